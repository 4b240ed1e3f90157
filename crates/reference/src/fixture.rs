//! Coats for this crate's own tests.

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};
use pelage_coat::{Coat, FinEdges, Frame, MipImage, PatchMesh, ShellTexture, Surface};

/// A unit square in the plane z = 0, centred, of 2 `cells`² faces as one patch, with upright fur a tenth long and `tiles` of hair along a side.
pub(crate) fn square(cells: u32, tiles: f32) -> Coat {
    let side = cells + 1;
    let at = |k: u32| Vec2::new((k % side) as f32, (k / side) as f32) / cells as f32;
    let count = (side * side) as usize;
    let surface = Surface {
        positions: (0..side * side).map(|k| (at(k) - 0.5).extend(0.0)).collect(),
        normals: vec![Vec3::Z; count],
        offsets: vec![0.1 * Vec3::Z; count],
        bends: vec![Vec3::ZERO; count],
        ends: vec![1.0; count],
        mixes: vec![0.0; count],
        directions: vec![Vec3::Z; count],
        colours: vec![Vec3::ONE; count],
    };
    let corner = |k: u32| (k / cells) * side + k % cells;
    let faces = (0..cells * cells).map(corner).flat_map(|v| [[v, v + 1, v + side + 1], [v, v + side + 1, v + side]]).collect();
    let patches = PatchMesh {
        vertices: (0..side * side).collect(),
        coordinates: (0..side * side).map(|k| tiles * at(k)).collect(),
        faces,
        patch_ends: vec![2 * cells * cells],
        opacities: Vec::new(),
    };
    let skin = MipImage { width: 1, height: 1, texels: vec![180, 140, 120, 255] };
    let shells = Arc::new(ShellTexture::stack(1, vec![skin]));
    Coat { frame: Frame { centre: DVec3::ZERO, diameter: 1.0 }, surface, patches, edges: FinEdges::default(), shells, fin: None }
}
