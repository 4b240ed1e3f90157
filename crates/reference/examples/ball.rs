//! Draws a furry ball and writes its hair as curves.
//!
//! `cargo run --release -p pelage-reference --example ball -- ball.png ball.txt`
#![allow(clippy::print_stdout, reason = "an example prints")]

mod common;

use std::fs::File;
use std::io::BufWriter;

use glam::Vec3;
use pelage_coat::Background;
use pelage_reference::{Laying, Placement, Scene, Settings, Shadows, quiet};
use pelage_strand::{GrowSettings, grow};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut files = std::env::args().skip(1);
    let (picture, curves) = (files.next().unwrap_or("ball.png".into()), files.next());
    let (coat, tile) = (common::ball(16, 3.0), grow(&GrowSettings::default())?);
    let scene = Scene::new(&coat, &tile, &Laying { placement: Placement::Free, ..Laying::default() })?;
    println!("{:?}", scene.counts());
    let settings = Settings { size: (480, 480), samples: 16, shadows: Shadows::Rays, ..Settings::default() };
    let image = scene.render(&common::view(&coat, 1.0), &settings, &quiet)?;
    println!("{} rays from the eye, {} towards the light", image.camera_rays, image.shadow_rays);
    let bytes = image.over(&Background { top: Vec3::splat(0.7), bottom: Vec3::splat(0.35) });
    image::RgbaImage::from_raw(image.width, image.height, bytes).ok_or("the pixels do not fill the picture")?.save(picture)?;
    if let Some(file) = curves {
        scene.curves()?.write(BufWriter::new(File::create(file)?))?;
    }
    Ok(())
}
