//! Connected pieces.

use super::{BoundaryLoop, Edge, Face, HalfEdge, Surface, Vertex, boundary};
use crate::FaceId;

/// Which piece of the surface each face belongs to, and the faces of each piece.
#[derive(Clone, Debug)]
pub struct Components<'a, S: Surface> {
    surface: &'a S,
    labels: Vec<u32>,
    /// Faces by piece, rising within each.
    faces: Vec<FaceId>,
    /// Where the faces of each piece start, and the end.
    starts: Vec<u32>,
}

impl<'a, S: Surface> Components<'a, S> {
    pub(super) fn of(surface: &'a S) -> Self {
        let (labels, count) = label_faces(surface.as_topology());
        // A counting sort keeps the faces of a piece in rising order.
        let mut starts = vec![0; count as usize + 1];
        for &label in &labels {
            starts[label as usize + 1] += 1;
        }
        for piece in 1..starts.len() {
            starts[piece] += starts[piece - 1];
        }
        let mut free = starts.clone();
        let mut faces = vec![FaceId(0); labels.len()];
        for (face, &label) in labels.iter().enumerate() {
            let place = &mut free[label as usize];
            faces[*place as usize] = FaceId::from_index(face);
            *place += 1;
        }
        Self { surface, labels, faces, starts }
    }

    /// How many pieces there are.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The number of the piece that a face belongs to: 0 for that of the lowest face, and so on in order of the pieces' lowest faces.
    #[inline]
    pub fn index_of(&self, face: FaceId) -> usize {
        self.labels[face.index()] as usize
    }

    /// The pieces, in order of their lowest faces.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Component<'_, S>> {
        (0..self.count()).map(|index| Component { surface: self.surface, index, faces: self.faces_of(index) })
    }

    /// The piece that a face belongs to.
    pub fn of_face(&self, face: FaceId) -> Component<'_, S> {
        let index = self.index_of(face);
        Component { surface: self.surface, index, faces: self.faces_of(index) }
    }

    fn faces_of(&self, index: usize) -> &[FaceId] {
        &self.faces[self.starts[index] as usize..self.starts[index + 1] as usize]
    }
}

/// The number of the piece of each face, and how many pieces there are.
fn label_faces(topology: &crate::Topology) -> (Vec<u32>, u32) {
    const NONE: u32 = u32::MAX;
    let mut labels = vec![NONE; topology.face_count()];
    let mut open = Vec::new();
    let mut count = 0;
    for seed in topology.faces() {
        if labels[seed.index()] != NONE {
            continue;
        }
        labels[seed.index()] = count;
        open.push(seed);
        while let Some(face) = open.pop() {
            for neighbour in face.neighbours() {
                if labels[neighbour.index()] == NONE {
                    labels[neighbour.index()] = count;
                    open.push(neighbour);
                }
            }
        }
        count += 1;
    }
    (labels, count)
}

/// A connected piece of a surface. What is counted is counted when asked for, in time linear in its faces.
#[derive(Debug)]
pub struct Component<'c, S: Surface> {
    surface: &'c S,
    index: usize,
    faces: &'c [FaceId],
}

impl<S: Surface> Clone for Component<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Surface> Copy for Component<'_, S> {}

impl<'c, S: Surface> Component<'c, S> {
    /// Its number among the pieces.
    pub fn index(self) -> usize {
        self.index
    }

    /// Its faces, in rising order.
    pub fn faces(self) -> impl ExactSizeIterator<Item = Face<'c, S>> + use<'c, S> {
        self.faces.iter().map(move |&face| Face::new(self.surface, face))
    }

    /// Its half-edges, in rising order.
    pub fn half_edges(self) -> impl Iterator<Item = HalfEdge<'c, S>> + use<'c, S> {
        self.faces().flat_map(Face::half_edges)
    }

    /// Its edges, each once.
    pub fn edges(self) -> impl Iterator<Item = Edge<'c, S>> + use<'c, S> {
        self.half_edges().filter_map(Edge::of_lower_side)
    }

    /// Its vertices, each once.
    pub fn vertices(self) -> impl Iterator<Item = Vertex<'c, S>> + use<'c, S> {
        // A vertex is met at each of its corners, and is taken at that which its fan starts with.
        self.half_edges().filter(|h| h.origin().first_leaving() == Some(*h)).map(HalfEdge::origin)
    }

    /// The loops of its boundary.
    pub fn boundary_loops(self) -> Vec<BoundaryLoop<'c, S>> {
        boundary::loops_among(self.half_edges())
    }

    /// Whether it has no boundary.
    pub fn is_closed(self) -> bool {
        !self.half_edges().any(HalfEdge::is_boundary)
    }

    /// χ = V − E + F.
    pub fn euler_characteristic(self) -> i64 {
        self.vertices().count() as i64 - self.edges().count() as i64 + self.faces.len() as i64
    }

    /// How many handles it has: 2 − 2g − B = χ with B boundary loops.
    pub fn genus(self) -> usize {
        // An oriented surface: even and never negative.
        ((2 - self.boundary_loops().len() as i64 - self.euler_characteristic()) / 2) as usize
    }

    /// Whether it is a disc: one boundary loop, and no handle.
    pub fn is_disc(self) -> bool {
        self.euler_characteristic() == 1
    }
}
