//! Rays a second through hair, beside triangles of the same number in `obvhs` alone; and how long a picture takes: a table in Markdown.
//!
//! The triangles are the segments again, each flat and as long and wide, so that boxes are alike; `obvhs` meets them in `f32`, in the order of the picture, on as many threads.
//!
//! `cargo run --release -p pelage-reference --example rays`
#![allow(clippy::print_stdout, reason = "an example prints")]

mod common;

use std::hint::black_box;
use std::time::{Duration, Instant};

use glam::{Mat4, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;
use pelage_coat::Coat;
use pelage_reference::{Curves, Laying, Scene, Settings, Shadows, View, quiet};
use pelage_strand::{GrowSettings, StrandTile, Undercoat, grow};
use rayon::prelude::*;

const SIZE: (u32, u32) = (640, 480);
const SAMPLES: u32 = 16;
const RATES: &str = "millions of rays a second: ours, with rays to the light, triangles binary, triangles eight wide";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("| segments | bytes a segment | laying and boxes, s | picture, s | with rays to the light, s | {RATES} |");
    println!("|---|---|---|---|---|---|");
    for (strands, tiles) in [(1400, 1.0), (4600, 2.0), (4600, 3.0), (4600, 5.0)] {
        let undercoat = Undercoat { count: strands * 7 / 10, ..Undercoat::default() };
        let tile = grow(&GrowSettings { count: strands - undercoat.count, undercoat, ..GrowSettings::default() })?;
        measure(&common::ball(24, tiles), &tile)?;
    }
    Ok(())
}

fn measure(coat: &Coat, tile: &StrandTile) -> Result<(), Box<dyn std::error::Error>> {
    let start = Instant::now();
    let scene = Scene::new(coat, tile, &Laying::default())?;
    let built = start.elapsed();
    let counts = scene.counts();
    let view = common::view(coat, SIZE.0 as f32 / SIZE.1 as f32);
    let mut pictures = [0.0; 4];
    for (k, shadows) in [Shadows::Formula, Shadows::Rays].into_iter().enumerate() {
        let start = Instant::now();
        let image = scene.render(&view, &Settings { size: SIZE, samples: SAMPLES, shadows, ..Settings::default() }, &quiet)?;
        pictures[2 * k] = start.elapsed().as_secs_f64();
        pictures[2 * k + 1] = (image.camera_rays + image.shadow_rays) as f64 / pictures[2 * k] / 1e6;
    }
    let rates = triangles(&flat(&scene.curves()?), &view);
    println!(
        "| {} | {:.0} | {:.1} | {:.1} | {:.1} | {:.2}, {:.2}, {:.2}, {:.2} |",
        counts.segments,
        counts.bytes as f64 / counts.segments as f64,
        built.as_secs_f64(),
        pictures[0],
        pictures[2],
        pictures[1],
        pictures[3],
        rates[0],
        rates[1]
    );
    Ok(())
}

/// Every segment as a triangle in its place.
fn flat(curves: &Curves) -> Vec<Triangle> {
    let pairs = curves.0.iter().flat_map(|curve| curve.windows(2));
    pairs
        .map(|pair| {
            let [a, b] = [0, 1].map(|k| Vec3A::new(pair[k][0], pair[k][1], pair[k][2]));
            let aside = (b - a).cross(a).normalize_or_zero() * pair[0][3];
            Triangle { v0: a - aside, v1: a + aside, v2: b }
        })
        .collect()
}

/// Millions of rays a second in `obvhs`, by its two hierarchies.
fn triangles(triangles: &[Triangle], view: &View) -> [f64; 2] {
    let bvh2 = build_bvh2_from_tris(triangles, BvhBuildParams::fast_build(), &mut Duration::default());
    let wide = build_cwbvh_from_tris(triangles, BvhBuildParams::fast_build(), &mut Duration::default());
    let of_bvh2 = rate(view, |ray| {
        bvh2.ray_traverse(ray, &mut RayHit::none(), |ray, id| triangles[bvh2.primitive_indices[id] as usize].intersect(ray));
    });
    let of_wide = rate(view, |ray| {
        wide.ray_traverse(ray, &mut RayHit::none(), |ray, id| triangles[wide.primitive_indices[id] as usize].intersect(ray));
    });
    [of_bvh2, of_wide]
}

fn rate(view: &View, cast: impl Fn(Ray) + Sync) -> f64 {
    let start = Instant::now();
    let coat_from_clip: Mat4 = view.camera.view_projection(SIZE.0 as f32 / SIZE.1 as f32).inverse();
    (0..SIZE.1).into_par_iter().for_each(|y| {
        for (x, sample) in (0..SIZE.0).flat_map(|x| (0..SAMPLES).map(move |sample| (x, sample))) {
            let at = [x as f32 + 0.25 * (sample % 4) as f32, y as f32 + 0.25 * (sample / 4) as f32];
            let clip = Vec3::new(2.0 * at[0] / SIZE.0 as f32 - 1.0, 1.0 - 2.0 * at[1] / SIZE.1 as f32, 0.5);
            let toward = coat_from_clip.project_point3(clip) - view.camera.eye;
            cast(black_box(Ray::new_inf(view.camera.eye.into(), toward.normalize_or(Vec3::Z).into())));
        }
    });
    f64::from(SIZE.0 * SIZE.1 * SAMPLES) / start.elapsed().as_secs_f64() / 1e6
}
