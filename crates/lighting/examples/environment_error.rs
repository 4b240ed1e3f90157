//! Prints how far light from all around to order 2 is from that of all orders, for pictures from smooth to a point.
//!
//! `cargo run --release -p pelage-lighting --example environment_error`
#![allow(clippy::print_stdout, reason = "an example prints")]

use glam::DVec3;
use pelage_lighting::{Environment, EnvironmentError};

const WIDTH: usize = 256;
const HEIGHT: usize = 128;

fn main() -> Result<(), EnvironmentError> {
    let sun = toward(30.0, 40.0);
    let cap = |degrees: f64| move |d: DVec3| f32::from(d.dot(sun) >= degrees.to_radians().cos());
    let pictures: [(&str, &dyn Fn(DVec3) -> f32); 7] = [
        ("one colour", &|_| 1.0),
        ("sky and ground", &|d| if d.y > 0.0 { 1.0 } else { 0.2 }),
        ("sky brighter at the top", &|d| if d.y > 0.0 { 0.3 + 0.7 * d.y as f32 } else { 0.2 }),
        ("half a wall: one side bright", &|d| f32::from(d.x > 0.0 && d.y > 0.0)),
        ("a disc of 60 degrees", &cap(60.0)),
        ("a disc of 30 degrees", &cap(30.0)),
        ("a disc of 2 degrees", &cap(2.0)),
    ];
    println!("{:<30}{:>10}{:>10}", "of the brightest normal", "largest", "rms");
    for (name, radiance) in pictures {
        let (largest, rms) = error(&picture(radiance)?);
        println!("{name:<30}{largest:>10.4}{rms:>10.4}");
    }
    Ok(())
}

/// The unit direction of an azimuth and an elevation in degrees.
fn toward(azimuth: f64, elevation: f64) -> DVec3 {
    let (a, e) = (azimuth.to_radians(), elevation.to_radians());
    DVec3::new(e.cos() * a.sin(), e.sin(), e.cos() * a.cos())
}

/// A grey picture by the radiance from each direction.
fn picture(radiance: &dyn Fn(DVec3) -> f32) -> Result<Environment, EnvironmentError> {
    let texel = |at: usize| {
        let (column, row) = ((at % WIDTH) as f64 + 0.5, (at / WIDTH) as f64 + 0.5);
        let direction = toward(180.0 - 360.0 * column / WIDTH as f64, 90.0 - 180.0 * row / HEIGHT as f64);
        [radiance(direction); 3]
    };
    Environment::new(WIDTH, HEIGHT, (0..WIDTH * HEIGHT).map(texel).collect())
}

/// The largest and the RMS error over normals evenly spread, over the brightest of them.
fn error(environment: &Environment) -> (f64, f64) {
    const NORMALS: u32 = 1000;
    let light = environment.irradiance();
    let (mut brightest, mut largest, mut squares) = (0.0_f64, 0.0_f64, 0.0);
    for k in 0..NORMALS {
        // Evenly in height, and by the golden angle around.
        let y = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(NORMALS);
        let normal = toward(137.507_764 * f64::from(k), y.asin().to_degrees());
        let full = environment.irradiance_in_full(normal).x;
        let apart = (light.at(normal).x - full).abs();
        (brightest, largest, squares) = (brightest.max(full), largest.max(apart), squares + apart * apart);
    }
    (largest / brightest, (squares / f64::from(NORMALS)).sqrt() / brightest)
}
