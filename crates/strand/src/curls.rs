//! How fine the curls of a tile are: what textures of it must resolve.

use libm::atan2;
use std::f64::consts::TAU;

use crate::tile::{Strand, StrandTile};

/// The curls and waves of a tile's hair, seen from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curls {
    /// What part of all hairs goes round, or forth and back, at least once.
    pub share: f64,
    /// The median of how wide they are, in tile sides: a helix' diameter; for waves the two thirds of the way from side to side that a circle as long as the wave
    /// has.
    pub width: f64,
    /// The median of how high a hair climbs in a turn, in tile sides.
    pub rise: f64,
}

impl StrandTile {
    /// How fine the curls are; `None` where no hair goes round once, or only within its own thickness, or too slightly to be seen.
    ///
    /// ```
    /// use pelage_strand::{GrowSettings, Style, grow};
    ///
    /// let curly = GrowSettings { style: Style::Curly { radius: 0.1, turns: 3.0 }, height: 0.4, steps: 60, ..GrowSettings::default() };
    /// let curls = grow(&curly)?.curls().ok_or("curls")?;
    /// assert!((curls.width / (2.0 * 0.1 * 0.4) - 1.0).abs() < 0.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn curls(&self) -> Option<Curls> {
        let (mut widths, mut rises): (Vec<f64>, Vec<f64>) = self.strands().filter_map(|strand| curl(&strand)).unzip();
        let share = widths.len() as f64 / self.strand_count() as f64;
        Some(Curls { share, width: median(&mut widths)?, rise: median(&mut rises)? })
    }
}

/// Hair that goes less far sideways, over its height, is straight to the eye: whoever loses its waves loses little.
const LEAST_WAY: f64 = 0.4;

/// How wide a hair's curls are and how high it climbs in one.
fn curl(strand: &Strand<'_>) -> Option<(f64, f64)> {
    let last = strand.points.len() - 1;
    let place = |index: usize| [0, 1].map(|axis| f64::from(strand.points[index][axis]));
    let (root, tip) = (place(0), place(last));
    // Without the way that the hair takes as a whole, a curl is closed.
    let drift = [0, 1].map(|axis| (tip[axis] - root[axis]) / last as f64);
    let step = |index: usize| {
        let (from, to) = (place(index), place(index + 1));
        [0, 1].map(|axis| to[axis] - from[axis] - drift[axis])
    };
    let (mut way, mut turned) = (0.0, 0.0);
    let mut before: Option<[f64; 2]> = None;
    for next in (0..last).map(step) {
        let length = next[0].hypot(next[1]);
        if length > 0.0 {
            if let Some([x, y]) = before {
                turned += atan2(x * next[1] - y * next[0], x * next[0] + y * next[1]).abs();
            }
            before = Some(next);
            way += length;
        }
    }
    let radius = strand.radii.iter().map(|&r| f64::from(r)).sum::<f64>() / strand.radii.len() as f64;
    let width = 2.0 * way / turned;
    let top = strand.points.iter().fold(0.0f64, |top, p| top.max(f64::from(p[2])));
    (turned >= TAU && width > radius && way > LEAST_WAY * top).then_some((width, top * TAU / turned))
}

fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
