//! What a view knows once there are positions. Lengths in model units, angles in radians.

use glam::{DVec2, DVec3};

use super::{BoundaryLoop, Component, Edge, Face, HalfEdge, Vertex};
use crate::Mesh;
use crate::vector::{angle_between, unit};

impl Vertex<'_, Mesh> {
    /// Where it is.
    #[inline]
    pub fn position(self) -> DVec3 {
        self.surface().positions()[self.index()]
    }

    /// Its unit normal, as [`Mesh::vertex_normals`] has it for all of them; zero for an unreferenced vertex.
    pub fn normal(self) -> DVec3 {
        unit(self.leaving().map(|corner| corner.face().normal() * corner.angle()).sum())
    }

    /// The angles of its faces at it, added up: 2π where the surface is flat and has no boundary.
    pub fn angle_sum(self) -> f64 {
        self.leaving().map(HalfEdge::angle).sum()
    }

    /// What its angles lack of 2π, or of π on a boundary: the curvature, Gaussian or geodesic, gathered at it. Over a component it adds up to 2πχ.
    pub fn angle_defect(self) -> f64 {
        let flat = if self.is_boundary() { std::f64::consts::PI } else { std::f64::consts::TAU };
        if self.is_referenced() { flat - self.angle_sum() } else { 0.0 }
    }

    /// A third of the area of its faces, in square model units: over all vertices they add up to the surface.
    pub fn area(self) -> f64 {
        self.faces().map(Face::area).sum::<f64>() / 3.0
    }
}

impl HalfEdge<'_, Mesh> {
    /// The vector from where it starts to where it ends.
    #[inline]
    pub fn vector(self) -> DVec3 {
        self.tip().position() - self.origin().position()
    }

    /// Its length.
    #[inline]
    pub fn length(self) -> f64 {
        self.vector().length()
    }

    /// The angle of its face at its origin, 0 to π.
    #[inline]
    pub fn angle(self) -> f64 {
        angle_between(self.vector(), -self.previous().vector())
    }

    /// The cotangent of the angle of its face opposite to it; infinite where the face has no area.
    pub fn opposite_cotangent(self) -> f64 {
        let (a, b) = (unit(-self.next().vector()), unit(self.previous().vector()));
        a.dot(b) / a.cross(b).length()
    }

    /// The texture coordinates at its origin in its face, if the mesh has any.
    pub fn texture_coordinates(self) -> Option<DVec2> {
        self.surface().texture_coordinates().map(|coordinates| coordinates[self.index()])
    }
}

impl Edge<'_, Mesh> {
    /// Its length.
    #[inline]
    pub fn length(self) -> f64 {
        self.half_edge().length()
    }

    /// Its middle.
    pub fn centre(self) -> DVec3 {
        let [a, b] = self.vertices().map(Vertex::position);
        0.5 * a + 0.5 * b
    }

    /// How far the surface turns over it, −π to π: 0 where flat, positive over a ridge, negative in a valley; none at a boundary.
    pub fn dihedral_angle(self) -> Option<f64> {
        let near = self.half_edge();
        let far = near.twin()?;
        let (n, m) = (near.face().normal(), far.face().normal());
        Some(libm::atan2(unit(near.vector()).dot(n.cross(m)), n.dot(m)))
    }
}

impl Face<'_, Mesh> {
    /// Where its corners are, in winding order.
    #[inline]
    pub fn positions(self) -> [DVec3; 3] {
        self.vertices().map(Vertex::position)
    }

    /// Its middle.
    pub fn centre(self) -> DVec3 {
        let [a, b, c] = self.positions();
        (a + b + c) / 3.0
    }

    /// The point with these barycentric coordinates, one for each corner; they add up to 1.
    pub fn at(self, barycentrics: DVec3) -> DVec3 {
        let [a, b, c] = self.positions();
        a * barycentrics.x + b * barycentrics.y + c * barycentrics.z
    }

    /// Half the cross product of two sides: along the normal, as long as the area. Sides of 1e-150 to 1e150 keep it in range.
    #[inline]
    pub fn area_vector(self) -> DVec3 {
        let [a, b, c] = self.positions();
        0.5 * (b - a).cross(c - a)
    }

    /// Its area, in square model units.
    pub fn area(self) -> f64 {
        self.area_vector().length()
    }

    /// Its unit normal; zero for a face without area. Right at any scale, also where the area itself leaves the range of `f64`.
    pub fn normal(self) -> DVec3 {
        let [a, b, c] = self.positions();
        unit(unit(b - a).cross(unit(c - a)))
    }

    /// Its angles at its corners, 0 to π; they add up to π but for a face with a side of no length.
    pub fn angles(self) -> [f64; 3] {
        let [a, b, c] = self.positions();
        [angle_between(b - a, c - a), angle_between(c - b, a - b), angle_between(a - c, b - c)]
    }
}

impl BoundaryLoop<'_, Mesh> {
    /// Its length.
    pub fn length(self) -> f64 {
        self.half_edges().map(HalfEdge::length).sum()
    }

    /// How far it turns to the left in the surface as it is walked: the [`Vertex::angle_defect`] of its vertices; 2π for a flat disc, −2π for a hole in a plane.
    pub fn turning(self) -> f64 {
        self.vertices().map(Vertex::angle_defect).sum()
    }
}

impl Component<'_, Mesh> {
    /// Its area, in square model units.
    pub fn area(self) -> f64 {
        self.faces().map(Face::area).sum()
    }
}
