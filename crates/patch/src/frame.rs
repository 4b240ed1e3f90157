//! Which way each face is to be turned so that the field becomes the tile's t axis.

use std::collections::VecDeque;

use glam::{DVec2, DVec3};
use pelage_field::DirectionField;
use pelage_mesh::{FaceId, Mesh};

use crate::shape::{FaceShape, face_axes};

/// For each face, the rotation (a unit complex number) from its flat layout to the tile: it takes the field to t.
///
/// A face where the field is zero or cancels takes the direction of a neighbour, carried across their common edge.
pub(crate) fn face_rotations(mesh: &Mesh, directions: &DirectionField, shapes: &[FaceShape], tile_side: f64) -> Vec<DVec2> {
    let mut found: Vec<Option<DVec2>> = mesh
        .topology()
        .faces()
        .map(|face| if shapes[face.index()].degenerate { None } else { direction_in_layout(mesh, directions, face, tile_side) })
        .collect();
    spread(mesh, shapes, &mut found);
    // With S the field turned so that (S, T, n) is right-handed, S = (T.y, −T.x), and p ↦ (S·p, T·p) is the rotation T.y + i T.x.
    found.into_iter().map(|t| t.map_or(DVec2::X, |t| DVec2::new(t.y, t.x))).collect()
}

/// The field in a face, as a unit vector of its layout.
pub(crate) fn direction_in_layout(mesh: &Mesh, directions: &DirectionField, face: FaceId, tile_side: f64) -> Option<DVec2> {
    let direction: DVec3 = directions.on_face(mesh, face);
    let [x, y] = face_axes(mesh, face, tile_side);
    let flat = DVec2::new(direction.dot(x), direction.dot(y));
    if flat.is_finite() { flat.try_normalize() } else { None }
}

/// Breadth first from the faces that have a direction; a component without any starts at its first face, along that face's first side.
fn spread(mesh: &Mesh, shapes: &[FaceShape], found: &mut [Option<DVec2>]) {
    let mut queue: VecDeque<FaceId> = mesh.topology().faces().filter(|f| found[f.index()].is_some()).collect();
    for start in mesh.topology().faces() {
        while let Some(face) = queue.pop_front() {
            let Some(direction) = found[face.index()] else { continue };
            for (k, half_edge) in face.half_edges().into_iter().enumerate() {
                let Some(twin) = mesh.topology().twin(half_edge) else { continue };
                let neighbour = twin.face();
                if found[neighbour.index()].is_none() {
                    let here = shapes[face.index()].side_direction(k);
                    let there = -shapes[neighbour.index()].side_direction((twin.0 % 3) as usize);
                    found[neighbour.index()] = there.rotate(conjugate(here).rotate(direction)).try_normalize();
                    queue.push_back(neighbour);
                }
            }
        }
        if found[start.index()].is_none() {
            found[start.index()] = Some(DVec2::X);
            queue.push_back(start);
        }
    }
}

/// The opposite rotation.
pub(crate) fn conjugate(rotation: DVec2) -> DVec2 {
    DVec2::new(rotation.x, -rotation.y)
}
