//! Shell space over one face: where a place of the tile at a height is on the surface.

use glam::{DVec2, DVec3, Vec3};
use pelage_coat::{Coat, Surface};

/// Fur shorter than this, in diameters, is there in proportion only, as the renderer has it: fur without length is no fur.
pub(crate) const GROWTH_LENGTH: f64 = 1e-3;

/// From a hair's axis to its rim the map is nearly linear: the second step is already within a millionth of the radius on an ordinary face.
const NEWTON_STEPS: usize = 3;

/// No hair reaches further over the edge of a face than the face is wide.
const FARTHEST_OVER: f64 = 1.0;

/// A coat and how much longer its fur is laid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Skin<'a> {
    pub(crate) coat: &'a Coat,
    pub(crate) length_scale: f64,
}

/// Positions and hair curves at three corners: S(β, h) = Σ β_i (p_i + c_i h + b_i (h² − h)).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sheet {
    places: [DVec3; 3],
    offsets: [DVec3; 3],
    bends: [DVec3; 3],
}

/// A face of a patch with the tile on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FaceMap {
    pub(crate) sheet: Sheet,
    pub(crate) corners: [DVec2; 3],
    pub(crate) ends: [f64; 3],
    pub(crate) growths: [f64; 3],
    pub(crate) mixes: [f64; 3],
    /// Twice the signed area in tiles.
    area: f64,
}

/// How far hair reaches over the bounds of a face's part of shell space.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Margins {
    pub(crate) beta: DVec3,
    pub(crate) height: f64,
}

impl Margins {
    fn grown(self, beta: DVec3, height: f64) -> Self {
        Self { beta: self.beta.max(beta.min(DVec3::splat(FARTHEST_OVER))), height: self.height.max(height.min(1.0)) }
    }

    /// Those of a part of the radius.
    pub(crate) fn scaled(&self, part: f64) -> Self {
        Self { beta: self.beta * part, height: self.height * part }
    }
}

/// What the skin under a place has, interpolated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SkinPoint {
    pub(crate) normal: DVec3,
    /// The mean of the hair's directions.
    pub(crate) direction: DVec3,
    pub(crate) colour: DVec3,
    /// Clamped to 0 … 1.
    pub(crate) growth: f64,
}

impl Skin<'_> {
    /// The surface vertices of a face's corners.
    pub(crate) fn vertices(&self, face: usize) -> [usize; 3] {
        self.coat.patches.faces[face].map(|corner| self.coat.patches.vertices[corner as usize] as usize)
    }

    /// The face's map; none where the tile has no area on it, or it no area.
    pub(crate) fn map(&self, face: usize) -> Option<FaceMap> {
        let surface = &self.coat.surface;
        let vertices = self.vertices(face);
        let corners = self.coat.patches.faces[face].map(|corner| self.coat.patches.coordinates[corner as usize].as_dvec2());
        let [first, second] = [corners[1] - corners[0], corners[2] - corners[0]];
        let area = first.perp_dot(second);
        let long = first.length_squared().max(second.length_squared());
        if area.abs() <= 1e-12 * long {
            return None;
        }
        let sheet = Sheet {
            places: vertices.map(|v| surface.positions[v].as_dvec3()),
            offsets: vertices.map(|v| surface.offsets[v].as_dvec3() * self.length_scale),
            bends: vertices.map(|v| surface.bends[v].as_dvec3() * self.length_scale),
        };
        let ends = vertices.map(|v| f64::from(surface.ends[v]));
        let mixes = vertices.map(|v| f64::from(surface.mixes[v]));
        Some(FaceMap { mixes, growths: vertices.map(|v| self.growth_at(v)), sheet, corners, ends, area })
    }

    /// The height of a place a little `aside` of one of a face whose height is known.
    pub(crate) fn height_beside(&self, face: usize, beta: DVec3, height: f64, aside: DVec3) -> f64 {
        self.map(face).map_or(height, |map| map.sheet.height_beside(beta, height, aside))
    }

    /// The skin's own values at barycentric coordinates of a face.
    pub(crate) fn point(&self, face: usize, beta: DVec3) -> SkinPoint {
        let surface: &Surface = &self.coat.surface;
        let vertices = self.vertices(face);
        let mixed = |array: &[Vec3]| mix(vertices.map(|v| array[v].as_dvec3()), beta);
        SkinPoint {
            normal: mixed(&surface.normals).normalize_or_zero(),
            direction: mixed(&surface.directions),
            colour: mixed(&surface.colours),
            growth: self.growth(face, beta),
        }
    }

    /// How much of its fur a place has: interpolated, then clamped.
    pub(crate) fn growth(&self, face: usize, beta: DVec3) -> f64 {
        DVec3::from(self.vertices(face).map(|v| self.growth_at(v))).dot(beta).clamp(0.0, 1.0)
    }

    /// Between the first coat and the last, 0 to 1: interpolated, then clamped.
    pub(crate) fn mix(&self, face: usize, beta: DVec3) -> f64 {
        DVec3::from(self.vertices(face).map(|v| f64::from(self.coat.surface.mixes[v]))).dot(beta).clamp(0.0, 1.0)
    }

    /// How much of its fur a vertex has, 1 and more for all.
    pub(crate) fn growth_at(&self, vertex: usize) -> f64 {
        self.coat.surface.offsets[vertex].as_dvec3().length() * self.length_scale / GROWTH_LENGTH
    }
}

/// Σ β_i v_i.
fn mix(values: [DVec3; 3], beta: DVec3) -> DVec3 {
    values[0] * beta.x + values[1] * beta.y + values[2] * beta.z
}

impl Sheet {
    pub(crate) fn place(&self, beta: DVec3, height: f64) -> DVec3 {
        mix(self.places, beta) + mix(self.offsets, beta) * height + mix(self.bends, beta) * (height * height - height)
    }

    /// The second derivative of the way as β and h run evenly, by `turn` and `rise`: linear on the way, so largest at one of its ends.
    pub(crate) fn second_derivative(&self, beta: DVec3, height: f64, turn: DVec3, rise: f64) -> DVec3 {
        2.0 * rise * (mix(self.offsets, turn) + (2.0 * height - 1.0) * mix(self.bends, turn)) + 2.0 * rise * rise * mix(self.bends, beta)
    }

    /// The same positions with one curve everywhere: that at a place of the face.
    pub(crate) fn with_curve_of(&self, beta: DVec3) -> Self {
        Self { places: self.places, offsets: [mix(self.offsets, beta); 3], bends: [mix(self.bends, beta); 3] }
    }

    /// Twice the area of the shell at a height, along its normal.
    fn facing(&self, height: f64) -> DVec3 {
        let corner = |k: usize| self.places[k] + self.offsets[k] * height + self.bends[k] * (height * height - height);
        let origin = corner(0);
        (corner(1) - origin).cross(corner(2) - origin)
    }

    /// How β₁, β₂ and h change along x, y and z at a place of shell space: the rows of the inverse of the map's derivative. None where shells touch.
    fn gradients(&self, beta: DVec3, height: f64) -> Option<[DVec3; 3]> {
        let corner = |k: usize| self.places[k] + self.offsets[k] * height + self.bends[k] * (height * height - height);
        let last = corner(2);
        let (first, second) = (corner(0) - last, corner(1) - last);
        let rise = mix(self.offsets, beta) + (2.0 * height - 1.0) * mix(self.bends, beta);
        let volume = first.cross(second).dot(rise);
        let least = 1e-9 * first.length() * second.length() * rise.length();
        (volume.abs() > least).then(|| [second.cross(rise), rise.cross(first), first.cross(second)].map(|row| row / volume))
    }

    /// Where a place of the surface is in shell space, looked for from a place near it (Newton); none where it does not settle.
    fn coordinates(&self, place: DVec3, (mut beta, mut height): (DVec3, f64)) -> Option<(DVec3, f64)> {
        for _ in 0..NEWTON_STEPS {
            let off = place - self.place(beta, height);
            let step = self.gradients(beta, height)?.map(|row| row.dot(off));
            beta += DVec3::new(step[0], step[1], -step[0] - step[1]);
            height += step[2];
        }
        (beta.is_finite() && height.is_finite()).then_some((beta, height))
    }

    /// The height of a place a little `aside` of one whose height is known: that of the shell through it, to first order. 0 to 1.
    fn height_beside(&self, beta: DVec3, height: f64, aside: DVec3) -> f64 {
        let rise = mix(self.offsets, beta) + (2.0 * height - 1.0) * mix(self.bends, beta);
        let normal = self.facing(height);
        let (up, between) = (normal.dot(aside), normal.dot(rise));
        // Where shells touch each other a place is on many.
        if up.abs() < between.abs() { (height + up / between).clamp(0.0, 1.0) } else { height.clamp(0.0, 1.0) }
    }
}

impl FaceMap {
    /// Barycentric coordinates of a place of the tile plane.
    pub(crate) fn barycentric(&self, place: DVec2) -> DVec3 {
        let [a, b, c] = self.corners.map(|corner| corner - place);
        let beta = DVec2::new(b.perp_dot(c), c.perp_dot(a)) / self.area;
        DVec3::new(beta.x, beta.y, 1.0 - beta.x - beta.y)
    }

    /// The side of a tile on the shell at a height: of the square of the same area.
    pub(crate) fn side(&self, height: f64) -> f64 {
        (self.sheet.facing(height).length() / self.area.abs()).sqrt()
    }

    /// The box around it in the tile plane.
    pub(crate) fn bounds(&self) -> (DVec2, DVec2) {
        self.bounds_with(&Margins::default())
    }

    /// The box around all places of the tile plane whose barycentric coordinates are negative by no more than the margins.
    pub(crate) fn bounds_with(&self, margins: &Margins) -> (DVec2, DVec2) {
        let all = margins.beta.element_sum();
        let [a, b, c] = [0, 1, 2].map(|k| {
            let mut beta = -margins.beta;
            beta[k] = 1.0 + all - margins.beta[k];
            self.corners[0] * beta.x + self.corners[1] * beta.y + self.corners[2] * beta.z
        });
        (a.min(b).min(c), a.max(b).max(c))
    }

    /// How far hair of a radius, in tile sides, reaches in shell space from its axis.
    pub(crate) fn margins(&self, radius: f64) -> Margins {
        let middle = DVec3::splat(1.0 / 3.0);
        [0.0, 0.5, 1.0].into_iter().fold(Margins::default(), |most, height| {
            let reach = radius * self.side(height);
            let Some([first, second, up]) = self.sheet.gradients(middle, height) else {
                return most.grown(DVec3::splat(FARTHEST_OVER), 1.0);
            };
            most.grown(DVec3::new(first.length(), second.length(), (first + second).length()) * reach, up.length() * reach)
        })
    }

    /// How far inside of the face's part of shell space a place is: barycentric coordinates, and the height that is left to the hair's end and to the outermost shell.
    pub(crate) fn inside(&self, place: DVec3, near: (DVec3, f64)) -> Option<[f64; 5]> {
        let (beta, height) = self.sheet.coordinates(place, near)?;
        Some([beta.x, beta.y, beta.z, beta.dot(self.ends.into()) - height, 1.0 - height])
    }

    /// Whether the face faces up in the tile.
    pub(crate) fn is_anticlockwise(&self) -> bool {
        self.area > 0.0
    }

    /// The least and the greatest mix of its corners.
    pub(crate) fn mix_range(&self) -> (f64, f64) {
        let [a, b, c] = self.mixes;
        (a.min(b).min(c), a.max(b).max(c))
    }

    /// Whether it has any fur.
    pub(crate) fn is_furred(&self) -> bool {
        self.growths.iter().any(|&growth| growth > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::square;

    /// A face whose fur differs from corner to corner in every way.
    fn twisted() -> FaceMap {
        let mut coat = square(1, 1.0);
        for (v, offset) in coat.surface.offsets.iter_mut().enumerate() {
            *offset = Vec3::new(0.1 * v as f32 - 0.2, 0.05 - 0.02 * v as f32, 0.2 + 0.1 * v as f32);
            coat.surface.bends[v] = Vec3::new(0.1, 0.03 * v as f32, -0.04);
        }
        Skin { coat: &coat, length_scale: 1.0 }.map(0).unwrap()
    }

    #[test]
    fn the_second_derivative_is_that_of_the_way() {
        let sheet = twisted().sheet;
        let (beta, turn) = (DVec3::new(0.3, 0.5, 0.2), DVec3::new(0.4, -0.3, -0.1));
        for (height, rise) in [(0.2, 0.5), (0.9, -0.7), (0.4, 0.0)] {
            let at = |t: f64| sheet.place(beta + turn * t, height + rise * t);
            let step = 1e-3;
            let differences = (at(step) - 2.0 * at(0.0) + at(-step)) / (step * step);
            let stated = sheet.second_derivative(beta, height, turn, rise);
            assert!(differences.abs_diff_eq(stated, 1e-6), "{differences} for {stated}");
        }
    }

    #[test]
    fn places_are_found_again_in_shell_space() {
        let sheet = twisted().sheet;
        for (beta, height) in [(DVec3::new(0.3, 0.5, 0.2), 0.4), (DVec3::new(0.05, 0.9, 0.05), 0.95)] {
            let near = (beta + DVec3::new(0.03, -0.05, 0.02), height - 0.04);
            let (found, at) = sheet.coordinates(sheet.place(beta, height), near).unwrap();
            assert!(found.abs_diff_eq(beta, 1e-9) && (at - height).abs() < 1e-9, "{found}, {at}");
        }
    }
}
