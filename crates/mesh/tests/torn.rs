//! All repairs at once, on clean surfaces torn at random and on polygons of no sense at all.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod mending;

use glam::{DVec2, DVec3};
use mending::{NONE, counts, mend, soup_of, triangles};
use pelage_mesh::{Face, Mesh, RepairReport, RepairSettings, Soup, Summary, plane, repair, rounded_die, sphere, torus};
use proptest::prelude::*;

/// One of several surfaces, closed, with a handle or with boundary.
fn surface() -> impl Strategy<Value = Mesh> {
    prop_oneof![
        (2..6_u32).prop_map(|n| sphere(1.0, n).unwrap()),
        (4..12_u32, 4..12_u32).prop_map(|(m, n)| torus(1.0, 0.5, m, n).unwrap()),
        (2..8_u32, 2..8_u32).prop_map(|(m, n)| plane(1.0, 2.0, m, n).unwrap()),
        (3..6_u32).prop_map(|n| rounded_die(1.0, 0.4, n).unwrap()),
    ]
}

/// What may be done to a surface that can be undone.
#[derive(Clone, Debug)]
enum Tear {
    Flip(usize),
    Duplicate(usize),
    DuplicateTurned(usize),
    Explode,
    Repeat(usize, usize),
    Unused,
}

fn tear() -> impl Strategy<Value = Tear> {
    prop_oneof![
        any::<usize>().prop_map(Tear::Flip),
        any::<usize>().prop_map(Tear::Duplicate),
        any::<usize>().prop_map(Tear::DuplicateTurned),
        Just(Tear::Explode),
        (any::<usize>(), any::<usize>()).prop_map(|(face, k)| Tear::Repeat(face, k)),
        Just(Tear::Unused),
    ]
}

fn apply(tears: &[Tear], positions: &mut Vec<DVec3>, faces: &mut Vec<[u32; 3]>) {
    for tear in tears {
        let count = faces.len();
        match *tear {
            Tear::Flip(k) => faces[k % count].reverse(),
            Tear::Duplicate(k) => faces.push(faces[k % count]),
            Tear::DuplicateTurned(k) => {
                let [a, b, c] = faces[k % count];
                faces.push([c, b, a]);
            }
            Tear::Explode => {
                *positions = faces.as_flattened().iter().map(|&v| positions[v as usize]).collect();
                *faces = (0..count as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
            }
            Tear::Repeat(k, corner) => {
                let mut face = faces[k % count];
                face[corner % 3] = face[(corner + 1) % 3];
                faces.push(face);
            }
            Tear::Unused => positions.insert(0, DVec3::splat(0.125)),
        }
        if matches!(tear, Tear::Unused) {
            faces.iter_mut().flatten().for_each(|v| *v += 1);
        }
    }
}

proptest! {
    #[test]
    fn what_can_be_undone_is_undone(mesh in surface(), tears in prop::collection::vec(tear(), 1..12)) {
        let (mut positions, mut faces) = (mesh.positions().to_vec(), triangles(&mesh));
        apply(&tears, &mut positions, &mut faces);
        let repaired = mend(Soup::from_polygons(positions, faces));
        prop_assert_eq!(counts(&repaired.mesh), counts(&mesh));
        prop_assert!((repaired.mesh.area() - mesh.area()).abs() < 1e-9 * mesh.area());
        let (volume, expected) = (repaired.mesh.signed_volume(), mesh.signed_volume());
        if mesh.topology().boundary_edge_count() == 0 {
            prop_assert!((volume - expected).abs() < 1e-9 * expected);
        }
        prop_assert!(!repaired.report.is_none());
        // What came out is a surface: repaired again it is the same, bit for bit.
        let again = mend(soup_of(&repaired.mesh));
        prop_assert_eq!(again.report, NONE);
        prop_assert!(again.mesh == repaired.mesh);
    }

    #[test]
    fn fins_are_taken_off(mesh in surface(), edges in prop::collection::vec(any::<prop::sample::Index>(), 1..5), heights in prop::collection::vec(0.05..0.4_f64, 5)) {
        let (mut positions, mut faces) = (mesh.positions().to_vec(), triangles(&mesh));
        let inner: Vec<_> = mesh.edges().filter(|edge| !edge.is_boundary()).collect();
        let chosen: std::collections::BTreeSet<usize> = edges.iter().map(|index| index.index(inner.len())).collect();
        for (&edge, height) in chosen.iter().zip(heights) {
            let edge = inner[edge];
            let [a, b] = edge.vertices();
            // Along the mean normal, so that no pair with it is flatter than the two faces are.
            let normal: DVec3 = edge.faces().map(Face::normal).sum();
            faces.push([a.id().0, b.id().0, positions.len() as u32]);
            positions.push(edge.centre() + height * normal.normalize());
        }
        let repaired = mend(Soup::from_polygons(positions, faces));
        let fins = chosen.len();
        let [v, e, boundary, f, loops, pieces, genus] = counts(&mesh);
        prop_assert_eq!(repaired.report.edges_split, fins);
        prop_assert_eq!(repaired.report.vertices_added, 2 * fins);
        prop_assert_eq!(counts(&repaired.mesh), [v + 3 * fins, e + 3 * fins, boundary + 3 * fins, f + fins, loops + fins, pieces + fins, genus]);
    }

    #[test]
    fn two_vertices_made_one_are_taken_apart_or_their_edge_collapses(mesh in surface(), a in any::<prop::sample::Index>(), b in any::<prop::sample::Index>()) {
        let count = mesh.topology().vertex_count();
        let (a, b) = (a.index(count) as u32, b.index(count) as u32);
        let faces = mesh.topology().triangles().map(|face| face.map(|v| if v == b { a } else { v }));
        let repaired = mend(Soup::from_polygons(mesh.positions().to_vec(), faces));
        let far = |v| mesh.vertex(pelage_mesh::VertexId(v)).neighbours().any(|n| n.id().0 == a || n.neighbours().any(|m| m.id().0 == a));
        let flattened = repaired.report.junctions_split + repaired.report.faces_without_area > 0;
        if a != b && !far(b) && !flattened {
            // Nothing else joins the two fans.
            prop_assert_eq!(counts(&repaired.mesh), counts(&mesh));
            prop_assert_eq!(repaired.report, RepairReport { vertices_split: 1, vertices_added: 1, vertices_unreferenced: 1, ..NONE });
        }
    }

    /// Any polygons at all, on a grid so coarse that most of it is degenerate.
    #[test]
    fn any_soup_gives_a_sound_mesh_or_an_error(
        grid in prop::collection::vec([0..3_i32, 0..3, 0..3], 1..14),
        polygons in prop::collection::vec(prop::collection::vec(0..14_u32, 0..7), 0..40),
        textured in any::<bool>(),
    ) {
        let positions: Vec<DVec3> = grid.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
        let count = positions.len() as u32;
        let mut soup = Soup::from_polygons(positions, polygons.iter().map(|polygon| polygon.iter().map(|v| v % count).collect::<Vec<_>>()));
        if textured {
            soup.texture_coordinates = grid.iter().map(|p| DVec2::new(f64::from(p[0]), f64::from(p[1]))).collect();
            soup.corner_coordinates = soup.corners.clone();
        }
        if let Ok(repaired) = repair(soup.clone(), &RepairSettings::default()) {
            prop_assert_eq!(repaired.mesh.topology().check(), Ok(()));
            prop_assert!(repaired.mesh.positions().iter().all(|p| p.is_finite()));
            prop_assert_eq!(Summary::of(&repaired.mesh).faces_without_area, 0);
            prop_assert_eq!(repaired.polygons.len(), repaired.mesh.topology().face_count());
            prop_assert!(repair(soup, &RepairSettings::default()) == Ok(repaired));
        }
    }

    /// A star-shaped polygon with straight corners put into its sides keeps its area and uses every corner.
    #[test]
    fn any_simple_polygon_keeps_its_area(radii in prop::collection::vec(0.2..1.0_f64, 3..40), cuts in prop::collection::vec(0..3_usize, 40), tilt in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0]) {
        let count = radii.len();
        let outline: Vec<DVec2> = radii.iter().enumerate().map(|(k, r)| r * DVec2::from_angle(std::f64::consts::TAU * k as f64 / count as f64)).collect();
        let side = |k: usize| (outline[k], outline[(k + 1) % count]);
        let area: f64 = (0..count).map(|k| 0.5 * side(k).0.perp_dot(side(k).1)).sum();
        let cut = |(k, &parts): (usize, &usize)| (0..=parts).map(move |part| (k, part as f64 / (parts + 1) as f64));
        let ring: Vec<DVec2> = cuts[..count].iter().enumerate().flat_map(cut).map(|(k, part)| side(k).0.lerp(side(k).1, part)).collect();
        let normal = (DVec3::from(tilt) + 2.0 * DVec3::Z).normalize();
        let (x, y) = normal.any_orthonormal_pair();
        let positions: Vec<DVec3> = ring.iter().map(|p| p.x * x + p.y * y).collect();
        let corners: Vec<u32> = (0..ring.len() as u32).collect();
        let repaired = mend(Soup::from_polygons(positions, [corners]));
        prop_assert!((repaired.mesh.area() - area).abs() < 1e-9 * area, "{} for {}", repaired.mesh.area(), area);
        prop_assert_eq!(repaired.report.polygons_tangled, 0);
        prop_assert_eq!(counts(&repaired.mesh), [ring.len(), 2 * ring.len() - 3, ring.len(), ring.len() - 2, 1, 1, 0]);
    }
}
