//! Shell space: hair as infinitely many shells of infinite resolution would draw it, cut at the outlines of patches.

use super::track::Track;
use super::{Laid, Layer, Room, copy_of, moved, not_negative};
use crate::face::FaceMap;
use crate::hair::Piece;

impl Layer<'_> {
    /// Lays what of every copy of the tile's hair is over the face.
    pub(super) fn shell(&self, face: usize, map: &FaceMap, laid: &mut Laid, room: &Room) {
        let patch = self.patch_of(face);
        let (low, high) = map.bounds();
        self.hair.around(low, high, |piece, tiles| {
            if room.is_left(laid) {
                let beta = piece.places.map(|place| map.barycentric(moved(place, tiles)));
                let copy = copy_of(patch, piece.strand, tiles);
                let track = Track { map, sheet: &map.sheet, piece, beta, rooted: None, face: face as u32, copy };
                track.lay(over_face(map, &track, piece), self.tolerance, laid);
            }
        });
    }
}

/// The part of a piece that is over the face, inside the box, and not cut off: each bound is linear on the way.
fn over_face(map: &FaceMap, track: &Track<'_>, piece: &Piece) -> [f64; 2] {
    let beta = |k: usize| track.beta.map(|beta| beta[k]);
    let end = track.beta.map(|beta| map.ends[0] * beta.x + map.ends[1] * beta.y + map.ends[2] * beta.z);
    let under = [0, 1].map(|k| end[k] - piece.heights[k]);
    let bounds = [beta(0), beta(1), beta(2), piece.heights, piece.heights.map(|height| 1.0 - height), under];
    let part = bounds.into_iter().map(not_negative).fold([0.0f64, 1.0f64], |[from, to], [a, b]| [from.max(a), to.min(b)]);
    // Where the skin is bare along the whole way there is no hair.
    let growth = |at: f64| track.beta[0].lerp(track.beta[1], at).dot(map.growths.into());
    if part.map(growth).iter().all(|&growth| growth <= 0.0) { [1.0, 0.0] } else { part }
}
