//! The quality figures say what they should, and tell a tiling from what is none.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a test stops where it fails and says what it did not try")]

mod common;

use glam::{DVec2, DVec3};
use pelage_field::DirectionField;
use pelage_mesh::{Face, FaceId, Mesh, VertexId, plane, sphere};
use pelage_patch::{PatchTiling, Quality, Settings};

const TILE: f64 = 0.25;

/// A plane as one patch whose coordinates are a linear map of the exact ones, (z, x) in tiles.
fn mapped_plane(map: impl Fn(DVec2) -> DVec2) -> (Mesh, DirectionField, PatchTiling) {
    let mesh = plane(1.0, 1.0, 4, 4).unwrap();
    let field = DirectionField::toward(&mesh, DVec3::X).unwrap();
    let place = |_, v: VertexId| map(DVec2::new(mesh.vertex(v).position().z, mesh.vertex(v).position().x) / TILE);
    let tiling = PatchTiling::from_places(&mesh, TILE, &[0; 32], place).unwrap();
    (mesh, field, tiling)
}

#[test]
fn exact_coordinates_measure_as_exact() {
    let (mesh, field, tiling) = mapped_plane(|p| p);
    let quality = tiling.quality(&mesh, Some(&field));
    assert_eq!((quality.patch_count, quality.faces_covered, quality.faces_flipped, quality.all_discs), (1, 32, 0, true));
    assert!((quality.stretch_max - 1.0).abs() < 1e-9 && quality.misalignment_deg_max.unwrap() < 1e-5);
    assert_eq!((quality.seam_length, quality.tile_repeats_max, quality.faces_per_patch_p50), (0.0, 4.0, 32));
}

#[test]
fn stretch_turning_and_flips_are_measured() {
    let close = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let (mesh, field, tiling) = mapped_plane(|p| DVec2::new(2.0 * p.x, 0.8 * p.y));
    assert!(close(tiling.quality(&mesh, Some(&field)).stretch_p50, 2.0));
    let (mesh, field, tiling) = mapped_plane(|p| DVec2::new(1.1 * p.x, 0.25 * p.y));
    assert!(close(tiling.quality(&mesh, Some(&field)).stretch_p99, 4.0));
    let (mesh, field, tiling) = mapped_plane(|p| DVec2::from_angle(0.5).rotate(p));
    let quality = tiling.quality(&mesh, Some(&field));
    assert!(close(quality.misalignment_deg_mean.unwrap(), 0.5_f64.to_degrees()) && close(quality.stretch_max, 1.0));
    let (mesh, field, tiling) = mapped_plane(|p| DVec2::new(-p.x, p.y));
    let quality = tiling.quality(&mesh, Some(&field));
    assert_eq!((quality.faces_flipped, quality.stretch_max), (32, f64::INFINITY));
    let (mesh, field, tiling) = mapped_plane(|_| DVec2::ZERO);
    assert_eq!(tiling.quality(&mesh, Some(&field)).faces_flipped, 32);
}

/// A source in the middle of a plane, every face laid out along the field but for those within a ring, which are turned: only where the ring lies farther
/// than a tile is it seen by the figure for far faces.
#[test]
fn near_a_singularity_and_far_are_told_apart() {
    let mesh = plane(4.0, 4.0, 40, 40).unwrap();
    let vectors: Vec<DVec3> = mesh.positions().iter().map(|p| *p - DVec3::new(0.03, 0.0, 0.01)).collect();
    let field = DirectionField::from_vectors(&mesh, &vectors).unwrap();
    assert_eq!(pelage_field::singularities(&mesh, &field).unwrap().len(), 1);
    let with_turned = |inner: f64, outer: f64| {
        let patches: Vec<u32> = (0..mesh.topology().face_count() as u32).collect();
        let place = |patch: u32, vertex: VertexId| {
            let face = mesh.face(FaceId(patch));
            let t = field.on_face(&mesh, FaceId(patch));
            let p = mesh.vertex(vertex).position() - face.centre();
            let flat = DVec2::new(p.dot(t.cross(face.normal())), p.dot(t)) / 0.5;
            let turned = (inner..outer).contains(&face.centre().length());
            if turned { DVec2::from_angle(0.6).rotate(flat) } else { flat }
        };
        PatchTiling::from_places(&mesh, 0.5, &patches, place).unwrap().quality(&mesh, Some(&field))
    };
    let (near, far) = (with_turned(0.0, 0.4), with_turned(0.7, 4.0));
    assert!(near.misalignment_deg_mean.unwrap() > 0.5 && near.misalignment_deg_mean_far.unwrap() < 1e-6, "{near:?}");
    let turned = 0.6_f64.to_degrees();
    assert!(far.misalignment_deg_mean_far.unwrap() > 0.95 * turned && far.misalignment_deg_mean_far.unwrap() <= turned + 1e-6, "{far:?}");
    assert!(far.misalignment_deg_mean.unwrap() < far.misalignment_deg_mean_far.unwrap() - 0.5);
}

#[test]
fn seams_are_measured_and_rings_are_no_discs() {
    let mesh = plane(4.0, 4.0, 4, 4).unwrap();
    let halves: Vec<u32> = mesh.faces().map(|f| u32::from(f.centre().x > 0.0)).collect();
    let flat = |_, v: VertexId| DVec2::new(mesh.vertex(v).position().z, mesh.vertex(v).position().x);
    let quality = PatchTiling::from_places(&mesh, 1.0, &halves, flat).unwrap().quality(&mesh, None);
    assert!((quality.seam_length - 4.0 / 32_f64.sqrt()).abs() < 1e-12 && quality.all_discs);
    assert!((quality.seam_fraction - 4.0 / (40.0 + 16.0 * 2_f64.sqrt())).abs() < 1e-12);
    let inner = |f: Face<'_, Mesh>| f.centre().abs().max_element() < 1.0;
    let ring: Vec<u32> = mesh.faces().map(|f| u32::from(inner(f))).collect();
    assert!(!PatchTiling::from_places(&mesh, 1.0, &ring, flat).unwrap().quality(&mesh, None).all_discs);
}

/// What a tiling of a mesh with some thousand faces must be worth: the names of the limits that it breaks.
fn broken_limits(quality: &Quality) -> Vec<&'static str> {
    let limits = [
        ("faces per patch", quality.faces_per_patch_p50 < 8),
        ("tiles spanned", quality.tile_repeats_p50 < 0.5),
        ("seam length", quality.seam_fraction > 0.35),
        ("stretch", quality.stretch_p50 > 1.15 || quality.stretch_p99 > 2.0),
        ("misalignment", quality.misalignment_deg_mean.is_some_and(|d| d > 12.0)),
        ("flips", quality.faces_flipped > 0),
        ("discs", !quality.all_discs),
    ];
    limits.into_iter().filter(|(_, broken)| *broken).map(|(name, _)| name).collect()
}

/// Each face a patch of its own, laid out exactly.
fn face_at_a_time(mesh: &Mesh, field: &DirectionField, tile_side: f64) -> PatchTiling {
    let patches: Vec<u32> = (0..mesh.topology().face_count() as u32).collect();
    let place = |patch: u32, vertex: VertexId| {
        let t = field.on_face(mesh, FaceId(patch));
        let s = t.cross(mesh.face(FaceId(patch)).normal());
        let p = mesh.vertex(vertex).position() - mesh.face(FaceId(patch)).centre();
        DVec2::new(p.dot(s), p.dot(t)) / tile_side
    };
    PatchTiling::from_places(mesh, tile_side, &patches, place).unwrap()
}

/// Two patches, front and back, looked at along x.
fn projection(mesh: &Mesh, tile_side: f64) -> PatchTiling {
    let patches: Vec<u32> = mesh.faces().map(|f| u32::from(f.normal().x < 0.0)).collect();
    let place = |patch: u32, vertex: VertexId| {
        let p = mesh.vertex(vertex).position();
        DVec2::new(if patch == 0 { -p.z } else { p.z }, p.y) / tile_side
    };
    PatchTiling::from_places(mesh, tile_side, &patches, place).unwrap()
}

#[test]
fn a_face_at_a_time_and_a_projection_are_no_tilings() {
    let mut models = common::real_models();
    models.retain(|(_, mesh)| (4000..7000).contains(&mesh.topology().face_count()));
    models.push(("sphere".into(), sphere(1.0, 16).unwrap()));
    for (name, mesh) in models {
        let field = common::combed(&mesh);
        let settings = Settings::for_mesh(&mesh);
        let worth = |tiling: &PatchTiling| broken_limits(&tiling.quality(&mesh, Some(&field)));
        assert_eq!(worth(&common::tile(&mesh, Some(&field), &settings)), [""; 0], "{name}");
        let single = worth(&face_at_a_time(&mesh, &field, settings.tile_side));
        assert_eq!(single, ["faces per patch", "tiles spanned", "seam length"], "{name}");
        let flat = worth(&projection(&mesh, settings.tile_side));
        assert!(flat.contains(&"stretch") && flat.contains(&"misalignment"), "{name}: {flat:?}");
    }
}
