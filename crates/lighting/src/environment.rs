//! A picture of all that is around, and what falls from it on a surface.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use crate::Irradiance;

/// A picture that cannot be one of all that is around.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EnvironmentError {
    /// There is no picture.
    #[error("the environment has {width} × {height} texels; give it at least 1 × 1")]
    Empty {
        /// Texels across.
        width: usize,
        /// Texels down.
        height: usize,
    },
    /// Size and texels differ.
    #[error("an environment of {width} × {height} texels was given {found}; give it width times height, rows from the top")]
    Length {
        /// Texels across.
        width: usize,
        /// Texels down.
        height: usize,
        /// Texels given.
        found: usize,
    },
    /// A texel that cannot be light.
    #[error("texel ({column}, {row}) of the environment is {radiance:?}; each channel must be finite and at least 0")]
    Radiance {
        /// From the left.
        column: usize,
        /// From the top.
        row: usize,
        /// What it says.
        radiance: [f32; 3],
    },
}

/// The light from all around as an equirectangular picture: radiance in linear light, one colour a texel, constant within it.
///
/// Rows are bands of equal height in elevation, from straight above (y up) at the top to straight below at the bottom. Columns are as a panorama is seen from
/// within: azimuth, which runs anticlockwise seen from above, is 180° at the left edge, 0 (towards +z) in the middle and −180° at the right edge, so that
/// +x, at 90°, is a quarter from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    width: usize,
    height: usize,
    /// Rows from the top.
    radiance: Vec<[f32; 3]>,
}

impl Environment {
    /// Takes a picture of any size from 1 × 1, rows from the top.
    ///
    /// # Errors
    /// Where there is no texel, their number is not the size's, or one is negative or not finite.
    pub fn new(width: usize, height: usize, radiance: Vec<[f32; 3]>) -> Result<Self, EnvironmentError> {
        if width == 0 || height == 0 {
            return Err(EnvironmentError::Empty { width, height });
        }
        if width.checked_mul(height) != Some(radiance.len()) {
            return Err(EnvironmentError::Length { width, height, found: radiance.len() });
        }
        let is_light = |texel: &[f32; 3]| texel.iter().all(|channel| channel.is_finite() && *channel >= 0.0);
        if let Some(at) = radiance.iter().position(|texel| !is_light(texel)) {
            return Err(EnvironmentError::Radiance { column: at % width, row: at / width, radiance: radiance[at] });
        }
        Ok(Self { width, height, radiance })
    }

    /// What falls on a surface, by its normal, to order 2.
    ///
    /// Ramamoorthi and Hanrahan 2001 (*An efficient representation for irradiance environment maps*): the picture's nine coefficients, each times that of
    /// the clamped cosine, which are π, 2π/3 and π/4 for the orders 0, 1 and 2, here over π. The harmonics are integrated over each texel in closed form, so
    /// that the only error is that of the orders left out: none for a sky and a ground, at most 3/32 of
    /// what faces it for light from one direction, 90° from it.
    pub fn irradiance(&self) -> Irradiance {
        let columns: Vec<Column> = (0..self.width).map(|column| Column::of(azimuths(column, self.width))).collect();
        let mut terms = [DVec3::ZERO; 9];
        for (row, texels) in self.radiance.chunks_exact(self.width).enumerate() {
            let band = Band::of(elevations(row, self.height));
            for (term, part) in terms.iter_mut().zip(band.moments(&Columns::sum(&columns, texels))) {
                *term += part;
            }
        }
        Irradiance(std::array::from_fn(|k| terms[k] * WEIGHTS[k]))
    }

    /// What falls on a surface with this unit normal, with all orders: the counterpart that [`Environment::irradiance`] is measured by.
    ///
    /// Texels are cut up until there are 256 columns and 128 rows at least, and of each the exact integral of the cosine counts where it is positive;
    /// only those that the horizon crosses err, altogether by less than 10⁻⁴ of the brightest. It takes time in proportion to the texels for every normal.
    pub fn irradiance_in_full(&self, normal: DVec3) -> DVec3 {
        let (across, down) = (256_usize.div_ceil(self.width), 128_usize.div_ceil(self.height));
        let (width, height) = (self.width * across, self.height * down);
        let columns: Vec<Column> = (0..width).map(|column| Column::of(azimuths(column, width))).collect();
        let mut sum = DVec3::ZERO;
        for row in 0..height {
            let band = Band::of(elevations(row, height));
            let texels = &self.radiance[row / down * self.width..][..self.width];
            for (column, integrals) in columns.iter().enumerate() {
                let direction = DVec3::new(band.cos * integrals.sin, band.sin * integrals.one, band.cos * integrals.cos);
                sum += colour(texels[column / across]) * normal.dot(direction).max(0.0);
            }
        }
        sum / PI
    }
}

/// Each harmonic's constant squared times the cosine's coefficient over π, in the order of [`Irradiance`].
const WEIGHTS: [f64; 9] = {
    const CONSTANT: f64 = 1.0 / (4.0 * PI);
    const LINEAR: f64 = 2.0 / 3.0 * 3.0 / (4.0 * PI);
    const QUADRATIC: f64 = 0.25 * 15.0 / (4.0 * PI);
    [CONSTANT, LINEAR, LINEAR, LINEAR, QUADRATIC, QUADRATIC, QUADRATIC / 12.0, QUADRATIC, QUADRATIC / 4.0]
};

fn colour(texel: [f32; 3]) -> DVec3 {
    DVec3::from(texel.map(f64::from))
}

/// Where a column of so many begins and ends, the lesser azimuth first.
fn azimuths(column: usize, of: usize) -> [f64; 2] {
    [column + 1, column].map(|edge| PI - TAU * (edge as f64 / of as f64))
}

/// Where a row of so many begins and ends, the lower elevation first.
fn elevations(row: usize, of: usize) -> [f64; 2] {
    [row + 1, row].map(|edge| FRAC_PI_2 - PI * (edge as f64 / of as f64))
}

/// Integrals over a column's azimuths *a*.
struct Column {
    one: f64,
    sin: f64,
    cos: f64,
    sin_cos: f64,
    cos_cos: f64,
}

impl Column {
    fn of([from, to]: [f64; 2]) -> Self {
        let between = |primitive: fn(f64) -> f64| primitive(to) - primitive(from);
        Self {
            one: to - from,
            sin: between(|a| -libm::cos(a)),
            cos: between(libm::sin),
            sin_cos: between(|a| -0.25 * libm::cos(2.0 * a)),
            cos_cos: between(|a| 0.5 * a + 0.25 * libm::sin(2.0 * a)),
        }
    }
}

/// The same of a row's radiance.
#[derive(Default)]
struct Columns {
    one: DVec3,
    sin: DVec3,
    cos: DVec3,
    sin_cos: DVec3,
    cos_cos: DVec3,
}

impl Columns {
    fn sum(columns: &[Column], texels: &[[f32; 3]]) -> Self {
        let mut sum = Self::default();
        for (column, &texel) in columns.iter().zip(texels) {
            let radiance = colour(texel);
            sum.one += radiance * column.one;
            sum.sin += radiance * column.sin;
            sum.cos += radiance * column.cos;
            sum.sin_cos += radiance * column.sin_cos;
            sum.cos_cos += radiance * column.cos_cos;
        }
        sum
    }
}

/// Integrals over a row's elevations *e*, each times cos *e*, as solid angle has it.
struct Band {
    one: f64,
    sin: f64,
    cos: f64,
    sin_sin: f64,
    sin_cos: f64,
    cos_cos: f64,
}

impl Band {
    fn of([from, to]: [f64; 2]) -> Self {
        let between = |primitive: fn(f64, f64) -> f64| {
            let [low, high] = [from, to].map(|e| primitive(libm::sin(e), libm::cos(e)));
            high - low
        };
        let one = between(|s, _| s);
        let sin_sin = between(|s, _| s * s * s / 3.0);
        Self {
            one,
            sin: between(|s, _| 0.5 * s * s),
            cos: 0.5 * (to - from) + between(|s, c| 0.5 * s * c),
            sin_sin,
            sin_cos: between(|_, c| -c * c * c / 3.0),
            cos_cos: one - sin_sin,
        }
    }

    /// The integrals of the nine terms of [`Irradiance`], with x = cos e sin a, y = sin e, z = cos e cos a.
    fn moments(&self, row: &Columns) -> [DVec3; 9] {
        let zz = row.cos_cos * self.cos_cos;
        let (all, yy) = (row.one * self.one, row.one * self.sin_sin);
        [
            all,
            row.one * self.sin,
            row.cos * self.cos,
            row.sin * self.cos,
            row.sin * self.sin_cos,
            row.cos * self.sin_cos,
            3.0 * zz - all,
            row.sin_cos * self.cos_cos,
            all - zz - 2.0 * yy,
        ]
    }
}
