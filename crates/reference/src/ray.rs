//! A ray in `f64`, and what it meets.

use glam::DVec3;

/// A ray and how much of it counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: DVec3,
    /// Unit.
    pub(crate) direction: DVec3,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl Ray {
    pub(crate) fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }
}
