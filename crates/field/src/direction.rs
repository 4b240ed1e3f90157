//! Tangent directions.

use glam::DVec3;
use pelage_mesh::{FaceId, Mesh, VertexId};

/// A unit tangent vector at each vertex, in model coordinates: which way the fur lies.
///
/// Unreferenced vertices, and vertices where no direction could be found, hold zero.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionField {
    vectors: Vec<DVec3>,
}

impl DirectionField {
    /// Takes vectors as they are: unit and tangent, or zero.
    pub(crate) fn from_unit_tangents(vectors: Vec<DVec3>) -> Self {
        Self { vectors }
    }

    /// The vectors, one for each vertex.
    pub fn vectors(&self) -> &[DVec3] {
        &self.vectors
    }

    /// The unit tangent at a vertex; zero where there is none.
    #[inline]
    pub fn at_vertex(&self, vertex: VertexId) -> DVec3 {
        self.vectors[vertex.index()]
    }

    /// The unit direction in the plane of a face: the mean of its corners' vectors, projected; zero where they cancel.
    pub fn on_face(&self, mesh: &Mesh, face: FaceId) -> DVec3 {
        let sum: DVec3 = mesh.topology().face_vertices(face).map(|v| self.at_vertex(v)).into_iter().sum();
        let normal = mesh.face_normal(face);
        let tangent = sum - normal * sum.dot(normal);
        if tangent.length() > 1e-9 { tangent.normalize() } else { DVec3::ZERO }
    }
}
