//! Draws the environment picture of the graphs: soft overcast light, a warm low sun on one side, a dark warm ground.
//!
//! `cargo run -p pelage-nodes --example studio -- graphs/images/studio.png`
#![allow(clippy::print_stderr, reason = "an example for a terminal")]

use glam::DVec3;
use image::{Rgb, RgbImage};

const WIDTH: u32 = 64;
const HEIGHT: u32 = 32;

/// Linear colours: straight above, at the horizon, of the sun, of the ground.
const ZENITH: DVec3 = DVec3::new(0.42, 0.47, 0.55);
const HORIZON: DVec3 = DVec3::new(0.68, 0.68, 0.68);
const SUN: DVec3 = DVec3::new(1.0, 0.62, 0.32);
const GROUND: DVec3 = DVec3::new(0.11, 0.08, 0.06);

/// Where the sun is and how far its glow reaches, in degrees.
const SUN_AZIMUTH: f64 = 60.0;
const SUN_ELEVATION: f64 = 12.0;
const GLOW: f64 = 22.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage: studio OUT.png");
        std::process::exit(2);
    };
    let picture = RgbImage::from_fn(WIDTH, HEIGHT, |column, row| {
        let azimuth = 180.0 - 360.0 * (f64::from(column) + 0.5) / f64::from(WIDTH);
        let elevation = 90.0 - 180.0 * (f64::from(row) + 0.5) / f64::from(HEIGHT);
        Rgb(radiance(azimuth, elevation).to_array().map(encode))
    });
    Ok(picture.save(path)?)
}

/// The unit direction of an azimuth and an elevation in degrees, as the lights of a graph have it.
fn toward(azimuth: f64, elevation: f64) -> DVec3 {
    let (a, e) = (azimuth.to_radians(), elevation.to_radians());
    DVec3::new(e.cos() * a.sin(), e.sin(), e.cos() * a.cos())
}

fn radiance(azimuth: f64, elevation: f64) -> DVec3 {
    let apart = toward(azimuth, elevation).angle_between(toward(SUN_AZIMUTH, SUN_ELEVATION)).to_degrees();
    let glow = (-0.5 * (apart / GLOW).powi(2)).exp();
    if elevation > 0.0 {
        HORIZON.lerp(ZENITH, elevation.to_radians().sin()).lerp(SUN, glow)
    } else {
        // The ground shines back a little of the sun.
        GROUND + 0.15 * glow * SUN
    }
}

/// sRGB (IEC 61966-2-1), in bytes.
fn encode(linear: f64) -> u8 {
    let c = linear.clamp(0.0, 1.0);
    let encoded = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round() as u8
}
