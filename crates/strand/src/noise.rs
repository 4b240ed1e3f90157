//! Smooth noise that repeats with the tile.

use crate::seed::mix;

/// Gradient noise (Perlin 2002, "Improving noise", with hashed gradients) that is toroidal in x and y and free in z.
///
/// One cell of noise is `1 / frequency` tile sides in all three directions; the value lies within [−1, 1] and is twice continuously differentiable.
///
/// ```
/// let noise = pelage_strand::TileNoise::new(7, 4);
/// assert_eq!(noise.value(0.25, 0.6, 0.1), noise.value(1.25, -0.4, 0.1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileNoise {
    seed: u64,
    frequency: u32,
}

impl TileNoise {
    /// Noise with `frequency` cells along a tile side (at least 1; 0 counts as 1).
    pub fn new(seed: u64, frequency: u32) -> Self {
        Self { seed: mix(seed), frequency: frequency.max(1) }
    }

    /// The noise at a place in tile sides; 0 where a coordinate is not finite.
    pub fn value(&self, x: f64, y: f64, z: f64) -> f64 {
        let scale = f64::from(self.frequency);
        let place = [(x - x.floor()) * scale, (y - y.floor()) * scale, z * scale];
        if !place.iter().all(|c| c.is_finite() && c.abs() < 1e15) {
            return 0.0;
        }
        let cell = place.map(f64::floor);
        let inside = [place[0] - cell[0], place[1] - cell[1], place[2] - cell[2]];
        let ease = inside.map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
        let hashes = self.hashes(cell);
        let mut total = 0.0;
        for (corner, &hash) in hashes.iter().enumerate() {
            let step = [corner & 1, (corner >> 1) & 1, corner >> 2].map(|bit| bit as f64);
            let mut weight = 1.0;
            for axis in 0..3 {
                weight *= if step[axis] > 0.0 { ease[axis] } else { 1.0 - ease[axis] };
            }
            total += weight * ramp(hash, [inside[0] - step[0], inside[1] - step[1], inside[2] - step[2]]);
        }
        total.clamp(-1.0, 1.0)
    }

    /// Two independent values at one place: a smooth sideways push.
    pub fn sideways(&self, x: f64, y: f64, z: f64) -> [f64; 2] {
        let other = Self { seed: mix(self.seed), frequency: self.frequency };
        [self.value(x, y, z), other.value(x, y, z)]
    }

    /// The hash of each corner of a cell, wrapped in x and y: x goes fastest. Corners share what their common coordinates give.
    fn hashes(&self, cell: [f64; 3]) -> [u64; 8] {
        let period = i64::from(self.frequency);
        let ends = |axis: usize| {
            let low = cell[axis] as i64;
            if axis < 2 { [low.rem_euclid(period), (low + 1).rem_euclid(period)] } else { [low, low + 1] }
        };
        let [xs, ys, zs] = [0, 1, 2].map(ends);
        let columns = xs.map(|x| mix(self.seed ^ x as u64)).map(|hash| ys.map(|y| mix(hash ^ y as u64)));
        std::array::from_fn(|corner| mix(columns[corner & 1][(corner >> 1) & 1] ^ zs[corner >> 2] as u64))
    }
}

/// A lattice point's gradient times the way from it.
fn ramp(hash: u64, away: [f64; 3]) -> f64 {
    let (a, b) = match hash % 3 {
        0 => (away[0], away[1]),
        1 => (away[1], away[2]),
        _ => (away[2], away[0]),
    };
    let signs = hash >> 32;
    (if signs & 1 == 0 { a } else { -a }) + (if signs & 2 == 0 { b } else { -b })
}
