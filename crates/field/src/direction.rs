//! Tangent directions.

use glam::DVec3;
use pelage_mesh::{FaceId, Mesh, VertexId, unit};

use crate::FieldError;
use crate::completion::{Completion, smooth_once};
use crate::constraints::{Constraint, Constraints, checked_directions};
use crate::point::PointConstraint;
use crate::transport::tangent_part;

/// A unit tangent vector at each vertex, in model coordinates: which way the fur lies.
///
/// Tangent means across the mean of the faces' normals weighted by angle ([`Mesh::vertex_normals`]). Unreferenced vertices, and vertices
/// whose normal vanishes, hold zero.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionField {
    vectors: Vec<DVec3>,
}

impl DirectionField {
    /// One direction for the whole model, in model coordinates and of any length, projected to the tangent plane at each vertex.
    ///
    /// Where the surface lies nearly across it ([`LEAST_PROJECTION`](crate::LEAST_PROJECTION)) the field is completed smoothly from its surroundings; a piece of
    /// surface that lies across it altogether follows the coordinate axis of which most lies in the piece instead (x before y before z).
    /// Near linear time.
    ///
    /// # Errors
    /// Where the direction is zero or not finite, or the mesh has no faces.
    ///
    /// ```
    /// use glam::DVec3;
    /// let ball = pelage_mesh::sphere(1.0, 8)?;
    /// let field = pelage_field::DirectionField::toward(&ball, DVec3::NEG_Y)?;
    /// assert!(field.vectors().iter().all(|v| (v.length() - 1.0).abs() < 1e-9));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn toward(mesh: &Mesh, direction: DVec3) -> Result<Self, FieldError> {
        let wanted = unit(direction);
        if wanted == DVec3::ZERO {
            return Err(FieldError::NoDirection(direction));
        }
        Self::completed(mesh, &vec![wanted; mesh.positions().len()], across(&[wanted]))
    }

    /// A few directions at places on the surface, and a few places that the fur lies about, spread over it (L2, L25; Praun, Finkelstein and
    /// Hoppe 2000, section 4).
    ///
    /// At each vertex the constraints' unit vectors are averaged, each with a Gaussian of its distance along the surface from the
    /// vertex nearest to the constraint's place. `radius` is the Gaussians' standard deviation, as a fraction of the model's diameter, 0.001 to
    /// 100: under the distance between constraints each rules its own surroundings, above it all are blended everywhere. The Gaussians are
    /// divided by the greatest of them, so that no place is too far to be ruled by its nearest constraint. The mean is projected to the
    /// tangent plane, scaled to unit length, and where it is too short for that ([`LEAST_PROJECTION`](crate::LEAST_PROJECTION)) completed smoothly.
    ///
    /// A point's vector at a vertex is the geodesic direction away from the middle of the face nearest to it, turned as its
    /// [`Flow`](crate::Flow) says. Every other constraint is also weighted by 1 less the point's Gaussian, so that a point rules alone at its own
    /// place: [`singularities`](crate::singularities) finds its index in that face. Two points in one face, or in faces that touch, cannot
    /// both be had. What further singularities the surface asks for (indices add up to its χ) lie where the field is led to them.
    ///
    /// A piece of surface that holds no constraint follows the mean of all the vectors, or the first one if they cancel, as
    /// [`DirectionField::toward`] does; without vectors, the coordinate axis of which most lies in it. Time is that of one [`Geodesics::distances`](pelage_mesh::Geodesics::distances) for each
    /// constraint, memory one number and one vector a vertex for each point.
    ///
    /// # Errors
    /// Where there are no constraints, a vector is zero, a number is not finite, the radius is out of range, or the mesh has no faces.
    ///
    /// ```
    /// use glam::DVec3;
    /// use pelage_field::{DirectionField, Flow, PointConstraint, singularities};
    ///
    /// // A crown: the fur whirls about the top, clockwise and outwards.
    /// let ball = pelage_mesh::sphere(1.0, 10)?;
    /// let crown = PointConstraint { at: DVec3::Y, flow: Flow::Turned(-1.0) };
    /// let field = DirectionField::from_constraints(&ball, &[], &[crown], 0.2)?;
    /// let found = singularities(&ball, &field)?;
    /// assert!(found.iter().any(|s| s.index == 1 && ball.face(s.face).centre().y > 0.99));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_constraints(mesh: &Mesh, vectors: &[Constraint], points: &[PointConstraint], radius: f64) -> Result<Self, FieldError> {
        let directions = checked_directions(vectors, points, radius)?;
        if mesh.topology().face_count() == 0 {
            return Err(FieldError::NoSurface);
        }
        let tie_break = across(&directions);
        let normals = mesh.vertex_normals();
        let wanted = Constraints { vectors, directions: &directions, points, radius }.blend(mesh, &normals, tie_break);
        Ok(Self { vectors: Completion::new(mesh, &normals, &wanted, tie_break).finish(mesh) })
    }

    /// A field from elsewhere, such as a painted one or a formula: a vector at each vertex, of any length, projected to the tangent plane.
    /// Where it is zero, or points straight out of the surface ([`LEAST_PROJECTION`](crate::LEAST_PROJECTION)), the field is completed as by
    /// [`DirectionField::toward`].
    ///
    /// # Errors
    /// Where there is not one vector for each vertex, one is not finite, or the mesh has no faces.
    pub fn from_vectors(mesh: &Mesh, vectors: &[DVec3]) -> Result<Self, FieldError> {
        let (values, expected) = (vectors.len(), mesh.positions().len());
        if values != expected {
            return Err(FieldError::Length { values, expected });
        }
        if let Some(vertex) = vectors.iter().position(|v| !v.is_finite()) {
            return Err(FieldError::NotFinite { vertex });
        }
        let wanted: Vec<DVec3> = vectors.iter().map(|&v| unit(v)).collect();
        Self::completed(mesh, &wanted, across(&wanted))
    }

    /// From a vector wanted at each vertex, at most 1 long.
    fn completed(mesh: &Mesh, wanted: &[DVec3], tie_break: DVec3) -> Result<Self, FieldError> {
        if mesh.topology().face_count() == 0 {
            return Err(FieldError::NoSurface);
        }
        let normals = mesh.vertex_normals();
        Ok(Self { vectors: Completion::new(mesh, &normals, wanted, tie_break).finish(mesh) })
    }

    /// The field after rounds of smoothing, in each of which every vector is joined by the mean of its neighbours', brought to its tangent
    /// plane. Singularities of opposite sign meet and vanish; 10 rounds take out noise of single vertices. Each round is linear.
    ///
    /// # Errors
    /// Where the field is not of this mesh.
    pub fn smoothed(&self, mesh: &Mesh, rounds: u32) -> Result<Self, FieldError> {
        self.check(mesh)?;
        let normals = mesh.vertex_normals();
        let mut vectors = self.vectors.clone();
        for _ in 0..rounds {
            vectors = smooth_once(mesh.topology(), &normals, &vectors);
        }
        Ok(Self { vectors })
    }

    /// The vectors, one for each vertex.
    pub fn vectors(&self) -> &[DVec3] {
        &self.vectors
    }

    /// The unit tangent at a vertex; zero where there is none.
    #[inline]
    pub fn at_vertex(&self, vertex: VertexId) -> DVec3 {
        self.vectors[vertex.index()]
    }

    /// The unit direction in the plane of a face: the mean of its corners' vectors, projected; zero where they cancel.
    pub fn on_face(&self, mesh: &Mesh, face: FaceId) -> DVec3 {
        let sum: DVec3 = mesh.face(face).vertices().map(|v| self.at_vertex(v.id())).into_iter().sum();
        let tangent = tangent_part(sum, mesh.face(face).normal());
        if tangent.length() > 1e-9 { unit(tangent) } else { DVec3::ZERO }
    }

    /// How many bytes it holds, for a cache to count.
    pub fn byte_size(&self) -> usize {
        size_of_val(self.vectors.as_slice())
    }

    pub(crate) fn check(&self, mesh: &Mesh) -> Result<(), FieldError> {
        let (values, expected) = (self.vectors.len(), mesh.positions().len());
        if values == expected { Ok(()) } else { Err(FieldError::Length { values, expected }) }
    }
}

/// A unit vector across most of some directions, and along no coordinate axis if it can be, as flat sides of models often lie across one.
fn across(directions: &[DVec3]) -> DVec3 {
    let along: DVec3 = directions.iter().map(|&d| d * d).sum::<DVec3>() / directions.len().max(1) as f64;
    unit((DVec3::ONE - along) * DVec3::new(1.0, 0.8, 0.6))
}
