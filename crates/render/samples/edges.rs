//! The edges of a shape, found by their ends.

use std::collections::BTreeMap;

use glam::Vec3;
use pelage_coat::FinEdges;

use super::{Dice, Shape};

/// Every edge once, with a random interval of the fin texture.
pub fn fin_edges(shape: &Shape, tiles_across: f32) -> FinEdges {
    let corners = |face: &[u32; 3]| face.map(|corner| shape.patches.vertices[corner as usize]);
    let mut sides: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (f, face) in shape.patches.faces.iter().enumerate() {
        let [a, b, c] = corners(face);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            sides.entry([from.min(to), from.max(to)]).or_default().push(f);
        }
    }
    let geometry: Vec<(Vec3, Vec3)> = shape
        .patches
        .faces
        .iter()
        .map(|face| {
            let [a, b, c] = corners(face).map(|v| shape.positions[v as usize]);
            ((b - a).cross(c - a).normalize_or_zero(), (a + b + c) / 3.0)
        })
        .collect();
    let mut dice = Dice::new(11);
    let mut edges = FinEdges::default();
    for ([a, b], faces) in sides {
        let (first, last) = (geometry[faces[0]], geometry[faces[faces.len() - 1]]);
        let span = (shape.positions[a as usize] - shape.positions[b as usize]).length() * shape.tiles / tiles_across;
        let start = dice.roll();
        edges.vertices.push([a, b]);
        edges.intervals.push([start, start + span]);
        // At a boundary there is no second face, and no normal.
        edges.face_normals.push([first.0, if faces.len() > 1 { last.0 } else { Vec3::ZERO }]);
        let apart = (first.1 - last.1).length();
        edges.curvatures.push(if apart > 0.0 { first.0.angle_between(last.0) / apart } else { 0.0 });
    }
    edges
}
