//! Frames that follow each other do not jump: the camera turned about fur, or moved away from it through all levels of detail.
#![allow(clippy::print_stdout, reason = "measures are shown with --nocapture")]

mod support;

use std::sync::Arc;

use glam::Vec3;
use pelage_coat::{Camera, Coat, MipImage, ShellTexture};
use pelage_render::{Detail, FinRule, LightingMode, March, Options, Picture, ShadowOptions, ShellDepth, View};

use support::samples::hair::{Hair, Recipe};
use support::samples::{Style, coat, light, shapes};
use support::stage::Stage;
use support::{SIZE, ball, difference, hair, mean_coverage, picture};

const ASPECT: f32 = SIZE.0 as f32 / SIZE.1 as f32;

fn seen(coat: &Coat, camera: Camera, options: Options) -> Picture {
    picture(coat, &View { options, ..View::new(camera, light(Vec3::new(0.5, 0.8, 0.6))) })
}

/// The largest change from picture to picture, and the median.
fn changes(pictures: &[Picture], of: impl Fn(&Picture, &Picture) -> f64) -> (f64, f64) {
    let mut changes: Vec<f64> = pictures.windows(2).map(|pair| of(&pair[0], &pair[1])).collect();
    changes.sort_by(f64::total_cmp);
    (changes[changes.len() - 1], changes[changes.len() / 2])
}

fn mean_change(a: &Picture, b: &Picture) -> f64 {
    difference(a, b).0
}

/// The camera turned about a coat by a third of a degree a frame.
fn turned(coat: &Coat, options: Options) -> Vec<Picture> {
    (0..48)
        .map(|step| {
            let camera = Camera::framing(Vec3::ZERO, 0.36, 0.3 + 0.0058 * step as f32, 0.2, 0.6, ASPECT, 1.0);
            seen(coat, camera, options)
        })
        .collect()
}

#[test]
fn fur_does_not_pop_when_the_camera_turns() {
    // Few faces and long fur, so that every fin counts.
    let coarse = coat(&shapes::sphere(4, 4.0), Style { length: 0.09, ..Style::default() }, &hair(6));
    for (what, shells) in [("fins alone", false), ("all", true)] {
        let of = |fin_rule| {
            let (most, median) = changes(&turned(&coarse, Options { fin_rule, shells, ..Options::default() }), mean_change);
            println!("{what}, {fin_rule:?}: largest change {most:.3} of 255, median {median:.3}, ratio {:.2}", most / median);
            most / median
        };
        let (paper, nvidia) = (of(FinRule::Faded), of(FinRule::Silhouette { threshold: 0.1 }));
        assert!(paper <= 2.0, "{what}: {paper}");
        assert!(nvidia > if shells { paper } else { 1.4 * paper }, "whole fins come and go at once: {nvidia}, {paper}");
    }
}

fn leveled(levels: bool) -> Hair {
    Recipe { layers: 8, resolution: 32, guard_hairs: 60, under_hairs: 100, radius: 0.03, levels, ..Recipe::default() }.grow()
}

fn leveled_ball() -> Coat {
    coat(&shapes::sphere(8, 4.0), Style { length: 0.05, ..Style::default() }, &leveled(true))
}

/// The ball so many times as far away as it fills the picture.
fn from(times: f32) -> Camera {
    Camera::framing(Vec3::ZERO, 0.36, 0.5, 0.2, 0.6, ASPECT, times)
}

/// The same picture of the ball, whatever the distance: the field of view narrows with it.
fn through_a_lens(times: f32) -> Camera {
    let camera = from(times);
    Camera { field_of_view: 2.0 * ((0.3_f32).tan() / times).atan(), ..camera }
}

/// The mean of the covered pixels' linear colour, weighted by coverage, and the mean coverage, as shares of 1.
fn colour_and_coverage(picture: &Picture, background: &Picture) -> ([f64; 3], f64) {
    let linear = |byte: u8| {
        let x = f64::from(byte) / 255.0;
        if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
    };
    let mut sums = [0.0; 3];
    let mut covered = 0.0;
    for (i, &coverage) in picture.coverage.iter().enumerate() {
        let part = f64::from(coverage) / 255.0;
        covered += part;
        for (c, sum) in sums.iter_mut().enumerate() {
            *sum += linear(picture.rgba[4 * i + c]) - (1.0 - part) * linear(background.rgba[4 * i + c]);
        }
    }
    (sums.map(|sum| sum / covered), covered / picture.coverage.len() as f64)
}

fn nothing(camera: Camera) -> Picture {
    seen(&ball(), camera, Options { surface: false, fins: false, shells: false, ..Options::default() })
}

#[test]
fn every_level_covers_and_colours_a_distant_ball_alike() {
    let coat = leveled_ball();
    let camera = through_a_lens(4.0);
    let background = nothing(camera);
    assert_eq!(coat.shells.levels.len(), 4);
    let at = |level: f32| seen(&coat, camera, Options { detail: Detail::Level(level), ..Options::default() });
    let finest = colour_and_coverage(&at(0.0), &background);
    for step in 1..=12 {
        let level = step as f32 / 4.0;
        let (colour, coverage) = colour_and_coverage(&at(level), &background);
        let off = colour.iter().zip(finest.0).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        println!("level {level}: coverage {:+.4} of {:.4}, colour within {:.1} %", coverage - finest.1, finest.1, 100.0 * off);
        // What stands out over the outline goes with the outermost shells. The colour is that of hair seen along itself, deeper down than one sees from
        // aside, and lit at its mean height; and the samples composite before they make mips, which loses light that pelage-volume keeps.
        let (most_coverage, most_colour) = [(0.005, 0.07), (0.008, 0.14), (0.06, 0.36)][(level.ceil() as usize).max(1) - 1];
        assert!((coverage - finest.1).abs() < most_coverage, "level {level}: coverage {coverage}, not {}", finest.1);
        assert!(off < most_colour, "level {level}: colour off by {off}");
    }
}

#[test]
fn a_whole_level_is_its_own_shells_and_nothing_else() {
    let coat = leveled_ball();
    for level in 0..4_u8 {
        let mut alone = coat.clone();
        alone.shells = Arc::new(ShellTexture { levels: vec![coat.shells.levels[usize::from(level)].clone()], ..(*coat.shells).clone() });
        let options = Options { fins: false, detail: Detail::Level(level.into()), ..Options::default() };
        let (chain, single) = (seen(&coat, from(1.0), options), seen(&alone, from(1.0), options));
        assert!(chain.rgba == single.rgba && chain.coverage == single.coverage, "level {level}");
        assert_eq!(chain.frame.shells_drawn, [7, 3, 1, 0][usize::from(level)]);
        assert_eq!(chain.frame.level, f32::from(level));
    }
}

#[test]
fn levels_meet_where_one_becomes_the_next() {
    let coat = leveled_ball();
    // Where a level's shells can be told apart, which blur must not tell, and nearer.
    for camera in [from(1.0), from(0.6)] {
        for level in [1.0_f32, 2.0, 3.0] {
            let at = |level| seen(&coat, camera, Options { fins: false, detail: Detail::Level(level), ..Options::default() });
            let (mean, most) = difference(&at(level - 1e-3), &at(level));
            assert!(mean < 0.02 && most <= 3, "level {level}: {mean} {most}");
            let (mean, most) = difference(&at(level), &at(level + 0.4));
            assert!(mean == 0.0 && most == 0, "a level is drawn as it is for a part of the way: {level}: {mean} {most}");
            let (mean, _) = difference(&at(level - 1.0), &at(level));
            assert!(mean > 0.5, "there is something to blend: {mean}");
        }
    }
}

/// The same with a direction for each image, no two alike, and hair that is cut here and there.
fn mapped_and_cut(coat: &Coat) -> Coat {
    let mut changed = coat.clone();
    let direction = |image: u32| [(128 + 37 * image) as u8, (60 + 91 * image) as u8, (200 + 53 * image) as u8, 0];
    let map = |mip: &MipImage| {
        let texels = (0..coat.shells.images).flat_map(|image| direction(image).repeat((mip.width * mip.height) as usize));
        MipImage { texels: texels.collect(), ..*mip }
    };
    changed.shells = Arc::new(ShellTexture { directions: Some(coat.shells.mips.iter().map(map).collect()), ..(*coat.shells).clone() });
    for (end, place) in changed.surface.ends.iter_mut().zip(&coat.surface.positions) {
        *end = (0.55 + 3.0 * place.y).clamp(0.05, 1.0);
    }
    changed
}

#[test]
fn levels_meet_whatever_the_options() {
    let coat = mapped_and_cut(&leveled_ball());
    let plain = Options { fins: false, ..Options::default() };
    let cases = [
        ("cut", plain),
        ("shaded by hair", Options { hair_shadow: 1.0, ..plain }),
        ("lit from the map", Options { lighting: LightingMode::Formula, ..plain }),
        ("without blur", Options { step_blur: 0.0, ..plain }),
        ("shadows", Options { shadows: Some(ShadowOptions { side: 256 }), ..plain }),
        ("stepped", Options { march: March { layers: 1, steps: 3 }, ..plain }),
        ("marched", Options { march: March { layers: 2, steps: 1 }, ..plain }),
        ("marched by four", Options { march: March { layers: 4, steps: 1 }, ..plain }),
    ];
    for (what, options) in cases {
        for camera in [from(1.0), from(0.6)] {
            for level in [1.0_f32, 2.0, 3.0] {
                let at = |level| seen(&coat, camera, Options { detail: Detail::Level(level), ..options });
                let (mean, most) = difference(&at(level - 1e-3), &at(level));
                let whole = difference(&at(level - 1.0), &at(level)).0;
                assert!(mean < 0.02 && most <= 3, "{what}, level {level}: {mean} {most}");
                assert!(whole > 0.5, "there is something to blend: {whole}");
                // The blend begins as smoothly.
                let (mean, most) = difference(&at(level - 0.5), &at(level - 0.5 + 2e-3));
                assert!(mean < 0.02 && most <= 3, "{what}, level {level}, where its blend begins: {mean} {most}");
            }
        }
    }
}

#[test]
fn a_view_that_moves_through_levels_is_as_if_made_anew() {
    let stage = Stage::plain();
    let coat = stage.upload(&leveled_ball());
    let at = |level, times| View {
        options: Options { detail: Detail::Level(level), shadows: Some(ShadowOptions { side: 64 }), ..Options::default() },
        ..View::new(from(times), light(Vec3::new(0.5, 0.8, 0.6)))
    };
    let mut prepared = stage.prepare(&coat, &at(0.8, 1.0));
    let first = stage.frame(&prepared);
    assert!(stage.frame(&prepared) == first);
    for view in [at(0.9, 1.0), at(1.7, 1.0), at(1.0, 1.0), at(0.9, 60.0), at(0.9, 1.0), at(0.8, 1.0)] {
        stage.update(&mut prepared, &view);
        assert!(stage.frame(&prepared) == stage.frame(&stage.prepare(&coat, &view)), "{:?}", view.options.detail);
    }
    assert!(stage.frame(&prepared) == first);
}

#[test]
fn fins_fade_away_with_the_last_shell() {
    let coat = leveled_ball();
    let fins = |level: f32| {
        let only = Options { surface: false, shells: false, detail: Detail::Level(level), ..Options::default() };
        let picture = seen(&coat, from(1.0), only);
        (mean_coverage(&picture), picture.frame.fins_drawn)
    };
    let whole = fins(0.0);
    assert_eq!((fins(1.5), fins(2.0)), (whole, whole));
    for part in [0.25, 0.5, 0.75] {
        let (covered, drawn) = fins(2.0 + part);
        // Where fins stand before each other, less than that goes.
        let left = covered / whole.0 - f64::from(1.0 - part);
        assert!((-0.01..0.12).contains(&left) && drawn == whole.1, "{part}: {covered} of {}", whole.0);
    }
    assert_eq!(fins(3.0), (0.0, 0));
    // Without coarser levels they never do.
    assert!(seen(&ball(), from(60.0), Options { detail: Detail::Level(9.0), ..Options::default() }).frame.fins_drawn > 0);
}

#[test]
fn bare_skin_is_of_one_colour_at_every_level() {
    let mut coat = leveled_ball();
    let bald = |coat: &Coat, level| {
        seen(coat, from(1.0), Options { length_scale: 0.0, fins: false, detail: Detail::Level(level), ..Options::default() })
    };
    let finest = bald(&coat, 0.0);
    for level in [0.8, 1.0, 2.3, 3.0] {
        assert!(bald(&coat, level).rgba == finest.rgba, "level {level}");
    }
    coat.surface.offsets.fill(Vec3::ZERO);
    let frame = seen(&coat, from(1.0), Options::default());
    assert!(frame.rgba == finest.rgba && frame.frame.level == 3.0, "without length the coarsest level is chosen");
}

#[test]
fn the_further_the_fewer_shells_are_drawn() {
    let coat = leveled_ball();
    let frames: Vec<_> = (0..30).map(|step| seen(&coat, from(1.25_f32.powi(step)), Options::default()).frame).collect();
    assert!(frames.windows(2).all(|pair| pair[1].level >= pair[0].level), "{frames:?}");
    assert!(frames.windows(2).all(|pair| pair[1].shells_drawn <= pair[0].shells_drawn), "{frames:?}");
    assert_eq!((frames[0].shells_drawn, frames[0].level), (7, 0.0));
    assert_eq!((frames[29].shells_drawn, frames[29].level), (0, 3.0));
    // Every level is met, and shells are where they are asked to be: a quarter of a pixel apart or more.
    assert_eq!(
        frames.iter().map(|frame| frame.shells_drawn).collect::<std::collections::BTreeSet<_>>().into_iter().collect::<Vec<_>>(),
        [0, 1, 3, 7]
    );
    // Half as far apart, half as soon: the level is one less.
    let level = |pixels| seen(&coat, from(6.0), Options { detail: Detail::Spacing(pixels), ..Options::default() }).frame.level;
    assert!((level(0.6) - level(0.3) - 1.0).abs() < 1e-4 && level(0.0) == 0.0, "{} {}", level(0.6), level(0.3));
}

#[test]
fn a_dolly_out_through_all_levels_does_not_pop() {
    let coat = leveled_ball();
    // Through a lens that follows, the ball stays as large as it is, and nothing changes but the level: by as much as it does when one goes back by 3 % a step.
    let camera = through_a_lens(4.0);
    let background = nothing(camera);
    let at = |step: usize| seen(&coat, camera, Options { detail: Detail::Level(3.0 * step as f32 / 70.0), ..Options::default() });
    let pictures: Vec<Picture> = (0..=70).map(at).collect();
    let measures: Vec<_> = pictures.iter().map(|picture| colour_and_coverage(picture, &background)).collect();
    let step = |of: &dyn Fn(usize) -> f64| (1..measures.len()).map(|i| (of(i) - of(i - 1)).abs()).fold(0.0, f64::max);
    let coverage = step(&|i| measures[i].1);
    let colour = (0..3).map(|c| step(&|i| measures[i].0[c] / measures[0].0[c])).fold(0.0, f64::max);
    println!("a step changes coverage by {coverage:.4}, colour by {:.2} % at most", 100.0 * colour);
    assert!(coverage < 0.006, "coverage jumps by {coverage}");
    assert!(colour < 0.035, "colour jumps by {colour}");
    // Pixel by pixel: no step is more than a fair part of the way from first to last.
    let whole = mean_change(&pictures[0], &pictures[pictures.len() - 1]);
    let most = changes(&pictures, mean_change).0;
    println!("a step changes pixels by {most:.3} at most, all steps together by {whole:.3}, of 255");
    assert!(most < 0.1 * whole, "{most} of {whole}");
}

#[test]
fn a_real_dolly_out_does_not_pop_either() {
    let coat = leveled_ball();
    // Coarser than by default, so that all levels are met while the ball is large enough to be measured.
    let options = Options { detail: Detail::Spacing(1.0), ..Options::default() };
    let pictures: Vec<Picture> = (0..=64).map(|step| seen(&coat, from(1.03_f32.powi(step)), options)).collect();
    assert!(pictures[64].frame.level == 3.0 && pictures[0].frame.level < 0.6, "{} {}", pictures[0].frame.level, pictures[64].frame.level);
    // The covered area falls as the square of the distance does, from step to step by the same factor.
    let factors: Vec<f64> = pictures.windows(2).map(|pair| mean_coverage(&pair[1]) / mean_coverage(&pair[0])).collect();
    let expected = 1.0 / 1.03_f64.powi(2);
    let most = factors.iter().map(|factor| (factor / expected - 1.0).abs()).fold(0.0, f64::max);
    println!("the covered area is off its course by {:.2} % a step at most", 100.0 * most);
    assert!(most < 0.05, "{most}: {factors:?}");
    // Colour goes on evenly, too, where levels that change at once let it jump.
    let jump = |pictures: &[Picture]| {
        let colour = |step: usize| colour_and_coverage(&pictures[step], &nothing(from(1.03_f32.powi(step as i32)))).0;
        (1..pictures.len()).map(|step| (colour(step)[0] / colour(step - 1)[0] - 1.0).abs()).fold(0.0, f64::max)
    };
    let at_once = Options { detail: Detail::Whole(1.0), ..options };
    let jumping: Vec<Picture> = (0..=64).map(|step| seen(&coat, from(1.03_f32.powi(step)), at_once)).collect();
    let (blended, whole) = (jump(&pictures), jump(&jumping));
    println!("a step changes colour by {:.2} % at most, {:.2} % where levels change at once", 100.0 * blended, 100.0 * whole);
    assert!(blended < 0.5 * whole, "{blended} {whole}");
}

#[test]
fn levels_blend_as_images_blended_on_the_processor_do() {
    // Tiles so small that what is seen of them is down their mips, by little or far. By hand the step to the next shell, and what follows from it, is the finer level's.
    for (tiles, level, most_mean, most_all) in [(16.0, 0.8, 0.25, 8), (24.0, 0.6, 0.1, 4), (60.0, 0.8, 0.1, 4)] {
        let coat = coat(&shapes::sphere(8, tiles), Style { length: 0.05, ..Style::default() }, &leveled(true));
        for times in [2.0, 5.0, 9.0] {
            let options = |level| Options { detail: Detail::Level(level), fins: false, ..Options::default() };
            let blended = seen(&coat, through_a_lens(times), options(level));
            let made = seen(&by_hand(&coat, level), through_a_lens(times), options(0.0));
            let (mean, most) = difference(&blended, &made);
            println!("{tiles} tiles, {times} times as far: {mean:.4} {most}");
            assert!(mean < most_mean && most <= most_all, "{tiles} tiles, {times}: {mean} {most}");
        }
    }
}

/// The coat with the images that a fractional level blends made on the processor, with all mips.
fn by_hand(coat: &Coat, level: f32) -> Coat {
    let t = (level.fract() - 0.5) / 0.5;
    let blend = t * t * (3.0 - 2.0 * t);
    let (fine, coarse) = (&coat.shells.levels[0], &coat.shells.levels[1]);
    let mut stack = (*coat.shells).clone();
    let mut shells = fine.clone();
    for mip in &mut stack.mips {
        let size = 4 * (mip.width * mip.height) as usize;
        let source = mip.texels.clone();
        for (k, shell) in shells.iter_mut().enumerate() {
            let into = (k % 2 == 0).then(|| coarse[k / 2]);
            let at = fine[k].image as usize * size;
            for texel in (0..size).step_by(4) {
                let linear = |from: usize| support::decode([source[from], source[from + 1], source[from + 2], source[from + 3]]);
                let (a, b) = (linear(at + texel), into.map_or([0.0; 4], |into| linear(into.image as usize * size + texel)));
                let mixed = std::array::from_fn(|c| a[c] + blend * (b[c] - a[c]));
                mip.texels[at + texel..at + texel + 4].copy_from_slice(&support::samples::hair::encode(mixed));
            }
            if let Some(into) = into {
                shell.light_height = fine[k].light_height + blend * (into.light_height - fine[k].light_height);
            }
        }
    }
    stack.levels = vec![shells];
    Coat { shells: Arc::new(stack), ..coat.clone() }
}

#[test]
fn opacity_that_is_shared_follows_the_power_law() {
    // One image for all shells, each of which stands for so many layers at so much of its opacity.
    let alpha = 90.0_f32 / 255.0;
    let texel = support::samples::hair::encode([0.4 * alpha, 0.3 * alpha, 0.2 * alpha, alpha]);
    let image = MipImage { width: 1, height: 1, texels: texel.to_vec() };
    let mut most = 0.0_f32;
    for layers in [0.0, 0.25, 1.0, 3.5] {
        for opacity in [0.0, 0.3, 1.0] {
            let mut stack = ShellTexture::stack(1, vec![image.clone()]);
            let shell = |height| pelage_coat::ShellLayer { layers, opacity, ..pelage_coat::ShellLayer::plain(height, 0) };
            stack.levels = vec![vec![shell(0.0), shell(0.5), shell(1.0)]];
            let mut coat = coat(&shapes::square(2, 3.0), Style::default(), &hair(2));
            coat.shells = Arc::new(stack);
            let camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.4, near: 0.1 };
            let options = Options { surface: false, fins: false, shell_depth: ShellDepth::Tested, ..Options::default() };
            let covered = seen(&coat, camera, options).coverage[(SIZE.1 / 2 * SIZE.0 + SIZE.0 / 2) as usize];
            let one = 1.0 - (1.0 - alpha * opacity).powf(layers);
            let expected = 255.0 * (1.0 - (1.0 - one).powi(2));
            assert!((f32::from(covered) - expected).abs() < 1.5, "{layers} layers of {opacity}: {covered}, not {expected}");
            most = most.max((f32::from(covered) - expected).abs());
        }
    }
    println!("reached: {most:.1} of 255");
}
