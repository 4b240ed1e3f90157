//! What each way of drawing shells shows, beside the plain one.
#![allow(clippy::print_stdout, clippy::expect_used, reason = "measures are shown with --nocapture, and a test may panic")]

mod support;

use std::sync::Arc;

use glam::Vec3;
use pelage_coat::{Camera, Coat, Encoding, MipImage, ShellTexture};
use pelage_render::{Headless, March, Options, Picture, RenderError, Renderer, ShadowOptions, ShellDepth, ShellRange, Target, View};
use texpresso::Format;

use support::samples::hair::Recipe;
use support::samples::{Dice, Style, background, coat, light, shapes};
use support::{SIZE, ball, difference, headless, mean_coverage, picture, sampled, twice, view};

/// Crisp long hair on a square, ten layers of it.
fn square(slant: f32) -> Coat {
    let hair = Recipe { layers: 10, resolution: 64, guard_hairs: 60, under_hairs: 60, radius: 0.03, ..Recipe::default() }.grow();
    coat(&shapes::square(4, 3.0), Style { length: 0.12, slant, toward: Vec3::Y }, &hair)
}

fn squarely() -> Camera {
    Camera { eye: 6.0 * Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.1, near: 0.1 }
}

fn aslant() -> Camera {
    Camera { eye: Vec3::new(0.0, -2.0, 0.9), target: Vec3::new(0.0, 0.0, 0.05), up: Vec3::Z, field_of_view: 0.2, near: 0.1 }
}

fn seen(coat: &Coat, camera: Camera, options: Options) -> Picture {
    picture(coat, &View { options: Options { fins: false, ..options }, ..View::new(camera, light(Vec3::new(0.3, -1.0, 1.0))) })
}

fn march(layers: u32, steps: u32) -> Options {
    Options { march: March { layers, steps }, step_blur: 0.0, ..Options::default() }
}

/// How much a row differs from the mean of its neighbours: the dots of strands that run up the picture.
fn roughness(picture: &Picture) -> f64 {
    let stride = 4 * SIZE.0 as usize;
    let byte = |at: usize| f64::from(picture.rgba[at]);
    let bend = |at: usize| (2.0 * byte(at) - byte(at - stride) - byte(at + stride)).abs();
    (stride..picture.rgba.len() - stride).step_by(4).map(bend).sum::<f64>() / f64::from(SIZE.0 * (SIZE.1 - 2))
}

#[test]
fn a_march_of_nothing_is_plain() {
    for camera in [squarely(), aslant()] {
        let plain = seen(&square(0.3), camera, Options { step_blur: 0.0, ..Options::default() });
        assert!(seen(&square(0.3), camera, march(0, 0)).rgba == plain.rgba);
    }
}

#[test]
fn several_layers_in_one_shell_show_what_as_many_shells_do() {
    // Seen squarely the layers lie over each other; aslant each is looked up where the ray of sight meets it.
    for (what, camera, counts, bound) in [("squarely", squarely(), &[3, 9][..], 1.8), ("aslant", aslant(), &[3], 2.5)] {
        for slant in [0.0, 0.5] {
            let coat = square(slant);
            let plain = seen(&coat, camera, march(1, 1));
            for &layers in counts {
                let marched = seen(&coat, camera, march(layers, 1));
                assert_eq!((plain.frame.shells_drawn, marched.frame.shells_drawn), (9, 9 / layers));
                let (mean, _) = difference(&marched, &plain);
                println!("{what}, slant {slant}, {layers} layers a shell: {mean:.3} of 255");
                assert!(mean < bound, "{what}, {slant}, {layers}: {mean}");
            }
            // Fewer shells without the march are another picture.
            let mut few = coat.clone();
            few.shells = Arc::new(ShellTexture { levels: vec![thinned(&coat.shells)], ..(*coat.shells).clone() });
            let (mean, _) = difference(&seen(&few, camera, march(1, 1)), &plain);
            println!("{what}, slant {slant}, a third of the shells: {mean:.3} of 255");
            assert!(mean > 1.5 * bound, "{what}, {slant}: {mean}");
        }
    }
}

#[test]
fn a_march_ends_where_the_hair_is_cut() {
    let mut shorn = square(0.5);
    // From a third of the length, below most of a march, to all of it.
    for (end, place) in shorn.surface.ends.iter_mut().zip(&square(0.5).surface.positions) {
        *end = (0.65 + place.x).clamp(0.3, 1.0);
    }
    let hair = |coat: &Coat, layers: u32| seen(coat, squarely(), Options { surface: false, ..march(layers, 1) });
    let (plain, whole) = (hair(&shorn, 1), mean_coverage(&hair(&square(0.5), 1)));
    for layers in [3, 9] {
        let marched = hair(&shorn, layers);
        let (mean, _) = difference(&marched, &plain);
        println!("{layers} layers a shell: {mean:.3} of 255, covered {:.4}, not {:.4}", mean_coverage(&marched), mean_coverage(&plain));
        assert!(mean < 1.8, "{layers}: {mean}");
        assert!((mean_coverage(&marched) - mean_coverage(&plain)).abs() < 0.01);
        assert!(mean_coverage(&plain) < whole - 0.02, "the cut takes something off: {whole}");
    }
}

#[test]
fn a_march_passes_over_layers_that_are_not_asked_for() {
    let only =
        |layers: u32, range: ShellRange| seen(&square(0.5), squarely(), Options { surface: false, layers: range, ..march(layers, 1) });
    for range in [ShellRange { first: 4, end: 7, left_out: None }, ShellRange { first: 1, end: 6, left_out: Some(3) }] {
        let (mean, _) = difference(&only(3, range), &only(1, range));
        assert!(mean < 1.8, "{range:?}: {mean}");
        assert!(difference(&only(3, range), &only(3, ShellRange::default())).0 > 0.5, "{range:?} leaves something out");
    }
}

#[test]
fn what_a_march_passes_over_shades_and_casts_as_it_does_elsewhere() {
    let range = ShellRange { first: 1, end: 4, left_out: None };
    for (what, shading) in [
        ("shade", Options { hair_shadow: 1.0, ..Options::default() }),
        ("shadow", Options { shadows: Some(ShadowOptions { side: 256 }), ..Options::default() }),
    ] {
        let at = |layers: u32, range: ShellRange| {
            let options = Options { layers: range, march: March { layers, steps: 1 }, step_blur: 0.0, ..shading };
            seen(&square(0.5), squarely(), options)
        };
        let (mean, _) = difference(&at(3, range), &at(1, range));
        assert!(mean < 1.0, "{what}: {mean}");
    }
}

/// Every third shell.
fn thinned(shells: &ShellTexture) -> Vec<pelage_coat::ShellLayer> {
    shells.levels[0].iter().step_by(3).copied().collect()
}

#[test]
fn steps_between_layers_join_what_layers_cut_up() {
    let (plain, steps) = (seen(&square(0.2), aslant(), march(1, 1)), seen(&square(0.2), aslant(), march(1, 4)));
    let (dotted, joined) = (roughness(&plain), roughness(&steps));
    println!("roughness {dotted:.2} of layers, {joined:.2} of four steps each");
    assert!(joined < 0.85 * dotted, "{dotted} {joined}");
    // They are as opaque together as the layers are.
    let open = |options: Options| mean_coverage(&seen(&square(0.2), squarely(), Options { surface: false, ..options }));
    let (plain, steps) = (open(march(1, 1)), open(march(1, 4)));
    println!("covered: {plain:.3} by layers, {steps:.3} by four steps each");
    assert!((plain - steps).abs() < 0.06, "{plain} {steps}");
    // A camera that goes on by a part of a layer changes less.
    let change = |steps: u32| {
        let on = |by: f32| Camera { eye: aslant().eye + by * Vec3::Z, ..aslant() };
        difference(&seen(&square(0.2), on(0.0), march(1, steps)), &seen(&square(0.2), on(0.08), march(1, steps))).0
    };
    let (layers, between) = (change(1), change(4));
    println!("a move changes {layers:.2} of 255 in layers, {between:.2} in steps");
    assert!(between < layers, "{layers} {between}");
}

#[test]
fn alpha_to_coverage_covers_about_as_much_as_blending() {
    for (what, coat) in [("ball", ball()), ("square", square(0.3))] {
        let options = |shell_depth| Options { surface: false, fins: false, shell_depth, ..Options::default() };
        let covered = |shell_depth, samples| mean_coverage(&sampled(&coat, &view(options(shell_depth)), samples));
        let blended = covered(ShellDepth::default(), 4);
        let covering = covered(ShellDepth::Coverage { threshold: 0.02 }, 4);
        let single = covered(ShellDepth::Coverage { threshold: 0.5 }, 1);
        println!("{what}: covered {blended:.3} blended, {covering:.3} by coverage of four samples, {single:.3} of one");
        assert!((covering - blended).abs() < 0.05, "{what}: {covering} {blended}");
        assert!((single - blended).abs() < 0.2, "{what}: {single} {blended}");
    }
}

#[test]
fn alpha_to_coverage_needs_no_order() {
    // Two squares, one behind the other: the near one drawn first, and last.
    let mut near_first = twice(&square(0.3), |p| p - 0.06 * Vec3::Z);
    let count = square(0.3).surface.positions.len();
    near_first.surface.colours[count..].fill(Vec3::X);
    let mut far_first = near_first.clone();
    far_first.patches.faces.reverse();
    let at = |coat: &Coat, shell_depth| seen(coat, squarely(), Options { surface: false, shell_depth, ..Options::default() });
    let change = |shell_depth| difference(&at(&near_first, shell_depth), &at(&far_first, shell_depth)).0;
    let (covering, tested) = (change(ShellDepth::Coverage { threshold: 0.02 }), change(ShellDepth::Tested));
    println!("drawn the other way round: depth only tested {tested:.3} of 255, by coverage {covering:.3}");
    assert!(covering < 0.01 && tested > 1.0, "{covering} {tested}");
}

/// Random blocks of images of this side, and what they decode to.
fn blocks(side: u32, images: u32) -> [ShellTexture; 2] {
    let mut dice = Dice::new(77);
    let mut mips = [Vec::new(), Vec::new()];
    let mut width = side;
    loop {
        let (blocks, size) = (width.div_ceil(4).pow(2) as usize, width as usize);
        let mut encoded = Vec::new();
        let mut decoded = Vec::new();
        for image in 0..images {
            let bytes: Vec<u8> =
                (0..16 * blocks).map(|i| if image == 0 && i % 16 < 2 { 255 } else { (256.0 * dice.roll()) as u8 }).collect();
            let mut texels = vec![0; 4 * size * size];
            Format::Bc3.decompress(&bytes, size, size, &mut texels);
            encoded.extend(bytes);
            decoded.extend(texels);
        }
        mips[0].push(MipImage { width, height: width, texels: encoded });
        mips[1].push(MipImage { width, height: width, texels: decoded });
        if width == 1 {
            break;
        }
        width /= 2;
    }
    let [encoded, decoded] = mips;
    [ShellTexture { encoding: Encoding::Bc3, ..ShellTexture::stack(images, encoded) }, ShellTexture::stack(images, decoded)]
}

#[test]
fn textures_in_blocks_draw_as_what_they_decode_to() {
    if !headless().device().features().contains(wgpu::Features::TEXTURE_COMPRESSION_BC) {
        println!("not on this adapter: it reads no blocks");
        return;
    }
    for side in [4, 16] {
        let [encoded, decoded] = blocks(side, 5).map(|shells| Coat { shells: Arc::new(shells), ..square(0.3) });
        for (camera, options) in [(squarely(), Options::default()), (aslant(), march(2, 2))] {
            let (blocks, plain) = (seen(&encoded, camera, options), seen(&decoded, camera, options));
            let (mean, most) = difference(&blocks, &plain);
            println!("{side} texels a side: {mean:.3}, at most {most} of 255");
            // Where an alpha lies at the threshold, one of the two leaves the pixel out.
            let far_off = blocks.rgba.iter().zip(&plain.rgba).filter(|(a, b)| a.abs_diff(**b) > 6).count();
            assert!(mean < 0.3 && far_off * 200 < plain.rgba.len(), "{side}: {mean} {most}, {far_off}");
            assert!(difference(&plain, &seen(&square(0.3), camera, options)).0 > 10.0, "they are another texture");
        }
    }
}

#[test]
fn blocks_that_do_not_fill_a_texture_are_refused() {
    let [encoded, _] = blocks(2, 3).map(|shells| Coat { shells: Arc::new(shells), ..square(0.3) });
    let error =
        pelage_render::render_picture(headless(), &encoded, &view(Options::default()), SIZE, 1, &background()).expect_err("refused");
    assert!(matches!(error, RenderError::Encoding { .. }), "{error}");
    assert_eq!(headless().take_errors(), Vec::<String>::new());
}

#[test]
fn blocks_are_refused_by_a_device_that_does_not_read_them() {
    let own = Headless::new().expect("an adapter");
    let (device, queue) = pollster::block_on(own.adapter().request_device(&wgpu::DeviceDescriptor::default())).expect("a device");
    let renderer = Renderer::new(&device, &queue, Target::new(wgpu::TextureFormat::Rgba8UnormSrgb, 1));
    let [encoded, _] = blocks(8, 3).map(|shells| Coat { shells: Arc::new(shells), ..square(0.3) });
    let error = renderer.upload(&device, &queue, &encoded).expect_err("refused");
    assert!(matches!(error, RenderError::Encoding { .. }) && error.to_string().contains("uncompressed"), "{error}");
    assert!(renderer.upload(&device, &queue, &square(0.3)).is_ok());
}

#[test]
fn blocks_of_detail_levels_blend_like_others() {
    if !headless().device().features().contains(wgpu::Features::TEXTURE_COMPRESSION_BC) {
        return;
    }
    // Two levels of random blocks: what they blend to is what the decoded ones do.
    let [encoded, decoded] = blocks(16, 6).map(|mut shells| {
        let stack = |images: std::ops::Range<u32>, every: usize| {
            images
                .clone()
                .map(|k| pelage_coat::ShellLayer::plain(((k - images.start) as usize * every) as f32 / 3.0, k))
                .collect::<Vec<_>>()
        };
        shells.levels = vec![stack(0..4, 1), stack(4..6, 2)];
        Coat { shells: Arc::new(shells), ..square(0.3) }
    });
    for level in [0.0, 0.75, 1.0] {
        let options = Options { detail: pelage_render::Detail::Level(level), ..Options::default() };
        let (mean, most) = difference(&seen(&encoded, squarely(), options), &seen(&decoded, squarely(), options));
        assert!(mean < 0.5 && most <= 8, "level {level}: {mean} {most}");
    }
}
