//! A coat keeps its opacity and its mean colour at every level of detail (L16).
#![allow(clippy::print_stdout, reason = "how much each level keeps")]

use pelage_nodes::Picture;
use pelage_tests::{Error, Scene};

/// Linear red, green and blue, the mean over the pixels that both pictures cover.
fn mean_colour(picture: &Picture, other: &Picture) -> [f64; 3] {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for (pixel, covered) in picture.rgba.chunks_exact(4).zip(picture.coverage.iter().zip(&other.coverage)) {
        if *covered.0 == 255 && *covered.1 == 255 {
            sum = [0, 1, 2].map(|c| sum[c] + linear(pixel[c]));
            count += 1.0;
        }
    }
    sum.map(|c| c / count)
}

fn linear(byte: u8) -> f64 {
    let c = f64::from(byte) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

fn mean_coverage(picture: &Picture) -> f64 {
    picture.coverage.iter().map(|&c| f64::from(c)).sum::<f64>() / (255.0 * picture.coverage.len() as f64)
}

#[test]
fn every_level_keeps_opacity_and_mean_colour() -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let mut at = |level: &str| Scene::evaluate_with(&mut evaluator, "figure4", &[("picture.detail", level)])?.picture();
    let finest = at("Level(level: 0.0)")?;
    // The outer half of a shell's spacing goes with each level, and with the last all of the fur's height.
    for (level, colour_bound, coverage_bound) in [("1.0", 0.01, 0.01), ("2.0", 0.02, 0.01), ("3.0", 0.03, 0.02), ("4.0", 0.08, 0.14)] {
        let coarse = at(&format!("Level(level: {level})"))?;
        let (was, is) = (mean_colour(&finest, &coarse), mean_colour(&coarse, &finest));
        let colour = was.iter().zip(is).map(|(was, is)| (is / was - 1.0).abs()).fold(0.0, f64::max);
        let coverage = (mean_coverage(&coarse) / mean_coverage(&finest) - 1.0).abs();
        println!("level {level}: colour off by {:.1} %, coverage by {:.1} %", 100.0 * colour, 100.0 * coverage);
        assert!(colour < colour_bound && coverage < coverage_bound, "level {level}: colour {colour}, coverage {coverage}");
    }
    Ok(())
}
