//! Odd coats, odd cameras, other people's passes: a picture or a typed error, never a validation error.

#![allow(clippy::expect_used, clippy::panic, clippy::print_stdout, reason = "a test may panic, and says what it measured")]

mod support;

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};

use glam::{Mat4, Vec2, Vec3};
use pelage_coat::{Camera, Coat, CoatError, FinEdges, Irradiance, Lights, MipImage, PatchMesh, ShellTexture, Surface};
use pelage_lighting::TableLayout;
use pelage_render::{
    Detail, FinRule, Headless, LightingMode, March, Offscreen, Options, RenderError, Renderer, ShadowOptions, ShellDepth, ShellRange,
    Target, View, Viewpoint, render_picture,
};
use wgpu::{
    Color, CommandEncoderDescriptor, Extent3d, LoadOp, Operations, RenderPassColorAttachment, RenderPassDepthStencilAttachment,
    RenderPassDescriptor, StoreOp, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureViewDescriptor,
};

use support::samples::{Dice, background};
use support::stage::Stage;
use support::{SIZE, ball, camera, difference, furry, headless, mean_coverage, picture, sampled, view};

fn draw(coat: &Coat, view: &View, size: (u32, u32), samples: u32) -> Result<pelage_render::Picture, RenderError> {
    let picture = render_picture(headless(), coat, view, size, samples, &background());
    assert_eq!(headless().take_errors(), Vec::<String>::new());
    picture
}

#[test]
fn a_picture_without_pixels_is_empty() {
    for size in [(0, 0), (5, 0), (0, 5)] {
        let picture = draw(&ball(), &view(Options::default()), size, 4).expect("a picture");
        assert!((picture.width, picture.height) == size && picture.rgba.is_empty() && picture.coverage.is_empty());
    }
    assert_eq!(draw(&ball(), &view(Options::default()), (1, 1), 1).expect("a picture").rgba.len(), 4);
}

#[test]
fn a_coat_without_faces_is_background() {
    let mut empty = ball();
    empty.surface = Surface::default();
    empty.patches = PatchMesh::default();
    empty.edges = FinEdges::default();
    let seen = picture(&empty, &view(Options::default()));
    assert!(seen.coverage.iter().all(|&c| c == 0));
    assert_eq!((seen.frame.triangles, seen.frame.fins_considered), (0, 0));
}

#[test]
fn one_layer_and_no_fin_is_skin() {
    let mut plain = ball();
    plain.shells = Arc::new(ShellTexture::stack(1, vec![MipImage { width: 1, height: 1, texels: vec![200, 180, 160, 255] }]));
    plain.fin = None;
    let seen = picture(&plain, &view(Options::default()));
    assert_eq!((seen.frame.shells_drawn, seen.frame.fins_drawn, seen.frame.fins_considered), (0, 0, 0));
    assert!(seen.coverage.contains(&255));
}

#[test]
fn a_coat_without_what_nobody_needs_draws_the_rest() {
    // Everything is asked for, and there is neither hair nor fin to show.
    let options =
        Options { shadows: Some(ShadowOptions { side: 64 }), lighting: LightingMode::Formula, hidden: true, ..Options::default() };
    let mut bare = ball();
    (bare.shells, bare.fin, bare.edges) = (Arc::new(ShellTexture::bare()), None, FinEdges::default());
    let seen = picture(&bare, &view(options));
    assert_eq!((seen.frame.shells_drawn, seen.frame.fins_considered), (0, 0));
    assert!(seen.coverage.contains(&255));
    // Only what was drawn has a time.
    if let Some(passes) = seen.frame.passes {
        assert_eq!([passes.compute, passes.surface, passes.fins, passes.shells].map(|pass| pass.is_some()), [false, true, false, false]);
    }
    let whole = picture(&ball(), &view(options)).frame.passes;
    assert!(whole.is_none_or(|whole| [whole.compute, whole.surface, whole.fins, whole.shells].iter().all(Option::is_some)));
}

#[test]
fn cameras_in_and_about_the_fur_draw() {
    let on_skin = 0.289 * Vec3::Z;
    for eye in [Vec3::ZERO, on_skin, 1.05 * on_skin, 100.0 * Vec3::Z, Vec3::new(0.0, 3.0, 0.0)] {
        for near in [1e-4, 0.01, 10.0] {
            let camera = Camera { eye, target: eye - Vec3::new(0.1, 0.05, 1.0), up: Vec3::Y, field_of_view: 1.2, near };
            picture(&ball(), &View { camera, ..view(Options::default()) });
        }
    }
    picture(&ball(), &view(Options { length_scale: 1e7, ..Options::default() }));
}

#[test]
fn shading_at_its_extremes_draws() {
    let mut extreme = view(Options { lighting: LightingMode::Formula, ..Options::default() });
    for power in [0.0, 1e4, 1e30, f64::MAX] {
        extreme.shading.hair.diffuse_power = power;
        extreme.shading.hair.specular_power = power;
        extreme.shading.self_shadow.density = power;
        picture(&ball(), &extreme);
    }
    // Light exactly from behind: the half vector has no direction.
    extreme.lights.directional[0].direction = -extreme.camera.toward_eye();
    picture(&ball(), &extreme);
}

#[test]
fn views_that_are_no_numbers_are_refused() {
    let fine = view(Options::default());
    let spoiled: [(View, &str); 6] = [
        (View { camera: Camera { eye: camera().target, ..camera() }, ..fine.clone() }, "the camera"),
        (View { camera: Camera { field_of_view: f32::NAN, ..camera() }, ..fine.clone() }, "the camera"),
        (View { camera: Camera { near: f32::INFINITY, ..camera() }, ..fine.clone() }, "the camera"),
        (View { lights: Lights { ambient: Irradiance([Vec3::NAN; 9]), ..fine.lights.clone() }, ..fine.clone() }, "the light"),
        (view(Options { length_scale: f32::NAN, ..Options::default() }), "the length scale, the alpha threshold or the step blur"),
        (
            view(Options { shell_depth: ShellDepth::Written { threshold: f32::NAN }, ..Options::default() }),
            "the length scale, the alpha threshold or the step blur",
        ),
    ];
    for (view, what) in spoiled {
        assert_eq!(draw(&ball(), &view, SIZE, 4).expect_err("refused"), RenderError::View { what });
    }
    let table = LightingMode::Table(TableLayout { size: 1, ..TableLayout::default() });
    let no_table = draw(&ball(), &view(Options { lighting: table, ..Options::default() }), SIZE, 4).expect_err("refused");
    assert!(matches!(no_table, RenderError::Table(_)), "{no_table}");
}

#[test]
fn a_negative_length_is_bald() {
    let bald = picture(&ball(), &view(Options { length_scale: 0.0, ..Options::default() }));
    assert!(picture(&ball(), &view(Options { length_scale: -1.0, ..Options::default() })).rgba == bald.rgba);
}

#[test]
fn coats_that_do_not_agree_are_refused() {
    let mut broken = ball();
    broken.patches.faces[3][1] = 1_000_000;
    let error = draw(&broken, &view(Options::default()), SIZE, 4).expect_err("refused");
    assert!(matches!(error, RenderError::Coat(CoatError::Index { array: "patches.faces", at: 10, .. })), "{error}");
}

#[test]
fn more_than_the_device_holds_is_refused_before_drawing() {
    let limits = headless().device().limits();
    let mut tall = ball();
    // As many shells as a frame lists.
    let layers = 257;
    let texels = vec![255; 4 * layers as usize];
    tall.shells = Arc::new(ShellTexture::stack(layers, vec![MipImage { width: 1, height: 1, texels }]));
    let wide_side = limits.max_texture_dimension_2d + 1;
    let mut wide = ball();
    let texels = vec![255; 4 * wide_side as usize];
    wide.shells = Arc::new(ShellTexture::stack(1, vec![MipImage { width: wide_side, height: 1, texels }]));
    for (coat, most) in [(tall, 256), (wide, limits.max_texture_dimension_2d)] {
        let error = draw(&coat, &view(Options::default()), SIZE, 4).expect_err("refused");
        assert!(matches!(error, RenderError::Limit { limit, needed, .. } if limit == u64::from(most) && needed == limit + 1), "{error}");
    }
    let error = draw(&ball(), &view(Options::default()), (wide_side, 4), 4).expect_err("refused");
    assert!(matches!(error, RenderError::Limit { .. }), "{error}");
    for samples in [0, 2, 3, 64] {
        assert_eq!(draw(&ball(), &view(Options::default()), SIZE, samples).expect_err("refused"), RenderError::Samples { samples });
    }
}

#[test]
fn errors_of_the_device_are_kept_not_printed() {
    let own = Headless::new().unwrap_or_else(|error| panic!("{error}"));
    // Nothing may be both mapped for reading and bound as storage.
    let _ = own.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 4,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    });
    assert!(matches!(own.check(), Err(RenderError::Validation(_))));
    assert_eq!(own.check(), Ok(()));
}

#[test]
fn every_option_draws_without_complaint() {
    for lighting in [LightingMode::PerVertex, LightingMode::Formula, LightingMode::Table(TableLayout::PAPER)] {
        for shell_depth in [ShellDepth::Tested, ShellDepth::Written { threshold: 0.5 }] {
            for left_out in [None, Some(3)] {
                let layers = ShellRange { first: 2, end: 6, left_out };
                // With several samples a software adapter takes its time for it.
                for (samples, anisotropy) in [(1, 16), (4, 2)] {
                    let options = Options { lighting, shell_depth, layers, anisotropy, ..Options::default() };
                    assert!(mean_coverage(&sampled(&ball(), &view(options), samples)) > 0.1);
                }
            }
        }
    }
}

#[test]
fn many_coats_share_one_upload_of_textures() {
    let offscreen = Offscreen::new(headless(), SIZE, 4).expect("a target");
    let first = offscreen.upload(&ball()).expect("a coat");
    let (device, queue) = (headless().device(), headless().queue());
    let second = offscreen.renderer().upload_sharing(device, queue, &ball(), first.textures()).expect("a coat");
    let draw = |coat| offscreen.render(coat, &view(Options::default()), &background()).expect("a picture").rgba;
    assert!(draw(&first) == draw(&second));
}

#[test]
fn several_threads_draw_with_one_target() {
    let target = Offscreen::new(headless(), SIZE, 1).expect("a target");
    let uploaded = target.upload(&ball()).expect("a coat");
    let draw = |length_scale| {
        target.render(&uploaded, &view(Options { length_scale, ..Options::default() }), &background()).expect("a picture").rgba
    };
    let alone = [0.5, 1.0, 1.5].map(draw);
    std::thread::scope(|scope| {
        let threads = [0, 1, 2, 0, 1, 2].map(|k| (k, scope.spawn(move || draw([0.5, 1.0, 1.5][k]))));
        for (k, thread) in threads {
            assert!(thread.join().expect("no panic") == alone[k]);
        }
    });
    assert_eq!(headless().take_errors(), Vec::<String>::new());
}

#[test]
fn a_step_of_a_ten_thousandth_changes_little_wherever_the_eye_is() {
    // On the skin, in the fur, at the tips, behind the near plane of what it looks at, within the ball.
    let radius = 0.288_675_13_f32;
    let out = Vec3::new(0.3, 0.2, 0.93).normalize();
    let mut worst = 0.0_f64;
    for height in [-0.2, 0.0, 1e-3, 0.02, 0.045, 0.06] {
        for near in [1e-4, 1e-2, 1.0, 10.0] {
            for ahead in [out, out.cross(Vec3::Y).normalize(), -out] {
                let at = |step: Vec3| {
                    let eye = out * (radius + height) + 1e-4 * step;
                    let camera = Camera { eye, target: eye + ahead + 0.1 * Vec3::X, up: Vec3::Y, field_of_view: 1.0, near };
                    sampled(&ball(), &View { camera, ..view(Options::default()) }, 4)
                };
                let here = at(Vec3::ZERO);
                for step in [Vec3::X, Vec3::Z] {
                    let (mean, _) = difference(&here, &at(step));
                    worst = worst.max(mean / 255.0);
                    assert!(mean < 2.55, "{height} above the skin, near {near}, looking {ahead}, moved along {step}: {mean} of 255");
                }
            }
        }
    }
    println!("reached: {:.2} % at most", 100.0 * worst);
}

#[test]
fn near_planes_and_lengths_at_their_extremes_draw() {
    let eye = 1.2 * Vec3::Z;
    for near in [1e-4, 1e-2, 1.0, 10.0] {
        let camera = Camera { eye, near, ..camera() };
        let seen = picture(&ball(), &View { camera, ..view(Options::default()) });
        // From beyond the middle on one sees the ball from within.
        assert_eq!(near <= 1.0, seen.coverage.contains(&255), "near {near}");
        assert_eq!(near >= 10.0, seen.coverage.iter().all(|&c| c == 0), "near {near}");
    }
    for length_scale in [1e-30, 1e3, 2e7, f32::MAX] {
        for options in every_feature() {
            let result = draw(&ball(), &view(Options { length_scale, ..options }), SIZE, 1);
            assert!(result.is_ok() || matches!(result, Err(RenderError::View { .. })), "{length_scale}: {result:?}");
        }
    }
}

/// Options that do most at once.
fn every_feature() -> [Options; 2] {
    let most = Options {
        lighting: LightingMode::Formula,
        hair_shadow: 0.7,
        shadows: Some(ShadowOptions { side: 64 }),
        fin_segments: 4,
        hidden: true,
        ..Options::default()
    };
    [most, Options { march: March { layers: 2, steps: 2 }, fin_rule: FinRule::All, ..most }]
}

#[test]
fn one_face_and_bare_coats_draw_with_everything_on() {
    let mut one = ball();
    one.patches.faces.truncate(1);
    one.patches.patch_ends = vec![1];
    let mut bare = ball();
    bare.surface.offsets.fill(Vec3::ZERO);
    let mut empty = ball();
    empty.surface = Surface::default();
    empty.patches = PatchMesh::default();
    empty.edges = FinEdges::default();
    for options in every_feature() {
        let whole = picture(&one, &view(options));
        assert_eq!((whole.frame.faces_furred, whole.frame.patches), (1, 1));
        let bald = picture(&bare, &view(options));
        assert_eq!((bald.frame.shells_drawn, bald.frame.fins_drawn, bald.frame.faces_drawn), (0, 0, 0));
        assert!(bald.coverage.contains(&255));
        assert!(picture(&empty, &view(options)).coverage.iter().all(|&c| c == 0));
    }
}

#[test]
fn targets_of_several_sizes_share_a_device() {
    // As a window does that is resized: each size is drawn as it is alone, and one comes back the same.
    let sizes = [(96, 72), (33, 7), (1, 200), (0, 40), (96, 72)];
    let pictures = sizes.map(|size| draw(&ball(), &view(every_feature()[0]), size, 4).expect("a picture"));
    for (picture, size) in pictures.iter().zip(sizes) {
        assert_eq!((picture.width, picture.height, picture.coverage.len() as u32), (size.0, size.1, size.0 * size.1));
    }
    assert!(pictures[0].rgba == pictures[4].rgba);
}

#[test]
fn a_lost_device_is_reported_and_a_new_one_draws_the_same() {
    let view = view(every_feature()[0]);
    let mut pictures = Vec::new();
    for _ in 0..2 {
        let own = Headless::new().expect("an adapter");
        let target = Offscreen::new(&own, SIZE, 4).expect("a target");
        let uploaded = target.upload(&ball()).expect("a coat");
        pictures.push(target.render(&uploaded, &view, &background()).expect("a picture"));
        own.device().destroy();
        for _ in 0..2 {
            let error = target.render(&uploaded, &view, &background()).expect_err("lost");
            assert!(matches!(error, RenderError::Lost(_)), "{error}");
            let error = target.time(&uploaded, &view, &background(), 1).expect_err("lost");
            assert!(matches!(error, RenderError::Lost(_)), "{error}");
        }
        assert!(matches!(own.check(), Err(RenderError::Lost(_))));
        assert!(matches!(Offscreen::new(&own, SIZE, 4), Err(RenderError::Lost(_))));
    }
    assert!(pictures[0].rgba == pictures[1].rgba);
}

#[test]
fn a_viewpoint_of_no_pixels_is_none_that_fails() {
    let mut stage = Stage::plain();
    let coat = stage.upload(&ball());
    let here = view(Options::default());
    let mut prepared = stage.prepare(&coat, &here);
    let first = stage.frame(&prepared);
    for size in [(0, 0), (0, 9), (9, 0)] {
        stage.size = size;
        stage.update(&mut prepared, &here);
    }
    stage.size = SIZE;
    stage.update(&mut prepared, &here);
    assert!(stage.frame(&prepared) == first);
}

#[test]
fn five_lights_are_refused() {
    let mut many = view(Options::default());
    many.lights.directional = vec![many.lights.directional[0]; 5];
    assert_eq!(draw(&ball(), &many, SIZE, 1).expect_err("refused"), RenderError::Lights { found: 5, limit: 4 });
    many.lights.directional.truncate(4);
    assert!(draw(&ball(), &many, SIZE, 1).is_ok());
}

/// What there is to choose among, and how much of each.
const CHOICES: [usize; 13] = [4, 3, 3, 2, 2, 3, 4, 2, 2, 3, 2, 2, 2];

/// Few lists of choices in which any two choices of any two kinds meet.
fn covering() -> Vec<[usize; CHOICES.len()]> {
    let mut open = BTreeSet::new();
    for (a, &first) in CHOICES.iter().enumerate() {
        for (b, &second) in CHOICES.iter().enumerate().skip(a + 1) {
            open.extend((0..first).flat_map(|x| (0..second).map(move |y| (a, x, b, y))));
        }
    }
    let mut dice = Dice::new(3);
    let mut rows = Vec::new();
    while !open.is_empty() {
        let roll = |dice: &mut Dice| -> [usize; CHOICES.len()] { std::array::from_fn(|k| (dice.roll() * CHOICES[k] as f32) as usize) };
        let met = |row: &[usize; CHOICES.len()]| open.iter().filter(|&&(a, x, b, y)| row[a] == x && row[b] == y).count();
        let best = (0..300).map(|_| roll(&mut dice)).max_by_key(met).unwrap_or_default();
        open.retain(|&(a, x, b, y)| best[a] != x || best[b] != y);
        rows.push(best);
    }
    rows
}

#[test]
fn any_two_options_draw_together_without_complaint() {
    let rows = covering();
    assert!(rows.len() < 40, "{}", rows.len());
    let targets = [(1, true), (4, true), (1, false), (4, false)].map(|(samples, reversed_depth)| {
        let target = Target { reversed_depth, ..Target::new(TextureFormat::Rgba8UnormSrgb, samples) };
        Stage::on(headless().device(), headless().queue(), target)
    });
    for row in rows {
        let [lighting, depth, march, hair_shadow, shadows, detail, target, bent, cut, rule, map, segments, culling] = row;
        let options = Options {
            lighting: [LightingMode::PerPatch, LightingMode::PerVertex, LightingMode::Formula, LightingMode::Table(TableLayout::default())]
                [lighting],
            shell_depth: [ShellDepth::default(), ShellDepth::Tested, ShellDepth::Coverage { threshold: 0.1 }][depth],
            march: [March::default(), March { layers: 2, steps: 1 }, March { layers: 1, steps: 3 }][march],
            hair_shadow: [0.0, 0.8][hair_shadow],
            shadows: [None, Some(ShadowOptions { side: 32 })][shadows],
            detail: [Detail::Level(0.0), Detail::Level(0.8), Detail::Level(2.0)][detail],
            fin_rule: [FinRule::Faded, FinRule::Silhouette { threshold: 0.1 }, FinRule::All][rule],
            fin_segments: [1, 4][segments],
            culling: culling == 1,
            anisotropy: [1, 2][culling],
            ..Options::default()
        };
        let stage = &targets[target];
        let uploaded = stage.upload(&furry(bent == 1, cut == 1, map == 1, detail > 0));
        let prepared = stage.prepare(&uploaded, &view(options));
        let pixels = stage.frame(&prepared);
        assert_eq!(headless().take_errors(), Vec::<String>::new(), "{options:?}");
        let covered = pixels.chunks_exact(4).filter(|pixel| pixel[3] == 255).count();
        assert!((1500..4500).contains(&covered), "{covered} pixels: {options:?}");
        assert!(pixels.chunks_exact(4).all(|pixel| pixel[3] < 255 || pixel[0] > 0), "no black: {options:?}");
    }
}

#[test]
fn depth_from_near_to_far_or_from_far_to_near_is_the_same_picture() {
    let pictures = [true, false].map(|reversed_depth| {
        let target = Target { reversed_depth, ..Target::new(TextureFormat::Rgba8UnormSrgb, 4) };
        let stage = Stage::on(headless().device(), headless().queue(), target);
        let uploaded = stage.upload(&furry(true, true, false, true));
        stage.frame(&stage.prepare(&uploaded, &view(every_feature()[0])))
    });
    // Where surfaces cut through each other, rounding decides.
    let off = pictures[0].iter().zip(&pictures[1]).filter(|(a, b)| a.abs_diff(**b) > 2).count();
    assert!(off < pictures[0].len() / 100, "{off} of {}", pictures[0].len());
}

#[test]
fn a_device_with_no_more_than_wgpus_default_limits_draws_everything() {
    let own = Headless::new().expect("an adapter");
    let descriptor = wgpu::DeviceDescriptor { required_limits: wgpu::Limits::default(), ..wgpu::DeviceDescriptor::default() };
    let (device, queue) = pollster::block_on(own.adapter().request_device(&descriptor)).expect("a device");
    let errors = Arc::new(Mutex::new(Vec::new()));
    let heard = Arc::clone(&errors);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| heard.lock().expect("whole").push(error.to_string())));
    let shared = Stage::on(headless().device(), headless().queue(), Target::new(TextureFormat::Rgba8UnormSrgb, 4));
    let stage = Stage::on(&device, &queue, Target::new(TextureFormat::Rgba8UnormSrgb, 4));
    for options in every_feature() {
        let frame = |stage: &Stage| {
            let uploaded = stage.upload(&furry(true, true, true, true));
            stage.frame(&stage.prepare(&uploaded, &view(Options { detail: Detail::Level(0.8), ..options })))
        };
        assert!(frame(&stage) == frame(&shared));
    }
    assert_eq!(*errors.lock().expect("whole"), Vec::<String>::new());
}

/// Draws two coats into one pass of our own, with near depth 0, and gives back how many pixels are covered.
fn embedded(models: &[Mat4]) -> usize {
    let (device, queue) = (headless().device(), headless().queue());
    let target = Target { depth: TextureFormat::Depth24Plus, reversed_depth: false, ..Target::new(TextureFormat::Rgba8UnormSrgb, 1) };
    let renderer = Renderer::new(device, queue, target);
    let coat = renderer.upload(device, queue, &ball()).expect("a coat");
    let texture = |format, usage| {
        device.create_texture(&TextureDescriptor {
            label: None,
            size: Extent3d { width: 64, height: 64, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format,
            usage: usage | TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        })
    };
    let colour = texture(target.colour, TextureUsages::COPY_SRC);
    let depth = texture(target.depth, TextureUsages::empty());
    let (colour_view, depth_view) = [&colour, &depth].map(|t| t.create_view(&TextureViewDescriptor::default())).into();
    let projection = glam::camera::rh::proj::directx::perspective(0.6, 1.0, 0.1, 10.0);
    let (eye, clip_from_world) = (3.0 * Vec3::Z, projection * Mat4::from_translation(-3.0 * Vec3::Z));
    let prepared: Vec<_> = models
        .iter()
        .map(|model| {
            let coat_from_world = model.inverse();
            let viewpoint = Viewpoint {
                clip_from_coat: clip_from_world * *model,
                eye: coat_from_world.transform_point3(eye),
                toward_eye: coat_from_world.transform_vector3(Vec3::Z).normalize(),
                pixels: Vec2::splat(64.0),
            };
            renderer.prepare(device, queue, &coat, &view(Options::default()), &viewpoint).expect("a view")
        })
        .collect();
    let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
    for view in &prepared {
        renderer.compute(&mut encoder, view);
    }
    {
        let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(RenderPassColorAttachment {
                view: &colour_view,
                depth_slice: None,
                resolve_target: None,
                ops: Operations { load: LoadOp::Clear(Color::TRANSPARENT), store: StoreOp::Store },
            })],
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &depth_view,
                depth_ops: Some(Operations { load: LoadOp::Clear(target.clear_depth()), store: StoreOp::Store }),
                stencil_ops: None,
            }),
            ..RenderPassDescriptor::default()
        });
        for view in &prepared {
            renderer.draw(&mut pass, view);
        }
    }
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 64 * 256,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(256), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        colour.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        Extent3d { width: 64, height: 64, depth_or_array_layers: 1 },
    );
    queue.submit([encoder.finish()]);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    assert_eq!(headless().take_errors(), Vec::<String>::new());
    let bytes = buffer.slice(..).get_mapped_range().expect("mapped");
    bytes.chunks_exact(4).filter(|pixel| pixel[3] > 128).count()
}

#[test]
fn coats_draw_into_a_pass_of_somebody_elses() {
    let one = embedded(&[Mat4::IDENTITY]);
    let small = embedded(&[Mat4::from_scale(Vec3::splat(0.5))]);
    let apart = embedded(&[0.45, -0.45].map(|x| Mat4::from_translation(x * Vec3::X) * Mat4::from_scale(Vec3::splat(0.5))));
    let hidden = embedded(&[Mat4::IDENTITY, Mat4::from_translation(-2.0 * Vec3::Z) * Mat4::from_scale(Vec3::splat(0.5))]);
    assert!(one > 300, "{one}");
    assert!((small as f64 / one as f64 - 0.25).abs() < 0.05, "{small} {one}");
    assert!((apart as f64 / small as f64 - 2.0).abs() < 0.2, "{apart} {small}");
    assert_eq!(hidden, one);
}
