//! What holds by construction, on meshes of many kinds.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a test stops where it fails and says what it did not try")]

mod common;

use glam::{DVec2, DVec3};
use pelage_mesh::{Mesh, plane, rounded_die, sphere, torus};
use pelage_patch::{Settings, grow};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

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
    let mut worst = 0.0_f64;
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
            worst = worst.max((tiling.coordinates()[v] - flat(v) - shift).length());
        }
    }
    println!("reached: within {worst:.0e} tiles");
    assert!(worst < 1e-5, "{worst}");
}

/// Without a field a plane keeps every distance.
#[test]
fn plane_is_reproduced_without_a_field() {
    let mesh = plane(2.0, 2.0, 40, 40).unwrap();
    let settings = Settings { patch_extent: 9.0, ..Settings::with_tile_side(0.25) };
    let tiling = common::tile(&mesh, None, &settings);
    let mut worst = 0.0_f64;
    for patch in tiling.patches() {
        let first = patch.vertices().start;
        for v in patch.vertices() {
            let wanted = mesh.vertex(tiling.vertices()[v]).position().distance(mesh.vertex(tiling.vertices()[first]).position()) / 0.25;
            worst = worst.max((tiling.coordinates()[v].distance(tiling.coordinates()[first]) - wanted).abs());
        }
    }
    println!("reached: within {worst:.0e} tiles");
    assert!(worst < 1e-5, "{worst}");
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
    let mut most = 0.0_f64;
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
                most = most.max(worst);
            }
        }
    }
    println!("reached: the same patches, coordinates within {most:.0e} tiles");
}

/// The model may lie as far off as ten million times its size: it is tiled as at home, also a regular one, of which rounding makes unequal what is equal.
#[test]
fn an_offset_changes_nothing() {
    let far = |mesh: &Mesh| 1e7 * mesh.diameter() * DVec3::new(1.0, -0.7, 0.3);
    let primitives = [sphere(1.0, 12).unwrap(), torus(1.0, 0.3, 40, 16).unwrap(), rounded_die(1.0, 0.3, 12).unwrap()];
    let primitives = primitives.map(|mesh| ("primitive".to_owned(), mesh)).into_iter();
    let real = common::real_models().into_iter().filter(|(_, mesh)| mesh.topology().face_count() < 7000);
    let mut most = 0.0_f64;
    for (name, mesh) in primitives.chain(real) {
        for with_field in [false, true] {
            let tiling_at = |mesh: &Mesh, tile_side: f64| {
                let field = with_field.then(|| common::combed(mesh));
                common::tile(mesh, field.as_ref(), &Settings::with_tile_side(tile_side))
            };
            let side = 0.08 * mesh.diameter();
            let (reference, tiling) = (tiling_at(&mesh, side), tiling_at(&common::moved(&mesh, |p| p + far(&mesh)), side));
            assert_eq!(reference.patches().len(), tiling.patches().len(), "{name}");
            let worst = reference.coordinates().iter().zip(tiling.coordinates()).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(reference.faces() == tiling.faces() && worst < 1e-4, "{name}: {worst}");
            most = most.max(worst);
        }
    }
    println!("reached: the same patches, coordinates within {most:.0e} tiles");
}

/// On 1, 2 and 8 threads at once, to the bit.
#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mesh = sphere(1.0, 10).unwrap();
    let field = common::combed(&mesh);
    let settings = Settings::for_mesh(&mesh);
    let make = || grow(&mesh, Some(&field), &settings).unwrap();
    let reference = make();
    for threads in [1, 2, 8] {
        std::thread::scope(|scope| {
            let runs: Vec<_> = (0..threads).map(|_| scope.spawn(make)).collect();
            for run in runs {
                let tiling = run.join().unwrap();
                assert_eq!(tiling, reference);
                let same = |(a, b): (&DVec2, &DVec2)| a.x.to_bits() == b.x.to_bits() && a.y.to_bits() == b.y.to_bits();
                assert!(tiling.coordinates().iter().zip(reference.coordinates()).all(same));
            }
        });
    }
}

/// A patch may repeat the tile (L4): the extent alone makes patches of several tiles, fewer of them, with hair as large as before; the tile's side alone makes the
/// hair larger, and leaves the patches' number to the extent.
#[test]
fn a_patch_may_repeat_the_tile() {
    for mesh in [plane(1.0, 1.0, 60, 60).unwrap(), torus(1.0, 0.4, 90, 36).unwrap()] {
        let once = Settings { patch_extent: 0.9, ..Settings::with_tile_side(0.08 * mesh.diameter()) };
        let quality = |settings: &Settings| {
            let tiling = common::tile(&mesh, None, settings);
            assert_eq!(tiling.tile_side(), settings.tile_side);
            // The hair's size is the map's scale: coordinates are in tiles, so that areas in them times the tile's are the surface's.
            let area = |corners: [DVec2; 3]| 0.5 * (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]);
            let mapped: f64 = tiling.faces().iter().map(|f| area(f.map(|v| tiling.coordinates()[v as usize]))).sum();
            let scale = mapped * settings.tile_side.powi(2) / mesh.area();
            assert!((scale - 1.0).abs() < 0.05, "{scale}");
            tiling.quality(&mesh, None)
        };
        let (small, large) = (quality(&once), quality(&Settings { patch_extent: 3.0, ..once }));
        let coarse = quality(&Settings { tile_side: 2.0 * once.tile_side, patch_extent: 0.45, ..once });
        assert!(small.tile_repeats_max < 1.8 && large.tile_repeats_p50 > 1.5 && large.tile_repeats_max > 2.5, "{large:?}");
        assert!(2 * large.patch_count < small.patch_count && large.seam_length < 0.7 * small.seam_length);
        assert!(large.stretch_p50 <= 1.15 && large.stretch_p99 <= 2.0);
        assert_eq!(coarse.patch_count, small.patch_count);
        assert!((coarse.tile_repeats_max - 0.5 * small.tile_repeats_max).abs() < 0.2, "{coarse:?}");
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

/// A ball with noise in and out, and some of its faces torn off.
fn noisy_ball() -> impl Strategy<Value = Mesh> {
    (1_u32..9, 0.0..0.4, 0.0..0.3, any::<u64>()).prop_map(|(subdivisions, noise, torn, seed)| {
        let ball = sphere(1.0, subdivisions).unwrap();
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let positions = ball.positions().iter().map(|&p| p * (1.0 + noise * random.random_range(-1.0..1.0))).collect();
        let kept = ball.topology().triangles().filter(|_| random.random_range(0.0..1.0) >= torn).collect();
        common::manifold(positions, kept)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn any_ball_keeps_every_invariant(mesh in noisy_ball(), seed: u64, tile in 0.05..3.0, extent in 0.2..5.0, combed: bool) {
        let field = (combed && mesh.topology().face_count() > 0).then(|| common::combed(&mesh));
        let settings = Settings { seed, patch_extent: extent, ..Settings::with_tile_side(tile) };
        common::tile(&mesh, field.as_ref(), &settings);
    }
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
