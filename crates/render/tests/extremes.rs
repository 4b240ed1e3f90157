//! The rows "Camera", "Shells" and "Hair lighting" of the numbers at their extremes, drawn into half floats, which hide neither what is no number nor what is
//! less than half a byte's step.

#![allow(clippy::expect_used, clippy::panic, clippy::print_stdout, reason = "a test may panic, and says what it measured")]

mod support;

use std::sync::Arc;

use glam::Vec3;
use pelage_coat::{Camera, Coat, MipImage, ShellTexture};
use pelage_lighting::TableLayout;
use pelage_render::{Detail, FinRule, LightingMode, March, Options, ShadowOptions, ShellDepth, Target, View};
use wgpu::{DeviceDescriptor, Features, TextureFormat};

use support::samples::hair::encode;
use support::samples::{Style, coat, light, shapes};
use support::stage::Stage;
use support::{SIZE, ball, furry, hair, headless, view};

/// The brightest of a frame's colours, of which none may be no number or negative, where none covers more than all.
fn sound(stage: &Stage, coat: &Coat, view: &View, what: &str) -> f32 {
    let uploaded = stage.upload(coat);
    let pixels = stage.numbers(&stage.prepare(&uploaded, view));
    assert_eq!(headless().take_errors(), Vec::<String>::new(), "{what}");
    let mut greatest = 0.0_f32;
    for (i, pixel) in pixels.iter().enumerate() {
        let fine = pixel.iter().all(|c| c.is_finite() && *c >= 0.0) && pixel[3] <= 1.001;
        assert!(fine, "{what}: {pixel:?} at {}, {}", i as u32 % SIZE.0, i as u32 / SIZE.0);
        greatest = pixel[..3].iter().fold(greatest, |greatest, c| greatest.max(*c));
    }
    greatest
}

/// Plain, with all that is computed at pixels, from a table, between levels of detail, and marching.
fn ways() -> [Options; 4] {
    let most = Options {
        lighting: LightingMode::Formula,
        hair_shadow: 0.7,
        shadows: Some(ShadowOptions { side: 64 }),
        fin_rule: FinRule::All,
        fin_segments: 4,
        ..Options::default()
    };
    let lighting = LightingMode::Table(TableLayout::default());
    let by_table = Options { lighting, shell_depth: ShellDepth::Tested, detail: Detail::Level(0.8), ..Options::default() };
    [Options::default(), most, by_table, Options { march: March { layers: 2, steps: 2 }, ..most }]
}

/// A plain ball, and one whose hair bends and is cut, with a direction map and levels of detail.
fn balls() -> [Coat; 2] {
    [ball(), furry(true, true, true, true)]
}

#[test]
fn no_pixel_is_no_number_wherever_the_eye_is() {
    let (stage, balls) = (Stage::floating(), balls());
    let radius = 0.288_675_13_f32;
    let out = Vec3::new(0.3, 0.2, 0.93).normalize();
    let (mut frames, mut brightest) = (0, 0.0_f32);
    // In the middle, under the skin, on it, on a vertex, in the fur, at the tips, and far away.
    let heights = [-radius, -1e-3, 0.0, 1e-4, 0.02, 0.05, 1.0, 1e4];
    for eye in heights.map(|height| out * (radius + height)).into_iter().chain([balls[0].surface.positions[7]]) {
        for near in [1e-4, 1e-2, 10.0] {
            // Towards the model, away from it with the model behind, and along the skin.
            for ahead in [-out, out, out.cross(Vec3::Y).normalize()] {
                let camera = Camera { eye, target: eye + ahead, up: Vec3::Y, field_of_view: 1.2, near };
                for (coat, options) in balls.iter().flat_map(|coat| ways().map(|options| (coat, options))) {
                    let what = format!("eye {eye}, near {near}, ahead {ahead}, {options:?}");
                    brightest = brightest.max(sound(&stage, coat, &View { camera, ..view(options) }, &what));
                    frames += 1;
                }
            }
        }
    }
    println!("reached: {frames} frames, colours from 0 to {brightest:.2}");
    assert!(brightest > 0.1, "something is seen");
}

#[test]
fn no_pixel_is_no_number_however_long_the_hair() {
    let (stage, balls) = (Stage::floating(), balls());
    let mut longest = 0.0_f32;
    // Of hair a twentieth of a diameter long.
    for length_scale in [0.0, 1e-30, 1e-6, 1.0, 1e3, 2e7] {
        for (coat, options) in balls.iter().flat_map(|coat| ways().map(|options| (coat, options))) {
            let view = view(Options { length_scale, ..options });
            sound(&stage, coat, &view, &format!("{:?}", view.options));
            longest = longest.max(0.05 * length_scale);
        }
    }
    println!("reached: hair from 0 to {longest:.0e} diameters");
}

#[test]
fn no_pixel_is_no_number_at_any_exponent_or_with_light_against_the_eye() {
    let (stage, balls) = (Stage::floating(), balls());
    let mut brightest = 0.0_f32;
    for power in [0.0, 1.0, 1e4, 1e30, f64::MAX] {
        for (coat, options) in balls.iter().flat_map(|coat| ways().map(|options| (coat, options))) {
            let mut extreme = view(options);
            extreme.shading.hair.diffuse_power = power;
            extreme.shading.hair.specular_power = power;
            for direction in [extreme.lights.directional[0].direction, -extreme.camera.toward_eye(), extreme.camera.toward_eye()] {
                extreme.lights.directional[0].direction = direction;
                brightest = brightest.max(sound(&stage, coat, &extreme, &format!("power {power}, light {direction}, {options:?}")));
            }
        }
    }
    println!("reached: colours from 0 to {brightest:.2}");
}

/// Into `f32`, where the adapter blends it.
fn in_f32() -> Option<Stage> {
    let adapter = headless().adapter();
    if !adapter.features().contains(Features::FLOAT32_BLENDABLE) {
        println!("this adapter does not blend f32: layers are looked at in half floats and bytes alone");
        return None;
    }
    let descriptor = DeviceDescriptor {
        required_features: Features::FLOAT32_BLENDABLE,
        required_limits: adapter.limits(),
        ..DeviceDescriptor::default()
    };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).expect("a device");
    Some(Stage::on(&device, &queue, Target::new(TextureFormat::Rgba32Float, 1)))
}

/// By how much the coverage in the middle of a square under so many layers, seen squarely, is not what the formula says.
fn off(stage: &Stage, layers: u32, alpha: u8) -> f64 {
    let texel = encode([0.0, 0.0, 0.0, f32::from(alpha) / 255.0]);
    let stack = ShellTexture::stack(layers, vec![MipImage { width: 1, height: 1, texels: texel.repeat(layers as usize) }]);
    let mut coat = coat(&shapes::square(4, 3.0), Style::default(), &hair(2));
    coat.shells = Arc::new(stack);
    let camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.5, near: 0.1 };
    // What is fainter than the threshold of opacity would be left out.
    let options = Options { surface: false, fins: false, shell_depth: ShellDepth::Tested, ..Options::default() };
    let uploaded = stage.upload(&coat);
    let prepared = stage.prepare(&uploaded, &View { options, ..View::new(camera, light(Vec3::Z)) });
    let middle = (SIZE.1 / 2 * SIZE.0 + SIZE.0 / 2) as usize;
    let seen = match stage.renderer.target().colour {
        TextureFormat::Rgba8UnormSrgb => f64::from(stage.frame(&prepared)[4 * middle + 3]) / 255.0,
        _ => f64::from(stage.numbers(&prepared)[middle][3]),
    };
    (seen - 1.0 + (1.0 - f64::from(alpha) / 255.0).powi(layers as i32 - 1)).abs()
}

/// As opaque as the formula says, but for what the target rounds at each layer: into bytes the faintest add nothing from half coverage on.
#[test]
fn one_to_256_layers_cover_what_the_formula_says() {
    // Half a step, the most that a layer loses; halves near 1 have steps of 2⁻¹¹, and some drivers cut them off.
    let targets = [(in_f32(), 2e-7), (Some(Stage::floating()), 4.9e-4), (Some(Stage::plain()), 0.5 / 255.0)];
    let mut reached = Vec::new();
    for (stage, rounding) in targets {
        let Some(stage) = stage else { continue };
        let mut most = 0.0_f64;
        for layers in [1, 2, 3, 8, 16, 17, 64, 128, 256] {
            for alpha in [1, 5, 77] {
                let (off, colour) = (off(&stage, layers, alpha), stage.renderer.target().colour);
                assert!(off < 1e-6 + rounding * f64::from(layers), "{layers} layers of {alpha} in {colour:?}: {off} off");
                most = most.max(off);
            }
        }
        reached.push(format!("{most:.1e} in {:?}", stage.renderer.target().colour));
    }
    println!("reached: within {}", reached.join(", "));
}
