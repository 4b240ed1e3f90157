//! A tracer of beads: every hair a dense string of spheres, put on the surface one by one, and every ray tried against all of them. It shares no line of mapping, clipping or
//! intersection with the crate.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use glam::{DMat2, DMat3, DVec2, DVec3, Vec2, Vec3};
use pelage_coat::{Camera, Coat};
use pelage_reference::{Laying, Scene, Settings, SkinColours, View, quiet};
use pelage_strand::{StrandSource, StrandTile};
use rayon::prelude::*;
use support::{glow, square, tile};

/// A place on a hair: centre, radius, colour.
struct Bead {
    centre: DVec3,
    radius: f64,
    colour: DVec3,
    /// The face that shows it.
    prism: usize,
}

/// Beads to a straight piece of hair in the tile: a sixth of a radius apart.
const BEADS: usize = 30;
/// Places looked at on the way through a bead.
const STEPS: usize = 12;
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

/// A face of shell space, as shells that are moved out one by one.
struct Prism {
    tile: [DVec2; 3],
    places: [DVec3; 3],
    offsets: [DVec3; 3],
    bends: [DVec3; 3],
    ends: [f64; 3],
    colours: [DVec3; 3],
}

impl Prism {
    fn of(coat: &Coat, face: [u32; 3]) -> Self {
        let vertex = face.map(|v| coat.patches.vertices[v as usize] as usize);
        let surface = &coat.surface;
        let take = |array: &[Vec3]| vertex.map(|v| array[v].as_dvec3());
        Self {
            tile: face.map(|v| coat.patches.coordinates[v as usize].as_dvec2()),
            places: take(&surface.positions),
            offsets: take(&surface.offsets),
            bends: take(&surface.bends),
            ends: vertex.map(|v| f64::from(surface.ends[v])),
            colours: take(&surface.colours),
        }
    }

    fn shell(&self, height: f64) -> [DVec3; 3] {
        [0, 1, 2].map(|k| self.places[k] + self.offsets[k] * height + self.bends[k] * (height * height - height))
    }

    /// The bead of a place of the tile plane at a height, as this face maps it, however far outside.
    fn bead(&self, place: DVec2, height: f64, radius: f64) -> Option<(DVec3, f64, DVec3)> {
        let solved = DMat2::from_cols(self.tile[1] - self.tile[0], self.tile[2] - self.tile[0]).inverse() * (place - self.tile[0]);
        let beta = [1.0 - solved.x - solved.y, solved.x, solved.y];
        let shell = self.shell(height);
        // Heron's, so that not even the area is had the same way.
        let heron = |sides: [f64; 3]| {
            let half = 0.5 * sides.iter().sum::<f64>();
            (half * (half - sides[0]) * (half - sides[1]) * (half - sides[2])).sqrt()
        };
        let area = heron([0, 1, 2].map(|k| shell[k].distance(shell[(k + 1) % 3])));
        let flat = heron([0, 1, 2].map(|k| self.tile[k].distance(self.tile[(k + 1) % 3])));
        let sum = |values: [DVec3; 3]| (0..3).map(|k| beta[k] * values[k]).sum::<DVec3>();
        beta.iter().all(|&b| b > -1.5).then(|| (sum(shell), radius * (area / flat).sqrt(), sum(self.colours)))
    }

    /// Whether a place is over the face and under the hair's end: its shell is found by halving, then areas are compared on it.
    fn holds(&self, place: DVec3) -> bool {
        let above = |height: f64| {
            let [a, b, c] = self.shell(height);
            (place - a).dot((b - a).cross(c - a))
        };
        let (mut low, mut high) = (-0.5, 1.0);
        if above(low) < 0.0 || above(high) > 0.0 {
            return false;
        }
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if above(middle) > 0.0 { low = middle } else { high = middle }
        }
        let [a, b, c] = self.shell(low);
        let normal = (b - a).cross(c - a);
        let part = |from: DVec3, to: DVec3| (from - place).cross(to - place).dot(normal) / normal.length_squared();
        let beta = [part(b, c), part(c, a), part(a, b)];
        beta.iter().all(|&b| b >= 0.0) && low <= (0..3).map(|k| beta[k] * self.ends[k]).sum::<f64>()
    }
}

fn beads(coat: &Coat, tile: &StrandTile) -> (Vec<Prism>, Vec<Bead>) {
    let prisms: Vec<Prism> = coat.patches.faces.iter().map(|&face| Prism::of(coat, face)).collect();
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
                    for (number, prism) in prisms.iter().enumerate() {
                        if let Some((centre, radius, colour)) = prism.bead(DVec2::new(x + f64::from(i), y + f64::from(j)), z, radius) {
                            beads.push(Bead { centre, radius, colour: own * colour, prism: number });
                        }
                    }
                }
            }
        }
    }
    (prisms, beads)
}

/// Colour and coverage of what a ray meets first, and whether that is hair.
fn trace(coat: &Coat, (prisms, beads): &(Vec<Prism>, Vec<Bead>), origin: DVec3, direction: DVec3) -> ([f64; 4], bool) {
    let mut best = (f64::INFINITY, [0.0; 4], false);
    for bead in beads {
        let (to, radius) = (bead.centre - origin, bead.radius);
        let foot = to.dot(direction);
        let squared = radius * radius - (to - direction * foot).length_squared();
        if squared >= 0.0 && foot - squared.sqrt() < best.0 {
            let half = squared.sqrt();
            let way = (0..=STEPS).map(|step| foot - half + 2.0 * half * step as f64 / STEPS as f64);
            let inside =
                way.take_while(|&distance| distance < best.0).find(|&distance| prisms[bead.prism].holds(origin + direction * distance));
            if let Some(distance) = inside {
                best = (distance, [bead.colour.x, bead.colour.y, bead.colour.z, 1.0], true);
            }
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
    let (size, grid) = (28u32, 3u32);
    let camera = Camera { eye: Vec3::new(0.9, -1.6, 1.5), target: Vec3::new(0.0, 0.0, 0.15), up: Vec3::Z, field_of_view: 0.45, near: 0.01 };
    let (lights, shading) = glow();
    let laying = Laying { tolerance: 0.01, skin: SkinColours { under_fur: SKIN, bare: SKIN }, ..Laying::default() };
    let scene = Scene::new(&coat, &tile, &laying).unwrap();
    let view = View { camera, lights, shading };
    let image = scene.render(&view, &Settings { size: (size, size), samples: 256, ..Settings::default() }, &quiet).unwrap();

    let beads = beads(&coat, &tile);
    assert!(beads.1.len() > 5_000, "{} beads", beads.1.len());
    let (eye, target) = (camera.eye.as_dvec3(), camera.target.as_dvec3());
    let forward = (target - eye).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let half = (0.5 * f64::from(camera.field_of_view)).tan();
    let (mut worst, mut sum, mut hair) = (0.0f64, 0.0f64, 0u32);
    // Coverage and colour of each pixel, and how many of its rays met hair.
    let traced = (0..image.pixels.len()).into_par_iter().map(|number| {
        let mut hair = 0;
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
        (mean, hair)
    });
    let traced: Vec<([f64; 4], u32)> = traced.collect();
    for ((mean, met), pixel) in traced.iter().zip(&image.pixels) {
        hair += met;
        let off = (0..4).map(|c| (mean[c] - f64::from(pixel[c])).abs()).fold(0.0, f64::max);
        worst = worst.max(off);
        sum += off;
    }
    let mean = sum / image.pixels.len() as f64;
    println!(
        "mean difference {mean:.5}, largest {worst:.4}, {hair} rays that meet hair, {} beads, {} segments",
        beads.1.len(),
        scene.counts().segments
    );
    assert!(hair > 700, "the picture shows hair: {hair}");
    // Nine samples of an edge are off by a ninth or so; nothing else may be.
    assert!(worst < 0.2 && mean < 0.008, "mean {mean}, worst {worst}");
}
