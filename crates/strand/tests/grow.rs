//! What grown hair promises.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test that cannot go on fails, and says what it measured")]

use pelage_strand::{
    Bands, GrowSettings, MAX_STRANDS, Opacity, Root, Strand, StrandError, StrandSource, StrandTile, Style, TileNoise, Undercoat, grow,
    grow_at,
};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn bare() -> Undercoat {
    Undercoat { count: 0, ..Undercoat::default() }
}

/// No force at all: every hair goes straight up.
fn free() -> GrowSettings {
    GrowSettings {
        count: 400,
        style: Style::Straight,
        lean: 0.0,
        splay: 0.0,
        gravity: 0.0,
        wander: 0.0,
        separation: 0.0,
        clump: 0.0,
        undercoat: bare(),
        ..GrowSettings::default()
    }
}

fn tip(tile: &StrandTile, index: usize) -> [f64; 3] {
    let strand = tile.strand(index).unwrap();
    strand.points.last().unwrap().map(f64::from)
}

fn shortest(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(1.0);
    d.min(1.0 - d)
}

fn nearest_distances(places: &[[f64; 2]]) -> Vec<f64> {
    let apart = |i: usize, j: usize| shortest(places[i][0], places[j][0]).hypot(shortest(places[i][1], places[j][1]));
    (0..places.len()).map(|i| (0..places.len()).filter(|&j| j != i).map(|j| apart(i, j)).fold(f64::INFINITY, f64::min)).collect()
}

fn roots(tile: &StrandTile) -> Vec<[f64; 2]> {
    tile.strands().map(|s| [f64::from(s.points[0][0]), f64::from(s.points[0][1])]).collect()
}

#[test]
fn count_is_exact_and_every_root_is_inside() {
    for (count, down) in [(0, 0), (1, 0), (0, 1), (7, 13), (1000, 300)] {
        let tile = grow(&GrowSettings { count, undercoat: Undercoat { count: down, ..bare() }, ..GrowSettings::default() }).unwrap();
        assert_eq!(tile.strand_count() as u32, count + down);
        assert!(roots(&tile).iter().flatten().all(|c| (0.0..1.0).contains(c)));
        assert_eq!(tile.point_count() as u32, (count + down) * (GrowSettings::default().steps + 1));
    }
}

#[test]
fn no_hair_is_an_empty_box_of_the_asked_height() {
    let tile = grow(&GrowSettings { count: 0, undercoat: bare(), height: 0.3, ..GrowSettings::default() }).unwrap();
    assert_eq!((tile.strand_count(), tile.height()), (0, 0.3));
}

#[test]
fn the_same_seed_grows_the_same_bits_and_another_does_not() {
    let settings = GrowSettings { count: 200, ..GrowSettings::default() };
    let tile = grow(&settings).unwrap();
    assert_eq!(tile, grow(&settings).unwrap());
    assert_ne!(tile, grow(&GrowSettings { seed: settings.seed + 1, ..settings }).unwrap());
}

#[test]
fn any_number_of_threads_grows_the_same_bits() {
    let settings = GrowSettings { count: 900, clump: 0.5, ..GrowSettings::default() };
    let with = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| grow(&settings).unwrap());
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(8));
}

/// What passes hair is what its shadow leaves, in cases that geometry answers.
#[test]
fn light_passes_where_no_shadow_falls() {
    let hair = |x: f64, y: f64, radii: [f64; 2]| StrandSource {
        points: vec![[x, y, 0.0], [x, y, 0.4]],
        radii: radii.to_vec(),
        root_colour: [1.0; 3],
        tip_colour: [1.0; 3],
    };
    let open = |hairs: &[StrandSource], slope: [f64; 2]| StrandTile::from_strands(0.4, hairs).unwrap().transmittance(slope, 512).unwrap();
    let disc = std::f64::consts::PI * 0.01;
    // A rod's shadow is a stadium, over the border too, and two that coincide are one.
    for slope in [[0.0, 0.0], [1.0, 0.0], [0.0, -1.5], [0.6, 0.8]] {
        let shadow = disc + 0.2 * 0.4 * f64::hypot(slope[0], slope[1]);
        for place in [0.5, 0.95] {
            let rod = hair(place, place, [0.1; 2]);
            assert!((open(std::slice::from_ref(&rod), slope) - (1.0 - shadow)).abs() < 1e-3);
            assert!((open(&[rod.clone(), rod], slope) - (1.0 - shadow)).abs() < 1e-3);
        }
    }
    // A cone's is its base along the normal; aslant, the hull of base and tip: two tangents to the base from a point 0.4 away.
    let cone = hair(0.3, 0.5, [0.1, 0.0]);
    assert!((open(std::slice::from_ref(&cone), [0.0, 0.0]) - (1.0 - disc)).abs() < 1e-3);
    let (tangent, angle) = ((0.4f64 * 0.4 - 0.01).sqrt(), (0.1f64 / 0.4).acos());
    let hull = 0.1 * tangent + 0.01 * (std::f64::consts::PI - angle);
    assert!((open(&[cone], [1.0, 0.0]) - (1.0 - hull)).abs() < 1e-3);
    assert_eq!(StrandTile::empty(0.4).transmittance([1.0, 0.0], 64), Some(1.0));
    assert_eq!(StrandTile::empty(0.4).transmittance([f64::NAN, 0.0], 64), None);
    assert_eq!(StrandTile::empty(0.4).transmittance([0.0, 0.0], 0), None);
}

#[test]
fn roots_moved_by_whole_tiles_grow_the_same_bits() {
    let settings = GrowSettings { count: 120, undercoat: Undercoat { count: 60, ..bare() }, clump: 0.5, ..GrowSettings::default() };
    let places: Vec<Root> = roots(&grow(&settings).unwrap()).iter().map(|r| Root::new(r[0], r[1]).unwrap()).collect();
    let home = grow_at(&settings, &places).unwrap();
    for tiles in [[1, 0], [0, -1], [-1, 1], [1000, -1000], [-1000, 1000]] {
        let moved: Vec<Root> = places.iter().map(|root| root.moved(tiles)).collect();
        let away = grow_at(&settings, &moved).unwrap();
        assert_eq!(away, home.moved(tiles));
        assert!(home.strands().zip(away.strands()).all(|(a, b)| a.points == b.points && b.cell == tiles));
        let (a, b) = (home.strand(5).unwrap().plane_point(3).unwrap(), away.strand(5).unwrap().plane_point(3).unwrap());
        assert!((b[0] - a[0] - f64::from(tiles[0])).abs() < 1e-9);
    }
}

/// Given in the plane, each coordinate one number, strands come home within a hundredth of a texel of the finest images; kept as one `f32` they would not.
#[test]
fn toroidal_tile_given_as_one_number_is_within_a_hundredth_of_a_texel() {
    const TEXELS: f64 = 2048.0;
    let grown = grow(&GrowSettings { count: 200, ..GrowSettings::default() }).unwrap();
    // With more digits than `f32` has, and moved by whole tiles.
    let place =
        |p: &[f32; 3], tiles: [f64; 2]| [f64::from(p[0]) / 1.000_07 + tiles[0], f64::from(p[1]) / 1.000_07 + tiles[1], f64::from(p[2])];
    let moved = |tiles: [f64; 2]| {
        let source = |s: Strand<'_>| StrandSource {
            points: s.points.iter().map(|p| place(p, tiles)).collect(),
            radii: s.radii.iter().map(|&r| f64::from(r)).collect(),
            root_colour: s.root_colour,
            tip_colour: s.tip_colour,
        };
        StrandTile::from_strands(grown.height(), &grown.strands().map(source).collect::<Vec<_>>()).unwrap()
    };
    let home = moved([0.0; 2]);
    let (mut most, mut as_f32) = (0.0_f64, 0.0_f64);
    for tiles in [[1.0, -1.0], [-1.0, 1.0], [1000.0, -1000.0], [-1000.0, 1000.0]] {
        let away = moved(tiles);
        for ((a, b), grown) in home.strands().zip(away.strands()).zip(grown.strands()) {
            assert_eq!([0, 1].map(|axis| f64::from(b.cell[axis] - a.cell[axis])), tiles);
            for ((p, q), grown) in a.points.iter().zip(b.points).zip(grown.points) {
                for axis in 0..2 {
                    most = most.max(TEXELS * (f64::from(p[axis]) - f64::from(q[axis])).abs());
                    let there = place(grown, tiles)[axis];
                    as_f32 = as_f32.max(TEXELS * (f64::from(there as f32) - there).abs());
                }
            }
        }
    }
    println!("reached: {most:.4} texels of {TEXELS}");
    println!("reached: {as_f32:.3} texels of {TEXELS} if a place were one f32");
    assert!(most < 1e-3 && as_f32 > 0.01, "{most} {as_f32}");
}

#[test]
fn neighbours_are_felt_across_the_border() {
    // Two hairs with the border between them must bend apart as two in the middle do.
    let settings = GrowSettings { count: 2, separation: 5.0, length_variation: 0.0, ..free() };
    let pair = |x: f64| [Root::new(x - 0.01, 0.5).unwrap(), Root::new(x + 0.01, 0.5).unwrap()];
    let gap = |x: f64| {
        let tile = grow_at(&settings, &pair(x).map(|r| r.moved([-r.cell[0], -r.cell[1]]))).unwrap();
        shortest(tip(&tile, 0)[0], tip(&tile, 1)[0])
    };
    assert!(gap(0.5) > 0.03, "{}", gap(0.5));
    assert!((gap(0.5) - gap(1.0)).abs() < 1e-4, "{} {}", gap(0.5), gap(1.0));
}

#[test]
fn roots_stand_evenly() {
    let tile = grow(&GrowSettings { count: 1000, ..free() }).unwrap();
    let places = roots(&tile);
    // The densest packing's distance; darts at random come as near as 1/(2n).
    let densest = (2.0 / (3f64.sqrt() * 1000.0)).sqrt();
    let nearest = nearest_distances(&places);
    let least = nearest.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least > 0.5 * densest, "{}", least / densest);
    // No wide gaps either: each sixteenth of the tile holds its share.
    for cell in 0..16 {
        let inside = places.iter().filter(|p| (p[0] * 4.0) as usize + 4 * (p[1] * 4.0) as usize == cell).count();
        assert!((50..=75).contains(&inside), "{inside}");
    }
}

#[test]
fn lengths_follow_the_asked_variation_and_reach_the_asked_height() {
    let variation = 0.5;
    let tile = grow(&GrowSettings { count: 2000, height: 0.4, length_variation: variation, ..free() }).unwrap();
    assert!((tile.height() / 0.4 - 1.0).abs() < 0.01);
    let tops: Vec<f64> = (0..2000).map(|i| tip(&tile, i)[2] / 0.4).collect();
    // Lengths go as 1 − v·u², u uniform; the longest 15 % (u < 0.15) are trimmed to the height.
    let scale = 1.0 / (1.0 - variation * 0.15 * 0.15);
    let length = |u: f64| (scale * (1.0 - variation * u * u)).min(1.0);
    let expected = (0..1000).map(|i| length((f64::from(i) + 0.5) / 1000.0)).sum::<f64>() / 1000.0;
    let mean = tops.iter().sum::<f64>() / 2000.0;
    assert!((mean - expected).abs() < 0.01, "{mean} {expected}");
    let shortest = tops.iter().copied().fold(1.0, f64::min);
    assert!((shortest - length(1.0)).abs() < 0.01, "{shortest}");
    assert!(tops.iter().filter(|&&top| top > 0.98).count() > 200);
}

#[test]
fn leaning_hair_leans_by_its_angle() {
    let tile = grow(&GrowSettings { lean: 30.0, ..free() }).unwrap();
    for (index, root) in roots(&tile).iter().enumerate() {
        let end = tip(&tile, index);
        assert!((end[0] - root[0]).abs() < 1e-6);
        assert!(((end[1] - root[1]) / end[2] - 30f64.to_radians().tan()).abs() < 1e-4);
    }
}

#[test]
fn curls_have_the_asked_radius_and_turns() {
    let (radius, turns, per_turn) = (0.03, 3.0, 12);
    let style = Style::Curly { radius: radius / free().height, turns };
    let tile = grow(&GrowSettings { style, steps: 36, ..free() }).unwrap();
    let mut hands = [0, 0];
    for strand in tile.strands() {
        let points: Vec<[f64; 3]> = strand.points.iter().map(|p| p.map(f64::from)).collect();
        // Over a whole number of turns the mean of the points is the axis.
        let axis = [0, 1].map(|c| points[..3 * per_turn].iter().map(|p| p[c]).sum::<f64>() / (3 * per_turn) as f64);
        assert!(points.iter().all(|p| ((p[0] - axis[0]).hypot(p[1] - axis[1]) - radius).abs() < 1e-5));
        let angle = |p: &[f64; 3]| (p[1] - axis[1]).atan2(p[0] - axis[0]);
        let step = |pair: &[[f64; 3]]| (angle(&pair[1]) - angle(&pair[0]) + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
        let turned = points.windows(2).map(step).sum::<f64>() / TAU;
        assert!((turned.abs() - turns).abs() < 1e-3, "{turned}");
        hands[usize::from(turned > 0.0)] += 1;
    }
    assert!(hands.iter().all(|&count| count > 100), "{hands:?}");
}

#[test]
fn waves_reach_the_asked_amplitude_to_one_side_and_the_other() {
    for style in [Style::Wavy { amplitude: 0.05, waves: 2.0 }, Style::Zigzag { amplitude: 0.05, waves: 2.0 }] {
        let tile = grow(&GrowSettings { style, height: 0.4, steps: 480, ..free() }).unwrap();
        for strand in tile.strands() {
            let [x, y, _] = strand.points[0];
            let far = |p: &[f32; 3]| f64::from(p[0] - x).hypot(f64::from(p[1] - y));
            // All sway is along one line; between its ends lie two amplitudes.
            let end = strand.points.iter().max_by(|a, b| far(a).total_cmp(&far(b))).unwrap();
            let along = [end[0] - x, end[1] - y].map(|c| f64::from(c) / far(end));
            let sway: Vec<f64> = strand.points.iter().map(|p| f64::from(p[0] - x) * along[0] + f64::from(p[1] - y) * along[1]).collect();
            let width = sway.iter().fold(f64::MIN, |a, &b| a.max(b)) - sway.iter().fold(f64::MAX, |a, &b| a.min(b));
            assert!((width - 0.04).abs() < 0.001, "{style:?} {width}");
        }
    }
}

#[test]
fn each_force_does_what_it_says() {
    let tips = |settings: &GrowSettings| {
        let tile = grow(settings).unwrap();
        let tips: Vec<[f64; 2]> = (0..tile.strand_count()).map(|i| [tip(&tile, i)[0], tip(&tile, i)[1]]).collect();
        let nearest = nearest_distances(&tips);
        nearest.iter().sum::<f64>() / nearest.len() as f64
    };
    let alone = tips(&free());
    assert!(tips(&GrowSettings { clump: 0.8, ..free() }) < 0.6 * alone);
    let loose = GrowSettings { wander: 2.0, length_variation: 0.0, ..free() };
    let (kept, not) = (tips(&GrowSettings { separation: 10.0, ..loose }), tips(&loose));
    assert!(kept > 1.15 * not, "{kept} {not}");
    // Gravity lays leaning hair down: more way sideways for the same height.
    let sideways = |gravity: f64| {
        let tile = grow(&GrowSettings { lean: 20.0, gravity, ..free() }).unwrap();
        (tip(&tile, 0)[1] - roots(&tile)[0][1]) / tip(&tile, 0)[2]
    };
    assert!(sideways(2.0) > 1.2 * sideways(0.0));
    // Stiffness holds against it.
    let bent = |stiffness: f64| {
        let tile = grow(&GrowSettings { wander: 3.0, stiffness, ..free() }).unwrap();
        roots(&tile).iter().enumerate().map(|(i, r)| (tip(&tile, i)[0] - r[0]).abs()).sum::<f64>()
    };
    assert!(bent(50.0) < 0.3 * bent(1.0));
}

#[test]
fn hair_tapers_from_the_asked_thickness_and_the_down_is_shorter_and_finer() {
    let settings = GrowSettings { count: 300, undercoat: Undercoat { count: 300, length: 0.5, thickness: 0.5, ..bare() }, ..free() };
    let tile = grow(&settings).unwrap();
    for (index, strand) in tile.strands().enumerate() {
        let down = index >= 300;
        let thickness = settings.thickness * if down { 0.5 } else { 1.0 };
        assert!((f64::from(strand.radii[0]) / thickness - 1.0).abs() < 0.151);
        assert!(strand.radii.windows(2).all(|pair| pair[1] <= pair[0]));
        let tip = f64::from(*strand.radii.last().unwrap()) / f64::from(strand.radii[0]);
        assert!((tip - settings.tip_thickness).abs() < 1e-4);
        assert!(!down || strand.arc_length() <= 0.53 * settings.height);
    }
}

#[test]
fn settings_out_of_range_are_named() {
    let good = GrowSettings::default();
    let wrong = [
        (GrowSettings { height: 0.0, ..good }, "height"),
        (GrowSettings { thickness: f64::NAN, ..good }, "thickness"),
        (GrowSettings { lean: 90.0, ..good }, "lean"),
        (GrowSettings { clump: 1.5, ..good }, "clump"),
        (GrowSettings { tip_colour: [0.0, 2.0, 0.0], ..good }, "tip_colour"),
        (GrowSettings { steps: 0, ..good }, "steps"),
        (GrowSettings { style: Style::Curly { radius: -0.1, turns: 1.0 }, ..good }, "style.radius"),
    ];
    for (settings, field) in wrong {
        match grow(&settings).unwrap_err() {
            StrandError::OutOfRange { name, .. } => assert_eq!(name, field),
            other => panic!("{other}"),
        }
    }
    let many = GrowSettings { count: u32::MAX, ..good };
    assert_eq!(
        grow(&many).unwrap_err(),
        StrandError::TooManyStrands { asked: u64::from(u32::MAX) + u64::from(good.undercoat.count), limit: MAX_STRANDS }
    );
    assert!(matches!(grow(&GrowSettings { count: 1_000_000, steps: 512, ..good }), Err(StrandError::TooManyPoints { .. })));
}

#[test]
fn hand_made_strands_are_brought_home_or_refused() {
    let source = StrandSource {
        points: vec![[-3.25, 1000.5, 0.0], [-3.0, 1000.75, 0.2]],
        radii: vec![0.01, 0.0],
        root_colour: [0.1; 3],
        tip_colour: [0.2; 3],
    };
    let tile = StrandTile::from_strands(0.2, std::slice::from_ref(&source)).unwrap();
    let strand = tile.strand(0).unwrap();
    assert_eq!((strand.points, strand.cell), (&[[0.75, 0.5, 0.0], [1.0, 0.75, 0.2]][..], [-4, 1000]));
    let short = StrandSource { points: vec![[0.0; 3]], radii: vec![0.1], ..source.clone() };
    assert_eq!(StrandTile::from_strands(0.2, &[source.clone(), short]), Err(StrandError::TooShort { strand: 1, points: 1 }));
    let few = StrandSource { radii: vec![0.1], ..source.clone() };
    assert_eq!(StrandTile::from_strands(0.2, &[few]), Err(StrandError::RadiiMismatch { strand: 0, points: 2, radii: 1 }));
    let lost = StrandSource { points: vec![[0.0; 3], [f64::NAN, 0.0, 0.0]], ..source };
    assert!(matches!(StrandTile::from_strands(0.2, &[lost]), Err(StrandError::BadPoint { strand: 0, point: 1, .. })));
}

#[test]
fn byte_size_counts_every_array() {
    let tile = grow(&GrowSettings { count: 10, steps: 4, undercoat: bare(), ..GrowSettings::default() }).unwrap();
    let plain = 11 * 4 + 50 * (12 + 4) + 10 * (12 + 12 + 8 + 8) + 2 * 4;
    assert_eq!(tile.byte_size(), plain);
    // Hair of more than two colours, or that lets light through, says so for each strand, and its bands once.
    let faint = tile.tinted(Bands::default(), &Opacity { root: 0.5, ..Opacity::default() }).unwrap();
    assert_eq!(faint.byte_size(), plain + 10 * 16 + size_of::<Bands>());
}

#[test]
fn noise_repeats_is_bounded_and_smooth() {
    let noise = TileNoise::new(3, 5);
    let mut spread = 0.0f64;
    for i in 0..2000 {
        let [x, y, z] = [0.618, 0.755, 0.319].map(|step| f64::from(i) * step);
        let value = noise.value(x, y, z);
        assert!(value.abs() <= 1.0);
        assert!((value - noise.value(x + 3.0, y - 2.0, z)).abs() < 1e-9);
        assert!((value - noise.value(x + 1e-5, y, z)).abs() < 1e-3);
        assert!(
            (noise.value(1.0 - 1e-7, y, z) - noise.value(0.0, y, z)).abs() < 1e-5
                && (noise.value(x, 1.0 - 1e-7, z) - noise.value(x, 0.0, z)).abs() < 1e-5
        );
        spread = spread.max(value.abs());
    }
    assert!(spread > 0.4);
    assert_eq!(noise.value(f64::NAN, 0.0, 0.0), 0.0);
}

fn any_style() -> impl Strategy<Value = Style> {
    let two = || (0.0..=1.0, 0.0..=64.0);
    prop_oneof![
        Just(Style::Straight),
        two().prop_map(|(amplitude, waves)| Style::Wavy { amplitude, waves }),
        two().prop_map(|(radius, turns)| Style::Curly { radius, turns }),
        two().prop_map(|(amplitude, waves)| Style::Zigzag { amplitude, waves }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whatever_is_in_range_grows_finite_hair_above_the_skin(
        style in any_style(),
        counts in (0u32..40, 0u32..40, 1u32..60, any::<u64>()),
        shape in (1e-3..=8.0, 0.0..=0.95, 1e-6..=0.25, 0.0..=75.0, 0.0..=60.0),
        forces in (0.0..=100.0, 0.0..=20.0, 0.0..=20.0, 0.0..=20.0, 0.0..=1.0, 0.01..=1.0),
    ) {
        let settings = GrowSettings {
            count: counts.0, steps: counts.2, seed: counts.3, style,
            undercoat: Undercoat { count: counts.1, ..Undercoat::default() },
            height: shape.0, length_variation: shape.1, thickness: shape.2, lean: shape.3, splay: shape.4,
            stiffness: forces.0, gravity: forces.1, wander: forces.2, separation: forces.3, clump: forces.4, clump_size: forces.5,
            ..GrowSettings::default()
        };
        let tile = grow(&settings).unwrap();
        prop_assert_eq!(tile.strand_count() as u64, settings.strand_count());
        prop_assert!(tile.height().is_finite() && tile.height() > 0.0);
        for strand in tile.strands() {
            prop_assert!(strand.points.iter().flatten().all(|c| c.is_finite()));
            prop_assert!(strand.points.iter().all(|p| p[2] >= 0.0 && f64::from(p[2]) <= tile.height()));
            prop_assert!(strand.radii.iter().all(|r| r.is_finite() && *r >= 0.0));
        }
    }
}
