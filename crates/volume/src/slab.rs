//! What part of a strand one layer holds.

use pelage_strand::Strand;
use std::f64::consts::{PI, TAU};

use crate::footprint::{Kind, Piece};
use crate::gauss::{bell, integral};

/// Beyond this many vertical σ a layer does not feel the hair: exp(−4.5) is 1 % of an 8-bit step short of nothing at mean weight.
const WINDOW: f64 = 3.0;

/// A layer's place and scale: where its tall Gaussian stands and how large a texel is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    /// Height of the layer, tile sides.
    pub(crate) height: f64,
    /// Vertical deviation, tile sides.
    pub(crate) sigma: f64,
    /// Texels along a tile side.
    pub(crate) resolution: f64,
    /// Lateral deviation of the filter in texels: sets how finely slanted hair is cut.
    pub(crate) lateral: f64,
}

/// A strand cut to one slab: strips in texels, their exact area, and where along the hair the layer stands.
#[derive(Default)]
pub(crate) struct Cut {
    pub(crate) pieces: Vec<Piece>,
    /// Texel areas: what the pieces cover together.
    pub(crate) mass: f64,
    /// 0 at the root, 1 at the tip.
    pub(crate) along: f32,
}

/// The way along a strand from one point to the next, in texels, heights in vertical σ from the layer.
#[derive(Clone, Copy)]
struct Run {
    from: [f64; 2],
    step: [f64; 2],
    heights: [f64; 2],
    radii: [f64; 2],
    along: [f64; 2],
}

impl Slab {
    /// The heights that reach into the slab.
    pub(crate) fn reach(&self) -> (f32, f32) {
        ((self.height - WINDOW * self.sigma) as f32, (self.height + WINDOW * self.sigma) as f32)
    }

    /// Cuts a strand: `cut` is emptied and filled.
    ///
    /// A point of the layer is covered when the hair stands over it anywhere within a height d of the layer, where d is random and exceeds x with
    /// probability exp(−x²/2σ²): the tall Gaussian. A hair's round section at the layer itself thus covers fully, and the run of slanted hair above
    /// and below fades away as the Gaussian does. With σ = Δ/√(2π) the weights of layers Δ apart sum to one within 1.5 %.
    pub(crate) fn cut(&self, strand: &Strand<'_>, cut: &mut Cut) {
        cut.pieces.clear();
        cut.mass = 0.0;
        let Some(nearest) = self.nearest(strand) else { return };
        for index in 0..strand.points.len() - 1 {
            let run = self.run(strand, index);
            let Some(run) = run.clipped() else { continue };
            for part in run.split(0.0).into_iter().flatten() {
                let outwards = if nearest.crossings <= 1 {
                    Kind::Beside(if part.middle_along() < nearest.along { -1.0 } else { 1.0 })
                } else {
                    Kind::Strip
                };
                self.strips(&part, outwards, cut);
            }
        }
        cut.along = nearest.along as f32;
        self.sections(strand, &nearest, cut);
    }

    fn run(&self, strand: &Strand<'_>, index: usize) -> Run {
        let [a, b] = [index, index + 1].map(|i| strand.points[i].map(f64::from));
        let last = (strand.points.len() - 1) as f64;
        Run {
            from: [a[0] * self.resolution, a[1] * self.resolution],
            step: [(b[0] - a[0]) * self.resolution, (b[1] - a[1]) * self.resolution],
            heights: [a[2], b[2]].map(|z| (z - self.height) / self.sigma),
            radii: [index, index + 1].map(|i| f64::from(strand.radii[i]) * self.resolution),
            along: [index as f64 / last, (index + 1) as f64 / last],
        }
    }

    /// The strip of one run, cut so that the weight changes little within the filter's width.
    fn strips(&self, run: &Run, outwards: Kind, cut: &mut Cut) {
        let length = run.length();
        if length < 1e-6 {
            return;
        }
        let along = [run.step[0] / length, run.step[1] / length].map(|c| c as f32);
        let rise = run.heights[1] - run.heights[0];
        let count = (rise.abs() / 0.1).min(length / (0.7 * self.lateral)).ceil().clamp(1.0, 256.0);
        for part in 0..count as u32 {
            let [t0, t1] = [f64::from(part) / count, f64::from(part + 1) / count];
            let weight = mean_bell(run.heights[0] + rise * t0, run.heights[0] + rise * t1);
            let radius = run.radii[0] + (run.radii[1] - run.radii[0]) * 0.5 * (t0 + t1);
            let piece_length = length / count;
            cut.mass += 2.0 * radius * piece_length * weight;
            cut.pieces.push(Piece {
                from: [0, 1].map(|axis| (run.from[axis] + run.step[axis] * t0) as f32),
                along,
                length: piece_length as f32,
                radius: radius as f32,
                weight: weight as f32,
                kind: outwards,
            });
        }
    }

    /// The hair's round sections where it crosses the layer; where it does not, that at its nearest point, faded.
    fn sections(&self, strand: &Strand<'_>, nearest: &Nearest, cut: &mut Cut) {
        if nearest.crossings == 0 {
            self.section(&self.run(strand, nearest.index), nearest.part, cut);
            return;
        }
        for index in 0..strand.points.len() - 1 {
            let run = self.run(strand, index);
            if let Some(part) = run.crossing() {
                self.section(&run, part, cut);
            }
        }
    }

    fn section(&self, run: &Run, part: f64, cut: &mut Cut) {
        let radius = run.radii[0] + (run.radii[1] - run.radii[0]) * part;
        let weight = bell(run.heights[0] + (run.heights[1] - run.heights[0]) * part);
        let length = run.length();
        let along = if length > 1e-6 { [run.step[0] / length, run.step[1] / length] } else { [1.0, 0.0] };
        cut.mass += PI * radius * radius * weight;
        cut.pieces.push(Piece {
            from: [0, 1].map(|axis| (run.from[axis] + run.step[axis] * part) as f32),
            along: along.map(|c| c as f32),
            length: 0.0,
            radius: radius as f32,
            weight: weight as f32,
            kind: Kind::Section(self.alone(run) as f32),
        });
    }

    /// How much of a section stands alone: what of the hair's run beside it fades within the filter's width.
    fn alone(&self, run: &Run) -> f64 {
        let fade = run.length() / (run.heights[1] - run.heights[0]).abs().max(1e-9);
        1.0 - bell(self.lateral / fade.max(1e-9))
    }

    /// Where the strand comes nearest to the layer; `None` if the slab does not feel it.
    fn nearest(&self, strand: &Strand<'_>) -> Option<Nearest> {
        let mut best = Nearest { index: 0, part: 0.0, along: 0.0, distance: f64::INFINITY, crossings: 0 };
        for index in 0..strand.points.len().saturating_sub(1) {
            let run = self.run(strand, index);
            let crossing = run.crossing();
            best.crossings += u32::from(crossing.is_some());
            let part = crossing.unwrap_or(if run.heights[0].abs() <= run.heights[1].abs() { 0.0 } else { 1.0 });
            let distance = (run.heights[0] + (run.heights[1] - run.heights[0]) * part).abs();
            if distance < best.distance {
                let along = run.along[0] + (run.along[1] - run.along[0]) * part;
                best = Nearest { index, part, along, distance, ..best };
            }
        }
        (best.distance <= WINDOW).then_some(best)
    }
}

struct Nearest {
    index: usize,
    part: f64,
    along: f64,
    distance: f64,
    crossings: u32,
}

impl Run {
    fn length(&self) -> f64 {
        (self.step[0] * self.step[0] + self.step[1] * self.step[1]).sqrt()
    }

    fn middle_along(&self) -> f64 {
        0.5 * (self.along[0] + self.along[1])
    }

    /// Where the run passes through the layer, as a part of it. A point exactly on the layer belongs to the run that begins there, so that it
    /// counts once.
    fn crossing(&self) -> Option<f64> {
        let [a, b] = self.heights;
        ((a < 0.0) != (b < 0.0)).then(|| a / (a - b))
    }

    fn between(&self, t0: f64, t1: f64) -> Self {
        let mix = |ends: [f64; 2]| [ends[0] + (ends[1] - ends[0]) * t0, ends[0] + (ends[1] - ends[0]) * t1];
        Self {
            from: [self.from[0] + self.step[0] * t0, self.from[1] + self.step[1] * t0],
            step: self.step.map(|s| s * (t1 - t0)),
            heights: mix(self.heights),
            radii: mix(self.radii),
            along: mix(self.along),
        }
    }

    /// The part within the window, if there is one.
    fn clipped(&self) -> Option<Self> {
        let [a, b] = self.heights;
        if a.abs() <= WINDOW && b.abs() <= WINDOW {
            return Some(*self);
        }
        if a.max(b) <= -WINDOW || a.min(b) >= WINDOW {
            return None;
        }
        let at = |height: f64| ((height - a) / (b - a)).clamp(0.0, 1.0);
        let (t0, t1) = (at(-WINDOW).min(at(WINDOW)), at(-WINDOW).max(at(WINDOW)));
        (t1 > t0).then(|| self.between(t0, t1))
    }

    /// The run in two where it passes `height`, else as it is.
    fn split(&self, height: f64) -> [Option<Self>; 2] {
        let [a, b] = self.heights;
        if (a < height) == (b < height) {
            return [Some(*self), None];
        }
        let t = (height - a) / (b - a);
        [Some(self.between(0.0, t)), Some(self.between(t, 1.0))]
    }
}

/// The mean of exp(−x²/2) from a to b, in closed form by erf.
fn mean_bell(a: f64, b: f64) -> f64 {
    if (b - a).abs() < 1e-3 { bell(0.5 * (a + b)) } else { TAU.sqrt() * (integral(b) - integral(a)) / (b - a) }
}
