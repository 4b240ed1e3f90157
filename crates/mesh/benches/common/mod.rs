//! Two pieces of work timed turn and turn about, since machines drift.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// The median times of both, in nanoseconds for each of `items`.
pub(crate) fn medians<A, B>(rounds: usize, items: usize, mut a: impl FnMut() -> A, mut b: impl FnMut() -> B) -> [f64; 2] {
    let (mut first, mut second) = (Vec::new(), Vec::new());
    for _ in 0..rounds {
        first.push(time(&mut a));
        second.push(time(&mut b));
    }
    [first, second].map(|mut times| {
        times.sort_unstable();
        times[times.len() / 2].as_secs_f64() * 1e9 / items as f64
    })
}

fn time<T>(work: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    black_box(work());
    start.elapsed()
}
