//! Draws the pictures of a tile in `graphs/images`: `mottled.png`, colours of a coat, and `tufts.png`, tufts as an artist might draw them, whose alpha is how high hair stands. Both repeat.
//!
//! `cargo run -p pelage-nodes --example tile_pictures -- graphs/images`

use std::f64::consts::TAU;
use std::path::Path;

use image::{Rgba, RgbaImage};

const SIDE: u32 = 128;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("say which folder to write to, as graphs/images")?;
    RgbaImage::from_fn(SIDE, SIDE, mottled).save(Path::new(&folder).join("mottled.png"))?;
    RgbaImage::from_fn(SIDE, SIDE, tufts).save(Path::new(&folder).join("tufts.png"))?;
    Ok(())
}

/// Waves that cross each other, dark where they meet: patches of brown on cream.
fn mottled(x: u32, y: u32) -> Rgba<u8> {
    let (s, t) = (f64::from(x) / f64::from(SIDE) * TAU, f64::from(y) / f64::from(SIDE) * TAU);
    let waves = (2.0 * s + (3.0 * t).sin()).sin() + (3.0 * t - (2.0 * s).cos()).sin() + 0.7 * (s + 2.0 * t + (4.0 * s).sin()).cos();
    let brown = ((waves + 0.2) * 3.0).clamp(0.0, 1.0);
    mixed([236.0, 216.0, 186.0], [120.0, 78.0, 48.0], brown, 255)
}

/// Pointed tufts in rows that are staggered as bricks are, each a little taller or shorter and of its own shade.
fn tufts(x: u32, y: u32) -> Rgba<u8> {
    const ACROSS: f64 = 8.0;
    let (column, row) = (f64::from(x) / f64::from(SIDE) * ACROSS, f64::from(y) / f64::from(SIDE) * ACROSS);
    let shift = if row.floor() as i64 % 2 == 0 { 0.0 } else { 0.5 };
    let along = (column + shift).rem_euclid(ACROSS);
    let chance = |salt: f64| ((along.floor() * 12.9898 + row.floor() * 78.233 + salt).sin() * 43_758.545_3).rem_euclid(1.0);
    let away = (along.fract() - 0.5).hypot(row.fract() - 0.5) / 0.5;
    let height = (1.0 - away).max(0.0).powf(0.7) * (0.6 + 0.4 * chance(0.0));
    mixed([196.0, 150.0, 104.0], [246.0, 226.0, 190.0], chance(3.0), (255.0 * height) as u8)
}

fn mixed(a: [f64; 3], b: [f64; 3], part: f64, alpha: u8) -> Rgba<u8> {
    let [red, green, blue] = [0, 1, 2].map(|k| (a[k] + (b[k] - a[k]) * part) as u8);
    Rgba([red, green, blue, alpha])
}
