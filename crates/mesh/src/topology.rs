//! Which faces, edges and vertices touch.

use crate::{FaceId, HalfEdgeId, VertexId};

/// No half-edge: the far side of a boundary edge, or the fan of an unreferenced vertex.
const NONE: u32 = u32::MAX;

/// An oriented manifold triangle topology, with or without boundary, in flat arrays.
///
/// Twelve bytes a face and half-edge array, four a vertex. Every accessor is O(1).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    /// Where half-edge *h* starts. `origins[3f..3f+3]` are the corners of face *f*.
    origins: Vec<VertexId>,
    /// The half-edge on the other side, or `NONE` at a boundary.
    twins: Vec<u32>,
    /// A half-edge that leaves the vertex; the one from which the whole fan can be walked by `rotate_left` if the vertex is on a boundary.
    leaving: Vec<u32>,
}

/// Why an index list is no oriented manifold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TopologyError {
    /// A corner names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are {vertex_count}; remove the face or add the vertex")]
    VertexOutOfRange {
        /// The face.
        face: u32,
        /// The vertex it names.
        vertex: u32,
        /// How many there are.
        vertex_count: usize,
    },
    /// A face uses a vertex twice.
    #[error("face {face} uses vertex {vertex} twice; remove the face")]
    DegenerateFace {
        /// The face.
        face: u32,
        /// The repeated vertex.
        vertex: u32,
    },
    /// Two faces run along an edge in the same direction: three faces share it, a face is doubled, or windings disagree.
    #[error(
        "faces {first} and {second} both run along the edge from vertex {from} to {to}; \
         make their windings agree, and give a third face at an edge vertices of its own"
    )]
    EdgeUsedTwice {
        /// The face met first.
        first: u32,
        /// The face met second.
        second: u32,
        /// Where the edge starts.
        from: u32,
        /// Where the edge ends.
        to: u32,
    },
    /// Several fans of faces touch at one vertex only.
    #[error("the faces around vertex {vertex} form more than one fan; give each fan a vertex of its own")]
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
    },
    /// More half-edges than a `u32` counts.
    #[error("{faces} faces are too many; at most {} fit", (u32::MAX - 1) / 3)]
    TooManyFaces {
        /// How many were given.
        faces: usize,
    },
}

/// An invariant that does not hold; see [`Topology::check`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("half-edge {half_edge}: {what}")]
pub struct BrokenInvariant {
    /// Where.
    pub half_edge: u32,
    /// What does not hold.
    pub what: &'static str,
}

impl Topology {
    /// Joins triangles along their common edges.
    ///
    /// `triangles` are vertex indices, anticlockwise. Time is that of two counting sorts over the half-edges: linear.
    ///
    /// # Errors
    /// Where the triangles are no oriented manifold; the first fault is named.
    pub fn from_triangles(vertex_count: usize, triangles: &[[u32; 3]]) -> Result<Self, TopologyError> {
        if triangles.len() as u64 * 3 >= u64::from(NONE) || vertex_count as u64 >= u64::from(NONE) {
            return Err(TopologyError::TooManyFaces { faces: triangles.len() });
        }
        for (face, corners) in triangles.iter().enumerate() {
            check_corners(face as u32, corners, vertex_count)?;
        }
        let origins: Vec<VertexId> = triangles.iter().flatten().map(|&v| VertexId(v)).collect();
        let twins = match_twins(vertex_count, &origins)?;
        let leaving = first_of_each_fan(vertex_count, &origins, &twins);
        let topology = Self { origins, twins, leaving };
        topology.check_fans()?;
        Ok(topology)
    }

    /// How many vertices, referenced or not.
    pub fn vertex_count(&self) -> usize {
        self.leaving.len()
    }

    /// How many faces.
    pub fn face_count(&self) -> usize {
        self.origins.len() / 3
    }

    /// How many half-edges: three a face.
    pub fn half_edge_count(&self) -> usize {
        self.origins.len()
    }

    /// How many edges, boundary edges among them.
    pub fn edge_count(&self) -> usize {
        self.edges().count()
    }

    /// Every vertex.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.vertex_count() as u32).map(VertexId)
    }

    /// Every face.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.face_count() as u32).map(FaceId)
    }

    /// One half-edge for each edge: the one with the lower number, or the only one at a boundary.
    pub fn edges(&self) -> impl Iterator<Item = HalfEdgeId> + '_ {
        (0..self.origins.len() as u32).filter(|&h| self.twins[h as usize] == NONE || h < self.twins[h as usize]).map(HalfEdgeId)
    }

    /// The corners of a face, in winding order.
    #[inline]
    pub fn face_vertices(&self, face: FaceId) -> [VertexId; 3] {
        let first = 3 * face.index();
        [self.origins[first], self.origins[first + 1], self.origins[first + 2]]
    }

    /// The faces across the three edges of a face; the *k*th lies across half-edge 3*f* + *k*.
    #[inline]
    pub fn face_neighbours(&self, face: FaceId) -> [Option<FaceId>; 3] {
        face.half_edges().map(|h| self.twin(h).map(HalfEdgeId::face))
    }

    /// Where the half-edge starts.
    #[inline]
    pub fn origin(&self, half_edge: HalfEdgeId) -> VertexId {
        self.origins[half_edge.index()]
    }

    /// Where the half-edge ends.
    #[inline]
    pub fn tip(&self, half_edge: HalfEdgeId) -> VertexId {
        self.origins[half_edge.next().index()]
    }

    /// The half-edge on the other side of the edge, if there is a face.
    #[inline]
    pub fn twin(&self, half_edge: HalfEdgeId) -> Option<HalfEdgeId> {
        let twin = self.twins[half_edge.index()];
        (twin != NONE).then_some(HalfEdgeId(twin))
    }

    /// The next half-edge, anticlockwise, that leaves the same vertex; none past a boundary.
    #[inline]
    pub fn rotate_left(&self, half_edge: HalfEdgeId) -> Option<HalfEdgeId> {
        self.twin(half_edge.previous())
    }

    /// The half-edges that leave a vertex, anticlockwise; at a boundary vertex from one end of the fan to the other.
    pub fn leaving(&self, vertex: VertexId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        let first = self.leaving[vertex.index()];
        let first = (first != NONE).then_some(HalfEdgeId(first));
        std::iter::successors(first, move |&h| self.rotate_left(h).filter(|&next| Some(next) != first))
    }

    /// The faces around a vertex, anticlockwise.
    pub fn vertex_faces(&self, vertex: VertexId) -> impl Iterator<Item = FaceId> + '_ {
        self.leaving(vertex).map(HalfEdgeId::face)
    }

    /// The vertices joined to a vertex by an edge, anticlockwise.
    pub fn vertex_neighbours(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        // The fan of a boundary vertex has one neighbour more than half-edges that leave: the start of the last face's last side.
        let last = self.leaving(vertex).map(HalfEdgeId::previous).find(|&h| self.twin(h).is_none()).map(|h| self.origin(h));
        self.leaving(vertex).map(|h| self.tip(h)).chain(last)
    }

    /// Whether the vertex lies on a boundary; an unreferenced vertex does not.
    pub fn is_boundary_vertex(&self, vertex: VertexId) -> bool {
        let first = self.leaving[vertex.index()];
        first != NONE && self.twins[first as usize] == NONE
    }

    /// Checks every invariant: mates are mutual and run opposite ways, corners differ, and each vertex's fan is whole.
    ///
    /// A `Topology` made by this crate always passes; tests and fuzzers call it.
    ///
    /// # Errors
    /// The first invariant that does not hold.
    pub fn check(&self) -> Result<(), BrokenInvariant> {
        let broken = |half_edge: usize, what| Err(BrokenInvariant { half_edge: half_edge as u32, what });
        if !self.origins.len().is_multiple_of(3) || self.origins.len() != self.twins.len() {
            return broken(self.origins.len(), "the arrays do not hold three half-edges a face");
        }
        let mut leaving_count = vec![0_u32; self.vertex_count()];
        for (index, (&origin, &twin)) in self.origins.iter().zip(&self.twins).enumerate() {
            let half_edge = HalfEdgeId::from_index(index);
            if origin.index() >= self.vertex_count() {
                return broken(index, "starts at a vertex that does not exist");
            }
            if origin == self.tip(half_edge) {
                return broken(index, "starts and ends at one vertex");
            }
            if twin != NONE {
                if twin as usize >= self.twins.len() || self.twins[twin as usize] != half_edge.0 {
                    return broken(index, "is not the mate of its mate");
                }
                if self.origins[twin as usize] != self.tip(half_edge) || self.tip(HalfEdgeId(twin)) != origin {
                    return broken(index, "does not run opposite to its mate");
                }
            }
            leaving_count[origin.index()] += 1;
        }
        for vertex in self.vertices() {
            let first = self.leaving[vertex.index()];
            if (first == NONE) != (leaving_count[vertex.index()] == 0) {
                return broken(first as usize, "a vertex has a fan exactly when a half-edge leaves it");
            }
            let fan = self.leaving(vertex).take(self.half_edge_count() + 1);
            if fan.count() != leaving_count[vertex.index()] as usize {
                return broken(first as usize, "the fan of its origin does not reach every half-edge that leaves it");
            }
            if self.leaving(vertex).any(|h| self.origin(h) != vertex) {
                return broken(first as usize, "the fan of a vertex holds a half-edge that starts elsewhere");
            }
        }
        Ok(())
    }

    /// Each vertex has one fan.
    fn check_fans(&self) -> Result<(), TopologyError> {
        let mut leaving_count = vec![0_u32; self.vertex_count()];
        for origin in &self.origins {
            leaving_count[origin.index()] += 1;
        }
        for vertex in self.vertices() {
            if self.leaving(vertex).count() != leaving_count[vertex.index()] as usize {
                return Err(TopologyError::NonManifoldVertex { vertex: vertex.0 });
            }
        }
        Ok(())
    }
}

fn check_corners(face: u32, corners: &[u32; 3], vertex_count: usize) -> Result<(), TopologyError> {
    for (k, &vertex) in corners.iter().enumerate() {
        if vertex as usize >= vertex_count {
            return Err(TopologyError::VertexOutOfRange { face, vertex, vertex_count });
        }
        if vertex == corners[(k + 1) % 3] {
            return Err(TopologyError::DegenerateFace { face, vertex });
        }
    }
    Ok(())
}

/// Pairs each half-edge with the one that runs the other way.
///
/// Half-edges are bucketed by the lower vertex of their edge (a counting sort); within a bucket, which is as long as the
/// vertex has edges, mates are found by a short sort.
fn match_twins(vertex_count: usize, origins: &[VertexId]) -> Result<Vec<u32>, TopologyError> {
    let ends = |h: u32| {
        let (from, to) = (origins[h as usize].0, origins[HalfEdgeId(h).next().index()].0);
        (from.min(to), from.max(to), from > to)
    };
    let mut start = vec![0_u32; vertex_count + 1];
    for h in 0..origins.len() as u32 {
        start[ends(h).0 as usize + 1] += 1;
    }
    for vertex in 0..vertex_count {
        start[vertex + 1] += start[vertex];
    }
    let mut fill = start.clone();
    // (upper vertex, runs downwards, half-edge): sorting brings mates side by side.
    let mut bucketed = vec![(0_u32, false, 0_u32); origins.len()];
    for h in 0..origins.len() as u32 {
        let (low, high, downwards) = ends(h);
        let slot = &mut fill[low as usize];
        bucketed[*slot as usize] = (high, downwards, h);
        *slot += 1;
    }
    let mut twins = vec![NONE; origins.len()];
    for low in 0..vertex_count {
        let bucket = &mut bucketed[start[low] as usize..start[low + 1] as usize];
        bucket.sort_unstable();
        for pair in bucket.windows(2) {
            let [(high, up, a), (other_high, down, b)] = [pair[0], pair[1]];
            if high != other_high {
                continue;
            }
            if up == down {
                let (from, to) = if up { (high, low as u32) } else { (low as u32, high) };
                return Err(TopologyError::EdgeUsedTwice { first: a / 3, second: b / 3, from, to });
            }
            twins[a as usize] = b;
            twins[b as usize] = a;
        }
    }
    Ok(twins)
}

/// A half-edge that leaves each vertex; at a boundary the one with the boundary on its right, where `rotate_left` starts.
fn first_of_each_fan(vertex_count: usize, origins: &[VertexId], twins: &[u32]) -> Vec<u32> {
    let mut leaving = vec![NONE; vertex_count];
    for (h, (origin, &twin)) in origins.iter().zip(twins).enumerate() {
        let slot = &mut leaving[origin.index()];
        if *slot == NONE || twin == NONE {
            *slot = h as u32;
        }
    }
    leaving
}
