//! One hair's covered fraction over a small window of texels.

use crate::gauss::{IntegralTable, REACH};

/// A straight run of hair in texels: a strip that covers `weight` of its area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) from: [f32; 2],
    /// Unit vector along the piece.
    pub(crate) along: [f32; 2],
    pub(crate) length: f32,
    /// Half the strip's width.
    pub(crate) radius: f32,
    /// 0 to 1.
    pub(crate) weight: f32,
    /// How the ends move outwards with the hair's round cross section: −1, 0 or 1 times its half chord.
    pub(crate) start_shift: f32,
    pub(crate) end_shift: f32,
}

/// Coverage of one hair, texel by texel, before it is merged into a layer.
///
/// Texel (i, j) is sampled at its centre with a Gaussian of deviation `sigma`, integrated over the strip in closed form: erf across times
/// erf along. The window is unwrapped; whoever merges it wraps.
pub(crate) struct Footprint {
    table: IntegralTable,
    sigma: f32,
    origin: [i32; 2],
    size: [usize; 2],
    values: Vec<f32>,
    /// Texel and piece pairs evaluated so far: what the cost is linear in.
    pub(crate) pairs: u64,
}

impl Footprint {
    pub(crate) fn new(sigma: f32) -> Self {
        Self { table: IntegralTable::new(), sigma, origin: [0, 0], size: [0, 0], values: Vec::new(), pairs: 0 }
    }

    /// How far a piece's influence reaches beyond its axis.
    pub(crate) fn margin(&self, radius: f32) -> f32 {
        // Beyond 3 σ lie 0.3 % of a strip's edge, which the mass correction puts back.
        radius + 3.0f32.min(REACH) * self.sigma
    }

    /// Opens an empty window over the box that encloses all pieces, margins included.
    pub(crate) fn open(&mut self, pieces: &[Piece]) {
        let mut low = [f32::INFINITY; 2];
        let mut high = [f32::NEG_INFINITY; 2];
        for piece in pieces {
            let (a, b) = self.bounds(piece);
            for axis in 0..2 {
                low[axis] = low[axis].min(a[axis]);
                high[axis] = high[axis].max(b[axis]);
            }
        }
        for axis in 0..2 {
            let first = (low[axis] - 0.5).ceil() as i32;
            let last = (high[axis] - 0.5).floor() as i32;
            self.origin[axis] = first;
            self.size[axis] = (i64::from(last) - i64::from(first) + 1).max(0) as usize;
        }
        self.values.clear();
        self.values.resize(self.size[0] * self.size[1], 0.0);
    }

    fn bounds(&self, piece: &Piece) -> ([f32; 2], [f32; 2]) {
        let margin = self.margin(piece.radius) + if piece.start_shift != 0.0 || piece.end_shift != 0.0 { piece.radius } else { 0.0 };
        let to = [piece.from[0] + piece.along[0] * piece.length, piece.from[1] + piece.along[1] * piece.length];
        let low = [0, 1].map(|axis| piece.from[axis].min(to[axis]) - margin);
        let high = [0, 1].map(|axis| piece.from[axis].max(to[axis]) + margin);
        (low, high)
    }

    /// Adds a piece to the open window.
    pub(crate) fn add(&mut self, piece: &Piece) {
        let (low, high) = self.bounds(piece);
        let range = |axis: usize| {
            let first = ((low[axis] - 0.5).ceil() as i32 - self.origin[axis]).max(0) as usize;
            let last = ((high[axis] - 0.5).floor() as i32 - self.origin[axis] + 1).max(0) as usize;
            first..last.min(self.size[axis])
        };
        let (columns, rows) = (range(0), range(1));
        if columns.is_empty() {
            return;
        }
        self.pairs += (columns.len() * rows.len()) as u64;
        let inverse = 1.0 / self.sigma;
        let table = self.table;
        let shifts = piece.start_shift != 0.0 || piece.end_shift != 0.0;
        for row in rows {
            let y = (self.origin[1] + row as i32) as f32 + 0.5 - piece.from[1];
            let line = &mut self.values[row * self.size[0]..][columns.clone()];
            for (column, value) in columns.clone().zip(line) {
                let x = (self.origin[0] + column as i32) as f32 + 0.5 - piece.from[0];
                let u = x * piece.along[0] + y * piece.along[1];
                let v = y * piece.along[0] - x * piece.along[1];
                let across = table.at((v + piece.radius) * inverse) - table.at((v - piece.radius) * inverse);
                let chord = if shifts { half_chord(v, piece.radius, self.sigma) } else { 0.0 };
                let begin = u - piece.start_shift * chord;
                let end = u - piece.length - piece.end_shift * chord;
                *value += piece.weight * across * (table.at(begin * inverse) - table.at(end * inverse));
            }
        }
    }

    /// Scales the window so that it sums to `mass` (texel areas), then hands each covered texel to `merge` as (x, y, coverage up to 1).
    ///
    /// The sum over texel centres of a Gaussian narrower than half a texel depends on where the hair stands; its mass may not.
    pub(crate) fn close(&mut self, mass: f32, mut merge: impl FnMut(i32, i32, f32)) {
        let sum: f64 = self.values.iter().map(|&v| f64::from(v)).sum();
        if !(sum > 0.0 && mass > 0.0) {
            return;
        }
        let scale = (f64::from(mass) / sum) as f32;
        for (row, line) in self.values.chunks_exact(self.size[0].max(1)).enumerate() {
            for (column, &value) in line.iter().enumerate() {
                if value > 0.0 {
                    merge(self.origin[0] + column as i32, self.origin[1] + row as i32, (value * scale).min(1.0));
                }
            }
        }
    }
}

/// Half the chord of the round cross section `v` off its middle; its mean πr/4 where the filter does not see the circle.
#[inline]
fn half_chord(v: f32, radius: f32, sigma: f32) -> f32 {
    let mean = radius * std::f32::consts::FRAC_PI_4;
    let seen = radius * radius / (radius * radius + sigma * sigma);
    let chord = (radius * radius - v * v).max(0.0).sqrt();
    mean + (chord - mean) * seen
}
