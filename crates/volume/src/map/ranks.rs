//! The order in which places of the tile are covered.

use std::f64::consts::TAU;

use noise::core::worley::{ReturnType, distance_functions, worley_4d};
use noise::math::vectors::Vector4;
use noise::permutationtable::PermutationTable;
use noise::{NoiseFn, OpenSimplex, Perlin};
use rayon::prelude::*;

use super::{FurMap, MapLook};

/// A cell.
pub(super) struct Grain {
    /// From 0, the first that is covered, to under 1.
    pub(super) rank: f64,
    /// How much brighter it is than the mean, −1 to 1.
    pub(super) shade: f64,
    /// When in a loop it is shortest, 0 to 1.
    moment: f64,
}

impl Grain {
    /// How long it is now, beside its whole length.
    pub(super) fn length(&self, map: &FurMap) -> f64 {
        1.0 - map.swing * (0.5 + 0.5 * libm::cos(TAU * (map.phase - libm::floor(map.phase) - self.moment)))
    }
}

/// The cells of a map, row by row. Ranked by numbers drawn for each cell, so that of a density exactly so many are covered and more density adds hair and moves none.
pub(super) fn grains(map: &FurMap) -> Vec<Grain> {
    let count = map.cells as usize * map.cells as usize;
    let drawn = |cell: usize, what: u64| mixed(mixed(map.seed ^ what.wrapping_mul(0x9e37_79b9_7f4a_7c15)) ^ cell as u64);
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&cell| (drawn(cell, 1), cell));
    let mut ranks = vec![0.0; count];
    for (place, &cell) in order.iter().enumerate() {
        ranks[cell] = place as f64 / count as f64;
    }
    let unit = |cell, what| (drawn(cell, what) >> 11) as f64 / (1u64 << 53) as f64;
    (0..count).map(|cell| Grain { rank: ranks[cell], shade: 2.0 * unit(cell, 2) - 1.0, moment: unit(cell, 3) }).collect()
}

/// A number in which every bit depends on every bit of another (the finaliser of SplitMix64: Steele, Lea, Flood 2014).
fn mixed(mut x: u64) -> u64 {
    x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

type Basis = Box<dyn Fn([f64; 4]) -> f64 + Send + Sync>;

/// Noise on the tile, which repeats: the tile is rolled up both ways into a torus that is flat in four dimensions, where any noise may be looked up.
pub(super) struct Noise {
    octaves: Vec<(Basis, f64, f64)>,
    shade: Basis,
    cells: f64,
    drift: f64,
    moved: [f64; 4],
    /// Values that the noise has, rising: what part of the tile has more of it.
    values: Vec<f64>,
}

/// Along a side of the grid from which it is known how often a value comes.
const KNOWN: usize = 192;

/// No corner of any grid, where gradient noise is the same for all seeds.
const OFFSET: [f64; 4] = [17.31, 5.27, 91.73, 41.19];

impl Noise {
    pub(super) fn new(map: &FurMap) -> Self {
        let seed = (map.seed ^ map.seed >> 32) as u32;
        let octave =
            |k: u32| (basis(map.look, seed.wrapping_add(k.wrapping_mul(0x9e37_79b9))), f64::from(1u32 << k), 1.0 / f64::from(1u32 << k));
        let turn = TAU * (map.phase - libm::floor(map.phase));
        let moved = [map.swing * libm::cos(turn), map.swing * libm::sin(turn), 0.0, 0.0];
        let shade = basis(MapLook::Simplex, seed.wrapping_add(77));
        let cells = f64::from(map.cells);
        let octaves = (0..map.octaves).map(octave).collect();
        let mut noise = Self { octaves, shade, cells, drift: map.drift, moved, values: Vec::new() };
        noise.values = noise.sampled(0.0, KNOWN);
        noise.values.sort_by(f64::total_cmp);
        noise
    }

    /// The rank of each texel, 0 where there is most noise.
    pub(super) fn ranks(&self, height: f64, side: usize) -> Vec<f64> {
        let mut values = self.sampled(height, side);
        values.par_iter_mut().for_each(|value| *value = self.rank(*value));
        values
    }

    /// How much brighter hair is at a texel than the mean, −1 to 1; the same at every height.
    pub(super) fn shade(&self, x: usize, y: usize, side: usize) -> f64 {
        let place = self.rolled(x, y, side, 2.0 * self.cells);
        (2.0 * (self.shade)(place)).clamp(-1.0, 1.0)
    }

    /// The values at all texels of a square, row by row.
    fn sampled(&self, height: f64, side: usize) -> Vec<f64> {
        let change = 0.5 * self.drift * height;
        let value = |index: usize| -> f64 {
            let sum = |(basis, finer, strength): &(Basis, f64, f64)| {
                let place = self.rolled(index % side, index / side, side, self.cells * finer);
                strength * basis([0, 1, 2, 3].map(|k| place[k] + finer * (change + self.moved[k])))
            };
            self.octaves.iter().map(sum).sum()
        };
        (0..side * side).into_par_iter().map(value).collect()
    }

    /// The middle of a texel on the torus, whose ways round are `cells` long.
    fn rolled(&self, x: usize, y: usize, side: usize, cells: f64) -> [f64; 4] {
        let radius = cells / TAU;
        let angle = |texel: usize| TAU * (texel as f64 + 0.5) / side as f64;
        let (s, t) = (angle(x), angle(y));
        [
            radius * libm::cos(s) + OFFSET[0],
            radius * libm::sin(s) + OFFSET[1],
            radius * libm::cos(t) + OFFSET[2],
            radius * libm::sin(t) + OFFSET[3],
        ]
    }

    /// What part of the tile has more noise than this.
    fn rank(&self, value: f64) -> f64 {
        let count = self.values.len();
        let after = self.values.partition_point(|known| *known <= value);
        let part = match (after.checked_sub(1).map(|before| self.values[before]), self.values.get(after)) {
            (Some(below), Some(above)) if above > &below => (value - below) / (above - below),
            _ => 0.0,
        };
        1.0 - (after as f64 + part - 0.5).clamp(0.0, count as f64) / count as f64
    }
}

/// A noise function; more of it is covered first.
fn basis(look: MapLook, seed: u32) -> Basis {
    match look {
        MapLook::Perlin | MapLook::Grains => {
            let perlin = Perlin::new(seed);
            Box::new(move |place| perlin.get(place))
        }
        MapLook::Simplex => {
            let simplex = OpenSimplex::new(seed);
            Box::new(move |place| simplex.get(place))
        }
        MapLook::Dots => {
            let table = PermutationTable::new(seed);
            // Most at the middle of a dot.
            Box::new(move |place| -worley_4d(&table, distance_functions::euclidean, ReturnType::Distance, Vector4::from(place)))
        }
    }
}
