//! Coats made by hand, for the tests, examples and benchmarks of this crate alone: it knows no mesh, no patches and no strands.
#![allow(dead_code, unreachable_pub, clippy::expect_used, clippy::panic, reason = "shared by several programs, each of which uses a part")]

mod edges;
pub mod hair;
pub mod levels;
pub mod shapes;

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};
use pelage_coat::{Background, Coat, Frame, Irradiance, Light, Lights, PatchMesh, Surface};

use hair::Hair;

/// A surface with tile coordinates, before it has fur.
pub struct Shape {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub patches: PatchMesh,
    /// Tiles per diameter.
    pub tiles: f32,
}

/// How the fur stands.
#[derive(Clone, Copy)]
pub struct Style {
    /// In diameters.
    pub length: f32,
    /// Radians from the normal.
    pub slant: f32,
    /// What it leans towards.
    pub toward: Vec3,
}

impl Default for Style {
    fn default() -> Self {
        Self { length: 0.022, slant: 0.7, toward: Vec3::new(0.0, -1.0, 0.25) }
    }
}

/// Fur on a shape.
pub fn coat(shape: &Shape, style: Style, hair: &Hair) -> Coat {
    let lean = |n: Vec3| (style.toward - n * n.dot(style.toward)).normalize_or_zero();
    let directions: Vec<Vec3> = shape.normals.iter().map(|&n| (n * style.slant.cos() + lean(n) * style.slant.sin()).normalize()).collect();
    let surface = Surface {
        positions: shape.positions.clone(),
        normals: shape.normals.clone(),
        offsets: directions.iter().map(|&d| d * style.length).collect(),
        bends: vec![Vec3::ZERO; directions.len()],
        ends: vec![1.0; directions.len()],
        mixes: vec![0.0; directions.len()],
        directions,
        colours: shape.positions.iter().map(|&p| colour_at(p)).collect(),
    };
    let edges = edges::fin_edges(shape, hair.fin.tiles_across);
    Coat {
        frame: Frame { centre: DVec3::ZERO, diameter: 1.0 },
        surface,
        patches: shape.patches.clone(),
        edges,
        shells: Arc::clone(&hair.shells),
        fin: Some(Arc::clone(&hair.fin)),
    }
}

/// Broad patches of lighter and darker brown.
fn colour_at(p: Vec3) -> Vec3 {
    let wave = (9.0 * p.x + 2.0 * (7.0 * p.y).sin()).sin() * (8.0 * p.z + 1.5 * (6.0 * p.x).cos()).cos();
    Vec3::new(0.95, 0.8, 0.62).lerp(Vec3::new(0.75, 0.5, 0.3), 0.5 + 0.5 * wave)
}

/// A sun from a direction, under a soft sky.
pub fn light(direction: Vec3) -> Lights {
    Lights {
        directional: vec![Light { direction: direction.normalize(), colour: Vec3::new(1.0, 0.96, 0.9) * 1.25 }],
        ambient: Irradiance::hemisphere(Vec3::new(0.34, 0.38, 0.44), Vec3::new(0.16, 0.14, 0.12)),
    }
}

/// A plain grey studio.
pub fn background() -> Background {
    Background { top: Vec3::new(0.30, 0.33, 0.36), bottom: Vec3::new(0.12, 0.12, 0.13) }
}

/// The same shape and coordinates, tile by tile.
pub fn grid(patches: &mut PatchMesh, first: u32, (columns, rows): (u32, u32)) {
    for row in 0..rows {
        for column in 0..columns {
            let a = first + row * (columns + 1) + column;
            let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
            patches.faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    patches.patch_ends.push(patches.faces.len() as u32);
}

/// A random number generator good enough for pictures, without a dependency.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x1234_5678_9abc_def1)
    }

    /// From 0 up to 1.
    pub fn roll(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (mixed >> 40) as f32 / (1u64 << 24) as f32
    }

    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.roll()
    }

    pub fn place(&mut self) -> Vec2 {
        Vec2::new(self.roll(), self.roll())
    }
}
