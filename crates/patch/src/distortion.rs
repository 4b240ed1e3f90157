//! How a face's place in the tile differs from the wanted one.

use glam::DVec2;

use crate::shape::FaceShape;

/// The linear part of the map from a face's layout to the tile, both in tile units, so that the wanted map is a rotation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jacobian {
    /// Gradient of s in the layout.
    s: DVec2,
    /// Gradient of t in the layout.
    t: DVec2,
}

impl Jacobian {
    /// Of a face that is not degenerate.
    pub(crate) fn new(shape: &FaceShape, places: [DVec2; 3]) -> Self {
        let base = shape.corners[1].x;
        let third = shape.corners[2];
        let along = (places[1] - places[0]) / base;
        let across = (places[2] - places[0] - along * third.x) / third.y;
        Self { s: DVec2::new(along.x, across.x), t: DVec2::new(along.y, across.y) }
    }

    /// The greater and the lesser singular value; the lesser is negative where the face is flipped.
    pub(crate) fn singular_values(&self) -> [f64; 2] {
        let turning = 0.5 * DVec2::new(self.s.x + self.t.y, self.t.x - self.s.y).length();
        let mirror = 0.5 * DVec2::new(self.s.x - self.t.y, self.t.x + self.s.y).length();
        [turning + mirror, turning - mirror]
    }

    /// The greater of the greater singular value and the inverse of the lesser: 1 at the wanted scale, infinite where flipped.
    pub(crate) fn stretch(&self) -> f64 {
        let [greater, lesser] = self.singular_values();
        if lesser > 0.0 { greater.max(1.0 / lesser) } else { f64::INFINITY }
    }

    /// Cosine of the angle between a unit direction of the layout and the tile's t axis pulled back into it.
    pub(crate) fn alignment(&self, direction: DVec2) -> f64 {
        // The line of constant s; its sense follows t where the face is not flipped.
        DVec2::new(-self.s.y, self.s.x).try_normalize().map_or(-1.0, |axis| axis.dot(direction))
    }
}

/// What every face of a patch must keep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    max_stretch: f64,
    /// Cosine of the greatest turning.
    min_alignment: f64,
}

impl Bounds {
    /// `max_turning` in radians.
    pub(crate) fn new(max_stretch: f64, max_turning: f64) -> Self {
        Self { max_stretch, min_alignment: libm::cos(max_turning) }
    }

    /// Whether a face so placed keeps them. `rotation` is the wanted one where there is a field.
    pub(crate) fn hold(&self, shape: &FaceShape, places: [DVec2; 3], rotation: Option<DVec2>) -> bool {
        if shape.degenerate {
            return true;
        }
        let jacobian = Jacobian::new(shape, places);
        let aligned = rotation.is_none_or(|r| jacobian.alignment(DVec2::new(r.y, r.x)) >= self.min_alignment);
        aligned && jacobian.stretch() <= self.max_stretch
    }
}
