//! Rays, and what they hit.

use glam::DVec3;

use super::crossing::Crossing;
use crate::SurfacePoint;
use crate::vector::unit;

/// A half-line, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    origin: DVec3,
    direction: DVec3,
    nearest: f64,
    farthest: f64,
}

/// Why there is no such ray.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RayError {
    /// The origin is NaN or infinite.
    #[error("the ray starts at {origin}, which is no place; give a finite one")]
    Origin {
        /// Where it starts.
        origin: DVec3,
    },
    /// The direction is zero, NaN or infinite.
    #[error("the ray's direction is {direction}, which is none; give a finite vector that is not zero")]
    Direction {
        /// Its direction.
        direction: DVec3,
    },
}

impl Ray {
    /// The ray from a place along a direction of whatever length.
    ///
    /// # Errors
    /// Where `origin` is not finite, or `direction` is zero or not finite.
    pub fn new(origin: DVec3, direction: DVec3) -> Result<Self, RayError> {
        let along = unit(direction);
        if !origin.is_finite() {
            return Err(RayError::Origin { origin });
        }
        if along == DVec3::ZERO {
            return Err(RayError::Direction { direction });
        }
        Ok(Self { origin, direction: along, nearest: 0.0, farthest: f64::INFINITY })
    }

    /// The part of it from one distance to another, in model units; both ends are in it. What it may hit lies there, distances are still from the origin.
    ///
    /// A ray that starts on the surface hits it at about 0: `ray.between(1e-9 * diameter, f64::INFINITY)` looks beyond.
    #[must_use]
    pub fn between(self, nearest: f64, farthest: f64) -> Self {
        Self { nearest, farthest, ..self }
    }

    /// Where it starts.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Its unit direction.
    pub fn direction(&self) -> DVec3 {
        self.direction
    }

    /// The place at a distance from the origin.
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }

    pub(super) fn limits(&self) -> (f64, f64) {
        (self.nearest, self.farthest)
    }

    /// The hit of a crossing, if it lies on the part of the ray that counts. `scale` is model units in a unit of the crossing.
    pub(super) fn hit(&self, crossing: Crossing, scale: f64) -> Option<Hit> {
        let distance = crossing.distance * scale;
        let point = SurfacePoint { face: crossing.face, barycentrics: crossing.barycentrics };
        let side = if crossing.faces_ray { Side::Outer } else { Side::Inner };
        (distance >= self.nearest && distance <= self.farthest).then_some(Hit { point, distance, side })
    }
}

/// Where a ray hits a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where on the surface.
    pub point: SurfacePoint,
    /// From the ray's origin, in model units.
    pub distance: f64,
    /// From which side.
    pub side: Side,
}

/// A side of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The side that its normal points to, from which it winds anticlockwise.
    Outer,
    /// The other.
    Inner,
}
