//! Properties of pictures, whatever the adapter.

mod support;

use std::sync::Arc;

use glam::Vec3;
use pelage_coat::{Camera, MipImage, ShellTexture};
use pelage_render::{Headless, LightingMode, Options, ShellDepth, ShellRange, View, render_picture};

use support::samples::hair::{Recipe, encode};
use support::samples::{Style, background, coat, light, shapes};
use support::{SIZE, ball, brightness, difference, hair, headless, mean_coverage, picture, sampled, view};

/// Nothing, with crisp layers where a test adds some.
fn nothing() -> Options {
    Options { surface: false, fins: false, shells: false, shell_depth: ShellDepth::Tested, step_blur: 0.0, ..Options::default() }
}

#[test]
fn the_background_is_untouched_where_nothing_is() {
    let (empty, furry) = (picture(&ball(), &view(nothing())), picture(&ball(), &view(Options::default())));
    assert!(empty.coverage.iter().all(|&c| c == 0));
    let mut bare = 0;
    for (i, &coverage) in furry.coverage.iter().enumerate() {
        if coverage == 0 {
            assert_eq!(empty.rgba[4 * i..4 * i + 4], furry.rgba[4 * i..4 * i + 4]);
            bare += 1;
        }
    }
    assert!(bare > 1000 && bare < furry.coverage.len() - 1000, "{bare}");
    // The ramp: lighter at the top, the same along a row but for the dither, which is there and at most a step.
    assert!(empty.rgba[0] > empty.rgba[empty.rgba.len() - 4]);
    let spread = |row: &[u8]| {
        let reds = row.iter().step_by(4);
        reds.clone().max().zip(reds.min()).map_or(0, |(most, least)| most - least)
    };
    let spreads: Vec<u8> = empty.rgba.chunks_exact(4 * SIZE.0 as usize).map(spread).collect();
    assert_eq!(spreads.iter().max(), Some(&1), "{spreads:?}");
}

#[test]
fn fur_without_length_is_bald_exactly() {
    let furry = ball();
    let mut bare = furry.clone();
    bare.surface.offsets.fill(Vec3::ZERO);
    let bald = picture(&bare, &view(Options { fins: false, shells: false, ..Options::default() }));
    assert!(picture(&bare, &view(Options::default())).rgba == bald.rgba);
    let scaled = picture(&furry, &view(Options { length_scale: 0.0, ..Options::default() }));
    assert!(scaled.rgba == bald.rgba && scaled.coverage == bald.coverage);
    assert_eq!((scaled.frame.shells_drawn, scaled.frame.fins_drawn), (0, 0));
    let with_fur = picture(&furry, &view(Options::default()));
    assert!(difference(&with_fur, &bald).0 > 5.0);
    assert_eq!(with_fur.frame.shells_drawn, 7);
}

#[test]
fn fur_grows_without_a_jump() {
    let at = |length_scale| picture(&ball(), &view(Options { length_scale, ..Options::default() }));
    let (mean, most) = difference(&at(0.0), &at(1e-4));
    assert!(mean < 0.5 && most < 16, "{mean} {most}");
}

#[test]
fn bare_parts_stay_bare() {
    let mut coat = ball();
    for (offset, position) in coat.surface.offsets.iter_mut().zip(&coat.surface.positions) {
        if position.x < 0.0 {
            *offset = Vec3::ZERO;
        }
    }
    let left = Camera::framing(Vec3::ZERO, 0.36, -1.571, 0.0, 0.6, SIZE.0 as f32 / SIZE.1 as f32, 1.0);
    let seen = |options| picture(&coat, &View { options, ..View::new(left, light(Vec3::new(-1.0, 1.0, 0.5))) });
    let (all, skin) = (seen(Options::default()), seen(Options { shells: false, fins: false, ..Options::default() }));
    let middle = 4 * (SIZE.1 as usize / 2 * SIZE.0 as usize + SIZE.0 as usize / 2);
    assert_eq!(all.rgba[middle..middle + 4], skin.rgba[middle..middle + 4]);
    // Faces without a furred corner are not submitted as shells.
    let offset = |corner: &u32| coat.surface.offsets[coat.patches.vertices[*corner as usize] as usize];
    let furred = coat.patches.faces.iter().filter(|face| face.iter().any(|corner| offset(corner) != Vec3::ZERO)).count();
    assert!(furred < coat.patches.faces.len());
    let shells = seen(Options { surface: false, fins: false, culling: false, ..Options::default() }).frame;
    assert_eq!(shells.triangles, 7 * furred as u64);
}

#[test]
fn the_side_away_from_the_light_is_darker() {
    let front = Camera::framing(Vec3::ZERO, 0.36, 0.0, 0.0, 0.6, SIZE.0 as f32 / SIZE.1 as f32, 1.0);
    for lighting in [LightingMode::PerVertex, LightingMode::Formula, LightingMode::Table(Default::default())] {
        let lit = picture(
            &ball(),
            &View { options: Options { lighting, ..Options::default() }, ..View::new(front, light(Vec3::new(1.0, 0.2, 0.3))) },
        );
        let (right, left) = (brightness(&lit, |x, _| x > SIZE.0 / 2 + 8), brightness(&lit, |x, _| x < SIZE.0 / 2 - 8));
        assert!(right > 1.2 * left, "{lighting:?}: lit {right}, away {left}");
    }
}

/// Layers of one even opacity each, all of which together let `through` of the light pass.
fn even_layers(layers: u32, through: f64) -> (ShellTexture, f64) {
    let alpha = (1.0 - through.powf(1.0 / f64::from(layers - 1))) as f32;
    let texel = encode([0.5 * alpha, 0.5 * alpha, 0.5 * alpha, alpha]);
    let covered = 1.0 - (1.0 - f64::from(texel[3]) / 255.0).powi(layers as i32 - 1);
    (ShellTexture::stack(layers, vec![MipImage { width: 1, height: 1, texels: texel.repeat(layers as usize) }]), covered)
}

#[test]
fn any_number_of_layers_covers_alike() {
    let mut seen = Vec::new();
    for layers in [2, 5, 16, 32] {
        let (stack, expected) = even_layers(layers, 0.3);
        let mut coat = coat(&shapes::square(4, 3.0), Style::default(), &hair(2));
        coat.shells = Arc::new(stack);
        let camera = Camera { eye: Vec3::new(0.0, 0.0, 1.0), target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.5, near: 0.1 };
        let options = Options { surface: false, fins: false, ..Options::default() };
        let picture = picture(&coat, &View { options, ..View::new(camera, light(Vec3::Z)) });
        let middle = picture.coverage[(SIZE.1 / 2 * SIZE.0 + SIZE.0 / 2) as usize];
        let covered = f64::from(middle) / 255.0;
        // Each layer rounds to a 255th.
        assert!((covered - expected).abs() < 0.5 / 255.0 * f64::from(layers), "{layers} layers: {covered}, not {expected}");
        seen.push(mean_coverage(&picture));
    }
    let spread = seen.iter().fold(0.0_f64, |most, &c| most.max((c - seen[0]).abs()));
    assert!(spread < 0.04, "{seen:?}");
}

#[test]
fn fins_thicken_the_silhouette() {
    let seen = |fins| picture(&ball(), &view(Options { fins, ..Options::default() }));
    let (with, without) = (seen(true), seen(false));
    let rim: Vec<usize> = (0..with.coverage.len()).filter(|&i| (20..200).contains(&without.coverage[i])).collect();
    let mean = |p: &pelage_render::Picture| rim.iter().map(|&i| f64::from(p.coverage[i])).sum::<f64>() / rim.len() as f64;
    assert!(rim.len() > 50 && mean(&with) > 1.2 * mean(&without), "{} {} {}", rim.len(), mean(&with), mean(&without));
    assert!(with.frame.fins_drawn > 0 && with.frame.fins_drawn < with.frame.fins_considered);
    assert_eq!(without.frame.fins_drawn, 0);
}

#[test]
fn two_runs_give_the_same_bytes() {
    let other = Headless::new().unwrap_or_else(|error| panic!("{error}"));
    let draw = |on| render_picture(on, &ball(), &view(Options::default()), SIZE, 4, &background()).expect("a picture");
    let (first, second) = (draw(headless()), draw(&other));
    assert!(first.rgba == second.rgba && first.coverage == second.coverage);
    assert_eq!(other.take_errors(), Vec::<String>::new());
}

#[test]
fn hair_has_no_sign_but_a_direction() {
    let before = picture(&ball(), &view(Options::default()));
    let mut turned = ball();
    turned.surface.directions.iter_mut().for_each(|t| *t = -*t);
    let (mean, most) = difference(&picture(&turned, &view(Options::default())), &before);
    assert!(mean < 0.01 && most <= 2, "−T is T but for packing: {mean} {most}");
    let mut mirrored = ball();
    for (t, n) in mirrored.surface.directions.iter_mut().zip(&ball().surface.normals) {
        *t = 2.0 * n.dot(*t) * *n - *t;
    }
    let (mean, most) = difference(&picture(&mirrored, &view(Options::default())), &before);
    assert!(mean > 0.5 && most > 10, "{mean} {most}");
}

#[test]
fn each_switch_and_layer_shows() {
    let all = picture(&ball(), &view(Options::default()));
    let without = |options| difference(&picture(&ball(), &view(options)), &all).0;
    let layers = ShellRange { left_out: Some(4), ..ShellRange::default() };
    assert!(without(Options { surface: false, ..Options::default() }) > 0.5);
    assert!(without(Options { fins: false, ..Options::default() }) > 0.5);
    assert!(without(Options { shells: false, ..Options::default() }) > 2.0);
    assert!(without(Options { layers, ..Options::default() }) > 0.1);
    assert!(without(Options { length_scale: 1.1, ..Options::default() }) > 0.5);
    assert!(without(Options { anisotropy: 8, ..Options::default() }) > 0.05);
    assert_eq!(picture(&ball(), &view(Options { layers, ..Options::default() })).frame.shells_drawn, 6);
}

#[test]
fn step_blur_joins_the_dots_of_a_slanted_hair() {
    // Hair that leans along the picture's height, seen at a grazing angle: dots along each strand are contrast from row to row.
    let hair = Recipe { layers: 8, ..Recipe::default() }.grow();
    let coat = coat(&shapes::square(8, 3.0), Style { length: 0.12, slant: 0.2, toward: Vec3::Y }, &hair);
    let camera = Camera { eye: Vec3::new(0.0, -1.2, 0.25), target: Vec3::new(0.0, 0.0, 0.05), up: Vec3::Z, field_of_view: 0.35, near: 0.1 };
    let roughness = |step_blur| {
        let options = Options { step_blur, fins: false, ..Options::default() };
        let seen = picture(&coat, &View { options, ..View::new(camera, light(Vec3::new(0.3, -1.0, 1.0))) });
        let stride = 4 * SIZE.0 as usize;
        let bend =
            |at: usize| (2.0 * f64::from(seen.rgba[at]) - f64::from(seen.rgba[at - stride]) - f64::from(seen.rgba[at + stride])).abs();
        let inside = (stride..seen.rgba.len() - stride).step_by(4);
        inside.map(bend).sum::<f64>() / f64::from(SIZE.0 * (SIZE.1 - 2))
    };
    let (dotted, joined) = (roughness(0.0), roughness(Options::default().step_blur));
    assert!(joined < 0.85 * dotted, "{dotted} {joined}");
}

#[test]
fn lighting_modes_agree() {
    let fine = || coat(&shapes::sphere(16, 4.0), Style { length: 0.05, ..Style::default() }, &hair(8));
    let lit = |lighting| picture(&fine(), &view(Options { lighting, ..Options::default() }));
    let formula = lit(LightingMode::Formula);
    for (mode, bound) in [(LightingMode::Table(Default::default()), 0.3), (LightingMode::PerVertex, 0.6)] {
        let (mean, most) = difference(&lit(mode), &formula);
        assert!(mean < bound && most < 20, "{mode:?}: {mean} {most}");
        assert!(mean > 0.0, "{mode:?} is a way of its own");
    }
}

#[test]
fn written_depth_hides_fur_behind_fur() {
    // Two squares with fur, the near one drawn first: what stands behind must not be blended over it.
    let shape = shapes::square(2, 4.0);
    let hair = Recipe { resolution: 64, guard_hairs: 16, under_hairs: 0, radius: 0.08, layers: 4, ..Recipe::default() }.grow();
    let mut pair = coat(&shape, Style { length: 0.1, slant: 0.0, ..Style::default() }, &hair);
    let count = pair.surface.positions.len();
    pair.surface.positions = [0.0, -0.05].iter().flat_map(|&z| shape.positions.iter().map(move |p| *p + z * Vec3::Z)).collect();
    for array in [&mut pair.surface.normals, &mut pair.surface.offsets, &mut pair.surface.bends, &mut pair.surface.directions] {
        array.extend_from_within(..);
    }
    pair.surface.ends.extend_from_within(..);
    pair.surface.mixes.extend_from_within(..);
    pair.surface.colours = [Vec3::Y, Vec3::X].iter().flat_map(|&c| vec![c; count]).collect();
    let (vertices, corners) = (pair.patches.vertices.clone(), pair.patches.vertices.len() as u32);
    pair.patches.vertices.extend(vertices.iter().map(|v| v + count as u32));
    pair.patches.coordinates.extend_from_within(..);
    let faces = pair.patches.faces.clone();
    pair.patches.faces.extend(faces.iter().map(|f| f.map(|c| c + corners)));
    pair.patches.patch_ends = vec![pair.patches.faces.len() as u32];
    let red = |shell_depth| {
        let options = Options { surface: false, fins: false, shell_depth, step_blur: 0.0, ..Options::default() };
        let camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.4, near: 0.1 };
        let seen = picture(&pair, &View { options, ..View::new(camera, light(Vec3::Z)) });
        seen.rgba.chunks_exact(4).zip(&seen.coverage).filter(|(p, c)| **c > 200 && p[0] > p[1]).count()
    };
    let (written, tested) = (red(ShellDepth::default()), red(ShellDepth::Tested));
    assert!(2 * written < tested, "red before green: {written} with depth written, {tested} without");
    let opaque_only = red(ShellDepth::Written { threshold: 0.9 });
    assert!(written > 10, "between the hairs what is behind them shows: {written}");
    assert!(opaque_only > written, "fewer hairs before it: {opaque_only}, {written}");
}

#[test]
fn one_sample_and_four_agree_in_the_mean() {
    let (one, four) = (sampled(&ball(), &view(Options::default()), 1), sampled(&ball(), &view(Options::default()), 4));
    assert!((mean_coverage(&one) - mean_coverage(&four)).abs() < 0.01);
    assert!(difference(&one, &four).0 < 6.0);
    assert!(four.coverage.iter().filter(|&&c| c > 0 && c < 255).count() > 100);
}

#[test]
fn the_picture_stands_upright() {
    let mut coat = ball();
    for (colour, position) in coat.surface.colours.iter_mut().zip(&coat.surface.positions) {
        *colour = if position.y > 0.0 { Vec3::ONE } else { Vec3::splat(0.1) };
    }
    let flat = Camera { up: Vec3::Y, ..Camera::framing(Vec3::ZERO, 0.36, 0.0, 0.0, 0.6, SIZE.0 as f32 / SIZE.1 as f32, 1.0) };
    let seen = picture(&coat, &View::new(flat, light(Vec3::Z)));
    assert!(brightness(&seen, |_, y| y < SIZE.1 / 2 - 6) > 1.5 * brightness(&seen, |_, y| y > SIZE.1 / 2 + 6));
}
