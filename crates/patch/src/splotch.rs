//! Irregular outlines (Praun et al. 2000, section 3).

use glam::DVec2;
use rand::{Rng, RngExt};

/// Waves of two to six lobes round the circle.
const HARMONICS: usize = 5;
/// Greatest departure from the circle, as a fraction of its radius.
const ROUGHNESS: f64 = 0.35;

/// A closed outline about the origin: a circle whose radius is perturbed by a few waves of random phase.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Splotch {
    radius: f64,
    /// The wave of *k* + 2 lobes as a complex amplitude; the lengths sum to at most `ROUGHNESS`.
    waves: [DVec2; HARMONICS],
}

impl Splotch {
    pub(crate) fn random(diameter: f64, rng: &mut impl Rng) -> Self {
        let waves = std::array::from_fn(|_| in_unit_disc(rng) * (ROUGHNESS / HARMONICS as f64));
        Self { radius: 0.5 * diameter, waves }
    }

    /// The outline's radius towards a place. Lobes come from powers of the unit complex number, so no trigonometry is called and the
    /// bits are the same everywhere.
    pub(crate) fn radius_towards(&self, place: DVec2) -> f64 {
        let Some(unit) = place.try_normalize() else { return self.radius };
        let mut power = unit;
        let mut factor = 1.0;
        for wave in self.waves {
            power = power.rotate(unit);
            factor += wave.dot(power);
        }
        self.radius * factor
    }

    /// Whether a place lies inside the outline grown by `swelling`.
    pub(crate) fn contains(&self, place: DVec2, swelling: f64) -> bool {
        place.length() <= swelling * self.radius_towards(place)
    }

    /// Roughly.
    pub(crate) fn area(&self) -> f64 {
        std::f64::consts::PI * self.radius * self.radius
    }
}

/// A random rotation, uniform in angle.
pub(crate) fn random_rotation(rng: &mut impl Rng) -> DVec2 {
    loop {
        if let Some(unit) = in_unit_disc(rng).try_normalize() {
            return unit;
        }
    }
}

fn in_unit_disc(rng: &mut impl Rng) -> DVec2 {
    loop {
        let point = DVec2::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        if point.length_squared() <= 1.0 {
            return point;
        }
    }
}
