//! Two tiles of hair in one: two coats of different types.

use crate::error::StrandError;
use crate::settings::check_size;
use crate::tile::StrandTile;

/// The hairs of two tiles in one box as high as the higher: down of one type under guard hairs of another, or two types side by side.
///
/// Of each a share from 0 to 1 is kept: of guard hairs and of undercoat alike, those that stand evenly. Each hair stays as it is, bit for bit, those of the
/// first before those of the second. Tiles grown by one seed have their roots in the same places: give them two. Hairs of the one do not feel those of the
/// other.
///
/// ```
/// use pelage_strand::{GrowSettings, mix, grow};
///
/// let one = grow(&GrowSettings { count: 40, ..GrowSettings::default() })?;
/// let other = grow(&GrowSettings { count: 100, height: 0.2, seed: 3, ..GrowSettings::default() })?;
/// let both = mix([&one, &other], [1.0, 0.25])?;
/// assert_eq!(both.strand_count(), 40 + 3200 + 25 + 800);
/// # Ok::<(), pelage_strand::StrandError>(())
/// ```
///
/// # Errors
/// A share out of range, coats in a row (mix the hair of each first), or more strands or points than a tile holds.
pub fn mix(tiles: [&StrandTile; 2], shares: [f64; 2]) -> Result<StrandTile, StrandError> {
    for (name, share) in ["first share", "second share"].into_iter().zip(shares) {
        if !(0.0..=1.0).contains(&share) {
            return Err(StrandError::OutOfRange { name, value: share, low: 0.0, high: 1.0, unit: "of its hairs" });
        }
    }
    if let Some(row) = tiles.into_iter().find(|tile| tile.coats() > 1) {
        return Err(StrandError::OutOfRange { name: "coats", value: f64::from(row.coats()), low: 1.0, high: 1.0, unit: "in a row" });
    }
    let kept: Vec<(&StrandTile, std::ops::Range<usize>)> = tiles
        .into_iter()
        .zip(shares)
        .flat_map(|(tile, share)| {
            tile.populations().map(move |range| {
                let end = range.start + (range.len() as f64 * share).round() as usize;
                (tile, range.start..end)
            })
        })
        .collect();
    let points = |(tile, range): &(&StrandTile, std::ops::Range<usize>)| -> u64 {
        u64::from(tile.offsets.get(range.end).copied().unwrap_or_default() - tile.offsets.get(range.start).copied().unwrap_or_default())
    };
    check_size(kept.iter().map(|(_, range)| range.len() as u64).sum(), kept.iter().map(points).sum())?;
    let box_of = |share_too: bool| {
        let high = tiles.into_iter().zip(shares).filter(|(tile, share)| !share_too || (*share > 0.0 && tile.strand_count() > 0));
        high.map(|(tile, _)| tile.height()).fold(0.0, f64::max)
    };
    let height = box_of(true);
    let mut both = StrandTile::empty(if height > 0.0 { height } else { box_of(false) });
    for (tile, range) in &kept {
        range.clone().filter_map(|index| tile.strand(index)).for_each(|strand| both.push_strand(&strand));
    }
    both.set_populations(&kept.iter().map(|(_, range)| range.len() as u32).collect::<Vec<u32>>());
    Ok(both)
}
