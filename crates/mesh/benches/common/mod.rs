//! Two pieces of work timed turn and turn about, since machines drift.

use std::hint::black_box;
use std::time::Duration;

use cpu_time::ThreadTime;

/// The least times of both on a core, in nanoseconds for each of `items`. What else a machine does is not in them, but for caches that it fills.
pub(crate) fn least<A, B>(rounds: usize, items: usize, mut a: impl FnMut() -> A, mut b: impl FnMut() -> B) -> [f64; 2] {
    let mut least = [Duration::MAX; 2];
    for _ in 0..rounds {
        least = [least[0].min(time(&mut a)), least[1].min(time(&mut b))];
    }
    least.map(|time| time.as_secs_f64() * 1e9 / items as f64)
}

fn time<T>(work: impl FnOnce() -> T) -> Duration {
    let start = ThreadTime::now();
    black_box(work());
    start.elapsed()
}
