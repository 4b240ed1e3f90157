//! How the hair tile lies on the surface, at each patch vertex.

use glam::Vec3;
use pelage_coat::{PatchMesh, Surface};

/// What is derived from a tiling for each of its vertices.
pub(crate) struct TileFrames {
    /// ∂*p*/∂*s*: along the tile's *s*, as long as a tile is wide, in the tangent plane. ∂*p*/∂*t* is the normal's cross product with it, as patches are
    /// nearly conformal and not mirrored.
    pub(crate) axes: Vec<Vec3>,
    /// The surface vertex nearest to the middle of the vertex' patch.
    pub(crate) middles: Vec<u32>,
}

impl TileFrames {
    /// Of a coat that has passed its own check.
    pub(crate) fn of(surface: &Surface, patches: &PatchMesh) -> Self {
        Self { axes: axes(surface, patches), middles: middles(surface, patches) }
    }
}

/// The mean of the faces' gradients, weighted by area.
fn axes(surface: &Surface, patches: &PatchMesh) -> Vec<Vec3> {
    let place = |corner: u32| surface.positions[patches.vertices[corner as usize] as usize];
    let mut sums = vec![(Vec3::ZERO, 0.0_f32); patches.vertices.len()];
    for face in &patches.faces {
        let [a, b, c] = face.map(place);
        let [p, q, r] = face.map(|corner| patches.coordinates[corner as usize]);
        let (e, f, u, v) = (b - a, c - a, q - p, r - p);
        // Twice the face's area on the tile; ∂p/∂s solves e = u.x ∂p/∂s + u.y ∂p/∂t and the same for f and v.
        let on_tile = u.perp_dot(v);
        let area = e.cross(f).length();
        if on_tile == 0.0 {
            continue;
        }
        let along = (e * v.y - f * u.y) / on_tile;
        if along.is_finite() && area.is_finite() {
            for &corner in face {
                let sum = &mut sums[corner as usize];
                *sum = (sum.0 + area * along, sum.1 + area);
            }
        }
    }
    let vertices = sums.iter().zip(&patches.vertices);
    vertices
        .map(|(&(sum, weight), &vertex)| {
            let normal = surface.normals[vertex as usize];
            let mean = if weight > 0.0 { sum / weight } else { Vec3::ZERO };
            let flat = mean - normal * mean.dot(normal);
            // Any axis where none is defined: a face without area on the tile shows one texel whatever it is.
            if flat == Vec3::ZERO { normal.any_orthogonal_vector() } else { flat.normalize() * mean.length() }
        })
        .collect()
}

fn middles(surface: &Surface, patches: &PatchMesh) -> Vec<u32> {
    let mut middles = vec![0; patches.vertices.len()];
    let mut first = 0;
    for &end in &patches.patch_ends {
        let corners = || patches.faces[first..end as usize].iter().flatten().copied();
        let place = |corner: u32| surface.positions[patches.vertices[corner as usize] as usize];
        let count = 3 * (end as usize - first);
        let centre = corners().map(place).sum::<Vec3>() / count.max(1) as f32;
        let nearest = corners().min_by(|&a, &b| place(a).distance_squared(centre).total_cmp(&place(b).distance_squared(centre)));
        if let Some(nearest) = nearest {
            corners().for_each(|corner| middles[corner as usize] = patches.vertices[nearest as usize]);
        }
        first = end as usize;
    }
    middles
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    #[test]
    fn a_square_knows_its_axis_and_its_middle() {
        // A tile turned by 90 degrees and 0.5 wide: s runs along y.
        let positions: Vec<Vec3> = (0..9).map(|i| Vec3::new((i % 3) as f32, (i / 3) as f32, 0.0)).collect();
        let coordinates = positions.iter().map(|p| Vec2::new(p.y, -p.x) / 0.5).collect();
        let square = |i: u32| [[i, i + 1, i + 4], [i, i + 4, i + 3]];
        let faces: Vec<[u32; 3]> = [0, 1, 3, 4].into_iter().flat_map(square).collect();
        let surface = Surface { normals: vec![Vec3::Z; 9], positions, ..Surface::default() };
        let patches =
            PatchMesh { vertices: (0..9).collect(), coordinates, patch_ends: vec![faces.len() as u32], faces, opacities: Vec::new() };
        let frames = TileFrames::of(&surface, &patches);
        for axis in &frames.axes {
            assert!(axis.abs_diff_eq(0.5 * Vec3::Y, 1e-6), "{axis}");
            // t runs along −x.
            assert!(Vec3::Z.cross(*axis).abs_diff_eq(-0.5 * Vec3::X, 1e-6));
        }
        assert_eq!(frames.middles, vec![4; 9]);
    }

    #[test]
    fn faces_without_area_on_the_tile_give_some_axis() {
        let surface = Surface { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], normals: vec![Vec3::Z; 3], ..Surface::default() };
        let patches = PatchMesh {
            vertices: vec![0, 1, 2],
            coordinates: vec![Vec2::ONE; 3],
            faces: vec![[0, 1, 2]],
            patch_ends: vec![1],
            opacities: Vec::new(),
        };
        for axis in TileFrames::of(&surface, &patches).axes {
            assert!((axis.length() - 1.0).abs() < 1e-6 && axis.z == 0.0);
        }
    }
}
