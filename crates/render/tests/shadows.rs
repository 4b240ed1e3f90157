//! What stands in the light's way: hair before hair (K10), and whatever the shadow map sees.
#![allow(clippy::print_stdout, reason = "measures are shown with --nocapture")]

mod support;

use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Camera, Coat, Irradiance, Light, Lights, MipImage, ShellTexture};
use pelage_lighting::{DirectionalLight, Illumination, SelfShadow};
use pelage_render::{LightingMode, Options, Picture, RenderError, ShadowOptions, ShellDepth, ShellRange, View};

use support::samples::hair::encode;
use support::samples::{Style, background, coat, shapes};
use support::stage::Stage;
use support::{SIZE, ball, bytes, decode, difference, flat_hair, headless, offscreen, picture, twice};

/// From straight above: 36 pixels are 0.36.
fn above() -> Camera {
    let distance = 20.0;
    Camera { eye: distance * Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 2.0 * (0.36_f32 / distance).atan(), near: 1.0 }
}

fn one_light(direction: Vec3, colour: Vec3) -> Lights {
    Lights {
        directional: vec![Light { direction: direction.normalize(), colour }],
        ambient: Irradiance::hemisphere(Vec3::splat(0.1), Vec3::splat(0.1)),
    }
}

fn seen(coat: &Coat, lights: &Lights, options: Options) -> Picture {
    picture(coat, &View { options, ..View::new(above(), lights.clone()) })
}

/// The pixel that shows a place in the plane z = 0.
fn pixel(x: f32, y: f32) -> usize {
    let column = (SIZE.0 as f32 / 2.0 + 100.0 * x).floor() as usize;
    let row = (SIZE.1 as f32 / 2.0 - 100.0 * y).floor() as usize;
    row * SIZE.0 as usize + column
}

fn rgb(picture: &Picture, x: f32, y: f32) -> [u8; 3] {
    let at = 4 * pixel(x, y);
    [picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]]
}

const LAYERS: u32 = 7;
const LENGTH: f32 = 0.08;

/// Opaque white layers on a square that is one tile, the sixth of them, and it alone, with nothing but a spot in its middle.
fn spotted() -> Coat {
    let side = 32_usize;
    let white = [255_u8; 4];
    let mut texels = Vec::new();
    for layer in 0..LAYERS {
        for i in 0..side * side {
            let (x, y) = (i % side, i / side);
            let spot = [x, y].iter().all(|at| (side / 2 - 2..side / 2 + 2).contains(at));
            texels.extend(if layer != 5 || spot { white } else { [0; 4] });
        }
    }
    let mut coat = coat(
        &shapes::square(4, std::f32::consts::SQRT_2),
        Style { length: LENGTH, slant: 0.0, ..Style::default() },
        &flat_hair(2, Vec3::ONE),
    );
    coat.shells = Arc::new(ShellTexture::stack(LAYERS, vec![MipImage { width: 32, height: 32, texels }]));
    coat.surface.colours.fill(Vec3::ONE);
    coat
}

/// Where the fourth layer (k = 3) is darkened by hair two layers above: the middle, and by how much all told.
fn darkened(lights: &Lights, lighting: LightingMode) -> (f32, f32, f64) {
    let layers = ShellRange { first: 3, end: 4, left_out: None };
    let options = Options { surface: false, fins: false, layers, lighting, ..Options::default() };
    let coat = spotted();
    let (without, with) = (seen(&coat, lights, options), seen(&coat, lights, Options { hair_shadow: 1.0, ..options }));
    let (mut x, mut y, mut sum) = (0.0, 0.0, 0.0);
    for i in 0..without.coverage.len() {
        let less = f64::from(without.rgba[4 * i]) - f64::from(with.rgba[4 * i]);
        assert!(less > -2.0, "nothing gets lighter");
        if less > 2.0 {
            x += less * (i % SIZE.0 as usize) as f64;
            y += less * (i / SIZE.0 as usize) as f64;
            sum += less;
        }
    }
    let (x, y) = (x / sum + 0.5 - f64::from(SIZE.0) / 2.0, f64::from(SIZE.1) / 2.0 - y / sum - 0.5);
    (x as f32 / 100.0, y as f32 / 100.0, sum)
}

#[test]
fn a_hair_shades_what_lies_away_from_the_light() {
    for lighting in [LightingMode::PerVertex, LightingMode::Formula] {
        for toward in [Vec3::new(1.0, 0.0, 1.0), Vec3::new(-1.0, 0.5, 1.0), Vec3::new(0.2, -1.2, 0.8), Vec3::new(0.0, 0.3, 1.0)] {
            let (x, y, sum) = darkened(&one_light(toward, Vec3::ONE), lighting);
            // The spot stands two layers of six above.
            let expected = -toward / toward.z * LENGTH * 2.0 / 6.0;
            assert!((x - expected.x).abs() < 0.008 && (y - expected.y).abs() < 0.008, "{lighting:?} {toward}: {x} {y}, not {expected}");
            assert!(sum > 1000.0, "{sum}");
        }
    }
}

#[test]
fn at_a_grazing_angle_a_hair_shades_no_further_than_some_lengths() {
    let (x, y, _) = darkened(&one_light(Vec3::new(1.0, 0.0, 0.05), Vec3::ONE), LightingMode::PerVertex);
    let furthest = LENGTH * 2.0 / 6.0 / 0.15;
    assert!((x + furthest).abs() < 0.01 && y.abs() < 0.008, "{x} {y}, not {furthest}");
}

#[test]
fn shade_between_hairs_takes_the_first_light_alone_and_as_much_of_it_as_asked() {
    let coat = spotted();
    let layers = ShellRange { first: 3, end: 4, left_out: None };
    let at = |lights: &Lights, hair_shadow| {
        seen(&coat, lights, Options { surface: false, fins: false, layers, hair_shadow, ..Options::default() })
    };
    let sun = one_light(Vec3::new(0.3, 0.0, 1.0), Vec3::ONE);
    let linear = |hair_shadow| decode([rgb(&at(&sun, hair_shadow), 0.0, 0.0)[0], 0, 0, 0])[0];
    let dark = linear(1.0);
    let (lit, half) = (linear(0.0) - dark, linear(0.5) - dark);
    assert!((half / lit - 0.5).abs() < 0.02, "{half} of {lit}");
    assert!(difference(&at(&sun, 1e-6), &at(&sun, 0.0)).1 <= 1 && at(&sun, -1.0).rgba == at(&sun, 0.0).rgba);
    // Without the first light there is nothing to take.
    let mut second = one_light(Vec3::new(0.3, 0.0, 1.0), Vec3::ZERO);
    second.directional.push(Light { direction: sun.directional[0].direction, colour: Vec3::ONE });
    assert!(difference(&at(&second, 1.0), &at(&second, 0.0)).1 <= 1);
    // From behind the skin no light passes hair on its way.
    let behind = one_light(Vec3::new(0.3, 0.0, -1.0), Vec3::ONE);
    assert!(difference(&at(&behind, 1.0), &at(&behind, 0.0)).1 <= 1);
}

#[test]
fn nothing_shades_the_outermost_hair() {
    let layers = ShellRange { first: LAYERS - 1, end: LAYERS, left_out: None };
    let at = |hair_shadow| {
        let options = Options { surface: false, fins: false, layers, hair_shadow, ..Options::default() };
        seen(&spotted(), &one_light(Vec3::new(0.3, 0.2, 1.0), Vec3::ONE), options)
    };
    assert!(difference(&at(1.0), &at(0.0)).1 <= 1);
}

/// Where the floating square is.
const FLOATING: Vec3 = Vec3::new(0.2, -0.1, 0.25);
const HALF: f32 = 0.1;
const FUR: Vec3 = Vec3::new(0.0, 0.16, 0.02);

/// A bare floor, and above it a small square with fur that sticks out beyond its edge: four shells of one even opacity.
fn over_a_floor(alpha: u8) -> Coat {
    floating(alpha, FLOATING)
}

fn floating(alpha: u8, at: Vec3) -> Coat {
    let small = 2.0 * HALF / std::f32::consts::FRAC_1_SQRT_2;
    let floor = coat(&shapes::square(4, 3.0), Style::default(), &flat_hair(2, Vec3::ONE));
    let count = floor.surface.positions.len();
    let mut coat = twice(&floor, |p| small * p + at);
    coat.surface.offsets[..count].fill(Vec3::ZERO);
    coat.surface.offsets[count..].fill(FUR);
    coat.surface.colours.fill(Vec3::ONE);
    let texel = |a: u8| encode([1.0, 1.0, 1.0, 1.0].map(|c| c * f32::from(a) / 255.0));
    let texels = [255, alpha, alpha, alpha, alpha].into_iter().flat_map(texel).collect();
    coat.shells = Arc::new(ShellTexture::stack(5, vec![MipImage { width: 1, height: 1, texels }]));
    coat.fin = None;
    coat
}

fn lights() -> Lights {
    one_light(Vec3::new(1.0, 0.0, 1.0), Vec3::splat(0.7))
}

fn with_shadows(side: u32) -> Options {
    Options { shadows: Some(ShadowOptions { side }), ..Options::default() }
}

/// The floor where so much of the first light comes.
fn floor(lights: &Lights, through: f64) -> [u8; 3] {
    let view = View::new(above(), lights.clone());
    let SelfShadow { minimum, .. } = view.shading.self_shadow;
    let reach = minimum + (1.0 - minimum) * through;
    let lit = |light: &Light| DirectionalLight { direction: light.direction.as_dvec3(), colour: light.colour.as_dvec3() * reach };
    let ambient = pelage_lighting::Irradiance(lights.ambient.0.map(Vec3::as_dvec3));
    bytes(view.shading.skin(&Illumination { lights: lights.directional.iter().map(lit).collect(), ambient }, DVec3::Z))
}

fn is_near(seen: [u8; 3], expected: [u8; 3], most: u8, what: &str) {
    assert!(seen.iter().zip(expected).all(|(&a, b)| a.abs_diff(b) <= most), "{what}: {seen:?} is not {expected:?}");
}

#[test]
fn shadows_fall_where_geometry_says_and_as_dark_as_what_casts_them_is_opaque() {
    let lights = lights();
    for alpha in [26, 77, 150] {
        let coat = over_a_floor(alpha);
        let with = seen(&coat, &lights, with_shadows(1024));
        let opacity = f64::from(alpha) / 255.0;
        // The skin's shadow: moved by its height along x.
        let (x, y) = (FLOATING.x - FLOATING.z, FLOATING.y);
        for (dx, dy, inside) in [(0.0, 0.0, true), (-0.085, -0.085, true), (0.03, 0.08, true), (-0.12, 0.0, false), (0.0, -0.12, false)] {
            let through = if inside { 0.0 } else { 1.0 };
            is_near(rgb(&with, x + dx, y + dy), floor(&lights, through), 2, &format!("alpha {alpha}, at {dx} {dy}"));
        }
        // Beyond the skin's edge the fur's: where the k-th shell from the top is the last to reach, k shells are passed.
        for shells in 1..=4 {
            let between = (4.5 - shells as f32) / 4.0 * FUR.y;
            let through = (1.0 - opacity).powi(shells);
            is_near(rgb(&with, x + 0.01, y + HALF + between), floor(&lights, through), 4, &format!("alpha {alpha}, under {shells} shells"));
        }
        is_near(rgb(&with, x, y + HALF + FUR.y + 0.02), floor(&lights, 1.0), 1, "beyond the fur");
        let without = seen(&coat, &lights, Options::default());
        is_near(rgb(&without, x, y), floor(&lights, 1.0), 1, "without shadows");
    }
}

#[test]
fn the_deeper_under_fur_the_darker() {
    // Light from straight above, the floor within the first quarter of the fur's length behind the outermost shell: opacity is taken to be spread evenly over it.
    let lights = one_light(Vec3::Z, Vec3::splat(0.7));
    let mut last = 255;
    for height in [0.004, 0.01, 0.02, 0.1] {
        let coat = floating(77, Vec3::new(0.1, -0.1, height));
        // The fur casts though it is not drawn.
        let with = seen(&coat, &lights, Options { shells: false, ..with_shadows(1024) });
        // What it is moved off the floor by: twice three texels of a map half as wide as all of it.
        let (low, high) = coat.bounds();
        let behind = height + FUR.z - 2.0 * 3.0 * 0.5 * (high - low).length() / 1024.0;
        let reached = (behind / (0.25 * FUR.length())).min(1.0);
        let through = (1.0 - 77.0 / 255.0_f64).powf(4.0 * f64::from(reached));
        let found = rgb(&with, 0.11, -0.1 + HALF + 0.02);
        is_near(found, floor(&lights, through), 4, &format!("{height} above the floor, {reached} of the way"));
        assert!(found[0] < last, "{height}: {found:?}, {last}");
        last = found[0];
    }
}

#[test]
fn no_light_leaks_along_the_outline_of_fur() {
    // Straight from above, on maps of few texels: where the shadow ends, in texels beyond the fur's edge.
    let lights = one_light(Vec3::Z, Vec3::splat(0.7));
    let coat = floating(150, Vec3::new(0.0, -0.1, 0.25));
    let (low, high) = coat.bounds();
    let beyond = [24, 32, 48, 64].map(|side| {
        let with = seen(&coat, &lights, Options { shells: false, ..with_shadows(side) });
        let linear = |byte: u8| decode([byte, 0, 0, 255])[0];
        let row: Vec<f32> = (0..30).map(|i| linear(rgb(&with, 0.005 + 0.01 * i as f32, -0.1 + HALF + 0.03)[0])).collect();
        let (dark, light) = (row[0], row[29]);
        let shaded = row.iter().map(|v| (light - v) / (light - dark)).sum::<f32>();
        (shaded - 100.0 * HALF) / (100.0 * (high - low).length() / side as f32)
    });
    println!("the shadow ends at {beyond:.2?} texels beyond the fur");
    let mean = beyond.iter().sum::<f32>() / 4.0;
    assert!(mean.abs() < 0.3 && beyond.iter().all(|beyond| beyond.abs() < 0.8), "{beyond:?}");
}

#[test]
fn the_furs_shadow_is_softer_than_the_skins() {
    let with = seen(&over_a_floor(77), &lights(), with_shadows(1024));
    let x = FLOATING.x - FLOATING.z;
    // Pixels between a tenth and nine tenths of the way from dark to light, on the way out along y.
    let half_shade = |way: f32, pixels: usize| {
        let row: Vec<f32> = (0..pixels).map(|i| f32::from(rgb(&with, x, FLOATING.y + way * 0.01 * i as f32)[0])).collect();
        let (dark, light) = (row[0], row[pixels - 1]);
        row.iter().filter(|&&v| v > dark + 0.1 * (light - dark) && v < dark + 0.9 * (light - dark)).count()
    };
    let (skin, fur) = (half_shade(-1.0, 25), half_shade(1.0, 30));
    println!("half shade of the skin {skin} pixels, of the fur {fur}");
    assert!(skin <= 2 && fur >= 10, "{skin} {fur}");
}

#[test]
fn fur_without_length_casts_nothing_but_the_skin_does() {
    let lights = lights();
    let bald = seen(&over_a_floor(150), &lights, Options { length_scale: 0.0, ..with_shadows(512) });
    let (x, y) = (FLOATING.x - FLOATING.z, FLOATING.y);
    is_near(rgb(&bald, x, y), floor(&lights, 0.0), 2, "the skin's shadow");
    is_near(rgb(&bald, x, y + HALF + 0.03), floor(&lights, 1.0), 2, "no fur's shadow");
    // Longer fur reaches further.
    let long = seen(&over_a_floor(150), &lights, Options { length_scale: 1.4, ..with_shadows(512) });
    let tips = rgb(&long, x, y + HALF + 1.2 * FUR.y)[0];
    assert!(tips < floor(&lights, 0.8)[0], "{tips}");
}

#[test]
fn light_from_behind_casts_nothing_on_what_it_does_not_light() {
    let lights = one_light(Vec3::new(0.4, 0.1, -1.0), Vec3::ONE);
    let coat = over_a_floor(77);
    let (with, without) = (seen(&coat, &lights, with_shadows(256)), seen(&coat, &lights, Options::default()));
    for (x, y) in [(-0.2, 0.0), (-0.05, 0.1), (0.0, -0.3), (-0.3, 0.3)] {
        assert_eq!(rgb(&with, x, y), rgb(&without, x, y), "{x} {y}");
    }
}

#[test]
fn what_the_light_meets_first_does_not_shade_itself() {
    let lights = one_light(Vec3::new(0.3, 0.4, 1.0), Vec3::ONE);
    let toward = lights.directional[0].direction;
    let camera = Camera { eye: 3.0 * Vec3::new(-0.2, 0.3, 1.0).normalize(), field_of_view: 0.26, ..above() };
    for (what, length_scale, most_mean, most_dark) in [("bald", 0.0, 0.2, 0.0), ("furry", 1.0, 3.0, 0.02), ("long", 3.0, 6.0, 0.1)] {
        for side in [256, 1024] {
            for lighting in [LightingMode::PerVertex, LightingMode::Formula] {
                let at = |shadows| {
                    let options = Options { fins: false, length_scale, shadows, lighting, ..Options::default() };
                    picture(&ball(), &View { options, ..View::new(camera, lights.clone()) })
                };
                let (with, without) = (at(Some(ShadowOptions { side })), at(None));
                // Where the ball looks to the light.
                let view = camera.view_projection(SIZE.0 as f32 / SIZE.1 as f32);
                let (mut sum, mut dark, mut count) = (0.0, 0, 0);
                for (i, &covered) in without.coverage.iter().enumerate() {
                    let (x, y) = ((i as u32 % SIZE.0) as f32 + 0.5, (i as u32 / SIZE.0) as f32 + 0.5);
                    let place = Vec3::new(2.0 * x / SIZE.0 as f32 - 1.0, 1.0 - 2.0 * y / SIZE.1 as f32, 0.5);
                    let way = (view.inverse().project_point3(place) - camera.eye).normalize();
                    let along = -camera.eye.dot(way);
                    let off = camera.eye.length_squared() - along * along;
                    let radius = 0.2887_f32;
                    if covered < 255 || off >= radius * radius {
                        continue;
                    }
                    let hit = camera.eye + way * (along - (radius * radius - off).sqrt());
                    if hit.dot(toward) < 0.35 * radius {
                        continue;
                    }
                    let less = (0..3).map(|c| with.rgba[4 * i + c].abs_diff(without.rgba[4 * i + c])).max().unwrap_or(0);
                    sum += f64::from(less);
                    dark += usize::from(less > 12);
                    count += 1;
                }
                let (mean, dark) = (sum / f64::from(count), dark as f64 / f64::from(count));
                println!("{what}, map of {side}, {lighting:?}: {mean:.2} of 255 on {count} pixels, more than 12 on {:.1} %", 100.0 * dark);
                assert!(count > 800 && mean <= most_mean && dark <= most_dark, "{what}, {side}: {mean} {dark}");
            }
        }
    }
}

#[test]
fn the_map_is_drawn_anew_when_what_it_shows_changes_and_not_otherwise() {
    let stage = Stage::plain();
    let uploaded = stage.upload(&over_a_floor(77));
    let view = View { options: with_shadows(128), ..View::new(above(), lights()) };
    let mut prepared = stage.prepare(&uploaded, &view);
    assert!(prepared.shadows_are_stale());
    let first = stage.frame(&prepared);
    assert!(!prepared.shadows_are_stale());
    assert!(stage.frame(&prepared) == first);
    let moved = View { camera: Camera { eye: Vec3::new(3.0, 1.0, 20.0), ..above() }, ..view.clone() };
    let bright = View { lights: one_light(Vec3::new(1.0, 0.0, 1.0), Vec3::X), ..view.clone() };
    for still in [moved, bright, View { options: Options { step_blur: 0.0, ..view.options }, ..view.clone() }] {
        stage.update(&mut prepared, &still);
        assert!(!prepared.shadows_are_stale());
        assert!(stage.frame(&prepared) == stage.frame(&stage.prepare(&uploaded, &still)));
    }
    let turned = View { lights: one_light(Vec3::new(1.0, 0.4, 1.0), Vec3::ONE), ..view.clone() };
    let longer = View { options: Options { length_scale: 1.3, ..view.options }, ..view.clone() };
    let finer = View { options: with_shadows(256), ..view.clone() };
    for changed in [turned, longer, finer, view.clone()] {
        stage.update(&mut prepared, &changed);
        assert!(prepared.shadows_are_stale());
        assert!(stage.frame(&prepared) == stage.frame(&stage.prepare(&uploaded, &changed)));
        assert!(!prepared.shadows_are_stale());
    }
    prepared.redraw_shadows();
    assert!(prepared.shadows_are_stale());
    assert!(stage.frame(&prepared) == first);
    stage.update(&mut prepared, &View { options: Options::default(), ..view });
    assert!(!prepared.shadows_are_stale() && stage.frame(&prepared) != first);
    assert_eq!(headless().take_errors(), Vec::<String>::new());
}

#[test]
fn a_map_larger_than_the_device_has_is_refused() {
    let most = headless().device().limits().max_texture_dimension_2d;
    let target = offscreen(4);
    let uploaded = target.upload(&ball()).unwrap_or_else(|error| panic!("{error}"));
    let view = View { options: with_shadows(most + 1), ..View::new(above(), lights()) };
    let error = target.render(&uploaded, &view, &background());
    assert!(matches!(error, Err(RenderError::Limit { needed, limit, .. }) if needed == limit + 1 && limit == u64::from(most)), "{error:?}");
}

#[test]
fn shadows_do_not_depend_on_how_depth_is_written() {
    let coat = over_a_floor(77);
    let at = |shell_depth| seen(&coat, &lights(), Options { shell_depth, ..with_shadows(256) });
    let (written, tested) = (at(ShellDepth::default()), at(ShellDepth::Tested));
    for (x, y) in [(-0.05, -0.1), (-0.04, 0.02), (-0.3, 0.0)] {
        assert_eq!(rgb(&written, x, y), rgb(&tested, x, y));
    }
}
