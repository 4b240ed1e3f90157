//! Contact sheets to look at: single layers, the coat from above and the fin, for several kinds of hair.
//!
//! `cargo run --release -p pelage-volume --example sheet -- FOLDER`

#![allow(clippy::print_stdout, reason = "an example that says where its pictures are")]

use image::{Rgb, RgbImage};
use pelage_strand::{GrowSettings, Style, Undercoat, grow};
use pelage_volume::{FinSettings, FinTexture, ShellSettings, ShellStack, linear_to_srgb, sample_fin, sample_shells, srgb_to_linear};
use std::path::PathBuf;

const GREY: f32 = 0.2;
const SIDE: u32 = 256;
const GAP: u32 = 8;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".into()));
    std::fs::create_dir_all(&folder)?;
    let bare = Undercoat { count: 0, ..Undercoat::default() };
    let bunny = GrowSettings::default();
    let kinds = [
        ("bunny", bunny),
        ("straight", GrowSettings { style: Style::Straight, lean: 0.0, wander: 0.1, clump: 0.0, gravity: 0.0, ..bunny }),
        ("curly", GrowSettings { style: Style::Curly { radius: 0.08571, turns: 2.0 }, lean: 10.0, steps: 40, ..bunny }),
        ("sparse", GrowSettings { count: 150, undercoat: bare, ..bunny }),
        ("dense", GrowSettings { count: 2500, thickness: 0.008, undercoat: Undercoat { count: 5000, ..bunny.undercoat }, ..bunny }),
        ("long", GrowSettings { height: 0.9, lean: 40.0, clump: 0.6, ..bunny }),
    ];
    for (name, settings) in kinds {
        let hair = grow(&settings)?;
        let shells = sample_shells(&hair, &ShellSettings::default())?;
        let fin = sample_fin(&hair, &FinSettings::default())?;
        let path = folder.join(format!("{name}.png"));
        sheet(&shells, &fin).save(&path)?;
        let cover: Vec<String> = (0..shells.layers()).map(|k| format!("{:.2}", shells.mips[0].mean_coverage(k))).collect();
        println!("{}: {} strands, height {:.3}, coverage {}", path.display(), hair.strand_count(), hair.height(), cover.join(" "));
        for (angle, slope) in [(0, 0.0), (45, 1.0), (75, 3.732)] {
            let along = [[slope, 0.0], [0.0, slope], [0.0, -slope]].map(|s| shells.transmittance(0, s).unwrap_or(f64::NAN));
            println!("  transmittance at {angle}°: {:.4} {:.4} {:.4}", along[0], along[1], along[2]);
        }
    }
    Ok(())
}

/// Two by two tiles of five layers, three views from above (flat, with dark roots, from afar) and the fin.
fn sheet(shells: &ShellStack, fin: &FinTexture) -> RgbImage {
    let width = 5 * (SIDE + GAP) + GAP;
    let mut picture = RgbImage::from_pixel(width.max(1024 + 2 * GAP), 2 * (SIDE + GAP) + 128 * 2 + 3 * GAP, Rgb([90, 90, 90]));
    for (column, part) in [0, 3, 7, 11, 15].into_iter().enumerate() {
        let layer = (part * (shells.layers() - 1) / 15).min(shells.layers() - 1);
        let x = GAP + column as u32 * (SIDE + GAP);
        paste(&mut picture, x, GAP, |u, v| layer_over_grey(shells, layer, u, v));
    }
    let flat = shells.seen_from_above(0, true).unwrap_or_default();
    let dark = shaded(shells, 0);
    let row = 2 * GAP + SIDE;
    let side = shells.resolution();
    let pick = |from: &[[f32; 4]], side: u32, u: u32, v: u32| from[((v % side) * side + u % side) as usize];
    paste(&mut picture, GAP, row, |u, v| rgb(pick(&flat, side, u, v)));
    paste(&mut picture, 2 * GAP + SIDE, row, |u, v| rgb(pick(&dark, side, u, v)));
    for (column, level) in [1u32, 2, 3].into_iter().enumerate() {
        let far = shaded(shells, level as usize);
        let small = (side >> level).max(1);
        paste(&mut picture, GAP + (2 + column as u32) * (SIDE + GAP), row, |u, v| rgb(pick(&far, small, u, v)));
    }
    let mip = &fin.mips[0];
    for v in 0..mip.height * 2 {
        for u in 0..mip.width * 2 {
            let texel = mip.texel(0, u / 2, v / 2).unwrap_or_default();
            picture.put_pixel(GAP + u, row + SIDE + GAP + v, over_grey(texel));
        }
    }
    // The fin as the graphics card draws it on a silhouette of 128 pixels: the second level.
    let mip = &fin.mips[1];
    for v in 0..mip.height {
        for u in 0..mip.width * 4 {
            let texel = mip.texel(0, u % mip.width, v).unwrap_or_default();
            picture.put_pixel(GAP + u, row + SIDE + 2 * GAP + 128 + v, over_grey(texel));
        }
    }
    picture
}

/// The stack from above with roots darkened roughly as a renderer's self-shadow does.
fn shaded(shells: &ShellStack, level: usize) -> Vec<[f32; 4]> {
    let mip = &shells.mips[level];
    let size = (mip.width * mip.height) as usize;
    let mut picture = vec![[0.0f32; 4]; size];
    for layer in 0..shells.layers() {
        let up = layer as f32 / (shells.layers() - 1).max(1) as f32;
        let light = 0.25 + 0.75 * up;
        for (index, below) in picture.iter_mut().enumerate() {
            let t = mip.texel(layer, index as u32 % mip.width, index as u32 / mip.width).unwrap_or_default();
            let alpha = f32::from(t[3]) / 255.0;
            for channel in 0..3 {
                below[channel] = srgb_to_linear(t[channel]) * light + below[channel] * (1.0 - alpha);
            }
        }
    }
    picture
}

fn paste(picture: &mut RgbImage, x: u32, y: u32, texel: impl Fn(u32, u32) -> Rgb<u8>) {
    (0..SIDE).for_each(|v| (0..SIDE).for_each(|u| picture.put_pixel(x + u, y + v, texel(u, v))));
}

fn layer_over_grey(shells: &ShellStack, layer: u32, u: u32, v: u32) -> Rgb<u8> {
    let side = shells.resolution();
    over_grey(shells.mips[0].texel(layer, u % side, v % side).unwrap_or_default())
}

fn over_grey(texel: [u8; 4]) -> Rgb<u8> {
    let alpha = f32::from(texel[3]) / 255.0;
    Rgb([0, 1, 2].map(|c| linear_to_srgb(srgb_to_linear(texel[c]) + GREY * (1.0 - alpha))))
}

fn rgb(linear: [f32; 4]) -> Rgb<u8> {
    Rgb([linear[0], linear[1], linear[2]].map(linear_to_srgb))
}
