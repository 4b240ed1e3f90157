//! Where in a pixel to look: a low-discrepancy sequence, scrambled for each pixel.

/// Mixes 32 bits: *lowbias32* of C. Wellons' prospector, 2018.
pub(crate) fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A number for a pixel of a picture with a seed.
pub(crate) fn pixel_seed(seed: u64, x: u32, y: u32) -> u32 {
    [(seed >> 32) as u32, x, y].into_iter().fold(hash(seed as u32 ^ 0x9e37_79b9), |mixed, next| hash(mixed ^ next))
}

/// Sample number `index` of a pixel, in the unit square: the first two dimensions of Sobol's sequence, each Owen-scrambled by hashing (B. Burley, *Practical
/// Hash-based Owen Scrambling*, 2020). The first 2^k samples are one in each of 2^k equal parts, of every shape that powers of two allow.
pub(crate) fn sample(pixel: u32, index: u32) -> [f64; 2] {
    let first = scramble(index.reverse_bits(), hash(pixel ^ 0x68bc_21eb));
    let second = scramble(sobol_second(index), hash(pixel ^ 0x02e5_be93));
    [first, second].map(|bits| (f64::from(bits) + 0.5) / (f64::from(u32::MAX) + 1.0))
}

/// A number from 0 to 1 for a strand at a sample: whether hair that is only partly there is met.
pub(crate) fn chance(pixel: u32, index: u32, copy: u32) -> f64 {
    f64::from(hash(hash(pixel ^ hash(index)) ^ copy)) / (f64::from(u32::MAX) + 1.0)
}

/// The second dimension: its direction numbers are those of Pascal's triangle modulo 2.
fn sobol_second(index: u32) -> u32 {
    let mut direction = 1u32 << 31;
    let mut bits = 0;
    let mut left = index;
    while left != 0 {
        if left & 1 == 1 {
            bits ^= direction;
        }
        direction ^= direction >> 1;
        left >>= 1;
    }
    bits
}

/// Owen's scrambling: every bit is turned over or not by a hash of those above it (S. Laine and T. Karras, *Stratified Sampling for Stochastic Transparency*,
/// 2011, with the constants of N. Vegdahl).
fn scramble(bits: u32, seed: u32) -> u32 {
    let mut x = bits.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_one_in_each_elementary_part() {
        for pixel in [0, 1, 77, 0xdead_beef] {
            for (columns, rows) in [(64, 1), (32, 2), (8, 8), (2, 32), (1, 64)] {
                let mut parts: Vec<usize> = (0..64)
                    .map(|index| sample(pixel, index))
                    .map(|[x, y]| (x * columns as f64) as usize + columns * (y * rows as f64) as usize)
                    .collect();
                parts.sort_unstable();
                parts.dedup();
                assert_eq!(parts.len(), 64, "{columns} × {rows} parts of pixel {pixel}");
            }
        }
    }

    #[test]
    fn pixels_and_strands_differ() {
        assert_ne!(sample(pixel_seed(1, 0, 0), 0), sample(pixel_seed(1, 1, 0), 0));
        assert_ne!(pixel_seed(1, 0, 1), pixel_seed(1, 1, 0));
        let mean = (0..10_000).map(|copy| chance(3, 5, copy)).sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 0.01, "{mean}");
    }
}
