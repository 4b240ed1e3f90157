//! Builds a furry square by hand, checks it and says what it holds.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};
use pelage_coat::{Coat, CoatError, FinEdges, Frame, MipImage, PatchMesh, ShellTexture, Surface};

fn main() -> Result<(), CoatError> {
    let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let surface = Surface {
        positions: corners.iter().map(|c| Vec3::new(c.x - 0.5, 0.0, 0.5 - c.y)).collect(),
        normals: vec![Vec3::Y; 4],
        // Fur as long as a hundredth of the model, leaning towards −z.
        offsets: vec![Vec3::new(0.0, 0.008, -0.006); 4],
        bends: vec![Vec3::ZERO; 4],
        ends: vec![1.0; 4],
        mixes: vec![0.0; 4],
        directions: vec![Vec3::new(0.0, 0.8, -0.6); 4],
        colours: vec![Vec3::new(0.6, 0.4, 0.2); 4],
    };
    let patches = PatchMesh {
        vertices: vec![0, 1, 2, 3],
        coordinates: corners.iter().map(|c| 8.0 * *c).collect(),
        faces: vec![[0, 1, 2], [0, 2, 3]],
        patch_ends: vec![2],
        opacities: Vec::new(),
    };
    // Two layers of one texel: an opaque skin, and above it fur that covers half.
    let texels = vec![200, 200, 200, 255, 137, 137, 137, 128];
    let coat = Coat {
        frame: Frame { centre: DVec3::ZERO, diameter: 1.0 },
        surface,
        patches,
        edges: FinEdges::default(),
        shells: Arc::new(ShellTexture::stack(2, vec![MipImage { width: 1, height: 1, texels }])),
        fin: None,
    };
    coat.check()?;
    let (least, greatest) = coat.bounds();
    println!("{} faces, {} bytes of arrays, {} bytes of texture", coat.patches.faces.len(), coat.byte_size(), coat.shells.byte_size());
    println!("from {least} to {greatest}");
    Ok(())
}
