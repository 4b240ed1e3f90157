//! The invariants of a topology, checked one by one.

use super::build::match_twins;
use super::{NONE, Topology};
use crate::HalfEdgeId;

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
    /// Checks every invariant: mates are mutual, run opposite ways and none is missing, corners differ, and each vertex's fan is whole.
    ///
    /// A `Topology` made by this crate always passes; tests and fuzzers call it. Linear time.
    ///
    /// # Errors
    /// The first invariant that does not hold.
    pub fn check(&self) -> Result<(), BrokenInvariant> {
        if !self.origins.len().is_multiple_of(3) || self.origins.len() != self.twins.len() {
            return broken(self.origins.len(), "the arrays do not hold three half-edges a face");
        }
        self.check_half_edges()?;
        self.check_pairing()?;
        self.check_every_fan()
    }

    /// Each half-edge has two different ends that exist, and a mate that runs the other way.
    fn check_half_edges(&self) -> Result<(), BrokenInvariant> {
        if let Some(index) = self.origins.iter().position(|origin| origin.index() >= self.vertex_count()) {
            return broken(index, "starts at a vertex that does not exist");
        }
        for (index, (&origin, &twin)) in self.origins.iter().zip(&self.twins).enumerate() {
            let half_edge = HalfEdgeId::from_index(index);
            if origin == self.tip(half_edge) {
                return broken(index, "starts and ends at one vertex");
            }
            if twin == NONE {
                continue;
            }
            if twin as usize >= self.twins.len() || self.twins[twin as usize] != half_edge.0 {
                return broken(index, "is not the mate of its mate");
            }
            if self.origins[twin as usize] != self.tip(half_edge) || self.tip(HalfEdgeId(twin)) != origin {
                return broken(index, "does not run opposite to its mate");
            }
        }
        Ok(())
    }

    /// No two half-edges run along one edge the same way, and none lacks the mate that is there.
    fn check_pairing(&self) -> Result<(), BrokenInvariant> {
        let Ok((twins, boundary_edges)) = match_twins(self.vertex_count(), &self.origins) else {
            return broken(0, "some edge is run along twice in the same direction");
        };
        if let Some(index) = twins.iter().zip(&self.twins).position(|(should, is)| should != is) {
            return broken(index, "has no mate, though one runs the other way");
        }
        if boundary_edges != self.boundary_edges {
            return broken(0, "the count of boundary edges is wrong");
        }
        Ok(())
    }

    /// From each vertex's entry every half-edge that leaves it is reached, and no other.
    fn check_every_fan(&self) -> Result<(), BrokenInvariant> {
        let counts = self.leaving_counts();
        for (vertex, (&first, &count)) in self.vertices().zip(self.leaving.iter().zip(&counts)) {
            if (first == NONE) != (count == 0) {
                return broken(first as usize, "a vertex has a fan exactly when a half-edge leaves it");
            }
            if first != NONE && self.origins.get(first as usize) != Some(&vertex.id()) {
                return broken(first as usize, "the fan of a vertex starts at a half-edge that does not leave it");
            }
            if vertex.leaving().take(count as usize + 1).count() != count as usize {
                return broken(first as usize, "the fan of its origin does not reach every half-edge that leaves it");
            }
        }
        Ok(())
    }
}

fn broken(half_edge: usize, what: &'static str) -> Result<(), BrokenInvariant> {
    Err(BrokenInvariant { half_edge: half_edge as u32, what })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::VertexId;

    /// Two triangles that share an edge, and a closed tetrahedron beside them.
    fn sample() -> Topology {
        let faces = [[0, 1, 2], [2, 1, 3], [4, 5, 6], [5, 4, 7], [6, 5, 7], [4, 6, 7]];
        Topology::from_triangles(9, &faces).unwrap()
    }

    fn what(change: impl FnOnce(&mut Topology)) -> &'static str {
        let mut topology = sample();
        change(&mut topology);
        topology.check().unwrap_err().what
    }

    #[test]
    fn sound_arrays_pass() {
        assert_eq!(sample().check(), Ok(()));
    }

    #[test]
    fn each_kind_of_corruption_is_found() {
        assert!(what(|t| t.twins.truncate(17)).contains("three half-edges"));
        assert!(what(|t| t.origins[4] = VertexId(9)).contains("does not exist"));
        assert!(what(|t| t.origins[1] = VertexId(0)).contains("one vertex"));
        assert!(what(|t| t.twins[0] = 77).contains("mate of its mate"));
        assert!(what(|t| t.twins[1] = NONE).contains("mate of its mate"));
        assert!(what(|t| (t.twins[0], t.twins[2]) = (2, 0)).contains("opposite"));
        assert!(what(|t| (t.twins[6], t.twins[9]) = (NONE, NONE)).contains("though one runs"));
        assert!(what(|t| t.boundary_edges += 1).contains("boundary edges"));
        assert!(what(|t| t.leaving[8] = 0).contains("exactly when"));
        assert!(what(|t| t.leaving[4] = NONE).contains("exactly when"));
        assert!(what(|t| t.leaving[4] = 0).contains("does not leave"));
        assert!(what(|t| t.leaving[4] = 1000).contains("does not leave"));
        // A boundary fan entered in the middle misses what lies to its right.
        let middle = |t: &mut Topology| t.leaving[2] = t.half_edge(HalfEdgeId(t.leaving[2])).rotate_left().unwrap().id().0;
        assert!(what(middle).contains("does not reach"));
    }

    proptest::proptest! {
        /// Any one number changed in any array is noticed, unless it still is a valid entry of a closed fan.
        #[test]
        fn one_changed_number_is_found(array in 0..3_usize, place in 0..18_usize, value in 0..20_u32) {
            let mut topology = sample();
            let vertex = place % 9;
            match array {
                0 => topology.origins[place] = VertexId(value),
                1 => topology.twins[place] = value,
                _ => topology.leaving[vertex] = value,
            }
            let still_an_entry = array == 2 && (4..8).contains(&vertex) && topology.origins.get(value as usize) == Some(&VertexId(vertex as u32));
            proptest::prop_assert_eq!(topology.check().is_ok(), topology == sample() || still_an_entry);
        }
    }
}
