//! Rectangles of cells, two triangles each, with texture coordinates over the whole.

use glam::DVec2;

/// Triangles and their texture coordinates as they are made.
#[derive(Default)]
pub(super) struct Grid {
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) coordinates: Vec<DVec2>,
}

impl Grid {
    /// Adds `across` × `down` cells. `vertex(i, j)` numbers the vertex *i* cells to the right and *j* up, seen from outside, where texture
    /// coordinates run from (0, 0) to (1, 1). `rising(i, j)` says which diagonal cuts a cell: from its lower left corner, or from its lower right.
    pub(super) fn add(&mut self, across: u32, down: u32, vertex: impl Fn(u32, u32) -> u32, rising: impl Fn(u32, u32) -> bool) {
        let place = |(i, j): (u32, u32)| DVec2::new(f64::from(i) / f64::from(across), f64::from(j) / f64::from(down));
        for j in 0..down {
            for i in 0..across {
                let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                let halves = if rising(i, j) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
                for corners in halves {
                    self.triangles.push(corners.map(|(i, j)| vertex(i, j)));
                    self.coordinates.extend(corners.map(place));
                }
            }
        }
    }
}
