//! Settings by their numbers.

/// How many values each knob has; a setting is the position of each knob's value, the finest of them last.
pub(super) struct Grid<'a> {
    counts: &'a [usize],
}

impl<'a> Grid<'a> {
    pub(super) fn new(counts: &'a [usize]) -> Self {
        Self { counts }
    }

    /// How many settings there are; none if they are more than can be counted.
    pub(super) fn len(&self) -> Option<usize> {
        self.counts.iter().try_fold(1usize, |len, &count| len.checked_mul(count))
    }

    /// The setting of a number: the last knob's value changes first.
    pub(super) fn setting(&self, mut number: usize) -> Vec<usize> {
        let mut setting = vec![0; self.counts.len()];
        for (position, &count) in setting.iter_mut().zip(self.counts).rev() {
            *position = number % count;
            number /= count;
        }
        setting
    }

    pub(super) fn number(&self, setting: &[usize]) -> usize {
        setting.iter().zip(self.counts).fold(0, |number, (&position, &count)| number * count + position)
    }

    /// How far each knob is from its finest value: 0 at it, 1 at the first.
    pub(super) fn place(&self, setting: &[usize]) -> Vec<f64> {
        let distance = |(&position, &count): (&usize, &usize)| match count - 1 {
            0 => 0.0,
            steps => (steps - position) as f64 / steps as f64,
        };
        setting.iter().zip(self.counts).map(distance).collect()
    }

    /// What is measured before anything is expected: the finest, what each knob alone does to it, and all of them together.
    pub(super) fn ends(&self) -> Vec<usize> {
        let finest: Vec<usize> = self.counts.iter().map(|count| count - 1).collect();
        let mut ends = vec![self.number(&finest)];
        for knob in 0..self.counts.len() {
            let mut setting = finest.clone();
            setting[knob] = 0;
            ends.push(self.number(&setting));
        }
        ends.push(0);
        let mut seen = std::collections::BTreeSet::new();
        ends.retain(|&number| seen.insert(number));
        ends
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_settings_are_the_same_thing() {
        let grid = Grid::new(&[3, 1, 4]);
        assert_eq!(grid.len(), Some(12));
        assert!((0..12).all(|number| grid.number(&grid.setting(number)) == number));
        assert_eq!(grid.setting(7), [1, 0, 3]);
        assert_eq!(grid.place(&[1, 0, 0]), [0.5, 0.0, 1.0]);
        assert_eq!(Grid::new(&[usize::MAX, 2]).len(), None);
    }

    #[test]
    fn each_end_is_there_once() {
        // The finest, the first of the first knob, the first of the last knob, all first.
        assert_eq!(Grid::new(&[3, 1, 4]).ends(), [11, 3, 8, 0]);
        assert_eq!(Grid::new(&[2]).ends(), [1, 0]);
        assert_eq!(Grid::new(&[]).ends(), [0]);
    }
}
