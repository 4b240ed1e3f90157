//! One hair's covered fraction over a small window of texels.

use std::f32::consts::FRAC_PI_4;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::LazyLock;

use crate::gauss::{IntegralTable, bell, integral};

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
    pub(crate) kind: Kind,
}

/// What a piece stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// A strip with straight ends.
    Strip,
    /// A strip that begins where the hair's round section ends: moved along by this sign times half its chord.
    Beside(f32),
    /// The round section itself, at `from`: this much of it as a disc on its own, the rest as a strip that runs on without a seam into those beside it.
    Section(f32),
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
        radius + 3.0 * self.sigma
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
        let margin = self.margin(piece.radius) + if matches!(piece.kind, Kind::Beside(_)) { piece.radius } else { 0.0 };
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
        match piece.kind {
            Kind::Strip => self.add_strip(piece, columns, rows, |_| 0.0),
            Kind::Beside(sign) => {
                let chord = HalfChord::new(piece.radius, self.sigma);
                self.add_strip(piece, columns, rows, |v| sign * chord.at(v));
            }
            Kind::Section(alone) => self.add_section(piece, columns, rows, alone),
        }
    }

    /// erf across times erf along; `shift` moves the strip along by what the place across asks for.
    fn add_strip(&mut self, piece: &Piece, columns: Range<usize>, rows: Range<usize>, shift: impl Fn(f32) -> f32) {
        let inverse = 1.0 / self.sigma;
        let table = self.table;
        for row in rows {
            let y = (self.origin[1] + row as i32) as f32 + 0.5 - piece.from[1];
            let line = &mut self.values[row * self.size[0]..][columns.clone()];
            for (column, value) in columns.clone().zip(line) {
                let x = (self.origin[0] + column as i32) as f32 + 0.5 - piece.from[0];
                let v = y * piece.along[0] - x * piece.along[1];
                let u = x * piece.along[0] + y * piece.along[1] - shift(v);
                let across = table.at((v + piece.radius) * inverse) - table.at((v - piece.radius) * inverse);
                *value += piece.weight * across * (table.at(u * inverse) - table.at((u - piece.length) * inverse));
            }
        }
    }

    /// A disc under the Gaussian. On its own it goes by distance: the edge is taken for straight, the radius for that which keeps the area. Where slanted
    /// hair runs on beside it, it is a strip as long as the chord.
    fn add_section(&mut self, piece: &Piece, columns: Range<usize>, rows: Range<usize>, alone: f32) {
        let inverse = 1.0 / self.sigma;
        let table = self.table;
        let radius = seen_radius(piece.radius, self.sigma);
        let chord = HalfChord::new(piece.radius, self.sigma);
        for row in rows {
            let y = (self.origin[1] + row as i32) as f32 + 0.5 - piece.from[1];
            let line = &mut self.values[row * self.size[0]..][columns.clone()];
            for (column, value) in columns.clone().zip(line) {
                let x = (self.origin[0] + column as i32) as f32 + 0.5 - piece.from[0];
                let distance = (x * x + y * y).sqrt();
                let disc = table.at((radius - distance) * inverse) - table.at((-radius - distance) * inverse);
                let v = y * piece.along[0] - x * piece.along[1];
                let u = x * piece.along[0] + y * piece.along[1];
                let across = table.at((v + piece.radius) * inverse) - table.at((v - piece.radius) * inverse);
                let half = chord.at(v);
                let strip = across * (table.at((u + half) * inverse) - table.at((u - half) * inverse));
                *value += piece.weight * (strip + (disc - strip) * alone);
            }
        }
    }

    /// Scales the window so that it sums to `mass` (texel areas), then hands each covered texel to `merge` as (x, y, coverage up to 1).
    ///
    /// The sum over texel centres of a Gaussian narrower than half a texel depends on where the hair stands; its mass may not.
    pub(crate) fn close(&mut self, mass: f32, mut merge: impl FnMut(i32, i32, f32)) {
        let Some(scale) = self.scale_to(mass) else { return };
        for (row, line) in self.values.chunks_exact(self.size[0].max(1)).enumerate() {
            for (column, &value) in line.iter().enumerate() {
                if value > 0.0 {
                    merge(self.origin[0] + column as i32, self.origin[1] + row as i32, (value * scale).min(1.0));
                }
            }
        }
    }
}

impl Footprint {
    /// The factor at which the window, cut off at full cover, sums to `mass`; `None` for an empty one.
    fn scale_to(&self, mass: f32) -> Option<f32> {
        let mut scale = 1.0f32;
        // Each round gives what full texels cannot take to the others; it settles at once unless the hair is wider than a texel.
        for _ in 0..4 {
            let (mut full, mut rest) = (0.0f64, 0.0f64);
            for &value in &self.values {
                if value * scale >= 1.0 { full += 1.0 } else { rest += f64::from(value) }
            }
            if !(rest > 0.0 && f64::from(mass) > full) {
                break;
            }
            let next = ((f64::from(mass) - full) / rest) as f32;
            if (next - scale).abs() < 1e-4 * scale {
                return Some(next);
            }
            scale = next;
        }
        (mass > 0.0 && !self.values.is_empty()).then_some(scale)
    }
}

/// Half the chord of a round section some way off its middle; its mean, πr/4, where the filter is too wide to see the circle.
#[derive(Clone, Copy)]
struct HalfChord {
    radius: f32,
    mean: f32,
    seen: f32,
    soft: f32,
}

/// How far the filter rounds off the ends of the chord, in radius × σ: measured to err least against many samples.
const CHORD_SOFTNESS: f32 = 1.6;

impl HalfChord {
    fn new(radius: f32, sigma: f32) -> Self {
        let squared = radius * radius;
        Self { radius, mean: radius * FRAC_PI_4, seen: squared / (squared + sigma * sigma), soft: CHORD_SOFTNESS * radius * sigma }
    }

    #[inline]
    fn at(self, v: f32) -> f32 {
        let squared = self.radius * self.radius - v * v;
        let chord = (0.5 * (squared + (squared * squared + self.soft * self.soft).sqrt())).max(0.0).sqrt();
        self.mean + (chord - self.mean) * self.seen
    }
}

/// The radius whose straight-edged profile Φ((r − ρ)/σ) − Φ((−r − ρ)/σ) has the area of a disc of `radius`.
fn seen_radius(radius: f32, sigma: f32) -> f32 {
    let wanted = radius / sigma;
    if wanted >= SEEN_REACH {
        // The profile's area tends to π(r² + σ²).
        return (radius * radius - sigma * sigma).max(0.0).sqrt();
    }
    let place = wanted * (SEEN_ENTRIES as f32 / SEEN_REACH);
    let index = (place as usize).min(SEEN_ENTRIES - 1);
    let (low, high) = (SEEN[index], SEEN[index + 1]);
    sigma * (low + (high - low) * (place - index as f32))
}

const SEEN_ENTRIES: usize = 256;
const SEEN_REACH: f32 = 8.0;

/// [`seen_radius`] for σ = 1, by bisection on the area π(r² + 1)(2Φ(r) − 1) + 2πr φ(r), which grows with r.
static SEEN: LazyLock<[f32; SEEN_ENTRIES + 1]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let wanted = i as f64 * f64::from(SEEN_REACH) / SEEN_ENTRIES as f64;
        let (mut low, mut high) = (0.0, wanted);
        for _ in 0..60 {
            let r = 0.5 * (low + high);
            let area = (r * r + 1.0) * (2.0 * integral(r) - 1.0) + 2.0 * r * bell(r) / TAU.sqrt();
            if area < wanted * wanted { low = r } else { high = r }
        }
        low as f32
    })
});
