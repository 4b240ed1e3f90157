//! The fast distance: a front of vertices that unfolds the surface as it goes.

use glam::DVec2;

use super::Source;
use super::layout::Layout;
use super::queue::Queue;
use crate::{HalfEdge, Mesh, VertexId};

/// How often an edge is unfolded further, for an obtuse corner.
const MOST_UNFOLDINGS: usize = 8;

/// A distance is replaced only by one that is less by this fraction: else rounding would go round in circles.
const LEAST_GAIN: f64 = 1e-12;

/// Sets the distances of the vertices within reach and of some beyond, and returns all it set; all others stay as they are.
pub(super) fn march(layout: &Layout<'_>, sources: &[Source], reach: f64, distances: &mut [f64]) -> Vec<VertexId> {
    let mut front = Front { layout, distances, queue: Queue::new(), touched: Vec::new() };
    for source in sources {
        front.start(source);
    }
    // A vertex within reach may be reached over an edge that has an end beyond, so that the front goes on for an edge's length.
    let mut longest: f64 = 0.0;
    while let Some((distance, vertex)) = front.queue.pop() {
        if distance > reach + longest {
            break;
        }
        if distance <= front.distances[vertex.index()] {
            let longest_here = front.pass_on(vertex);
            longest = if distance <= reach { longest.max(longest_here) } else { longest };
        }
    }
    front.touched
}

struct Front<'f, 'm> {
    layout: &'f Layout<'m>,
    distances: &'f mut [f64],
    queue: Queue<VertexId>,
    touched: Vec<VertexId>,
}

impl<'m> Front<'_, 'm> {
    /// The corners of the faces that a source touches see it straight.
    fn start(&mut self, source: &Source) {
        if let Source::Vertex(vertex) = source {
            self.reach_vertex(*vertex, 0.0);
        }
        for point in self.layout.faces_of(source) {
            for side in self.layout.mesh.face(point.face).half_edges() {
                self.reach_vertex(side.origin().id(), self.layout.place(side.id(), &point).length());
            }
        }
    }

    fn reach_vertex(&mut self, vertex: VertexId, distance: f64) {
        let known = &mut self.distances[vertex.index()];
        if distance >= *known * (1.0 - LEAST_GAIN) {
            return;
        }
        if *known == f64::INFINITY {
            self.touched.push(vertex);
        }
        *known = distance;
        self.queue.push(distance, vertex);
    }

    /// Offers what a vertex's distance means for the others of its faces: along each edge, and through each edge to the corner opposite.
    /// Returns the length of its longest edge.
    fn pass_on(&mut self, vertex: VertexId) -> f64 {
        let here = self.distances[vertex.index()];
        let mut longest: f64 = 0.0;
        for leaving in self.layout.mesh.vertex(vertex).leaving() {
            let (next, arriving) = (leaving.tip().id(), leaving.previous());
            longest = longest.max(self.layout.length(leaving.id())).max(self.layout.length(arriving.id()));
            self.reach_vertex(next, here + self.layout.length(leaving.id()));
            if arriving.is_boundary() {
                self.reach_vertex(arriving.origin().id(), here + self.layout.length(arriving.id()));
            }
            if let Some(distance) = self.through(leaving) {
                self.reach_vertex(leaving.apex().id(), distance);
            }
            if let Some(distance) = self.through(arriving) {
                self.reach_vertex(next, distance);
            }
        }
        longest
    }

    /// The distance at the apex of a half-edge's face for a path that comes in over the half-edge; none if no straight one does.
    ///
    /// The source is put where the distances at the ends of the edge say, on the far side. A path that is shorter than the distances at both ends comes over
    /// an edge further on, whose ends then know better where the source is: an obtuse apex sees such edges.
    fn through(&self, half_edge: HalfEdge<'m, Mesh>) -> Option<f64> {
        let at = |end: crate::Vertex<'m, Mesh>| self.distances[end.index()];
        let target = self.layout.apex(half_edge.id());
        // The edge that the path comes over, as the half-edge behind it.
        let mut behind = half_edge.twin()?;
        let (mut left, mut right) = (DVec2::ZERO, DVec2::new(self.layout.length(half_edge.id()), 0.0));
        let (mut at_left, mut at_right) = (at(half_edge.origin()), at(half_edge.tip()));
        for _ in 0..MOST_UNFOLDINGS {
            let source = image(left, right, at_left, at_right)?;
            let path = target - source;
            if path.perp_dot(left - source) < 0.0 || path.perp_dot(right - source) > 0.0 {
                return None;
            }
            let distance = path.length();
            if distance >= at_left.min(at_right) {
                return Some(distance);
            }
            let apex = self.layout.apex(behind.id());
            // The half-edge behind runs from right to left.
            let along = (left - right).try_normalize()?;
            let beyond = right + along * apex.x + along.perp() * apex.y;
            let (at_beyond, passes_right) = (at(behind.apex()), path.perp_dot(beyond - source) >= 0.0);
            if passes_right {
                (left, at_left, behind) = (beyond, at_beyond, behind.previous().twin()?);
            } else {
                (right, at_right, behind) = (beyond, at_beyond, behind.next().twin()?);
            }
        }
        None
    }
}

/// The point at given distances from two others, on the right of the way from the first to the second; none if no point is or if they coincide.
#[inline]
fn image(a: DVec2, b: DVec2, to_a: f64, to_b: f64) -> Option<DVec2> {
    let side = b - a;
    let length = side.length();
    if !(length > 0.0 && to_a < f64::INFINITY && to_b < f64::INFINITY) {
        return None;
    }
    let x = 0.5 * (length + (to_a - to_b) * (to_a + to_b) / length);
    let squared = (to_a - x) * (to_a + x);
    let along = side / length;
    (squared >= 0.0).then(|| a + along * x - along.perp() * squared.sqrt())
}
