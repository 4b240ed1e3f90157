//! Which hairs lie together.

use crate::tile::Root;
use crate::torus::{TorusGrid, shortest};

/// For each hair the one in the middle of its lock, `width` tile sides wide: the first roots stand evenly (see `roots`), so as many of them as locks fit are
/// the locks' guides.
pub(crate) fn nearest_locks(width: f64, roots: &[Root]) -> Vec<u32> {
    let wanted = (1.0 / (width * width)).ceil() as usize;
    let guides = wanted.min(roots.len()).max(1);
    let place = |root: &Root| root.fraction.map(f64::from);
    // Dart throwing keeps the nearest guide within about 1.5 lock widths; the search doubles where given roots do not.
    let mut radius = 1.5 * width.max((1.0 / guides as f64).sqrt());
    let mut locks = vec![u32::MAX; roots.len()];
    while locks.contains(&u32::MAX) {
        let whole = radius >= 0.75;
        let mut grid = TorusGrid::new(if whole { 1.0 } else { radius }, guides);
        grid.rebuild(roots.iter().take(guides).map(place));
        for (lock, root) in locks.iter_mut().zip(roots).filter(|(lock, _)| **lock == u32::MAX) {
            let from = place(root);
            let mut best = if whole { f64::INFINITY } else { radius * radius };
            grid.around(from, |j| {
                let to = place(&roots[j]);
                let d = [shortest(to[0] - from[0]), shortest(to[1] - from[1])];
                let distance = d[0] * d[0] + d[1] * d[1];
                if distance < best || (distance == best && (j as u32) < *lock) {
                    best = distance;
                    *lock = j as u32;
                }
            });
        }
        radius *= 2.0;
    }
    locks
}
