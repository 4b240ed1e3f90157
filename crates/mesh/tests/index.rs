//! Rays and closest points: one suite that a search through all faces and the hierarchy both pass, and what must hold besides.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

mod common;

use common::{joined, models, sawtooth_fan, twisted_strip};
use glam::DVec3;
use pelage_mesh::{
    FaceId, Hit, IndexError, Mesh, Nearest, Ray, RayError, Side, SpatialIndex, Vertex, plane, rounded_die, sphere, torus, unit,
};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// What can be asked of a surface.
trait Search {
    fn distances(&self, ray: &Ray) -> Vec<f64>;
    fn closest(&self, point: DVec3) -> Option<f64>;
    fn faces_within(&self, point: DVec3, radius: f64) -> Vec<FaceId>;
}

impl Search for SpatialIndex<'_> {
    fn distances(&self, ray: &Ray) -> Vec<f64> {
        self.hits(ray).iter().map(|hit| hit.distance).collect()
    }

    fn closest(&self, point: DVec3) -> Option<f64> {
        self.closest_point(point).map(|nearest| nearest.distance)
    }

    fn faces_within(&self, point: DVec3, radius: f64) -> Vec<FaceId> {
        self.within(point, radius).iter().map(|nearest| nearest.point.face).collect()
    }
}

/// All faces, one after the other, by other formulas than those of the crate.
struct EveryFace<'a>(&'a Mesh);

impl EveryFace<'_> {
    /// T. Möller, B. Trumbore: Fast, Minimum Storage Ray/Triangle Intersection, Journal of Graphics Tools 2(1), 1997.
    fn hit(ray: &Ray, [a, b, c]: [DVec3; 3]) -> Option<f64> {
        let (ab, ac) = (b - a, c - a);
        let p = ray.direction().cross(ac);
        let determinant = ab.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let s = ray.origin() - a;
        let (u, q) = (s.dot(p) / determinant, s.cross(ab));
        let v = ray.direction().dot(q) / determinant;
        let distance = ac.dot(q) / determinant;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance >= 0.0).then_some(distance)
    }

    /// C. Ericson: Real-Time Collision Detection, 2005, section 5.1.5: by the region of the triangle.
    fn nearest(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
        let on_line = |a: DVec3, b: DVec3| {
            let t = if a == b { 0.0 } else { ((p - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0) };
            a.lerp(b, t).distance(p)
        };
        let normal = unit((b - a).cross(c - a));
        let above = |a: DVec3, b: DVec3| normal.dot((b - a).cross(p - a)) >= 0.0;
        if normal != DVec3::ZERO && above(a, b) && above(b, c) && above(c, a) {
            return normal.dot(p - a).abs();
        }
        on_line(a, b).min(on_line(b, c)).min(on_line(c, a))
    }
}

impl Search for EveryFace<'_> {
    fn distances(&self, ray: &Ray) -> Vec<f64> {
        let mut all: Vec<f64> = self.0.faces().filter_map(|face| Self::hit(ray, face.positions())).collect();
        all.sort_by(f64::total_cmp);
        all
    }

    fn closest(&self, point: DVec3) -> Option<f64> {
        self.0.faces().map(|face| Self::nearest(point, face.positions())).reduce(f64::min)
    }

    fn faces_within(&self, point: DVec3, radius: f64) -> Vec<FaceId> {
        let mut all: Vec<_> =
            self.0.faces().map(|face| (Self::nearest(point, face.positions()), face.id())).filter(|near| near.0 <= radius).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        all.into_iter().map(|near| near.1).collect()
    }
}

fn a_ball_is_found(search: &impl Search, centre: DVec3, radius: f64) {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    for _ in 0..50 {
        let direction = direction(&mut random);
        let outside = Ray::new(centre + 3.0 * radius * direction, -direction).unwrap();
        let distances = search.distances(&outside);
        assert_eq!(distances.len(), 2);
        assert!((distances[0] / radius - 2.0).abs() < 0.02 && (distances[1] / radius - 4.0).abs() < 0.02, "{distances:?}");
        assert!(search.distances(&Ray::new(centre + 3.0 * radius * direction, direction).unwrap()).is_empty());
        assert_eq!(search.distances(&Ray::new(centre, direction).unwrap()).len(), 1);
        let closest = search.closest(centre + 5.0 * radius * direction).unwrap() / radius;
        assert!((closest - 4.0).abs() < 0.02, "{closest}");
        assert!(search.faces_within(centre + 1.5 * radius * direction, 0.4 * radius).is_empty());
        assert!(!search.faces_within(centre + 1.5 * radius * direction, 0.6 * radius).is_empty());
    }
    assert!((search.closest(centre).unwrap() / radius - 1.0).abs() < 0.02);
}

fn direction(random: &mut Pcg64Mcg) -> DVec3 {
    let mut number = || random.random::<f64>() * 2.0 - 1.0;
    DVec3::new(number(), number(), number()).normalize()
}

#[test]
fn both_ways_of_searching_find_a_ball() {
    for (scale, place) in [(1.0, DVec3::ZERO), (1e-30, DVec3::ZERO), (1e30, DVec3::ZERO), (1.0, DVec3::new(1e6, -1e6, 3e5))] {
        let ball = sphere(1.0, 24).unwrap();
        let ball = ball.with_positions(ball.positions().iter().map(|&p| scale * p + place).collect()).unwrap();
        a_ball_is_found(&SpatialIndex::of(&ball), place, scale);
        a_ball_is_found(&EveryFace(&ball), place, scale);
    }
}

fn surfaces() -> Vec<(&'static str, Mesh)> {
    vec![
        ("ball", sphere(1.0, 6).unwrap()),
        ("torus", torus(1.0, 0.4, 24, 12).unwrap()),
        ("cube", rounded_die(1.0, 0.0, 4).unwrap()),
        ("die", rounded_die(1.0, 0.3, 6).unwrap()),
        ("sheet", plane(2.0, 1.0, 9, 7).unwrap()),
        ("saddle", sawtooth_fan(0.0, 1.5).mesh),
        ("strip", twisted_strip(16)),
        ("pair", joined(&sphere(1.0, 4).unwrap(), &torus(1.0, 0.2, 9, 6).unwrap(), DVec3::X)),
    ]
}

/// The same hits, the same closest points, the same faces: from anywhere to anywhere.
fn agree(name: &str, mesh: &Mesh, random: &mut Pcg64Mcg, rounds: usize) {
    let (index, every) = (SpatialIndex::of(mesh), EveryFace(mesh));
    let (low, high) = mesh.bounds().unwrap();
    let size = mesh.diameter();
    let middle = 0.5 * low + 0.5 * high;
    for _ in 0..rounds {
        let (from, to) = (middle + size * direction(random) * random.random::<f64>(), middle + 0.4 * size * direction(random));
        let ray = Ray::new(from, to - from).unwrap();
        let (ours, wanted) = (index.distances(&ray), every.distances(&ray));
        assert_eq!(ours.len(), wanted.len(), "{name}: {ray:?}");
        assert!(ours.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-9 * size), "{name}: {ours:?} {wanted:?}");
        assert_eq!(index.first_hit(&ray).map(|hit| hit.distance), ours.first().copied());
        assert_eq!(index.is_hit(&ray), !ours.is_empty());
        let (ours, wanted) = (index.closest(from).unwrap(), every.closest(from).unwrap());
        assert!((ours - wanted).abs() < 1e-12 * size, "{name}: {ours} {wanted}");
        let radius = ours + 0.1 * size * random.random::<f64>();
        let (mut ours, mut wanted) = (index.faces_within(from, radius), every.faces_within(from, radius));
        ours.sort();
        wanted.sort();
        assert_eq!(ours, wanted, "{name}: within {radius} of {from}");
    }
}

#[test]
fn the_hierarchy_finds_what_a_search_through_all_faces_finds() {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    for (name, mesh) in surfaces() {
        agree(name, &mesh, &mut random, 200);
        // Further out the other formulas leave the range of `f64`.
        for scale in [1e-90, 1e-30, 1e30, 1e90] {
            agree(name, &mesh.with_positions(mesh.positions().iter().map(|&p| scale * p).collect()).unwrap(), &mut random, 10);
        }
    }
    for (name, mesh) in models() {
        if mesh.positions().len() < 6000 {
            agree(&name, &mesh, &mut random, 20);
        }
    }
}

#[test]
fn a_hit_and_a_closest_point_say_where_they_are() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    for (name, mesh) in surfaces() {
        let index = SpatialIndex::of(&mesh);
        for _ in 0..100 {
            let ray = Ray::new(2.0 * direction(&mut random), direction(&mut random)).unwrap();
            for Hit { point, distance, side } in index.hits(&ray) {
                assert!(point.position(&mesh).distance(ray.at(distance)) < 1e-12, "{name}");
                assert!(point.barycentrics.min_element() >= 0.0 && (point.barycentrics.element_sum() - 1.0).abs() < 1e-12);
                assert_eq!(side == Side::Outer, mesh.face(point.face).normal().dot(ray.direction()) < 0.0, "{name}");
            }
            let Nearest { point, position, distance } = index.closest_point(ray.origin()).unwrap();
            assert!(point.position(&mesh).distance(position) < 1e-12 && (position.distance(ray.origin()) - distance).abs() < 1e-12);
            assert!(point.barycentrics.min_element() >= 0.0 && (point.barycentrics.element_sum() - 1.0).abs() < 1e-12);
            let near = index.within(ray.origin(), distance + 0.2);
            assert!(near[0].distance == distance && near.windows(2).all(|pair| pair[0].distance <= pair[1].distance));
        }
    }
}

/// Closed surfaces with a point inside each.
fn closed() -> Vec<(String, Mesh, DVec3)> {
    let mut all = vec![
        ("ball".to_owned(), sphere(1.0, 6).unwrap(), DVec3::new(0.1, 0.2, -0.3)),
        ("ball from its middle".to_owned(), sphere(1.0, 5).unwrap(), DVec3::ZERO),
        ("cube".to_owned(), rounded_die(2.0, 0.0, 4).unwrap(), DVec3::ZERO),
        ("cube off its middle".to_owned(), rounded_die(2.0, 0.0, 4).unwrap(), DVec3::new(0.5, 0.25, 0.0)),
        ("torus".to_owned(), torus(1.0, 0.4, 24, 12).unwrap(), DVec3::X),
    ];
    for (name, mesh) in models().into_iter().filter(|(_, mesh)| mesh.topology().is_closed() && mesh.positions().len() < 6000) {
        // A little beneath the first face: inside, as no model is that thin there.
        let face = mesh.face(FaceId(0));
        let inside = face.centre() - 1e-4 * mesh.diameter() * face.normal();
        all.push((name, mesh, inside));
    }
    all
}

/// Rays aimed exactly at vertices and at points of edges: the surface lets none through, and counts each passage once.
#[test]
fn no_ray_slips_through_a_vertex_or_an_edge() {
    let mut rays = 0;
    for (name, mesh, inside) in closed() {
        let index = SpatialIndex::of(&mesh);
        let vertices = mesh.vertices().map(Vertex::position);
        let on_edges = mesh.edges().flat_map(|edge| {
            let [a, b] = edge.vertices().map(Vertex::position);
            [0.5, 0.3].map(|t| a.lerp(b, t))
        });
        // Every ninth of a model's, as there are a hundred thousand.
        let step = if mesh.positions().len() > 600 { 9 } else { 1 };
        for target in vertices.chain(on_edges).filter(|&target| target != inside).step_by(step) {
            let out = Ray::new(inside, target - inside).unwrap();
            let hits = index.hits(&out);
            assert!(hits.len() % 2 == 1, "{name}: {} hits from inside through {target}", hits.len());
            // A ray that only touches may pass on, which none does that leaves a convex body.
            let convex = name.starts_with("ball") || name.starts_with("cube");
            assert!(!convex || (hits[0].distance / inside.distance(target) - 1.0).abs() < 1e-12, "{name}");
            // Each passage is out, or in again.
            let balance: i32 = hits.iter().map(|hit| if hit.side == Side::Inner { 1 } else { -1 }).sum();
            assert_eq!(balance, 1, "{name}");
            let far = inside + 3.0 * mesh.diameter() * (target - inside).normalize();
            assert!(index.hits(&Ray::new(far, target - far).unwrap()).len().is_multiple_of(2), "{name}");
            rays += 1;
        }
    }
    println!("{rays} rays, none slipped through");
}

#[test]
fn rays_along_axes_and_through_the_plane_of_faces_are_counted_once() {
    let cube = rounded_die(2.0, 0.0, 4).unwrap();
    let index = SpatialIndex::of(&cube);
    for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z] {
        let across = DVec3::new(axis.y, axis.z, axis.x);
        for (u, v) in [(0.0, 0.0), (0.5, 0.0), (0.5, 0.5), (0.25, 0.7)] {
            let from = -3.0 * axis + u * across + v * axis.cross(across);
            let distances: Vec<f64> = index.hits(&Ray::new(from, axis).unwrap()).iter().map(|hit| hit.distance).collect();
            assert_eq!(distances, [2.0, 4.0], "{axis} {u} {v}");
        }
        // In the plane of a side, where the two sides that it leaves and enters are met on their rims: both or none.
        let grazing = Ray::new(-3.0 * axis + across, axis).unwrap();
        assert!(index.hits(&grazing).len().is_multiple_of(2));
    }
    let sheet = plane(2.0, 2.0, 4, 4).unwrap();
    assert!(SpatialIndex::of(&sheet).hits(&Ray::new(-3.0 * DVec3::X, DVec3::X).unwrap()).is_empty(), "seen on edge, it has no breadth");
}

#[test]
fn a_ray_can_start_on_the_surface_and_stop_short() {
    let ball = sphere(1.0, 12).unwrap();
    let index = SpatialIndex::of(&ball);
    for face in ball.faces() {
        let ray = Ray::new(face.centre(), -face.normal()).unwrap();
        let beyond = index.first_hit(&ray.between(1e-9, f64::INFINITY)).unwrap();
        assert!(beyond.distance > 1.5 && beyond.side == Side::Inner);
        assert!(index.first_hit(&ray.between(1e-9, 1.0)).is_none() && !index.is_hit(&ray.between(3.0, 4.0)));
        assert!(index.closest_point(face.centre()).unwrap().distance < 1e-15);
    }
}

#[test]
fn what_is_no_ray_says_why() {
    let bad = [DVec3::new(f64::NAN, 0.0, 0.0), DVec3::new(0.0, f64::INFINITY, 0.0)];
    for v in bad {
        assert!(matches!(Ray::new(v, DVec3::X), Err(RayError::Origin { .. })));
        assert!(matches!(Ray::new(DVec3::ZERO, v), Err(RayError::Direction { .. })));
        assert!(SpatialIndex::of(&sphere(1.0, 2).unwrap()).closest_point(v).is_none());
        assert!(SpatialIndex::of(&sphere(1.0, 2).unwrap()).within(v, 1.0).is_empty());
    }
    assert!(matches!(Ray::new(DVec3::ZERO, DVec3::ZERO), Err(RayError::Direction { .. })));
    assert_eq!(Ray::new(DVec3::ZERO, 1e-200 * DVec3::Y).unwrap().direction(), DVec3::Y);
}

#[test]
fn an_empty_mesh_and_faces_without_area_are_searched_too() {
    let none = Mesh::from_triangles(vec![DVec3::ONE], &[]).unwrap();
    let index = SpatialIndex::of(&none);
    let ray = Ray::new(DVec3::ZERO, DVec3::ONE).unwrap();
    assert!(index.first_hit(&ray).is_none() && index.closest_point(DVec3::ZERO).is_none() && index.within(DVec3::ZERO, 9.0).is_empty());
    let needle = Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], &[[0, 1, 2]]).unwrap();
    let index = SpatialIndex::of(&needle);
    assert_eq!(index.closest_point(DVec3::new(1.5, 1.0, 0.0)).unwrap().position, DVec3::new(1.5, 0.0, 0.0));
    assert!(index.first_hit(&Ray::new(DVec3::new(0.5, 1.0, 0.0), DVec3::NEG_Y).unwrap()).is_none());
    let point = needle.with_positions(vec![DVec3::ONE; 3]).unwrap();
    assert_eq!(SpatialIndex::of(&point).closest_point(DVec3::ZERO).unwrap().distance, 3_f64.sqrt());
}

#[test]
fn from_far_away_it_is_still_hit() {
    let ball = sphere(1.0, 8).unwrap();
    let index = SpatialIndex::of(&ball);
    for far in [1e3, 1e6, 1e9, 1e12] {
        for vertex in ball.vertices() {
            let from = far * DVec3::new(0.6, 0.64, 0.48);
            let inner = 0.9 * vertex.position();
            assert_eq!(index.hits(&Ray::new(from, inner - from).unwrap()).len(), 2, "from {far}");
        }
    }
    // Lines of a sheet lie on the sides of boxes, where rounding decides on which side a ray passes.
    let sheet = plane(2.0, 2.0, 16, 16).unwrap();
    let index = SpatialIndex::of(&sheet);
    for far in [1e3, 1e9, 1e12] {
        for edge in sheet.edges().filter(|edge| !edge.is_boundary() && edge.centre().abs().max_element() < 0.99) {
            let from = far * DVec3::new(0.31, 0.92, -0.17);
            assert!(index.is_hit(&Ray::new(from, edge.centre() - from).unwrap()), "from {far} through {}", edge.centre());
        }
    }
    for far in [1e3, 1e100, 1e200] {
        let nearest = index.closest_point(far * DVec3::Y).unwrap();
        assert!((nearest.distance / far - 1.0).abs() < 2e-3, "{nearest:?}");
    }
}

#[test]
fn a_moved_mesh_keeps_its_hierarchy() {
    let mesh = torus(1.0, 0.4, 24, 12).unwrap();
    let bent = mesh.with_positions(mesh.positions().iter().map(|p| DVec3::new(p.x, p.y + p.x * p.x, 3.0 * p.z)).collect()).unwrap();
    let (moved, fresh) = (SpatialIndex::of(&mesh).refit(&bent).unwrap(), SpatialIndex::of(&bent));
    let mut random = Pcg64Mcg::seed_from_u64(8);
    let mut hits = 0;
    for _ in 0..500 {
        let ray = Ray::new(3.0 * direction(&mut random), direction(&mut random)).unwrap();
        assert_eq!(moved.hits(&ray), fresh.hits(&ray));
        assert_eq!(moved.closest_point(ray.origin()), fresh.closest_point(ray.origin()));
        hits += fresh.hits(&ray).len();
    }
    assert!(hits > 50);
    let other = sphere(1.0, 3).unwrap();
    let error = SpatialIndex::of(&mesh).refit(&other).unwrap_err();
    assert_eq!(error, IndexError { found: other.topology().face_count(), expected: 576 });
}

/// Triangles that are not joined: anything can be made of them.
fn soup() -> impl Strategy<Value = Mesh> {
    let place = [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64];
    // Some coordinates on a coarse grid, so that faces degenerate and line up with axes.
    let place = (place, any::<bool>()).prop_map(|(p, coarse)| DVec3::from(if coarse { p.map(|x| (2.0 * x).round() / 2.0) } else { p }));
    prop::collection::vec(prop::array::uniform3(place), 0..40).prop_map(|faces| {
        let triangles: Vec<[u32; 3]> = (0..faces.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
        Mesh::from_triangles(faces.into_flattened(), &triangles).unwrap()
    })
}

proptest! {
    #[test]
    fn of_any_faces_the_closest_is_found(mesh in soup(), p in [-2.0..2.0_f64, -2.0..2.0_f64, -2.0..2.0_f64]) {
        let (index, every) = (SpatialIndex::of(&mesh), EveryFace(&mesh));
        match (index.closest(p.into()), every.closest(p.into())) {
            (Some(a), Some(b)) => prop_assert!((a - b).abs() < 1e-9, "{} {}", a, b),
            (a, b) => prop_assert_eq!(a, b),
        }
    }

    #[test]
    fn of_any_faces_those_clearly_hit_are_found(mesh in soup(), from in [-2.0..2.0_f64, -2.0..2.0_f64, -2.0..2.0_f64], to in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64]) {
        let (from, to) = (DVec3::from(from), DVec3::from(to));
        prop_assume!(from.distance(to) > 1e-3);
        let ray = Ray::new(from, to - from).unwrap();
        let hits = SpatialIndex::of(&mesh).hits(&ray);
        for face in mesh.faces() {
            // Shrunk and grown about its middle: clearly inside, and clearly outside.
            let about = |factor: f64| face.positions().map(|p| face.centre() + factor * (p - face.centre()));
            let found = hits.iter().any(|hit| hit.point.face == face.id());
            let steep = face.normal().dot(ray.direction()).abs() > 1e-6 && face.area() > 1e-6;
            let starts_off = EveryFace::nearest(from, face.positions()) > 1e-9;
            if steep && starts_off {
                prop_assert!(found || EveryFace::hit(&ray, about(0.999)).is_none());
                prop_assert!(!found || EveryFace::hit(&ray, about(1.001)).is_some());
            }
        }
    }
}
