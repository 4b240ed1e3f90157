//! What a level of detail for each patch would save over one for the whole coat (L16), in the fragments of shells.
//!
//! `cargo run --release -p pelage-tests --example patch_levels`. For each graph and distance: the faces that show their front, their area on the screen times the
//! shells that are drawn of them, at the level that the coat's centre asks for and at the one that the middle of each patch does.
#![allow(clippy::print_stdout, reason = "it prints a table")]

use glam::{Vec2, Vec3};
use pelage_coat::{Camera, Coat};
use pelage_render::Viewpoint;
use pelage_tests::{Error, Scene};

const SIZE: (u32, u32) = (640, 480);
/// Pixels between shells: the renderer's default, and the one of the saved graph of levels.
const SPACINGS: [f32; 2] = [0.25, 0.5];

fn main() -> Result<(), Error> {
    println!("{:8} {:>6} {:>8} {:>18} {:>18} {:>8}", "graph", "times", "spacing", "shells, one level", "shells, by patch", "of one");
    for name in ["bunny", "fox", "meadow"] {
        let scene = Scene::evaluate(name, &[("picture.size", "(64, 48)")])?;
        let coat = scene.coat()?;
        let near = scene.framing()?.camera(coat.bounds(), SIZE.0 as f32 / SIZE.1 as f32);
        for times in [1.0, 2.0, 4.0, 8.0] {
            let eye = near.target + times * (near.eye - near.target);
            let camera = Camera { eye, near: times * near.near, ..near };
            for spacing in SPACINGS {
                let (one, each) = shells(&coat, &Viewpoint::of(&camera, SIZE), spacing);
                println!("{name:8} {times:6} {spacing:8} {one:18.2} {each:18.2} {:8.2}", each / one);
            }
        }
    }
    Ok(())
}

/// The mean number of shells over the area that shows, with one level and with one for each patch.
fn shells(coat: &Coat, viewpoint: &Viewpoint, spacing: f32) -> (f32, f32) {
    let steps = coat.shells.layers().saturating_sub(1) as f32;
    let coarsest = (coat.shells.layers() as f32).log2().ceil();
    let length = coat.surface.offsets.iter().map(|offset| offset.length()).fold(0.0, f32::max);
    let drawn = |pixels: f32| steps / (spacing * steps / pixels.max(1e-6)).max(1.0).log2().min(coarsest).exp2();
    let whole = drawn(viewpoint.pixels_of(length));
    let depth = |at: Vec3| (viewpoint.clip_from_coat * at.extend(1.0)).w;
    let (mut area, mut one, mut each, mut first) = (0.0, 0.0, 0.0, 0);
    for &end in &coat.patches.patch_ends {
        let faces = &coat.patches.faces[first..end as usize];
        first = end as usize;
        let corners = faces.iter().flatten().map(|&corner| place(coat, corner));
        let middle = corners.sum::<Vec3>() / (3 * faces.len()).max(1) as f32;
        let own = drawn(viewpoint.pixels_of(length) * depth(Vec3::ZERO) / depth(middle).max(1e-6));
        let shown: f32 = faces.iter().map(|face| on_screen(viewpoint, face.map(|corner| place(coat, corner)))).sum();
        area += shown;
        one += shown * whole;
        each += shown * own;
    }
    (one / area, each / area)
}

fn place(coat: &Coat, corner: u32) -> Vec3 {
    coat.surface.positions[coat.patches.vertices[corner as usize] as usize]
}

/// The area that a face takes on the screen where it shows its front and all of it is in view, in squares of half the screen.
fn on_screen(viewpoint: &Viewpoint, corners: [Vec3; 3]) -> f32 {
    let clip = corners.map(|corner| viewpoint.clip_from_coat * corner.extend(1.0));
    if clip.iter().any(|c| c.w <= 1e-6 || c.x.abs() > c.w || c.y.abs() > c.w) {
        return 0.0;
    }
    let [a, b, c] = clip.map(|c| Vec2::new(c.x, c.y) / c.w);
    (0.5 * (b - a).perp_dot(c - a)).max(0.0)
}
