//! What holds of every topology, however its faces and vertices are numbered.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

use glam::DVec3;
use pelage_mesh::{FaceId, Mesh, Summary, Topology, TopologyError, Vertex, plane, rounded_die, sphere, torus};
use proptest::prelude::*;

/// One of several surfaces: closed, with a handle, with boundary.
fn surface() -> impl Strategy<Value = Mesh> {
    prop_oneof![
        (1..8_u32).prop_map(|n| sphere(1.0, n).unwrap()),
        (3..12_u32, 3..12_u32).prop_map(|(m, n)| torus(1.0, 0.5, m, n).unwrap()),
        (1..8_u32, 1..8_u32).prop_map(|(m, n)| plane(1.0, 2.0, m, n).unwrap()),
        (3..8_u32).prop_map(|n| rounded_die(1.0, 0.4, n).unwrap()),
    ]
}

/// The same surface with faces in another order, corners turned and vertices renumbered.
fn shuffled() -> impl Strategy<Value = (Mesh, Mesh)> {
    surface().prop_flat_map(|mesh| {
        let topology = mesh.topology();
        let faces = Just(topology.triangles().collect::<Vec<_>>()).prop_shuffle();
        let names = Just((0..topology.vertex_count() as u32).collect::<Vec<_>>()).prop_shuffle();
        let turns = prop::collection::vec(0..3_usize, topology.face_count());
        (Just(mesh), faces, names, turns).prop_map(|(mesh, faces, names, turns)| {
            let renamed = |(face, turn): (&[u32; 3], &usize)| {
                let mut face = face.map(|v| names[v as usize]);
                face.rotate_left(*turn);
                face
            };
            let triangles: Vec<_> = faces.iter().zip(&turns).map(renamed).collect();
            let mut positions = vec![DVec3::ZERO; names.len()];
            for (old, &new) in names.iter().enumerate() {
                positions[new as usize] = mesh.positions()[old];
            }
            (mesh, Mesh::from_triangles(positions, &triangles).unwrap())
        })
    })
}

/// The surface less some of its faces, which may tear vertices.
fn with_faces_removed() -> impl Strategy<Value = (usize, Vec<[u32; 3]>)> {
    (surface(), prop::collection::vec(any::<bool>(), 1..400)).prop_map(|(mesh, keep)| {
        let kept = mesh.topology().triangles().zip(keep.iter().cycle()).filter(|(_, keep)| **keep).map(|(face, _)| face);
        (mesh.topology().vertex_count(), kept.collect())
    })
}

/// Whether each vertex's faces hang together through edges at that vertex: by brute force.
fn each_vertex_has_one_fan(vertex_count: usize, faces: &[[u32; 3]]) -> bool {
    (0..vertex_count as u32).all(|vertex| {
        let around: Vec<_> = faces.iter().filter(|face| face.contains(&vertex)).collect();
        let mut reached: Vec<_> = around.iter().take(1).collect();
        loop {
            let touches = |face: &&&&[u32; 3]| reached.iter().any(|known| known.iter().filter(|v| face.contains(v)).count() == 2);
            let Some(next) = around.iter().find(|face| !reached.contains(face) && touches(&face)) else { break };
            reached.push(next);
        }
        reached.len() == around.len()
    })
}

fn integers(summary: &Summary) -> [i64; 8] {
    let s = summary;
    let counts = [s.vertices, s.unreferenced_vertices, s.edges, s.faces, s.boundary_loops, s.components, s.genus];
    let [a, b, c, d, e, f, g] = counts.map(|count| count as i64);
    [a, b, c, d, e, f, g, s.euler_characteristic]
}

proptest! {
    #[test]
    fn numbering_changes_no_count_and_no_measure((mesh, other) in shuffled()) {
        prop_assert_eq!(other.topology().check(), Ok(()));
        let (a, b) = (Summary::of(&mesh), Summary::of(&other));
        prop_assert_eq!(integers(&a), integers(&b));
        for (x, y) in [(a.area, b.area), (a.diameter, b.diameter), (a.mean_edge_length, b.mean_edge_length)] {
            prop_assert!((x - y).abs() <= 1e-12 * x);
        }
    }

    #[test]
    fn rings_agree_with_a_search_through_all_faces((_, mesh) in shuffled()) {
        let topology = mesh.topology();
        for vertex in topology.vertices() {
            let mut ring: Vec<_> = vertex.neighbours().map(Vertex::id).collect();
            let mut expected: Vec<_> = topology.half_edges()
                .flat_map(|h| [(h.origin(), h.tip()), (h.tip(), h.origin())])
                .filter(|ends| ends.0 == vertex).map(|ends| ends.1.id()).collect();
            ring.sort();
            expected.sort();
            expected.dedup();
            prop_assert_eq!(&ring, &expected);
            let on_boundary = topology.half_edges().any(|h| h.twin().is_none() && (h.origin() == vertex || h.tip() == vertex));
            prop_assert_eq!(vertex.is_boundary(), on_boundary);
            let steps: Vec<_> = vertex.leaving().collect();
            prop_assert!(steps.windows(2).all(|pair| pair[0].rotate_left() == Some(pair[1]) && pair[1].rotate_right() == Some(pair[0])));
        }
    }

    #[test]
    fn open_surfaces_are_accepted_exactly_if_no_vertex_is_torn((vertex_count, faces) in with_faces_removed()) {
        match Topology::from_triangles(vertex_count, &faces) {
            Ok(topology) => {
                prop_assert!(each_vertex_has_one_fan(vertex_count, &faces));
                prop_assert_eq!(topology.check(), Ok(()));
                let loops = topology.boundary_loops();
                prop_assert_eq!(loops.iter().map(|walk| walk.edge_count()).sum::<usize>(), topology.boundary_edge_count());
                for walk in loops {
                    let walk: Vec<_> = walk.half_edges().collect();
                    for k in 0..walk.len() {
                        prop_assert_eq!(walk[k].tip(), walk[(k + 1) % walk.len()].origin());
                        prop_assert!(walk[k].is_boundary());
                    }
                }
                let pieces = topology.components();
                prop_assert_eq!(pieces.iter().map(|piece| piece.faces().len()).sum::<usize>(), topology.face_count());
                prop_assert!(topology.edges().all(|edge| edge.faces().all(|face| pieces.index_of(face.id()) == pieces.index_of(edge.half_edge().face().id()))));
                let even = 2 * pieces.count() as i64 - topology.boundary_loops().len() as i64 - topology.euler_characteristic();
                prop_assert!(even >= 0 && even % 2 == 0);
            }
            Err(TopologyError::NonManifoldVertex { .. }) => prop_assert!(!each_vertex_has_one_fan(vertex_count, &faces)),
            Err(other) => prop_assert!(false, "{}", other),
        }
    }

    #[test]
    fn any_list_of_indices_gives_a_sound_topology_or_an_error(faces in prop::collection::vec([0..9_u32, 0..9_u32, 0..9_u32], 0..20)) {
        if let Ok(topology) = Topology::from_triangles(8, &faces) {
            prop_assert_eq!(topology.check(), Ok(()));
            prop_assert_eq!(topology.triangles().collect::<Vec<_>>(), faces);
        }
    }
}

#[test]
fn faults_name_the_faces() {
    let error = |faces: &[[u32; 3]]| Topology::from_triangles(6, faces).unwrap_err();
    assert_eq!(error(&[[0, 1, 6]]), TopologyError::VertexOutOfRange { face: 0, vertex: 6, vertex_count: 6 });
    for face in [[3, 3, 1], [3, 1, 3], [1, 3, 3]] {
        assert_eq!(error(&[[0, 1, 2], face]), TopologyError::DegenerateFace { face: 1, vertex: 3 });
    }
    assert_eq!(error(&[[0, 1, 2], [3, 0, 1]]), TopologyError::EdgeUsedTwice { first: 0, second: 1, from: 0, to: 1 });
    let page = |k| [0, 1, k];
    assert!(matches!(error(&[page(2), [1, 0, 3], page(4)]), TopologyError::EdgeUsedTwice { first: 0, second: 2, .. }));
    assert_eq!(error(&[[0, 1, 2], [2, 3, 4]]), TopologyError::NonManifoldVertex { vertex: 2 });
    let strip = [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5], [4, 5, 1], [1, 5, 0]];
    assert!(matches!(error(&strip), TopologyError::NotOrientable { .. }));
    assert!(matches!(Topology::from_triangles(1 << 31, &[]), Err(TopologyError::TooManyVertices { .. })));
}

#[test]
fn no_faces_make_an_empty_surface() {
    let mesh = Mesh::from_triangles(vec![DVec3::ZERO; 3], &[]).unwrap();
    let summary = Summary::of(&mesh);
    assert_eq!((summary.faces, summary.vertices, summary.unreferenced_vertices, summary.components), (0, 0, 3, 0));
    assert_eq!((summary.diameter, summary.mean_edge_length, summary.area), (0.0, 0.0, 0.0));
    assert!(!summary.is_closed());
}

#[test]
fn slivers_have_normals_and_angles() {
    for height in [1e-2, 1e-8, 1e-100] {
        let mesh = Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, DVec3::new(0.5, height, 0.0)], &[[0, 1, 2]]).unwrap();
        let face = mesh.face(FaceId(0));
        assert_eq!(face.normal(), DVec3::Z);
        let angles = face.angles();
        assert!((angles[0] - 2.0 * height).abs() < 1e-2 * height && (angles[0] - angles[1]).abs() < 1e-9 * height, "{angles:?}");
    }
    let flat = Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X, DVec3::X], &[[0, 1, 2], [1, 0, 3]]).unwrap();
    assert!(flat.vertex_normals().iter().all(|&n| n == DVec3::ZERO));
    assert!(flat.face(FaceId(1)).angles().iter().all(|a| a.is_finite()));
}

#[test]
fn normals_at_vertices_do_not_depend_on_how_a_flat_side_is_cut() {
    // The three sides at a cube's corner have four, five or six triangles there; each side counts the same.
    for segments in [3, 4] {
        let cube = rounded_die(2.0, 0.0, segments).unwrap();
        for (p, n) in cube.positions().iter().zip(cube.vertex_normals()) {
            let outermost = p.abs().cmpge(DVec3::splat(1.0 - 1e-12));
            let expected = DVec3::select(outermost, p.signum(), DVec3::ZERO).normalize();
            assert!(n.distance(expected) < 1e-12, "at {p}: {n}");
        }
    }
}

#[test]
fn normals_and_angles_hold_beyond_where_squares_do() {
    let unit = torus(1.0, 0.4, 12, 8).unwrap();
    for scale in [1e-250, 1e-160, 1e160, 1e250] {
        let scaled = unit.with_positions(unit.positions().iter().map(|&p| scale * p).collect()).unwrap();
        for (a, b) in unit.vertex_normals().iter().zip(scaled.vertex_normals()) {
            assert!(a.distance(b) < 1e-12, "× {scale}: {a} became {b}");
        }
        for (face, other) in unit.faces().zip(scaled.faces()) {
            assert!(face.normal().distance(other.normal()) < 1e-12);
            let angles = face.angles().into_iter().zip(other.angles());
            assert!(angles.into_iter().all(|(a, b)| (a - b).abs() < 1e-12));
        }
    }
}
