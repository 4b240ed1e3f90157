//! Pictures of a furry ball and a furry ring made by hand: whole, close, grazing, lit from all sides, and pass by pass.
//!
//! `cargo run --release -p pelage-render --example furry_sphere -- FOLDER` (default `target/furry_sphere`).
#![allow(clippy::print_stdout, reason = "an example prints")]

#[path = "../samples/mod.rs"]
mod samples;

use std::error::Error;
use std::f32::consts::FRAC_PI_2;
use std::path::PathBuf;

use glam::Vec3;
use pelage_coat::{Camera, Coat};
use pelage_render::{Headless, LightingMode, Options, Picture, ShellDepth, View, render_picture};
use samples::hair::Recipe;
use samples::{Style, background, coat, light, shapes};

const SIZE: (u32, u32) = (640, 480);

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args_os().nth(1).map_or_else(|| "target/furry_sphere".into(), Into::into);
    std::fs::create_dir_all(&folder)?;
    let headless = Headless::new()?;
    let summary = headless.summary();
    println!("{} ({}{})", summary.name, summary.backend, if summary.software { ", software" } else { "" });

    let hair = Recipe::default().grow();
    let ball = coat(&shapes::sphere(20, 7.0), Style::default(), &hair);
    let ring = coat(&shapes::torus((72, 30), (12, 5)), Style::default(), &hair);
    let whole = camera(0.6, 0.3, 1.05);
    let close = Camera { eye: Vec3::new(0.25, 0.3, 0.62), target: Vec3::new(0.1, 0.12, 0.2), ..whole };
    let grazing = Camera { eye: Vec3::new(0.0, 0.36, 0.55), target: Vec3::new(0.0, 0.28, 0.0), ..whole };
    let over_ring = Camera { eye: Vec3::new(0.0, 0.32, 0.8), target: Vec3::new(0.02, 0.09, 0.2), ..whole };
    let sun = Vec3::new(0.5, 0.8, 0.6);
    let parts = |surface, fins, shells| Options { surface, fins, shells, ..Options::default() };
    let with = |options: Options| View { options, ..View::new(whole, light(sun)) };
    let views: Vec<(&str, &Coat, View)> = vec![
        ("whole", &ball, with(Options::default())),
        ("ring", &ring, with(Options::default())),
        ("close", &ball, View::new(close, light(sun))),
        ("grazing", &ball, View::new(grazing, light(sun))),
        ("far", &ball, View::new(camera(0.6, 0.3, 5.0), light(sun))),
        ("light_left", &ball, View::new(whole, light(Vec3::new(-1.0, 0.3, 0.5)))),
        ("light_right", &ball, View::new(whole, light(Vec3::new(1.0, 0.3, 0.1)))),
        ("light_behind", &ball, View::new(whole, light(Vec3::new(-0.3, 0.4, -1.0)))),
        ("surface_only", &ball, with(parts(true, false, false))),
        ("fins_only", &ball, with(parts(true, true, false))),
        ("shells_only", &ball, with(parts(true, false, true))),
        ("blended", &ball, with(Options { shell_depth: ShellDepth::Tested, ..Options::default() })),
        ("formula", &ball, with(Options { lighting: LightingMode::Formula, ..Options::default() })),
        ("table", &ball, with(Options { lighting: LightingMode::Table(Default::default()), ..Options::default() })),
        ("anisotropic", &ball, with(Options { anisotropy: 8, ..Options::default() })),
        ("ring_blended", &ring, with(Options { shell_depth: ShellDepth::Tested, ..Options::default() })),
        ("over_ring", &ring, View::new(over_ring, light(sun))),
        (
            "over_ring_blended",
            &ring,
            View { options: Options { shell_depth: ShellDepth::Tested, ..Options::default() }, ..View::new(over_ring, light(sun)) },
        ),
        ("close_dotted", &ball, View { options: Options { step_blur: 0.0, ..Options::default() }, ..View::new(close, light(sun)) }),
        ("above", &ring, View::new(camera(0.0, FRAC_PI_2 * 0.6, 1.05), light(sun))),
    ];
    for (name, coat, view) in views {
        let picture = render_picture(&headless, coat, &view, SIZE, 4, &background())?;
        save(&picture, &folder.join(format!("{name}.png")))?;
        println!("{name}: {:?}", picture.frame);
    }
    Ok(())
}

fn camera(azimuth: f32, elevation: f32, margin: f32) -> Camera {
    Camera::framing(Vec3::ZERO, 0.34, azimuth, elevation, 0.6, SIZE.0 as f32 / SIZE.1 as f32, margin)
}

fn save(picture: &Picture, path: &std::path::Path) -> Result<(), Box<dyn Error>> {
    Ok(image::save_buffer(path, &picture.rgba, picture.width, picture.height, image::ExtendedColorType::Rgba8)?)
}
