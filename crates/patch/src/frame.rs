//! Which way each face is to be turned so that the field becomes the tile's t axis.

use std::collections::VecDeque;

use glam::{DVec2, DVec3};
use pelage_field::DirectionField;
use pelage_mesh::{Face, FaceId, Mesh};

use crate::shape::{FaceShape, face_axes};

/// For each face, the rotation (a unit complex number) from its flat layout to the tile: it takes the field to t.
///
/// A face where the field is zero or cancels takes the direction of a neighbour, carried across their common edge.
pub(crate) fn face_rotations(mesh: &Mesh, directions: &DirectionField, shapes: &[FaceShape], tile_side: f64) -> Vec<DVec2> {
    let mut found: Vec<Option<DVec2>> = mesh
        .faces()
        .map(|face| if shapes[face.index()].degenerate { None } else { direction_in_layout(mesh, directions, face.id(), tile_side) })
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
    let mut queue: VecDeque<Face<'_, Mesh>> = mesh.faces().filter(|f| found[f.index()].is_some()).collect();
    for start in mesh.faces() {
        while let Some(face) = queue.pop_front() {
            let Some(direction) = found[face.index()] else { continue };
            for (k, half_edge) in face.half_edges().into_iter().enumerate() {
                let Some(twin) = half_edge.twin() else { continue };
                let neighbour = twin.face();
                if found[neighbour.index()].is_none() {
                    let here = shapes[face.index()].side_direction(k);
                    let there = -shapes[neighbour.index()].side_direction(twin.index() % 3);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::face_shapes;

    /// In space, the direction that each face was given.
    fn in_space(mesh: &Mesh, found: &[Option<DVec2>]) -> Vec<DVec3> {
        let space = |face: Face<'_, Mesh>| {
            let [x, y] = face_axes(mesh, face.id(), 1.0);
            found[face.index()].map_or(DVec3::ZERO, |t| t.x * x + t.y * y)
        };
        mesh.faces().map(space).collect()
    }

    #[test]
    fn one_direction_spreads_over_a_plane_unturned() {
        let mesh = pelage_mesh::plane(3.0, 2.0, 7, 5).unwrap();
        let shapes = face_shapes(&mesh, 1.0);
        let mut found = vec![None; shapes.len()];
        found[33] = Some(DVec2::from_angle(0.7));
        spread(&mesh, &shapes, &mut found);
        let directions = in_space(&mesh, &found);
        assert!(directions.iter().all(|d| d.distance(directions[33]) < 1e-12));
    }

    #[test]
    fn a_component_without_any_direction_gets_one() {
        let mesh = pelage_mesh::rounded_die(1.0, 0.2, 5).unwrap();
        let shapes = face_shapes(&mesh, 1.0);
        let mut found = vec![None; shapes.len()];
        spread(&mesh, &shapes, &mut found);
        assert!(in_space(&mesh, &found).iter().all(|d| (d.length() - 1.0).abs() < 1e-12));
    }

    /// The rotation takes the field to t, (0, 1), and what lies to the right of it, seen from outside, to s.
    #[test]
    fn field_becomes_t() {
        let mesh = pelage_mesh::plane(1.0, 1.0, 1, 1).unwrap();
        let shapes = face_shapes(&mesh, 1.0);
        let field = DirectionField::toward(&mesh, DVec3::X).unwrap();
        for (face, rotation) in mesh.faces().zip(face_rotations(&mesh, &field, &shapes, 1.0)) {
            let [x, y] = face_axes(&mesh, face.id(), 1.0);
            let to_tile = |v: DVec3| rotation.rotate(DVec2::new(v.dot(x), v.dot(y)));
            assert!(to_tile(DVec3::X).distance(DVec2::Y) < 1e-12);
            assert!(to_tile(DVec3::Z).distance(DVec2::X) < 1e-12);
        }
    }
}
