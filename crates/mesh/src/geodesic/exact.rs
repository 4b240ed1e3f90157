//! The exact distance: windows are passed from edge to edge.

use std::f64::consts::{PI, TAU};

use super::Source;
use super::layout::Layout;
use super::queue::Queue;
use super::window::{Sight, Window};
use crate::{Mesh, Vertex, VertexId};

/// A vertex with more than a flat one's angle by this much bends shortest paths.
const LEAST_EXCESS: f64 = 1e-9;

/// Two windows that see a corner at distances closer than this fraction of them both pass on either side of it.
const TIE: f64 = 1e-12;

/// Sets the distances of the vertices within reach, and returns them; all others stay as they are.
pub(super) fn propagate(layout: &Layout<'_>, sources: &[Source], reach: f64, distances: &mut [f64]) -> Vec<VertexId> {
    let best = vec![Best { distance: f64::INFINITY, crossing: 0.0 }; layout.mesh.topology().half_edge_count()];
    let mut search = Search { layout, reach, distances, best, queue: Queue::new(), touched: Vec::new() };
    for source in sources {
        search.start(source);
    }
    while let Some((distance, event)) = search.queue.pop() {
        match event {
            Event::Vertex(vertex) if distance <= search.distances[vertex.index()] => search.bend(vertex, distance),
            Event::Window(window) if !window.is_useless(layout, search.distances) => search.pass_on(&window),
            _ => {}
        }
    }
    search.touched
}

enum Event {
    Vertex(VertexId),
    Window(Window),
}

/// The best window so far that saw the corner opposite a half-edge over it, and where its ray crossed.
#[derive(Clone, Copy)]
struct Best {
    distance: f64,
    crossing: f64,
}

struct Search<'s, 'm> {
    layout: &'s Layout<'m>,
    reach: f64,
    distances: &'s mut [f64],
    best: Vec<Best>,
    queue: Queue<Event>,
    touched: Vec<VertexId>,
}

impl<'m> Search<'_, 'm> {
    fn start(&mut self, source: &Source) {
        if let Source::Vertex(vertex) = source {
            self.reach_vertex(*vertex, 0.0);
        }
        self.look_around(source, 0.0);
    }

    /// From a source: the corners of the faces that it touches, and a window on each side that it does not lie on.
    fn look_around(&mut self, source: &Source, offset: f64) {
        for point in self.layout.faces_of(source) {
            let face = self.layout.mesh.face(point.face);
            for (k, side) in face.half_edges().into_iter().enumerate() {
                let place = self.layout.place(side.id(), &point);
                self.reach_vertex(side.origin().id(), offset + place.length());
                let weight_opposite = point.barycentrics[(k + 2) % 3];
                if weight_opposite > super::layout::ON_SIDE
                    && let Some(behind) = side.twin()
                {
                    let length = self.layout.length(side.id());
                    let source = glam::DVec2::new(length - place.x, -place.y);
                    self.offer(Window { half_edge: behind.id(), from: 0.0, to: length, source, offset });
                }
            }
        }
    }

    fn reach_vertex(&mut self, vertex: VertexId, distance: f64) {
        let known = &mut self.distances[vertex.index()];
        if distance > self.reach || distance >= *known {
            return;
        }
        if *known == f64::INFINITY {
            self.touched.push(vertex);
        }
        *known = distance;
        self.queue.push(distance, Event::Vertex(vertex));
    }

    /// A vertex passes its distance on along edges, and where shortest paths can bend it is a source itself.
    fn bend(&mut self, vertex: VertexId, distance: f64) {
        let here = self.layout.mesh.vertex(vertex);
        for edge in here.edges() {
            let [a, b] = edge.vertices();
            let other = if a == here { b } else { a };
            self.reach_vertex(other.id(), distance + self.layout.length(edge.half_edge().id()));
        }
        if bends_paths(here) {
            self.look_around(&Source::Vertex(vertex), distance);
        }
    }

    fn offer(&mut self, window: Window) {
        let nearest = window.nearest();
        if nearest <= self.reach && !window.is_useless(self.layout, self.distances) {
            self.queue.push(nearest, Event::Window(window));
        }
    }

    /// Passes a window over its face to the two other sides; but where a better one saw the corner between them, to the side that the better one does not cover.
    fn pass_on(&mut self, window: &Window) {
        let apex = self.layout.apex(window.half_edge);
        let sight = window.sees(apex);
        let (mut to_left, mut to_right) = (sight != Sight::Left, sight != Sight::Right);
        if sight == Sight::Between {
            let (distance, crossing) = (window.distance_to(apex), window.crossing(apex));
            let best = &mut self.best[window.half_edge.index()];
            if distance > best.distance * (1.0 + TIE) {
                to_left = crossing <= best.crossing;
                to_right = crossing >= best.crossing;
            } else if distance < best.distance {
                *best = Best { distance, crossing };
            }
            let corner = self.layout.mesh.half_edge(window.half_edge).apex().id();
            self.reach_vertex(corner, distance);
        }
        let between = sight == Sight::Between;
        let [right, left] = self.layout.far_sides(window.half_edge);
        for (frame, wanted, starts_at_corner, ends_at_corner) in [(left, to_left, false, between), (right, to_right, between, false)] {
            let length = self.layout.length(frame.side);
            if wanted
                && let Some(behind) = self.layout.mesh.half_edge(frame.side).twin()
                && let Some(child) = window.beyond(&frame, behind.id(), length, starts_at_corner, ends_at_corner)
            {
                self.offer(child);
            }
        }
    }
}

/// Whether a shortest path can pass through the vertex with an angle on either side: not over a tip.
fn bends_paths(vertex: Vertex<'_, Mesh>) -> bool {
    let flat = if vertex.is_boundary() { PI } else { TAU };
    vertex.angle_sum() > flat + LEAST_EXCESS
}
