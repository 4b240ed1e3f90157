//! A place on the surface that need not be a vertex.

use glam::DVec3;

use crate::{FaceId, Mesh};

/// A point on a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The face.
    pub face: FaceId,
    /// How much each corner counts, in winding order: not negative, and 1 together.
    pub barycentrics: DVec3,
}

impl SurfacePoint {
    /// Where it is, in model units.
    pub fn position(&self, mesh: &Mesh) -> DVec3 {
        mesh.face(self.face).at(self.barycentrics)
    }
}
