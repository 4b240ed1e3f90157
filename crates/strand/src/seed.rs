//! Randomness that depends on a seed and on a strand's number only.
//!
//! Every strand draws from a generator of its own, so that what a hair is like depends on no other hair.

use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// What a stream is used for; streams of different purposes never meet.
#[derive(Clone, Copy)]
pub(crate) enum Purpose {
    Roots = 1,
    UndercoatRoots = 2,
    Traits = 3,
    Noise = 4,
    LockNoise = 5,
    Places = 6,
    Wool = 7,
    Locks = 8,
}

/// Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators": the finaliser of SplitMix64.
pub(crate) fn mix(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The generator of one strand (or of the whole tile, with `index` 0) for one purpose.
pub(crate) fn stream(seed: u64, purpose: Purpose, index: u64) -> Pcg64Mcg {
    let high = mix(seed ^ mix(purpose as u64));
    let low = mix(high ^ mix(index));
    Pcg64Mcg::new((u128::from(high) << 64) | u128::from(low))
}

/// Uniform in [0, 1), with 53 bits.
pub(crate) fn unit(random: &mut Pcg64Mcg) -> f64 {
    (random.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
}

/// Uniform in [−1, 1).
pub(crate) fn signed(random: &mut Pcg64Mcg) -> f64 {
    2.0 * unit(random) - 1.0
}
