//! Shell space: hair as infinitely many shells of infinite resolution would draw it, cut at the outlines of patches.
//!
//! A face shows what is inside of its own part of shell space: over the face, under the hair's end and the outermost shell. So the axes laid on it are those that are inside or no further
//! outside than the hair is thick, and rays meet what of a hair is inside (`clip.rs`). Neighbouring faces of a patch go on with the same hair.

use super::track::Track;
use super::{Edges, Laid, Layer, Room, copy_of, moved, not_negative};
use crate::face::{FaceMap, Margins};

impl Layer<'_> {
    /// Lays what of every copy of the tile's hair reaches over the face.
    pub(super) fn shell(&self, face: usize, map: &FaceMap, laid: &mut Laid, room: &Room) {
        let patch = self.patch_of(face);
        let thickest = self.hair.thickest();
        let margins = if self.edges == Edges::Bodies { map.margins(thickest) } else { Margins::default() };
        let (low, high) = map.bounds_with(&margins);
        let (least, most) = map.mix_range();
        self.hair.around(low, high, |piece, tiles| {
            // Where exactly a hair ends between two coats rays find out.
            if room.is_left(laid) && self.hair.stands_between(piece.strand, least, most) {
                let beta = piece.places.map(|place| map.barycentric(moved(place, tiles)));
                let copy = copy_of(patch, piece.strand, tiles);
                let margins = margins.scaled(piece.radii[0].max(piece.radii[1]) / thickest.max(f64::MIN_POSITIVE));
                let track = Track { map, sheet: &map.sheet, piece, beta, rooted: None, inside: Some(margins), face: face as u32, copy };
                track.lay(over_face(map, &track, &margins), self.tolerance, laid);
            }
        });
    }
}

/// The part of a piece that is over the face, in the box, and not cut off, or less than the margins outside: each bound is linear on the way.
fn over_face(map: &FaceMap, track: &Track<'_>, margins: &Margins) -> [f64; 2] {
    let heights = track.piece.heights;
    let beta = |k: usize| track.beta.map(|beta| beta[k] + margins.beta[k]);
    let end = track.beta.map(|beta| beta.dot(map.ends.into()));
    let under = [0, 1].map(|k| end[k] - heights[k] + margins.height);
    let bounds = [
        beta(0),
        beta(1),
        beta(2),
        heights.map(|height| height + margins.height),
        heights.map(|height| 1.0 - height + margins.height),
        under,
    ];
    let part = bounds.into_iter().map(not_negative).fold([0.0f64, 1.0f64], |[from, to], [a, b]| [from.max(a), to.min(b)]);
    // Where the skin is bare along the whole way there is no hair.
    let growth = |at: f64| track.beta[0].lerp(track.beta[1], at).dot(map.growths.into());
    if part.map(growth).iter().all(|&growth| growth <= 0.0) { [1.0, 0.0] } else { part }
}
