//! Several coats in a row on one creature: which hairs stand where one becomes the next (L24).
//!
//! Where a coat becomes the next, some hairs of the one stand and some of the other, each whole: that is how it is on an animal, and how many there are goes evenly from the one number to the
//! other. Each hair has a place in the row from which, and one up to which, it stands.

use crate::error::StrandError;
use crate::settings::check_size;
use crate::tile::StrandTile;

/// The golden ratio less 1: its multiples, whole numbers dropped, fill 0 to 1 evenly however many there are (Weyl).
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Where in the row a hair stands that is there wherever its tile is.
pub(crate) const EVERYWHERE: [f32; 2] = [f32::NEG_INFINITY, f32::INFINITY];

impl StrandTile {
    /// The hair of several tiles as coats in a row: at place 0 of the row all hair of the first stands and no other, at 1 that of the second, and so on; half way between
    /// two, half the hairs of either. A tile that is a row itself adds all its coats.
    ///
    /// Boxes of different height are stretched to the highest, as each is again when it is laid on a surface.
    ///
    /// ```
    /// use pelage_strand::{GrowSettings, StrandTile, grow};
    ///
    /// let short = grow(&GrowSettings { count: 300, ..GrowSettings::default() })?;
    /// let mane = grow(&GrowSettings { count: 100, height: 0.8, seed: 4, ..GrowSettings::default() })?;
    /// let both = StrandTile::row(&[&short, &mane])?;
    /// assert_eq!(both.coats(), 2);
    /// assert_eq!(both.at(0.0).strand_count(), short.strand_count());
    /// assert_eq!(both.at(1.0).strand_count(), mane.strand_count());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// No tile at all, or more strands or points than a tile holds.
    pub fn row(tiles: &[&Self]) -> Result<Self, StrandError> {
        let height = tiles.iter().map(|tile| tile.height()).reduce(f64::max).ok_or(StrandError::NoTiles)?;
        check_size(tiles.iter().map(|tile| tile.strand_count() as u64).sum(), tiles.iter().map(|tile| tile.point_count() as u64).sum())?;
        let coats: u32 = tiles.iter().map(|tile| tile.coats()).sum();
        let mut row = Self::empty(height);
        row.transitions = coats - 1;
        let mut before = 0;
        for tile in tiles {
            let last = before + tile.transitions;
            row.append(tile, |rank, [from, to]| {
                let enters = if before == 0 { f64::NEG_INFINITY } else { f64::from(before) - 1.0 + rank };
                let leaves = if last + 1 == coats { f64::INFINITY } else { f64::from(last) + rank };
                let within = |place: f32| f64::from(place) + f64::from(before);
                [if from.is_finite() { within(from) } else { enters }, if to.is_finite() { within(to) } else { leaves }]
            });
            before = last + 1;
        }
        let populations: Vec<u32> = tiles.iter().flat_map(|tile| tile.populations()).map(|range| range.len() as u32).collect();
        row.set_populations(&populations);
        Ok(row)
    }

    /// How many coats are in the row; 1 for hair that was grown.
    pub fn coats(&self) -> u32 {
        self.transitions + 1
    }

    /// The hair that stands at a place in the row of coats, from 0 to one less than their number; beyond its ends, and for NaN, as at the nearer end or the first.
    #[must_use]
    pub fn at(&self, place: f64) -> Self {
        let place = place.max(0.0).min(f64::from(self.transitions));
        let mut tile = Self::empty(self.height);
        let mut populations = Vec::new();
        for population in self.populations() {
            let before = tile.strand_count();
            for index in population {
                if self.strand(index).is_some_and(|strand| strand.stands_at(place)) {
                    tile.copy(self, index, 1.0, EVERYWHERE);
                }
            }
            populations.push((tile.strand_count() - before) as u32);
        }
        // Of a coat alone there is nothing left of the others.
        populations.retain(|&count| count > 0);
        tile.set_populations(&populations);
        tile
    }

    /// Appends all strands of a tile; `stands` says of each, by its rank from 0 to 1 and where it stood, where it stands now.
    fn append(&mut self, tile: &Self, stands: impl Fn(f64, [f32; 2]) -> [f64; 2]) {
        let stretch = self.height / tile.height.max(f64::MIN_POSITIVE);
        for (index, strand) in tile.strands().enumerate() {
            // A hair that came by its rank goes by it.
            let known = strand.stands.into_iter().find(|place| place.is_finite());
            let rank = known.map_or(((index as f64 + 0.5) * GOLDEN).fract(), |place| f64::from(place).rem_euclid(1.0));
            self.copy(tile, index, stretch, stands(rank, strand.stands).map(|place| place as f32));
        }
    }
}
