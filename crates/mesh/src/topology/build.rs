//! From a list of triangles to half-edges.

use super::diagnosis::explain;
use super::{NONE, Topology, TopologyError};
use crate::VertexId;

/// Handles of vertices have 31 bits, so that a vertex, a direction and a half-edge go into one sortable word.
const MOST_VERTICES: usize = (u32::MAX >> 1) as usize;

/// A half-edge in the bucket of the lower end of its edge: from the top, 31 bits of the higher end, 1 bit that is set
/// if it runs downwards, 32 bits of its own number. In sorted order mates stand side by side.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(not(test), derive(PartialOrd, Ord))]
struct Entry(u64);

impl Entry {
    #[inline]
    fn new(higher: u32, downwards: bool, half_edge: u32) -> Self {
        Self(u64::from(higher) << 33 | u64::from(downwards) << 32 | u64::from(half_edge))
    }

    #[inline]
    fn half_edge(self) -> u32 {
        self.0 as u32
    }

    #[inline]
    fn higher(self) -> u32 {
        (self.0 >> 33) as u32
    }

    #[inline]
    fn downwards(self) -> bool {
        self.0 >> 32 & 1 == 1
    }
}

/// Why triangles are no manifold; a clash of windings not yet explained.
enum Fault {
    Named(TopologyError),
    Clash { clash: Clash, origins: Vec<VertexId> },
}

impl From<TopologyError> for Fault {
    fn from(error: TopologyError) -> Self {
        Self::Named(error)
    }
}

impl Topology {
    /// Joins triangles along their common edges.
    ///
    /// `triangles` are vertex indices, anticlockwise. Time is linear: one counting sort of the half-edges by the lower end of
    /// their edge, and one walk around each vertex. Beside the result it needs 24 bytes a face and 4 a vertex for a while.
    ///
    /// # Errors
    /// Where the triangles are no oriented manifold; the first fault is named.
    pub fn from_triangles(vertex_count: usize, triangles: &[[u32; 3]]) -> Result<Self, TopologyError> {
        Self::join(vertex_count, triangles).map_err(|fault| match fault {
            Fault::Named(error) => error,
            Fault::Clash { clash, origins } => explain(vertex_count, &origins, clash),
        })
    }

    /// The same, where nobody wants to know why it fails.
    pub(crate) fn of_manifold(vertex_count: usize, triangles: &[[u32; 3]]) -> Option<Self> {
        Self::join(vertex_count, triangles).ok()
    }

    fn join(vertex_count: usize, triangles: &[[u32; 3]]) -> Result<Self, Fault> {
        if triangles.len() as u64 * 3 >= u64::from(NONE) {
            return Err(TopologyError::TooManyFaces { faces: triangles.len() }.into());
        }
        if vertex_count > MOST_VERTICES {
            return Err(TopologyError::TooManyVertices { vertices: vertex_count }.into());
        }
        for (face, corners) in triangles.iter().enumerate() {
            check_corners(face as u32, corners, vertex_count)?;
        }
        let origins: Vec<VertexId> = triangles.as_flattened().iter().map(|&v| VertexId(v)).collect();
        let (twins, boundary_edges) = match match_twins(vertex_count, &origins) {
            Ok(matched) => matched,
            Err(clash) => return Err(Fault::Clash { clash, origins }),
        };
        let leaving = first_of_each_fan(vertex_count, &origins, &twins);
        let topology = Self { origins, twins, leaving, boundary_edges };
        topology.check_fans()?;
        Ok(topology)
    }

    /// Each vertex has one fan: all that leaves it is reached from its entry.
    fn check_fans(&self) -> Result<(), TopologyError> {
        // A half-edge is in one fan only, so that the fans hold all of them exactly when none is missed.
        let reached: usize = self.vertices().map(|vertex| vertex.leaving().count()).sum();
        if reached == self.half_edge_count() {
            return Ok(());
        }
        let counts = self.leaving_counts();
        let torn = self.vertices().find(|vertex| vertex.leaving().count() != counts[vertex.index()] as usize);
        torn.map_or(Ok(()), |vertex| Err(TopologyError::NonManifoldVertex { vertex: vertex.id().0 }))
    }

    /// How many half-edges leave each vertex.
    pub(super) fn leaving_counts(&self) -> Vec<u32> {
        let mut counts = vec![0_u32; self.vertex_count()];
        for origin in &self.origins {
            counts[origin.index()] += 1;
        }
        counts
    }
}

#[inline]
fn check_corners(face: u32, corners: &[u32; 3], vertex_count: usize) -> Result<(), TopologyError> {
    let [a, b, c] = *corners;
    if let Some(&vertex) = corners.iter().find(|&&vertex| vertex as usize >= vertex_count) {
        return Err(TopologyError::VertexOutOfRange { face, vertex, vertex_count });
    }
    if a == b || b == c || c == a {
        return Err(TopologyError::DegenerateFace { face, vertex: if a == b { a } else { c } });
    }
    Ok(())
}

/// Two half-edges that run along one edge the same way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clash {
    pub(super) first: u32,
    pub(super) second: u32,
    pub(super) from: u32,
    pub(super) to: u32,
}

/// Calls `visit` with the two ends and the number of every half-edge.
#[inline]
fn for_each_half_edge(origins: &[VertexId], mut visit: impl FnMut(u32, u32, u32)) {
    for (face, corners) in origins.chunks_exact(3).enumerate() {
        let (first, [a, b, c]) = (3 * face as u32, [corners[0].0, corners[1].0, corners[2].0]);
        visit(a, b, first);
        visit(b, c, first + 1);
        visit(c, a, first + 2);
    }
}

/// Pairs each half-edge with the one that runs the other way, and counts those that stay alone.
///
/// Half-edges are put into the bucket of the lower end of their edge by a counting sort; a bucket is as long as the vertex has
/// lower edges, and sorting its few words brings mates side by side.
pub(super) fn match_twins(vertex_count: usize, origins: &[VertexId]) -> Result<(Vec<u32>, u32), Clash> {
    // Two places ahead, so that filling a bucket moves its start to where the next one's will be looked for.
    let mut starts = vec![0_u32; vertex_count + 2];
    for_each_half_edge(origins, |from, to, _| starts[from.min(to) as usize + 2] += 1);
    for vertex in 2..starts.len() {
        starts[vertex] += starts[vertex - 1];
    }
    let mut entries = vec![Entry::default(); origins.len()];
    for_each_half_edge(origins, |from, to, half_edge| {
        let (lower, higher, downwards) = if from < to { (from, to, false) } else { (to, from, true) };
        let place = &mut starts[lower as usize + 1];
        entries[*place as usize] = Entry::new(higher, downwards, half_edge);
        *place += 1;
    });
    let mut twins = vec![NONE; origins.len()];
    let mut paired = 0;
    for lower in 0..vertex_count {
        let bucket = &mut entries[starts[lower] as usize..starts[lower + 1] as usize];
        bucket.sort_unstable();
        paired += pair_bucket(lower as u32, bucket, &mut twins)?;
    }
    Ok((twins, origins.len() as u32 - paired))
}

/// Pairs the half-edges of one sorted bucket; says how many found a mate.
#[inline]
fn pair_bucket(lower: u32, bucket: &[Entry], twins: &mut [u32]) -> Result<u32, Clash> {
    let mut paired = 0;
    for pair in bucket.windows(2) {
        let [first, second] = [pair[0], pair[1]];
        if first.higher() != second.higher() {
            continue;
        }
        if first.downwards() == second.downwards() {
            let (from, to) = if first.downwards() { (first.higher(), lower) } else { (lower, first.higher()) };
            return Err(Clash { first: first.half_edge(), second: second.half_edge(), from, to });
        }
        twins[first.half_edge() as usize] = second.half_edge();
        twins[second.half_edge() as usize] = first.half_edge();
        paired += 2;
    }
    Ok(paired)
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

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "a test says what it measured")]

    use std::cell::Cell;
    use std::cmp::Ordering;

    use rand::SeedableRng;
    use rand::seq::SliceRandom;
    use rand_pcg::Pcg64Mcg;

    use super::*;

    thread_local! {
        static COMPARISONS: Cell<u64> = const { Cell::new(0) };
    }

    /// As derived, but counted.
    impl Ord for Entry {
        fn cmp(&self, other: &Self) -> Ordering {
            COMPARISONS.set(COMPARISONS.get() + 1);
            self.0.cmp(&other.0)
        }
    }

    impl PartialOrd for Entry {
        fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
            Some(self.cmp(other))
        }
    }

    /// Comparisons a face.
    fn comparisons(vertex_count: usize, triangles: &[[u32; 3]]) -> f64 {
        COMPARISONS.set(0);
        let topology = Topology::from_triangles(vertex_count, triangles).unwrap();
        assert_eq!(topology.face_count(), triangles.len());
        COMPARISONS.get() as f64 / triangles.len() as f64
    }

    /// Time is near linear to a million faces: every pass goes once through what it is given, but for the sorts of the buckets, whose comparisons are counted here
    /// since a clock would say more of the machine.
    #[test]
    fn a_million_faces_take_as_few_steps_a_face_as_five_thousand() {
        let mut counts = Vec::new();
        for (major, minor) in [(50, 50), (250, 200), (1000, 500)] {
            let torus = crate::torus(1.0, 0.4, major, minor).unwrap();
            let mut triangles: Vec<[u32; 3]> = torus.topology().triangles().collect();
            let in_order = comparisons(torus.positions().len(), &triangles);
            triangles.shuffle(&mut Pcg64Mcg::seed_from_u64(1));
            let shuffled = comparisons(torus.positions().len(), &triangles);
            counts.push([in_order, shuffled]);
        }
        println!("reached: {:.2} comparisons a face of 5,000, {:.2} of 1,000,000", counts[0][1], counts[2][1]);
        for count in &counts {
            assert!((0..2).all(|k| count[k] > 1.0 && count[k] < 1.05 * counts[0][k]), "{counts:?}");
        }
        // The worst there is: all in one bucket, which is sorted in n log n.
        for exponent in [12, 16, 20] {
            let rim = 1_u32 << exponent;
            let mut fan: Vec<[u32; 3]> = (0..rim).map(|k| [0, 1 + k, 1 + (k + 1) % rim]).collect();
            fan.shuffle(&mut Pcg64Mcg::seed_from_u64(2));
            let most = 4.0 * f64::from(exponent);
            let count = comparisons(rim as usize + 1, &fan);
            assert!(count < most, "valence {rim}: {count} comparisons a face");
        }
    }
}
