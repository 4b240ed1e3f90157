//! Free strands: each hair whole, wherever its root stands.

use glam::DVec2;

use super::track::Track;
use super::{Laid, Layer, Room, copy_of, moved, not_negative};
use crate::face::FaceMap;
use crate::hair::Piece;

impl Layer<'_> {
    /// Lays every copy of a strand whose root is on the face, whole: its way over the surface goes on as the face's own map has it, its curve is that at the root.
    pub(super) fn free(&self, face: usize, map: &FaceMap, laid: &mut Laid, room: &Room) {
        let patch = self.patch_of(face);
        let corners = self.skin.coat.patches.faces[face];
        let (low, high) = map.bounds();
        for pieces in self.hair.strands() {
            let Some(first) = pieces.first() else { continue };
            let root = first.places[0];
            let range = |axis: usize| ((low - root)[axis].ceil() as i64, (high - root)[axis].floor() as i64);
            let ((left, right), (bottom, top)) = (range(0), range(1));
            for tiles in (bottom..=top).flat_map(|y| (left..=right).map(move |x| [x, y])) {
                if room.is_left(laid) && is_on(map, corners, moved(root, tiles)) {
                    self.strand(face, map, pieces, (tiles, copy_of(patch, first.strand, tiles)), laid);
                }
            }
        }
    }

    fn strand(&self, face: usize, map: &FaceMap, pieces: &[Piece], (tiles, copy): ([i64; 2], u32), laid: &mut Laid) {
        let root = map.barycentric(moved(pieces[0].places[0], tiles));
        let (end, growth) = (root.dot(map.ends.into()), root.dot(map.growths.into()));
        let mix = root.dot(map.mixes.into());
        if growth <= 0.0 || !self.hair.stands_between(pieces[0].strand, mix, mix) {
            return;
        }
        let sheet = map.sheet.with_curve_of(root);
        for piece in pieces {
            let beta = piece.places.map(|place| map.barycentric(moved(place, tiles)));
            let track = Track { map, sheet: &sheet, piece, beta, rooted: Some(root), inside: None, face: face as u32, copy };
            let top = end.min(1.0);
            let [low, high] = [not_negative(piece.heights), not_negative(piece.heights.map(|height| top - height))];
            track.lay([low[0].max(high[0]), low[1].min(high[1])], self.tolerance, laid);
        }
    }
}

/// Whether a place of the tile plane is on a face. A place on the edge of two is on exactly one of them: for both the same number is compared with nothing, as
/// an edge is looked at from its lower patch vertex.
fn is_on(map: &FaceMap, patch_vertices: [u32; 3], place: DVec2) -> bool {
    (0..3).all(|k| {
        let next = (k + 1) % 3;
        let forward = patch_vertices[k] < patch_vertices[next];
        let (from, to) = if forward { (map.corners[k], map.corners[next]) } else { (map.corners[next], map.corners[k]) };
        let left = (to - from).perp_dot(place - from) >= 0.0;
        // On the left of the edge as the face runs along it; a face that is turned over runs the other way.
        left == (forward == map.is_anticlockwise())
    })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::face::Skin;
    use crate::fixture::square;

    #[test]
    fn a_root_on_an_edge_stands_on_one_face() {
        let coat = square(4, 2.0);
        let skin = Skin { coat: &coat, length_scale: 1.0 };
        // A lattice with many places on edges and vertices, kept off the rim.
        for place in (1..32).flat_map(|x| (1..32).map(move |y| DVec2::new(f64::from(x), f64::from(y)) / 16.0)) {
            let on = |face: &usize| is_on(&skin.map(*face).unwrap(), coat.patches.faces[*face], place);
            assert_eq!((0..coat.patches.faces.len()).filter(on).count(), 1, "{place}");
        }
    }

    #[test]
    fn barycentric_coordinates_are_the_face_s() {
        let coat = square(4, 2.0);
        let map = Skin { coat: &coat, length_scale: 1.0 }.map(7).unwrap();
        let beta = DVec3::new(0.2, 0.3, 0.5);
        let place = map.corners[0] * beta.x + map.corners[1] * beta.y + map.corners[2] * beta.z;
        assert!(map.barycentric(place).abs_diff_eq(beta, 1e-12));
        assert!((map.side(0.0) - 0.5).abs() < 1e-6);
    }
}
