//! Prints what hair textures take and what making them smaller costs: bytes beside the paper's, compression, one layer, levels of detail, shared images.
//!
//! `cargo run --release -p pelage-volume --example economy`

#![allow(clippy::print_stdout, reason = "an example that prints tables")]

use std::error::Error;

use pelage_strand::{GrowSettings, Style, Undercoat, grow};
use pelage_volume::{FinSettings, OneLayerFit, ShellSettings, ShellStack, Spacing, sample_fin, sample_shells};
use texpresso::{Format, Params};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let hair = grow(&GrowSettings::default())?;
    let stack = sample_shells(&hair, &ShellSettings { directions: Some(1.0), ..ShellSettings::default() })?;
    let fin = sample_fin(&hair, &FinSettings::default())?;
    bytes(&stack, fin.byte_size())?;
    compression(&stack.with_levels()?);
    one_layer()?;
    levels(&stack)?;
    sharing()
}

fn straight() -> GrowSettings {
    let bare = Undercoat { count: 0, ..Undercoat::default() };
    let upright = GrowSettings { style: Style::Straight, lean: 0.0, splay: 0.0, gravity: 0.0, wander: 0.0, ..GrowSettings::default() };
    GrowSettings { separation: 0.0, clump: 0.0, undercoat: bare, ..upright }
}

/// Bytes exactly, beside the paper's figures.
fn bytes(stack: &ShellStack, fin: usize) -> Result<()> {
    let levels = stack.with_levels()?;
    let upright = sample_shells(&grow(&straight())?, &ShellSettings::default())?;
    let one = OneLayerFit::of(&upright)?.stack(&upright);
    println!("bytes: finest mip, all mips, with the fin of {fin}");
    let row = |name: &str, mips: Vec<usize>| {
        println!("{name:>40} {:>9} {:>9} {:>9}", mips[0], mips.iter().sum::<usize>(), mips.iter().sum::<usize>() + fin);
    };
    row("16 × 128², RGBA8 (paper: 1.6 MB)", stack.level_bytes());
    row("in blocks (paper: a third)", stack.compressed().level_bytes());
    row("skin and one layer (paper: 200 KB)", one.level_bytes());
    row("the same in blocks", one.compressed().level_bytes());
    row("16 × 128² with levels of detail", levels.level_bytes());
    row("the same in blocks", levels.compressed().level_bytes());
    row("one layer with levels of detail", one.with_levels()?.level_bytes());
    row(
        "20 × 128² for 60 shells",
        sample_shells(&grow(&straight())?, &ShellSettings { layers: 20, ..ShellSettings::default() })?.level_bytes(),
    );
    println!("{:>40} {:>19}", "direction map of 16 × 128²", stack.direction_bytes());
    println!("{:>40} {:>19}", "the same with levels of detail", levels.direction_bytes());
    Ok(())
}

/// Bytes and errors by mip level, and the thickness of hair with and without correction.
fn compression(stack: &ShellStack) {
    println!(
        "\nBC3 of {} images: bytes, RMS of alpha and of linear colour, largest error of an image's mean coverage; the same by texpresso alone",
        stack.images()
    );
    let small = stack.compressed();
    for ((mip, error), own) in small.mips.iter().zip(small.errors(stack)).zip(&stack.mips) {
        let size = 4 * own.width as usize * own.height as usize;
        let (mut rms, mut worst, mut thicker) = (0.0f64, 0.0f64, 0.0f64);
        for image in own.texels.chunks_exact(size) {
            let (side, mut blocks) = (own.width as usize, vec![0; Format::Bc3.compressed_size(own.width as usize, own.width as usize)]);
            Format::Bc3.compress(image, side, side, Params::default(), &mut blocks);
            let mut back = vec![0; size];
            Format::Bc3.decompress(&blocks, side, side, &mut back);
            let alphas = |texels: &[u8]| texels.iter().skip(3).step_by(4).map(|&alpha| f64::from(alpha)).collect::<Vec<f64>>();
            let (got, wanted) = (alphas(&back), alphas(image));
            rms += got.iter().zip(&wanted).map(|(a, b)| ((a - b) / 255.0).powi(2)).sum::<f64>();
            let off = got.iter().sum::<f64>() / wanted.iter().sum::<f64>().max(1.0) - 1.0;
            worst = worst.max(off.abs());
            thicker += off / f64::from(own.layers);
        }
        let alone = (rms / (own.texels.len() / 4) as f64).sqrt();
        println!(
            "{:>4}² {:>8} {:.4} {:.4} {:.5}   {alone:.4} {worst:.5} (mean {thicker:+.5})",
            mip.width,
            mip.blocks.len(),
            error.alpha_rms,
            error.colour_rms,
            error.coverage
        );
    }
}

/// How far hair of several kinds is from one image.
fn one_layer() -> Result<()> {
    println!(
        "\none layer: unlikeness, RMS and largest error of alpha, of colour; first, middle and last opacity; picture along the normal, RMS"
    );
    let straight = straight();
    let bare = Undercoat { count: 0, ..Undercoat::default() };
    for (name, settings) in [
        ("upright, even", GrowSettings { length_variation: 0.0, tip_thickness: 1.0, ..straight }),
        ("upright, tapered", GrowSettings { length_variation: 0.0, ..straight }),
        ("upright, lengths 0.5 to 1", straight),
        ("splayed by 10°", GrowSettings { splay: 10.0, ..straight }),
        ("leaning by 10°", GrowSettings { lean: 10.0, ..straight }),
        ("leaning by 22°", GrowSettings { lean: 22.0, ..straight }),
        ("wavy, else upright", GrowSettings { style: GrowSettings::default().style, ..straight }),
        ("default guard hairs", GrowSettings { undercoat: bare, ..GrowSettings::default() }),
        ("default coat", GrowSettings::default()),
    ] {
        let stack = sample_shells(&grow(&settings)?, &ShellSettings::default())?;
        let fit = OneLayerFit::of(&stack)?;
        let one = fit.stack(&stack);
        let picture = |stack: &ShellStack, level: usize| stack.seen_at(level, 0, true).unwrap_or_default();
        println!(
            "{name:>26} {:.3}  {:.4} {:.3}  {:.4} {:.3}  {:.2} {:.2} {:.2}  {:.4}",
            fit.unlikeness,
            fit.alpha_rms,
            fit.alpha_largest,
            fit.colour_rms,
            fit.colour_largest,
            fit.ramp[0],
            fit.ramp[7],
            fit.ramp[14],
            rms(&picture(&stack, 0), &picture(&one, 0))
        );
    }
    Ok(())
}

fn rms(a: &[[f32; 4]], b: &[[f32; 4]]) -> f64 {
    let squares = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>();
    (squares / (4 * a.len()).max(1) as f64).sqrt()
}

/// What is seen at each level of detail, along the normal and at 45°, and where it is lit.
fn levels(stack: &ShellStack) -> Result<()> {
    println!(
        "\nlevels of detail of the default coat: shells, picture along the normal against the finest (RMS), transmittance at 45°, where the skin is lit"
    );
    let chain = stack.with_levels()?;
    let finest = chain.seen_at(0, 0, true).unwrap_or_default();
    for level in 0..chain.levels.len() {
        let alone = ShellStack { levels: vec![chain.levels[level].clone()], ..chain.clone() };
        println!(
            "level {level}: {:>2} shells, {:.5}, {:.4}, {:.3}",
            chain.levels[level].len(),
            rms(&chain.seen_at(level, 0, true).unwrap_or_default(), &finest),
            alone.transmittance(0, [1.0, 0.0]).unwrap_or(f64::NAN),
            chain.levels[level][0].light_height
        );
    }
    Ok(())
}

/// 20 images shown by more and fewer shells, beside hair sampled anew.
fn sharing() -> Result<()> {
    println!("\n20 layers of 400 guard hairs shown by more or fewer shells, and as many sampled anew: transmittance at 0° and 45°, bytes");
    let hair = grow(&GrowSettings { count: 400, undercoat: Undercoat { count: 0, ..Undercoat::default() }, ..GrowSettings::default() })?;
    let stack = sample_shells(&hair, &ShellSettings { layers: 20, ..ShellSettings::default() })?;
    let through = |stack: &ShellStack| [0.0, 1.0].map(|slope| stack.transmittance(0, [slope, 0.0]).unwrap_or(f64::NAN));
    for (name, spacing) in [("even", Spacing::Even), ("power 1.5", Spacing::Power(1.5)), ("exponential 1", Spacing::Exponential(1.0))] {
        for shells in [10, 20, 40, 60] {
            let shared = stack.shared(shells, spacing)?;
            let anew = sample_shells(&hair, &ShellSettings { layers: shells, spacing, ..ShellSettings::default() })?;
            let ([a, b], [c, d]) = (through(&shared), through(&anew));
            println!("{name:>14} {shells:>3}: {a:.4} {b:.4} {:>8}   anew {c:.4} {d:.4} {:>8}", shared.byte_size(), anew.byte_size());
        }
    }
    Ok(())
}
