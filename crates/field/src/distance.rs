//! Shortest paths along edges (Dijkstra 1959).

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use pelage_mesh::{HalfEdge, Mesh, VertexId};

/// A place in the queue: nearer first, then lower number, so that equal distances are settled in one order.
#[derive(Clone, Copy, PartialEq)]
struct Reached {
    distance: f64,
    vertex: u32,
}

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        self.distance.total_cmp(&other.distance).then(self.vertex.cmp(&other.vertex))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The edge network of a mesh with lengths in units of its diameter.
pub(crate) struct Network<'a> {
    mesh: &'a Mesh,
    lengths: Vec<f64>,
}

impl<'a> Network<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let diameter = mesh.diameter();
        let length = |h: HalfEdge<'_, Mesh>| (h.vector() / diameter).length();
        // All in one place: no length, no direction, and everything is near everything.
        let lengths = if diameter > 0.0 { mesh.half_edges().map(length).collect() } else { vec![0.0; mesh.topology().half_edge_count()] };
        Self { mesh, lengths }
    }

    /// Calls `settle` with each vertex that can be reached from `sources`, nearest first, and its distance.
    pub(crate) fn walk(&self, sources: impl IntoIterator<Item = VertexId>, mut settle: impl FnMut(VertexId, f64)) {
        let topology = self.mesh.topology();
        let mut distances = vec![f64::INFINITY; topology.vertex_count()];
        let mut queue = BinaryHeap::new();
        let mut reach = |queue: &mut BinaryHeap<_>, vertex: VertexId, distance: f64| {
            if distance < distances[vertex.index()] {
                distances[vertex.index()] = distance;
                queue.push(Reverse(Reached { distance, vertex: vertex.0 }));
            }
        };
        for source in sources {
            reach(&mut queue, source, 0.0);
        }
        let mut settled = vec![false; topology.vertex_count()];
        while let Some(Reverse(Reached { distance, vertex })) = queue.pop() {
            if std::mem::replace(&mut settled[vertex as usize], true) {
                continue;
            }
            settle(VertexId(vertex), distance);
            for leaving in topology.vertex(VertexId(vertex)).leaving() {
                reach(&mut queue, leaving.tip().id(), distance + self.lengths[leaving.index()]);
                let arriving = leaving.previous();
                if arriving.is_boundary() {
                    reach(&mut queue, arriving.origin().id(), distance + self.lengths[arriving.index()]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage_mesh::{plane, sphere};

    #[test]
    fn along_a_grid_line_it_is_the_straight_distance() {
        let mesh = plane(3.0, 4.0, 12, 16).unwrap();
        let network = Network::new(&mesh);
        let mut far = 0.0;
        let mut last = 0.0;
        network.walk([VertexId(0)], |vertex, distance| {
            assert!(distance >= last);
            last = distance;
            let straight = mesh.vertex(vertex).position().distance(mesh.vertex(VertexId(0)).position()) / 5.0;
            assert!(distance >= straight - 1e-12 && distance <= straight * 1.42 + 1e-12);
            if vertex == VertexId(12) {
                far = distance;
            }
        });
        assert!((far - 3.0 / 5.0).abs() < 1e-12);
    }

    #[test]
    fn every_vertex_is_settled_once() {
        let mesh = sphere(1.0, 6).unwrap();
        let mut seen = vec![0; mesh.positions().len()];
        Network::new(&mesh).walk([VertexId(3), VertexId(200), VertexId(3)], |vertex, _| seen[vertex.index()] += 1);
        assert!(seen.iter().all(|&times| times == 1));
    }
}
