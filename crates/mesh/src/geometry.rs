//! A topology with positions.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec4};

use crate::vector::unit;
use crate::{Edge, Face, Topology, TopologyError};

/// A triangle mesh: a shared [`Topology`], a position for each vertex in the model's own units, and texture coordinates and colours if it has them.
///
/// Of one vertex, edge or face it is asked through views: `mesh.face(f).normal()`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    topology: Arc<Topology>,
    positions: Vec<DVec3>,
    texture_coordinates: Option<Vec<DVec2>>,
    colours: Option<Vec<Vec4>>,
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
    /// A texture coordinate is NaN or infinite.
    #[error("corner {corner} of face {face} has texture coordinates that are not finite; mend them or leave all of them out")]
    CoordinateNotFinite {
        /// The face.
        face: u32,
        /// Which of its corners, 0 to 2.
        corner: u32,
    },
    /// One colour a vertex is needed.
    #[error("{colours} colours for {vertices} vertices; give one for each, or none")]
    ColourCount {
        /// Colours given.
        colours: usize,
        /// Vertices of the topology.
        vertices: usize,
    },
    /// A colour is NaN or infinite.
    #[error("vertex {vertex} has a colour that is not finite; mend it or leave all of them out")]
    ColourNotFinite {
        /// The vertex.
        vertex: u32,
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
        Ok(Self { topology, positions, texture_coordinates: None, colours: None })
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
    /// Where there is not one for each half-edge, or one is not finite.
    pub fn with_texture_coordinates(mut self, coordinates: Vec<DVec2>) -> Result<Self, MeshError> {
        let corners = self.topology.half_edge_count();
        if coordinates.len() != corners {
            return Err(MeshError::CoordinateCount { coordinates: coordinates.len(), corners });
        }
        if let Some(half_edge) = coordinates.iter().position(|c| !c.is_finite()) {
            return Err(MeshError::CoordinateNotFinite { face: half_edge as u32 / 3, corner: half_edge as u32 % 3 });
        }
        self.texture_coordinates = Some(coordinates);
        Ok(self)
    }

    /// The same mesh with a colour for each vertex: red, green and blue in linear light with the primaries of sRGB, and alpha, each 0 to 1 as a rule.
    ///
    /// # Errors
    /// Where there is not one for each vertex, or one is not finite.
    pub fn with_colours(mut self, colours: Vec<Vec4>) -> Result<Self, MeshError> {
        if colours.len() != self.positions.len() {
            return Err(MeshError::ColourCount { colours: colours.len(), vertices: self.positions.len() });
        }
        if let Some(vertex) = colours.iter().position(|colour| !colour.is_finite()) {
            return Err(MeshError::ColourNotFinite { vertex: vertex as u32 });
        }
        self.colours = Some(colours);
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

    /// A colour for each vertex, if the model has them: linear red, green, blue, and alpha.
    pub fn colours(&self) -> Option<&[Vec4]> {
        self.colours.as_deref()
    }

    /// The unit normal at each vertex: the mean of its faces' normals weighted by their angle there (Thürmer and Wüthrich 1998),
    /// which does not depend on how a flat region is cut into faces. Zero for an unreferenced vertex.
    pub fn vertex_normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for face in self.faces() {
            let normal = face.normal();
            for (corner, angle) in face.vertices().into_iter().zip(face.angles()) {
                normals[corner.index()] += normal * angle;
            }
        }
        normals.into_iter().map(unit).collect()
    }

    /// The mean length of the edges, each counted once, in model units; 0 without edges.
    pub fn mean_edge_length(&self) -> f64 {
        let total: f64 = self.edges().map(Edge::length).sum();
        total / self.topology.edge_count().max(1) as f64
    }

    /// The area of the surface, in square model units.
    pub fn area(&self) -> f64 {
        self.faces().map(Face::area).sum()
    }

    /// The volume under the faces, in cubic model units: that enclosed by a closed surface, negative where it is wound inwards.
    ///
    /// The sum of the signed tetrahedra between the faces and the box's centre. For a surface with boundary it depends on that centre and
    /// means little.
    pub fn signed_volume(&self) -> f64 {
        let centre = self.bounds().map_or(DVec3::ZERO, |(low, high)| 0.5 * low + 0.5 * high);
        let tetrahedron = |face: Face<'_, Self>| {
            let [a, b, c] = face.positions().map(|p| p - centre);
            a.dot(b.cross(c)) / 6.0
        };
        self.faces().map(tetrahedron).sum()
    }

    /// The least and greatest corner of the box around the referenced vertices; `None` for a mesh without faces.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let corners = self.faces().flat_map(Face::positions);
        corners.fold(None, |bounds, p| {
            let (low, high) = bounds.unwrap_or((p, p));
            Some((low.min(p), high.max(p)))
        })
    }

    /// The same mesh with other positions, one for each vertex; texture coordinates, colours and topology are kept.
    ///
    /// # Errors
    /// Where their count differs, or a position is not finite.
    pub fn with_positions(&self, positions: Vec<DVec3>) -> Result<Self, MeshError> {
        let moved = Self::new(Arc::clone(&self.topology), positions)?;
        Ok(Self { texture_coordinates: self.texture_coordinates.clone(), colours: self.colours.clone(), ..moved })
    }

    /// The length of the diagonal of [`Mesh::bounds`], which the project calls the model's *diameter*; 0 without faces.
    pub fn diameter(&self) -> f64 {
        self.bounds().map_or(0.0, |(low, high)| {
            // Halved, as the extent of the greatest numbers is greater still; and measured by its largest part, whose square may be out of range.
            let half = 0.5 * high - 0.5 * low;
            let largest = half.max_element();
            if largest > 0.0 { 2.0 * largest * (half / largest).length() } else { 0.0 }
        })
    }

    /// How many bytes it holds, for a cache to count.
    pub fn byte_size(&self) -> usize {
        let corners = self.topology.half_edge_count();
        let coordinates = self.texture_coordinates.as_ref().map_or(0, |c| c.len() * size_of::<DVec2>());
        let colours = self.colours.as_ref().map_or(0, |c| size_of_val(c.as_slice()));
        2 * size_of::<u32>() * corners + self.positions.len() * (4 + size_of::<DVec3>()) + coordinates + colours
    }
}
