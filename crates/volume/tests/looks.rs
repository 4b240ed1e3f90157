//! Hair that lets light through, and hair of more than two colours.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test that cannot go on fails, and says what it measured")]

use pelage_strand::{Bands, GrowSettings, Opacity, Stop, StrandSource, StrandTile, Undercoat, grow};
use pelage_volume::{FinAcross, FinSettings, ShellSettings, sample_fin, sample_shells, srgb_to_linear};

fn leaning() -> StrandTile {
    let hair =
        StrandSource { points: vec![[0.1, 0.5, 0.0], [0.85, 0.5, 1.0]], radii: vec![0.03; 2], root_colour: [0.5; 3], tip_colour: [0.5; 3] };
    StrandTile::from_strands(1.0, &[hair]).unwrap()
}

fn opacity(root: f64, tip: f64) -> Opacity {
    Opacity { root, tip, variation: 0.0 }
}

fn stops(list: &[(f32, f32)]) -> Bands {
    Bands::new(&list.iter().map(|&(along, grey)| Stop { along, colour: [grey; 3] }).collect::<Vec<_>>()).unwrap()
}

const SETTINGS: ShellSettings = ShellSettings {
    layers: 9,
    spacing: pelage_volume::Spacing::Even,
    resolution: 64,
    lateral_sigma: 0.35,
    vertical_core: 0.5,
    vertical_sigma: 0.2,
    skin_colour: [0.0; 3],
    mip_rule: pelage_volume::MipRule::Coverage,
    directions: None,
};

#[test]
fn a_layer_covers_as_much_as_its_hair_is_opaque() {
    let whole = sample_shells(&leaning(), &SETTINGS).unwrap();
    for (root, tip) in [(0.5, 0.5), (1.0, 0.2), (0.0, 1.0)] {
        let faint = sample_shells(&leaning().tinted(Bands::default(), &opacity(root, tip)).unwrap(), &SETTINGS).unwrap();
        for layer in 1..9u32 {
            let wanted = root + (tip - root) * f64::from(layer) / 8.0;
            let ratio = faint.mips[0].mean_coverage(layer) / whole.mips[0].mean_coverage(layer);
            assert!((ratio - wanted).abs() < 0.01, "{root} to {tip}, layer {layer}: {ratio} of {wanted}");
        }
    }
    // Opaque is what it was, byte for byte.
    assert_eq!(sample_shells(&leaning().tinted(Bands::default(), &Opacity::default()).unwrap(), &SETTINGS).unwrap(), whole);
    // Seen through, hair's colour is still its own.
    let faint = sample_shells(&leaning().tinted(Bands::default(), &opacity(0.3, 0.3)).unwrap(), &SETTINGS).unwrap();
    let texel = faint.mips[0].texel(4, 30, 32).unwrap();
    let alpha = f32::from(texel[3]) / 255.0;
    assert!((srgb_to_linear(texel[0]) / alpha - 0.5).abs() < 0.02, "{texel:?}");
}

#[test]
fn a_fin_covers_as_much_as_its_hair_is_opaque() {
    let settings = FinSettings { width: 64, height: 64, slab_width: 1.0, tiles_across: 1, across: FinAcross::S, sigma: 0.3 };
    let whole = sample_fin(&leaning(), &settings).unwrap();
    let faint =
        sample_fin(&leaning().tinted(stops(&[(0.0, 0.1), (0.5, 0.1), (0.5, 0.9)]), &opacity(1.0, 0.2)).unwrap(), &settings).unwrap();
    for row in 8..56u32 {
        let up = 1.0 - (f64::from(row) + 0.5) / 64.0;
        let sum = |fin: &pelage_volume::FinTexture| (0..64).map(|x| f64::from(fin.mips[0].texel(0, x, row).unwrap()[3])).sum::<f64>();
        assert!((sum(&faint) / sum(&whole) - (1.0 - 0.8 * up)).abs() < 0.02, "row {row}");
        let x = (64.0 * (0.1 + 0.75 * up)) as u32;
        let texel = faint.mips[0].texel(0, x, row).unwrap();
        let colour = srgb_to_linear(texel[0]) / (f32::from(texel[3]) / 255.0);
        let wanted = if up < 0.5 { 0.1 } else { 0.9 };
        assert!((up - 0.5).abs() < 0.03 || (colour - wanted).abs() < 0.05, "row {row}: {colour} of {wanted}");
    }
}

/// A layer shows the mean of the bands that it holds; one colour taken at its own height would miss them.
#[test]
fn bands_narrower_than_a_layer_are_averaged() {
    // A dark ring round the very height of layer 4, a tenth of a layer wide: 1/80 of the hair.
    let ring = stops(&[(0.49375, 0.8), (0.49375, 0.0), (0.50625, 0.0), (0.50625, 0.8)]);
    let stack = sample_shells(&leaning().tinted(ring, &Opacity::default()).unwrap(), &SETTINGS).unwrap();
    let grey = |layer: u32| {
        let (mut colour, mut alpha) = (0.0, 0.0);
        for texel in stack.mips[0].texels.chunks_exact(4).skip(layer as usize * 4096).take(4096) {
            colour += f64::from(srgb_to_linear(texel[0]));
            alpha += f64::from(texel[3]) / 255.0;
        }
        colour / alpha
    };
    println!("reached: {:.3} where the mean is 0.72", grey(4));
    assert!((grey(4) - 0.72).abs() < 0.01, "{}", grey(4));
    assert!((grey(2) - 0.8).abs() < 0.01, "{}", grey(2));
}

/// Light through layers of translucent hair, beside what passes the hair itself: less of it, as the book says by how much.
#[test]
fn light_passes_translucent_layers_as_it_does_the_hair() {
    let bare = Undercoat { count: 0, ..Undercoat::default() };
    for (lean, root, tip) in [(22.0, 0.6, 0.6), (22.0, 1.0, 0.2), (22.0, 1.0, 1.0)] {
        let settings = GrowSettings { count: 700, undercoat: bare, lean, opacity: opacity(root, tip), ..GrowSettings::default() };
        let hair = grow(&settings).unwrap();
        let stack = sample_shells(&hair, &ShellSettings { layers: 24, ..ShellSettings::default() }).unwrap();
        for slope in [0.0, 1.0, 3.732] {
            let [layers, truth] = [stack.transmittance(0, [slope, 0.0]), hair.transmittance([slope, 0.0], 512)].map(Option::unwrap);
            println!("reached: opacity {root} to {tip}, slope {slope}: {layers:.3} through layers, {truth:.3} through hair");
            // Along the normal a hair is in several layers at one place, which add up; the more light it lets through the more that counts.
            assert!(truth - layers < 0.22 && layers - truth < 0.08, "opacity {root} to {tip}, slope {slope}: {layers} {truth}");
        }
    }
}
