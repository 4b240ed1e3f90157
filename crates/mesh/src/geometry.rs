//! A topology with positions.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::{FaceId, Topology, TopologyError, VertexId};

/// A triangle mesh: a shared [`Topology`], a position for each vertex in the model's own units, and texture coordinates if it has them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    topology: Arc<Topology>,
    positions: Vec<DVec3>,
    texture_coordinates: Option<Vec<DVec2>>,
}

/// Why positions and topology make no mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The triangles are no oriented manifold.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// One position a vertex is needed.
    #[error("{positions} positions for {vertices} vertices; give one for each")]
    PositionCount {
        /// Positions given.
        positions: usize,
        /// Vertices of the topology.
        vertices: usize,
    },
    /// One pair of texture coordinates a half-edge is needed.
    #[error("{coordinates} texture coordinates for {corners} face corners; give one for each, or none")]
    CoordinateCount {
        /// Coordinates given.
        coordinates: usize,
        /// Corners of the topology.
        corners: usize,
    },
    /// A position is NaN or infinite.
    #[error("vertex {vertex} is at {position}, which is no place; mend the position")]
    NotFinite {
        /// The vertex.
        vertex: u32,
        /// Its position.
        position: DVec3,
    },
}

impl Mesh {
    /// Joins positions and a topology.
    ///
    /// # Errors
    /// Where their counts differ, or a position is not finite.
    pub fn new(topology: Arc<Topology>, positions: Vec<DVec3>) -> Result<Self, MeshError> {
        if positions.len() != topology.vertex_count() {
            return Err(MeshError::PositionCount { positions: positions.len(), vertices: topology.vertex_count() });
        }
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(MeshError::NotFinite { vertex: vertex as u32, position: positions[vertex] });
        }
        Ok(Self { topology, positions, texture_coordinates: None })
    }

    /// Joins positions and triangles.
    ///
    /// # Errors
    /// Where the triangles are no oriented manifold, or a position is not finite.
    pub fn from_triangles(positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> Result<Self, MeshError> {
        Self::new(Arc::new(Topology::from_triangles(positions.len(), triangles)?), positions)
    }

    /// The same mesh with texture coordinates, one pair for each half-edge (the corner it starts at), u to the right and v up.
    ///
    /// # Errors
    /// Where there is not one for each half-edge.
    pub fn with_texture_coordinates(mut self, coordinates: Vec<DVec2>) -> Result<Self, MeshError> {
        let corners = self.topology.half_edge_count();
        if coordinates.len() != corners {
            return Err(MeshError::CoordinateCount { coordinates: coordinates.len(), corners });
        }
        self.texture_coordinates = Some(coordinates);
        Ok(self)
    }

    /// Which faces, edges and vertices touch.
    pub fn topology(&self) -> &Arc<Topology> {
        &self.topology
    }

    /// A position for each vertex.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// A pair of texture coordinates for each half-edge, if the model has them.
    pub fn texture_coordinates(&self) -> Option<&[DVec2]> {
        self.texture_coordinates.as_deref()
    }

    /// Where a vertex is.
    #[inline]
    pub fn position(&self, vertex: VertexId) -> DVec3 {
        self.positions[vertex.index()]
    }

    /// Where the corners of a face are, in winding order.
    #[inline]
    pub fn face_positions(&self, face: FaceId) -> [DVec3; 3] {
        self.topology.face_vertices(face).map(|v| self.position(v))
    }

    /// The middle of a face.
    pub fn face_centre(&self, face: FaceId) -> DVec3 {
        let [a, b, c] = self.face_positions(face);
        (a + b + c) / 3.0
    }

    /// Half the cross product of two sides: along the normal, as long as the face's area.
    #[inline]
    pub fn face_area_vector(&self, face: FaceId) -> DVec3 {
        let [a, b, c] = self.face_positions(face);
        0.5 * (b - a).cross(c - a)
    }

    /// The area of a face.
    pub fn face_area(&self, face: FaceId) -> f64 {
        self.face_area_vector(face).length()
    }

    /// The unit normal of a face; zero for a face without area.
    pub fn face_normal(&self, face: FaceId) -> DVec3 {
        self.face_area_vector(face).normalize_or_zero()
    }

    /// The unit normal at each vertex: the mean of its faces' normals weighted by their angle there (Thürmer and Wüthrich 1998),
    /// which does not depend on how a flat region is cut into faces. Zero for an unreferenced vertex.
    pub fn vertex_normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for face in self.topology.faces() {
            let normal = self.face_normal(face);
            let corners = self.topology.face_vertices(face);
            for k in 0..3 {
                let [here, next, previous] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|v| self.position(v));
                let angle = (next - here).angle_between(previous - here);
                if angle.is_finite() {
                    normals[corners[k].index()] += normal * angle;
                }
            }
        }
        normals.into_iter().map(DVec3::normalize_or_zero).collect()
    }

    /// The least and greatest corner of the box around the referenced vertices; `None` for a mesh without faces.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let corners = self.topology.faces().flat_map(|face| self.face_positions(face));
        corners.fold(None, |bounds, p| {
            let (low, high) = bounds.unwrap_or((p, p));
            Some((low.min(p), high.max(p)))
        })
    }

    /// The length of the diagonal of [`Mesh::bounds`], which the project calls the model's *diameter*; 0 without faces.
    pub fn diameter(&self) -> f64 {
        self.bounds().map_or(0.0, |(low, high)| low.distance(high))
    }

    /// How many bytes it holds, for a cache to count.
    pub fn byte_size(&self) -> usize {
        let corners = self.topology.half_edge_count();
        let coordinates = self.texture_coordinates.as_ref().map_or(0, |c| c.len() * size_of::<DVec2>());
        8 * corners + self.positions.len() * (4 + size_of::<DVec3>()) + coordinates
    }
}
