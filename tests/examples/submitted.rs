//! What is submitted of the bunny's shells, seen from elsewhere: the faces that were picked for the graph's own camera keep their fur, the others are bald.
//!
//! `cargo run --release -p pelage-tests --example submitted -- PICTURE.png`
#![allow(clippy::print_stdout, reason = "a program for a person at a terminal")]

use std::collections::BTreeSet;

use glam::{Quat, Vec3};
use image::RgbaImage;
use pelage_coat::{Camera, Coat};
use pelage_render::{Offscreen, Options, View};
use pelage_tests::{Error, Fur, Scene, Stage, gpu};

/// How far round the model from where faces were picked, in degrees.
const ROUND: [f32; 3] = [0.0, 100.0, 180.0];

const SIZE: (u32, u32) = (300, 300);

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1).ok_or("say where the picture goes: -- PICTURE.png")?;
    let scene = Scene::evaluate("bunny", &[])?;
    let coat = scene.coat()?;
    let (view, background) = scene.view(&coat)?;
    let (headless, options) = (gpu()?.headless(), Options { fins: false, culling: false, ..view.options });
    let stage = Stage::new(headless, 1);
    let picked = Fur::new(headless, &stage, &coat, &view)?.faces(headless, &stage)?;
    println!("{} of {} faces are submitted for each shell", picked.len(), coat.patches.faces.len());
    let offscreen = Offscreen::new(headless, SIZE, 4)?;
    let bared = offscreen.upload(&bared(&coat, &picked))?;
    let mut strip = RgbaImage::new(SIZE.0 * ROUND.len() as u32, SIZE.1);
    for (place, degrees) in (0..).zip(ROUND) {
        let view = View { camera: round(&view.camera, degrees), options, ..view.clone() };
        let picture = offscreen.render(&bared, &view, &background)?;
        let picture = RgbaImage::from_raw(SIZE.0, SIZE.1, picture.rgba).ok_or("the pixels do not fill the picture")?;
        image::imageops::replace(&mut strip, &picture, place * i64::from(SIZE.0), 0);
    }
    Ok(strip.save(path)?)
}

/// The coat without fur on any face but those picked. The others get vertices of their own, without length.
fn bared(coat: &Coat, picked: &[[u32; 3]]) -> Coat {
    let picked: BTreeSet<[u32; 3]> = picked.iter().copied().collect();
    let mut coat = coat.clone();
    let (vertices, corners) = (coat.surface.positions.len() as u32, coat.patches.vertices.len() as u32);
    let surface = &mut coat.surface;
    for array in [&mut surface.positions, &mut surface.normals, &mut surface.directions, &mut surface.colours] {
        array.extend_from_within(..);
    }
    for array in [&mut surface.offsets, &mut surface.bends] {
        array.resize(2 * vertices as usize, Vec3::ZERO);
    }
    surface.ends.resize(2 * vertices as usize, 0.0);
    surface.mixes.resize(2 * vertices as usize, 0.0);
    let patches = &mut coat.patches;
    patches.vertices.extend(patches.vertices.clone().iter().map(|vertex| vertex + vertices));
    patches.coordinates.extend_from_within(..);
    patches.faces.iter_mut().filter(|face| !picked.contains(*face)).for_each(|face| *face = face.map(|corner| corner + corners));
    coat
}

/// A camera moved round what it looks at.
fn round(camera: &Camera, degrees: f32) -> Camera {
    let turn = Quat::from_axis_angle(camera.up, degrees.to_radians());
    Camera { eye: camera.target + turn * (camera.eye - camera.target), ..*camera }
}
