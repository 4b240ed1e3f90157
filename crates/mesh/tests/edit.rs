//! Meshes from meshes: subdivided, simplified, transformed, joined.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use std::f64::consts::PI;

use glam::{DVec3, Vec4};
use pelage_mesh::{
    Mesh, SubdivideError, Summary, Transform, TransformError, join, plane, rounded_die, sphere, subdivide, torus, transform,
};
use proptest::prelude::*;

/// Texture coordinates and colours that are the places themselves, so that what is carried can be told.
fn marked(mesh: Mesh) -> Mesh {
    let coordinates = mesh.half_edges().map(|h| h.origin().position().truncate()).collect();
    let colours = mesh.positions().iter().map(|p| p.as_vec3().extend(1.0)).collect();
    mesh.with_texture_coordinates(coordinates).unwrap().with_colours(colours).unwrap()
}

fn sound(mesh: &Mesh) {
    assert_eq!(mesh.topology().check(), Ok(()));
}

mod subdivision {
    use super::*;

    /// The limit of a regular mesh of valence six is the box spline: a plane stays one with even spacing, at its middle exactly.
    #[test]
    fn a_plane_stays_a_plane_and_topology_a_topology() {
        let sheet = plane(4.0, 4.0, 4, 4).unwrap();
        let finer = subdivide(&sheet, 3).unwrap();
        sound(&finer);
        assert_eq!(finer.topology().face_count(), 64 * sheet.topology().face_count());
        assert!(finer.positions().iter().all(|p| p.y == 0.0) && finer.faces().all(|face| face.normal().y > 0.999_999));
        let ring = torus(1.0, 0.4, 12, 8).unwrap();
        let finer = subdivide(&ring, 2).unwrap();
        sound(&finer);
        assert_eq!((finer.topology().genus(), finer.topology().boundary_edge_count()), (1, 0));
    }

    /// Loop's rules by their masks, worked out by hand: an octahedron's corners have valence 4, so that three eighths and a quarter of a right angle's cosine make
    /// 5/8 − (3/8)² = 31/64 for all neighbours together, whose mean is the middle; and edges have 3/4 of their own middle and 1/8 of each corner across.
    #[test]
    fn an_octahedron_follows_the_masks() {
        let corners = vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let faces = [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
        let finer = subdivide(&Mesh::from_triangles(corners, &faces).unwrap(), 1).unwrap();
        assert!((finer.positions()[0] - (1.0 - 31.0 / 64.0) * DVec3::X).length() < 1e-15);
        // From X to Y, across lie Z and −Z.
        let middle = DVec3::new(0.375, 0.375, 0.0);
        assert!(finer.positions()[6..].iter().any(|p| p.distance(middle) < 1e-15));
    }

    /// At valence 3 the cosine is −1/2, so that (1/4)² is taken from 5/8; the neighbours' mean lies opposite, a third as far from the middle.
    #[test]
    fn a_tetrahedron_shrinks_to_a_quarter() {
        let corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]].map(|c: [i8; 3]| DVec3::from(c.map(f64::from)));
        let finer = subdivide(&Mesh::from_triangles(corners.to_vec(), &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]).unwrap(), 1).unwrap();
        assert!(finer.positions().iter().zip(corners).all(|(p, corner)| p.distance(0.25 * corner) < 1e-15));
    }

    /// A boundary's points are those of the cubic B-spline: 1/8, 3/4, 1/8, and middles.
    #[test]
    fn a_boundary_is_a_curve_of_its_own() {
        let rim = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let square = Mesh::from_triangles(rim.to_vec(), &[[0, 1, 2], [0, 2, 3]]).unwrap();
        let finer = subdivide(&square, 1).unwrap();
        assert_eq!(finer.positions()[1], DVec3::new(1.75, 0.25, 0.0));
        assert!(finer.positions().contains(&DVec3::new(1.0, 0.0, 0.0)));
        // Whatever is inside: the other diagonal gives the same rim.
        let other = subdivide(&Mesh::from_triangles(rim.to_vec(), &[[0, 1, 3], [1, 2, 3]]).unwrap(), 1).unwrap();
        let rims = [&finer, &other].map(|mesh| {
            let mut rim: Vec<[i64; 3]> =
                mesh.boundary_loops()[0].vertices().map(|v| (v.position() * 1e6).as_i64vec3().to_array()).collect();
            rim.sort_unstable();
            rim
        });
        assert_eq!(rims[0], rims[1]);
    }

    #[test]
    fn texture_coordinates_and_colours_are_interpolated() {
        let sheet = marked(plane(2.0, 2.0, 3, 3).unwrap());
        let finer = subdivide(&sheet, 1).unwrap();
        let (old, colours) = (sheet.colours().unwrap(), finer.colours().unwrap());
        assert_eq!(&colours[..old.len()], old);
        for (edge, colour) in sheet.edges().zip(&colours[old.len()..]) {
            assert!(colour.distance(edge.centre().as_vec3().extend(1.0)) < 1e-6);
        }
        // The marks are the places before anything moved.
        for (face, whole) in finer.topology().faces().zip((0..).flat_map(|whole| [whole; 4])) {
            let middles = sheet.face(pelage_mesh::FaceId(whole)).edges().map(|edge| edge.centre().truncate());
            let corners = sheet.face(pelage_mesh::FaceId(whole)).positions().map(DVec3::truncate);
            let [a, b, c] = corners;
            let [ab, bc, ca] = middles;
            let expected = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]][face.index() % 4];
            for (half_edge, at) in finer.face(face.id()).half_edges().into_iter().zip(expected) {
                assert!(half_edge.texture_coordinates().unwrap().distance(at) < 1e-15);
            }
        }
    }

    #[test]
    fn it_ends_before_memory_does() {
        let ball = sphere(1.0, 20).unwrap();
        for levels in [6, 31, 32, u32::MAX] {
            assert_eq!(subdivide(&ball, levels), Err(SubdivideError::TooManyFaces { faces: 8000, levels }));
        }
        assert_eq!(subdivide(&ball, 0).unwrap(), ball);
        let nothing = Mesh::from_triangles(vec![DVec3::X], &[]).unwrap();
        assert_eq!(subdivide(&nothing, u32::MAX).unwrap(), nothing);
    }
}

mod transforms {
    use super::*;

    #[test]
    fn scale_comes_first_then_turning_about_x_y_z_then_the_shift() {
        let sheet = plane(2.0, 2.0, 1, 1).unwrap();
        let by =
            Transform { scale: DVec3::new(3.0, 1.0, 1.0), turn: 0.5 * PI * DVec3::new(1.0, 0.0, 1.0), shift: DVec3::new(0.0, 0.0, 7.0) };
        let moved = transform(&sheet, &by).unwrap();
        for (p, q) in sheet.positions().iter().zip(moved.positions()) {
            // About x: (x, −z, y). Then about z: (−y, x, z).
            let scaled = DVec3::new(3.0 * p.x, p.y, p.z);
            let about_x = DVec3::new(scaled.x, -scaled.z, scaled.y);
            let expected = DVec3::new(-about_x.y, about_x.x, about_x.z + 7.0);
            assert!(q.distance(expected) < 1e-14, "{q} for {expected}");
        }
        let about_y = transform(&sheet, &Transform { turn: 0.5 * PI * DVec3::Y, ..Transform::default() }).unwrap();
        assert!(about_y.positions().iter().zip(sheet.positions()).all(|(q, p)| q.distance(DVec3::new(p.z, p.y, -p.x)) < 1e-14));
        assert_eq!(transform(&sheet, &Transform::default()).unwrap(), sheet);
    }

    #[test]
    fn a_mirror_keeps_the_outside_outside_and_all_that_corners_have() {
        let die = marked(rounded_die(1.0, 0.4, 6).unwrap());
        for (scale, times) in [
            (DVec3::new(-1.0, 1.0, 1.0), 1.0),
            (DVec3::new(1.0, -2.0, 1.0), 2.0),
            (DVec3::splat(-1.0), 1.0),
            (DVec3::new(-1.0, -1.0, 1.0), 1.0),
        ] {
            let mirrored = transform(&die, &Transform { scale, ..Transform::default() }).unwrap();
            sound(&mirrored);
            assert!((mirrored.signed_volume() - times * die.signed_volume()).abs() < 1e-12, "{scale}");
            for corner in mirrored.half_edges() {
                let old = corner.origin().position() / scale;
                assert!(corner.texture_coordinates().unwrap().distance(old.truncate()) < 1e-12);
            }
            assert_eq!(mirrored.colours(), die.colours());
        }
    }

    #[test]
    fn what_gives_no_place_is_refused() {
        let sheet = plane(1.0, 1.0, 1, 1).unwrap();
        let fail = |by: Transform| transform(&sheet, &by).unwrap_err();
        let still = Transform::default();
        assert!(matches!(fail(Transform { scale: DVec3::new(1.0, 0.0, 1.0), ..still }), TransformError::Flat(_)));
        assert!(matches!(fail(Transform { turn: DVec3::splat(f64::NAN), ..still }), TransformError::NotFinite { .. }));
        assert!(matches!(fail(Transform { shift: DVec3::splat(f64::INFINITY), ..still }), TransformError::NotFinite { .. }));
        let far = transform(&sheet, &Transform { scale: DVec3::splat(1e308), ..still }).unwrap();
        assert!(matches!(transform(&far, &Transform { scale: DVec3::splat(1e3), ..still }), Err(TransformError::Mesh(_))));
    }
}

mod joining {
    use super::*;

    #[test]
    fn both_are_there_each_in_its_order() {
        let (ball, sheet) = (sphere(1.0, 3).unwrap(), plane(5.0, 5.0, 2, 2).unwrap());
        let both = join(&ball, &sheet).unwrap();
        sound(&both);
        let (one, two) = (ball.positions().len(), ball.topology().face_count());
        assert_eq!((&both.positions()[..one], &both.positions()[one..]), (ball.positions(), sheet.positions()));
        let triangles: Vec<[u32; 3]> = both.topology().triangles().collect();
        assert!(triangles[..two].iter().copied().eq(ball.topology().triangles()));
        assert!(triangles[two..].iter().map(|t| t.map(|v| v - one as u32)).eq(sheet.topology().triangles()));
        assert_eq!(Summary::of(&both).faces, two + 8);
        // The ball has no texture coordinates, so that there are none.
        assert_eq!(both.texture_coordinates(), None);
    }

    #[test]
    fn what_corners_and_vertices_have_is_kept_as_far_as_both_have_it() {
        let sheet = marked(plane(1.0, 1.0, 2, 1).unwrap());
        let both = join(&sheet, &sheet).unwrap();
        let coordinates = sheet.texture_coordinates().unwrap();
        assert_eq!(both.texture_coordinates().unwrap(), [coordinates, coordinates].concat());
        let bare = plane(1.0, 1.0, 1, 1).unwrap();
        let colours = join(&bare, &sheet).unwrap().colours().unwrap().to_vec();
        assert_eq!((&colours[..4], &colours[4..]), ([Vec4::ONE; 4].as_slice(), sheet.colours().unwrap()));
        assert_eq!(join(&bare, &bare).unwrap().colours(), None);
    }
}

#[cfg(feature = "simplify")]
mod simplification {
    use super::*;
    use pelage_mesh::{SimplifyError, SimplifySettings, SpatialIndex, simplify};

    fn share(share: f64) -> SimplifySettings {
        SimplifySettings { share, ..SimplifySettings::default() }
    }

    /// The greatest distance of vertices of one from the surface of another, in diameters.
    fn apart(from: &Mesh, to: &Mesh) -> f64 {
        let (index, diameter) = (SpatialIndex::of(to), to.diameter());
        from.positions().iter().map(|&p| index.closest_point(p).unwrap().distance / diameter).fold(0.0, f64::max)
    }

    #[test]
    fn a_share_of_the_faces_is_left_close_to_where_they_were() {
        for (name, mesh, genus) in [("ball", sphere(1.0, 30).unwrap(), 0), ("ring", torus(1.0, 0.4, 80, 40).unwrap(), 1)] {
            let faces = mesh.topology().face_count();
            for part in [0.5, 0.1, 0.02] {
                let coarse = simplify(&mesh, &share(part)).unwrap();
                sound(&coarse.mesh);
                let left = coarse.mesh.topology().face_count();
                assert!(left as f64 <= part * faces as f64 + 1.0 && left as f64 > 0.8 * part * faces as f64, "{name}: {left} of {faces}");
                assert_eq!((coarse.mesh.topology().genus(), coarse.mesh.topology().boundary_edge_count()), (genus, 0), "{name}");
                let measured = apart(&mesh, &coarse.mesh);
                println!("reached: {name} at {part}: {measured:.4} diameters off, said {:.4}", coarse.error);
                assert!(measured < 3.0 * coarse.error + 1e-4, "{name} at {part}: {measured} for {}", coarse.error);
                assert!(coarse.mesh.positions().iter().all(|p| mesh.positions().contains(p)));
            }
        }
    }

    #[test]
    fn an_error_ends_it_first() {
        let ball = sphere(1.0, 30).unwrap();
        let mut faces = ball.topology().face_count();
        for error in [1e-4, 1e-3, 1e-2] {
            let coarse = simplify(&ball, &SimplifySettings { share: 0.0, error, ..SimplifySettings::default() }).unwrap();
            assert!(coarse.error <= error && coarse.mesh.topology().face_count() < faces, "{error}");
            faces = coarse.mesh.topology().face_count();
            let measured = apart(&ball, &coarse.mesh);
            println!("reached: {faces} faces within {error}: {measured:.5} diameters off");
            assert!(measured < 6.0 * error);
        }
        // A plane loses all that is not its corners.
        let sheet =
            simplify(&plane(1.0, 1.0, 20, 20).unwrap(), &SimplifySettings { share: 0.0, error: 1e-3, keep_boundary: false }).unwrap();
        let (area, faces) = (sheet.mesh.area(), sheet.mesh.topology().face_count());
        assert!((area - 1.0).abs() < 1e-3 && faces < 100, "{faces} of 800 faces, area {area}");
    }

    #[test]
    fn a_boundary_can_be_kept_and_what_vertices_have_stays_with_them() {
        let sheet = marked(plane(1.0, 1.0, 12, 12).unwrap());
        let kept = simplify(&sheet, &SimplifySettings { keep_boundary: true, ..share(0.05) }).unwrap().mesh;
        assert_eq!(kept.topology().boundary_edge_count(), sheet.topology().boundary_edge_count());
        let free = simplify(&sheet, &share(0.05)).unwrap().mesh;
        assert!(free.topology().boundary_edge_count() < sheet.topology().boundary_edge_count());
        for mesh in [kept, free] {
            for corner in mesh.half_edges() {
                let place = corner.origin().position();
                assert_eq!(corner.texture_coordinates(), Some(place.truncate()));
                assert_eq!(mesh.colours().unwrap()[corner.origin().index()], place.as_vec3().extend(1.0));
            }
        }
    }

    /// The seam of the torus's texture, where u starts again, is still one: no face reaches across it.
    #[test]
    fn a_texture_seam_stays_one() {
        let ring = torus(1.0, 0.4, 60, 24).unwrap();
        let coarse = simplify(&ring, &share(0.2)).unwrap().mesh;
        sound(&coarse);
        for face in coarse.faces() {
            let at = face.half_edges().map(|h| h.texture_coordinates().unwrap());
            let spread = at.iter().map(|a| at.iter().map(|b| a.distance(*b)).fold(0.0, f64::max)).fold(0.0, f64::max);
            assert!(spread < 0.5, "{at:?}");
        }
    }

    #[test]
    fn scale_and_place_make_no_difference() {
        let ring = torus(1.0, 0.4, 30, 20).unwrap();
        let coarse = simplify(&ring, &share(0.3)).unwrap().mesh;
        for scale in [1e-20, 1e20] {
            let by = Transform { scale: DVec3::splat(scale), ..Transform::default() };
            let other = simplify(&transform(&ring, &by).unwrap(), &share(0.3)).unwrap().mesh;
            assert_eq!(other.topology().face_count(), coarse.topology().face_count(), "{scale}");
        }
        assert_eq!(simplify(&ring, &share(0.3)).unwrap().mesh, coarse);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let ball = sphere(1.0, 4).unwrap();
        for wrong in [-0.1, 1.1, f64::NAN] {
            assert!(matches!(simplify(&ball, &share(wrong)), Err(SimplifyError::Share(_))));
            assert!(matches!(simplify(&ball, &SimplifySettings { error: wrong, ..share(0.5) }), Err(SimplifyError::Error(_))));
        }
        assert_eq!(simplify(&Mesh::from_triangles(vec![DVec3::X], &[]).unwrap(), &share(0.5)), Err(SimplifyError::NoSurface));
        // With nothing asked to stay there is still a solid, or it is said that there is none.
        match simplify(&ball, &share(0.0)) {
            Ok(left) => sound(&left.mesh),
            Err(error) => assert!(matches!(error, SimplifyError::Nothing(_)), "{error}"),
        }
        let whole = simplify(&ball, &SimplifySettings { error: 0.0, ..share(1.0) }).unwrap().mesh;
        assert_eq!(whole.topology().face_count(), ball.topology().face_count());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn any_surface_is_still_one(bumps in prop::collection::vec(-0.4..0.4_f64, 162), part in 0.0..1.0_f64, keep in any::<bool>()) {
            let ball = sphere(1.0, 4).unwrap();
            let positions = ball.positions().iter().zip(&bumps).map(|(&p, bump)| p * (1.0 + bump)).collect();
            let bumpy = ball.with_positions(positions).unwrap();
            if let Ok(coarse) = simplify(&bumpy, &SimplifySettings { keep_boundary: keep, ..share(part) }) {
                prop_assert_eq!(coarse.mesh.topology().check(), Ok(()));
                prop_assert!(coarse.mesh.topology().face_count() <= bumpy.topology().face_count());
            }
        }
    }
}
