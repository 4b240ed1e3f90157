//! The light a single fibre returns (L13), exact.

use glam::DVec3;

/// Where |L + V| is below this, the half vector is lost in rounding and the specular fades out in proportion.
pub const HALF_VECTOR_FADE: f64 = 1e-3;

/// The hair lighting of Lengyel et al. 2001, section 2.4: Ka + Kd (1 − u²)^(Pd/2) + Ks (1 − v²)^(Ps/2).
///
/// A fibre has no one normal: 1 − u² is the squared sine between it and the light, which is the cosine to the best of its normals
/// (Kajiya and Kay 1989; Banks 1994). It depends on neither the skin's normal nor depth: see [`crate::Facing`] and [`crate::SelfShadow`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairLighting {
    /// *Ka*, the part of the light from all around that is returned; each channel usually 0 to 1.
    pub ambient: DVec3,
    /// *Kd*, the diffuse colour; each channel usually 0 to 1.
    pub diffuse: DVec3,
    /// *Ks*, the colour of the highlight; each channel usually 0 to 1.
    pub specular: DVec3,
    /// *Pd*, from 0 up; under 0 counts as 0. At 1 a fibre gives back the sine; Banks found 4.8 to match a surface's brightness.
    pub diffuse_power: f64,
    /// *Ps*, from 0 up; under 0 counts as 0. The higher the narrower the highlight.
    pub specular_power: f64,
}

impl Default for HairLighting {
    /// A soft coat with a faint broad highlight.
    ///
    /// Hair that points at the light returns none of it, which leaves a dark spot where a coat should be brightest; real hair scatters about
    /// its mean direction. A diffuse power under 1 stands for that.
    fn default() -> Self {
        Self {
            ambient: DVec3::splat(0.7),
            diffuse: DVec3::splat(1.0),
            specular: DVec3::splat(0.25),
            diffuse_power: 0.6,
            specular_power: 20.0,
        }
    }
}

impl HairLighting {
    /// The light returned for u = T·L and v = T·H, cosines that may lie beyond ±1 by rounding.
    ///
    /// Finite for finite colours, exact to rounding; with both powers 0 it is Ka + Kd + Ks exactly. A cosine that is no number counts as 1, a power that is
    /// none as 0.
    pub fn evaluate(&self, u: f64, v: f64) -> DVec3 {
        self.combine(self.diffuse_factor(u), self.specular_factor(v))
    }

    /// (1 − u²)^(Pd/2), from 0 to 1.
    pub fn diffuse_factor(&self, u: f64) -> f64 {
        sine_power(u, self.diffuse_power)
    }

    /// (1 − v²)^(Ps/2), from 0 to 1.
    pub fn specular_factor(&self, v: f64) -> f64 {
        sine_power(v, self.specular_power)
    }

    /// Ka + Kd · diffuse + Ks · specular, for factors from here or from a table.
    pub fn combine(&self, diffuse: f64, specular: f64) -> DVec3 {
        self.ambient + self.diffuse * diffuse + self.specular * specular
    }
}

/// The value brought into a range; `otherwise` for what is no number.
pub(crate) fn within(value: f64, low: f64, high: f64, otherwise: f64) -> f64 {
    if value.is_nan() { otherwise } else { value.clamp(low, high) }
}

/// sin(angle)^power from the angle's cosine.
///
/// Clamped before the root, as rounded unit vectors often have a product above 1. `libm`, so that tables have the same bits everywhere.
fn sine_power(cosine: f64, power: f64) -> f64 {
    let cosine = within(cosine, -1.0, 1.0, 1.0);
    // (1 − c)(1 + c) keeps the digits that 1 − c² loses near ±1.
    libm::pow((1.0 - cosine) * (1.0 + cosine), 0.5 * power.max(0.0))
}

/// *H*, and how far it is to be believed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfVector {
    /// The unit vector half-way between light and eye; zero where they are opposite.
    pub direction: DVec3,
    /// 1, falling in proportion to |L + V| to 0 below [`HALF_VECTOR_FADE`]: multiply the specular by it.
    pub weight: f64,
}

/// The half vector of unit *L* and *V*: as they come to oppose each other it has no direction, and its weight fades to 0, as it does for what is no number.
pub fn half_vector(light: DVec3, view: DVec3) -> HalfVector {
    let sum = light + view;
    let length = sum.length();
    if length > 0.0 {
        HalfVector { direction: sum / length, weight: (length / HALF_VECTOR_FADE).min(1.0) }
    } else {
        HalfVector { direction: DVec3::ZERO, weight: 0.0 }
    }
}
