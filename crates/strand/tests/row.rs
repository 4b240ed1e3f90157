//! Coats in a row: how much hair of which stands where.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pelage_strand::{GrowSettings, StrandError, StrandTile, Undercoat, grow};
use proptest::prelude::*;

fn tile(count: u32, height: f64, seed: u64) -> StrandTile {
    let undercoat = Undercoat { count: 0, ..Undercoat::default() };
    grow(&GrowSettings { count, height, seed, steps: 4, undercoat, ..GrowSettings::default() }).unwrap()
}

#[test]
fn at_whole_places_there_is_the_hair_of_one_coat() {
    let tiles = [tile(40, 0.3, 1), tile(25, 0.3, 2), tile(60, 0.3, 3)];
    let row = StrandTile::row(&[&tiles[0], &tiles[1], &tiles[2]]).unwrap();
    assert_eq!(row.coats(), 3);
    for (place, one) in tiles.iter().enumerate() {
        let at = row.at(place as f64);
        let stretch = (row.height() / one.height()) as f32;
        assert_eq!(at.coats(), 1);
        for (a, b) in at.strands().zip(one.strands()) {
            assert_eq!((a.radii, a.root_colour, a.tip_colour, a.cell), (b.radii, b.root_colour, b.tip_colour, b.cell));
            assert!(a.points.iter().zip(b.points).all(|(p, q)| p[..2] == q[..2] && (p[2] - q[2] * stretch).abs() < 1e-6));
        }
        assert_eq!(at.strand_count(), one.strand_count());
    }
}

#[test]
fn a_row_of_a_row_is_one_row() {
    let [a, b, c] = [tile(40, 0.3, 1), tile(25, 0.3, 2), tile(60, 0.3, 3)];
    let flat = StrandTile::row(&[&a, &b, &c]).unwrap();
    let (first, last) =
        (StrandTile::row(&[&StrandTile::row(&[&a, &b]).unwrap(), &c]), StrandTile::row(&[&a, &StrandTile::row(&[&b, &c]).unwrap()]));
    for nested in [first.unwrap(), last.unwrap()] {
        assert_eq!((nested.coats(), nested.strand_count()), (flat.coats(), flat.strand_count()));
        for (a, b) in nested.strands().zip(flat.strands()) {
            assert_eq!((a.radii, a.cell), (b.radii, b.cell));
            assert!(a.stands.iter().zip(b.stands).all(|(p, q)| *p == q || (p - q).abs() < 1e-5), "{:?} {:?}", a.stands, b.stands);
            // Stretched twice, heights may round another way.
            assert!(a.points.iter().zip(b.points).all(|(p, q)| p[..2] == q[..2] && (p[2] - q[2]).abs() < 1e-6));
        }
    }
}

#[test]
fn boxes_are_stretched_to_the_highest() {
    let (low, high) = (tile(30, 0.1, 1), tile(30, 0.8, 2));
    let row = StrandTile::row(&[&low, &high]).unwrap();
    let top = |tile: &StrandTile| tile.strands().flat_map(|strand| strand.points.iter().map(|p| p[2])).fold(0.0, f32::max);
    assert_eq!(row.height(), high.height());
    assert!((top(&row.at(0.0)) - top(&row.at(1.0))).abs() < 1e-6);
}

#[test]
fn beyond_its_ends_a_row_is_as_at_them() {
    let row = StrandTile::row(&[&tile(40, 0.3, 1), &tile(25, 0.3, 2)]).unwrap();
    assert_eq!(row.at(-3.0), row.at(0.0));
    assert_eq!(row.at(f64::NAN), row.at(0.0));
    assert_eq!(row.at(f64::INFINITY), row.at(1.0));
}

#[test]
fn a_row_of_nothing_and_one_too_long_are_refused() {
    assert_eq!(StrandTile::row(&[]), Err(StrandError::NoTiles));
    let one = tile(1 << 10, 0.3, 1);
    let many = vec![&one; (1 << 10) + 1];
    assert!(matches!(StrandTile::row(&many), Err(StrandError::TooManyStrands { .. })));
}

proptest! {
    /// The number of hairs goes evenly from the one to the other, wherever in a population one looks; no hair comes back that has gone.
    #[test]
    fn density_is_kept(first in 50_u32..400, second in 50_u32..400, place in 0.0..1.0_f64) {
        let (a, b) = (tile(first, 0.3, 1), tile(second, 0.3, 2));
        let row = StrandTile::row(&[&a, &b]).unwrap();
        let standing = |range: std::ops::Range<usize>| row.strands().skip(range.start).take(range.len()).filter(|strand| strand.stands_at(place)).count() as f64;
        let (first, second) = (first as usize, second as usize);
        for (range, share) in [(0..first, 1.0 - place), (first / 2..first, 1.0 - place), (first..first + second, place), (first..first + second / 3, place)] {
            let (len, found) = (range.len() as f64, standing(range));
            prop_assert!((found - share * len).abs() <= 3.0, "{found} of {}", share * len);
        }
        for strand in row.strands() {
            prop_assert!(strand.stands[0] < strand.stands[1]);
        }
    }
}
