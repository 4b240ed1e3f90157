//! A grid over the torus that finds neighbours.

/// The shortest way between two coordinates that are equal modulo one.
pub(crate) fn shortest(delta: f64) -> f64 {
    delta - (delta + 0.5).floor()
}

/// Points of the unit torus in square cells at least as wide as the search radius, so that the 3 × 3 cells around a place hold all neighbours.
pub(crate) struct TorusGrid {
    side: usize,
    starts: Vec<u32>,
    members: Vec<u32>,
    homes: Vec<u32>,
}

impl TorusGrid {
    /// A grid for searches within `radius` tile sides among about `count` points.
    pub(crate) fn new(radius: f64, count: usize) -> Self {
        // More cells than points would be memory for nothing.
        let most = (count as f64).sqrt().ceil().clamp(1.0, 1024.0);
        let side = (1.0 / radius.max(1e-9)).floor().clamp(1.0, most) as usize;
        Self { side, starts: vec![0; side * side + 1], members: Vec::new(), homes: Vec::new() }
    }

    /// Sorts the points into cells by counting; inside a cell they stay in order of number.
    pub(crate) fn rebuild(&mut self, places: impl Iterator<Item = [f64; 2]>) {
        self.homes.clear();
        self.homes.extend(places.map(|place| cell_of(self.side, place)));
        self.starts.fill(0);
        for &home in &self.homes {
            self.starts[home as usize + 1] += 1;
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.members.clear();
        self.members.resize(self.homes.len(), 0);
        // Filling from the back leaves `starts` at each cell's beginning.
        for (number, &home) in self.homes.iter().enumerate().rev() {
            let end = &mut self.starts[home as usize + 1];
            *end -= 1;
            self.members[*end as usize] = number as u32;
        }
        // `starts[c + 1]` now holds where cell c begins.
    }

    /// Calls `visit` with every point in the cells around a place, each once.
    pub(crate) fn around(&self, place: [f64; 2], mut visit: impl FnMut(usize)) {
        let side = self.side;
        let home = cell_of(side, place) as usize;
        let reach = side.min(3);
        for row in 0..reach {
            let y = (home / side + row + side - 1) % side;
            for column in 0..reach {
                let x = (home % side + column + side - 1) % side;
                let cell = y * side + x;
                let begin = self.starts[cell + 1] as usize;
                let end = self.starts.get(cell + 2).map_or(self.members.len(), |&next| next as usize);
                self.members[begin..end].iter().for_each(|&number| visit(number as usize));
            }
        }
    }
}

fn cell_of(side: usize, place: [f64; 2]) -> u32 {
    let index = |c: f64| (((c - c.floor()) * side as f64) as usize).min(side - 1);
    (index(place[1]) * side + index(place[0])) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_finds_what_a_full_search_finds() {
        for (radius, count) in [(0.9, 5), (0.45, 40), (0.3, 200), (0.07, 500)] {
            let places: Vec<[f64; 2]> =
                (0..count).map(|i| [f64::from(i) * 0.618_034 % 1.0 - 0.3, f64::from(i) * 0.754_877 % 1.0 + 2.0]).collect();
            let mut grid = TorusGrid::new(radius, count as usize);
            grid.rebuild(places.iter().copied());
            for &from in &places {
                let near = |i: usize| {
                    let d = [shortest(places[i][0] - from[0]), shortest(places[i][1] - from[1])];
                    d[0] * d[0] + d[1] * d[1] < radius * radius
                };
                let mut found = Vec::new();
                grid.around(from, |i| {
                    if near(i) {
                        found.push(i);
                    }
                });
                found.sort_unstable();
                let wanted: Vec<usize> = (0..places.len()).filter(|&i| near(i)).collect();
                assert_eq!(found, wanted, "radius {radius}");
            }
        }
    }
}
