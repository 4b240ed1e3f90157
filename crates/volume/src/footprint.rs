//! One hair's covered fraction over a small window of texels.

use std::f32::consts::FRAC_PI_4;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::LazyLock;

use crate::gauss::{Tables, bell, integral};

/// A straight run of hair, in texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) from: [f32; 2],
    /// Unit vector along the piece.
    pub(crate) along: [f32; 2],
    pub(crate) length: f32,
    /// Half the strip's width.
    pub(crate) radius: f32,
    pub(crate) kind: Kind,
}

/// What a piece stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// A strip that covers exp(−h²/2) of itself, where h = `height` + `rise` × way along. It begins where the hair's round section ends: moved along by
    /// `beside` (−1, 0 or 1) times half the section's chord.
    Strip { height: f32, rise: f32, beside: f32 },
    /// The round section itself, at `from`, covering `weight` of itself: `alone` of it as a disc, the rest as a strip that runs on without a seam into
    /// those beside it.
    Section { weight: f32, alone: f32 },
}

/// Coverage of one hair, texel by texel, before it is merged into a layer.
///
/// Texel (i, j) is sampled at its centre with a Gaussian of deviation `sigma`, integrated over the strip in closed form: erf across times
/// erf along. The window is unwrapped; whoever merges it wraps.
pub(crate) struct Footprint {
    tables: Tables,
    sigma: f32,
    origin: [i32; 2],
    size: [usize; 2],
    values: Vec<f32>,
    /// Texel and piece pairs evaluated so far: what the cost is linear in.
    pub(crate) pairs: u64,
}

impl Footprint {
    pub(crate) fn new(sigma: f32) -> Self {
        Self { tables: Tables::new(), sigma, origin: [0, 0], size: [0, 0], values: Vec::new(), pairs: 0 }
    }

    /// How far a piece's influence reaches beyond its axis.
    pub(crate) fn margin(&self, radius: f32) -> f32 {
        // Beyond 2.75 σ lies 0.3 % of an edge, which the mass correction puts back.
        radius + 2.75 * self.sigma
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
        let margin = self.margin(piece.radius)
            + match piece.kind {
                Kind::Strip { beside, .. } => piece.radius * beside.abs(),
                Kind::Section { .. } => 0.0,
            };
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
            Kind::Strip { height, rise, beside } => self.add_strip(piece, columns, rows, &Along::new(height, rise, self.sigma), beside),
            Kind::Section { weight, alone } => self.add_section(piece, columns, rows, weight, alone),
        }
    }

    /// The filter's integral across times that along.
    fn add_strip(&mut self, piece: &Piece, columns: Range<usize>, rows: Range<usize>, along: &Along, beside: f32) {
        let inverse = 1.0 / self.sigma;
        let tables = self.tables;
        let chord = HalfChord::new(piece.radius, self.sigma);
        for row in rows {
            let y = (self.origin[1] + row as i32) as f32 + 0.5 - piece.from[1];
            let line = &mut self.values[row * self.size[0]..][columns.clone()];
            for (column, value) in columns.clone().zip(line) {
                let x = (self.origin[0] + column as i32) as f32 + 0.5 - piece.from[0];
                let v = y * piece.along[0] - x * piece.along[1];
                let across = tables.integral((v + piece.radius) * inverse) - tables.integral((v - piece.radius) * inverse);
                // A step of 16 bits: nothing that a byte could show.
                if across < 1.5e-5 {
                    continue;
                }
                let shift = if beside == 0.0 { 0.0 } else { beside * chord.at(v) };
                let u = x * piece.along[0] + y * piece.along[1] - shift;
                *value += across * along.at(tables, u, piece.length);
            }
        }
    }

    /// A disc under the Gaussian. On its own it goes by distance: the edge is taken for straight, the radius for that which keeps the area. Where slanted
    /// hair runs on beside it, it is a strip as long as the chord.
    fn add_section(&mut self, piece: &Piece, columns: Range<usize>, rows: Range<usize>, weight: f32, alone: f32) {
        let inverse = 1.0 / self.sigma;
        let tables = self.tables;
        let radius = seen_radius(piece.radius, self.sigma);
        let chord = HalfChord::new(piece.radius, self.sigma);
        for row in rows {
            let y = (self.origin[1] + row as i32) as f32 + 0.5 - piece.from[1];
            let line = &mut self.values[row * self.size[0]..][columns.clone()];
            for (column, value) in columns.clone().zip(line) {
                let x = (self.origin[0] + column as i32) as f32 + 0.5 - piece.from[0];
                let distance = (x * x + y * y).sqrt();
                let disc = tables.integral((radius - distance) * inverse) - tables.integral((-radius - distance) * inverse);
                let v = y * piece.along[0] - x * piece.along[1];
                let u = x * piece.along[0] + y * piece.along[1];
                let across = tables.integral((v + piece.radius) * inverse) - tables.integral((v - piece.radius) * inverse);
                let half = chord.at(v);
                let strip = across * (tables.integral((u + half) * inverse) - tables.integral((u - half) * inverse));
                *value += weight * (strip + (disc - strip) * alone);
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

/// ∫ exp(−(h + g t)²/2) G_σ(u − t) dt from 0 to a length: the tall Gaussian along a straight hair under the lateral one, in closed form.
///
/// The product of the two is a Gaussian in t of deviation q, 1/q² = g² + 1/σ², about m = q²(u/σ² − g h), of height bell((h + g u)/√(1 + g²σ²)) q/σ.
struct Along {
    height: f32,
    rise: f32,
    /// 1/√(1 + g²σ²) = q/σ.
    narrowing: f32,
    /// 1/q.
    sharpness: f32,
    /// m = near·u − offset.
    near: f32,
    offset: f32,
}

impl Along {
    fn new(height: f32, rise: f32, sigma: f32) -> Self {
        let narrowing = 1.0 / (1.0 + rise * rise * sigma * sigma).sqrt();
        let near = narrowing * narrowing;
        Self { height, rise, narrowing, sharpness: 1.0 / (narrowing * sigma), near, offset: near * sigma * sigma * rise * height }
    }

    #[inline]
    fn at(&self, tables: Tables, u: f32, length: f32) -> f32 {
        let middle = self.near * u - self.offset;
        let between = tables.integral((length - middle) * self.sharpness) - tables.integral(-middle * self.sharpness);
        between * self.narrowing * tables.bell((self.height + self.rise * u) * self.narrowing)
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
