//! What comparing a 640×480 picture costs: `cargo bench -p pelage-accuracy`.

use divan::Bencher;
use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, Image, dilate, flip, rmse_linear};

const WIDTH: u32 = 640;
const HEIGHT: u32 = 480;

fn main() {
    divan::main();
}

/// A picture with detail at every scale, by a small linear congruential sequence.
fn noise(mut state: u32) -> Vec<u8> {
    let step = |_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    (0..WIDTH * HEIGHT * 3).map(step).collect()
}

#[divan::bench(sample_count = 10)]
fn flip_640x480(bencher: Bencher) {
    let (a, b) = (noise(1), noise(2));
    let (Ok(a), Ok(b)) = (Image::new(WIDTH, HEIGHT, &a), Image::new(WIDTH, HEIGHT, &b)) else { return };
    bencher.bench(|| flip(a, b, None, DEFAULT_PIXELS_PER_DEGREE));
}

#[divan::bench(sample_count = 20)]
fn rmse_640x480(bencher: Bencher) {
    let (a, b) = (noise(1), noise(2));
    let (Ok(a), Ok(b)) = (Image::new(WIDTH, HEIGHT, &a), Image::new(WIDTH, HEIGHT, &b)) else { return };
    bencher.bench(|| rmse_linear(a, b, None));
}

#[divan::bench(sample_count = 20, args = [2, 20])]
fn dilate_640x480(bencher: Bencher, radius: u32) {
    let mask: Vec<u8> = noise(3).chunks_exact(3).map(|pixel| u8::from(pixel[0] > 250)).collect();
    bencher.bench(|| dilate(&mask, WIDTH, HEIGHT, radius));
}
