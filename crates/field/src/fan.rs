//! Tangent directions at a vertex as angles of its fan of faces (Knöppel et al. 2013).

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use pelage_mesh::{HalfEdge, Mesh, Vertex, unit};

/// Stretches the corners at an inner vertex to a full round, and calls `place` with each half-edge that leaves the vertex, its direction
/// from the first of them and its corner, in radians. Returns the round: 2π, or on a boundary the sum of the angles.
pub(crate) fn lay_out<'a>(
    vertex: Vertex<'a, Mesh>,
    corner: impl Fn(HalfEdge<'a, Mesh>) -> f64,
    mut place: impl FnMut(HalfEdge<'a, Mesh>, f64, f64),
) -> f64 {
    let total: f64 = vertex.leaving().map(&corner).sum();
    let stretch = if vertex.is_boundary() || total <= 0.0 { 1.0 } else { TAU / total };
    let mut direction = 0.0;
    for h in vertex.leaving() {
        let stretched = stretch * corner(h);
        place(h, direction, stretched);
        direction += stretched;
    }
    direction
}

/// The angle of a tangent vector in the layout of a vertex, which is turned so that its edges lie as near as can be to where they are seen
/// along the normal. `directions` are those of the half-edges that leave it, in the layout.
pub(crate) fn angle_of<'a>(vertex: Vertex<'a, Mesh>, normal: DVec3, vector: DVec3, directions: impl Fn(HalfEdge<'a, Mesh>) -> f64) -> f64 {
    if vector == DVec3::ZERO {
        return 0.0;
    }
    // Seen from the vector itself, so that its own angle is 0.
    let sideways = normal.cross(vector);
    let misfit = |h: HalfEdge<'a, Mesh>| {
        let edge = unit(h.vector());
        let seen = DVec2::new(edge.dot(vector), edge.dot(sideways));
        let (sin, cos) = libm::sincos(directions(h));
        DVec2::new(cos, -sin).rotate(seen)
    };
    let sum: DVec2 = vertex.leaving().map(misfit).sum();
    -libm::atan2(sum.y, sum.x)
}

/// The unit tangent at the origin of a half-edge that lies, in the layout, opposite the bisector of the half-edge's face there: away from
/// the face's middle. `tangent` is any unit tangent there.
pub(crate) fn away_from_face(half_edge: HalfEdge<'_, Mesh>, normal: DVec3, tangent: DVec3) -> DVec3 {
    let vertex = half_edge.origin();
    let (mut leaving, mut bisector) = (Vec::new(), 0.0);
    lay_out(vertex, HalfEdge::angle, |h, direction, corner| {
        leaving.push((h.id(), direction));
        if h == half_edge {
            bisector = direction + 0.5 * corner;
        }
    });
    leaving.sort_unstable_by_key(|&(h, _)| h);
    let direction = |h: HalfEdge<'_, Mesh>| leaving.binary_search_by_key(&h.id(), |&(h, _)| h).map_or(0.0, |place| leaving[place].1);
    let turn = bisector + PI - angle_of(vertex, normal, tangent, direction);
    let (sin, cos) = libm::sincos(turn);
    unit(cos * tangent + sin * normal.cross(tangent))
}
