//! Patches that overlap: the surface is covered, triangles meet, outlines fade, and it is the same each time.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use pelage_field::DirectionField;
use pelage_mesh::{Mesh, SpatialIndex, plane, sphere, torus};
use pelage_patch::{LappedPatches, PatchError, Settings, lap};

fn settings(mesh: &Mesh) -> Settings {
    Settings::with_tile_side(0.2 * mesh.diameter())
}

fn models() -> Vec<(&'static str, Mesh, Option<DirectionField>)> {
    let (ball, ring, sheet) = (sphere(1.0, 10).unwrap(), torus(1.0, 0.4, 40, 20).unwrap(), plane(1.0, 1.0, 1, 1).unwrap());
    let combed = DirectionField::toward(&ball, DVec3::NEG_Y).unwrap();
    vec![("ball", ball.clone(), Some(combed)), ("ball", ball, None), ("ring", ring, None), ("two triangles", sheet, None)]
}

/// The triangles of each patch.
fn by_patch(lapped: &LappedPatches) -> Vec<&[[u32; 3]]> {
    let mut first = 0;
    lapped
        .patch_ends()
        .iter()
        .map(|&end| {
            let faces = &lapped.faces()[first..end as usize];
            first = end as usize;
            faces
        })
        .collect()
}

fn corners(lapped: &LappedPatches, face: [u32; 3]) -> [DVec2; 3] {
    face.map(|corner| lapped.coordinates()[corner as usize])
}

fn area([a, b, c]: [DVec2; 3]) -> f64 {
    0.5 * (b - a).perp_dot(c - a)
}

#[test]
fn every_place_is_covered_and_none_by_a_triangle_that_is_turned_over() {
    for (name, mesh, field) in models() {
        let lapped = lap(&mesh, field.as_ref(), &settings(&mesh)).unwrap();
        assert!(lapped.faces().iter().all(|&face| area(corners(&lapped, face)) > 0.0), "{name}");
        // By triangle of the mesh the pieces that lie in it, in barycentric coordinates of it.
        let mut pieces: BTreeMap<u32, Vec<[DVec2; 3]>> = BTreeMap::new();
        let index = SpatialIndex::of(&mesh);
        for &face in lapped.faces() {
            let places = face.map(|corner| mesh_place(&mesh, &lapped, corner));
            // A piece lies in one face: the one in which its middle is nearest.
            let middle = (places[0] + places[1] + places[2]) / 3.0;
            let owner = index.closest_point(middle).unwrap().point.face;
            let flat = |p: DVec3| {
                let [a, b, c] = mesh.face(owner).vertices().map(pelage_mesh::Vertex::position);
                let (u, v) = ((b - a), (c - a));
                let n = u.cross(v);
                let (s, t) = ((p - a).cross(v).dot(n) / n.length_squared(), u.cross(p - a).dot(n) / n.length_squared());
                DVec2::new(s, t)
            };
            pieces.entry(owner.0).or_default().push(places.map(flat));
        }
        let (mut seen, mut bare) = (0, 0);
        for face in mesh.faces() {
            let own = pieces.get(&face.id().0).map_or(&[][..], Vec::as_slice);
            for k in 0..45u32 {
                // Low-discrepancy places within the triangle.
                let (mut s, mut t) = ((0.5 + f64::from(k) * 0.754_877_666) % 1.0, (0.5 + f64::from(k) * 0.569_840_29) % 1.0);
                if s + t > 1.0 {
                    (s, t) = (1.0 - s, 1.0 - t);
                }
                let place = DVec2::new(s, t);
                seen += 1;
                bare += u32::from(!own.iter().any(|&piece| holds(piece, place)));
            }
        }
        assert!(f64::from(bare) < 2e-3 * f64::from(seen), "{name}: {bare} of {seen} places are bare");
    }
}

fn mesh_place(mesh: &Mesh, lapped: &LappedPatches, corner: u32) -> DVec3 {
    lapped.points()[corner as usize].position(mesh)
}

fn holds(triangle: [DVec2; 3], place: DVec2) -> bool {
    let side = |k: usize| (triangle[(k + 1) % 3] - triangle[k]).perp_dot(place - triangle[k]);
    (0..3).all(|k| side(k) >= -1e-9) || (0..3).all(|k| side(k) <= 1e-9)
}

/// An edge of a patch is that of two triangles, or its border: where a ring is cut in there is no crack.
#[test]
fn triangles_of_a_patch_meet() {
    for (name, mesh, field) in models() {
        let lapped = lap(&mesh, field.as_ref(), &settings(&mesh)).unwrap();
        for faces in by_patch(&lapped) {
            let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
            for face in faces {
                for k in 0..3 {
                    let (from, to) = (face[k], face[(k + 1) % 3]);
                    *sides.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
                }
            }
            assert!(sides.values().all(|&count| count.abs() <= 1), "{name}: an edge is of three triangles, or of two on one side");
        }
    }
}

#[test]
fn a_patch_is_whole_in_its_middle_and_gone_at_its_outline() {
    let mesh = sphere(1.0, 12).unwrap();
    let lapped = lap(&mesh, None, &settings(&mesh)).unwrap();
    for (faces, number) in by_patch(&lapped).iter().zip(0..) {
        let mut sides: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for face in *faces {
            (0..3).for_each(|k| *sides.entry([face[k].min(face[(k + 1) % 3]), face[k].max(face[(k + 1) % 3])]).or_default() += 1);
        }
        let border: Vec<u32> = sides.iter().filter(|(_, count)| **count == 1).flat_map(|(side, _)| *side).collect();
        // On a ball that no patch's bounds cut, every border is an outline.
        let gone = border.iter().filter(|&&corner| lapped.opacities()[corner as usize] < 1e-6).count();
        assert!(gone * 20 >= border.len() * 19, "patch {number}: {gone} of {}", border.len());
        assert!(faces.iter().flatten().any(|&corner| lapped.opacities()[corner as usize] == 1.0), "patch {number} is nowhere whole");
    }
    assert!(lapped.opacities().iter().all(|opacity| (0.0..=1.0).contains(opacity)));
    // Evenly from the one to the other, within the outer three tenths: the last fifth of the way there has three quarters of the area of the first; over more of the patch it would have less.
    let mut fifths = [0usize; 5];
    for opacity in lapped.opacities().iter().filter(|opacity| (1e-3..0.999).contains(*opacity)) {
        fifths[((5.0 * opacity) as usize).min(4)] += 1;
    }
    let [first, .., last] = fifths;
    assert!(first > 100 && last < first && 10 * last > 6 * first, "{fifths:?}");
}

#[test]
fn a_tile_is_as_large_as_it_is_to_be_and_lies_along_the_field() {
    let mesh = sphere(1.0, 16).unwrap();
    let field = DirectionField::toward(&mesh, DVec3::NEG_Y).unwrap();
    let side = settings(&mesh).tile_side;
    let lapped = lap(&mesh, Some(&field), &settings(&mesh)).unwrap();
    let (mut on_surface, mut on_tile) = (0.0, 0.0);
    for &face in lapped.faces() {
        let [a, b, c] = face.map(|corner| mesh_place(&mesh, &lapped, corner));
        on_surface += 0.5 * (b - a).cross(c - a).length() / (side * side);
        on_tile += area(corners(&lapped, face));
    }
    assert!((on_tile / on_surface - 1.0).abs() < 0.05, "{on_tile} of {on_surface}");
    // More than once covered, and less than six times.
    let sphere_area = 4.0 * std::f64::consts::PI / (side * side);
    assert!((1.2..6.0).contains(&(on_surface / sphere_area)), "{} times", on_surface / sphere_area);
}

#[test]
fn the_same_comes_of_the_same_and_another_of_another_seed() {
    let mesh = torus(1.0, 0.4, 20, 10).unwrap();
    let of = |seed| lap(&mesh, None, &Settings { seed, ..settings(&mesh) }).unwrap();
    assert_eq!(of(1), of(1));
    assert_ne!(of(1), of(2));
}

#[test]
fn what_cannot_be_lapped_is_refused() {
    let (mesh, other) = (sphere(1.0, 3).unwrap(), sphere(1.0, 4).unwrap());
    let field = DirectionField::toward(&other, DVec3::NEG_Y).unwrap();
    assert!(matches!(lap(&mesh, Some(&field), &settings(&mesh)), Err(PatchError::DirectionCount { .. })));
    assert!(matches!(
        lap(&mesh, None, &Settings { max_stretch: 1.0, ..settings(&mesh) }),
        Err(PatchError::Setting { name: "max_stretch", .. })
    ));
    let nothing = Mesh::from_triangles(Vec::new(), &[]).unwrap();
    let lapped = lap(&nothing, None, &Settings::with_tile_side(1.0)).unwrap();
    assert!(lapped.faces().is_empty() && lapped.patch_ends().is_empty());
}
