//! Hair lighting looked up instead of computed (L13).

use crate::HairLighting;
use crate::hair::within;

/// Which quantity runs evenly along an axis of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The cosine, from −1 to 1: cheap, and fine where the function is even about 0 and flat at ±1.
    Cosine,
    /// The angle, from π to 0: needed where the slope at ±1 is infinite, as that of the diffuse term with *Pd* near 1.
    Angle,
}

impl Axis {
    /// Where a cosine lies along the axis, from 0 to 1; what is no number counts as 1.
    pub fn position(self, cosine: f64) -> f64 {
        let cosine = within(cosine, -1.0, 1.0, 1.0);
        match self {
            Self::Cosine => 0.5 + 0.5 * cosine,
            Self::Angle => 1.0 - libm::acos(cosine) / std::f64::consts::PI,
        }
    }

    /// The cosine at a position from 0 to 1.
    pub fn cosine(self, position: f64) -> f64 {
        match self {
            Self::Cosine => 2.0 * position - 1.0,
            Self::Angle => libm::cos((1.0 - position) * std::f64::consts::PI),
        }
    }
}

/// Size and axes of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TableLayout {
    /// Texels along each side, 2 to 4096.
    pub size: usize,
    /// How u = T·L runs.
    pub u: Axis,
    /// How v = T·H runs.
    pub v: Axis,
}

impl Default for TableLayout {
    /// 64², u by angle and v by cosine: errs by less than 0.01 up to *Ps* = 64.
    fn default() -> Self {
        Self { size: 64, u: Axis::Angle, v: Axis::Cosine }
    }
}

impl TableLayout {
    /// The paper's: 32², both axes by cosine (Lengyel et al. 2001, section 2.4).
    pub const PAPER: Self = Self { size: 32, u: Axis::Cosine, v: Axis::Cosine };
}

/// Why there is no table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// Too small or too large a side.
    #[error("a lighting table of {size}² texels is not possible; ask for a side from 2 to 4096")]
    Size {
        /// The side that was asked for.
        size: usize,
    },
}

/// How far a table is from the formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The largest error, looked for at 64 places between any two texels.
    pub largest: f64,
    /// The root of the mean square over cosines evenly spread from −1 to 1, which are directions evenly spread.
    pub rms: f64,
}

/// The error of each factor of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorError {
    /// Of (1 − u²)^(Pd/2).
    pub diffuse: Deviation,
    /// Of (1 − v²)^(Ps/2).
    pub specular: Deviation,
}

/// The two factors of hair lighting over u and v, to be looked up bilinearly.
///
/// Two channels and not the paper's finished colour, so that self-shadow and facing act on the lit part alone, and one table serves every
/// colour. The first and last texel lie exactly at ±1. Since each factor depends on one axis only, the table is their product and is
/// kept as two rows; [`LightingTable::texels`] spreads it out for a graphics processor, which then needs one fetch for both.
#[derive(Clone, Debug, PartialEq)]
pub struct LightingTable {
    layout: TableLayout,
    diffuse: Vec<f32>,
    specular: Vec<f32>,
}

impl LightingTable {
    /// The table of a lighting's two powers; its colours do not matter here.
    ///
    /// # Errors
    /// A side under 2 or above 4096.
    pub fn new(lighting: &HairLighting, layout: TableLayout) -> Result<Self, TableError> {
        if !(2..=4096).contains(&layout.size) {
            return Err(TableError::Size { size: layout.size });
        }
        let row = |axis: Axis, factor: &dyn Fn(f64) -> f64| -> Vec<f32> {
            (0..layout.size).map(|i| factor(axis.cosine(i as f64 / (layout.size - 1) as f64)) as f32).collect()
        };
        Ok(Self {
            layout,
            diffuse: row(layout.u, &|u| lighting.diffuse_factor(u)),
            specular: row(layout.v, &|v| lighting.specular_factor(v)),
        })
    }

    /// Its size and axes.
    pub fn layout(&self) -> TableLayout {
        self.layout
    }

    /// The diffuse and the specular factor at u and v, bilinear.
    pub fn look_up(&self, u: f64, v: f64) -> (f64, f64) {
        (linear(&self.diffuse, self.layout.u.position(u)), linear(&self.specular, self.layout.v.position(v)))
    }

    /// `size`² texels of diffuse and specular factor, u along a row and v from row to row.
    pub fn texels(&self) -> Vec<[f32; 2]> {
        self.specular.iter().flat_map(|&specular| self.diffuse.iter().map(move |&diffuse| [diffuse, specular])).collect()
    }

    /// The error of each factor against the exact `lighting`.
    pub fn factor_error(&self, lighting: &HairLighting) -> FactorError {
        let [diffuse, specular] =
            self.spreads(lighting).map(|spread| Deviation { largest: spread.most.max(-spread.least), rms: spread.square.sqrt() });
        FactorError { diffuse, specular }
    }

    /// The error of the finished light Ka + Kd · diffuse + Ks · specular: the largest in any colour channel over all u and v, and the root of the mean square
    /// of all channels.
    pub fn colour_error(&self, lighting: &HairLighting) -> Deviation {
        let [diffuse, specular] = self.spreads(lighting);
        // u and v are free of each other, so that the extremes of both meet and their means multiply.
        let channel = |kd: f64, ks: f64| {
            let (up, down) = (diffuse.reach(kd)[1] + specular.reach(ks)[1], diffuse.reach(kd)[0] + specular.reach(ks)[0]);
            let square = kd * kd * diffuse.square + 2.0 * kd * ks * diffuse.mean * specular.mean + ks * ks * specular.square;
            (up.max(-down), square)
        };
        let channels = [0, 1, 2].map(|c| channel(lighting.diffuse[c], lighting.specular[c]));
        Deviation {
            largest: channels.iter().fold(0.0, |most, (largest, _)| most.max(*largest)),
            rms: (channels.iter().map(|(_, square)| square).sum::<f64>() / 3.0).sqrt(),
        }
    }

    /// How the errors of the diffuse and of the specular factor spread.
    fn spreads(&self, lighting: &HairLighting) -> [Spread; 2] {
        [
            Spread::of(self.layout.u, &self.diffuse, &|u| lighting.diffuse_factor(u)),
            Spread::of(self.layout.v, &self.specular, &|v| lighting.specular_factor(v)),
        ]
    }
}

/// The value at a position from 0 to 1 of a row, linear between texels.
fn linear(row: &[f32], position: f64) -> f64 {
    let at = position.clamp(0.0, 1.0) * (row.len() - 1) as f64;
    let low = (at as usize).min(row.len() - 2);
    let (a, b) = (f64::from(row[low]), f64::from(row[low + 1]));
    a + (b - a) * (at - low as f64)
}

/// Table less truth along one axis.
struct Spread {
    least: f64,
    most: f64,
    mean: f64,
    square: f64,
}

impl Spread {
    fn of(axis: Axis, row: &[f32], exact: &dyn Fn(f64) -> f64) -> Self {
        const BETWEEN: usize = 64;
        let steps = BETWEEN * (row.len() - 1);
        let [least, most] = (0..=steps).map(|i| i as f64 / steps as f64).fold([0.0, 0.0], |[least, most], position| {
            let error = linear(row, position) - exact(axis.cosine(position));
            [f64::min(least, error), f64::max(most, error)]
        });
        let even = (0..steps)
            .map(|i| (2.0 * i as f64 + 1.0) / steps as f64 - 1.0)
            .map(|cosine| linear(row, axis.position(cosine)) - exact(cosine));
        let [mean, square] =
            even.fold([0.0, 0.0], |[mean, square], error| [mean + error, square + error * error]).map(|sum| sum / steps as f64);
        Self { least, most, mean, square }
    }

    /// The least and the most that a multiple of the error is.
    fn reach(&self, factor: f64) -> [f64; 2] {
        let ends = [factor * self.least, factor * self.most];
        [ends[0].min(ends[1]), ends[0].max(ends[1])]
    }
}
