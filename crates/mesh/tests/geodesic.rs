//! Distance along the surface against what it must be: formulas, bounds, and the exact distance.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

mod common;

use std::f64::consts::{PI, TAU};

use common::{joined, models, sawtooth_fan, sheet_with_hole, twisted_strip};
use glam::{DMat3, DVec3};
use pelage_mesh::{
    Edge, FaceId, GeodesicError, Geodesics, Mesh, Source, SurfacePoint, Vertex, VertexId, angle_between, plane, rounded_die, sphere, torus,
};
use proptest::prelude::*;

const ALL: f64 = f64::INFINITY;

fn fast(mesh: &Mesh, source: impl Into<Source>) -> Vec<f64> {
    Geodesics::on(mesh).distances(&[source.into()], ALL).unwrap().to_vec(mesh.positions().len())
}

fn exact(mesh: &Mesh, source: impl Into<Source>) -> Vec<f64> {
    Geodesics::on(mesh).exact_distances(&[source.into()], ALL).unwrap().to_vec(mesh.positions().len())
}

fn vertex_at(mesh: &Mesh, place: DVec3) -> VertexId {
    let nearest = mesh.vertices().min_by(|a, b| a.position().distance(place).total_cmp(&b.position().distance(place)));
    nearest.unwrap().id()
}

/// The greatest of |a − b| / scale.
fn worst(a: &[f64], b: &[f64], scale: f64) -> f64 {
    a.iter().zip(b).map(|(a, b)| if a == b { 0.0 } else { (a - b).abs() / scale }).fold(0.0, f64::max)
}

fn greatest(distances: &[f64]) -> f64 {
    distances.iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max)
}

/// Along edges with `steps` places on each, joined straight over faces: never too short, and not much too long.
fn over_many_places(mesh: &Mesh, source: VertexId, steps: usize) -> Vec<f64> {
    let mut places: Vec<DVec3> = mesh.positions().to_vec();
    let mut on_side = vec![Vec::new(); mesh.topology().half_edge_count()];
    for edge in mesh.edges() {
        let [a, b] = edge.vertices().map(Vertex::position);
        let first = places.len();
        places.extend((1..steps).map(|k| a.lerp(b, k as f64 / steps as f64)));
        let inner: Vec<usize> = (first..places.len()).collect();
        for side in edge.half_edges() {
            on_side[side.index()] = inner.clone();
        }
    }
    let mut joined = vec![Vec::new(); places.len()];
    for face in mesh.faces() {
        let mut rim: Vec<usize> = face.vertices().map(Vertex::index).to_vec();
        rim.extend(face.half_edges().iter().flat_map(|side| on_side[side.index()].iter().copied()));
        for &a in &rim {
            joined[a].extend(rim.iter().copied().filter(|&b| b != a));
        }
    }
    let mut distances = vec![ALL; places.len()];
    let mut queue = std::collections::BTreeSet::from([(0_u64, source.index())]);
    distances[source.index()] = 0.0;
    // The bits of numbers that are not negative are in the order of the numbers.
    while let Some((bits, here)) = queue.pop_first() {
        for &there in &joined[here] {
            let distance = f64::from_bits(bits) + places[here].distance(places[there]);
            if distance < distances[there] {
                queue.remove(&(distances[there].to_bits(), there));
                distances[there] = distance;
                queue.insert((distance.to_bits(), there));
            }
        }
    }
    distances.truncate(mesh.positions().len());
    distances
}

#[test]
fn a_plane_is_measured_straight() {
    // Sheared ever more, so that corners grow obtuse and faces turn to slivers.
    for shear in [0.0, 1.0, 5.0, 40.0] {
        let flat = plane(4.0, 3.0, 16, 12).unwrap();
        let shape = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(shear, 0.0, 1.0));
        let mesh = flat.with_positions(flat.positions().iter().map(|&p| shape * p).collect()).unwrap();
        let middle = vertex_at(&mesh, DVec3::ZERO);
        for source in [VertexId(0), middle, VertexId(20)] {
            let straight: Vec<f64> = mesh.vertices().map(|v| v.position().distance(mesh.vertex(source).position())).collect();
            let scale = mesh.diameter();
            assert!(worst(&exact(&mesh, source), &straight, scale) < 1e-12, "shear {shear}, {source:?}");
            assert!(worst(&fast(&mesh, source), &straight, scale) < 1e-12, "shear {shear}, {source:?}");
        }
    }
}

#[test]
fn points_on_faces_and_edges_and_corners_are_sources() {
    let mesh = plane(4.0, 3.0, 8, 6).unwrap();
    for barycentrics in
        [[0.2, 0.3, 0.5], [0.5, 0.5, 0.0], [0.0, 0.25, 0.75], [0.4, 0.0, 0.6], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1e-12, 0.5, 0.5]]
    {
        for face in [0, 37, 95] {
            let point = SurfacePoint { face: FaceId(face), barycentrics: barycentrics.into() };
            let straight: Vec<f64> = mesh.positions().iter().map(|p| p.distance(point.position(&mesh))).collect();
            assert!(worst(&exact(&mesh, point), &straight, 1.0) < 1e-9, "{point:?}");
            assert!(worst(&fast(&mesh, point), &straight, 1.0) < 1e-9, "{point:?}");
        }
    }
}

/// A square hole: straight, or around its corners, by trying all ways.
#[test]
fn a_hole_is_walked_around() {
    let (mesh, corners) = sheet_with_hole();
    let (low, high) = (corners[0], corners[2]);
    let sees = |a: DVec3, b: DVec3| {
        // Clipped to the open hole; a grazing line does not enter it.
        let d = b - a;
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for k in [0, 2] {
            if d[k].abs() < 1e-12 {
                if a[k] <= low[k] + 1e-9 || a[k] >= high[k] - 1e-9 {
                    return true;
                }
                continue;
            }
            let (s, t) = ((low[k] - a[k]) / d[k], (high[k] - a[k]) / d[k]);
            (enter, leave) = (enter.max(s.min(t)), leave.min(s.max(t)));
        }
        enter >= leave - 1e-9
    };
    let source = vertex_at(&mesh, DVec3::new(-2.0, 0.0, -1.0));
    let from = mesh.vertex(source).position();
    let way = |to: DVec3, around: &[DVec3]| {
        let stops: Vec<DVec3> = [from].iter().chain(around).copied().chain([to]).collect();
        if stops.windows(2).all(|w| sees(w[0], w[1])) { stops.windows(2).map(|w| w[0].distance(w[1])).sum() } else { ALL }
    };
    let shortest = |to: DVec3| {
        let one = corners.iter().map(|&c| way(to, &[c]));
        let two = corners.iter().flat_map(|&c| corners.iter().map(move |&d| (c, d))).map(|(c, d)| way(to, &[c, d]));
        one.chain(two).fold(way(to, &[]), f64::min)
    };
    let wanted: Vec<f64> = mesh.vertices().map(|v| if v.is_referenced() { shortest(v.position()) } else { ALL }).collect();
    assert!(wanted.iter().filter(|d| d.is_finite()).count() > 300);
    assert!(worst(&exact(&mesh, source), &wanted, 1.0) < 1e-12);
    let error = worst(&fast(&mesh, source), &wanted, greatest(&wanted));
    println!("around a hole: fast errs by {error:.1e} of the greatest distance");
    assert!(error < 0.01, "{error}");
}

/// Flat but for its tip, where angles miss or exceed a full round: the law of cosines in the unrolled fan, or straight over the tip.
#[test]
fn cones_and_saddles_unroll() {
    for (height, tooth) in [(1.5, 0.0), (0.2, 0.0), (0.0, 0.8), (0.0, 1.5)] {
        let fan = sawtooth_fan(height, tooth);
        let tip = fan.mesh.vertex(VertexId(0));
        let round = tip.angle_sum();
        assert!((round > TAU) == (tooth > 0.0), "{round}");
        let from_tip: Vec<f64> = fan.mesh.positions().iter().map(|p| p.length()).collect();
        assert!(worst(&exact(&fan.mesh, VertexId(0)), &from_tip, 1.0) < 1e-12);
        assert!(worst(&fast(&fan.mesh, VertexId(0)), &from_tip, 1.0) < 1e-12);
        let source = fan.spoke(0, 2);
        let (ours, quick) = (exact(&fan.mesh, source), fast(&fan.mesh, source));
        let near = fan.mesh.vertex(source).position().length();
        for spoke in 0..fan.spokes {
            for ring in 1..=3 {
                let target = fan.spoke(spoke, ring);
                let far = fan.mesh.vertex(target).position().length();
                let turned = round * f64::from(spoke) / f64::from(fan.spokes);
                let angle = turned.min(round - turned);
                let wanted = if angle >= PI { near + far } else { (near * near + far * far - 2.0 * near * far * angle.cos()).sqrt() };
                assert!(
                    (ours[target.index()] - wanted).abs() < 1e-12,
                    "height {height}, tooth {tooth}: {} for {wanted}",
                    ours[target.index()]
                );
                assert!(
                    (quick[target.index()] - wanted).abs() < 0.05 * (near + far),
                    "height {height}, tooth {tooth}: fast {} for {wanted}",
                    quick[target.index()]
                );
            }
        }
    }
}

/// The polyhedron lies inside the ball, so that the exact distance is too short by the square of the edge; the fast one likewise nearly.
#[test]
fn a_ball_is_measured_ever_better() {
    let mut errors = Vec::new();
    for segments in [8, 16, 32] {
        let ball = sphere(1.0, segments).unwrap();
        let source = VertexId(5);
        let arcs: Vec<f64> = ball.positions().iter().map(|&p| angle_between(p, ball.positions()[5])).collect();
        let (ours, quick) = (exact(&ball, source), fast(&ball, source));
        assert!(ours.iter().zip(&arcs).all(|(d, arc)| *d <= arc + 1e-12));
        errors.push([worst(&ours, &arcs, PI), worst(&quick, &arcs, PI)]);
    }
    println!("ball: {errors:?}");
    assert!(errors[0][0] < 1e-2 && errors[0][1] < 3e-2);
    for k in [0, 1] {
        assert!(errors[1][k] < 0.7 * errors[0][k] && errors[2][k] < 0.7 * errors[1][k], "{errors:?}");
    }
    assert!(errors[2][0] < 0.1 * errors[0][0], "the square of the edge: {errors:?}");
}

/// The inner and outer equator and the tubes of a torus are closed geodesics.
#[test]
fn a_torus_is_measured_along_its_tube() {
    let ring = torus(1.0, 0.4, 96, 48).unwrap();
    let source = vertex_at(&ring, DVec3::new(1.4, 0.0, 0.0));
    let inner = vertex_at(&ring, DVec3::new(0.6, 0.0, 0.0));
    for (distances, bound) in [(exact(&ring, source), 2e-3), (fast(&ring, source), 2e-2)] {
        assert!((distances[inner.index()] / (0.4 * PI) - 1.0).abs() < bound, "{}", distances[inner.index()]);
    }
}

/// Exact is no more than any path found by brute force, and hardly less.
#[test]
fn exact_distances_are_what_many_small_steps_come_to() {
    let models = [
        ("ball", sphere(1.0, 4).unwrap()),
        ("torus", torus(1.0, 0.4, 12, 8).unwrap()),
        ("die", rounded_die(1.0, 0.2, 4).unwrap()),
        ("saddle", sawtooth_fan(0.0, 1.5).mesh),
        ("strip", twisted_strip(12)),
        ("hole", sheet_with_hole().0),
    ];
    for (name, mesh) in models {
        for source in [VertexId(0), VertexId(17)] {
            let (ours, other) = (exact(&mesh, source), over_many_places(&mesh, source, 24));
            for (a, b) in ours.iter().zip(&other).filter(|(a, _)| a.is_finite()) {
                assert!(*a <= b + 1e-12 && *a >= 0.996 * b, "{name}: {a} for {b}");
            }
            assert_eq!(ours.iter().filter(|d| d.is_finite()).count(), other.iter().filter(|d| d.is_finite()).count());
        }
    }
}

#[test]
fn there_and_back_is_as_far() {
    for mesh in [torus(1.0, 0.4, 20, 12).unwrap(), rounded_die(1.0, 0.1, 6).unwrap(), twisted_strip(20)] {
        let (a, b) = (VertexId(3), VertexId(mesh.positions().len() as u32 / 2));
        assert!((exact(&mesh, a)[b.index()] - exact(&mesh, b)[a.index()]).abs() < 1e-12);
    }
}

#[test]
fn what_is_not_joined_is_infinitely_far() {
    let pair = joined(&sphere(1.0, 4).unwrap(), &plane(1.0, 1.0, 3, 3).unwrap(), 5.0 * DVec3::X);
    let first = sphere(1.0, 4).unwrap().positions().len();
    for distances in [fast(&pair, VertexId(2)), exact(&pair, VertexId(2))] {
        assert!(distances[..first].iter().all(|d| d.is_finite()) && distances[first..].iter().all(|&d| d == ALL));
    }
    let mut both = Geodesics::on(&pair);
    let sources = [VertexId(2).into(), VertexId(first as u32).into()];
    assert!(both.distances(&sources, ALL).unwrap().to_vec(pair.positions().len()).iter().all(|d| d.is_finite()));
    let alone = Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE], &[[0, 1, 2]]).unwrap();
    assert_eq!(Geodesics::on(&alone).distances(&[VertexId(3).into()], ALL).unwrap().nearest_first(), [(VertexId(3), 0.0)]);
}

#[test]
fn of_several_sources_the_nearest_counts() {
    let mesh = plane(4.0, 3.0, 20, 15).unwrap();
    let sources = [VertexId(0), VertexId(200), VertexId(333)];
    let each: Vec<Vec<f64>> = sources.iter().map(|&source| exact(&mesh, source)).collect();
    let nearest: Vec<f64> = (0..mesh.positions().len()).map(|v| each.iter().map(|d| d[v]).fold(ALL, f64::min)).collect();
    let mut geodesics = Geodesics::on(&mesh);
    let sources = sources.map(Source::from);
    let ours = geodesics.exact_distances(&sources, ALL).unwrap().to_vec(nearest.len());
    assert!(worst(&ours, &nearest, 1.0) < 1e-12);
    let quick = geodesics.distances(&sources, ALL).unwrap().to_vec(nearest.len());
    // Where two fronts meet, an edge's ends speak of different sources: wrong by less than half an edge.
    let error = worst(&quick, &nearest, 0.2);
    assert!(error < 0.5, "{error}");
    assert!(geodesics.distances(&[], ALL).unwrap().nearest_first().is_empty());
}

#[test]
fn a_reach_cuts_the_same_distances_off() {
    let (ring, flat) = (torus(1.0, 0.4, 48, 24).unwrap(), plane(4.0, 3.0, 16, 12).unwrap());
    let sheared = flat.with_positions(flat.positions().iter().map(|p| DVec3::new(p.x + 5.0 * p.z, 0.0, p.z)).collect()).unwrap();
    let source = [VertexId(77).into()];
    let reaches = [0.0, 0.1, 0.5, 1.3, 2.0, 4.0];
    for (mesh, reach) in [ring, sheared].iter().flat_map(|mesh| reaches.map(|reach| (mesh, reach))) {
        let mut geodesics = Geodesics::on(mesh);
        let (all, near) = (geodesics.distances(&source, ALL).unwrap(), geodesics.distances(&source, reach).unwrap());
        let within: Vec<_> = all.nearest_first().iter().copied().filter(|v| v.1 <= reach).collect();
        assert_eq!(near.nearest_first(), within, "reach {reach}");
        let (all, near) = (geodesics.exact_distances(&source, ALL).unwrap(), geodesics.exact_distances(&source, reach).unwrap());
        let within: Vec<_> = all.nearest_first().iter().copied().filter(|v| v.1 <= reach).collect();
        assert_eq!(near.nearest_first(), within, "reach {reach}");
    }
}

#[test]
fn a_source_that_is_nowhere_is_an_error() {
    let mesh = plane(1.0, 1.0, 2, 2).unwrap();
    let mut geodesics = Geodesics::on(&mesh);
    let mut error = |source: Source| geodesics.distances(&[VertexId(0).into(), source], ALL).unwrap_err();
    assert_eq!(error(VertexId(9).into()), GeodesicError::NoSuchVertex { source_index: 1, vertex: 9, vertices: 9 });
    let point = |face, b: [f64; 3]| SurfacePoint { face: FaceId(face), barycentrics: b.into() }.into();
    assert_eq!(error(point(8, [1.0, 0.0, 0.0])), GeodesicError::NoSuchFace { source_index: 1, face: 8, faces: 8 });
    for b in [[0.5, 0.5, 0.5], [-0.5, 1.0, 0.5], [f64::NAN, 0.5, 0.5], [ALL, 0.0, 0.0]] {
        assert!(matches!(error(point(0, b)), GeodesicError::NotOnFace { source_index: 1, .. }), "{b:?}");
    }
    for reach in [-1.0, f64::NAN] {
        assert!(matches!(geodesics.distances(&[VertexId(0).into()], reach), Err(GeodesicError::Reach { .. })));
        assert!(matches!(geodesics.exact_distances(&[VertexId(0).into()], reach), Err(GeodesicError::Reach { .. })));
    }
}

#[test]
fn faces_without_area_or_length_are_crossed() {
    // A cap whose apex lies on its base, in the way from one side to the other; and a mesh that is a single point.
    let places = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let cap = Mesh::from_triangles(places.to_vec(), &[[0, 2, 3], [2, 1, 3], [1, 2, 0], [0, 4, 1]]).unwrap();
    for distances in [fast(&cap, VertexId(3)), exact(&cap, VertexId(3)), exact(&cap, VertexId(4)).into_iter().rev().collect()] {
        assert!(distances.iter().all(|d| d.is_finite()), "{distances:?}");
    }
    assert!((exact(&cap, VertexId(2))[4] - 1.0).abs() < 1e-12);
    assert!((exact(&cap, VertexId(3))[4] - 2.0).abs() < 1e-12, "{}", exact(&cap, VertexId(3))[4]);
    let point = cap.with_positions(vec![DVec3::ONE; 5]).unwrap();
    assert!(fast(&point, VertexId(0)).iter().chain(&exact(&point, VertexId(0))).all(|&d| d == 0.0));
}

#[test]
fn scale_and_place_change_nothing() {
    let mesh = torus(1.0, 0.4, 24, 12).unwrap();
    let (ours, quick) = (exact(&mesh, VertexId(7)), fast(&mesh, VertexId(7)));
    for scale in [1e-250, 1e-30, 1e30, 1e250] {
        let scaled = mesh.with_positions(mesh.positions().iter().map(|&p| scale * p).collect()).unwrap();
        assert!(worst(&exact(&scaled, VertexId(7)).iter().map(|d| d / scale).collect::<Vec<_>>(), &ours, 1.0) < 1e-12);
        assert!(worst(&fast(&scaled, VertexId(7)).iter().map(|d| d / scale).collect::<Vec<_>>(), &quick, 1.0) < 1e-12);
    }
}

/// What the book's page says of the fast distance, on every model.
#[test]
fn on_models_the_fast_distance_is_near_the_exact_one() {
    for (name, mesh) in models() {
        // The exact distance of the largest two would take as long as all other tests here.
        if mesh.positions().len() > 6000 {
            continue;
        }
        for source in [VertexId(0), VertexId(mesh.positions().len() as u32 / 2)] {
            let (ours, quick) = (exact(&mesh, source), fast(&mesh, source));
            assert!(ours.iter().chain(&quick).all(|d| d.is_finite()), "{name}");
            let far = greatest(&ours);
            let mean = ours.iter().zip(&quick).map(|(a, b)| (a - b).abs()).sum::<f64>() / far / ours.len() as f64;
            let most = worst(&ours, &quick, far);
            println!("{name}: mean {:.2} %, at most {:.2} % of the greatest distance", 100.0 * mean, 100.0 * most);
            assert!(mean < 0.015 && most < 0.04, "{name}: {mean} {most}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Crumpled balls: bounds that hold of any surface.
    #[test]
    fn distances_keep_the_bounds_of_a_metric(bumps in prop::collection::vec(0.5..2.0_f64, 98), source in 0..98_u32) {
        let ball = sphere(1.0, 3).unwrap();
        let count = ball.positions().len();
        let mesh = ball.with_positions(ball.positions().iter().zip(bumps.iter().cycle()).map(|(&p, bump)| p * bump).collect()).unwrap();
        let source = VertexId(source % count as u32);
        let (ours, quick, along_edges) = (exact(&mesh, source), fast(&mesh, source), over_many_places(&mesh, source, 1));
        for (k, p) in mesh.positions().iter().enumerate() {
            prop_assert!(ours[k] >= p.distance(mesh.vertex(source).position()) - 1e-12);
            prop_assert!(ours[k] <= along_edges[k] + 1e-12 && quick[k] <= along_edges[k] + 1e-12);
            prop_assert!(quick[k] >= 0.5 * ours[k], "{} for {}", quick[k], ours[k]);
        }
        for (edge, [a, b]) in mesh.edges().map(|edge| (edge, edge.vertices())) {
            prop_assert!((ours[a.index()] - ours[b.index()]).abs() <= Edge::length(edge) + 1e-12);
            prop_assert!((quick[a.index()] - quick[b.index()]).abs() <= Edge::length(edge) + 1e-9);
        }
        let finer = over_many_places(&mesh, source, 12);
        prop_assert!(ours.iter().zip(&finer).all(|(a, b)| *a <= b + 1e-12 && *a >= 0.95 * b));
    }
}
