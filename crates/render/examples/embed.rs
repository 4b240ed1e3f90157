//! Furry meshes in somebody else's frame: their device (wgpu's default limits, no features), their encoder, their depth buffer with 0 at the near plane,
//! their projection, and their boxes, which hide fur and are hidden by it.
//!
//! `cargo run --release -p pelage-render --example embed -- PICTURE.png` (default `target/embed.png`) draws 24 frames and writes the last.
#![allow(clippy::print_stdout, reason = "an example prints")]

mod host;
#[path = "../samples/mod.rs"]
mod samples;

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use glam::camera::rh::{proj::directx::perspective, view::look_at_mat4};
use glam::{Mat4, Vec3};
use pelage_coat::{Camera, Lights};
use pelage_render::{DepthBuffer, GpuCoat, PreparedView, Renderer, Target, View, Viewpoint};

use host::{Block, COLOUR, DEPTH, Host, Opaque};
use samples::hair::Recipe;
use samples::{Style, coat, light, shapes};

const SIZE: (u32, u32) = (960, 576);
const SUN: Vec3 = Vec3::new(0.45, 0.8, 0.4);
const FRAMES: u32 = 24;

/// A coat somewhere in the world.
struct Ball {
    world_from_coat: Mat4,
    prepared: PreparedView,
}

fn main() -> Result<(), Box<dyn Error>> {
    let path: PathBuf = std::env::args_os().nth(1).map_or_else(|| "target/embed.png".into(), Into::into);
    let host = Host::new(SIZE, 4)?;
    let opaque = Opaque::new(&host, &blocks(), SUN.normalize());
    let target = Target { colour: COLOUR, depth: DEPTH, reversed_depth: false, samples: host.samples };
    let renderer = Renderer::new(&host.device, &host.queue, target);
    let mut balls = balls(&host, &renderer)?;

    let mut times = Vec::new();
    for frame in 0..FRAMES {
        let start = Instant::now();
        let (clip_from_world, eye) = look(frame);
        opaque.look(&host, clip_from_world);
        for Ball { world_from_coat, prepared } in &mut balls {
            let viewpoint = Viewpoint::placed(clip_from_world, eye, *world_from_coat, SIZE);
            renderer.update(&host.device, &host.queue, prepared, &view(*world_from_coat), &viewpoint)?;
        }
        // Far fur first: near fur lets it through.
        balls.sort_by(|a, b| distance(b, eye).total_cmp(&distance(a, eye)));
        draw(&host, &renderer, &opaque, &mut balls)?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    println!("{} × {}, {} samples, {FRAMES} frames: median {:.1} ms", SIZE.0, SIZE.1, host.samples, times[times.len() / 2]);
    host.save(&path)?;
    println!("{}", path.display());
    Ok(())
}

/// One frame of the host's, with fur in it.
fn draw(host: &Host, renderer: &Renderer, opaque: &Opaque, balls: &mut [Ball]) -> Result<(), Box<dyn Error>> {
    let mut encoder = host.encoder();
    for ball in &*balls {
        renderer.compute(&mut encoder, &ball.prepared);
    }
    {
        let mut pass = host.pass(&mut encoder, true, false);
        opaque.draw(&mut pass);
        for ball in &*balls {
            renderer.draw_surface(&mut pass, &ball.prepared);
        }
    }
    // All that is opaque is there: what it hides needs no shells.
    for Ball { prepared, .. } in &mut *balls {
        let depth = DepthBuffer { view: &host.depth, size: host.size };
        renderer.find_hidden(&host.device, &host.queue, &mut encoder, prepared, depth);
    }
    {
        let mut pass = host.pass(&mut encoder, false, true);
        for ball in &*balls {
            renderer.draw_fins(&mut pass, &ball.prepared);
            renderer.draw_shells(&mut pass, &ball.prepared);
        }
    }
    host.finish(encoder)
}

/// A floor, and a box between the balls, before the one and behind the other.
fn blocks() -> Vec<Block> {
    vec![
        Block { low: Vec3::new(-8.0, -0.2, -8.0), high: Vec3::new(8.0, 0.0, 8.0), colour: Vec3::new(0.22, 0.25, 0.2) },
        Block { low: Vec3::new(-0.35, 0.0, -0.3), high: Vec3::new(0.55, 1.1, 0.3), colour: Vec3::new(0.5, 0.2, 0.12) },
    ]
}

fn balls(host: &Host, renderer: &Renderer) -> Result<Vec<Ball>, Box<dyn Error>> {
    let hair = Recipe::default().grow();
    let short = coat(&shapes::sphere(16, 7.0), Style::default(), &hair);
    let long = coat(&shapes::sphere(16, 5.0), Style { length: 0.06, ..Style::default() }, &hair);
    let near = renderer.upload(&host.device, &host.queue, &long)?;
    // The same hair: one copy of its textures.
    let far = renderer.upload_sharing(&host.device, &host.queue, &short, near.textures())?;
    let placed = |coat: &GpuCoat, place: Vec3, turn: f32, size: f32| -> Result<Ball, Box<dyn Error>> {
        let world_from_coat = Mat4::from_translation(place) * Mat4::from_rotation_y(turn) * Mat4::from_scale(Vec3::splat(size));
        let (clip_from_world, eye) = look(0);
        let viewpoint = Viewpoint::placed(clip_from_world, eye, world_from_coat, SIZE);
        let prepared = renderer.prepare(&host.device, &host.queue, coat, &view(world_from_coat), &viewpoint)?;
        Ok(Ball { world_from_coat, prepared })
    };
    Ok(vec![placed(&near, Vec3::new(-0.5, 0.5, 0.75), 0.4, 1.6)?, placed(&far, Vec3::new(0.75, 0.72, -0.7), 2.1, 2.4)?])
}

/// The host's camera: from coordinates of the world to clip space, and where the eye is.
fn look(frame: u32) -> (Mat4, Vec3) {
    let turn = 0.45 - 0.02 * frame as f32;
    let eye = Vec3::new(4.2 * turn.sin(), 1.7, 4.2 * turn.cos());
    let projection = perspective(0.65, SIZE.0 as f32 / SIZE.1 as f32, 0.1, 40.0);
    (projection * look_at_mat4(eye, Vec3::new(0.05, 0.6, 0.0), Vec3::Y), eye)
}

fn distance(ball: &Ball, eye: Vec3) -> f32 {
    ball.world_from_coat.transform_point3(Vec3::ZERO).distance(eye)
}

/// The world's lights in the coat's coordinates. Balls are turned about the vertical alone, so that the sky stays where it is.
fn view(world_from_coat: Mat4) -> View {
    let Lights { mut directional, ambient } = light(SUN);
    for light in &mut directional {
        light.direction = world_from_coat.inverse().transform_vector3(light.direction).normalize_or(Vec3::Y);
    }
    View::new(UNUSED, Lights { directional, ambient })
}

/// A view carries a camera for those who have none; here the viewpoint says it all.
const UNUSED: Camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 1.0, near: 0.1 };
