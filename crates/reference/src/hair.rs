//! The tile's hair as straight pieces, and where on the torus they are.

use glam::DVec2;
use pelage_strand::{Strand, StrandTile};

use crate::ReferenceError;

/// The box around a straight piece of hair may cover so many tiles.
const MOST_TILES_CROSSED: f64 = 4096.0;

/// A straight piece of a strand, on the strand's own tile plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) strand: u32,
    /// Where it begins and ends in the tile plane.
    pub(crate) places: [DVec2; 2],
    /// How high, in heights of the box.
    pub(crate) heights: [f64; 2],
    /// Half its width, in tile sides.
    pub(crate) radii: [f64; 2],
    /// How far along the strand, 0 at the root, 1 at the tip.
    pub(crate) along: [f64; 2],
}

impl Piece {
    /// How many tiles the box around it covers.
    fn tiles(&self) -> f64 {
        (self.places[1] - self.places[0]).abs().element_product()
    }
}

/// All pieces of a tile, strand by strand, and a grid that finds them.
#[derive(Debug)]
pub(crate) struct Hair {
    pub(crate) pieces: Vec<Piece>,
    /// Where each strand's pieces end.
    ends: Vec<u32>,
    grid: Grid,
    thickest: f64,
    /// From where and up to where in the row of coats each strand stands, and how many coats follow the first.
    stands: Vec<[f64; 2]>,
    transitions: f64,
}

impl Hair {
    /// The pieces of a tile; points that the line between others passes within `tolerance` radii are left out.
    ///
    /// # Errors
    /// A piece that runs across more tiles than could be listed.
    pub(crate) fn of(tile: &StrandTile, tolerance: f64) -> Result<Self, ReferenceError> {
        let mut pieces = Vec::new();
        let mut ends = Vec::with_capacity(tile.strand_count());
        for (number, strand) in tile.strands().enumerate() {
            cut(&strand, number as u32, tile.height(), tolerance, &mut pieces);
            ends.push(pieces.len() as u32);
        }
        if let Some(long) = pieces.iter().find(|piece| piece.tiles() > MOST_TILES_CROSSED) {
            return Err(ReferenceError::LongStrand { strand: long.strand as usize, tiles: long.tiles(), limit: MOST_TILES_CROSSED });
        }
        let grid = Grid::of(&pieces);
        let thickest = pieces.iter().flat_map(|piece| piece.radii).fold(0.0, f64::max);
        let stands = tile.strands().map(|strand| strand.stands.map(f64::from)).collect();
        Ok(Self { pieces, ends, grid, thickest, stands, transitions: f64::from(tile.coats() - 1) })
    }

    /// Whether a strand stands anywhere between two mixes, each 0 at the first coat and 1 at the last.
    pub(crate) fn stands_between(&self, strand: u32, least: f64, most: f64) -> bool {
        let place = |mix: f64| mix.clamp(0.0, 1.0) * self.transitions;
        self.stands.get(strand as usize).is_none_or(|&[from, to]| from <= place(most) && place(least) < to)
    }

    /// The pieces of each strand, from root to tip.
    pub(crate) fn strands(&self) -> impl Iterator<Item = &[Piece]> {
        let mut from = 0;
        self.ends.iter().map(move |&end| {
            let range = from..end as usize;
            from = end as usize;
            &self.pieces[range]
        })
    }

    /// The largest radius, in tile sides.
    pub(crate) fn thickest(&self) -> f64 {
        self.thickest
    }

    /// Calls `visit` with every piece whose box touches the box from `low` to `high` of the tile plane, and by how many tiles it is to be moved; each once.
    pub(crate) fn around(&self, low: DVec2, high: DVec2, mut visit: impl FnMut(&Piece, [i64; 2])) {
        self.grid.around(&self.pieces, low, high, &mut visit);
    }
}

fn cut(strand: &Strand<'_>, number: u32, height: f64, tolerance: f64, pieces: &mut Vec<Piece>) {
    let last = strand.points.len().saturating_sub(1);
    let mut from = 0;
    while from < last {
        let to = reach(strand, from, last, tolerance);
        let at = |index: usize| DVec2::new(f64::from(strand.points[index][0]), f64::from(strand.points[index][1]));
        pieces.push(Piece {
            strand: number,
            places: [at(from), at(to)],
            heights: [from, to].map(|index| f64::from(strand.points[index][2]) / height),
            radii: [from, to].map(|index| f64::from(strand.radii[index])),
            along: [from, to].map(|index| index as f64 / last as f64),
        });
        from = to;
    }
}

/// How far a straight piece from a point may go.
fn reach(strand: &Strand<'_>, from: usize, last: usize, tolerance: f64) -> usize {
    (from + 2..=last).take_while(|&to| is_straight(strand, from, to, tolerance)).last().unwrap_or(from + 1)
}

/// Whether the points between two are where the line between these has them, and as thick.
fn is_straight(strand: &Strand<'_>, from: usize, to: usize, tolerance: f64) -> bool {
    let value = |index: usize, axis: usize| f64::from(if axis < 3 { strand.points[index][axis] } else { strand.radii[index] });
    let allowed = tolerance * value(from, 3).max(value(to, 3));
    (from + 1..to).all(|index| {
        let part = (index - from) as f64 / (to - from) as f64;
        let off = |axis: usize| value(from, axis) + (value(to, axis) - value(from, axis)) * part - value(index, axis);
        let away = (off(0).powi(2) + off(1).powi(2) + off(2).powi(2)).sqrt();
        away <= allowed && off(3).abs() <= allowed
    })
}

/// Square cells over the torus, each with the pieces whose boxes touch it.
#[derive(Debug)]
struct Grid {
    side: i64,
    starts: Vec<u32>,
    members: Vec<Member>,
}

/// A piece in a cell of the plane; the cell's remainder on the torus is where it is listed.
#[derive(Clone, Copy, Debug, Default)]
struct Member {
    piece: u32,
    cell: [i32; 2],
}

/// Most cells along a side.
const FINEST: f64 = 256.0;

impl Grid {
    fn of(pieces: &[Piece]) -> Self {
        let run: f64 = pieces.iter().map(|piece| (piece.places[1] - piece.places[0]).abs().max_element()).sum();
        let count = pieces.len().max(1) as f64;
        // Cells about as wide as a piece is long, not more of them than pieces, and about four for each piece at most.
        let area: f64 = pieces.iter().map(Piece::tiles).sum();
        let side = (count / run.max(1e-9)).min(count.sqrt()).min((4.0 * count / area.max(1e-9)).sqrt()).clamp(1.0, FINEST).floor() as i64;
        let mut grid = Self { side, starts: vec![0; (side * side) as usize + 1], members: Vec::new() };
        grid.each_cell(pieces, |starts, home, _| starts[home + 1] += 1);
        for cell in 1..grid.starts.len() {
            grid.starts[cell] += grid.starts[cell - 1];
        }
        let mut members = vec![Member::default(); grid.starts[grid.starts.len() - 1] as usize];
        let mut next = grid.starts.clone();
        grid.each_cell(pieces, |_, home, member| {
            members[next[home] as usize] = member;
            next[home] += 1;
        });
        Self { members, ..grid }
    }

    fn each_cell(&mut self, pieces: &[Piece], mut visit: impl FnMut(&mut [u32], usize, Member)) {
        for (number, piece) in pieces.iter().enumerate() {
            let (low, high) = self.cells(piece.places[0].min(piece.places[1]), piece.places[0].max(piece.places[1]));
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let home = self.home(x, y);
                    visit(&mut self.starts, home, Member { piece: number as u32, cell: [x as i32, y as i32] });
                }
            }
        }
    }

    /// The cells of the plane that a box touches.
    fn cells(&self, low: DVec2, high: DVec2) -> ([i64; 2], [i64; 2]) {
        let cell = |c: f64| (c * self.side as f64).floor() as i64;
        ([cell(low.x), cell(low.y)], [cell(high.x), cell(high.y)])
    }

    fn home(&self, x: i64, y: i64) -> usize {
        (y.rem_euclid(self.side) * self.side + x.rem_euclid(self.side)) as usize
    }

    fn around(&self, pieces: &[Piece], low: DVec2, high: DVec2, visit: &mut impl FnMut(&Piece, [i64; 2])) {
        let (first, last) = self.cells(low, high);
        for y in first[1]..=last[1] {
            for x in first[0]..=last[0] {
                let home = self.home(x, y);
                for member in &self.members[self.starts[home] as usize..self.starts[home + 1] as usize] {
                    let piece = &pieces[member.piece as usize];
                    let tiles = [(x - i64::from(member.cell[0])) / self.side, (y - i64::from(member.cell[1])) / self.side];
                    let (from, _) = self.cells(piece.places[0].min(piece.places[1]), piece.places[0].max(piece.places[1]));
                    // Of the cells that both boxes touch, the lowest alone tells of the piece.
                    let lowest = [0, 1].map(|axis| first[axis].max(from[axis] + tiles[axis] * self.side));
                    if [x, y] == lowest {
                        visit(piece, tiles);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage_strand::{GrowSettings, grow};

    #[test]
    fn the_grid_finds_each_piece_once() {
        let tile = grow(&GrowSettings { count: 150, height: 0.9, lean: 40.0, ..GrowSettings::default() }).unwrap();
        let hair = Hair::of(&tile, 0.0).unwrap();
        for (low, high) in [([0.1, 0.2], [0.3, 0.25]), ([-3.7, 5.9], [-2.1, 6.2]), ([0.0, 0.0], [1.0, 1.0]), ([1.5, 1.5], [1.5, 1.5])] {
            let (low, high) = (DVec2::from(low), DVec2::from(high));
            let mut found = Vec::new();
            hair.around(low, high, |piece, tiles| found.push((piece.strand, piece.along.map(f64::to_bits), tiles)));
            let mut wanted = Vec::new();
            for piece in &hair.pieces {
                for tile in (-10..=10).flat_map(|x| (-10..=10).map(move |y| [x, y])) {
                    let moved = piece.places.map(|p| p + DVec2::new(tile[0] as f64, tile[1] as f64));
                    // A cell's width to either side may be told of as well.
                    if (moved[0].min(moved[1])).cmple(high).all() && (moved[0].max(moved[1])).cmpge(low).all() {
                        wanted.push((piece.strand, piece.along.map(f64::to_bits), tile));
                    }
                }
            }
            let count = found.len();
            found.sort_unstable();
            found.dedup();
            assert_eq!(count, found.len(), "a piece twice");
            assert!(wanted.iter().all(|piece| found.binary_search(piece).is_ok()), "a piece is missing of {}", wanted.len());
            assert!(!wanted.is_empty());
        }
    }

    #[test]
    fn pieces_keep_to_the_strand() {
        let tile = grow(&GrowSettings { count: 100, ..GrowSettings::default() }).unwrap();
        let (fine, coarse) = (Hair::of(&tile, 0.0).unwrap(), Hair::of(&tile, 0.1).unwrap());
        assert_eq!(fine.pieces.len(), tile.point_count() - tile.strand_count());
        assert!(coarse.pieces.len() * 2 < fine.pieces.len(), "{} of {}", coarse.pieces.len(), fine.pieces.len());
        for (number, pieces) in coarse.strands().enumerate() {
            let strand = tile.strand(number).unwrap();
            let last = strand.points.len() - 1;
            for (index, point) in strand.points.iter().enumerate() {
                let along = index as f64 / last as f64;
                let piece = pieces.iter().find(|piece| along <= piece.along[1]).unwrap();
                let part = (along - piece.along[0]) / (piece.along[1] - piece.along[0]);
                let at = piece.places[0].lerp(piece.places[1], part);
                let off = at - DVec2::new(f64::from(point[0]), f64::from(point[1]));
                assert!(off.length() <= 0.1 * piece.radii[0].max(piece.radii[1]) + 1e-7);
            }
        }
    }
}
