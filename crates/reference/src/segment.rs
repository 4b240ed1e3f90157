//! A straight tapered piece of hair on the surface.

use glam::{DVec3, Vec3};

/// What rays meet: the hull of two spheres. 32 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    pub(crate) ends: [[f32; 3]; 2],
    pub(crate) radii: [f32; 2],
}

/// Where it comes from: what light asks for. 48 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Origin {
    /// Face of the patches.
    pub(crate) face: u32,
    /// Strand of the tile.
    pub(crate) strand: u32,
    /// Which copy of the strand: the same for all its segments on one patch.
    pub(crate) copy: u32,
    /// Whether some of it is not to be seen: what is outside of the face's part of shell space.
    pub(crate) is_clipped: bool,
    /// The first two barycentric coordinates at both ends.
    pub(crate) beta: [[f32; 2]; 2],
    /// Heights at both ends, 0 at the skin, 1 at the tips.
    pub(crate) heights: [f32; 2],
    /// How far along the strand both ends are.
    pub(crate) along: [f32; 2],
}

impl Segment {
    /// Its ends in `f64`.
    pub(crate) fn axis(&self) -> [DVec3; 2] {
        self.ends.map(|end| Vec3::from(end).as_dvec3())
    }

    /// Its unit direction; zero where it has no length.
    pub(crate) fn direction(&self) -> DVec3 {
        let [a, b] = self.axis();
        (b - a).normalize_or_zero()
    }
}

impl Origin {
    /// Barycentric coordinates a part of the way along.
    pub(crate) fn beta_at(&self, part: f64) -> DVec3 {
        let [x, y] = [0, 1].map(|k| lerp(self.beta.map(|beta| beta[k]), part));
        DVec3::new(x, y, 1.0 - x - y)
    }

    pub(crate) fn height_at(&self, part: f64) -> f64 {
        lerp(self.heights, part)
    }

    pub(crate) fn along_at(&self, part: f64) -> f64 {
        lerp(self.along, part)
    }
}

fn lerp(ends: [f32; 2], part: f64) -> f64 {
    f64::from(ends[0]) + (f64::from(ends[1]) - f64::from(ends[0])) * part
}
