//! How many layers hair wants.

use pelage_strand::StrandTile;

use crate::shells::MOST_LAYERS;

/// The layers from which a tile's sections, seen along a line that runs `slope` aside for each tile side it rises, overlap instead of leaving gaps.
///
/// Layers Δ apart show a hair as sections Δ·slope apart, so they meet where that is no more than the hair is wide: N = 1 + height·slope / (2 · mean radius),
/// the radius averaged over the hairs' heights. Fewer layers let more light through than the strands do ([`StrandTile::transmittance`]), unless hair is so
/// close that nothing passes it anyway. From 2 to the most layers there are; that, too, where more would be wanted.
pub fn layers_for(tile: &StrandTile, slope: f64) -> u32 {
    let (mut risen, mut shown) = (0.0f64, 0.0f64);
    for strand in tile.strands() {
        for (points, radii) in strand.points.windows(2).zip(strand.radii.windows(2)) {
            let rise = f64::from((points[1][2] - points[0][2]).abs());
            risen += rise;
            shown += rise * 0.5 * f64::from(radii[0] + radii[1]);
        }
    }
    let wanted = 1.0 + (tile.height() * slope.abs() * risen / (2.0 * shown)).ceil();
    // No hair wants no layers: 0/0 is NaN, which `max` drops.
    wanted.max(2.0).min(f64::from(MOST_LAYERS)) as u32
}
