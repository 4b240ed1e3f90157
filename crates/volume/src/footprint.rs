//! One hair's covered fraction over a small window of texels.

use std::f32::consts::FRAC_PI_4;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::LazyLock;

use crate::gauss::{bell, centred_integral, even_bell, integral};

/// A straight run of hair, in texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) from: [f32; 2],
    /// Unit vector along the piece.
    pub(crate) along: [f32; 2],
    pub(crate) length: f32,
    /// Half the strip's mean width.
    pub(crate) radius: f32,
    /// By how much it widens along the piece, in texels a texel.
    pub(crate) taper: f32,
    pub(crate) kind: Kind,
    /// The hair's unit direction, from root to tip.
    pub(crate) toward: [f32; 3],
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

/// Texels evaluated at once.
const LANES: usize = 8;
type Lanes = [f32; LANES];

/// Coverage of one hair, texel by texel, before it is merged into a layer.
///
/// Texel (i, j) is sampled at its centre with a Gaussian of deviation `sigma`, integrated over the strip in closed form: erf across times
/// erf along. The window is unwrapped; whoever merges it wraps.
pub(crate) struct Footprint {
    sigma: f32,
    origin: [i32; 2],
    size: [usize; 2],
    values: Vec<f32>,
    /// Σ value × direction, if directions are asked for; empty else.
    toward: Vec<[f32; 3]>,
    directed: bool,
    scratch: Scratch,
    /// Texel and piece pairs evaluated so far: what the cost is linear in.
    pub(crate) pairs: u64,
}

/// The texels of a piece, as many as fill whole lanes, in its own frame.
#[derive(Default)]
struct Scratch {
    /// Along the piece, from its beginning.
    u: Vec<Lanes>,
    /// Across it.
    v: Vec<Lanes>,
    values: Vec<Lanes>,
}

impl Footprint {
    pub(crate) fn new(sigma: f32) -> Self {
        Self {
            sigma,
            origin: [0, 0],
            size: [0, 0],
            values: Vec::new(),
            toward: Vec::new(),
            directed: false,
            scratch: Scratch::default(),
            pairs: 0,
        }
    }

    /// The same, keeping the hair's mean direction at each texel as well.
    pub(crate) fn directed(self, directed: bool) -> Self {
        Self { directed, ..self }
    }

    /// How far a piece's influence reaches beyond its axis.
    fn margin(&self, radius: f32) -> f32 {
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
        self.toward.clear();
        if self.directed {
            self.toward.resize(self.values.len(), [0.0; 3]);
        }
    }

    fn bounds(&self, piece: &Piece) -> ([f32; 2], [f32; 2]) {
        let margin = self.margin(piece.radius + 0.5 * (piece.taper * piece.length).abs())
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
        // Thinner hair has the same profile under the filter, and its mass makes it thin: a difference of nearly equal integrals would be all rounding.
        let piece =
            &if piece.radius < THINNEST * self.sigma { Piece { radius: THINNEST * self.sigma, taper: 0.0, ..*piece } } else { *piece };
        let (low, high) = self.bounds(piece);
        let range = |axis: usize| {
            let first = ((low[axis] - 0.5).ceil() as i32 - self.origin[axis]).max(0) as usize;
            let last = ((high[axis] - 0.5).floor() as i32 - self.origin[axis] + 1).max(0) as usize;
            first..last.min(self.size[axis])
        };
        let (columns, rows) = (range(0), range(1));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        self.pairs += (columns.len() * rows.len()) as u64;
        self.scratch.place(piece, self.origin, &columns, &rows);
        match piece.kind {
            Kind::Strip { height, rise, beside } => {
                let along = Along::new(height, rise, self.sigma);
                // Not shifted, no chord; not faded, no bell.
                match (beside == 0.0, height == 0.0 && rise == 0.0) {
                    (true, true) => self.scratch.strip::<false, false>(piece, self.sigma, &along, beside),
                    (true, false) => self.scratch.strip::<false, true>(piece, self.sigma, &along, beside),
                    (false, true) => self.scratch.strip::<true, false>(piece, self.sigma, &along, beside),
                    (false, false) => self.scratch.strip::<true, true>(piece, self.sigma, &along, beside),
                }
            }
            Kind::Section { weight, alone } => self.scratch.section(piece, self.sigma, weight, alone),
        }
        let lines = self.scratch.values.as_flattened().chunks_exact(columns.len());
        for (row, line) in rows.zip(lines) {
            let sums = &mut self.values[row * self.size[0]..][columns.clone()];
            sums.iter_mut().zip(line).for_each(|(sum, value)| *sum += value);
            if self.directed {
                let sums = &mut self.toward[row * self.size[0]..][columns.clone()];
                sums.iter_mut().zip(line).for_each(|(sum, value)| *sum = [0, 1, 2].map(|axis| sum[axis] + value * piece.toward[axis]));
            }
        }
    }

    /// Scales the window so that it sums to `mass` (texel areas), then hands each covered texel to `merge` as (x, y, coverage up to 1, mean direction).
    /// The direction is 0 unless it was asked for.
    ///
    /// The sum over texel centres of a Gaussian narrower than half a texel depends on where the hair stands; its mass may not.
    pub(crate) fn close(&mut self, mass: f32, mut merge: impl FnMut(i32, i32, f32, [f32; 3])) {
        let Some(scale) = self.scale_to(mass) else { return };
        for (row, line) in self.values.chunks_exact(self.size[0].max(1)).enumerate() {
            for (column, &value) in line.iter().enumerate() {
                if value > LEAST {
                    let toward = self.toward.get(row * self.size[0] + column).map_or([0.0; 3], |sum| sum.map(|d| d / value));
                    merge(self.origin[0] + column as i32, self.origin[1] + row as i32, (value * scale).min(1.0), toward);
                }
            }
        }
    }

    /// The factor at which the window, cut off at full cover, sums to `mass`; `None` for an empty one.
    fn scale_to(&self, mass: f32) -> Option<f32> {
        let mut scale = 1.0f32;
        // Each round gives what full texels cannot take to the others; it settles at once unless the hair is wider than a texel.
        for _ in 0..8 {
            let (mut full, mut rest) = (0.0f32, 0.0f32);
            for &value in &self.values {
                let is_full = value * scale >= 1.0;
                full += if is_full { 1.0 } else { 0.0 };
                rest += if is_full { 0.0 } else { value };
            }
            if !(rest > 0.0 && mass > full) {
                break;
            }
            let next = (mass - full) / rest;
            if (next - scale).abs() < 1e-4 * scale {
                return Some(next);
            }
            scale = next;
        }
        (mass > 0.0 && !self.values.is_empty()).then_some(scale)
    }
}

/// Hair is evaluated at this radius at least, in deviations of the filter.
const THINNEST: f32 = 0.25;
/// Less than this is nothing: what the polynomials leave far outside a hair, and a hundredth of a byte's step.
const LEAST: f32 = 4e-5;

impl Scratch {
    /// Fills in where the texels of a rectangle lie, row by row.
    fn place(&mut self, piece: &Piece, origin: [i32; 2], columns: &Range<usize>, rows: &Range<usize>) {
        let lanes = (columns.len() * rows.len()).div_ceil(LANES);
        for values in [&mut self.u, &mut self.v, &mut self.values] {
            values.resize(lanes, [0.0; LANES]);
        }
        let (us, vs) = (self.u.as_flattened_mut(), self.v.as_flattened_mut());
        let first = (origin[0] + columns.start as i32) as f32 + 0.5 - piece.from[0];
        let mut number = 0;
        for row in rows.clone() {
            let y = (origin[1] + row as i32) as f32 + 0.5 - piece.from[1];
            let (u, v) = (y * piece.along[1], y * piece.along[0]);
            for column in 0..columns.len() {
                let x = first + column as f32;
                us[number] = x * piece.along[0] + u;
                vs[number] = v - x * piece.along[1];
                number += 1;
            }
        }
    }

    /// The filter's integral across times that along.
    fn strip<const MOVED: bool, const FADED: bool>(&mut self, piece: &Piece, sigma: f32, along: &Along, beside: f32) {
        let inverse = 1.0 / sigma;
        let chord = HalfChord::new(piece.radius, sigma);
        let length = piece.length;
        let growth = piece.taper * length;
        let (first, taper) = (piece.radius - 0.5 * growth, piece.taper);
        let (thin, thick) = (piece.radius - 0.5 * growth.abs(), piece.radius + 0.5 * growth.abs());
        let places = self.u.as_flattened().iter().zip(self.v.as_flattened());
        for ((&u, &v), value) in places.zip(self.values.as_flattened_mut()) {
            let u = if MOVED { u - beside * chord.at(v) } else { u };
            let radius = (first + taper * u).max(thin).min(thick);
            let across = centred_integral((v + radius) * inverse) - centred_integral((v - radius) * inverse);
            let part = across * along.between::<FADED>(u, length);
            *value = if FADED { part * along.weight(u) } else { part };
        }
    }

    /// A disc under the Gaussian. On its own it goes by distance: the edge is taken for straight, the radius for that which keeps the area. Where slanted
    /// hair runs on beside it, it is a strip as long as the chord.
    fn section(&mut self, piece: &Piece, sigma: f32, weight: f32, alone: f32) {
        let inverse = 1.0 / sigma;
        let radius = seen_radius(piece.radius, sigma);
        let chord = HalfChord::new(piece.radius, sigma);
        let places = self.u.as_flattened().iter().zip(self.v.as_flattened());
        for ((&u, &v), value) in places.zip(self.values.as_flattened_mut()) {
            let distance = (u * u + v * v).sqrt();
            let disc = centred_integral((radius - distance) * inverse) - centred_integral((-radius - distance) * inverse);
            let across = centred_integral((v + piece.radius) * inverse) - centred_integral((v - piece.radius) * inverse);
            let half = chord.at(v);
            let strip = across * (centred_integral((u + half) * inverse) - centred_integral((u - half) * inverse));
            *value = weight * (strip + (disc - strip) * alone);
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

    /// The part of the filter that lies along the hair.
    #[inline(always)]
    fn between<const FADED: bool>(&self, u: f32, length: f32) -> f32 {
        let middle = if FADED { self.near * u - self.offset } else { u };
        centred_integral((length - middle) * self.sharpness) - centred_integral(-middle * self.sharpness)
    }

    /// The mean weight of that part.
    #[inline(always)]
    fn weight(&self, u: f32) -> f32 {
        self.narrowing * even_bell((self.height + self.rise * u) * self.narrowing)
    }
}

/// Half the chord of a round section some way off its middle; its mean, πr/4, where the filter is too wide to see the circle.
#[derive(Clone, Copy)]
struct HalfChord {
    squared: f32,
    mean: f32,
    seen: f32,
    /// The square of what rounds off the ends.
    soft: f32,
}

/// How far the filter rounds off the ends of the chord, in radius × σ: measured to err least against many samples.
const CHORD_SOFTNESS: f32 = 1.6;

impl HalfChord {
    fn new(radius: f32, sigma: f32) -> Self {
        let squared = radius * radius;
        let soft = CHORD_SOFTNESS * radius * sigma;
        Self { squared, mean: radius * FRAC_PI_4, seen: squared / (squared + sigma * sigma), soft: soft * soft }
    }

    #[inline(always)]
    fn at(self, v: f32) -> f32 {
        let squared = self.squared - v * v;
        let chord = (0.5 * (squared + (squared * squared + self.soft).sqrt())).max(0.0).sqrt();
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
