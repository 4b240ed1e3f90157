//! Odd coats, odd cameras, other people's passes: a picture or a typed error, never a validation error.

#![allow(clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod support;

use std::sync::Arc;

use glam::{Mat4, Vec2, Vec3};
use pelage_coat::{Camera, Coat, CoatError, FinEdges, Irradiance, Lights, MipImage, PatchMesh, ShellTexture, Surface};
use pelage_lighting::TableLayout;
use pelage_render::{
    LightingMode, Offscreen, Options, RenderError, Renderer, ShellDepth, ShellRange, Target, View, Viewpoint, render_picture,
};
use wgpu::{
    Color, CommandEncoderDescriptor, Extent3d, LoadOp, Operations, RenderPassColorAttachment, RenderPassDepthStencilAttachment,
    RenderPassDescriptor, StoreOp, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureViewDescriptor,
};

use support::samples::background;
use support::{SIZE, ball, camera, headless, mean_coverage, picture, sampled, view};

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
    let own = pelage_render::Headless::new().unwrap_or_else(|error| panic!("{error}"));
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
                let options = Options { lighting, shell_depth, layers, anisotropy: 16, ..Options::default() };
                for samples in [1, 4] {
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
        renderer.compute(&mut encoder, &coat, view);
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
            renderer.draw(&mut pass, &coat, view);
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
