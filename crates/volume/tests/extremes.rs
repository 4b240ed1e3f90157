//! The rows "Gaussian sampling", "Toroidal tile" and "Shells" of the numbers at their extremes, as a stack's user sees them.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test that cannot go on fails, and says what it measured")]

use pelage_strand::{GrowSettings, StrandSource, StrandTile, Style, Undercoat, grow};
use pelage_volume::{FinSettings, ShellSettings, ShellStack, VolumeError, layers_for, sample_fin, sample_shells};
use std::f64::consts::PI;

fn bare() -> Undercoat {
    Undercoat { count: 0, ..Undercoat::default() }
}

fn sampled(tile: &StrandTile, layers: u32, resolution: u32) -> ShellStack {
    sample_shells(tile, &ShellSettings { layers, resolution, ..ShellSettings::default() }).unwrap()
}

fn alpha(stack: &ShellStack, layer: u32, x: u32, y: u32) -> f64 {
    f64::from(stack.mips[0].texel(layer, x, y).unwrap()[3]) / 255.0
}

/// The same strands, moved over the torus.
fn shifted(tile: &StrandTile, by: [f64; 2]) -> StrandTile {
    let sources: Vec<StrandSource> = tile
        .strands()
        .map(|s| StrandSource {
            points: s.points.iter().map(|p| [f64::from(p[0]) + by[0], f64::from(p[1]) + by[1], f64::from(p[2])]).collect(),
            radii: s.radii.iter().map(|&r| f64::from(r)).collect(),
            root_colour: s.root_colour,
            tip_colour: s.tip_colour,
        })
        .collect();
    StrandTile::from_strands(tile.height(), &sources).unwrap()
}

/// Upright hair without taper, all of one height and thickness but for what is drawn.
fn upright(count: u32, thickness: f64) -> StrandTile {
    let straight = GrowSettings {
        style: Style::Straight,
        lean: 0.0,
        splay: 0.0,
        gravity: 0.0,
        wander: 0.0,
        separation: 0.0,
        clump: 0.0,
        ..GrowSettings::default()
    };
    grow(&GrowSettings { count, thickness, length_variation: 0.0, tip_thickness: 1.0, undercoat: bare(), ..straight }).unwrap()
}

#[test]
fn gaussian_sampling_covers_what_thin_hair_covers_at_every_resolution() {
    let mut most = 0.0_f64;
    // From three texels down to a thousandth of one at 32: a layer's mean is the sections' area. The second kind leans, waves and tapers.
    for thickness in [0.003, 0.01 / 32.0, 0.001 / 32.0] {
        let tile = upright(800, thickness);
        let section: f64 = tile.strands().map(|s| PI * f64::from(s.radii[0]).powi(2)).sum();
        // Hairs overlap where they stand dense; 2 % of the tile hides at most 1 % of itself.
        assert!(section < 0.025);
        let wavy = grow(&GrowSettings { count: 200, thickness, undercoat: bare(), ..GrowSettings::default() }).unwrap();
        let finest = sampled(&wavy, 16, 512);
        for resolution in [32, 128, 512] {
            // A layer's bytes keep its sum to a step.
            let step = 1.0 / (255.0 * f64::from(resolution * resolution));
            let (straight, bent) = (sampled(&tile, 16, resolution), sampled(&wavy, 16, resolution));
            for layer in [1, 8, 14] {
                let covered = straight.mips[0].mean_coverage(layer);
                assert!(
                    (covered - section).abs() < 0.01 * section + step,
                    "{thickness} at {resolution}, layer {layer}: {covered} of {section}"
                );
                most = most.max(((covered - section).abs() - step) / section);
                let (covered, wanted) = (bent.mips[0].mean_coverage(layer), finest.mips[0].mean_coverage(layer));
                assert!(
                    (covered - wanted).abs() < 0.01 * wanted + step,
                    "{thickness} at {resolution}, layer {layer}: {covered} of {wanted}"
                );
                most = most.max(((covered - wanted).abs() - step) / wanted);
            }
        }
    }
    println!("reached: coverage within {:.2} % beside a byte's step", 100.0 * most);
}

#[test]
fn toroidal_tile_moved_by_whole_tiles_is_the_same_hair() {
    let tile = grow(&GrowSettings { count: 150, undercoat: bare(), ..GrowSettings::default() }).unwrap();
    let home = sampled(&tile, 16, 64);
    let mut other = 0;
    for tiles in [[1, -1], [-1, 1], [-1, 0], [1000, -1000], [-1000, 1000]] {
        assert_eq!(home, sampled(&tile.moved(tiles), 16, 64));
        // Given in the plane as one number, a place loses what f64 cannot hold: far less than a byte's step.
        let away = sampled(&shifted(&tile, tiles.map(f64::from)), 16, 64);
        assert!(home.mips[0].texels.iter().zip(&away.mips[0].texels).all(|(a, b)| a.abs_diff(*b) <= 1));
        other += home.mips[0].texels.iter().zip(&away.mips[0].texels).filter(|(a, b)| a != b).count();
    }
    println!("reached: the same bits; given as one number, {other} of {} bytes are a step off", 5 * home.mips[0].texels.len());
}

#[test]
fn toroidal_tile_is_the_same_hair_wherever_its_border_runs() {
    let tile = grow(&GrowSettings { count: 150, undercoat: bare(), ..GrowSettings::default() }).unwrap();
    let home = sampled(&tile, 16, 64);
    let moved = sampled(&shifted(&tile, [27.0 / 64.0, 50.0 / 64.0]), 16, 64);
    let mut most = 0.0_f64;
    for layer in 1..16 {
        for i in 0..64 * 64 {
            let (x, y) = (i % 64, i / 64);
            let difference = alpha(&home, layer, x, y) - alpha(&moved, layer, (x + 27) % 64, (y + 50) % 64);
            assert!(difference.abs() < 2.5 / 255.0, "layer {layer} at {x}, {y}: {difference}");
            most = most.max(255.0 * difference.abs());
        }
    }
    println!("reached: {most:.0} steps");
}

#[test]
fn toroidal_tile_has_a_seam_that_cannot_be_told_from_the_middle() {
    // The mean step from texel to texel over each line of the tile, over several seeds: the line that is the border is like any other.
    let mut steps = [[0.0f64; 64]; 2];
    for seed in 0..6 {
        let tile = grow(&GrowSettings { seed, ..GrowSettings::default() }).unwrap();
        let stack = sample_shells(&tile, &ShellSettings { resolution: 64, ..ShellSettings::default() }).unwrap();
        for layer in 1..16 {
            for i in 0..64 * 64 {
                let (x, y) = (i % 64, i / 64);
                let here = alpha(&stack, layer, x, y);
                steps[0][x as usize] += (here - alpha(&stack, layer, (x + 1) % 64, y)).abs();
                steps[1][y as usize] += (here - alpha(&stack, layer, x, (y + 1) % 64)).abs();
            }
        }
    }
    let mut most = 0.0_f64;
    for lines in steps {
        let mean = lines[..63].iter().sum::<f64>() / 63.0;
        let deviation = (lines[..63].iter().map(|s| (s - mean).powi(2)).sum::<f64>() / 63.0).sqrt();
        assert!((lines[63] - mean).abs() < 3.0 * deviation, "{} against {mean} ± {deviation}", lines[63]);
        most = most.max((lines[63] - mean).abs() / deviation);
    }
    println!("reached: {most:.1} deviations of all lines");
}

#[test]
fn shells_of_one_layer_are_the_skin() {
    let one = sampled(&grow(&GrowSettings::default()).unwrap(), 1, 64);
    assert!(one.layers() == 1 && (one.mips[0].mean_coverage(0) - 1.0).abs() < 1e-12);
    assert_eq!(one.transmittance(0, [0.0, 0.0]), Some(1.0));
}

/// The slopes of 0°, 45° and 75°.
fn slopes() -> [[f64; 2]; 3] {
    [[0.0, 0.0], [1.0, 0.0], [75f64.to_radians().tan(), 0.0]]
}

#[test]
fn shells_pass_as_much_light_in_any_number_of_layers_where_hair_is_close() {
    // The edge of the domain: guard hairs alone, whose strands themselves let just under 2 % through along the normal. What is closer is kept better.
    let open = grow(&GrowSettings { count: 1500, undercoat: bare(), ..GrowSettings::default() }).unwrap();
    let closed = grow(&GrowSettings::default()).unwrap();
    let mut reached = Vec::new();
    for (tile, limit, layers) in [(&open, 0.02, vec![8, 16, 64, 256]), (&closed, 0.004, vec![8, 48])] {
        let (mut spread, mut off) = (0.0_f64, 0.0_f64);
        let strands = slopes().map(|slope| tile.transmittance(slope, 256).unwrap());
        assert!(strands[0] < 0.02, "{strands:?}");
        let through = |&layers: &u32| {
            let stack = sampled(tile, layers, 128);
            slopes().map(|slope| stack.transmittance(0, slope).unwrap())
        };
        let counts: Vec<[f64; 3]> = layers.iter().map(through).collect();
        for angle in 0..3 {
            let all: Vec<f64> = counts.iter().map(|kept| kept[angle]).collect();
            let (least, most) = (all.iter().copied().fold(1.0, f64::min), all.iter().copied().fold(0.0, f64::max));
            assert!(most - least < limit, "{all:?} at angle {angle}");
            assert!((least - strands[angle]).abs().max((most - strands[angle]).abs()) < 0.02, "{all:?} of {}", strands[angle]);
            (spread, off) = (spread.max(most - least), off.max((least - strands[angle]).abs()).max((most - strands[angle]).abs()));
        }
        reached.push(format!("{spread:.4} among layer counts and {off:.3} from the strands"));
    }
    println!("reached: guard hairs alone {}; with undercoat {}", reached[0], reached[1]);
}

#[test]
fn shells_of_upright_open_hair_show_it_once_however_many_layers() {
    // The share that stands under hair is seen once, but for the texels at its edge: the finer they are the less those come to.
    let open = grow(&GrowSettings { count: 150, lean: 0.0, undercoat: bare(), ..GrowSettings::default() }).unwrap();
    let wanted = open.transmittance([0.0, 0.0], 512).unwrap();
    let mut most = 0.0_f64;
    for layers in [8, 16, 32, 64] {
        let clear = sampled(&open, layers, 512).transmittance(0, [0.0, 0.0]).unwrap();
        assert!((clear - wanted).abs() < 0.02, "{layers} layers: {clear} of {wanted}");
        most = most.max((clear - wanted).abs());
    }
    println!("reached: {most:.3} from the strands");
}

#[test]
fn shells_of_sparse_hair_pass_what_the_strands_do_from_the_stated_layer_count_up() {
    let slope = 75f64.to_radians().tan();
    let mut reached = Vec::new();
    for count in [150, 400] {
        let tile = grow(&GrowSettings { count, undercoat: bare(), ..GrowSettings::default() }).unwrap();
        let wanted = tile.transmittance([slope, 0.0], 512).unwrap();
        let through = |layers| sampled(&tile, layers, 256).transmittance(0, [slope, 0.0]).unwrap();
        let enough = layers_for(&tile, slope);
        assert!((80..128).contains(&enough), "{enough}");
        assert!((through(enough) - wanted).abs() < 0.02, "{} of {wanted}", through(enough));
        // Fewer leave gaps between the sections, which is what the count is for.
        let (kept, too_few) = (through(enough) - wanted, through(enough / 4) - wanted);
        assert!(too_few > 0.04);
        reached.push(format!("{count} hairs: {:.3} off with {enough} layers, {too_few:.3} with {}", kept.abs(), enough / 4));
    }
    println!("reached: {}", reached.join("; "));
}

#[test]
fn shells_along_the_normal_neither_thin_nor_thicken_as_layers_double() {
    // Slanted hair is whole seen along the normal however far the layers are apart: the core of one begins where the next one's ends.
    let tile = grow(&GrowSettings { count: 60, lean: 50.0, style: Style::Straight, undercoat: bare(), ..GrowSettings::default() }).unwrap();
    let wanted = tile.transmittance([0.0, 0.0], 512).unwrap();
    let mut most = 0.0_f64;
    for layers in [8, 16, 32] {
        let open = sampled(&tile, layers, 512).transmittance(0, [0.0, 0.0]).unwrap();
        assert!((open - wanted).abs() < 0.02, "{layers} layers: {open} of {wanted}");
        most = most.max((open - wanted).abs());
    }
    println!("reached: {most:.3} from the strands");
}

#[test]
fn a_strand_that_runs_on_for_too_long_is_refused() {
    let source = |reach: f64| StrandSource {
        points: vec![[0.5, 0.5, 0.0], [0.5 + reach, 0.5 + reach, 0.3]],
        radii: vec![0.01, 0.0],
        root_colour: [1.0; 3],
        tip_colour: [1.0; 3],
    };
    for reach in [1e3, 9e5] {
        let tile = StrandTile::from_strands(0.3, &[source(0.2), source(reach)]).unwrap();
        let refused = |error: VolumeError| matches!(error, VolumeError::StrandTooWide { strand: 1, .. });
        assert!(refused(sample_shells(&tile, &ShellSettings::default()).unwrap_err()));
        assert!(refused(sample_fin(&tile, &FinSettings { width: 8192, height: 2048, ..FinSettings::default() }).unwrap_err()));
    }
    let long = StrandTile::from_strands(0.3, &[source(20.0)]).unwrap();
    assert!(sample_shells(&long, &ShellSettings::default()).is_ok());
}
