//! Geodesic polar coordinates about a place (Melvær and Reimers 2012).

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use pelage_mesh::{Face, HalfEdge, Mesh, Vertex, VertexId, unit};

use crate::completion::any_tangent;
use crate::fan::away_from_face;
use crate::transport::{tangent_part, transport};

/// A way that is not shorter by this part is no shorter way: it keeps those that are equal but for rounding from replacing each other.
const SHORTER: f64 = 1e-9;

/// A vertex as seen from the place.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    /// Along the surface, in diameters of the model.
    pub(crate) distance: f64,
    /// In which direction it left the place, in radians from the first side of its face, anticlockwise seen from outside.
    pub(crate) angle: f64,
    /// In which direction it arrives: a unit tangent.
    pub(crate) away: DVec3,
}

/// A vertex may be looked on from anew when a shorter way to it is found over a face whose third corner lies farther; so often at most, so that the
/// march ends after *F* log *F* steps whatever the mesh.
const MOST_PASSES: u8 = 8;

/// How each vertex is seen from the middle of a face with area; none where no path leads, or a vertex has no normal.
///
/// The front is marched outwards as in Dijkstra's algorithm. Over a face two corners of which have been passed, the place is laid out flat beside
/// it, by their distances, so that a plane is seen exactly; the angle is interpolated between theirs.
pub(crate) fn seen_from(face: Face<'_, Mesh>, normals: &[DVec3]) -> Vec<Option<Seen>> {
    let mesh = face.surface();
    let count = mesh.positions().len();
    let diameter = mesh.diameter();
    let mut march = March { normals, diameter, seen: vec![None; count], passes: vec![0; count], queue: BinaryHeap::new() };
    march.start(face);
    while let Some(Reverse((key, vertex))) = march.queue.pop() {
        let vertex = mesh.vertex(VertexId(vertex));
        let current = march.seen[vertex.index()].is_some_and(|seen| rounded(seen.distance) == key);
        if current && march.passes[vertex.index()] < MOST_PASSES {
            march.passes[vertex.index()] += 1;
            march.pass(vertex);
        }
    }
    march.seen
}

struct March<'a> {
    normals: &'a [DVec3],
    diameter: f64,
    seen: Vec<Option<Seen>>,
    /// How often each vertex was looked on from.
    passes: Vec<u8>,
    /// Nearer first, by [`rounded`] distance, then lower number.
    queue: BinaryHeap<Reverse<(u64, u32)>>,
}

impl March<'_> {
    /// Reaches the corners of the place's own face.
    fn start(&mut self, face: Face<'_, Mesh>) {
        let (normal, axis, middle) = (face.normal(), first_axis(face), incentre(face));
        for half_edge in face.half_edges() {
            let vertex = half_edge.origin();
            let offset = (vertex.position() - middle) / self.diameter;
            let here = self.normals[vertex.index()];
            // In the angles by which singularities are found, so that this face holds one whatever its shape.
            let away = away_from_face(half_edge, here, any_tangent(here));
            let angle = libm::atan2(offset.dot(normal.cross(axis)), offset.dot(axis));
            self.reach(vertex, Seen { distance: offset.length(), angle, away });
        }
    }

    fn reach(&mut self, vertex: Vertex<'_, Mesh>, seen: Seen) {
        let shorter = self.seen[vertex.index()].is_none_or(|before| seen.distance < before.distance * (1.0 - SHORTER));
        if shorter && seen.away != DVec3::ZERO {
            self.seen[vertex.index()] = Some(seen);
            self.queue.push(Reverse((rounded(seen.distance), vertex.id().0)));
        }
    }

    /// Looks from a vertex at the other two corners of each of its faces.
    fn pass(&mut self, vertex: Vertex<'_, Mesh>) {
        for leaving in vertex.leaving() {
            for corner in [leaving.next(), leaving.previous()] {
                self.look(vertex, corner);
            }
        }
    }

    /// At the origin of a half-edge: over its face if the third corner was passed too, else along the edge from `vertex`.
    fn look(&mut self, vertex: Vertex<'_, Mesh>, corner: HalfEdge<'_, Mesh>) {
        let passed = |v: Vertex<'_, Mesh>| self.seen[v.index()].filter(|_| self.passes[v.index()] > 0);
        let side = corner.next();
        let over = passed(side.origin()).zip(passed(side.tip())).and_then(|(one, two)| self.over_face(side, one, two));
        let seen = over.or_else(|| passed(vertex).map(|near| self.along_edge(vertex, corner.origin(), near)));
        if let Some(seen) = seen {
            self.reach(corner.origin(), seen);
        }
    }

    /// How the corner opposite a side is seen over their face, the side's ends being seen as `one` and `two`; none where the straight way
    /// from the place does not cross the side.
    fn over_face(&self, side: HalfEdge<'_, Mesh>, one: Seen, two: Seen) -> Option<Seen> {
        let along = side.vector() / self.diameter;
        let (length, x, normal) = (along.length(), unit(along), side.face().normal());
        let y = normal.cross(x);
        let place = laid_out(length, one.distance, two.distance)?;
        let arm = (side.apex().position() - side.origin().position()) / self.diameter;
        let way = DVec2::new(arm.dot(x), arm.dot(y)) - place;
        let crossing = place.x - way.x * place.y / way.y;
        if !(0.0..=length).contains(&crossing) {
            return None;
        }
        let turned = |to: DVec2| libm::atan2((-place).perp_dot(to), (-place).dot(to));
        let part = turned(way) / turned(DVec2::new(length, 0.0) - place);
        let difference = two.angle - one.angle;
        let angle = one.angle + part.clamp(0.0, 1.0) * (difference - TAU * (difference / TAU).round());
        let here = self.normals[side.apex().index()];
        let away = transport(unit(way.x * x + way.y * y), normal, here);
        Some(Seen { distance: way.length(), angle, away: unit(tangent_part(away, here)) })
    }

    fn along_edge(&self, from: Vertex<'_, Mesh>, to: Vertex<'_, Mesh>, near: Seen) -> Seen {
        let edge = (to.position() - from.position()) / self.diameter;
        let away = unit(tangent_part(unit(edge), self.normals[to.index()]));
        Seen { distance: near.distance + edge.length(), away, ..near }
    }
}

/// The first side of a face, from which angles about its middle are counted.
pub(crate) fn first_axis(face: Face<'_, Mesh>) -> DVec3 {
    unit(tangent_part(unit(face.half_edges()[0].vector()), face.normal()))
}

/// Where a place lies that is so far from the ends of a side, 0 and `length` on the first axis, and not above it; none where the distances
/// make no triangle.
fn laid_out(length: f64, from_start: f64, from_end: f64) -> Option<DVec2> {
    let along = 0.5 * (length + (from_start - from_end) * (from_start + from_end) / length);
    let below = (from_start - along) * (from_start + along);
    (below > 0.0).then(|| DVec2::new(along, -below.sqrt()))
}

/// Where a face's bisectors meet: seen from there, no two corners are nearer to opposite than the face's angles make them.
fn incentre(face: Face<'_, Mesh>) -> DVec3 {
    let across = [1, 2, 0].map(|k| face.half_edges()[k].length());
    let longest = across.into_iter().fold(f64::MIN_POSITIVE, f64::max);
    let weights = across.map(|length| length / longest);
    let sum: DVec3 = weights.iter().zip(face.positions()).map(|(&weight, corner)| weight * corner).sum();
    sum / weights.iter().sum::<f64>()
}

/// A distance as a whole number, so that those which are equal but for rounding tie, and the vertices' numbers decide: else a regular model
/// would have another field when scaled. The offset keeps round distances off the steps between numbers.
fn rounded(distance: f64) -> u64 {
    (distance * f64::from(1 << 30) + 0.371_943) as u64
}
