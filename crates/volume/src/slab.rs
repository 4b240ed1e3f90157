//! What part of a strand one layer holds.

use pelage_strand::Strand;
use std::f64::consts::{PI, TAU};

use crate::footprint::{Kind, Piece};
use crate::gauss::{bell, integral};

/// Beyond this many vertical σ a layer does not feel the hair: exp(−4.5) is 1 % of an 8-bit step short of nothing at mean weight.
const WINDOW: f64 = 3.0;

/// Runs are merged while their joints stay this near to the straight line, in lateral deviations of the filter.
const MERGE_DEVIATION: f64 = 0.1;

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
        cut.along = nearest.along as f32;
        let (low, high) = self.reach();
        let mut pending = Pending::default();
        for index in 0..strand.points.len() - 1 {
            let (a, b) = (strand.points[index][2], strand.points[index + 1][2]);
            if a.max(b) < low || a.min(b) > high {
                continue;
            }
            let run = self.run(strand, index);
            for part in run.clipped().into_iter().flat_map(|run| run.split(0.0)).flatten() {
                let side = if nearest.crossings > 1 { 0.0 } else { if part.middle_along() < nearest.along { -1.0 } else { 1.0 } };
                if let Some((done, beside)) = pending.take_in(part, side, MERGE_DEVIATION * self.lateral) {
                    strip(&done, beside, cut);
                }
            }
            if let Some(part) = run.crossing() {
                self.section(&run, part, cut);
            }
        }
        if let Some((done, beside)) = pending.flush() {
            strip(&done, beside, cut);
        }
        if nearest.crossings == 0 {
            self.section(&self.run(strand, nearest.index), nearest.part, cut);
        }
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
            kind: Kind::Section { weight: weight as f32, alone: self.alone(run) as f32 },
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
        let height = |index: usize| (f64::from(strand.points[index][2]) - self.height) / self.sigma;
        let mut from = height(0);
        for index in 0..strand.points.len().saturating_sub(1) {
            let heights = [from, height(index + 1)];
            from = heights[1];
            let crossing = crossing(heights);
            best.crossings += u32::from(crossing.is_some());
            let distance = if crossing.is_some() { 0.0 } else { heights[0].abs().min(heights[1].abs()) };
            if distance < best.distance {
                let part = crossing.unwrap_or(if heights[0].abs() <= heights[1].abs() { 0.0 } else { 1.0 });
                let along = (index as f64 + part) / (strand.points.len() - 1) as f64;
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

    fn crossing(&self) -> Option<f64> {
        crossing(self.heights)
    }

    /// Where the run ends.
    fn end(&self) -> [f64; 2] {
        [self.from[0] + self.step[0], self.from[1] + self.step[1]]
    }

    /// The straight run from this one's beginning to the other's end.
    fn joined(&self, next: &Self) -> Self {
        let end = next.end();
        Self {
            from: self.from,
            step: [end[0] - self.from[0], end[1] - self.from[1]],
            heights: [self.heights[0], next.heights[1]],
            radii: [self.radii[0], next.radii[1]],
            along: [self.along[0], next.along[1]],
        }
    }

    /// How far a joint lies from where this run passes its height, in texels.
    fn deviation(&self, joint: &Joint) -> f64 {
        let rise = self.heights[1] - self.heights[0];
        if rise.abs() < 1e-9 {
            return f64::INFINITY;
        }
        let t = (joint.height - self.heights[0]) / rise;
        if !(0.0..=1.0).contains(&t) {
            return f64::INFINITY;
        }
        let off = [0, 1].map(|axis| self.from[axis] + self.step[axis] * t - joint.place[axis]);
        (off[0] * off[0] + off[1] * off[1]).sqrt()
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

/// Where heights change sign, as a part of the way. A point exactly on the layer belongs to the run that begins there, so that it counts once.
fn crossing([a, b]: [f64; 2]) -> Option<f64> {
    ((a < 0.0) != (b < 0.0)).then(|| a / (a - b))
}

/// A point where two runs were joined.
#[derive(Clone, Copy, Default)]
struct Joint {
    place: [f64; 2],
    height: f64,
}

/// Joints that a merged run may have.
const MOST_JOINTS: usize = 8;

/// Runs on one side of the layer, merged while they are as good as straight: hair has more points than a layer can tell apart.
#[derive(Default)]
struct Pending {
    run: Option<(Run, f32)>,
    joints: [Joint; MOST_JOINTS],
    count: usize,
}

impl Pending {
    /// Adds a run; hands back the finished one that it could not be merged with.
    fn take_in(&mut self, next: Run, side: f32, tolerance: f64) -> Option<(Run, f32)> {
        let Some((run, old_side)) = self.run else {
            self.run = Some((next, side));
            return None;
        };
        let merged = run.joined(&next);
        let joint = Joint { place: next.from, height: next.heights[0] };
        let end = run.end();
        let follows = run.heights[1] == next.heights[0] && (end[0] - next.from[0]).abs() + (end[1] - next.from[1]).abs() < 1e-6;
        let straight = self.joints[..self.count].iter().chain([&joint]).all(|joint| merged.deviation(joint) <= tolerance);
        if follows && side == old_side && straight && self.count < MOST_JOINTS {
            self.joints[self.count] = joint;
            self.count += 1;
            self.run = Some((merged, side));
            return None;
        }
        self.count = 0;
        self.run.replace((next, side))
    }

    fn flush(&mut self) -> Option<(Run, f32)> {
        self.run.take()
    }
}

/// The strip of one run.
fn strip(run: &Run, beside: f32, cut: &mut Cut) {
    let length = run.length();
    if length < 1e-6 {
        return;
    }
    let rise = run.heights[1] - run.heights[0];
    let radius = 0.5 * (run.radii[0] + run.radii[1]);
    cut.mass += 2.0 * radius * length * mean_bell(run.heights[0], run.heights[1]);
    cut.pieces.push(Piece {
        from: run.from.map(|c| c as f32),
        along: run.step.map(|c| (c / length) as f32),
        length: length as f32,
        radius: radius as f32,
        kind: Kind::Strip { height: run.heights[0] as f32, rise: (rise / length) as f32, beside },
    });
}

/// The mean of exp(−x²/2) from a to b, in closed form by erf.
fn mean_bell(a: f64, b: f64) -> f64 {
    if (b - a).abs() < 1e-3 { bell(0.5 * (a + b)) } else { TAU.sqrt() * (integral(b) - integral(a)) / (b - a) }
}
