//! A furry ball of plain arrays: a cube blown up, each of its sides a patch.

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};
use pelage_coat::{Camera, Coat, FinEdges, Frame, Irradiance, Light, Lights, MipImage, PatchMesh, ShellTexture, Surface};
use pelage_lighting::Shading;
use pelage_reference::View;

/// A ball with a diameter of a half, of 12 `cells`² faces, `tiles` of hair along each side of the cube, and fur a fifteenth long that leans to the west.
pub(crate) fn ball(cells: u32, tiles: f32) -> Coat {
    let side = cells + 1;
    let (mut surface, mut patches) = (Surface::default(), PatchMesh::default());
    for (normal, s) in [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z].into_iter().zip([
        Vec3::Y,
        Vec3::Z,
        Vec3::Z,
        Vec3::X,
        Vec3::X,
        Vec3::Y,
    ]) {
        let t = normal.cross(s);
        let first = surface.positions.len() as u32;
        for k in 0..side * side {
            let at = Vec2::new((k % side) as f32, (k / side) as f32) / cells as f32;
            // The tangent makes cells of like angles.
            let bent = (2.0 * at - 1.0) * std::f32::consts::FRAC_PI_4;
            let up = (normal + s * bent.x.tan() + t * bent.y.tan()).normalize_or(normal);
            let along = Vec3::new(-up.z, 0.0, up.x).normalize_or_zero();
            surface.positions.push(0.25 * up);
            surface.normals.push(up);
            surface.offsets.push(0.065 * (0.9 * up + 0.43 * along));
            surface.bends.push(0.02 * along);
            surface.ends.push(1.0);
            surface.mixes.push(0.0);
            surface.directions.push(0.8 * up + 0.4 * along);
            surface.colours.push(Vec3::new(0.9, 0.75 + 0.2 * up.y, 0.6));
            patches.vertices.push(first + k);
            patches.coordinates.push(tiles * at);
        }
        for k in 0..cells * cells {
            let corner = first + (k / cells) * side + k % cells;
            patches.faces.extend([[corner, corner + 1, corner + side + 1], [corner, corner + side + 1, corner + side]]);
        }
        patches.patch_ends.push(patches.faces.len() as u32);
    }
    let skin = MipImage { width: 1, height: 1, texels: vec![93, 78, 66, 255] };
    let shells = Arc::new(ShellTexture::stack(1, vec![skin]));
    Coat { frame: Frame { centre: DVec3::ZERO, diameter: 1.0 }, surface, patches, edges: FinEdges::default(), shells, fin: None }
}

/// The whole ball in a low sun.
pub(crate) fn view(coat: &Coat, aspect: f32) -> View {
    let (low, high) = coat.bounds();
    let radius = 0.5 * (high - low).max_element();
    let camera = Camera::framing(0.5 * (low + high), radius, 0.3, 0.3, 0.5, aspect, 1.02);
    let sun = Light { direction: Vec3::new(0.7, 0.5, 0.5).normalize_or(Vec3::Y), colour: Vec3::splat(2.0) };
    let ambient = Irradiance::hemisphere(Vec3::new(0.34, 0.42, 0.57), Vec3::new(0.17, 0.13, 0.11));
    View { camera, lights: Lights { directional: vec![sun], ambient }, shading: Shading::default() }
}
