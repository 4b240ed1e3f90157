//! Boundary loops, pieces and the Euler characteristic.

use super::{NONE, Topology};
use crate::{FaceId, HalfEdgeId};

/// Which piece of the surface each face belongs to; see [`Topology::components`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    labels: Vec<u32>,
    count: usize,
}

impl Components {
    /// How many pieces there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The piece of a face: 0 for that of the lowest face, and so on in order of the pieces' lowest faces.
    #[inline]
    pub fn of_face(&self, face: FaceId) -> usize {
        self.labels[face.index()] as usize
    }

    /// How many faces each piece has.
    pub fn face_counts(&self) -> Vec<usize> {
        let mut counts = vec![0; self.count];
        for &label in &self.labels {
            counts[label as usize] += 1;
        }
        counts
    }
}

impl Topology {
    /// The loops of boundary half-edges, each in the order in which it is walked with the surface on the left.
    ///
    /// Loops come in the order of their lowest half-edge, which each starts with.
    pub fn boundary_loops(&self) -> Vec<Vec<HalfEdgeId>> {
        let mut seen = vec![false; self.half_edge_count()];
        let mut loops = Vec::new();
        for start in self.half_edges() {
            if self.twin(start).is_some() || seen[start.index()] {
                continue;
            }
            let mut walk = Vec::new();
            let mut here = start;
            while !seen[here.index()] {
                seen[here.index()] = true;
                walk.push(here);
                // The fan of a boundary vertex starts with the half-edge that has the boundary on its right.
                here = HalfEdgeId(self.leaving[self.tip(here).index()]);
            }
            loops.push(walk);
        }
        loops
    }

    /// The connected pieces: faces are connected where they share an edge (fans that share a vertex only are no manifold).
    pub fn components(&self) -> Components {
        let mut labels = vec![NONE; self.face_count()];
        let mut open = Vec::new();
        let mut count = 0;
        for seed in self.faces() {
            if labels[seed.index()] != NONE {
                continue;
            }
            labels[seed.index()] = count;
            open.push(seed);
            while let Some(face) = open.pop() {
                for neighbour in self.face_neighbours(face).into_iter().flatten() {
                    if labels[neighbour.index()] == NONE {
                        labels[neighbour.index()] = count;
                        open.push(neighbour);
                    }
                }
            }
            count += 1;
        }
        Components { labels, count: count as usize }
    }

    /// How many vertices have a face.
    pub fn referenced_vertex_count(&self) -> usize {
        self.leaving.iter().filter(|&&first| first != NONE).count()
    }

    /// χ = V − E + F, unreferenced vertices not counted.
    pub fn euler_characteristic(&self) -> i64 {
        self.referenced_vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }
}
