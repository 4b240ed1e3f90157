//! A tracer of beads: every hair a dense string of spheres, put on the surface one by one, and every ray tried against all of them. It shares no line of mapping, clipping or
//! intersection with the crate.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use glam::{DMat2, DMat3, DVec2, DVec3, Vec2, Vec3};
use pelage_coat::{Camera, Coat};
use pelage_reference::{Laying, Scene, Settings, SkinColours, View, quiet};
use pelage_strand::{StrandSource, StrandTile};
use support::{glow, square, tile};

/// A place on a hair: centre, radius, colour.
struct Bead {
    centre: DVec3,
    radius: f64,
    colour: DVec3,
}

/// Beads to a straight piece of hair in the tile: a hundredth of a radius apart.
const BEADS: usize = 1200;
const SKIN: DVec3 = DVec3::new(0.2, 0.15, 0.3);

/// The square pulled into a dome, with fur that leans, bends, differs in length and is cut.
fn dome() -> Coat {
    let mut coat = square(5, 1.6);
    for v in 0..coat.surface.positions.len() {
        let p = coat.surface.positions[v];
        let lifted = p + Vec3::new(0.0, 0.0, 0.35 - 0.7 * p.length_squared());
        coat.surface.positions[v] = lifted;
        let normal = Vec3::new(1.4 * p.x, 1.4 * p.y, 1.0).normalize();
        coat.surface.normals[v] = normal;
        coat.surface.offsets[v] = (0.16 + 0.1 * p.x) * (normal + Vec3::new(0.5, 0.2, 0.0));
        coat.surface.bends[v] = 0.05 * Vec3::new(0.3, 0.1 + p.y, -0.4);
        coat.surface.ends[v] = 0.75 + p.y;
        coat.surface.colours[v] = Vec3::new(0.5 + p.x, 0.6, 0.5 + p.y);
        // The tile lies askew and stretched.
        let at = coat.patches.coordinates[v];
        coat.patches.coordinates[v] = Vec2::new(1.1 * at.x + 0.4 * at.y - 0.3, 0.9 * at.y - 0.2 * at.x + 2.1);
    }
    coat
}

fn strands() -> StrandTile {
    let strand = |x: f64, y: f64, lean: f64, turn: f64, tip: f64| StrandSource {
        points: (0..4)
            .map(|k| f64::from(k) / 3.0)
            .map(|t| [x + lean * t * (turn + t).cos(), y + lean * t * (turn + t).sin(), t * tip])
            .collect(),
        radii: vec![0.07, 0.06, 0.045, 0.012],
        root_colour: [0.9, 0.3, 0.2],
        tip_colour: [0.2, 0.5, 0.9],
    };
    tile(&[
        strand(0.1, 0.15, 0.2, 0.4, 1.0),
        strand(0.6, 0.4, 0.45, 2.0, 0.8),
        strand(0.35, 0.85, 0.3, 4.5, 1.0),
        strand(0.85, 0.8, 0.1, 1.0, 0.6),
    ])
}

/// Where a place of shell space is: the face found by trying all of them, the shell's three corners moved out first, the place taken between them.
fn on_surface(coat: &Coat, place: DVec2, height: f64) -> Option<(DVec3, f64, DVec3)> {
    let patches = &coat.patches;
    patches.faces.iter().find_map(|face| {
        let tile = face.map(|v| patches.coordinates[v as usize].as_dvec2());
        let solved = DMat2::from_cols(tile[1] - tile[0], tile[2] - tile[0]).inverse() * (place - tile[0]);
        let beta = [1.0 - solved.x - solved.y, solved.x, solved.y];
        if beta.iter().any(|&b| b < 0.0) {
            return None;
        }
        let vertex = face.map(|v| patches.vertices[v as usize] as usize);
        let surface = &coat.surface;
        let end: f64 = (0..3).map(|k| beta[k] * f64::from(surface.ends[vertex[k]])).sum();
        if height > end || height > 1.0 {
            return None;
        }
        let corner = vertex.map(|v| {
            let (p, c, b) = (surface.positions[v].as_dvec3(), surface.offsets[v].as_dvec3(), surface.bends[v].as_dvec3());
            p + c * height + b * (height * height - height)
        });
        let centre = (0..3).map(|k| beta[k] * corner[k]).sum();
        let colour = (0..3).map(|k| beta[k] * surface.colours[vertex[k]].as_dvec3()).sum();
        // Heron's, so that not even the area is had the same way.
        let heron = |sides: [f64; 3]| {
            let half = 0.5 * sides.iter().sum::<f64>();
            (half * (half - sides[0]) * (half - sides[1]) * (half - sides[2])).sqrt()
        };
        let shell = heron([0, 1, 2].map(|k| corner[k].distance(corner[(k + 1) % 3])));
        let flat = heron([0, 1, 2].map(|k| tile[k].distance(tile[(k + 1) % 3])));
        Some((centre, (shell / flat).sqrt(), colour))
    })
}

fn beads(coat: &Coat, tile: &StrandTile) -> Vec<Bead> {
    let mut beads = Vec::new();
    for strand in tile.strands() {
        let last = strand.points.len() - 1;
        for (index, (points, radii)) in strand.points.windows(2).zip(strand.radii.windows(2)).enumerate() {
            for bead in 0..=BEADS {
                let t = bead as f64 / BEADS as f64;
                let [x, y, z] = [0, 1, 2].map(|k| f64::from(points[0][k]) * (1.0 - t) + f64::from(points[1][k]) * t);
                let radius = f64::from(radii[0]) * (1.0 - t) + f64::from(radii[1]) * t;
                let along = (index as f64 + t) / last as f64;
                let own = DVec3::from(strand.root_colour.map(f64::from)).lerp(DVec3::from(strand.tip_colour.map(f64::from)), along);
                for (i, j) in (-4..8).flat_map(|i| (-4..8).map(move |j| (i, j))) {
                    if let Some((centre, side, colour)) = on_surface(coat, DVec2::new(x + f64::from(i), y + f64::from(j)), z) {
                        beads.push(Bead { centre, radius: radius * side, colour: own * colour });
                    }
                }
            }
        }
    }
    beads
}

/// Colour and coverage of what a ray meets first, and whether that is hair.
fn trace(coat: &Coat, beads: &[Bead], origin: DVec3, direction: DVec3) -> ([f64; 4], bool) {
    let mut best = (f64::INFINITY, [0.0; 4], false);
    for bead in beads {
        let (to, radius) = (bead.centre - origin, bead.radius);
        let foot = to.dot(direction);
        let squared = radius * radius - (to - direction * foot).length_squared();
        if squared >= 0.0 && foot - squared.sqrt() < best.0 {
            best = (foot - squared.sqrt(), [bead.colour.x, bead.colour.y, bead.colour.z, 1.0], true);
        }
    }
    for face in &coat.patches.faces {
        let vertex = face.map(|v| coat.patches.vertices[v as usize] as usize);
        let [a, b, c] = vertex.map(|v| coat.surface.positions[v].as_dvec3());
        let solved = DMat3::from_cols(b - a, c - a, -direction).inverse() * (origin - a);
        if solved.x >= 0.0 && solved.y >= 0.0 && solved.x + solved.y <= 1.0 && solved.z > 0.0 && solved.z < best.0 {
            let mixed = |values: [Vec3; 3]| {
                (values[0] * (1.0 - solved.x as f32 - solved.y as f32) + values[1] * solved.x as f32 + values[2] * solved.y as f32)
                    .as_dvec3()
            };
            let colour = SKIN * mixed(vertex.map(|v| coat.surface.colours[v]));
            best = (solved.z, [colour.x, colour.y, colour.z, 1.0], false);
        }
    }
    (best.1, best.2)
}

#[test]
fn pixels_are_those_of_a_tracer_of_beads() {
    let (coat, tile) = (dome(), strands());
    let (size, grid) = (48u32, 3u32);
    let camera = Camera { eye: Vec3::new(0.9, -1.6, 1.5), target: Vec3::new(0.0, 0.0, 0.15), up: Vec3::Z, field_of_view: 0.45, near: 0.01 };
    let (lights, shading) = glow();
    let laying = Laying { tolerance: 0.01, skin: SkinColours { under_fur: SKIN, bare: SKIN }, ..Laying::default() };
    let scene = Scene::new(&coat, &tile, &laying).unwrap();
    let view = View { camera, lights, shading };
    let image = scene.render(&view, &Settings { size: (size, size), samples: 256, ..Settings::default() }, &quiet).unwrap();

    let beads = beads(&coat, &tile);
    assert!(beads.len() > 20_000, "{} beads", beads.len());
    let (eye, target) = (camera.eye.as_dvec3(), camera.target.as_dvec3());
    let forward = (target - eye).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let half = (0.5 * f64::from(camera.field_of_view)).tan();
    let (mut worst, mut sum, mut hair) = (0.0f64, 0.0f64, 0u32);
    for (number, pixel) in image.pixels.iter().enumerate() {
        let (x, y) = ((number as u32 % size) as f64, (number as u32 / size) as f64);
        let mut mean = [0.0; 4];
        for sample in 0..grid * grid {
            let at = [x + (f64::from(sample % grid) + 0.5) / f64::from(grid), y + (f64::from(sample / grid) + 0.5) / f64::from(grid)];
            let plane = at.map(|c| (2.0 * c / f64::from(size) - 1.0) * half);
            let direction = (forward + right * plane[0] - up * plane[1]).normalize();
            let (seen, is_hair) = trace(&coat, &beads, eye, direction);
            hair += u32::from(is_hair);
            (0..4).for_each(|c| mean[c] += seen[c] / f64::from(grid * grid));
        }
        let off = (0..4).map(|c| (mean[c] - f64::from(pixel[c])).abs()).fold(0.0, f64::max);
        worst = worst.max(off);
        sum += off;
    }
    let mean = sum / image.pixels.len() as f64;
    println!(
        "mean difference {mean:.5}, largest {worst:.4}, {hair} rays that meet hair, {} beads, {} segments",
        beads.len(),
        scene.counts().segments
    );
    assert!(hair > 2000, "the picture shows hair: {hair}");
    // Nine samples of an edge are off by a ninth or so; nothing else may be.
    assert!(worst < 0.2 && mean < 0.008, "mean {mean}, worst {worst}");
}
