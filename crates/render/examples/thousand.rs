//! A thousand furry balls in somebody else's frame: four coats that share one hair's textures, each a crowd in its own part of the field, and the nearest
//! balls with a view of their own, which gives them fins. Level of detail by distance.
//!
//! `cargo run --release -p pelage-render --example thousand -- PICTURE.png NEAREST` (default `target/thousand.png` and 12) prints times and memory and writes the
//! last frame. `NEAREST` 1000 gives each ball a view of its own, to compare.
#![allow(clippy::print_stdout, reason = "an example prints")]

mod host;
#[path = "../samples/mod.rs"]
mod samples;

use std::error::Error;
use std::f32::consts::TAU;
use std::path::PathBuf;
use std::time::Instant;

use glam::camera::rh::{proj::directx::perspective, view::look_at_mat4};
use glam::{Mat4, Vec3};
use pelage_coat::{Camera, Lights};
use pelage_render::{Crowd, Detail, GpuCoat, Options, PreparedView, Renderer, Target, View, Viewpoint};

use host::{Block, COLOUR, DEPTH, Host, Opaque};
use samples::hair::Recipe;
use samples::levels::with_levels;
use samples::{Dice, Style, coat, light, shapes};

const SIZE: (u32, u32) = (960, 576);
const SUN: Vec3 = Vec3::new(0.45, 0.8, 0.4);
const COUNT: usize = 1000;
const COLUMNS: usize = 25;
const KINDS: usize = 4;
const FRAMES: u32 = 12;

/// A kind of ball: its coat, where those of the crowd stand, and those nearest to the eye, the furthest first.
struct Kind {
    places: Vec<Mat4>,
    crowd: Crowd,
    near: Vec<(Mat4, PreparedView)>,
}

/// Milliseconds of a frame's parts.
#[derive(Clone, Copy, Default)]
struct Times {
    update: f64,
    record: f64,
    draw: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let path: PathBuf = std::env::args_os().nth(1).map_or_else(|| "target/thousand.png".into(), Into::into);
    let nearest = std::env::args().nth(2).and_then(|count| count.parse().ok()).unwrap_or(12);
    let host = Host::new(SIZE, 1)?;
    let ground = Block { low: Vec3::new(-60.0, -0.2, -60.0), high: Vec3::new(60.0, 0.0, 60.0), colour: Vec3::new(0.22, 0.25, 0.2) };
    let opaque = Opaque::new(&host, &[ground], SUN.normalize());
    let target = Target { colour: COLOUR, depth: DEPTH, reversed_depth: false, samples: host.samples };
    let renderer = Renderer::new(&host.device, &host.queue, target);
    let empty = memory(&host);
    let coats = coats(&host, &renderer)?;
    let with_coats = memory(&host);
    let start = Instant::now();
    let mut kinds = kinds(&host, &renderer, coats, nearest)?;
    println!("{COUNT} balls, {nearest} of them with a view of their own, made in {:.0} ms", lap(start));

    // The first frame compiles.
    draw(&host, &renderer, &opaque, &mut kinds, 0)?;
    let times = (1..=FRAMES).map(|frame| draw(&host, &renderer, &opaque, &mut kinds, frame)).collect::<Result<Vec<Times>, _>>()?;
    let of = |pick: fn(&Times) -> f64| median(times.iter().map(pick).collect());
    println!(
        "a frame: {:.1} ms to move the views, {:.1} ms to record, {:.1} ms to draw",
        of(|t| t.update),
        of(|t| t.record),
        of(|t| t.draw)
    );
    let mut by_level = vec![0; 5];
    for kind in &kinds {
        by_level.iter_mut().zip(kind.crowd.seen_by_level()).for_each(|(sum, seen)| *sum += seen);
    }
    println!(
        "seen at each level of detail, the finest first: {by_level:?} in {} draws",
        kinds.iter().map(|kind| kind.crowd.draw_count()).sum::<usize>()
    );
    println!("memory: coats {:.2} MB, views and crowds {:.2} MB", mega(with_coats - empty), mega(memory(&host) - with_coats));
    host.save(&path)?;
    println!("{}", path.display());
    Ok(())
}

/// One frame.
fn draw(host: &Host, renderer: &Renderer, opaque: &Opaque, kinds: &mut [Kind], frame: u32) -> Result<Times, Box<dyn Error>> {
    let start = Instant::now();
    let (clip_from_world, eye) = look(frame);
    opaque.look(host, clip_from_world);
    let world = Viewpoint::placed(clip_from_world, eye, Mat4::IDENTITY, SIZE);
    for Kind { places, crowd, near } in &mut *kinds {
        renderer.update_crowd(&host.device, &host.queue, crowd, (&view(Mat4::IDENTITY), &world), places)?;
        for (place, prepared) in near {
            let viewpoint = Viewpoint::placed(clip_from_world, eye, *place, SIZE);
            renderer.update(&host.device, &host.queue, prepared, &view(*place), &viewpoint)?;
        }
    }
    let update = lap(start);
    let start = Instant::now();
    let mut encoder = host.encoder();
    for kind in &*kinds {
        kind.near.iter().for_each(|(_, prepared)| renderer.compute(&mut encoder, prepared));
    }
    {
        let mut pass = host.pass(&mut encoder, true, true);
        opaque.draw(&mut pass);
        // All that is opaque first, the near before the far: what it hides fails the depth test.
        for Kind { crowd, near, .. } in kinds.iter().rev() {
            near.iter().rev().for_each(|(_, prepared)| renderer.draw_surface(&mut pass, prepared));
            renderer.draw_crowd_surface(&mut pass, crowd);
        }
        // Then the far before the near: near fur lets far fur through.
        for Kind { crowd, near, .. } in &*kinds {
            renderer.draw_crowd_shells(&mut pass, crowd);
            for (_, prepared) in near {
                renderer.draw_fins(&mut pass, prepared);
                renderer.draw_shells(&mut pass, prepared);
            }
        }
    }
    let record = lap(start);
    let start = Instant::now();
    host.finish(encoder)?;
    Ok(Times { update, record, draw: lap(start) })
}

/// Four kinds of ball, one hair.
fn coats(host: &Host, renderer: &Renderer) -> Result<Vec<GpuCoat>, Box<dyn Error>> {
    let hair = with_levels(&Recipe { resolution: 64, ..Recipe::default() }.grow());
    let lengths: [f32; KINDS] = [0.02, 0.035, 0.05, 0.07];
    let mut coats: Vec<GpuCoat> = Vec::new();
    for length in lengths {
        let coat = coat(&shapes::sphere(6, 4.0), Style { length, ..Style::default() }, &hair);
        let uploaded = match coats.first() {
            Some(first) => renderer.upload_sharing(&host.device, &host.queue, &coat, first.textures())?,
            None => renderer.upload(&host.device, &host.queue, &coat)?,
        };
        coats.push(uploaded);
    }
    Ok(coats)
}

/// Scattered over the ground by a seed, each kind in its own part of the field, the furthest first.
fn kinds(host: &Host, renderer: &Renderer, coats: Vec<GpuCoat>, nearest: usize) -> Result<Vec<Kind>, Box<dyn Error>> {
    let (clip_from_world, eye) = look(0);
    let world = Viewpoint::placed(clip_from_world, eye, Mat4::IDENTITY, SIZE);
    let mut places = scattered();
    places.sort_by(|a, b| distance(*b, eye).total_cmp(&distance(*a, eye)));
    let near = COUNT - nearest.min(COUNT);
    let part = COUNT.div_ceil(coats.len());
    let mut kinds = Vec::new();
    for (k, coat) in coats.into_iter().enumerate() {
        let (first, end) = (k * part, ((k + 1) * part).min(COUNT));
        let own = places[near.clamp(first, end)..end].iter().map(|&place| {
            let viewpoint = Viewpoint::placed(clip_from_world, eye, place, SIZE);
            Ok((place, renderer.prepare(&host.device, &host.queue, &coat, &view(place), &viewpoint)?))
        });
        let near_views = own.collect::<Result<Vec<_>, Box<dyn Error>>>()?;
        let crowd = renderer.prepare_crowd(&host.device, &host.queue, &coat, (&view(Mat4::IDENTITY), &world), part as u32)?;
        kinds.push(Kind { places: places[first..near.clamp(first, end)].to_vec(), crowd, near: near_views });
    }
    Ok(kinds)
}

fn scattered() -> Vec<Mat4> {
    let mut dice = Dice::new(7);
    let place = |i: usize| {
        let (column, row) = ((i % COLUMNS) as f32, (i / COLUMNS) as f32);
        let size = dice.between(0.9, 1.8);
        let place = Vec3::new(1.3 * (column - 12.0) + dice.between(-0.3, 0.3), 0.3 * size, 2.0 - 1.3 * row + dice.between(-0.3, 0.3));
        Mat4::from_translation(place) * Mat4::from_rotation_y(dice.between(0.0, TAU)) * Mat4::from_scale(Vec3::splat(size))
    };
    (0..COUNT).map(place).collect()
}

/// The host's camera: from coordinates of the world to clip space, and where the eye is.
fn look(frame: u32) -> (Mat4, Vec3) {
    let eye = Vec3::new(-0.8 + 0.1 * frame as f32, 3.0, 7.0);
    let projection = perspective(0.7, SIZE.0 as f32 / SIZE.1 as f32, 0.1, 100.0);
    (projection * look_at_mat4(eye, Vec3::new(0.0, 0.0, -6.0), Vec3::Y), eye)
}

fn distance(place: Mat4, eye: Vec3) -> f32 {
    place.transform_point3(Vec3::ZERO).distance(eye)
}

/// The world's lights in the coordinates of what stands at a place. Balls are turned about the vertical alone, so that the sky stays where it is.
fn view(world_from_coat: Mat4) -> View {
    let Lights { mut directional, ambient } = light(SUN);
    for light in &mut directional {
        light.direction = world_from_coat.inverse().transform_vector3(light.direction).normalize_or(Vec3::Y);
    }
    // A view carries a camera for those who have none; here the viewpoint says it all.
    let camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 1.0, near: 0.1 };
    let options = Options { detail: Detail::Whole(0.25), ..Options::default() };
    View { options, ..View::new(camera, Lights { directional, ambient }) }
}

/// What the device's allocator has given out, in bytes.
fn memory(host: &Host) -> u64 {
    host.device.generate_allocator_report().map_or(0, |report| report.total_allocated_bytes)
}

fn mega(bytes: u64) -> f64 {
    bytes as f64 / f64::from(1 << 20)
}

fn lap(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
