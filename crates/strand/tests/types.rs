//! What each type of hair promises: its shape, its locks, what varies from place to place, its colours, and what is made of two tiles or of guides.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test that cannot go on fails, and says what it measured")]

use pelage_strand::{
    Amounts, Bands, ByNoise, ByPattern, Curve, Gather, GrowSettings, Guide, Offset, Opacity, Pattern, Root, Stop, Strand, StrandError,
    StrandSource, StrandTile, Style, Taper, Undercoat, grow, grow_at, guided, mix,
};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn bare() -> Undercoat {
    Undercoat { count: 0, ..Undercoat::default() }
}

/// No force at all: every hair goes straight up, all to the asked height.
fn free() -> GrowSettings {
    GrowSettings {
        count: 400,
        height: 0.4,
        length_variation: 0.0,
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

fn root(strand: &Strand<'_>) -> [f64; 2] {
    [0, 1].map(|axis| f64::from(strand.points[0][axis]))
}

fn tip(strand: &Strand<'_>) -> [f64; 3] {
    strand.points[strand.points.len() - 1].map(f64::from)
}

fn shortest(delta: f64) -> f64 {
    delta - (delta + 0.5).floor()
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

/// A helix of radius r and n turns on a way of length 1 is √(1 + (2πrn)²) long; irregular wool about as long. Half way it has turned back.
#[test]
fn wool_is_as_long_as_its_helix_and_turns_round_on_the_way() {
    let (radius, turns) = (0.1, 3.0);
    let wool = |irregularity: f64| {
        let style = Style::Woolly { radius, turns, irregularity };
        grow(&GrowSettings { style, steps: 240, ..free() }).unwrap()
    };
    let ratio = (1.0 + (TAU * radius * turns).powi(2)).sqrt();
    let regular = wool(0.0);
    for strand in regular.strands() {
        assert!((strand.arc_length() / (ratio * 0.4) - 1.0).abs() < 0.01, "{} {}", strand.arc_length() / 0.4, ratio);
    }
    let tangled = mean(wool(1.0).strands().map(|strand| strand.arc_length() / 0.4));
    println!("reached: wool {tangled:.3} heights long, its regular helix {ratio:.3}");
    assert!((0.95..1.35).contains(&(tangled / ratio)), "{tangled} {ratio}");
    for strand in regular.strands() {
        let turn = |k: usize| {
            let p = |i: usize| [0, 1].map(|axis| f64::from(strand.points[i][axis]));
            let (a, b, c) = (p(k - 1), p(k), p(k + 1));
            (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
        };
        // It turns one way below where it changes its sense, 0.3 to 0.7 of the way, and the other above.
        assert!(turn(30) * turn(210) < 0.0);
        let changes = (2..239).filter(|&k| (turn(k) > 0.0) != (turn(k - 1) > 0.0)).count();
        assert!((1..=2).contains(&changes), "{changes}");
    }
}

#[test]
fn neighbours_in_wool_are_out_of_step_and_in_curls_nearly_in_step() {
    // How much the first steps of neighbours go the same way, after their azimuth is taken off: by the spread of phases, which the place after a quarter shows.
    let spread = |style: Style| {
        let tile = grow(&GrowSettings { style, count: 300, steps: 48, ..free() }).unwrap();
        // Way from the axis over the radius, squared, at the tip: 2 − 2 cos(phase difference) for whole turns plus a half is 4 for all.
        mean(tile.strands().map(|strand| {
            let (from, to) = (root(&strand), tip(&strand));
            (to[0] - from[0]).hypot(to[1] - from[1])
        }))
    };
    // A curl of 2.5 turns ends a diameter from its root; wool, which turns back, ends anywhere.
    let curl = spread(Style::Curly { radius: 0.1, turns: 2.5 });
    let wool = spread(Style::Woolly { radius: 0.1, turns: 2.5, irregularity: 0.0 });
    assert!((curl - 0.08).abs() < 1e-4, "{curl}");
    assert!(wool < 0.75 * curl, "{wool} {curl}");
}

#[test]
fn zigzag_runs_straight_between_its_bends() {
    let waves = 4.0;
    let tile = grow(&GrowSettings { style: Style::Zigzag { amplitude: 0.05, waves }, steps: 400, ..free() }).unwrap();
    let slope = 4.0 * 0.05 * waves;
    for strand in tile.strands() {
        let run = |k: usize| {
            let d = [0, 1, 2].map(|axis| f64::from(strand.points[k + 1][axis]) - f64::from(strand.points[k][axis]));
            d[0].hypot(d[1]) / d[2]
        };
        // All but the steps that hold a bend climb at one slope.
        let straight = (0..400).filter(|&k| (run(k) - slope).abs() < 0.01 * slope).count();
        assert!(straight >= 400 - 2 * waves as usize, "{straight}");
        let bends = (1..400).filter(|&k| run(k) < 0.97 * slope).count();
        assert!(bends <= 2 * waves as usize, "{bends}");
    }
}

/// Tips of a spike are (1 − strength) times as far from its middle as their roots, whatever the offset along the hair.
#[test]
fn spiky_tips_come_as_near_as_asked() {
    for offset in [Offset::Sine, Offset::Exponential { rate: 3.0 }, Offset::Power { exponent: 2.0 }] {
        for strength in [0.0, 0.5, 0.9, 1.0] {
            let settings = GrowSettings { gather: Gather::Spiky { strength, offset }, clump_size: 0.2, ..free() };
            let tile = grow(&settings).unwrap();
            // The first hairs stand in the middles: 1/0.2² of them.
            let middles: Vec<[f64; 2]> = (0..25).map(|lock| root(&tile.strand(lock).unwrap())).collect();
            for strand in tile.strands() {
                let way = |place: [f64; 2], middle: [f64; 2]| shortest(place[0] - middle[0]).hypot(shortest(place[1] - middle[1]));
                let from = root(&strand);
                let middle = middles.iter().copied().min_by(|a, b| way(from, *a).total_cmp(&way(from, *b))).unwrap();
                let to = tip(&strand);
                let (before, after) = (way(from, middle), way([to[0], to[1]], middle));
                assert!((after - (1.0 - strength) * before).abs() < 1e-5, "{offset:?} {strength}: {after} of {before}");
            }
            // The offset is followed on the way as well: half way along, its own part of it.
            let strand = tile.strands().skip(25).find(|strand| way_of(strand, 24) > 0.02 || strength < 0.3).unwrap();
            let half = way_of(&strand, 12) / way_of(&strand, 24).max(1e-12);
            assert!(strength < 0.3 || (half - offset.at(0.5)).abs() < 1e-3, "{offset:?}: {half}");
        }
    }
}

/// How far aside of its root a hair is at a point.
fn way_of(strand: &Strand<'_>, index: usize) -> f64 {
    let from = root(strand);
    (f64::from(strand.points[index][0]) - from[0]).hypot(f64::from(strand.points[index][1]) - from[1])
}

#[test]
fn spikes_are_cones_and_tufts_keep_some_hair_out() {
    let offset = Offset::Power { exponent: 1.5 };
    let spikes = grow(&GrowSettings { gather: Gather::Spiky { strength: 1.0, offset }, clump_size: 0.25, ..free() }).unwrap();
    // The sixteen middles are the highest, all else the lower the further out, down to 0.55.
    let tops: Vec<f64> = spikes.strands().map(|strand| tip(&strand)[2] / 0.4).collect();
    assert!(tops[..16].iter().all(|&top| top > 0.99), "{:?}", &tops[..16]);
    let least = tops.iter().copied().fold(1.0, f64::min);
    assert!((least - 0.55).abs() < 0.02, "{least}");
    let tufts =
        |mess: f64| grow(&GrowSettings { gather: Gather::Clumpy { strength: 1.0, mess, offset }, clump_size: 0.25, ..free() }).unwrap();
    let tidy = tufts(0.0);
    assert!(tidy.strands().all(|strand| (tip(&strand)[2] / 0.4 - 1.0).abs() < 0.01));
    // Each goes its own part of the way: 2/3 in the mean, some hardly any.
    let moved = mean(tidy.strands().skip(16).map(|strand| way_of(&strand, 24)));
    let all = mean(spikes.strands().skip(16).map(|strand| way_of(&strand, 24)));
    assert!((moved / all - 2.0 / 3.0).abs() < 0.05, "{}", moved / all);
    // Tufts go aside, each as a whole.
    let messy = tufts(0.5);
    let aside: Vec<f64> = messy.strands().take(16).map(|strand| way_of(&strand, 24) / 0.4).collect();
    assert!(aside.iter().all(|&way| way <= 0.5 + 1e-6) && aside.iter().any(|&way| way > 0.3), "{aside:?}");
}

#[test]
fn radii_follow_their_taper() {
    let (tip_thickness, thickness) = (0.2, 0.01);
    let along = |taper: Taper| {
        let tile = grow(&GrowSettings { taper, tip_thickness, thickness, thickness_variation: 0.0, count: 3, steps: 4, ..free() }).unwrap();
        tile.strand(1).unwrap().radii.iter().map(|&r| f64::from(r) / thickness).collect::<Vec<f64>>()
    };
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(near(&along(Taper::Fixed), &[1.0; 5]));
    assert!(near(&along(Taper::Linear), &[1.0, 0.8, 0.6, 0.4, 0.2]));
    assert!(near(&along(Taper::Power { exponent: 2.0 }), &[1.0, 0.95, 0.8, 0.55, 0.2]));
    let e = |x: f64| 0.2 + 0.8 * (1.0 - (1.0 - (-2.0 * x).exp()) / (1.0 - (-2.0f64).exp()));
    assert!(near(&along(Taper::Exponential { rate: 2.0 }), &[1.0, e(0.25), e(0.5), e(0.75), 0.2]));
    assert!(near(&along(Taper::Exponential { rate: 0.0 }), &along(Taper::Linear)));
    assert!(near(&along(Taper::Curve(Curve::new(&[0.5, 1.5, 0.0]).unwrap())), &[0.5, 1.0, 1.5, 0.75, 0.0]));
}

#[test]
fn patterns_repeat_with_the_tile_and_take_half_of_it() {
    let patterns = [
        Pattern::Stripes { along_s: 3, along_t: 0 },
        Pattern::Stripes { along_s: 2, along_t: 5 },
        Pattern::Checks { count: 2 },
        Pattern::Dots { count: 3 },
    ];
    for pattern in patterns {
        for softness in [0.0, 0.3, 1.0] {
            let mut sum = 0.0;
            for (i, j) in (0..200).flat_map(|i| (0..200).map(move |j| (i, j))) {
                // Off the edges of all patterns, where rounding would choose.
                let [x, y] = [i, j].map(|k| (f64::from(k) + 0.37) / 200.0);
                let value = pattern.value(x, y, softness);
                assert!((0.0..=1.0).contains(&value));
                for [across, up] in [[1.0, 0.0], [0.0, 1.0], [-3.0, 2.0]] {
                    assert!((value - pattern.value(x + across, y + up, softness)).abs() < 1e-9, "{pattern:?} at {x}, {y}");
                }
                sum += value;
            }
            assert!((sum / 40_000.0 - 0.5).abs() < 0.05, "{pattern:?} {softness}: {}", sum / 40_000.0);
        }
        assert_eq!(pattern.value(0.0, 0.0, 0.3), 1.0);
    }
    // As many as asked: whole, half way to the next, and next, across, along and aslant.
    let along = |pattern: Pattern, x: f64, y: f64| [0.0, 0.5, 1.0].map(|step| pattern.value(x * step, y * step, 0.3));
    assert_eq!(along(Pattern::Stripes { along_s: 3, along_t: 0 }, 1.0 / 3.0, 0.0), [1.0, 0.0, 1.0]);
    assert_eq!(along(Pattern::Stripes { along_s: 2, along_t: 5 }, 0.0, 0.2), [1.0, 0.0, 1.0]);
    assert_eq!(along(Pattern::Checks { count: 3 }, 1.0 / 3.0, 0.0), [1.0, 0.0, 1.0]);
    assert_eq!(along(Pattern::Checks { count: 3 }, 1.0 / 3.0, 1.0 / 3.0), [1.0, 1.0, 1.0]);
    assert_eq!(along(Pattern::Dots { count: 3 }, 1.0 / 3.0, 0.0), [1.0, 0.0, 1.0]);
    assert_eq!(along(Pattern::Dots { count: 3 }, 1.0 / 3.0, 1.0 / 3.0), [1.0, 1.0, 1.0]);
}

#[test]
fn what_varies_varies_by_place_and_nothing_else_does() {
    let half = Amounts { length: 0.5, thickness: 0.5, colour: 0.5, tip: 0.5, bend: 0.5 };
    let pattern = Pattern::Stripes { along_s: 0, along_t: 2 };
    let by_pattern = ByPattern { pattern, softness: 0.0, amounts: half };
    let even = GrowSettings {
        count: 600,
        thickness_variation: 0.0,
        colour_variation: 0.0,
        root_colour: [0.4; 3],
        tip_colour: [0.8; 3],
        lean: 30.0,
        ..free()
    };
    let striped = grow(&GrowSettings { by_pattern, ..even }).unwrap();
    let plain = grow(&even).unwrap();
    let (mut inside, mut lengths) = (0, Vec::new());
    for (a, b) in striped.strands().zip(plain.strands()) {
        let [x, y] = root(&a);
        let is_inside = pattern.value(x, y, 0.0) > 0.5;
        inside += usize::from(is_inside);
        let factor = if is_inside { 0.5 } else { 1.0 };
        let lean = |strand: &Strand<'_>| {
            let (from, to) = (root(strand), tip(strand));
            ((to[0] - from[0]).hypot(to[1] - from[1]) / to[2]).atan().to_degrees()
        };
        assert!((lean(&a) - 30.0 * factor).abs() < 0.01 && (lean(&b) - 30.0).abs() < 0.01, "{} {}", lean(&a), lean(&b));
        lengths.push(a.arc_length() / factor);
        assert!((a.radii[0] / b.radii[0] - factor as f32).abs() < 1e-5);
        assert!((a.radii[24] / a.radii[0] - 0.15 * factor as f32).abs() < 1e-5);
        assert!((a.colour_at(1.0)[0] - 0.8 * factor as f32).abs() < 1e-6);
    }
    assert!((250..350).contains(&inside), "{inside}");
    // Half as long, and else of one length: that of the box's height for those that lean the least.
    assert!(lengths.iter().all(|length| (length * 15f64.to_radians().cos() / 0.4 - 1.0).abs() < 0.01), "{lengths:?}");
    // By noise each quantity has its own, smooth and repeating: neighbours are alike, across the border too.
    let noisy = grow(&GrowSettings {
        by_noise: ByNoise { cells: 2, amounts: Amounts { length: 0.8, thickness: 0.8, ..Amounts::default() } },
        ..even
    })
    .unwrap();
    let value = |strand: &Strand<'_>| [strand.arc_length(), f64::from(strand.radii[0])];
    let all: Vec<([f64; 2], [f64; 2])> = noisy.strands().map(|strand| (root(&strand), value(&strand))).collect();
    let span = |k: usize| all.iter().fold((f64::MAX, f64::MIN), |(low, high), (_, v)| (low.min(v[k]), high.max(v[k])));
    for k in 0..2 {
        let (low, high) = span(k);
        assert!(low < 0.7 * high, "{low} {high}");
        for (i, (p, a)) in all.iter().enumerate() {
            for (q, b) in all[..i].iter().filter(|(q, _)| shortest(p[0] - q[0]).hypot(shortest(p[1] - q[1])) < 0.04) {
                assert!((a[k] - b[k]).abs() < 0.3 * (high - low), "{p:?} {q:?}");
            }
        }
    }
    let (lengths, radii): (Vec<f64>, Vec<f64>) = all.iter().map(|(_, v)| (v[0], v[1])).unzip();
    assert!(correlation(&lengths, &radii).abs() < 0.7, "{}", correlation(&lengths, &radii));
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let [ma, mb] = [a, b].map(|v| mean(v.iter().copied()));
    let sum = |f: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(a, b)| f(a - ma, b - mb)).sum::<f64>();
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
}

#[test]
fn bends_and_tips_vary_by_hair_as_asked() {
    let settings = GrowSettings { count: 2000, lean: 20.0, bend_variation: 0.5, tip_variation: 0.5, tip_thickness: 0.5, ..free() };
    let tile = grow(&settings).unwrap();
    let leans: Vec<f64> = tile.strands().map(|strand| (way_of(&strand, 24) / tip(&strand)[2]).atan().to_degrees()).collect();
    let tips: Vec<f64> = tile.strands().map(|strand| f64::from(strand.radii[24] / strand.radii[0])).collect();
    for (values, middle) in [(&leans, 20.0), (&tips, 0.5)] {
        let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(low, high), &v| (low.min(v), high.max(v)));
        assert!((low / middle - 0.5).abs() < 0.01 && (high / middle - 1.5).abs() < 0.01, "{low} {high} of {middle}");
        assert!((mean(values.iter().copied()) / middle - 1.0).abs() < 0.02);
    }
}

/// Lengths go as 1 − v·u², so at a part z of the height there is left P(u² < (1 − z)/v) of the hair (K3), the longest 15 % trimmed to the height.
#[test]
fn density_falls_towards_the_tips_as_the_lengths_say() {
    let variation = 0.8;
    let tile = grow(&GrowSettings { count: 4000, length_variation: variation, ..free() }).unwrap();
    let scale = 1.0 / (1.0 - variation * 0.15 * 0.15);
    for part in [0.1, 0.25, 0.4, 0.6, 0.8, 0.95] {
        let there = tile.strands().filter(|strand| tip(strand)[2] >= part * 0.4).count() as f64 / 4000.0;
        let wanted = ((1.0 - part / scale) / variation).clamp(0.0, 1.0).sqrt();
        assert!((there - wanted).abs() < 0.025, "at {part}: {there}, not {wanted}");
    }
}

#[test]
fn bands_are_met_at_their_stops_and_mean_what_many_samples_do() {
    let stop = |along: f32, grey: f32| Stop { along, colour: [grey, 0.5 * grey, 0.1] };
    let bands = Bands::new(&[stop(0.1, 0.2), stop(0.5, 0.9), stop(0.5, 0.1), stop(0.8, 0.6)]).unwrap();
    assert_eq!(
        (bands.at(0.0), bands.at(0.1), bands.at(0.8), bands.at(1.0)),
        ([0.2, 0.1, 0.1], [0.2, 0.1, 0.1], [0.6, 0.3, 0.1], [0.6, 0.3, 0.1])
    );
    // Of two stops at one place the band begins with the later.
    assert_eq!(bands.at(0.5)[0], 0.1);
    for (from, to) in [(0.0, 1.0), (0.05, 0.3), (0.4, 0.6), (0.5, 0.55), (0.45, 0.5), (0.9, 0.95)] {
        let many = mean((0..4000).map(|i| f64::from(bands.at(from + (to - from) * (i as f32 + 0.5) / 4000.0)[0])));
        let closed = f64::from(bands.mean(from, to)[0]);
        assert!((many - closed).abs() < 5e-4, "{from} to {to}: {many} {closed}");
    }
    let settings = GrowSettings { bands, count: 50, colour_variation: 0.3, undercoat: Undercoat { count: 20, ..bare() }, ..free() };
    let tile = grow(&settings).unwrap();
    for (index, strand) in tile.strands().enumerate() {
        // The guard hairs have the bands, shaded as a whole; the down keeps its own two colours.
        assert_eq!(strand.bands.is_some(), index < 50);
        assert!(index >= 50 || strand.colour_at(0.3)[0] == (bands.at(0.3)[0] * strand.shade).clamp(0.0, 1.0));
        let ends = [(strand.root_colour, 0.0), (strand.tip_colour, 1.0)];
        assert!(ends.iter().all(|(colour, along)| (0..3).all(|c| (colour[c] - strand.colour_at(*along)[c]).abs() < 1e-6)));
    }
    assert!(tile.strands().any(|strand| strand.shade > 1.15) && tile.strands().any(|strand| strand.shade < 0.85));
}

#[test]
fn a_share_of_the_hair_is_white_and_opacity_falls_as_asked() {
    let opacity = Opacity { root: 1.0, tip: 0.4, variation: 0.5 };
    let settings = GrowSettings { count: 4000, white: 0.25, opacity, root_colour: [0.05; 3], tip_colour: [0.05; 3], ..free() };
    let tile = grow(&settings).unwrap();
    let white = tile.strands().filter(|strand| strand.colour_at(0.5)[0] > 0.4).count() as f64 / 4000.0;
    assert!((white - 0.25).abs() < 0.02, "{white}");
    assert!(!tile.is_opaque());
    for strand in tile.strands() {
        let [root, tip] = strand.opacity;
        assert!((0.5..=1.0).contains(&root) && (tip / root - 0.4).abs() < 1e-6 && (strand.opacity_at(0.5) - 0.7 * root).abs() < 1e-6);
    }
    let roots = mean(tile.strands().map(|strand| f64::from(strand.opacity[0])));
    assert!((roots - 0.75).abs() < 0.01, "{roots}");
    assert!(grow(&free()).unwrap().is_opaque());
}

/// A rod's shadow, dimmed: by its own opacity, by the products where two cross, once where it is crossed twice.
#[test]
fn light_passes_translucent_hair_in_part() {
    let rod = |x: f64| StrandSource {
        points: vec![[x, 0.5, 0.0], [x, 0.5, 0.4]],
        radii: vec![0.1; 2],
        root_colour: [1.0; 3],
        tip_colour: [1.0; 3],
    };
    let disc = std::f64::consts::PI * 0.01;
    let open = |rods: &[StrandSource], opacity: Opacity| {
        let tile = StrandTile::from_strands(0.4, rods).unwrap().tinted(Bands::default(), &opacity).unwrap();
        tile.transmittance([0.0, 0.0], 512).unwrap()
    };
    let half = Opacity { root: 0.5, tip: 0.5, variation: 0.0 };
    assert!((open(&[rod(0.3)], half) - (1.0 - 0.5 * disc)).abs() < 1e-3);
    assert!((open(&[rod(0.3), rod(0.3)], half) - (1.0 - 0.75 * disc)).abs() < 1e-3);
    assert!((open(&[rod(0.3), rod(0.7)], half) - (1.0 - disc)).abs() < 1e-3);
    // From its side a rod that fades from root to tip takes as much as its mean.
    let fading = StrandTile::from_strands(0.4, &[rod(0.3)]).unwrap();
    let fading = fading.tinted(Bands::default(), &Opacity { root: 1.0, tip: 0.0, variation: 0.0 }).unwrap();
    let seen = 1.0 - fading.transmittance([2.0, 0.0], 512).unwrap();
    let strip = 0.5 * 0.2 * 0.8;
    // Its ends are round: the root's half disc is whole, the tip's nothing; so is what the section's depth hides.
    assert!((seen - strip).abs() < 0.6 * disc, "{seen} {strip}");
}

#[test]
fn a_mix_keeps_shares_of_both_bit_for_bit() {
    let opacity = Opacity { tip: 0.5, ..Opacity::default() };
    let bands = Bands::new(&[Stop { along: 0.5, colour: [0.3; 3] }]).unwrap();
    let guard =
        grow(&GrowSettings { count: 200, bands, undercoat: Undercoat { count: 100, ..bare() }, seed: 1, ..GrowSettings::default() })
            .unwrap();
    let down = grow(&GrowSettings { count: 400, height: 0.2, opacity, undercoat: bare(), seed: 2, ..GrowSettings::default() }).unwrap();
    let both = mix([&guard, &down], [0.5, 0.25]).unwrap();
    assert_eq!(both.strand_count(), 100 + 50 + 100);
    assert_eq!(both.height(), guard.height());
    let kept = (0..100).chain(200..250).map(|i| guard.strand(i).unwrap()).chain((0..100).map(|i| down.strand(i).unwrap()));
    for (a, b) in both.strands().zip(kept) {
        assert_eq!(a, b);
    }
    // Guard hairs of the half stand as evenly as half as many grown would.
    let places: Vec<[f64; 2]> = both.strands().take(100).map(|strand| root(&strand)).collect();
    let apart = |a: &[f64; 2], b: &[f64; 2]| shortest(a[0] - b[0]).hypot(shortest(a[1] - b[1]));
    let nearest = |i: usize| (0..100).filter(|&j| j != i).map(|j| apart(&places[i], &places[j])).fold(f64::MAX, f64::min);
    let least = (0..100).map(nearest).fold(f64::MAX, f64::min);
    assert!(least > 0.6 * (1.0f64 / 200.0).sqrt(), "{least}");
    // None of one is the other; none of both is bald.
    assert!(mix([&guard, &down], [0.0, 1.0]).unwrap().strands().eq(down.strands()));
    assert_eq!(mix([&guard, &down], [0.0, 1.0]).unwrap().height(), down.height());
    let bald = mix([&guard, &down], [0.0, 0.0]).unwrap();
    assert_eq!((bald.strand_count(), bald.height()), (0, guard.height()));
    for shares in [[1.1, 0.0], [f64::NAN, 0.0], [0.0, -0.1]] {
        assert!(matches!(mix([&guard, &down], shares), Err(StrandError::OutOfRange { .. })));
    }
    // Doubled again and again there is too much of it at last.
    let mut many = grow(&GrowSettings { count: 40_000, steps: 1, ..free() }).unwrap();
    for _ in 0..4 {
        many = mix([&many, &many], [1.0, 1.0]).unwrap();
    }
    assert!(matches!(mix([&many, &many], [1.0, 1.0]), Err(StrandError::TooManyStrands { asked: 1_280_000, .. })));
}

/// Upright hairs on a lattice, one in each place given.
fn upright(places: &[[f64; 2]], points: usize) -> StrandTile {
    let hair = |&[x, y]: &[f64; 2]| StrandSource {
        points: (0..points).map(|k| [x, y, 0.5 * k as f64 / (points - 1) as f64]).collect(),
        radii: vec![0.005; points],
        root_colour: [0.5; 3],
        tip_colour: [0.5; 3],
    };
    StrandTile::from_strands(0.5, &places.iter().map(hair).collect::<Vec<_>>()).unwrap()
}

#[test]
fn hair_at_a_guide_is_the_guide() {
    let guides = [
        Guide { root: [0.25, 0.125], points: vec![[0.1, 0.0, 0.4], [0.3, 0.1, 0.6], [0.6, 0.3, 0.5]] },
        Guide { root: [-0.25, 7.5], points: vec![[-0.4, 0.2, 0.9]] },
        Guide { root: [0.5, 0.75], points: vec![[0.0, -0.2, 0.5], [0.0, -0.2, 1.1]] },
    ];
    let places = [[0.25, 0.125], [0.75, 0.5], [0.5, 0.75]];
    let tile = guided(&upright(&places, 129), &guides).unwrap();
    for (strand, guide) in tile.strands().zip(&guides) {
        let from = root(&strand);
        let heights = |p: &[f32; 3]| [(f64::from(p[0]) - from[0]) / 0.5, (f64::from(p[1]) - from[1]) / 0.5, f64::from(p[2]) / 0.5];
        let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt();
        assert!(apart(heights(&strand.points[128]), guide.points[guide.points.len() - 1]) < 1e-6);
        for point in &guide.points {
            let nearest = strand.points.iter().map(|p| apart(heights(p), *point)).fold(f64::MAX, f64::min);
            assert!(nearest < 0.01, "{nearest} heights from {point:?}");
        }
    }
    let top = tile.strands().flat_map(|strand| strand.points.iter()).fold(0.0f32, |top, p| top.max(p[2]));
    assert_eq!(tile.height(), f64::from(top));
}

#[test]
fn guides_whose_tips_are_linear_are_met_exactly_between_them() {
    // A lattice of guides in the middle of the tile, and hairs inside of it, away from those that have neighbours beyond.
    let tip = |x: f64, y: f64| [0.3 * x - 0.1 * y + 0.05, 0.2 * y + 0.1, 0.8 + 0.2 * x];
    let jitter = |k: i32| f64::from((k * 7919) % 13) / 13.0 * 0.05;
    let guides: Vec<Guide> = (0..8)
        .flat_map(|i| (0..8).map(move |j| [f64::from(i) / 8.0 + jitter(i + 9 * j), f64::from(j) / 8.0 + jitter(3 * i + j)]))
        .map(|[x, y]| Guide {
            root: [f64::from(x as f32), f64::from(y as f32)],
            points: vec![tip(f64::from(x as f32), f64::from(y as f32))],
        })
        .collect();
    let places: Vec<[f64; 2]> =
        (0..20).flat_map(|i| (0..20).map(move |j| [0.35 + 0.015 * f64::from(i), 0.35 + 0.015 * f64::from(j)])).collect();
    let tile = guided(&upright(&places, 3), &guides).unwrap();
    let mut most = 0.0f64;
    for strand in tile.strands() {
        let [x, y] = root(&strand);
        let wanted = tip(x, y);
        let got = [f64::from(strand.points[2][0]) - x, f64::from(strand.points[2][1]) - y, f64::from(strand.points[2][2])];
        most = (0..3).map(|axis| (got[axis] / 0.5 - wanted[axis]).abs()).fold(most, f64::max);
    }
    println!("reached: a linear field within {most:.0e} heights");
    assert!(most < 1e-6, "{most}");
}

#[test]
fn guides_shape_the_torus_without_a_seam() {
    let guides = [
        Guide { root: [0.1, 0.2], points: vec![[0.5, 0.0, 0.6]] },
        Guide { root: [0.6, 0.9], points: vec![[-0.5, 0.2, 0.8]] },
        Guide { root: [0.9, 0.4], points: vec![[0.0, 0.5, 0.4]] },
    ];
    let moved: Vec<Guide> = guides
        .iter()
        .zip([[3.0, -2.0], [-1.0, 0.0], [0.0, 5.0]])
        .map(|(g, [dx, dy])| Guide { root: [g.root[0] + dx, g.root[1] + dy], ..g.clone() })
        .collect();
    let step = 1.0 / 64.0;
    let places: Vec<[f64; 2]> = (0..64).flat_map(|i| (0..64).map(move |j| [step * f64::from(i), step * f64::from(j)])).collect();
    let hair = upright(&places, 2);
    let tile = guided(&hair, &guides).unwrap();
    let again = guided(&hair, &moved).unwrap();
    let tips: Vec<[f64; 3]> = tile
        .strands()
        .map(|strand| {
            let (from, to) = (root(&strand), tip(&strand));
            [to[0] - from[0], to[1] - from[1], to[2]]
        })
        .collect();
    let difference = tile
        .strands()
        .zip(again.strands())
        .map(|(a, b)| (0..3).map(|axis| f64::from((a.points[1][axis] - b.points[1][axis]).abs())).fold(0.0, f64::max))
        .fold(0.0, f64::max);
    assert!(difference < 1e-5, "{difference}");
    let jump = |a: usize, b: usize| (0..3).map(|axis| (tips[a][axis] - tips[b][axis]).abs()).fold(0.0, f64::max);
    let at = |i: usize, j: usize| (i % 64) * 64 + j % 64;
    let steps = |across: bool| (0..64).flat_map(move |i| (0..64).map(move |j| (i, j, if across { at(i + 1, j) } else { at(i, j + 1) })));
    let inner = [true, false]
        .map(|across| steps(across).filter(|&(i, j, _)| i < 63 && j < 63).map(|(i, j, next)| jump(at(i, j), next)).fold(0.0, f64::max));
    let seam = [true, false]
        .map(|across| steps(across).filter(|&(i, j, _)| i == 63 || j == 63).map(|(i, j, next)| jump(at(i, j), next)).fold(0.0, f64::max));
    for k in 0..2 {
        assert!(seam[k] <= 1.2 * inner[k] && inner[k] < 0.05, "{seam:?} {inner:?}");
    }
    // One guide alone shapes all hair alike.
    let alike = guided(&hair, &guides[..1]).unwrap();
    for strand in alike.strands() {
        let (from, to) = (root(&strand), tip(&strand));
        assert!((to[0] - from[0] - 0.25).abs() < 1e-6 && (to[1] - from[1]).abs() < 1e-6 && (to[2] - 0.3).abs() < 1e-6);
    }
    assert_eq!(guided(&hair, &[]).unwrap(), hair);
}

#[test]
fn curls_wind_about_their_guide() {
    let style = Style::Curly { radius: 0.05, turns: 3.0 };
    let curly = grow(&GrowSettings { style, count: 60, steps: 96, ..free() }).unwrap();
    let straight = grow(&GrowSettings { count: 60, steps: 96, ..free() }).unwrap();
    let guides = [
        Guide { root: [0.2, 0.3], points: vec![[0.0, 0.3, 0.7], [0.0, 0.9, 0.8]] },
        Guide { root: [0.7, 0.6], points: vec![[0.4, 0.4, 0.6]] },
    ];
    let (curled, ways) = (guided(&curly, &guides).unwrap(), guided(&straight, &guides).unwrap());
    for (strand, way) in curled.strands().zip(ways.strands()) {
        // As far from the straight hair's way as the helix is from its own: up to a diameter, and that far somewhere.
        let apart = |k: usize| (0..3).map(|axis| f64::from(strand.points[k][axis] - way.points[k][axis]).powi(2)).sum::<f64>().sqrt();
        let most = (0..=96).map(apart).fold(0.0, f64::max);
        assert!(most < 2.0 * 0.05 * 0.4 * 1.3 && most > 0.05 * 0.4, "{most}");
    }
}

#[test]
fn wrong_guides_are_named() {
    let hair = upright(&[[0.5, 0.5]], 2);
    let guide = |root: [f64; 2], points: Vec<[f64; 3]>| Guide { root, points };
    let up = || vec![[0.0, 0.0, 1.0]];
    let wrong = |guides: &[Guide]| guided(&hair, guides).unwrap_err();
    assert_eq!(
        wrong(&[guide([0.1, 0.1], up()), guide([0.2, 0.1], up()), guide([1.1, -2.9], up())]),
        StrandError::GuidesMeet { first: 0, second: 2 }
    );
    for (bad, point) in
        [([f64::NAN, 0.0, 1.0], 1), ([0.0, 0.0, -0.1], 1), ([9.0, 0.0, 1.0], 1), ([0.0, f64::INFINITY, 1.0], 1), ([0.0; 3], 1)]
    {
        assert_eq!(wrong(&[guide([0.5, 0.5], vec![bad])]), StrandError::BadGuide { guide: 0, point, limit: 8.0 }, "{bad:?}");
    }
    assert_eq!(wrong(&[guide([0.0, 0.0], up()), guide([f64::NAN, 0.0], up())]), StrandError::BadGuide { guide: 1, point: 0, limit: 8.0 });
    assert!(matches!(wrong(&[guide([0.0, 0.0], vec![])]), StrandError::ListLength { length: 0, least: 1, most: 64, .. }));
    assert!(matches!(wrong(&[guide([0.0, 0.0], vec![[0.0, 0.0, 1.0]; 65])]), StrandError::ListLength { length: 65, .. }));
    let many: Vec<Guide> = (0..1025).map(|k| guide([f64::from(k) / 2000.0, 0.0], up())).collect();
    assert!(matches!(wrong(&many), StrandError::ListLength { length: 1025, most: 1024, .. }));
    // At the ends all is well.
    assert!(guided(&hair, &many[..1024]).is_ok());
    assert!(guided(&hair, &[guide([0.0, 0.0], vec![[-8.0, 8.0, 8.0]; 64])]).is_ok());
    assert!(guided(&StrandTile::empty(0.3), &many[..3]).is_ok_and(|tile| tile.height() == 0.3));
}

#[test]
fn curls_are_measured_and_straight_hair_has_none() {
    let curls = |style: Style, thickness: f64| grow(&GrowSettings { style, thickness, steps: 96, ..free() }).unwrap().curls();
    let helix = curls(Style::Curly { radius: 0.05, turns: 4.0 }, 0.002).unwrap();
    assert!((helix.width / 0.04 - 1.0).abs() < 0.01 && (helix.rise / 0.1 - 1.0).abs() < 0.03 && helix.share == 1.0, "{helix:?}");
    let waves = curls(Style::Wavy { amplitude: 0.05, waves: 4.0 }, 0.002).unwrap();
    assert!((waves.width / 0.04 - 0.64).abs() < 0.1 && (waves.rise / 0.1 - 1.0).abs() < 0.15, "{waves:?}");
    assert_eq!(curls(Style::Straight, 0.002), None);
    // Half a turn is no curl, and one within the hair's own thickness is none that anybody sees.
    assert_eq!(curls(Style::Curly { radius: 0.05, turns: 0.4 }, 0.002), None);
    assert_eq!(curls(Style::Curly { radius: 0.001, turns: 4.0 }, 0.01), None);
    // Nor are the slight waves of the default coat.
    let default = grow(&GrowSettings { count: 100, ..GrowSettings::default() }).unwrap().curls();
    assert!(default.is_none_or(|curls| curls.share < 0.05), "{default:?}");
    assert_eq!(StrandTile::empty(0.3).curls(), None);
}

#[test]
fn any_number_of_threads_makes_the_same_bits() {
    let offset = Offset::Sine;
    let amounts = Amounts { length: 0.3, thickness: 0.3, colour: 0.3, tip: 0.3, bend: 0.3 };
    let settings = GrowSettings {
        count: 700,
        style: Style::Woolly { radius: 0.1, turns: 3.0, irregularity: 1.0 },
        gather: Gather::Clumpy { strength: 0.7, mess: 0.2, offset },
        by_noise: ByNoise { cells: 4, amounts },
        white: 0.2,
        ..GrowSettings::default()
    };
    let guides: Vec<Guide> = (0..9)
        .map(|k| Guide { root: [f64::from(k) * 0.137, f64::from(k) * 0.319], points: vec![[0.1, f64::from(k) * 0.1, 0.8]] })
        .collect();
    let all = || {
        let grown = grow(&settings).unwrap();
        let bent = guided(&grown, &guides).unwrap();
        mix([&grown, &bent], [0.5, 0.5]).unwrap()
    };
    let with = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(all);
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(8));
}

/// Every new parameter at both ends grows hair, and beyond them it is named.
#[test]
fn every_parameter_has_ends_and_beyond_them_is_named() {
    type Set = fn(&mut GrowSettings, f64);
    fn offset(settings: &mut GrowSettings, offset: Offset) {
        settings.gather = Gather::Clumpy { strength: 0.5, mess: 0.1, offset };
    }
    fn wool(settings: &mut GrowSettings, radius: f64, turns: f64, irregularity: f64) {
        settings.style = Style::Woolly { radius, turns, irregularity };
    }
    let table: [(&str, f64, f64, Set); 33] = [
        ("style.amplitude", 0.0, 1.0, |s, v| s.style = Style::Zigzag { amplitude: v, waves: 2.0 }),
        ("style.waves", 0.0, 64.0, |s, v| s.style = Style::Wavy { amplitude: 0.1, waves: v }),
        ("style.radius", 0.0, 1.0, |s, v| wool(s, v, 3.0, 0.5)),
        ("style.turns", 0.0, 64.0, |s, v| wool(s, 0.1, v, 0.5)),
        ("style.irregularity", 0.0, 1.0, |s, v| wool(s, 0.1, 3.0, v)),
        ("gather.strength", 0.0, 1.0, |s, v| s.gather = Gather::Spiky { strength: v, offset: Offset::Sine }),
        ("gather.strength", 0.0, 1.0, |s, v| s.gather = Gather::Clumpy { strength: v, mess: 0.1, offset: Offset::Sine }),
        ("gather.mess", 0.0, 1.0, |s, v| s.gather = Gather::Clumpy { strength: 0.5, mess: v, offset: Offset::Sine }),
        ("gather.offset.rate", -8.0, 8.0, |s, v| offset(s, Offset::Exponential { rate: v })),
        ("gather.offset.exponent", 0.1, 10.0, |s, v| offset(s, Offset::Power { exponent: v })),
        ("taper.exponent", 0.1, 10.0, |s, v| s.taper = Taper::Power { exponent: v }),
        ("taper.rate", -8.0, 8.0, |s, v| s.taper = Taper::Exponential { rate: v }),
        ("thickness_variation", 0.0, 0.95, |s, v| s.thickness_variation = v),
        ("tip_variation", 0.0, 1.0, |s, v| s.tip_variation = v),
        ("bend_variation", 0.0, 1.0, |s, v| (s.bend_variation, s.lean) = (v, 75.0)),
        ("white", 0.0, 1.0, |s, v| s.white = v),
        ("opacity.root", 0.0, 1.0, |s, v| s.opacity.root = v),
        ("opacity.tip", 0.0, 1.0, |s, v| s.opacity.tip = v),
        ("opacity.variation", 0.0, 1.0, |s, v| s.opacity.variation = v),
        ("by_noise.length", 0.0, 0.95, |s, v| s.by_noise.amounts.length = v),
        ("by_noise.thickness", 0.0, 0.95, |s, v| s.by_noise.amounts.thickness = v),
        ("by_noise.colour", 0.0, 1.0, |s, v| s.by_noise.amounts.colour = v),
        ("by_noise.tip", 0.0, 1.0, |s, v| s.by_noise.amounts.tip = v),
        ("by_noise.bend", 0.0, 1.0, |s, v| s.by_noise.amounts.bend = v),
        ("by_pattern.softness", 0.0, 1.0, |s, v| s.by_pattern.softness = v),
        ("by_pattern.length", 0.0, 0.95, |s, v| s.by_pattern.amounts.length = v),
        ("by_pattern.thickness", 0.0, 0.95, |s, v| s.by_pattern.amounts.thickness = v),
        ("by_pattern.colour", 0.0, 1.0, |s, v| s.by_pattern.amounts.colour = v),
        ("by_pattern.tip", 0.0, 1.0, |s, v| s.by_pattern.amounts.tip = v),
        ("by_pattern.bend", 0.0, 1.0, |s, v| s.by_pattern.amounts.bend = v),
        ("by_noise.cells", 1.0, 64.0, |s, v| {
            s.by_noise = ByNoise { cells: v as u32, amounts: Amounts { length: 0.5, ..Amounts::default() } }
        }),
        ("pattern.count", 1.0, 64.0, |s, v| s.by_pattern.pattern = Pattern::Checks { count: v as u32 }),
        ("pattern.along_s", 0.0, 64.0, |s, v| s.by_pattern.pattern = Pattern::Stripes { along_s: v as u32, along_t: 0 }),
    ];
    for (name, low, high, set) in table {
        let settings = |value: f64| {
            let mut settings = GrowSettings { count: 30, undercoat: Undercoat { count: 10, ..bare() }, ..GrowSettings::default() };
            set(&mut settings, value);
            settings
        };
        for value in [low, high] {
            let tile = grow(&settings(value)).unwrap_or_else(|error| panic!("{name} {value}: {error}"));
            assert!(
                tile.height() > 0.0 && tile.strands().all(|strand| strand.points.iter().flatten().all(|c| c.is_finite())),
                "{name} {value}"
            );
            assert!(tile.strands().all(|strand| strand.radii.iter().all(|r| r.is_finite() && *r >= 0.0)), "{name} {value}");
        }
        let whole = name.starts_with("pattern") || name.ends_with("cells");
        let beyond = if whole { vec![high + 1.0] } else { vec![low - 1e-3, high + 1e-3, f64::NAN, f64::INFINITY] };
        for value in beyond {
            match grow(&settings(value)) {
                Err(StrandError::OutOfRange { name: named, .. }) => assert_eq!(named, name),
                other => panic!("{name} {value}: {other:?}"),
            }
        }
    }
    let stop = |along: f32, grey: f32| Stop { along, colour: [grey; 3] };
    assert!(matches!(Bands::new(&[stop(0.0, 0.5); 9]), Err(StrandError::ListLength { name: "bands", length: 9, .. })));
    for wrong in [[stop(0.5, 0.5), stop(0.4, 0.5)], [stop(0.0, 0.5), stop(1.1, 0.5)], [stop(f32::NAN, 0.5), stop(0.4, 0.5)]] {
        assert!(matches!(Bands::new(&wrong), Err(StrandError::OutOfRange { name: "bands.along", .. })), "{wrong:?}");
    }
    assert!(matches!(Bands::new(&[stop(0.0, f32::NAN)]), Err(StrandError::OutOfRange { name: "bands.colour", .. })));
    assert!(matches!(Curve::new(&[]), Err(StrandError::ListLength { least: 1, .. })));
    assert!(matches!(Curve::new(&[1.0; 17]), Err(StrandError::ListLength { most: 16, .. })));
    assert!(matches!(Curve::new(&[1.0, f64::NAN]), Err(StrandError::OutOfRange { name: "taper.values", .. })));
}

fn any_offset() -> impl Strategy<Value = Offset> {
    prop_oneof![
        Just(Offset::Sine),
        (-8.0..=8.0).prop_map(|rate| Offset::Exponential { rate }),
        (0.1..=10.0).prop_map(|exponent| Offset::Power { exponent }),
    ]
}

fn any_gather() -> impl Strategy<Value = Gather> {
    prop_oneof![
        Just(Gather::Free),
        (0.0..=1.0, 0.0..=1.0, any_offset()).prop_map(|(strength, mess, offset)| Gather::Clumpy { strength, mess, offset }),
        (0.0..=1.0, any_offset()).prop_map(|(strength, offset)| Gather::Spiky { strength, offset }),
    ]
}

fn any_amounts() -> impl Strategy<Value = Amounts> {
    (0.0..=0.95, 0.0..=0.95, 0.0..=1.0, 0.0..=1.0, 0.0..=1.0).prop_map(|(length, thickness, colour, tip, bend)| Amounts {
        length,
        thickness,
        colour,
        tip,
        bend,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn whatever_type_is_in_range_grows_finite_hair_above_the_skin(
        wool in (0.0..=1.0, 0.0..=64.0, 0.0..=1.0),
        gather in any_gather(),
        (by_noise, by_pattern, cells, count) in (any_amounts(), any_amounts(), 1u32..=64, 1u32..=64),
        (guards, down, steps, seed) in (0u32..40, 0u32..40, 1u32..40, any::<u64>()),
        (variation, clump_size, lean) in (0.0..=1.0, 0.01..=1.0, 0.0..=75.0),
        roots in proptest::collection::vec((0.0..1.0, 0.0..1.0), 0..20),
    ) {
        let settings = GrowSettings {
            style: Style::Woolly { radius: wool.0, turns: wool.1, irregularity: wool.2 },
            gather, clump_size, lean, steps, seed, count: guards, tip_variation: variation, bend_variation: variation,
            by_noise: ByNoise { cells, amounts: by_noise },
            by_pattern: ByPattern { pattern: Pattern::Dots { count }, softness: variation, amounts: by_pattern },
            undercoat: Undercoat { count: down, ..Undercoat::default() },
            ..GrowSettings::default()
        };
        let tile = grow(&settings).unwrap();
        prop_assert!(tile.height().is_finite() && tile.height() > 0.0);
        let guides: Vec<Guide> = roots.iter().map(|&(x, y)| Guide { root: [x, y], points: vec![[x - 0.5, y - 0.5, 0.1 + x]] }).collect();
        let bent = guided(&tile, &guides).unwrap();
        for tile in [&tile, &bent] {
            for strand in tile.strands() {
                prop_assert!(strand.points.iter().flatten().all(|c| c.is_finite()));
                prop_assert!(strand.points.iter().all(|p| p[2] >= 0.0 && f64::from(p[2]) <= tile.height()));
                prop_assert!(strand.radii.iter().all(|r| r.is_finite() && *r >= 0.0));
                prop_assert!((0..=8).all(|k| strand.colour_at(k as f32 / 8.0).iter().all(|c| (0.0..=1.0).contains(c))));
            }
        }
    }

    #[test]
    fn types_moved_by_whole_tiles_keep_their_bits(gather in any_gather(), amounts in any_amounts(), seed in any::<u64>()) {
        let by_pattern = ByPattern { pattern: Pattern::Checks { count: 2 }, softness: 0.2, amounts };
        let settings = GrowSettings { count: 40, undercoat: bare(), gather, by_pattern, seed, ..GrowSettings::default() };
        let places: Vec<Root> = grow(&settings).unwrap().strands().map(|s| Root::new(f64::from(s.points[0][0]), f64::from(s.points[0][1])).unwrap()).collect();
        let home = grow_at(&settings, &places).unwrap();
        let away = grow_at(&settings, &places.iter().map(|root| root.moved([5, -1000])).collect::<Vec<_>>()).unwrap();
        prop_assert_eq!(away, home.moved([5, -1000]));
    }
}
