//! Compares two PNG files of one size: `cargo run -p pelage-accuracy --example compare -- reference.png test.png heat.png`.
//!
//! Without arguments it compares a drawn disc with the same disc moved by one pixel.
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use image::RgbImage;
use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, Image, dilate, flip, heat_picture, rmse_linear, union, unlike_background};

const BACKGROUND: [u8; 3] = [24, 24, 32];

fn main() -> Result<(), Box<dyn Error>> {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let (reference, test) = match paths.as_slice() {
        [reference, test, ..] => (image::open(reference)?.into_rgb8(), image::open(test)?.into_rgb8()),
        _ => (disc(60.0), disc(61.0)),
    };
    let (first, second) = (borrow(&reference)?, borrow(&test)?);

    let subject = union(&unlike_background(first, BACKGROUND, 0), &unlike_background(second, BACKGROUND, 0))?;
    let mask = dilate(&subject, first.width(), first.height(), 2)?;
    let report = flip(first, second, Some(&mask), DEFAULT_PIXELS_PER_DEGREE)?;
    println!("FLIP over {} pixels: mean {:.4}, 99th percentile {:.4}, max {:.4}", report.pixels, report.mean, report.p99, report.max);
    println!("RMSE of linear light: {:.4}", rmse_linear(first, second, Some(&mask))?);

    if let [_, _, heat] = paths.as_slice() {
        let rgb = heat_picture(&report.map, Some(&mask))?;
        image::save_buffer(heat, &rgb, first.width(), first.height(), image::ExtendedColorType::Rgb8)?;
        println!("where they differ: {heat}");
    }
    Ok(())
}

fn borrow(image: &RgbImage) -> Result<Image<'_>, Box<dyn Error>> {
    Ok(Image::new(image.width(), image.height(), image.as_raw())?)
}

/// A lit disc of radius 40 about `centre` columns.
fn disc(centre: f64) -> RgbImage {
    RgbImage::from_fn(128, 128, |x, y| {
        let inside = (f64::from(x) - centre).hypot(f64::from(y) - 64.0) < 40.0;
        image::Rgb(if inside { [200, 150 - (y / 2) as u8, 90] } else { BACKGROUND })
    })
}
