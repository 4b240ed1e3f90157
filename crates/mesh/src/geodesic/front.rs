//! The fast distance: a front of vertices that unfolds the surface as it goes.

use glam::DVec2;

use super::Source;
use super::layout::Layout;
use super::queue::Queue;
use crate::{HalfEdge, Mesh, VertexId};

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
    /// The source is put where the distances at the ends of the edge say, on the far side. The apex may be nearer than both ends, where it is obtuse: then it is
    /// corrected once they are known, and passes that on.
    fn through(&self, half_edge: HalfEdge<'m, Mesh>) -> Option<f64> {
        // Nothing comes over a boundary.
        half_edge.twin()?;
        let ends = [half_edge.origin(), half_edge.tip()].map(|end| self.distances[end.index()]);
        let length = self.layout.length(half_edge.id());
        let source = image(length, ends)?;
        let path = self.layout.apex(half_edge.id()) - source;
        let crosses = path.perp_dot(-source) >= 0.0 && path.perp_dot(DVec2::new(length, 0.0) - source) <= 0.0;
        crosses.then(|| path.length())
    }
}

/// The point below the x axis at given distances from the origin and from the point at `length` on the axis; none if no point is or if those coincide.
#[inline]
fn image(length: f64, [to_origin, to_end]: [f64; 2]) -> Option<DVec2> {
    if !(length > 0.0 && to_origin < f64::INFINITY && to_end < f64::INFINITY) {
        return None;
    }
    let x = 0.5 * (length + (to_origin - to_end) * (to_origin + to_end) / length);
    let squared = (to_origin - x) * (to_origin + x);
    (squared >= 0.0).then(|| DVec2::new(x, -squared.sqrt()))
}
