//! Where hairs stand: random, yet even.

use crate::seed::{Purpose, stream, unit};
use crate::tile::Root;
use crate::torus::shortest;

/// Darts that may fail one after another before the wanted distance shrinks.
const PATIENCE: u32 = 40;
/// By what the distance shrinks.
const SHRINK: f64 = 0.96;

/// `count` places on the unit torus, no two nearer than dart throwing could keep them apart.
///
/// Relaxed dart throwing (McCool and Fiume 1992, "Hierarchical Poisson disk sampling distributions"): the distance begins near that of the
/// densest packing and shrinks whenever darts keep failing, so exactly `count` places result, and every beginning of the list is itself even.
pub(crate) fn scatter(seed: u64, purpose: Purpose, count: u32) -> Vec<Root> {
    let mut random = stream(seed, purpose, 0);
    let mut field = DartField::new(count);
    let mut distance = (2.0 / (3f64.sqrt() * f64::from(count.max(1)))).sqrt();
    let mut roots = Vec::with_capacity(count as usize);
    let mut failures = 0;
    while roots.len() < count as usize {
        // Multiples of 2⁻²⁴ are exact in f32 as well.
        let place = [unit(&mut random), unit(&mut random)].map(|u| (u * f64::from(1u32 << 24)).floor() / f64::from(1u32 << 24));
        if field.is_free(place, distance) {
            field.add(place);
            roots.push(Root { cell: [0, 0], fraction: place.map(|c| c as f32) });
            failures = 0;
        } else {
            failures += 1;
            if failures == PATIENCE {
                distance *= SHRINK;
                failures = 0;
            }
        }
    }
    roots
}

/// The darts thrown so far, in cells about one dart wide.
struct DartField {
    side: usize,
    cells: Vec<Vec<[f64; 2]>>,
}

impl DartField {
    fn new(count: u32) -> Self {
        let side = f64::from(count).sqrt().ceil().clamp(1.0, 2048.0) as usize;
        Self { side, cells: vec![Vec::new(); side * side] }
    }

    fn home(&self, place: [f64; 2]) -> [usize; 2] {
        place.map(|c| ((c * self.side as f64) as usize).min(self.side - 1))
    }

    fn add(&mut self, place: [f64; 2]) {
        let [x, y] = self.home(place);
        self.cells[y * self.side + x].push(place);
    }

    fn is_free(&self, place: [f64; 2], distance: f64) -> bool {
        let [x, y] = self.home(place);
        let reach = (distance * self.side as f64).ceil() as usize;
        // A window wider than the torus would visit cells twice.
        let span = (2 * reach + 1).min(self.side);
        let first = |home: usize| (home + self.side - reach % self.side) % self.side;
        let mut rows = (0..span).map(|row| (first(y) + row) % self.side);
        rows.all(|row| {
            let mut columns = (0..span).map(|column| (first(x) + column) % self.side);
            columns.all(|column| self.cells[row * self.side + column].iter().all(|&other| !nearer(place, other, distance)))
        })
    }
}

fn nearer(a: [f64; 2], b: [f64; 2], distance: f64) -> bool {
    let d = [shortest(a[0] - b[0]), shortest(a[1] - b[1])];
    d[0] * d[0] + d[1] * d[1] < distance * distance
}
