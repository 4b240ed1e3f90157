//! Surfaces that several tests use.
#![allow(dead_code, clippy::print_stdout, reason = "each test takes what it needs, and says what it leaves out")]

use std::f64::consts::TAU;
use std::path::PathBuf;

use glam::DVec3;
use pelage_mesh::{Mesh, VertexId, plane, read_obj};

/// Every real model by its name, the strip with one side cut open; none where no folder of models is given.
pub(crate) fn models() -> Vec<(String, Mesh)> {
    let Some(folder) = std::env::var_os("PELAGE_MODELS") else {
        println!("PELAGE_MODELS is not set: the real models are not looked at");
        return Vec::new();
    };
    let entries = std::fs::read_dir(PathBuf::from(folder).join("real")).unwrap();
    let mut files: Vec<PathBuf> =
        entries.map(|entry| entry.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "obj")).collect();
    files.sort();
    assert!(files.len() >= 13, "only {} models", files.len());
    let name = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
    files.iter().map(|path| (name(path), read_obj(path).unwrap().mesh)).collect()
}

/// Two meshes as one, the second moved.
pub(crate) fn joined(first: &Mesh, second: &Mesh, offset: DVec3) -> Mesh {
    let count = first.positions().len() as u32;
    let positions = first.positions().iter().copied().chain(second.positions().iter().map(|&p| p + offset)).collect();
    let moved = second.topology().triangles().map(|corners| corners.map(|v| v + count));
    let triangles: Vec<_> = first.topology().triangles().chain(moved).collect();
    Mesh::from_triangles(positions, &triangles).unwrap()
}

/// A sheet of 5 by 4 with a square hole of 2 by 2 about its middle, and the hole's corners in turn.
pub(crate) fn sheet_with_hole() -> (Mesh, [DVec3; 4]) {
    let sheet = plane(5.0, 4.0, 20, 16).unwrap();
    let is_kept = |face: &pelage_mesh::Face<'_, Mesh>| face.centre().abs().max_element() > 1.0;
    let triangles: Vec<_> = sheet.faces().filter(is_kept).map(|face| face.vertices().map(|v| v.id().0)).collect();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, z]| DVec3::new(x, 0.0, z));
    (Mesh::from_triangles(sheet.positions().to_vec(), &triangles).unwrap(), corners)
}

/// Flat but for its tip, the first vertex.
pub(crate) struct Fan {
    pub(crate) mesh: Mesh,
    pub(crate) spokes: u32,
}

const RINGS: u32 = 5;

impl Fan {
    /// The vertex of a ring, counted from 1, on a spoke.
    pub(crate) fn spoke(&self, spoke: u32, ring: u32) -> VertexId {
        VertexId(1 + (ring - 1) * self.spokes + spoke)
    }
}

/// A cone of the given height over a unit circle, or with teeth up and down a saddle, cut into five rings.
pub(crate) fn sawtooth_fan(height: f64, tooth: f64) -> Fan {
    let spokes = 12;
    let rim = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(spokes)).sin_cos();
        DVec3::new(cos, if k.is_multiple_of(2) { tooth } else { -tooth } - height, sin)
    };
    let mut positions = vec![DVec3::ZERO];
    positions.extend((1..=RINGS).flat_map(|ring| (0..spokes).map(move |k| rim(k) * f64::from(ring) / f64::from(RINGS))));
    let at = |ring: u32, k: u32| 1 + (ring - 1) * spokes + k % spokes;
    let mut triangles: Vec<_> = (0..spokes).map(|k| [0, at(1, k + 1), at(1, k)]).collect();
    for (ring, k) in (1..RINGS).flat_map(|ring| (0..spokes).map(move |k| (ring, k))) {
        triangles.push([at(ring, k), at(ring, k + 1), at(ring + 1, k)]);
        triangles.push([at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)]);
    }
    Fan { mesh: Mesh::from_triangles(positions, &triangles).unwrap(), spokes }
}

/// A Möbius strip cut open, three quads wide.
pub(crate) fn twisted_strip(quads: u32) -> Mesh {
    let flat = plane(1.0, 1.0, quads, 3).unwrap();
    let place = |p: &DVec3| {
        let (angle, across) = (TAU * (p.x + 0.5), 0.6 * p.z);
        let (sin, cos) = angle.sin_cos();
        let (half_sin, half_cos) = (0.5 * angle).sin_cos();
        DVec3::new((1.0 + across * half_cos) * cos, across * half_sin, (1.0 + across * half_cos) * sin)
    };
    flat.with_positions(flat.positions().iter().map(place).collect()).unwrap()
}
