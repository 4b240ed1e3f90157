//! Meshes at the edge of what a mesh can be.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a test stops where it fails and says what it did not try")]

mod common;

use std::f64::consts::TAU;

use common::surfaces::{copies, perforated};
use glam::{DVec2, DVec3};
use pelage_mesh::{Mesh, plane, sphere};
use pelage_patch::{PatchError, PatchTiling, Settings, grow};

fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Mesh {
    Mesh::from_triangles(positions.iter().map(|&p| DVec3::from(p)).collect(), triangles).unwrap()
}

#[test]
fn nothing_gives_nothing() {
    let empty = mesh(&[], &[]);
    let tiling = common::tile(&empty, None, &Settings::with_tile_side(1.0));
    assert!(tiling.patches().is_empty());
}

#[test]
fn one_triangle_is_one_patch() {
    let triangle = mesh(&[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]], &[[0, 1, 2]]);
    for tile in [1e-3, 1.0, 1e3] {
        let tiling = common::tile(&triangle, None, &Settings::with_tile_side(tile));
        let sides = [[0, 1, 3], [1, 2, 5], [2, 0, 4]];
        for [a, b, length] in sides {
            let found = tiling.coordinates()[a].distance(tiling.coordinates()[b]);
            assert!((found * tile - f64::from(length as u32)).abs() < 1e-9);
        }
    }
}

/// A patch is never a sphere: of a tetrahedron three faces join at most.
#[test]
fn closed_surfaces_take_two_patches() {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let tetrahedron = mesh(&corners, &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);
    let loose = Settings { max_stretch: 1e6, patch_extent: 100.0, ..Settings::with_tile_side(1.0) };
    assert_eq!(common::tile(&tetrahedron, None, &loose).patches().len(), 2);
}

/// 5,000 balls of 20 faces: each is tiled by itself, by two patches at least.
#[test]
fn components_are_tiled_apart() {
    let many = copies(&sphere(1.0, 1).unwrap(), 5000, 3.0 * DVec3::X);
    for directions in [None, Some(common::combed(&many))] {
        let tiling = common::tile(&many, directions.as_ref(), &Settings::with_tile_side(1.0));
        assert!(tiling.patches().len() >= 10_000);
        for patch in tiling.patches() {
            let ball = |row: usize| tiling.surface_faces()[row].index() / 20;
            assert!(patch.faces().all(|row| ball(row) == ball(patch.faces().start)));
        }
    }
}

/// Genus 3, 4 and 133: no patch wraps a handle, whatever it may span.
#[test]
fn handles_are_cut_open() {
    for (columns, rows, cuts) in [(3, 1, 4), (2, 2, 4), (19, 7, 1)] {
        let slab = perforated(columns, rows, cuts);
        assert_eq!(slab.topology().euler_characteristic(), 2 - 2 * i64::from(columns * rows));
        let field = common::combed(&slab);
        for (directions, extent, loose) in [(Some(&field), 0.9, 2.0), (None, 0.9, 2.0), (None, 100.0, 1e6)] {
            let settings = Settings { patch_extent: extent, max_stretch: loose, ..Settings::for_mesh(&slab) };
            common::tile(&slab, directions, &settings);
        }
    }
}

/// Valence 3 all over: a tetrahedron, and a ball each of whose faces is split at its middle.
#[test]
fn valence_three() {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let tetrahedron = mesh(&corners, &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);
    let ball = sphere(1.0, 6).unwrap();
    let middles = ball.faces().map(|face| face.centre().normalize());
    let positions: Vec<DVec3> = ball.positions().iter().copied().chain(middles).collect();
    let first = ball.positions().len() as u32;
    let split = |(k, [a, b, c]): (usize, [u32; 3])| {
        let middle = first + k as u32;
        [[a, b, middle], [b, c, middle], [c, a, middle]]
    };
    let triangles: Vec<[u32; 3]> = ball.topology().triangles().enumerate().flat_map(split).collect();
    let split = Mesh::from_triangles(positions, &triangles).unwrap();
    for mesh in [tetrahedron, split] {
        for seed in 0..4 {
            let settings = Settings { seed, ..Settings::for_mesh(&mesh) };
            common::tile(&mesh, Some(&common::combed(&mesh)), &settings);
            common::tile(&mesh, None, &Settings { patch_extent: 5.0, ..settings });
        }
    }
}

/// A strip with a half twist, cut once across so that it can be wound: a disc that lies beside itself.
#[test]
fn a_moebius_strip_cut_once() {
    let (around, across) = (120_u32, 6_u32);
    let place = |k: u32, j: u32| {
        let turn = TAU * f64::from(k) / f64::from(around);
        let (half, out) = (0.5 * turn, f64::from(j) / f64::from(across) - 0.5);
        let radius = 1.0 + 0.6 * out * half.cos();
        DVec3::new(radius * turn.cos(), 0.6 * out * half.sin(), -radius * turn.sin())
    };
    let positions = (0..=around).flat_map(|k| (0..=across).map(move |j| place(k, j))).collect();
    let cell = |k: u32, j: u32| {
        let [a, b, c, d] = [(k, j), (k + 1, j), (k, j + 1), (k + 1, j + 1)].map(|(k, j)| k * (across + 1) + j);
        [[a, b, c], [b, d, c]]
    };
    let triangles: Vec<[u32; 3]> = (0..around).flat_map(|k| (0..across).flat_map(move |j| cell(k, j))).collect();
    let strip = Mesh::from_triangles(positions, &triangles).unwrap();
    assert_eq!(strip.topology().euler_characteristic(), 1);
    for extent in [0.9, 50.0] {
        let settings = Settings { patch_extent: extent, ..Settings::for_mesh(&strip) };
        common::tile(&strip, Some(&common::combed(&strip)), &settings);
        common::tile(&strip, None, &settings);
    }
}

/// A fan of 5,000 faces, flat: one patch if it may be that large, and any number if not.
#[test]
fn high_valence() {
    let rim = (0..5000).map(|k| TAU * f64::from(k) / 5000.0).map(|a| [a.cos(), 0.0, -a.sin()]);
    let positions: Vec<[f64; 3]> = std::iter::once([0.0; 3]).chain(rim).collect();
    let triangles: Vec<[u32; 3]> = (0..5000).map(|k| [0, 1 + k, 1 + (k + 1) % 5000]).collect();
    let fan = mesh(&positions, &triangles);
    let whole = common::tile(&fan, None, &Settings { patch_extent: 10.0, ..Settings::with_tile_side(0.5) });
    assert_eq!(whole.patches().len(), 1);
    common::tile(&fan, Some(&common::combed(&fan)), &Settings::with_tile_side(0.2));
}

/// Gives by how much a distance is off at most, in tiles of side 1.
fn assert_reproduced(mesh: &Mesh, tiling: &PatchTiling) -> f64 {
    assert_eq!(tiling.patches().len(), 1);
    let ends = |v: usize| (mesh.vertex(tiling.vertices()[v]).position(), tiling.coordinates()[v]);
    let off = |v: usize| {
        let ((p, s), (q, t)) = (ends(0), ends(v));
        (p.distance(q) - s.distance(t)).abs()
    };
    let worst = (0..tiling.vertices().len()).map(off).fold(0.0, f64::max);
    assert!(worst < 1e-5, "{worst}");
    worst
}

/// A cone so steep that its 5,000 needles meet at a point: nothing is flipped, and no step is as slow as the whole.
#[test]
fn a_spike_of_valence_5000() {
    let rim = (0..5000).map(|k| TAU * f64::from(k) / 5000.0).map(|a| [0.2 * a.cos(), 0.0, -0.2 * a.sin()]);
    let positions: Vec<[f64; 3]> = std::iter::once([0.0, 1.0, 0.0]).chain(rim).collect();
    let triangles: Vec<[u32; 3]> = (0..5000).map(|k| [0, 1 + k, 1 + (k + 1) % 5000]).collect();
    let spike = mesh(&positions, &triangles);
    common::tile(&spike, Some(&common::combed(&spike)), &Settings::for_mesh(&spike));
    common::tile(&spike, None, &Settings::for_mesh(&spike));
}

/// A square whose middle vertex lies so near to one side that their face is a cap is still reproduced.
#[test]
fn flat_caps_are_reproduced() {
    let mut worst = 0.0_f64;
    for height in [1e-2, 1e-4, 1e-6, 1e-8, 0.0] {
        let corners = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, -2.0], [-1.0, 0.0, -2.0], [0.0, 0.0, -height]];
        let square = mesh(&corners, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]);
        for seed in 0..8 {
            let settings = Settings { seed, patch_extent: 10.0, ..Settings::with_tile_side(1.0) };
            worst = worst.max(assert_reproduced(&square, &common::tile(&square, None, &settings)));
        }
    }
    println!("reached: within {worst:.0e} tiles");
}

/// A flat grid one row of which is squeezed to needles is still reproduced.
#[test]
fn flat_needles_are_reproduced() {
    let mut worst = 0.0_f64;
    for height in [1e-2, 1e-4, 1e-6, 1e-8] {
        let grid = plane(10.0, 10.0, 10, 10).unwrap();
        let squeezed = common::moved(&grid, |p| DVec3::new(if p.x > 0.5 { p.x - 1.0 + height } else { p.x }, p.y, p.z));
        let settings = Settings { patch_extent: 30.0, ..Settings::with_tile_side(1.0) };
        let tiling = common::tile(&squeezed, None, &settings);
        worst = worst.max(assert_reproduced(&squeezed, &tiling));
    }
    println!("reached: within {worst:.0e} tiles");
}

/// Faces without area: collinear corners, two corners in one place, all three in one place. They are covered, finite and counted.
#[test]
fn faces_without_area_are_counted() {
    let grid = plane(4.0, 4.0, 4, 4).unwrap();
    let pinched = common::moved(&grid, |p| if p.x == 0.0 { DVec3::new(1.0, p.y, p.z) } else { p });
    let tiling = common::tile(&pinched, Some(&common::combed(&pinched)), &Settings { patch_extent: 20.0, ..Settings::with_tile_side(1.0) });
    assert_eq!(tiling.quality(&pinched, None).faces_degenerate, 8);
    let point = common::moved(&grid, |_| DVec3::ONE);
    let tiling = common::tile(&point, Some(&common::combed(&point)), &Settings::for_mesh(&point));
    assert_eq!(tiling.quality(&point, None).faces_degenerate, 32);
    let line = common::moved(&grid, |p| DVec3::new(p.x + 0.3 * p.z, 0.0, 0.0));
    let tiling = common::tile(&line, Some(&common::combed(&line)), &Settings::with_tile_side(0.5));
    assert_eq!(tiling.quality(&line, None).faces_degenerate, 32);
}

#[test]
fn settings_out_of_range_are_named() {
    let mesh = sphere(1.0, 2).unwrap();
    let good = Settings::for_mesh(&mesh);
    let wrong = [
        ("tile_side", Settings { tile_side: 0.0, ..good }),
        ("tile_side", Settings { tile_side: f64::NAN, ..good }),
        ("patch_extent", Settings { patch_extent: -1.0, ..good }),
        ("patch_extent", Settings { patch_extent: f64::INFINITY, ..good }),
        ("alignment", Settings { alignment: -0.1, ..good }),
        ("alignment", Settings { alignment: f64::NAN, ..good }),
        ("max_stretch", Settings { max_stretch: 1.0, ..good }),
        ("max_turning", Settings { max_turning: 0.0, ..good }),
        ("max_turning", Settings { max_turning: 2.0, ..good }),
    ];
    for (name, settings) in wrong {
        assert!(matches!(grow(&mesh, None, &settings), Err(PatchError::Setting { name: n, .. }) if n == name), "{name}");
    }
    let tiny = Settings { tile_side: 1e-200, ..good };
    assert!(matches!(grow(&mesh, None, &tiny), Err(PatchError::Scale { .. })));
}

#[test]
fn a_field_of_another_mesh_is_refused() {
    let field = common::combed(&sphere(1.0, 2).unwrap());
    let mesh = sphere(1.0, 3).unwrap();
    let refused = grow(&mesh, Some(&field), &Settings::for_mesh(&mesh));
    assert_eq!(refused, Err(PatchError::DirectionCount { directions: 42, vertices: 92 }));
}

#[test]
fn tilings_from_elsewhere_are_checked() {
    let grid = plane(1.0, 1.0, 1, 1).unwrap();
    let tiling = |tile_side, patches: &[u32], place: DVec2| PatchTiling::from_places(&grid, tile_side, patches, |_, _| place);
    assert!(tiling(1.0, &[0, 1], DVec2::ZERO).is_ok());
    assert!(matches!(tiling(0.0, &[0, 1], DVec2::ZERO), Err(PatchError::Setting { name: "tile_side", .. })));
    assert_eq!(tiling(1.0, &[0], DVec2::ZERO), Err(PatchError::FaceCount { given: 1, faces: 2 }));
    assert_eq!(tiling(1.0, &[0, 2], DVec2::ZERO), Err(PatchError::EmptyPatch { patch: 1, last: 2 }));
    assert_eq!(tiling(1.0, &[u32::MAX, 0], DVec2::ZERO), Err(PatchError::EmptyPatch { patch: 1, last: u32::MAX }));
    assert!(matches!(tiling(1.0, &[0, 0], DVec2::NAN), Err(PatchError::NoPlace { patch: 0, .. })));
}
