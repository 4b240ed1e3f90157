//! Disjoint sets (Tarjan 1975, with path halving), named by their lowest member so that the order of joining changes no name.

/// Sets of the numbers from 0.
pub(super) struct Sets {
    parents: Vec<u32>,
}

impl Sets {
    /// Each number in a set of its own.
    pub(super) fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// The lowest member of the set.
    #[inline]
    pub(super) fn lowest(&mut self, mut member: u32) -> u32 {
        while self.parents[member as usize] != member {
            let above = self.parents[self.parents[member as usize] as usize];
            self.parents[member as usize] = above;
            member = above;
        }
        member
    }

    /// Makes one set of two.
    #[inline]
    pub(super) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.lowest(a), self.lowest(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }
}
