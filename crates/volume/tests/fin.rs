//! What a fin promises.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use pelage_strand::{GrowSettings, StrandSource, StrandTile, grow};
use pelage_volume::{FinAcross, FinSettings, FinTexture, VolumeError, sample_fin, srgb_to_linear};

fn hair(points: Vec<[f64; 3]>, radius: f64, colour: [f32; 3]) -> StrandSource {
    StrandSource { radii: vec![radius; points.len()], points, root_colour: colour, tip_colour: colour }
}

fn row(fin: &FinTexture, y: u32) -> f64 {
    let mip = &fin.mips[0];
    (0..mip.width).map(|x| f64::from(mip.texel(0, x, y).unwrap()[3])).sum::<f64>() / (255.0 * f64::from(mip.width))
}

#[test]
fn levels_halve_down_to_one_texel() {
    let fin = sample_fin(&grow(&GrowSettings::default()).unwrap(), &FinSettings::default()).unwrap();
    let sides: Vec<(u32, u32)> = fin.mips.iter().map(|mip| (mip.width, mip.height)).collect();
    assert_eq!(sides, [(512, 64), (256, 32), (128, 16), (64, 8), (32, 4), (16, 2), (8, 1), (4, 1), (2, 1), (1, 1)]);
    assert_eq!((fin.byte_size(), fin.level_bytes()[0]), (174_780, 131_072));
    let full = fin.mips[0].mean_coverage(0);
    assert!(fin.mips.iter().all(|mip| (mip.mean_coverage(0) - full).abs() < 1.0 / 255.0));
}

#[test]
fn a_fin_is_dense_at_the_skin_and_ragged_at_the_tips() {
    let fin = sample_fin(&grow(&GrowSettings::default()).unwrap(), &FinSettings::default()).unwrap();
    assert!(row(&fin, 63) > 0.9, "{}", row(&fin, 63));
    assert!(row(&fin, 0) < 0.15, "{}", row(&fin, 0));
    let quarters = [0, 16, 32, 48].map(|first| (first..first + 16).map(|y| row(&fin, y)).sum::<f64>());
    assert!(quarters.windows(2).all(|pair| pair[1] > pair[0]), "{quarters:?}");
    // Each tile of the width shows another slab.
    let third = |n: u32| -> Vec<u8> { (n * 170..(n + 1) * 170).map(|x| fin.mips[0].texel(0, x, 40).unwrap()[3]).collect() };
    let filled = |n: u32| third(n).iter().filter(|&&byte| byte > 127).count();
    assert!((0..3).all(|n| filled(n) > 100) && third(0) != third(1) && third(1) != third(2));
    // Tips end at different heights: the highest covered row differs along the fin.
    let mip = &fin.mips[0];
    let top = |x: u32| (0..64).find(|&y| mip.texel(0, x, y).unwrap()[3] > 127).unwrap_or(64);
    let tops: Vec<u32> = (0..512).map(top).collect();
    assert!(tops.iter().any(|&y| y < 8) && tops.iter().any(|&y| y > 24));
}

#[test]
fn one_hair_covers_its_area() {
    // 0.01 wide and 0.4 high in a picture 3 tiles by 0.5: whatever the texels, 0.004 / 1.5 of it.
    for (radius, width, height) in [(0.005, 512, 64), (0.005, 64, 16), (0.0005, 2048, 512)] {
        let tile = StrandTile::from_strands(0.5, &[hair(vec![[0.3, 0.02, 0.05], [0.3, 0.02, 0.25], [0.3, 0.02, 0.45]], radius, [1.0; 3])])
            .unwrap();
        let fin = sample_fin(&tile, &FinSettings { width, height, ..FinSettings::default() }).unwrap();
        // The slab of one tile of three holds the root.
        let area = 2.0 * radius * 0.4 / 1.5;
        let covered = fin.mips[0].mean_coverage(0);
        assert!((covered / area - 1.0).abs() < 0.05, "{covered} of {area} at {width} × {height}");
    }
}

#[test]
fn nearer_hair_hides_hair_behind_it() {
    let red = hair(vec![[0.5, 0.01, 0.0], [0.5, 0.01, 0.4]], 0.05, [1.0, 0.0, 0.0]);
    let green = hair(vec![[0.5, 0.03, 0.0], [0.5, 0.03, 0.4]], 0.05, [0.0, 1.0, 0.0]);
    for sources in [[red.clone(), green.clone()], [green, red]] {
        let tile = StrandTile::from_strands(0.4, &sources).unwrap();
        let fin = sample_fin(&tile, &FinSettings { tiles_across: 1, ..FinSettings::default() }).unwrap();
        let middle = fin.mips[0].texel(0, 256, 32).unwrap();
        assert!(middle[3] == 255 && srgb_to_linear(middle[0]) > 0.99 && middle[1] < 10, "{middle:?}");
    }
}

#[test]
fn a_fin_wraps_across_and_shows_the_asked_profile() {
    // Hair over the right border comes in at the left.
    let tile = StrandTile::from_strands(0.4, &[hair(vec![[0.99, 0.01, 0.0], [1.09, 0.01, 0.4]], 0.01, [1.0; 3])]).unwrap();
    let fin = sample_fin(&tile, &FinSettings { tiles_across: 1, ..FinSettings::default() }).unwrap();
    let covered = |x: u32, y: u32| fin.mips[0].texel(0, x, y).unwrap()[3] > 200;
    assert!(covered(507, 63) && covered((0.09 * 512.0) as u32 - 1, 0));
    // Leaning along t shows as leaning to the right in profile only.
    let leaning = grow(&GrowSettings { lean: 30.0, splay: 0.0, ..GrowSettings::default() }).unwrap();
    let strand = leaning.strand(0).unwrap();
    let one = hair(strand.points.iter().map(|p| p.map(f64::from)).collect(), 0.01, [1.0; 3]);
    let tile = StrandTile::from_strands(leaning.height(), &[one]).unwrap();
    let centre = |across: FinAcross, y: u32| {
        let fin = sample_fin(&tile, &FinSettings { across, slab_width: 1.0, tiles_across: 1, ..FinSettings::default() }).unwrap();
        let angle = |x: u32| std::f64::consts::TAU * (f64::from(x) + 0.5) / 512.0;
        let weight = |x: u32| f64::from(fin.mips[0].texel(0, x, y).unwrap()[3]);
        let sums = (0..512).fold([0.0; 2], |sum, x| [sum[0] + weight(x) * angle(x).cos(), sum[1] + weight(x) * angle(x).sin()]);
        sums[1].atan2(sums[0]) / std::f64::consts::TAU
    };
    let lean = |across| (centre(across, 24) - centre(across, 60) + 0.5).rem_euclid(1.0) - 0.5;
    assert!(lean(FinAcross::T) > 0.05, "{}", lean(FinAcross::T));
    assert!(lean(FinAcross::S).abs() < 0.5 * lean(FinAcross::T));
}

#[test]
fn a_wider_slab_is_denser_and_threads_change_nothing() {
    let tile = grow(&GrowSettings::default()).unwrap();
    let cover =
        |slab_width: f64| sample_fin(&tile, &FinSettings { slab_width, ..FinSettings::default() }).unwrap().mips[0].mean_coverage(0);
    assert!(cover(0.02) < cover(0.05) && cover(0.05) < cover(0.2));
    let with = |threads: usize| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| sample_fin(&tile, &FinSettings::default()))
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(8));
}

#[test]
fn settings_out_of_range_are_named() {
    let tile = StrandTile::empty(0.3);
    let wrong = |settings: FinSettings| sample_fin(&tile, &settings).unwrap_err();
    assert!(matches!(
        wrong(FinSettings { height: 60, ..FinSettings::default() }),
        VolumeError::NotPowerOfTwo { name: "height", nearest: 64, .. }
    ));
    assert!(matches!(wrong(FinSettings { slab_width: 0.0, ..FinSettings::default() }), VolumeError::OutOfRange { name: "slab_width", .. }));
    assert!(matches!(
        wrong(FinSettings { tiles_across: 0, ..FinSettings::default() }),
        VolumeError::OutOfRange { name: "tiles_across", .. }
    ));
    assert!(sample_fin(&tile, &FinSettings::default()).unwrap().mips.iter().all(|mip| mip.texels.iter().all(|&byte| byte == 0)));
}
