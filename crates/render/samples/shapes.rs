//! Surfaces with tile coordinates.

use std::collections::BTreeMap;
use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use pelage_coat::PatchMesh;

use super::{Shape, grid};

/// A sphere of diameter 0.58 (its box has diameter 1), a cube's six sides blown up: 12 n² faces, six patches.
pub fn sphere(n: u32, tiles: f32) -> Shape {
    const RADIUS: f32 = 0.288_675_13;
    let sides = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
    let mut shape = Shape { positions: vec![], normals: vec![], patches: PatchMesh::default(), tiles };
    let mut known: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    for (i, &out) in sides.iter().enumerate() {
        let right = if out.y.abs() > 0.5 { Vec3::X } else { Vec3::Y.cross(out) };
        let up = out.cross(right);
        let first = shape.patches.vertices.len() as u32;
        for row in 0..=n {
            for column in 0..=n {
                // Evenly spaced angles, not cube coordinates.
                let at = |k: u32| ((k as f32 / n as f32 - 0.5) * TAU / 4.0).tan();
                let normal = (out + right * at(column) + up * at(row)).normalize();
                let key = normal.to_array().map(|c| (f64::from(c) * 1e5).round() as i64);
                let next = shape.positions.len() as u32;
                let vertex = *known.entry(key).or_insert(next);
                if vertex == next {
                    shape.positions.push(RADIUS * normal);
                    shape.normals.push(normal);
                }
                let across = RADIUS * TAU / 4.0 * tiles;
                shape.patches.vertices.push(vertex);
                shape.patches.coordinates.push(Vec2::new(column as f32, row as f32) / n as f32 * across + 0.37 * i as f32);
            }
        }
        grid(&mut shape.patches, first, (n, n));
    }
    shape
}

/// A torus about the y axis: a whole number of tiles each way, one patch.
pub fn torus((columns, rows): (u32, u32), (around, across): (u32, u32)) -> Shape {
    let (major, minor) = (0.26, 0.11);
    let mut shape = Shape { positions: vec![], normals: vec![], patches: PatchMesh::default(), tiles: around as f32 / (TAU * major) };
    for row in 0..rows {
        for column in 0..columns {
            let (a, b) = (column as f32 / columns as f32 * TAU, row as f32 / rows as f32 * TAU);
            let out = Vec3::new(a.sin(), 0.0, a.cos());
            let normal = out * b.cos() + Vec3::Y * b.sin();
            shape.positions.push(major * out + minor * normal);
            shape.normals.push(normal);
        }
    }
    for row in 0..=rows {
        for column in 0..=columns {
            shape.patches.vertices.push((row % rows) * columns + column % columns);
            shape.patches.coordinates.push(Vec2::new((column * around) as f32 / columns as f32, (row * across) as f32 / rows as f32));
        }
    }
    grid(&mut shape.patches, 0, (columns, rows));
    shape
}

/// A square of side 0.7 in the plane z = 0, looking along +z: 2 n² faces.
pub fn square(n: u32, tiles: f32) -> Shape {
    const SIDE: f32 = 0.707_106_77;
    let mut shape = Shape { positions: vec![], normals: vec![], patches: PatchMesh::default(), tiles };
    for row in 0..=n {
        for column in 0..=n {
            let at = Vec2::new(column as f32, row as f32) / n as f32;
            shape.patches.vertices.push(shape.positions.len() as u32);
            shape.patches.coordinates.push(at * SIDE * tiles);
            shape.positions.push(((at - 0.5) * SIDE).extend(0.0));
            shape.normals.push(Vec3::Z);
        }
    }
    grid(&mut shape.patches, 0, (n, n));
    shape
}
