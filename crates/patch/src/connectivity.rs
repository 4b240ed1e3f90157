//! Whether triangles make a disc, seen from their index list alone.

use std::collections::HashMap;

/// Whether triangles, given by vertex numbers, are a topological disc: every edge has one or two of them, they hang together along edges,
/// the ones around each vertex are a single fan, and V − E + F = 1.
///
/// Of connected surfaces, orientable or not, only the disc and the projective plane have that characteristic, and the latter no boundary.
pub(crate) fn is_disc(triangles: &[[u32; 3]]) -> bool {
    let mut edges: HashMap<(u32, u32), [u32; 2]> = HashMap::new();
    let mut pieces = Pieces::new(triangles.len());
    // Corners 3f + k, joined where two faces share an edge at their common vertex: one class a fan.
    let mut fans = Pieces::new(3 * triangles.len());
    let mut corner_of: HashMap<u32, u32> = HashMap::new();
    for (face, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
            corner_of.entry(from).or_insert((3 * face + k) as u32);
            let entry = edges.entry((from.min(to), from.max(to))).or_insert([u32::MAX; 2]);
            match entry {
                [u32::MAX, _] => entry[0] = (3 * face + k) as u32,
                [other, u32::MAX] => {
                    let other = *other as usize;
                    pieces.join(face, other / 3);
                    let next = |corner: usize| if corner % 3 == 2 { corner - 2 } else { corner + 1 };
                    let same_way = triangles[other / 3][other % 3] == from;
                    let mate = if same_way { other } else { next(other) };
                    let far_mate = if same_way { next(other) } else { other };
                    fans.join(3 * face + k, mate);
                    fans.join(next(3 * face + k), far_mate);
                    entry[1] = (3 * face + k) as u32;
                }
                _ => return false,
            }
        }
    }
    let boundary = edges.values().filter(|e| e[1] == u32::MAX).count();
    let whole = pieces.count == 1 && fans.count == corner_of.len();
    whole && boundary > 0 && corner_of.len() + triangles.len() == edges.len() + 1
}

/// Disjoint sets.
struct Pieces {
    parents: Vec<u32>,
    count: usize,
}

impl Pieces {
    fn new(size: usize) -> Self {
        Self { parents: (0..size as u32).collect(), count: size }
    }

    fn root(&mut self, mut member: usize) -> usize {
        while self.parents[member] as usize != member {
            let parent = self.parents[member] as usize;
            self.parents[member] = self.parents[parent];
            member = parent;
        }
        member
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            self.parents[a.max(b)] = a.min(b) as u32;
            self.count -= 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::is_disc;

    #[test]
    fn tells_discs_from_the_rest() {
        assert!(is_disc(&[[0, 1, 2]]), "a triangle");
        assert!(is_disc(&[[0, 1, 2], [2, 1, 3]]), "two along an edge");
        assert!(is_disc(&[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]), "a closed fan");
        assert!(!is_disc(&[]), "nothing");
        assert!(!is_disc(&[[0, 1, 2], [3, 4, 5]]), "two pieces");
        assert!(!is_disc(&[[0, 1, 2], [2, 3, 4]]), "joined at a vertex");
        assert!(!is_disc(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]), "three along an edge");
        assert!(!is_disc(&[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]), "a sphere");
        let ring = [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4], [2, 0, 5], [0, 3, 5]];
        assert!(!is_disc(&ring), "a ring");
        let pinched = [[0, 1, 4], [1, 2, 4], [2, 5, 6], [2, 6, 0], [0, 4, 7]];
        assert!(!is_disc(&pinched), "pinched at 2, though of the right characteristic or connected otherwise");
    }
}
