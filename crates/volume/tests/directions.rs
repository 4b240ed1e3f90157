//! What the direction map promises.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::f64::consts::TAU;

use pelage_strand::{StrandSource, StrandTile};
use pelage_volume::{ShellSettings, ShellStack, sample_shells};

const STEP: f64 = 1.0 / 127.5;

fn hair(points: Vec<[f64; 3]>, radius: f64) -> StrandSource {
    StrandSource { radii: vec![radius; points.len()], points, root_colour: [0.5; 3], tip_colour: [0.5; 3] }
}

fn sampled(strands: &[StrandSource], stretch: f64) -> ShellStack {
    let tile = StrandTile::from_strands(1.0, strands).unwrap();
    sample_shells(&tile, &ShellSettings { layers: 6, resolution: 32, directions: Some(stretch), ..ShellSettings::default() }).unwrap()
}

fn direction(stack: &ShellStack, mip: usize, image: u32, x: u32, y: u32) -> [f64; 3] {
    let texel = stack.directions.as_ref().unwrap()[mip].texel(image, x, y).unwrap();
    [0, 1, 2].map(|axis| f64::from(texel[axis]) * STEP - 1.0)
}

fn near(a: [f64; 3], b: [f64; 3], bound: f64) -> bool {
    (0..3).all(|axis| (a[axis] - b[axis]).abs() <= bound)
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

#[test]
fn upright_hair_points_up_everywhere() {
    let stack = sampled(&[hair(vec![[0.4, 0.6, 0.0], [0.4, 0.6, 1.0]], 0.05)], 1.0);
    let maps = stack.directions.as_ref().unwrap();
    assert_eq!(maps.iter().map(|mip| (mip.width, mip.layers)).collect::<Vec<_>>(), [(32, 6), (16, 6), (8, 6), (4, 6), (2, 6), (1, 6)]);
    assert_eq!(stack.direction_bytes(), stack.byte_size());
    assert!(maps.iter().all(|mip| mip.texels.chunks_exact(4).all(|texel| texel == [128, 128, 255, 255])));
}

#[test]
fn leaning_hair_points_along_its_lean_and_height_is_stretched_first() {
    let lean = [0.3, -0.4, 1.0];
    for stretch in [1.0, 0.25, 4.0] {
        let stack = sampled(&[hair(vec![[0.4, 0.6, 0.0], [0.7, 0.2, 1.0]], 0.04)], stretch);
        let laid = [lean[0], lean[1], lean[2] * stretch];
        let unit = laid.map(|c| c / length(laid));
        // Where there is none, too: in every image some texel has hair, and the others take it from there.
        for (mip, side) in [(0usize, 32u32), (2, 8), (5, 1)] {
            for image in 0..6 {
                assert!(
                    (0..side * side).all(|i| near(direction(&stack, mip, image, i % side, i / side), unit, STEP)),
                    "{stretch} {mip} {image}"
                );
            }
        }
    }
}

#[test]
fn a_helix_shrinks_to_what_its_turns_have_in_common() {
    // Two turns a layer spacing: 2πrn aside on average for each 1 up, and what is aside cancels but for the part of a turn left over.
    let (turns, radius) = (10.0, 0.02);
    let points = (0..=2000).map(|i| f64::from(i) / 2000.0);
    let points = points.map(|z| [0.5 + radius * (TAU * turns * z).cos(), 0.5 + radius * (TAU * turns * z).sin(), z]).collect();
    let stack = sampled(&[hair(points, 0.01)], 1.0);
    let rise = 1.0 / (1.0 + (TAU * turns * radius).powi(2)).sqrt();
    let mean = direction(&stack, 5, 3, 0, 0);
    assert!((0.55..0.75).contains(&rise) && near(mean, [0.0, 0.0, rise], 0.05) && (mean[2] - rise).abs() < 0.01, "{mean:?} of {rise}");
    // Everywhere at most one long, rounding aside.
    for image in 0..6 {
        assert!((0..1024).all(|i| length(direction(&stack, 0, image, i % 32, i / 32)) < 1.0 + 2.0 * STEP));
    }
}

#[test]
fn hairs_that_cross_are_weighted_by_what_they_cover() {
    // At height 1/2 the thicker crosses the thinner at right angles in the plane of s and height; the whole layer covers by 2r × run + πr² each.
    let cross = |sign: f64, y: f64, radius: f64| hair(vec![[0.5 - 0.3 * sign, y, 0.0], [0.5 + 0.3 * sign, y, 1.0]], radius);
    let (thick, thin) = (0.02, 0.01);
    let stack = sampled(&[cross(1.0, 0.3, thick), cross(-1.0, 0.8, thin)], 1.0);
    let length = (1.0f64 + 0.36).sqrt();
    let settings = ShellSettings::default();
    // What runs in a layer: its core to both sides and the Gaussian beyond, 1/5 of a tile a spacing.
    let run = 0.6 * 0.2 * (2.0 * settings.vertical_core + settings.vertical_sigma * TAU.sqrt());
    let area = |radius: f64| 2.0 * radius * run + TAU / 2.0 * radius * radius;
    let (a, b) = (area(thick), area(thin));
    let wanted = [0.6 / length * (a - b) / (a + b), 0.0, 1.0 / length];
    let mean = direction(&stack, 5, 2, 0, 0);
    assert!(near(mean, wanted, 0.02), "{mean:?} of {wanted:?}");
}

/// Without filling, a texel half a hair's width away would hold a zero, and filtering would mix it in.
#[test]
fn no_texel_is_short_where_all_hair_stands_alike() {
    let strands: Vec<StrandSource> =
        (0..5).map(|i| f64::from(i) * 0.19).map(|x| hair(vec![[x, 0.1 + x, 0.0], [x + 0.1, 0.1 + x, 1.0]], 0.01)).collect();
    let stack = sampled(&strands, 1.0).with_levels().unwrap();
    let maps = stack.directions.as_ref().unwrap();
    assert_eq!(maps[0].layers, stack.images());
    for (mip, map) in maps.iter().enumerate() {
        for image in 0..map.layers {
            for i in 0..map.width * map.width {
                let length = length(direction(&stack, mip, image, i % map.width, i / map.width));
                assert!((length - 1.0).abs() < 2.0 * STEP, "mip {mip}, image {image}: {length}");
            }
        }
    }
}

#[test]
fn a_level_of_detail_points_where_its_visible_hair_does() {
    // Upright up to layer 2, leaning from there on; layer 3 holds the leaning part alone and hides what it stands on.
    let kinked = hair(vec![[0.5, 0.5, 0.0], [0.5, 0.5, 0.4], [0.9, 0.5, 1.0]], 0.05);
    let stack = sampled(&[kinked], 1.0).with_levels().unwrap();
    let composite = stack.levels[1][1].image;
    let leaning = [0.4 / 0.52f64.sqrt(), 0.0, 0.6 / 0.52f64.sqrt()];
    let seen = direction(&stack, 0, composite, 20, 16);
    assert!(near(seen, leaning, 0.02), "{seen:?}");
    // Beside it layer 2 shows through: each by what is seen of it.
    let (x, y) = (14, 16);
    let [lower, upper] = [2, 3].map(|layer| f64::from(stack.mips[0].texel(layer, x, y).unwrap()[3]) / 255.0);
    assert!(lower > 0.4 && upper > 0.02 && upper < 0.2, "{lower} {upper}");
    let [below, above] = [2, 3].map(|layer| direction(&stack, 0, layer, x, y));
    let shown = lower * (1.0 - upper);
    let wanted = [0, 1, 2].map(|axis| (below[axis] * shown + above[axis] * upper) / (shown + upper));
    assert!(near(direction(&stack, 0, composite, x, y), wanted, 0.51 * STEP) && !near(wanted, below, STEP), "{wanted:?}");
}

#[test]
fn the_seam_is_like_the_middle() {
    let at = |x: f64, y: f64| sampled(&[hair(vec![[x, y, 0.0], [x + 0.3, y + 0.2, 0.6], [x, y + 0.4, 1.0]], 0.03)], 1.0);
    let (middle, seam) = (at(0.25, 0.25), at(0.875, 0.9375));
    // Moved by 20 and 22 texels.
    for image in 0..6 {
        for (x, y) in (0..1024).map(|i| (i % 32, i / 32)) {
            let there = direction(&seam, 0, image, (x + 20) % 32, (y + 22) % 32);
            if middle.mips[0].texel(image, x, y).unwrap()[3] > 0 && image > 0 {
                assert!(near(direction(&middle, 0, image, x, y), there, 2.01 * STEP), "image {image} at {x}, {y}");
            }
        }
    }
    let tile = StrandTile::from_strands(1.0, &[hair(vec![[0.9, 0.9, 0.0], [1.3, 1.1, 1.0]], 0.03)]).unwrap();
    let settings = ShellSettings { resolution: 32, directions: Some(1.0), ..ShellSettings::default() };
    assert_eq!(sample_shells(&tile, &settings), sample_shells(&tile.moved([1000, -1000]), &settings));
}

#[test]
fn asking_for_directions_changes_no_colour_and_no_stretch_is_wrong_unnoticed() {
    let tile = StrandTile::from_strands(1.0, &[hair(vec![[0.1, 0.2, 0.0], [0.4, 0.2, 1.0]], 0.03)]).unwrap();
    let plain = sample_shells(&tile, &ShellSettings::default()).unwrap();
    let directed = sample_shells(&tile, &ShellSettings { directions: Some(2.0), ..ShellSettings::default() }).unwrap();
    assert_eq!((plain.mips, plain.work), (directed.mips, directed.work));
    for stretch in [0.0, -1.0, f64::NAN] {
        assert!(sample_shells(&tile, &ShellSettings { directions: Some(stretch), ..ShellSettings::default() }).is_err());
    }
}
