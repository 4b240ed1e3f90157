//! Prints how far each layer's coverage is from the many-sample truth, its mean by resolution, what mips do to the picture, and transmittance over the layer
//! count beside the strands' own.
//!
//! `cargo run --release -p pelage-volume --example coverage_error`

#![allow(clippy::print_stdout, reason = "an example that prints tables")]

#[path = "../tests/common/exact.rs"]
mod exact;

use exact::ExactLayer;
use pelage_strand::{GrowSettings, StrandTile, Undercoat, grow};
use pelage_volume::{MipRule, ShellSettings, ShellStack, layers_for, sample_shells, srgb_to_linear};
use rayon::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    coverage_table()?;
    resolution_table()?;
    mip_table()?;
    layer_table()
}

/// A few hairs, so that the sampling is measured and not the rule by which hairs combine; then the whole coat, so that it is. Every layer, each at 32 to 512.
fn coverage_table() -> Result<(), Box<dyn std::error::Error>> {
    const RESOLUTIONS: [u32; 5] = [32, 64, 128, 256, 512];
    let few = GrowSettings { count: 12, undercoat: Undercoat { count: 0, ..Undercoat::default() }, ..GrowSettings::default() };
    for (settings, texels) in [(few, 400), (GrowSettings::default(), 100)] {
        let hair = grow(&settings)?;
        println!(
            "{} hairs: coverage of a layer against 512 samples a texel, at most {texels} texels that hair touches; RMS and mean error",
            hair.strand_count()
        );
        println!("layer{}", RESOLUTIONS.map(|resolution| format!("{resolution:>17}")).join(""));
        let stacks = RESOLUTIONS.map(|resolution| sample_shells(&hair, &ShellSettings { resolution, ..ShellSettings::default() }));
        for layer in 1..16 {
            print!("{layer:>5}");
            for shells in stacks.iter().flatten() {
                let (rms, mean) = layer_error(&hair, shells, layer, texels);
                print!("{rms:>9.4}{mean:>+8.4}");
            }
            println!();
        }
    }
    Ok(())
}

fn layer_error(hair: &StrandTile, shells: &ShellStack, layer: u32, texels: usize) -> (f64, f64) {
    let settings = ShellSettings::default();
    let spacing = hair.height() / f64::from(shells.layers() - 1);
    let exact = ExactLayer {
        height: spacing * f64::from(layer),
        core: spacing * settings.vertical_core,
        vertical: spacing * settings.vertical_sigma,
        resolution: shells.resolution(),
        lateral: settings.lateral_sigma,
    };
    let side = shells.resolution();
    let alpha = |x: u32, y: u32| shells.mips[0].texel(layer, x, y).map_or(0.0, |t| f64::from(t[3]) / 255.0);
    let touched: Vec<(u32, u32)> = (0..side * side).map(|i| (i % side, i / side)).filter(|&(x, y)| alpha(x, y) > 0.0).collect();
    let stride = (touched.len() / texels).max(1);
    let errors: Vec<f64> = touched.par_iter().step_by(stride).map(|&(x, y)| alpha(x, y) - exact.coverage(hair, x, y, 512)).collect();
    let count = errors.len().max(1) as f64;
    ((errors.iter().map(|e| e * e).sum::<f64>() / count).sqrt(), errors.iter().sum::<f64>() / count)
}

/// Transmittance and picture of each level beside those of the full resolution.
fn mip_table() -> Result<(), Box<dyn std::error::Error>> {
    let bare = Undercoat { count: 0, ..Undercoat::default() };
    let upright = GrowSettings { lean: 0.0, splay: 4.0, gravity: 0.0, wander: 0.1, clump: 0.0, undercoat: bare, ..GrowSettings::default() };
    println!(
        "\nmips: picture along the normal against the averaged full picture (RMS in linear light), transmittance at 0°, 45°, 75°, mean light with roots darkened"
    );
    for (name, settings) in [("coat", GrowSettings::default()), ("open", GrowSettings { count: 400, ..upright }), ("upright", upright)] {
        let hair = grow(&settings)?;
        for mip_rule in [MipRule::Coverage, MipRule::Transmittance] {
            let shells = sample_shells(&hair, &ShellSettings { mip_rule, ..ShellSettings::default() })?;
            for level in 0..shells.mips.len() {
                let through = [0.0, 1.0, 3.732].map(|slope| shells.transmittance(level, [slope, 0.0]).unwrap_or(f64::NAN));
                let error = picture_error(&shells, level);
                let light = [0.0, 1.0, 3.732].map(|slope| shaded_light(&shells, level, slope));
                println!(
                    "{name:>8} {mip_rule:?} level {level}: picture {error:.4}, transmittance {:.4} {:.4} {:.4}, light {:.4} {:.4} {:.4}",
                    through[0], through[1], through[2], light[0], light[1], light[2]
                );
            }
        }
    }
    Ok(())
}

/// Mean green light along a slope, layers lit from a quarter at the skin to one at the tips, as a self-shadow does: what tells distance from nearness.
fn shaded_light(shells: &ShellStack, level: usize, slope: f64) -> f64 {
    let mip = &shells.mips[level];
    let mut light = vec![0.0f64; (mip.width * mip.height) as usize];
    for layer in 0..shells.layers() {
        let up = f64::from(layer) / f64::from((shells.layers() - 1).max(1));
        let shift = (slope * shells.height * up * f64::from(mip.width)).round() as u32;
        for (index, below) in (0u32..).zip(&mut light) {
            let texel = mip.texel(layer, (index % mip.width + shift) % mip.width, index / mip.width).unwrap_or_default();
            let own = f64::from(srgb_to_linear(texel[1])) * (0.25 + 0.75 * up);
            *below = own + *below * (1.0 - f64::from(texel[3]) / 255.0);
        }
    }
    light.iter().sum::<f64>() / light.len().max(1) as f64
}

fn picture_error(shells: &ShellStack, level: usize) -> f64 {
    let full = shells.seen_from_above(0, true).unwrap_or_default();
    let small = shells.seen_from_above(level, true).unwrap_or_default();
    let (side, small_side) = (shells.resolution() as usize, (shells.resolution() as usize >> level).max(1));
    let step = side / small_side;
    let mut sum = 0.0;
    for (index, texel) in small.iter().enumerate() {
        let (x, y) = (index % small_side, index / small_side);
        for channel in 0..3 {
            let block = (0..step * step).map(|i| f64::from(full[(y * step + i / step) * side + x * step + i % step][channel]));
            let mean = block.sum::<f64>() / (step * step) as f64;
            sum += (mean - f64::from(texel[channel])).powi(2);
        }
    }
    (sum / (3 * small.len()) as f64).sqrt()
}

/// The same hair in more layers, beside what the strands themselves let through.
fn layer_table() -> Result<(), Box<dyn std::error::Error>> {
    println!("\ntransmittance at 0°, 45° and 75° of the strands, and of stacks of more and more layers of 128²");
    let bare = Undercoat { count: 0, ..Undercoat::default() };
    let coat = GrowSettings::default();
    let slopes = [0.0, 1.0, 75f64.to_radians().tan()];
    for (name, settings) in [
        ("coat", coat),
        ("guards", GrowSettings { undercoat: bare, ..coat }),
        ("400", GrowSettings { count: 400, undercoat: bare, ..coat }),
        ("sparse", GrowSettings { count: 150, undercoat: bare, ..coat }),
        ("thin", GrowSettings { count: 4000, thickness: 0.002, undercoat: bare, ..coat }),
    ] {
        let hair = grow(&settings)?;
        let through = slopes.map(|slope| hair.transmittance([slope, 0.0], 1024).unwrap_or(f64::NAN));
        let wanted = [1, 2].map(|angle| layers_for(&hair, slopes[angle]));
        println!(
            "{name:>8}    strands: {:.4}, {:.4}, {:.4}; sections meet from {} layers at 45°, {} at 75°",
            through[0], through[1], through[2], wanted[0], wanted[1]
        );
        for layers in [8, 16, 32, 64, 128, 256] {
            let shells = sample_shells(&hair, &ShellSettings { layers, ..ShellSettings::default() })?;
            let through = slopes.map(|slope| shells.transmittance(0, [slope, 0.0]).unwrap_or(f64::NAN));
            println!("{name:>8} {layers:>3} layers: {:.4}, {:.4}, {:.4}", through[0], through[1], through[2]);
        }
    }
    Ok(())
}

/// A layer's mean coverage at every resolution.
fn resolution_table() -> Result<(), Box<dyn std::error::Error>> {
    println!("\nmean coverage of layers 2, 8 and 14 of 16 by resolution");
    let bare = Undercoat { count: 0, ..Undercoat::default() };
    let thin = |thickness: f64| GrowSettings { count: 1000, thickness, undercoat: bare, ..GrowSettings::default() };
    for (name, settings) in
        [("coat", GrowSettings::default()), ("0.01 texel of 32", thin(0.01 / 32.0)), ("0.001 texel of 32", thin(0.001 / 32.0))]
    {
        let hair = grow(&settings)?;
        for resolution in [32, 64, 128, 256, 512] {
            let shells = sample_shells(&hair, &ShellSettings { resolution, ..ShellSettings::default() })?;
            let covered = [2, 8, 14].map(|layer| format!("{:.6}", shells.mips[0].mean_coverage(layer))).join(" ");
            println!("{name:>18} {resolution:>4}: {covered}");
        }
    }
    Ok(())
}
