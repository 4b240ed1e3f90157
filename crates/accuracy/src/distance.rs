//! How far each pixel is from a contour: exact Euclidean distances in linear time.
//!
//! P. F. Felzenszwalb, D. P. Huttenlocher: *Distance Transforms of Sampled Functions*, Theory of Computing 8 (2012). The square of a distance is separable, so each row and
//! then each column is the lower envelope of parabolas.

/// The distance in pixels from each pixel's centre to the contour between `inside` and the rest, negative inside: that to the nearest centre on the other side, less
/// half a pixel. Infinite where there is no other side.
pub(crate) fn signed_distance(width: usize, inside: &[bool]) -> Vec<f64> {
    let to = |side: bool| squared_distance(width, inside, side);
    let (to_inside, to_outside) = (to(true), to(false));
    to_inside.into_iter().zip(to_outside).map(|(out, within)| if out > 0.0 { out.sqrt() - 0.5 } else { 0.5 - within.sqrt() }).collect()
}

/// The squared distance from each pixel to the nearest that is on `side`.
fn squared_distance(width: usize, inside: &[bool], side: bool) -> Vec<f64> {
    let mut squares: Vec<f64> = inside.iter().map(|&is| if is == side { 0.0 } else { f64::INFINITY }).collect();
    let mut envelope = Envelope::default();
    for row in squares.chunks_mut(width.max(1)) {
        envelope.transform(row);
    }
    let height = squares.len() / width.max(1);
    let mut column = vec![0.0; height];
    for x in 0..width {
        (0..height).for_each(|y| column[y] = squares[y * width + x]);
        envelope.transform(&mut column);
        (0..height).for_each(|y| squares[y * width + x] = column[y]);
    }
    squares
}

/// The lower envelope of parabolas of one width: which they are and from where on each is the lowest. Kept for the next line.
#[derive(Default)]
struct Envelope {
    /// Apex and height.
    parabolas: Vec<(f64, f64)>,
    /// Where each begins to be the lowest.
    from: Vec<f64>,
}

impl Envelope {
    /// Replaces each value by the least over all `q` of (p − q)² + f(q).
    fn transform(&mut self, line: &mut [f64]) {
        self.parabolas.clear();
        self.from.clear();
        for (place, &height) in line.iter().enumerate().filter(|(_, height)| height.is_finite()) {
            self.add(place as f64, height);
        }
        if self.parabolas.is_empty() {
            return;
        }
        let mut lowest = 0;
        for (place, value) in line.iter_mut().enumerate() {
            let place = place as f64;
            while self.from.get(lowest + 1).is_some_and(|&from| from <= place) {
                lowest += 1;
            }
            let (apex, height) = self.parabolas[lowest];
            *value = (place - apex) * (place - apex) + height;
        }
    }

    /// Adds a parabola right of all the others.
    fn add(&mut self, apex: f64, height: f64) {
        while let (Some(&(other, its)), Some(&from)) = (self.parabolas.last(), self.from.last()) {
            let meet = ((height + apex * apex) - (its + other * other)) / (2.0 * (apex - other));
            if meet > from {
                self.parabolas.push((apex, height));
                self.from.push(meet);
                return;
            }
            self.parabolas.pop();
            self.from.pop();
        }
        self.parabolas.push((apex, height));
        self.from.push(f64::NEG_INFINITY);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn slowly(width: usize, inside: &[bool]) -> Vec<f64> {
        let nearest = |index: usize| {
            let others = (0..inside.len()).filter(|&other| inside[other] != inside[index]);
            let squared = |other: usize| {
                let apart = |a: usize, b: usize| (a as f64 - b as f64).powi(2);
                apart(other % width, index % width) + apart(other / width, index / width)
            };
            others.map(squared).fold(f64::INFINITY, f64::min).sqrt()
        };
        (0..inside.len()).map(|index| if inside[index] { 0.5 - nearest(index) } else { nearest(index) - 0.5 }).collect()
    }

    proptest! {
        #[test]
        fn it_is_the_distance_to_the_nearest(width in 1usize..16, inside in proptest::collection::vec(any::<bool>(), 1..200)) {
            let inside = &inside[..inside.len() / width * width];
            prop_assert_eq!(signed_distance(width, inside), slowly(width, inside));
        }
    }
}
