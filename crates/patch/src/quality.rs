//! What a tiling is worth, measured from the tiling itself.

use glam::{DVec2, DVec3};
use pelage_field::{DirectionField, Singularity, singularities};
use pelage_mesh::{Face, Geodesics, Mesh, Source, SurfacePoint};

use crate::connectivity::is_disc;
use crate::distortion::Jacobian;
use crate::frame::direction_in_layout;
use crate::shape::{FaceShape, face_shapes};
use crate::{Patch, PatchTiling};

/// Figures of a [`PatchTiling`]. Those over faces leave out faces without area; they are 0 where there is nothing to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Patches.
    pub patch_count: usize,
    /// Faces that lie in exactly one patch.
    pub faces_covered: usize,
    /// Faces whose image winds clockwise, or has no area though the face has.
    pub faces_flipped: usize,
    /// Faces without area: twice the area is at most 1e-10 of the longest side squared.
    pub faces_degenerate: usize,
    /// Whether every patch is a topological disc: in one piece, without holes, handles or pinched vertices.
    pub all_discs: bool,
    /// The median number of faces of a patch.
    pub faces_per_patch_p50: usize,
    /// Patches of three faces or fewer.
    pub tiny_patch_count: usize,
    /// The part of the surface that lies in those.
    pub tiny_patch_area: f64,
    /// Median over faces of the stretch: the greater of the greater singular value and the inverse of the lesser of the map from surface to
    /// tile, 1 at the wanted scale, infinite for a flipped face.
    pub stretch_p50: f64,
    /// The stretch that one face in a hundred exceeds.
    pub stretch_p99: f64,
    /// The greatest stretch.
    pub stretch_max: f64,
    /// Mean over the area of the angle, in degrees, between the field and the hair: the tile's t axis pulled back into the face. `None`
    /// without a field.
    pub misalignment_deg_mean: Option<f64>,
    /// The same mean over the faces whose corners are all more than one tile, along the surface, from the middle of every face that holds a singularity
    /// of the field: nearer the field turns within a tile, and no patch can follow. 0 where no face is that far; `None` without a field.
    pub misalignment_deg_mean_far: Option<f64>,
    /// The greatest such angle of any face, in degrees.
    pub misalignment_deg_max: Option<f64>,
    /// Length of the edges between patches, in diameters of the model.
    pub seam_length: f64,
    /// The same as a fraction of the length of all edges.
    pub seam_fraction: f64,
    /// Median over patches of the tiles spanned: the longer side of the box around the patch's coordinates.
    pub tile_repeats_p50: f64,
    /// The most tiles that a patch spans.
    pub tile_repeats_max: f64,
}

impl PatchTiling {
    /// Measures the tiling on the mesh that it was made from; `directions` is the field that it should follow, if any.
    ///
    /// Cost: linear, but for sorting the faces by stretch; with a field its singularities are found too. A mesh or field with other counts than the tiling was made from is measured as
    /// far as it goes: faces that it does not have count as not covered.
    pub fn quality(&self, mesh: &Mesh, directions: Option<&DirectionField>) -> Quality {
        let directions = directions.filter(|d| d.vectors().len() == mesh.topology().vertex_count());
        let shapes = face_shapes(mesh, self.tile_side());
        let rows: Vec<usize> = (0..self.faces().len()).filter(|&row| self.surface_faces()[row].index() < shapes.len()).collect();
        let distortion = Distortion::measure(self, mesh, directions, &shapes, &rows);
        let (seam, total) = self.seam_lengths(mesh);
        let area = |patch: &Patch| -> f64 {
            patch.faces().filter_map(|row| shapes.get(self.surface_faces()[row].index())).map(FaceShape::area).sum()
        };
        let tiny = |patch: &&Patch| patch.faces().len() <= 3;
        let whole: f64 = shapes.iter().map(FaceShape::area).sum();
        let repeats = sorted(self.patches().iter().map(|p| self.span(p)).collect());
        Quality {
            patch_count: self.patches().len(),
            faces_covered: self.faces_covered(shapes.len()),
            faces_flipped: distortion.flipped,
            faces_degenerate: distortion.degenerate,
            all_discs: self.patches().iter().all(|p| is_disc(&self.faces()[p.faces()])),
            faces_per_patch_p50: percentile(&sorted(self.patches().iter().map(|p| p.faces().len() as f64).collect()), 0.5) as usize,
            tiny_patch_count: self.patches().iter().filter(tiny).count(),
            tiny_patch_area: ratio(self.patches().iter().filter(tiny).map(area).sum(), whole),
            stretch_p50: percentile(&distortion.stretch, 0.5),
            stretch_p99: percentile(&distortion.stretch, 0.99),
            stretch_max: percentile(&distortion.stretch, 1.0),
            misalignment_deg_mean: directions.map(|_| distortion.mean_misalignment),
            misalignment_deg_mean_far: directions.map(|field| self.mean_misalignment_far(mesh, field, &shapes, &rows)),
            misalignment_deg_max: directions.map(|_| distortion.max_misalignment),
            seam_length: ratio(seam, mesh.diameter()),
            seam_fraction: ratio(seam, total),
            tile_repeats_p50: percentile(&repeats, 0.5),
            tile_repeats_max: percentile(&repeats, 1.0),
        }
    }

    /// The angle, in degrees, between the field and the hair in each of [`PatchTiling::faces`]; NaN in faces without area or
    /// direction, or that the mesh does not have.
    pub fn misalignment_deg(&self, mesh: &Mesh, directions: &DirectionField) -> Vec<f64> {
        if directions.vectors().len() != mesh.topology().vertex_count() {
            return vec![f64::NAN; self.faces().len()];
        }
        let shapes = face_shapes(mesh, self.tile_side());
        (0..self.faces().len()).map(|row| self.misalignment_of(mesh, directions, &shapes, row).unwrap_or(f64::NAN)).collect()
    }

    fn misalignment_of(&self, mesh: &Mesh, directions: &DirectionField, shapes: &[FaceShape], row: usize) -> Option<f64> {
        let face = self.surface_faces()[row];
        let shape = shapes.get(face.index()).filter(|s| !s.degenerate)?;
        let direction = direction_in_layout(mesh, directions, face, self.tile_side())?;
        let cosine = Jacobian::new(shape, self.places(row)).alignment(direction);
        Some(cosine.clamp(-1.0, 1.0).acos().to_degrees())
    }

    /// In degrees, over the area that is more than a tile from the field's singularities.
    fn mean_misalignment_far(&self, mesh: &Mesh, directions: &DirectionField, shapes: &[FaceShape], rows: &[usize]) -> f64 {
        let near = near_singularities(mesh, directions, self.tile_side());
        let far = rows.iter().filter(|&&row| !near[self.surface_faces()[row].index()]);
        let (mut sum, mut area) = (0.0, 0.0);
        for &row in far {
            if let Some(degrees) = self.misalignment_of(mesh, directions, shapes, row) {
                let weight = shapes[self.surface_faces()[row].index()].area();
                (sum, area) = (sum + weight * degrees, area + weight);
            }
        }
        ratio(sum, area)
    }

    fn places(&self, row: usize) -> [DVec2; 3] {
        self.faces()[row].map(|v| self.coordinates()[v as usize])
    }

    fn span(&self, patch: &Patch) -> f64 {
        let places = &self.coordinates()[patch.vertices()];
        let first = places.first().copied().unwrap_or_default();
        let (low, high) = places.iter().fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)));
        (high - low).max_element()
    }

    fn faces_covered(&self, face_count: usize) -> usize {
        let mut covers = vec![0_u8; face_count];
        for face in self.surface_faces() {
            if let Some(count) = covers.get_mut(face.index()) {
                *count = count.saturating_add(1);
            }
        }
        covers.into_iter().filter(|&count| count == 1).count()
    }

    /// Of the edges between patches, and of all; in model units.
    fn seam_lengths(&self, mesh: &Mesh) -> (f64, f64) {
        let patch = |face: Face<'_, Mesh>| self.patch_of_face().get(face.index());
        mesh.edges().fold((0.0, 0.0), |(seam, total), edge| {
            let length = edge.length();
            let mut sides = edge.faces().map(patch);
            let first = sides.next();
            let parts = sides.any(|other| Some(other) != first);
            (if parts { seam + length } else { seam }, total + length)
        })
    }
}

/// The faces that hold a singularity of the field, and those a corner of which lies within `reach`, in model units, of the middle of one that does.
fn near_singularities(mesh: &Mesh, directions: &DirectionField, reach: f64) -> Vec<bool> {
    let found = singularities(mesh, directions).unwrap_or_default();
    let middle = |s: &Singularity| Source::Point(SurfacePoint { face: s.face, barycentrics: DVec3::splat(1.0 / 3.0) });
    let sources: Vec<Source> = found.iter().map(middle).collect();
    let mut close = vec![false; mesh.positions().len()];
    // Sources on the mesh and a reach that is a length have distances.
    if let Ok(distances) = Geodesics::on(mesh).distances(&sources, reach) {
        distances.nearest_first().iter().for_each(|(vertex, _)| close[vertex.index()] = true);
    }
    let mut near: Vec<bool> = mesh.faces().map(|face| face.vertices().iter().any(|v| close[v.index()])).collect();
    found.iter().for_each(|s| near[s.face.index()] = true);
    near
}

struct Distortion {
    /// Ascending.
    stretch: Vec<f64>,
    flipped: usize,
    degenerate: usize,
    mean_misalignment: f64,
    max_misalignment: f64,
}

impl Distortion {
    fn measure(tiling: &PatchTiling, mesh: &Mesh, directions: Option<&DirectionField>, shapes: &[FaceShape], rows: &[usize]) -> Self {
        let mut result =
            Self { stretch: Vec::with_capacity(rows.len()), flipped: 0, degenerate: 0, mean_misalignment: 0.0, max_misalignment: 0.0 };
        let mut aligned_area = 0.0;
        for &row in rows {
            let shape = &shapes[tiling.surface_faces()[row].index()];
            if shape.degenerate {
                result.degenerate += 1;
                continue;
            }
            let jacobian = Jacobian::new(shape, tiling.places(row));
            result.stretch.push(jacobian.stretch());
            // A face whose coordinates overflow is no better than a flipped one, and has the same stretch.
            result.flipped += usize::from(!jacobian.stretch().is_finite());
            if let Some(degrees) = directions.and_then(|d| tiling.misalignment_of(mesh, d, shapes, row)) {
                result.mean_misalignment += shape.area() * degrees;
                result.max_misalignment = result.max_misalignment.max(degrees);
                aligned_area += shape.area();
            }
        }
        result.mean_misalignment = ratio(result.mean_misalignment, aligned_area);
        result.stretch = sorted(result.stretch);
        result
    }
}

fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values
}

/// By nearest rank; 0 of nothing.
fn percentile(ascending: &[f64], part: f64) -> f64 {
    let rank = (part * ascending.len() as f64).ceil() as usize;
    ascending.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
}

fn ratio(part: f64, whole: f64) -> f64 {
    // An empty sum is −0.
    if whole > 0.0 { (part / whole).max(0.0) } else { 0.0 }
}
