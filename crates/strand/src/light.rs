//! What light the strands themselves let through: what every texture made of them is measured against.

use std::collections::BTreeMap;

use crate::tile::StrandTile;

/// Most samples along a tile side.
const FINEST: u32 = 8192;

impl StrandTile {
    /// What part of the light passes all hair along a slanted line, averaged over the tile; each hair the sweep of its round level sections, and as opaque as it
    /// is at most where the line meets it, however often that is.
    ///
    /// `slope` is how far the line runs along x and y for each tile side that it rises: (0, 0) along the normal, (1, 0) at 45°. Lines stand on a lattice of
    /// `side`² places (1 to 8192), and whether one meets a hair is decided in closed form, so the only error is the lattice's: under 0.002 at 512 for the
    /// default coat. Cost goes with `side`² and with the slope. `None` for a slope that is not finite or a side out of range.
    ///
    /// ```
    /// use pelage_strand::{StrandSource, StrandTile};
    ///
    /// let hair = StrandSource { points: vec![[0.5, 0.5, 0.0], [0.5, 0.5, 0.4]], radii: vec![0.1; 2], root_colour: [1.0; 3], tip_colour: [1.0; 3] };
    /// let tile = StrandTile::from_strands(0.4, &[hair])?;
    /// let open = tile.transmittance([1.0, 0.0], 512).ok_or("a finite slope")?;
    /// // Its shadow at 45° is a stadium.
    /// assert!((open - (1.0 - 0.4 * 0.2 - std::f64::consts::PI * 0.01)).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn transmittance(&self, slope: [f64; 2], side: u32) -> Option<f64> {
        if !slope.iter().all(|s| s.is_finite() && s.abs() < 1e6) || !(1..=FINEST).contains(&side) {
            return None;
        }
        let mut shadow = Shadow { side: i64::from(side), met: vec![false; side as usize * side as usize] };
        // What translucent hair leaves, where there is some.
        let mut open: BTreeMap<usize, f64> = BTreeMap::new();
        for strand in self.strands() {
            // Where the line through a point of the hair leaves the skin.
            let foot = |p: &[f32; 3]| [0, 1].map(|axis| f64::from(p[axis]) - slope[axis] * f64::from(p[2]));
            let last = (strand.points.len() - 1) as f64;
            let mut most: BTreeMap<usize, f64> = BTreeMap::new();
            for (index, (points, radii)) in strand.points.windows(2).zip(strand.radii.windows(2)).enumerate() {
                let (ends, radii) = ([foot(&points[0]), foot(&points[1])], [f64::from(radii[0]), f64::from(radii[1])]);
                if strand.is_opaque() {
                    shadow.add(ends, radii, |met, place, _| met[place] = true);
                    continue;
                }
                shadow.add(ends, radii, |_, place, part| {
                    let opacity = f64::from(strand.opacity_at(((index as f64 + part) / last) as f32));
                    most.entry(place).and_modify(|most| *most = most.max(opacity)).or_insert(opacity);
                });
            }
            most.into_iter().for_each(|(place, opacity)| *open.entry(place).or_insert(1.0) *= 1.0 - opacity);
        }
        let met = shadow.met.iter().filter(|&&met| met).count();
        let dimmed: f64 = open.iter().filter(|&(&place, _)| !shadow.met[place]).map(|(_, open)| 1.0 - open).sum();
        Some(1.0 - (met as f64 + dimmed) / shadow.met.len() as f64)
    }
}

/// The places of a lattice over the tile whose lines meet hair.
struct Shadow {
    side: i64,
    met: Vec<bool>,
}

impl Shadow {
    /// Visits the union of the discs from one end to the other: its places, and how far along the disc is that comes nearest.
    fn add(&mut self, ends: [[f64; 2]; 2], radii: [f64; 2], mut visit: impl FnMut(&mut [bool], usize, f64)) {
        let side = self.side as f64;
        let step = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let grow = radii[1] - radii[0];
        let squared = step[0] * step[0] + step[1] * step[1] - grow * grow;
        let reach = radii[0].max(radii[1]);
        let range = |axis: usize| {
            let (low, high) = (ends[0][axis].min(ends[1][axis]) - reach, ends[0][axis].max(ends[1][axis]) + reach);
            ((low * side - 0.5).ceil() as i64, (high * side - 0.5).floor() as i64)
        };
        let ((left, right), (bottom, top)) = (range(0), range(1));
        for row in bottom..=top {
            let y = (row as f64 + 0.5) / side - ends[0][1];
            let line = (row.rem_euclid(self.side) * self.side) as usize;
            for column in left..=right {
                let x = (column as f64 + 0.5) / side - ends[0][0];
                let along = x * step[0] + y * step[1] + radii[0] * grow;
                // Where the discs come nearest: |p − ct|² − (r + gt)² is least there if the axis outruns the radius, else at an end.
                let t = if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { f64::from(u8::from(grow > 0.0)) };
                let (dx, dy, r) = (x - step[0] * t, y - step[1] * t, radii[0] + grow * t);
                if dx * dx + dy * dy <= r * r {
                    visit(&mut self.met, line + column.rem_euclid(self.side) as usize, t);
                }
            }
        }
    }
}
