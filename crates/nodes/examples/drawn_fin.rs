//! Draws the fin picture of the graphs: tufts of curved blades, as somebody might draw them.
//!
//! `cargo run -p pelage-nodes --example drawn_fin -- graphs/images/fin.png`
#![allow(clippy::print_stderr, reason = "an example for a terminal")]

use image::{Rgba, RgbaImage};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const WIDTH: u32 = 256;
const HEIGHT: u32 = 64;
/// Samples along a pixel's side.
const FINE: u32 = 4;

/// A blade from its root, at the bottom, to its tip; places across in widths of the picture.
struct Blade {
    root: f64,
    lean: f64,
    curl: f64,
    length: f64,
    width: f64,
    colour: [f64; 3],
}

impl Blade {
    fn random(dice: &mut Pcg64Mcg) -> Self {
        let mut between = |low: f64, high: f64| low + (high - low) * dice.random::<f64>();
        let shade = between(0.55, 1.0);
        Self {
            root: between(0.0, 1.0),
            lean: between(-0.02, 0.05),
            curl: between(0.0, 0.05),
            length: between(0.45, 1.0),
            width: between(0.003, 0.006),
            colour: [0.95 * shade, 0.82 * shade, 0.6 * shade],
        }
    }

    /// Whether it covers a place `x` across and `y` up; the picture repeats across.
    fn covers(&self, x: f64, y: f64) -> bool {
        let up = y / self.length;
        let apart = x - self.root - self.lean * up - self.curl * up * up * up;
        up <= 1.0 && (apart - apart.round()).abs() <= self.width * (1.0 - 0.85 * up)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage: drawn_fin OUT.png");
        std::process::exit(2);
    };
    let mut dice = Pcg64Mcg::seed_from_u64(5);
    let blades: Vec<Blade> = (0..90).map(|_| Blade::random(&mut dice)).collect();
    Ok(RgbaImage::from_fn(WIDTH, HEIGHT, |column, row| pixel(&blades, column, row)).save(path)?)
}

/// The mean of a pixel's samples, alpha straight.
fn pixel(blades: &[Blade], column: u32, row: u32) -> Rgba<u8> {
    let (mut sum, mut covered) = ([0.0; 3], 0.0);
    for sample in 0..FINE * FINE {
        let x = (f64::from(column * FINE + sample % FINE) + 0.5) / f64::from(WIDTH * FINE);
        let y = 1.0 - (f64::from(row * FINE + sample / FINE) + 0.5) / f64::from(HEIGHT * FINE);
        if let Some(blade) = blades.iter().rev().find(|blade| blade.covers(x, y)) {
            // Darker at the roots.
            let light = 0.45 + 0.55 * y;
            sum = [0, 1, 2].map(|c| sum[c] + blade.colour[c] * light);
            covered += 1.0;
        }
    }
    let byte = |value: f64| (255.0 * value.clamp(0.0, 1.0)).round() as u8;
    let [r, g, b] = sum.map(|c| if covered > 0.0 { byte(c / covered) } else { 0 });
    Rgba([r, g, b, byte(covered / f64::from(FINE * FINE))])
}
