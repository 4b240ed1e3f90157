//! Where a direction field cannot be continuous, and how often it turns there.

use std::f64::consts::{PI, TAU};

use pelage_mesh::{BoundaryLoop, Face, FaceId, HalfEdge, Mesh};

use crate::fan::{angle_of, lay_out};
use crate::{DirectionField, FieldError};

/// A face around which the field turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singularity {
    /// The face that holds it.
    pub face: FaceId,
    /// How often the field turns anticlockwise, seen from outside, on one anticlockwise round: 1 for a source, sink or whirl, −1 for a saddle.
    pub index: i32,
}

/// The singularities of a direction field, by face.
///
/// The index of a face is the field's turning along its three sides, each taken the short way, with what a vector turns that is transported
/// without turning taken out, over 2π. Vectors are transported as in Knöppel et al. 2013: directions at a vertex are measured by the angles
/// of its faces, stretched so that a full round is 2π. On a closed surface indices add up to χ whatever the field is, so that
/// the sum says nothing; the places do. With boundary they add up to χ plus [`boundary_turning`]. A vertex without a vector counts as one along some fixed
/// tangent. Linear time.
///
/// # Errors
/// Where the field is not of this mesh.
pub fn singularities(mesh: &Mesh, field: &DirectionField) -> Result<Vec<Singularity>, FieldError> {
    let angles = Angles::new(mesh, field)?;
    let singularity = |face: Face<'_, Mesh>| {
        let turning: f64 = face.half_edges().map(|side| angles.turning(side)).into_iter().sum();
        let index = ((turning + angles.curvature(face)) / TAU).round() as i32;
        (index != 0).then_some(Singularity { face: face.id(), index })
    };
    Ok(mesh.faces().filter_map(singularity).collect())
}

/// How often the field turns against the tangent of each boundary loop, walked with the surface on the left; in the order of
/// [`Mesh::boundary_loops`].
///
/// # Errors
/// Where the field is not of this mesh.
pub fn boundary_turning(mesh: &Mesh, field: &DirectionField) -> Result<Vec<i32>, FieldError> {
    let angles = Angles::new(mesh, field)?;
    let turning = |walk: BoundaryLoop<'_, Mesh>| {
        let total: f64 = walk.half_edges().map(|side| angles.turning(side) + angles.rounds[side.origin().index()] - PI).sum();
        (total / TAU).round() as i32
    };
    Ok(mesh.boundary_loops().into_iter().map(turning).collect())
}

/// Directions at vertices as angles.
struct Angles {
    /// The corner at the origin of each half-edge, stretched.
    corners: Vec<f64>,
    /// The direction of each half-edge at its origin, from the first of the fan.
    directions: Vec<f64>,
    /// The field's direction at each vertex, likewise.
    field: Vec<f64>,
    /// What a round of each vertex's fan comes to: 2π inside, the sum of the angles on a boundary.
    rounds: Vec<f64>,
}

impl Angles {
    fn new(mesh: &Mesh, field: &DirectionField) -> Result<Self, FieldError> {
        field.check(mesh)?;
        let topology = mesh.topology();
        let angles: Vec<f64> = mesh.faces().flat_map(Face::angles).collect();
        let mut corners = vec![0.0; angles.len()];
        let mut directions = vec![0.0; angles.len()];
        let mut rounds = vec![0.0; topology.vertex_count()];
        let mut at_vertices = vec![0.0; topology.vertex_count()];
        let normals = mesh.vertex_normals();
        for vertex in mesh.vertices() {
            rounds[vertex.index()] = lay_out(
                vertex,
                |h| angles[h.index()],
                |h, direction, corner| (directions[h.index()], corners[h.index()]) = (direction, corner),
            );
            let vector = field.at_vertex(vertex.id());
            at_vertices[vertex.index()] = angle_of(vertex, normals[vertex.index()], vector, |h| directions[h.index()]);
        }
        Ok(Self { corners, directions, field: at_vertices, rounds })
    }

    /// How much the field turns along a half-edge, −π to π, transport taken out; the other way round its negative exactly.
    fn turning(&self, half_edge: HalfEdge<'_, Mesh>) -> f64 {
        match half_edge.twin() {
            Some(twin) if twin.id() < half_edge.id() => -self.turning_forwards(twin),
            _ => self.turning_forwards(half_edge),
        }
    }

    fn turning_forwards(&self, half_edge: HalfEdge<'_, Mesh>) -> f64 {
        let (from, to, next) = (half_edge.origin(), half_edge.tip(), half_edge.next());
        let backwards = self.directions[next.index()] + self.corners[next.index()];
        let transport = backwards + PI - self.directions[half_edge.index()];
        let turning = self.field[to.index()] - self.field[from.index()] - transport;
        turning - TAU * (turning / TAU).round()
    }

    /// What a vector turns that is transported around the face: the excess of its angles over π.
    fn curvature(&self, face: Face<'_, Mesh>) -> f64 {
        face.half_edges().map(|h| self.corners[h.index()]).into_iter().sum::<f64>() - PI
    }
}
