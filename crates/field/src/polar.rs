//! Geodesic polar coordinates about a place (Melvær and Reimers 2012).

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use pelage_mesh::{Face, Geodesics, HalfEdge, Mesh, SurfacePoint, Vertex, VertexId, unit};

use crate::completion::any_tangent;
use crate::fan::away_from_face;
use crate::transport::{tangent_part, transport};

/// A way that passes a side's end by less than this part of the side still crosses it.
const GRAZING: f64 = 1e-9;

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

/// How each vertex is seen from the middle of a face with area; none where no path leads, or a vertex has no normal.
///
/// Nearest first, each vertex is seen over the face that gives the shortest way to it: the place is laid out flat beside the face, by the distances of the other
/// two corners, so that a plane is seen exactly; the angle is interpolated between theirs.
pub(crate) fn seen_from(face: Face<'_, Mesh>, normals: &[DVec3], geodesics: &mut Geodesics<'_>) -> Vec<Option<Seen>> {
    let mesh = face.surface();
    let middle = SurfacePoint { face: face.id(), barycentrics: incentre(face) };
    let mut view = View { normals, diameter: mesh.diameter(), distances: Vec::new(), seen: vec![None; mesh.positions().len()] };
    // The source is on the mesh, so that there is a distance; else nothing is seen.
    let Ok(distances) = geodesics.distances(&[middle.into()], f64::INFINITY) else { return view.seen };
    view.distances = distances.to_vec(mesh.positions().len());
    view.distances.iter_mut().for_each(|distance| *distance /= view.diameter);
    view.start(face, middle.position(mesh));
    let mut order: Vec<VertexId> = distances.nearest_first().iter().map(|&(vertex, _)| vertex).collect();
    order.sort_by_key(|vertex| (rounded(view.distances[vertex.index()]), *vertex));
    for vertex in order {
        if view.seen[vertex.index()].is_none() {
            view.seen[vertex.index()] = view.look_at(mesh.vertex(vertex));
        }
    }
    view.seen
}

struct View<'a> {
    normals: &'a [DVec3],
    diameter: f64,
    /// In diameters.
    distances: Vec<f64>,
    seen: Vec<Option<Seen>>,
}

impl View<'_> {
    /// The corners of the place's own face.
    fn start(&mut self, face: Face<'_, Mesh>, middle: DVec3) {
        let (normal, axis) = (face.normal(), first_axis(face));
        for half_edge in face.half_edges() {
            let vertex = half_edge.origin();
            let offset = (vertex.position() - middle) / self.diameter;
            let here = self.normals[vertex.index()];
            // In the angles by which singularities are found, so that this face holds one whatever its shape.
            let away = away_from_face(half_edge, here, any_tangent(here));
            let angle = libm::atan2(offset.dot(normal.cross(axis)), offset.dot(axis));
            self.seen[vertex.index()] = Some(Seen { distance: offset.length(), angle, away });
        }
    }

    /// Over the face that gives the shortest way, or along the edge from the nearest neighbour where no straight way crosses a face.
    fn look_at(&self, vertex: Vertex<'_, Mesh>) -> Option<Seen> {
        let over = vertex.link().filter_map(|side| self.over_face(side));
        let along = || vertex.neighbours().filter_map(|neighbour| self.along_edge(neighbour, vertex));
        let nearest = over.min_by_key(|seen| rounded(seen.distance)).or_else(|| along().min_by_key(|seen| rounded(seen.distance)))?;
        (nearest.away != DVec3::ZERO).then_some(Seen { distance: self.distances[vertex.index()], ..nearest })
    }

    /// How the corner opposite a side is seen over their face; none where the straight way from the place does not cross the side.
    fn over_face(&self, side: HalfEdge<'_, Mesh>) -> Option<Seen> {
        let [one, two] = [side.origin(), side.tip()].map(|end| self.distances[end.index()]);
        let along = side.vector() / self.diameter;
        let (length, x, normal) = (along.length(), unit(along), side.face().normal());
        let y = normal.cross(x);
        let place = laid_out(length, one, two)?;
        let arm = (side.apex().position() - side.origin().position()) / self.diameter;
        let way = DVec2::new(arm.dot(x), arm.dot(y)) - place;
        let crossing = place.x - way.x * place.y / way.y;
        // A way through a corner of the side crosses it, whatever rounding says.
        if !(-GRAZING * length..=(1.0 + GRAZING) * length).contains(&crossing) {
            return None;
        }
        let here = self.normals[side.apex().index()];
        let away = transport(unit(way.x * x + way.y * y), normal, here);
        Some(Seen { distance: way.length(), angle: self.angle(side, place, length, way)?, away: unit(tangent_part(away, here)) })
    }

    /// The angle of a way from the place over a side: in proportion between those of its ends, or, where one end is farther than the corner
    /// and not seen yet, as far from the other as it is in the layout.
    fn angle(&self, side: HalfEdge<'_, Mesh>, place: DVec2, length: f64, way: DVec2) -> Option<f64> {
        let between = |a: DVec2, b: DVec2| libm::atan2(a.perp_dot(b), a.dot(b));
        let (to_one, to_two) = (-place, DVec2::new(length, 0.0) - place);
        let [one, two] = [side.origin(), side.tip()].map(|end| self.seen[end.index()].map(|seen| seen.angle));
        match (one, two) {
            (Some(one), Some(two)) => {
                let part = between(to_one, way) / between(to_one, to_two);
                let difference = two - one;
                Some(one + part.clamp(0.0, 1.0) * (difference - TAU * (difference / TAU).round()))
            }
            (Some(one), None) => Some(one + between(to_one, way)),
            (None, Some(two)) => Some(two + between(to_two, way)),
            (None, None) => None,
        }
    }

    fn along_edge(&self, from: Vertex<'_, Mesh>, to: Vertex<'_, Mesh>) -> Option<Seen> {
        let near = self.seen[from.index()]?;
        let edge = (to.position() - from.position()) / self.diameter;
        let away = unit(tangent_part(unit(edge), self.normals[to.index()]));
        Some(Seen { distance: near.distance + edge.length(), away, ..near })
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

/// Where a face's bisectors meet, in barycentric coordinates: seen from there, no two corners are nearer to opposite than the face's angles make them.
fn incentre(face: Face<'_, Mesh>) -> DVec3 {
    let across = DVec3::from([1, 2, 0].map(|k| face.half_edges()[k].length()));
    // Divided first, as the lengths' sum may leave the range of f64.
    let weights = across / across.max_element();
    weights / weights.element_sum()
}

/// A distance as a whole number, so that those which are equal but for rounding tie, and their order decides: else a regular model
/// would have another field when scaled. The offset keeps round distances off the steps between numbers.
fn rounded(distance: f64) -> u64 {
    (distance * f64::from(1 << 30) + 0.371_943) as u64
}
