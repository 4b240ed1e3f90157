//! The alpha half of a BC3 block: sixteen values on a ramp of eight or six steps.
//!
//! Colour blocks are texpresso's. Its alpha blocks (2.0.2) are fitted to eight steps between other ends than they write and read back rounded down, which makes hair thinner: by
//! 0.5 % on average and up to 5 % an image (`examples/economy.rs`). Keeping the mean needs values between bytes, which it does not take.

/// The eight values that indices stand for, by the block's two ends: six steps between them where the first is greater; else four steps, nothing, and all.
fn steps(ends: [u8; 2]) -> [f64; 8] {
    let [a, b] = ends.map(f64::from);
    let between = |part: f64, parts: f64| a + (b - a) * part / parts;
    if ends[0] > ends[1] {
        [a, b, between(1.0, 7.0), between(2.0, 7.0), between(3.0, 7.0), between(4.0, 7.0), between(5.0, 7.0), between(6.0, 7.0)]
    } else {
        [a, b, between(1.0, 5.0), between(2.0, 5.0), between(3.0, 5.0), between(4.0, 5.0), 0.0, 255.0]
    }
}

/// The block that holds sixteen values of 0 to 255 with the least squared error, of those whose ends are the values' own.
pub(crate) fn encode_alpha(values: [f64; 16]) -> [u8; 8] {
    let byte = |value: f64| value.round().clamp(0.0, 255.0) as u8;
    let range = |keep: fn(f64) -> bool| {
        let kept = values.iter().copied().filter(|&value| keep(value));
        kept.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
    };
    let (low, high) = range(|_| true);
    let eight = [byte(high), byte(low)];
    // Nothing and all come for free, so the ends are those of what is between.
    let (low, high) = range(|value| (0.5..254.5).contains(&value));
    let six = if low <= high { [byte(low), byte(high)] } else { [0, 0] };
    let [one, other] = [eight, six].map(|ends| fitted(&values, ends));
    let (_, ends, indices) = if one.0 < other.0 { one } else { other };
    packed(ends, indices)
}

/// Squared error, ends and indices of the nearest steps.
fn fitted(values: &[f64; 16], ends: [u8; 2]) -> (f64, [u8; 2], [u8; 16]) {
    let steps = steps(ends);
    let mut error = 0.0;
    let indices = values.map(|value| {
        let apart = |index: usize| (steps[index] - value).powi(2);
        let nearest = (1..8).fold(0, |best, index| if apart(index) < apart(best) { index } else { best });
        error += apart(nearest);
        nearest as u8
    });
    (error, ends, indices)
}

/// The ends, then three bits a value, the first lowest.
fn packed(ends: [u8; 2], indices: [u8; 16]) -> [u8; 8] {
    let bits = indices.iter().rev().fold(0u64, |bits, &index| bits << 3 | u64::from(index));
    (bits << 16 | u64::from(ends[1]) << 8 | u64::from(ends[0])).to_le_bytes()
}

/// The sixteen values of a block, 0 to 255, not rounded.
pub(crate) fn decode_alpha(block: [u8; 8]) -> [f64; 16] {
    let steps = steps([block[0], block[1]]);
    let bits = u64::from_le_bytes(block) >> 16;
    std::array::from_fn(|i| steps[(bits >> (3 * i) & 7) as usize])
}

/// The block with one value moved to the step next above or below, and by how much that is; `None` at the end of the ramp.
pub(crate) fn moved(block: [u8; 8], value: usize, up: bool) -> Option<([u8; 8], f64)> {
    let steps = steps([block[0], block[1]]);
    let bits = u64::from_le_bytes(block);
    let shift = 16 + 3 * value;
    let own = steps[(bits >> shift & 7) as usize];
    let further = (0..8u64).zip(steps.map(|step| step - own)).filter(|(_, by)| if up { *by > 0.0 } else { *by < 0.0 });
    let (index, by) = further.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    Some(((bits & !(7 << shift) | index << shift).to_le_bytes(), by))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use texpresso::{Format, Params};

    #[test]
    fn values_that_lie_on_a_ramp_come_back() {
        for values in [
            [0u8; 16],
            [255; 16],
            [77; 16],
            std::array::from_fn(|i| if i % 3 == 0 { 255 } else { 0 }),
            std::array::from_fn(|i| 10 + 20 * (i as u8 % 8)),
        ] {
            let values = values.map(f64::from);
            assert_eq!(decode_alpha(encode_alpha(values)), values);
        }
    }

    #[test]
    fn one_value_moves_by_one_step() {
        let block = encode_alpha(std::array::from_fn(|i| 10.0 + 20.0 * (i % 8) as f64));
        let (higher, by) = moved(block, 3, true).unwrap_or_default();
        let (before, after) = (decode_alpha(block), decode_alpha(higher));
        assert_eq!(by, 20.0);
        assert!((0..16).all(|i| after[i] - before[i] == if i == 3 { 20.0 } else { 0.0 }));
        assert_eq!((moved(block, 7, true), moved(block, 0, false)), (None, None));
    }

    proptest! {
        #[test]
        fn no_value_is_further_off_than_half_a_step(values in proptest::array::uniform16(0u8..=255)) {
            let (low, high) = (values.iter().min().copied().unwrap_or(0), values.iter().max().copied().unwrap_or(0));
            let own = values.map(f64::from);
            let squares = |back: [f64; 16]| back.iter().zip(own).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            let ours = squares(decode_alpha(encode_alpha(own)));
            prop_assert!(ours <= 16.0 * (f64::from(high - low) / 14.0 + 1e-9).powi(2));
            // Another reader of the same block agrees but for cutting off instead of rounding; and another's block is no better.
            let mut block = [0u8; 16];
            block[..8].copy_from_slice(&encode_alpha(own));
            let read = Format::Bc3.decompress_block(&block).map(|texel| f64::from(texel[3]));
            prop_assert!(read.iter().zip(decode_alpha(encode_alpha(own))).all(|(a, b)| b - a >= -1e-9 && b - a < 1.0));
            Format::Bc3.compress_block_masked(values.map(|value| [0, 0, 0, value]), 0xFFFF, Params::default(), &mut block);
            let theirs = squares(decode_alpha([0, 1, 2, 3, 4, 5, 6, 7].map(|i| block[i])));
            prop_assert!(ours <= theirs + 16.0, "{ours} {theirs}");
        }
    }
}
