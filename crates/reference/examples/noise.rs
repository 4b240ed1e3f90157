//! How far the noise of a picture falls with rays a pixel: a furry ball from near, against 2,048 other rays a pixel, as a table in Markdown.
//!
//! `cargo run --release -p pelage-reference --example noise`
#![allow(clippy::print_stdout, reason = "an example prints")]

mod common;

use pelage_reference::{Image, Laying, Scene, Settings, Shadows, View, quiet};
use pelage_strand::{GrowSettings, Undercoat, grow};

const SAMPLES: [u32; 5] = [1, 4, 16, 64, 256];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let coat = common::ball(24, 2.0);
    let tile = grow(&GrowSettings { count: 500, undercoat: Undercoat { count: 300, ..Undercoat::default() }, ..GrowSettings::default() })?;
    let scene = Scene::new(&coat, &tile, &Laying::default())?;
    let whole = common::view(&coat, 1.0);
    // The middle of the ball alone, so that every pixel is fur.
    let view = View { camera: pelage_coat::Camera { field_of_view: 0.3 * whole.camera.field_of_view, ..whole.camera }, ..whole };
    println!("| rays a pixel | {} |", SAMPLES.map(|samples| samples.to_string()).join(" | "));
    println!("|---|{}", "---|".repeat(SAMPLES.len()));
    for (name, shadows) in [("depth by formula", Shadows::Formula), ("shadows by rays", Shadows::Rays)] {
        let image = |samples, seed| scene.render(&view, &Settings { size: (24, 24), samples, seed, shadows }, &quiet);
        let truth = image(2048, 99)?;
        let mut cells = Vec::new();
        for samples in SAMPLES {
            cells.push(format!("{:.4}", rmse(&image(samples, 7)?, &truth)));
        }
        println!("| {name} | {} |", cells.join(" | "));
    }
    Ok(())
}

/// The root mean square of what two pictures differ by, over all pixels and colours.
fn rmse(one: &Image, other: &Image) -> f64 {
    let squares = one.pixels.iter().zip(&other.pixels).flat_map(|(a, b)| (0..3).map(move |c| f64::from(a[c] - b[c]).powi(2)));
    (squares.sum::<f64>() / (3 * one.pixels.len()) as f64).sqrt()
}
