//! How many texels one hair may span.

use pelage_strand::{Strand, StrandTile};

use crate::{MAX_TEXELS, VolumeError};

/// Refuses a tile with a strand whose window, so many `texels` a tile side along the two axes, would not fit the bound on working memory: hair made elsewhere may
/// run on for a million tiles.
pub(crate) fn check_extents(tile: &StrandTile, texels: [f64; 2], axes: [usize; 2]) -> Result<(), VolumeError> {
    for (strand, hair) in tile.strands().enumerate() {
        let sides = [0, 1].map(|k| (texels[k] * extent(&hair, axes[k])).ceil() + 1.0);
        let asked = sides[0] * sides[1];
        if asked > MAX_TEXELS as f64 {
            return Err(VolumeError::StrandTooWide { strand, asked, limit: MAX_TEXELS });
        }
    }
    Ok(())
}

/// From end to end along an axis, its thickness included, in tile sides.
fn extent(hair: &Strand<'_>, axis: usize) -> f64 {
    let ends = hair.points.iter().zip(hair.radii).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (point, &radius)| {
        let (place, radius) = (f64::from(point[axis]), f64::from(radius));
        (low.min(place - radius), high.max(place + radius))
    });
    (ends.1 - ends.0).max(0.0)
}
