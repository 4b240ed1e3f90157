//! What part of a strand one layer holds.

use libm::acos;
use pelage_strand::Strand;
use std::f64::consts::{PI, TAU};

use crate::footprint::{Kind, Piece};
use crate::gauss::{bell, integral};

/// Beyond this many vertical σ above or below its core a layer does not feel the hair: exp(−4.5) is 1 % of an 8-bit step short of nothing at mean weight.
const FADE: f64 = 3.0;

/// Runs are merged while their joints stay this near to the straight line, in lateral deviations of the filter.
const MERGE_DEVIATION: f64 = 0.1;

/// A layer's place and scale: where its tall Gaussian stands and how large a texel is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    /// Height of the layer, tile sides.
    pub(crate) height: f64,
    /// Vertical deviation above the layer, tile sides.
    pub(crate) sigma: f64,
    /// Vertical deviation below it, tile sides: another where layers are unevenly spaced, so that the cores of neighbours meet.
    pub(crate) sigma_below: f64,
    /// Half the height of the core, in vertical deviations: hair within it covers fully.
    pub(crate) core: f64,
    /// Texels along a tile side.
    pub(crate) resolution: f64,
    /// Lateral deviation of the filter in texels: sets how finely slanted hair is cut.
    pub(crate) lateral: f64,
    /// What heights are scaled by before directions are taken.
    pub(crate) stretch: f64,
}

/// A strand cut to one slab: strips in texels, their exact area, and where along the hair the layer stands.
#[derive(Default)]
pub(crate) struct Cut {
    pub(crate) pieces: Vec<Piece>,
    /// Texel areas: what the pieces cover together.
    pub(crate) mass: f64,
    /// Of the mass, what hair covers by being thicker elsewhere in the slab, and not by its way aside.
    rim: f64,
    /// 0 at the root, 1 at the tip.
    pub(crate) along: f32,
    /// From where to where along the hair it is within the core.
    pub(crate) within: [f32; 2],
}

impl Cut {
    /// Lets the section show what thicker hair below or above it covers around it, which no strip does where hair stands upright.
    fn widen_section(&mut self) {
        for piece in &mut self.pieces {
            if let Kind::Section { weight, alone } = piece.kind {
                let area = f64::from(piece.radius).powi(2) + self.rim.max(0.0) * f64::from(alone) / (PI * f64::from(weight));
                piece.radius = area.sqrt() as f32;
            }
        }
    }
}

/// The way along a strand from one point to the next, in texels, heights in vertical σ from the layer.
#[derive(Clone, Copy)]
struct Run {
    from: [f64; 2],
    step: [f64; 2],
    heights: [f64; 2],
    radii: [f64; 2],
    along: [f64; 2],
    /// The way in space, in tile sides, heights stretched: the hair's direction times its length.
    way: [f64; 3],
}

impl Slab {
    /// The heights that reach into the slab.
    pub(crate) fn reach(&self) -> (f32, f32) {
        let window = self.window();
        ((self.height - window * self.sigma_below) as f32, (self.height + window * self.sigma) as f32)
    }

    /// How far above the layer a height is, in vertical deviations.
    fn scaled(&self, above: f64) -> f64 {
        above / if above < 0.0 { self.sigma_below } else { self.sigma }
    }

    /// How far from the layer hair is felt, in vertical deviations.
    fn window(&self) -> f64 {
        self.core + FADE
    }

    /// What hair at a height covers of what it stands over.
    fn weight(&self, height: f64) -> f64 {
        bell((height.abs() - self.core).max(0.0))
    }

    /// Cuts a strand: `cut` is emptied and filled.
    ///
    /// A point of the layer is covered when hair stands over it within a height d of the layer, where d is random, the same for all hairs, and exceeds the
    /// core by x with probability exp(−x²/2σ²): a tall Gaussian with a flat top. Hair within the core thus covers fully, and the run of slanted hair above and
    /// below fades away as the Gaussian does.
    pub(crate) fn cut(&self, strand: &Strand<'_>, cut: &mut Cut) {
        cut.pieces.clear();
        cut.mass = 0.0;
        cut.rim = 0.0;
        let Some(nearest) = self.nearest(strand) else { return };
        cut.along = nearest.along as f32;
        cut.within = [cut.along; 2];
        let (low, high) = self.reach();
        let mut pending = Pending::default();
        for index in 0..strand.points.len() - 1 {
            let (a, b) = (strand.points[index][2], strand.points[index + 1][2]);
            if a.max(b) < low || a.min(b) > high {
                continue;
            }
            for run in self.runs(strand, index).into_iter().flatten() {
                self.take_in(&run, &nearest, &mut pending, cut);
            }
        }
        if let Some((done, zone)) = pending.flush() {
            strip(&done, zone, cut);
        }
        if nearest.crossings == 0 {
            self.section(&self.run(strand, nearest.index), nearest.part, cut);
        }
        if nearest.crossings <= 1 {
            cut.widen_section();
        }
    }

    /// The strips and the section of one run.
    fn take_in(&self, run: &Run, nearest: &Nearest, pending: &mut Pending, cut: &mut Cut) {
        for part in run.clipped(self.window()).into_iter().flat_map(|run| run.parted(self.core)).flatten() {
            let zone = Zone {
                beside: if nearest.crossings > 1 { 0.0 } else { if part.middle_along() < nearest.along { -1.0 } else { 1.0 } },
                core: if part.middle_height().abs() < self.core { None } else { Some(self.core.copysign(part.middle_height())) },
            };
            if zone.core.is_none() {
                let [from, to] = part.along.map(|along| along as f32);
                cut.within = [cut.within[0].min(from), cut.within[1].max(to)];
            }
            if let Some((done, zone)) = pending.take_in(part, zone, MERGE_DEVIATION * self.lateral) {
                strip(&done, zone, cut);
            }
        }
        if let Some(part) = run.crossing() {
            self.section(run, part, cut);
        }
    }

    /// One run; two, apart where they pass the layer, if heights are not scaled alike above and below it.
    fn runs(&self, strand: &Strand<'_>, index: usize) -> [Option<Run>; 2] {
        let run = self.run(strand, index);
        let above = [index, index + 1].map(|i| f64::from(strand.points[i][2]) - self.height);
        let Some(part) = crossing(above).filter(|_| self.sigma != self.sigma_below) else { return [Some(run), None] };
        let (mut first, mut second) = (run.between(0.0, part), run.between(part, 1.0));
        first.heights = [run.heights[0], 0.0];
        second.heights = [0.0, run.heights[1]];
        [Some(first).filter(|_| part > 0.0), Some(second).filter(|_| part < 1.0)]
    }

    fn run(&self, strand: &Strand<'_>, index: usize) -> Run {
        let [a, b] = [index, index + 1].map(|i| strand.points[i].map(f64::from));
        let last = (strand.points.len() - 1) as f64;
        Run {
            from: [a[0] * self.resolution, a[1] * self.resolution],
            step: [(b[0] - a[0]) * self.resolution, (b[1] - a[1]) * self.resolution],
            heights: [a[2], b[2]].map(|z| self.scaled(z - self.height)),
            radii: [index, index + 1].map(|i| f64::from(strand.radii[i]) * self.resolution),
            along: [index as f64 / last, (index + 1) as f64 / last],
            way: [b[0] - a[0], b[1] - a[1], (b[2] - a[2]) * self.stretch],
        }
    }

    fn section(&self, run: &Run, part: f64, cut: &mut Cut) {
        let radius = run.radii[0] + (run.radii[1] - run.radii[0]) * part;
        let weight = self.weight(run.heights[0] + (run.heights[1] - run.heights[0]) * part);
        let length = run.length();
        let along = if length > 1e-6 { [run.step[0] / length, run.step[1] / length] } else { [1.0, 0.0] };
        cut.mass += PI * radius * radius * weight;
        cut.pieces.push(Piece {
            from: [0, 1].map(|axis| (run.from[axis] + run.step[axis] * part) as f32),
            along: along.map(|c| c as f32),
            length: 0.0,
            radius: radius as f32,
            taper: 0.0,
            kind: Kind::Section { weight: weight as f32, alone: self.alone(run) as f32 },
            toward: run.toward(),
        });
    }

    /// How much of a section stands alone: what of the hair's run beside it ends within the filter's width.
    fn alone(&self, run: &Run) -> f64 {
        let beside = run.length() / (run.heights[1] - run.heights[0]).abs().max(1e-9) * (1.0 + self.core);
        1.0 - bell(self.lateral / beside.max(1e-9))
    }

    /// Where the strand comes nearest to the layer; `None` if the slab does not feel it.
    fn nearest(&self, strand: &Strand<'_>) -> Option<Nearest> {
        let mut best = Nearest { index: 0, part: 0.0, along: 0.0, distance: f64::INFINITY, crossings: 0 };
        let above = |index: usize| f64::from(strand.points[index][2]) - self.height;
        let mut from = above(0);
        for index in 0..strand.points.len().saturating_sub(1) {
            let ends = [from, above(index + 1)];
            from = ends[1];
            let crossing = crossing(ends);
            best.crossings += u32::from(crossing.is_some());
            let away = ends.map(|above| self.scaled(above).abs());
            let distance = if crossing.is_some() { 0.0 } else { away[0].min(away[1]) };
            if distance < best.distance {
                let part = crossing.unwrap_or(if away[0] <= away[1] { 0.0 } else { 1.0 });
                let along = (index as f64 + part) / (strand.points.len() - 1) as f64;
                best = Nearest { index, part, along, distance, ..best };
            }
        }
        (best.distance <= self.window()).then_some(best)
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

    /// The unit direction; straight up where the run has no length.
    fn toward(&self) -> [f32; 3] {
        let length = self.way.iter().map(|w| w * w).sum::<f64>().sqrt();
        if length > 0.0 && length.is_finite() { self.way.map(|w| (w / length) as f32) } else { [0.0, 0.0, 1.0] }
    }

    fn middle_along(&self) -> f64 {
        0.5 * (self.along[0] + self.along[1])
    }

    /// How much thicker the hair becomes away from the layer, in texels.
    fn outward_growth(&self) -> f64 {
        let growth = self.radii[1] - self.radii[0];
        if self.heights[1].abs() >= self.heights[0].abs() { growth } else { -growth }
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
            way: [0, 1, 2].map(|axis| self.way[axis] + next.way[axis]),
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
            way: self.way.map(|w| w * (t1 - t0)),
        }
    }

    fn middle_height(&self) -> f64 {
        0.5 * (self.heights[0] + self.heights[1])
    }

    /// The part within a window of heights, if there is one.
    fn clipped(&self, window: f64) -> Option<Self> {
        let [a, b] = self.heights;
        if a.abs() <= window && b.abs() <= window {
            return Some(*self);
        }
        if a.max(b) <= -window || a.min(b) >= window {
            return None;
        }
        let at = |height: f64| ((height - a) / (b - a)).clamp(0.0, 1.0);
        let (t0, t1) = (at(-window).min(at(window)), at(-window).max(at(window)));
        (t1 > t0).then(|| self.between(t0, t1))
    }

    /// The run in parts where it passes the layer or an end of its core, in order.
    fn parted(&self, core: f64) -> [Option<Self>; 4] {
        let [a, b] = self.heights;
        let place = |height: f64| if (a < height) == (b < height) { None } else { Some((height - a) / (b - a)) };
        let cuts = if b > a { [-core, 0.0, core] } else { [core, 0.0, -core] };
        let mut from = 0.0;
        let mut parts = [None; 4];
        for (part, end) in parts.iter_mut().zip(cuts.map(place).into_iter().chain([Some(1.0)])) {
            let Some(end) = end else { continue };
            if end > from {
                *part = Some(if from == 0.0 && end == 1.0 { *self } else { self.between(from, end) });
                from = end;
            }
        }
        parts
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

/// Where a run lies to the layer.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Zone {
    /// −1 before the layer, 1 after it, along the hair; 0 where hair that passes more than once has no one side.
    beside: f32,
    /// The end of the core that it lies beyond, in vertical deviations; `None` within it.
    core: Option<f64>,
}

/// Runs in one zone, merged while they are as good as straight: hair has more points than a layer can tell apart.
#[derive(Default)]
struct Pending {
    run: Option<(Run, Zone)>,
    joints: [Joint; MOST_JOINTS],
    count: usize,
}

impl Pending {
    /// Adds a run; hands back the finished one that it could not be merged with.
    fn take_in(&mut self, next: Run, zone: Zone, tolerance: f64) -> Option<(Run, Zone)> {
        let Some((run, old_zone)) = self.run else {
            self.run = Some((next, zone));
            return None;
        };
        let merged = run.joined(&next);
        let joint = Joint { place: next.from, height: next.heights[0] };
        let end = run.end();
        let follows =
            (run.heights[1] - next.heights[0]).abs() < 1e-9 && (end[0] - next.from[0]).abs() + (end[1] - next.from[1]).abs() < 1e-6;
        let straight = self.joints[..self.count].iter().chain([&joint]).all(|joint| merged.deviation(joint) <= tolerance);
        if follows && zone == old_zone && straight && self.count < MOST_JOINTS {
            self.joints[self.count] = joint;
            self.count += 1;
            self.run = Some((merged, zone));
            return None;
        }
        self.count = 0;
        self.run.replace((next, zone))
    }

    fn flush(&mut self) -> Option<(Run, Zone)> {
        self.run.take()
    }
}

/// The strip of one run.
fn strip(run: &Run, zone: Zone, cut: &mut Cut) {
    let heights = run.heights.map(|height| zone.core.map_or(0.0, |core| height - core));
    let length = run.length();
    let shown = 0.5 * (run.radii[0] + run.radii[1]) * mean_bell(heights[0], heights[1]);
    let area = swept(length, run.outward_growth());
    cut.mass += shown * area;
    cut.rim += shown * (area - 2.0 * length);
    if length < 1e-6 {
        return;
    }
    cut.pieces.push(Piece {
        from: run.from.map(|c| c as f32),
        along: run.step.map(|c| (c / length) as f32),
        length: length as f32,
        radius: (0.5 * (run.radii[0] + run.radii[1])) as f32,
        taper: ((run.radii[1] - run.radii[0]) / length) as f32,
        kind: Kind::Strip { height: heights[0] as f32, rise: ((heights[1] - heights[0]) / length) as f32, beside: zone.beside },
        toward: run.toward(),
    });
}

/// The area that a disc of radius 1 covers for the first time as it moves by `way` and grows by `growth` at once (both small: the rate of it).
///
/// The normal speed of the rim, way·cos φ + growth, integrated over the part of the rim where it is positive: 2·way where nothing grows, the whole rim where
/// growth outruns the way, none where it shrinks faster than it moves.
fn swept(way: f64, growth: f64) -> f64 {
    if growth >= way {
        return TAU * growth;
    }
    if growth <= -way {
        return 0.0;
    }
    2.0 * ((way * way - growth * growth).sqrt() + growth * acos(-growth / way))
}

/// The mean of exp(−x²/2) from a to b, in closed form by erf.
fn mean_bell(a: f64, b: f64) -> f64 {
    if (b - a).abs() < 1e-3 { bell(0.5 * (a + b)) } else { TAU.sqrt() * (integral(b) - integral(a)) / (b - a) }
}
