//! What holds by construction, on meshes of many kinds.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a test stops where it fails and says what it did not try")]

mod common;

use glam::{DVec2, DVec3};
use pelage_mesh::{Mesh, plane, rounded_die, sphere, torus};
use pelage_patch::{Settings, grow};
use proptest::prelude::*;

#[test]
fn primitives_keep_every_invariant() {
    for mesh in
        [sphere(1.0, 12).unwrap(), torus(1.0, 0.3, 60, 20).unwrap(), rounded_die(2.0, 0.3, 11).unwrap(), plane(3.0, 1.0, 30, 9).unwrap()]
    {
        for seed in 0..4 {
            let settings = Settings { seed, ..Settings::for_mesh(&mesh) };
            common::tile(&mesh, None, &settings);
            common::tile(&mesh, Some(&common::combed(&mesh)), &settings);
        }
    }
}

/// A plane is laid out as it is, turned so that the field (+x) becomes t and the axis left of it seen from above (+z) becomes s.
#[test]
fn plane_is_reproduced_along_the_field() {
    let mesh = plane(2.0, 2.0, 40, 40).unwrap();
    let field = pelage_field::DirectionField::toward(&mesh, DVec3::X).unwrap();
    let settings = Settings { patch_extent: 9.0, ..Settings::with_tile_side(0.25) };
    let tiling = common::tile(&mesh, Some(&field), &settings);
    assert!(tiling.patches().iter().any(|p| p.faces().len() > 500), "patches are large enough to drift");
    for patch in tiling.patches() {
        let flat = |v: usize| {
            let p = mesh.vertex(tiling.vertices()[v]).position();
            DVec2::new(p.z, p.x) / 0.25
        };
        let shift = tiling.coordinates()[patch.vertices().start] - flat(patch.vertices().start);
        for v in patch.vertices() {
            assert!((tiling.coordinates()[v] - flat(v) - shift).length() < 1e-5);
        }
    }
}

/// Without a field a plane keeps every distance.
#[test]
fn plane_is_reproduced_without_a_field() {
    let mesh = plane(2.0, 2.0, 40, 40).unwrap();
    let settings = Settings { patch_extent: 9.0, ..Settings::with_tile_side(0.25) };
    let tiling = common::tile(&mesh, None, &settings);
    for patch in tiling.patches() {
        let first = patch.vertices().start;
        for v in patch.vertices() {
            let wanted = mesh.vertex(tiling.vertices()[v]).position().distance(mesh.vertex(tiling.vertices()[first]).position()) / 0.25;
            assert!((tiling.coordinates()[v].distance(tiling.coordinates()[first]) - wanted).abs() < 1e-5);
        }
    }
}

#[test]
fn same_seed_same_bits_and_another_seed_another_tiling() {
    let mesh = torus(1.0, 0.4, 50, 20).unwrap();
    let field = common::combed(&mesh);
    let settings = Settings::for_mesh(&mesh);
    let first = grow(&mesh, Some(&field), &settings).unwrap();
    let again = std::thread::scope(|scope| scope.spawn(|| grow(&mesh, Some(&field), &settings).unwrap()).join().unwrap());
    assert_eq!(first, again);
    let bits =
        |t: &pelage_patch::PatchTiling| -> Vec<u64> { t.coordinates().iter().flat_map(|c| [c.x.to_bits(), c.y.to_bits()]).collect() };
    assert_eq!(bits(&first), bits(&again));
    let other = grow(&mesh, Some(&field), &Settings { seed: 1, ..settings }).unwrap();
    assert_ne!(first.patch_of_face(), other.patch_of_face());
}

#[test]
fn scale_changes_nothing() {
    for mesh in [sphere(1.0, 10).unwrap(), torus(1.0, 0.3, 40, 16).unwrap(), plane(1.0, 1.0, 20, 20).unwrap()] {
        for with_field in [false, true] {
            let tiling_at = |scale: f64| {
                let mesh = common::moved(&mesh, |p| p * scale);
                let field = with_field.then(|| common::combed(&mesh));
                common::tile(&mesh, field.as_ref(), &Settings::with_tile_side(0.15 * scale))
            };
            let reference = tiling_at(1.0);
            for scale in [1e-30, 1e-15, 1e-3, 7.3, 1e15, 1e30] {
                let tiling = tiling_at(scale);
                assert_eq!(reference.faces(), tiling.faces(), "× {scale}");
                let worst = reference.coordinates().iter().zip(tiling.coordinates()).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
                assert!(worst < 1e-4, "× {scale}: {worst}");
            }
        }
    }
}

/// Patches start at places all over the tile, or all would show the same hairs in their middle.
#[test]
fn patches_show_different_parts_of_the_tile() {
    let mesh = sphere(1.0, 12).unwrap();
    let tiling = common::tile(&mesh, None, &Settings::for_mesh(&mesh));
    let middle = |patch: &pelage_patch::Patch| {
        let corners = tiling.faces()[patch.faces().start].map(|v| tiling.coordinates()[v as usize]);
        (corners[0] + corners[1] + corners[2]) / 3.0
    };
    let mut quarters = [0; 4];
    for patch in tiling.patches() {
        let place = middle(patch).rem_euclid(DVec2::ONE);
        quarters[usize::from(place.x < 0.5) + 2 * usize::from(place.y < 0.5)] += 1;
    }
    assert!(quarters.iter().all(|&count| 8 * count > tiling.patches().len()), "{quarters:?}");
}

/// Twice the extent makes about a quarter of the patches; the tile's side alone, extent times side kept, changes none.
#[test]
fn tile_and_extent_are_apart() {
    let mesh = plane(1.0, 1.0, 60, 60).unwrap();
    let count = |tile_side, patch_extent| {
        let tiling = common::tile(&mesh, None, &Settings { patch_extent, ..Settings::with_tile_side(tile_side) });
        (tiling.patches().len(), tiling.quality(&mesh, None).tile_repeats_max)
    };
    let (fine, repeats) = count(0.05, 2.0);
    let (same, repeats_once) = count(0.1, 1.0);
    let (coarse, _) = count(0.05, 4.0);
    assert_eq!(fine, same);
    assert!(repeats > 2.0 && (repeats_once - 0.5 * repeats).abs() < 0.2);
    assert!((2.5..6.0).contains(&(fine as f64 / coarse as f64)), "{fine} and {coarse}");
}

fn bumpy_grid_with_holes() -> impl Strategy<Value = Mesh> {
    (2_u32..12, 2_u32..12).prop_flat_map(|(columns, rows)| {
        let vertices = ((columns + 1) * (rows + 1)) as usize;
        let faces = (2 * columns * rows) as usize;
        let shifts = prop::collection::vec(prop::array::uniform3(-0.45..0.45), vertices);
        (shifts, prop::collection::vec(0.0..1.0, faces), 0.0..0.4, 0.0..2.0).prop_map(move |(shifts, draws, holes, height)| {
            let place = |k: usize| {
                let (column, row) = (k as u32 % (columns + 1), k as u32 / (columns + 1));
                let [x, y, z] = shifts[k];
                // Some columns fall together, which leaves slivers and faces without area.
                let x = if k % 7 == 3 { 1.0 } else { x };
                DVec3::new(f64::from(column) + x, height * z, f64::from(row) + if k % 7 == 3 { 0.0 } else { y })
            };
            let corners = |cell: u32| {
                let first = cell % columns + cell / columns * (columns + 1);
                let [a, b, c, d] = [first, first + 1, first + columns + 1, first + columns + 2];
                [[a, c, b], [b, c, d]]
            };
            let triangles: Vec<[u32; 3]> = (0..columns * rows).flat_map(corners).collect();
            let kept = triangles.into_iter().zip(&draws).filter(|&(_, &draw)| draw >= holes).map(|(t, _)| t).collect();
            common::manifold((0..vertices).map(place).collect(), kept)
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn any_grid_keeps_every_invariant(mesh in bumpy_grid_with_holes(), seed: u64, tile in 0.2..10.0, extent in 0.2..5.0, combed: bool) {
        let field = (combed && mesh.topology().face_count() > 0).then(|| common::combed(&mesh));
        let settings = Settings { seed, patch_extent: extent, ..Settings::with_tile_side(tile) };
        common::tile(&mesh, field.as_ref(), &settings);
    }
}
