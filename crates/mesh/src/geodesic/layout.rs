//! Faces laid out flat, one beside the other.

use glam::{DVec2, DVec3};

use super::Source;
use crate::{HalfEdge, HalfEdgeId, Mesh, SurfacePoint};

/// A source within this fraction of a face's height from a side, or a corner, is on it.
pub(super) const ON_SIDE: f64 = 1e-9;

/// Each face as its half-edges see it: the half-edge along the x axis from the origin, the face above. In units of the mesh's diameter, so that no square overflows.
#[derive(Clone, Debug)]
pub(super) struct Layout<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) unit: f64,
    sides: Vec<Side>,
}

#[derive(Clone, Copy, Debug)]
struct Side {
    length: f64,
    apex: DVec2,
}

impl<'a> Layout<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let diameter = mesh.diameter();
        // All in one place: every distance is 0, in whatever unit.
        let unit = if diameter > 0.0 { diameter } else { 1.0 };
        let side = |half_edge: HalfEdge<'_, Mesh>| {
            let along = half_edge.vector() / unit;
            let to_apex = -half_edge.previous().vector() / unit;
            let length = along.length();
            let apex = if length > 0.0 {
                DVec2::new(along.dot(to_apex), along.cross(to_apex).length()) / length
            } else {
                DVec2::new(0.0, to_apex.length())
            };
            Side { length, apex }
        };
        Self { mesh, unit, sides: mesh.half_edges().map(side).collect() }
    }

    #[inline]
    pub(super) fn length(&self, half_edge: HalfEdgeId) -> f64 {
        self.sides[half_edge.index()].length
    }

    /// The third corner of the half-edge's face.
    #[inline]
    pub(super) fn apex(&self, half_edge: HalfEdgeId) -> DVec2 {
        self.sides[half_edge.index()].apex
    }

    /// The two other sides of a half-edge's face, each with the frame of the half-edge behind it: where that starts, and which way it runs.
    /// First the side from the tip to the apex, then that from the apex to the origin.
    #[inline]
    pub(super) fn far_sides(&self, half_edge: HalfEdgeId) -> [Frame; 2] {
        let (tip, apex) = (DVec2::new(self.length(half_edge), 0.0), self.apex(half_edge));
        let frame = |side: HalfEdgeId, from: DVec2, to: DVec2| Frame { side, from, along: (to - from) / self.length(side) };
        [frame(half_edge.next(), apex, tip), frame(half_edge.previous(), DVec2::ZERO, apex)]
    }

    /// Where a point of the face lies for one of its half-edges.
    pub(super) fn place(&self, half_edge: HalfEdgeId, point: &SurfacePoint) -> DVec2 {
        let corner = (half_edge.0 % 3) as usize;
        let b: [f64; 3] = point.barycentrics.max(DVec3::ZERO).into();
        let (tip, apex) = (b[(corner + 1) % 3], b[(corner + 2) % 3]);
        let sum = b[0] + b[1] + b[2];
        (DVec2::new(self.length(half_edge), 0.0) * tip + self.apex(half_edge) * apex) / sum
    }

    /// Every face that a source touches with the source's coordinates there: one inside, two on an edge, as many as the vertex has at a vertex.
    pub(super) fn faces_of(&self, source: &Source) -> Vec<SurfacePoint> {
        let at_corner = |corner: HalfEdge<'_, Mesh>| {
            let axis = DVec3::AXES[corner.index() % 3];
            SurfacePoint { face: corner.face().id(), barycentrics: axis }
        };
        let point = match source {
            Source::Vertex(vertex) => return self.mesh.vertex(*vertex).leaving().map(at_corner).collect(),
            Source::Point(point) => point,
        };
        let weights: [f64; 3] = point.barycentrics.into();
        let sides = self.mesh.face(point.face).half_edges();
        if let Some(corner) = (0..3).find(|&k| 1.0 - weights[k] <= ON_SIDE) {
            return sides[corner].origin().leaving().map(at_corner).collect();
        }
        let mut touched = vec![*point];
        // Corner k + 2 weighs nothing: the point lies on side k.
        for (k, side) in sides.into_iter().enumerate().filter(|(k, _)| weights[(k + 2) % 3] <= ON_SIDE) {
            if let Some(twin) = side.twin() {
                let mut barycentrics = [0.0; 3];
                barycentrics[twin.index() % 3] = weights[(k + 1) % 3];
                barycentrics[twin.next().index() % 3] = weights[k];
                touched.push(SurfacePoint { face: twin.face().id(), barycentrics: barycentrics.into() });
            }
        }
        touched
    }
}

/// The frame of the half-edge behind one side of a face, seen from the frame of another side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// The side, as a half-edge of the face.
    pub(super) side: HalfEdgeId,
    from: DVec2,
    along: DVec2,
}

impl Frame {
    /// Where a point lies in this frame.
    #[inline]
    pub(super) fn see(&self, point: DVec2) -> DVec2 {
        let arm = point - self.from;
        DVec2::new(arm.dot(self.along), self.along.perp_dot(arm))
    }
}
