//! What views say of vertices, edges, faces, rings, loops and components, against searches through all faces and against formulas.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

mod common;

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

use common::{joined, models, sawtooth_fan, sheet_with_hole, twisted_strip};
use glam::{DVec3, EulerRot};
use pelage_mesh::{BoundaryLoop, Component, Edge, Face, FaceId, HalfEdge, Mesh, Vertex, VertexId, plane, rounded_die, sphere, torus};

fn surfaces() -> Vec<(String, Mesh)> {
    let made = [
        ("ball", sphere(1.0, 5).unwrap()),
        ("torus", torus(1.0, 0.4, 9, 7).unwrap()),
        ("cube", rounded_die(2.0, 0.0, 3).unwrap()),
        ("sheet", plane(2.0, 1.0, 5, 4).unwrap()),
        ("one face", plane(1.0, 1.0, 1, 1).unwrap()),
        ("hole", sheet_with_hole().0),
        ("saddle", sawtooth_fan(0.0, 1.0).mesh),
        ("strip", twisted_strip(8)),
        ("pair", joined(&torus(1.0, 0.2, 5, 4).unwrap(), &plane(1.0, 1.0, 2, 2).unwrap(), 4.0 * DVec3::X)),
    ];
    made.into_iter().map(|(name, mesh)| (name.to_owned(), mesh)).collect()
}

fn ids<'a>(vertices: impl IntoIterator<Item = Vertex<'a, Mesh>>) -> BTreeSet<u32> {
    vertices.into_iter().map(|vertex| vertex.id().0).collect()
}

/// Every sentence about a vertex, by looking through all faces.
#[test]
fn vertices_know_what_surrounds_them() {
    for (name, mesh) in surfaces() {
        let edges: BTreeSet<[u32; 2]> =
            mesh.topology().triangles().flat_map(|[a, b, c]| [[a.min(b), a.max(b)], [b.min(c), b.max(c)], [c.min(a), c.max(a)]]).collect();
        for vertex in mesh.vertices() {
            let v = vertex.id().0;
            let faces: Vec<[u32; 3]> = mesh.topology().triangles().filter(|face| face.contains(&v)).collect();
            let around: BTreeSet<u32> = edges.iter().filter(|ends| ends.contains(&v)).map(|ends| ends[0] + ends[1] - v).collect();
            assert_eq!((vertex.face_count(), vertex.valence()), (faces.len(), around.len()), "{name}: {vertex:?}");
            assert_eq!(vertex.is_referenced(), !faces.is_empty());
            assert_eq!(ids(vertex.neighbours()), around);
            assert_eq!(vertex.neighbours().count(), around.len(), "each once");
            let ends: BTreeSet<u32> = vertex.edges().flat_map(Edge::vertices).map(|end| end.id().0).filter(|&end| end != v).collect();
            assert_eq!((ends, vertex.edges().count()), (around.clone(), around.len()));
            assert_eq!(vertex.faces().map(Face::id).collect::<BTreeSet<_>>().len(), faces.len());
            assert!(
                vertex.leaving().all(|half_edge| half_edge.origin() == vertex)
                    && vertex.arriving().all(|half_edge| half_edge.tip() == vertex)
            );
            // The rim of the star: around in order, a loop unless the vertex is on the boundary.
            let link: Vec<HalfEdge<'_, Mesh>> = vertex.link().collect();
            assert!(link.iter().all(|side| side.apex() == vertex));
            assert!(link.windows(2).all(|pair| pair[0].tip() == pair[1].origin()));
            if let (Some(first), Some(last)) = (link.first(), link.last()) {
                assert_eq!(last.tip() != first.origin(), vertex.is_boundary(), "{name}: {vertex:?}");
            }
            for other in mesh.vertices() {
                let joined = around.contains(&other.id().0);
                assert_eq!(vertex.edge_to(other.id()).is_some(), joined, "{name}: {vertex:?} {other:?}");
                let runs = mesh.half_edges().find(|h| h.origin() == vertex && h.tip() == other);
                assert_eq!(vertex.half_edge_to(other.id()), runs);
            }
        }
    }
}

#[test]
fn half_edges_edges_and_faces_agree_with_each_other() {
    for (name, mesh) in surfaces() {
        for half_edge in mesh.half_edges() {
            assert_eq!(half_edge.next().next(), half_edge.previous());
            assert_eq!((half_edge.tip(), half_edge.apex()), (half_edge.next().origin(), half_edge.previous().origin()));
            assert!(half_edge.face().half_edges().contains(&half_edge));
            assert_eq!(half_edge.is_boundary(), half_edge.twin().is_none());
            if let Some(twin) = half_edge.twin() {
                assert_eq!((twin.twin(), twin.origin(), twin.tip()), (Some(half_edge), half_edge.tip(), half_edge.origin()));
                assert_eq!(twin.edge(), half_edge.edge());
                assert_eq!(half_edge.rotate_right().unwrap().rotate_left(), Some(half_edge));
            }
            assert!(half_edge.edge().half_edges().any(|side| side == half_edge), "{name}");
        }
        assert_eq!(mesh.edges().count(), mesh.topology().edge_count());
        for edge in mesh.edges() {
            assert_eq!(edge.faces().count(), if edge.is_boundary() { 1 } else { 2 });
            assert_eq!(mesh.edge(edge.half_edges().last().unwrap().id()), edge);
            assert!(edge.faces().all(|face| face.edges().contains(&edge)));
        }
        for face in mesh.faces() {
            let shares = |other: &Face<'_, Mesh>| *other != face && other.edges().iter().any(|edge| face.edges().contains(edge));
            let wanted: BTreeSet<FaceId> = mesh.faces().filter(shares).map(Face::id).collect();
            assert_eq!(face.neighbours().map(Face::id).collect::<BTreeSet<_>>(), wanted, "{name}: {face:?}");
            for (across, side) in face.across().into_iter().zip(face.half_edges()) {
                assert_eq!(across, side.twin().map(HalfEdge::face));
            }
            assert_eq!(face.is_boundary(), face.across().contains(&None));
        }
    }
}

#[test]
fn rings_are_those_of_a_breadth_first_search() {
    for (name, mesh) in surfaces() {
        for vertex in mesh.vertices() {
            let mut seen = BTreeSet::from([vertex.id().0]);
            let mut last = seen.clone();
            for ring in vertex.rings() {
                let next: BTreeSet<u32> =
                    last.iter().flat_map(|&v| ids(mesh.vertex(VertexId(v)).neighbours())).filter(|v| !seen.contains(v)).collect();
                assert_eq!(ids(ring.iter().copied()), next, "{name}: {vertex:?}");
                assert!(ring.windows(2).all(|pair| pair[0].id() < pair[1].id()));
                seen.extend(&next);
                last = next;
            }
            let piece = mesh.components();
            let whole = vertex.faces().next().map_or(1, |face| piece.of_face(face.id()).vertices().count());
            assert_eq!(seen.len(), whole, "{name}: the rings end when the piece does");
        }
    }
}

#[test]
fn loops_have_length_and_turning() {
    let only = |mesh: &Mesh| -> (usize, f64, f64) {
        let loops = mesh.boundary_loops();
        assert_eq!(loops.len(), 1);
        (loops[0].edge_count(), loops[0].length(), loops[0].turning())
    };
    let (edges, length, turning) = only(&plane(2.0, 1.0, 5, 4).unwrap());
    assert_eq!(edges, 18);
    assert!((length - 6.0).abs() < 1e-12 && (turning - TAU).abs() < 1e-12);
    let (mesh, _) = sheet_with_hole();
    let loops = mesh.boundary_loops();
    let (outer, hole): (Vec<_>, Vec<_>) = loops.into_iter().partition(|l| l.turning() > 0.0);
    assert!((outer[0].turning() - TAU).abs() < 1e-12 && (outer[0].length() - 18.0).abs() < 1e-12);
    assert!((hole[0].turning() + TAU).abs() < 1e-12 && (hole[0].length() - 8.0).abs() < 1e-12);
    for (name, mesh) in surfaces() {
        let all: usize = mesh.boundary_loops().into_iter().map(BoundaryLoop::edge_count).sum();
        assert_eq!(all, mesh.topology().boundary_edge_count(), "{name}");
        for walk in mesh.boundary_loops() {
            assert!(walk.edges().all(Edge::is_boundary) && walk.vertices().all(Vertex::is_boundary), "{name}");
            assert_eq!(walk.first(), walk.half_edges().min_by_key(|h| h.id()).unwrap());
        }
    }
}

#[test]
fn components_have_characteristic_genus_and_boundary_of_their_own() {
    let many =
        joined(&joined(&torus(1.0, 0.3, 9, 7).unwrap(), &sheet_with_hole().0, 9.0 * DVec3::X), &sphere(1.0, 3).unwrap(), 9.0 * DVec3::Y);
    let pieces = many.components();
    let said: Vec<_> =
        pieces.iter().map(|p| (p.euler_characteristic(), p.genus(), p.boundary_loops().len(), p.is_closed(), p.is_disc())).collect();
    assert_eq!(said, [(0, 1, 0, true, false), (0, 0, 2, false, false), (2, 0, 0, true, false)]);
    let disc = plane(1.0, 1.0, 3, 3).unwrap();
    assert!(disc.components().iter().all(Component::is_disc));
    for (name, mesh) in surfaces().into_iter().chain(models()) {
        let (topology, pieces) = (mesh.topology(), mesh.components());
        let sum = |of: fn(Component<'_, Mesh>) -> usize| -> usize { pieces.iter().map(of).sum() };
        assert_eq!(sum(|p| p.faces().len()), topology.face_count(), "{name}");
        assert_eq!(sum(|p| p.edges().count()), topology.edge_count(), "{name}");
        assert_eq!(sum(|p| p.vertices().count()), topology.referenced_vertex_count(), "{name}");
        assert_eq!(sum(|p| p.boundary_loops().len()), mesh.boundary_loops().len(), "{name}");
        assert_eq!(pieces.iter().map(Component::genus).sum::<usize>(), topology.genus(), "{name}");
        assert_eq!(pieces.iter().map(Component::euler_characteristic).sum::<i64>(), topology.euler_characteristic(), "{name}");
        assert!((pieces.iter().map(Component::area).sum::<f64>() / mesh.area() - 1.0).abs() < 1e-12, "{name}");
        assert_eq!(pieces.iter().all(Component::is_closed), topology.is_closed(), "{name}");
        for piece in pieces.iter() {
            assert!(piece.faces().all(|face| pieces.index_of(face.id()) == piece.index()), "{name}");
        }
    }
}

/// Gauss and Bonnet: angles say what counts say.
#[test]
fn angle_defects_add_up_to_the_characteristic() {
    for (name, mesh) in surfaces().into_iter().chain(models()) {
        for piece in mesh.components().iter() {
            let total: f64 = piece.vertices().map(Vertex::angle_defect).sum();
            let wanted = TAU * piece.euler_characteristic() as f64;
            assert!((total - wanted).abs() < 1e-7, "{name}: {total} for {wanted}");
        }
        let area: f64 = mesh.vertices().map(Vertex::area).sum();
        assert!((area / mesh.area() - 1.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn dihedral_angles_are_positive_over_ridges() {
    let cube = rounded_die(2.0, 0.0, 3).unwrap();
    let mut ridges = 0;
    for edge in cube.edges() {
        let on_ridge = edge.centre().abs().to_array().iter().filter(|&&x| x > 1.0 - 1e-9).count() == 2;
        let angle = edge.dihedral_angle().unwrap();
        assert!((angle - if on_ridge { PI / 2.0 } else { 0.0 }).abs() < 1e-12, "{angle} at {}", edge.centre());
        ridges += usize::from(on_ridge);
    }
    assert_eq!(ridges, 36);
    // Inside out, ridges are valleys; folded onto itself it turns by half a round; at a boundary there is nothing to turn over.
    let folded = |angle: f64| {
        let far = DVec3::new(0.5, angle.sin(), -angle.cos());
        let (mesh, side) = (vec![DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.0, 1.0), far], [[0, 2, 1], [0, 1, 3]]);
        let mesh = Mesh::from_triangles(mesh, &side).unwrap();
        mesh.edges().find_map(Edge::dihedral_angle).unwrap()
    };
    for angle in [-3.0, -1.0, -1e-9, 0.0, 1e-9, 0.5, 2.0, 3.0] {
        assert!((folded(angle) + angle).abs() < 1e-15, "{angle}: {}", folded(angle));
    }
    assert!((folded(PI).abs() - PI).abs() < 1e-12);
    assert_eq!(plane(1.0, 1.0, 1, 1).unwrap().edges().filter(|edge| edge.dihedral_angle().is_none()).count(), 4);
}

#[test]
fn corners_and_cotangents_are_those_of_the_triangle() {
    let mesh = torus(1.0, 0.4, 9, 7).unwrap();
    for face in mesh.faces() {
        for (k, side) in face.half_edges().into_iter().enumerate() {
            assert_eq!(side.angle().to_bits(), face.angles()[k].to_bits());
            assert!((side.opposite_cotangent() - 1.0 / face.angles()[(k + 2) % 3].tan()).abs() < 1e-12);
            assert!((side.length() - side.origin().position().distance(side.tip().position())).abs() < 1e-15);
        }
        assert!(face.at(DVec3::ONE / 3.0).distance(face.centre()) < 1e-15);
        assert!(
            (face.area_vector().length() - face.area()).abs() < 1e-15 && face.area_vector().normalize().distance(face.normal()) < 1e-12
        );
    }
    let sheet = plane(2.0, 1.0, 4, 2).unwrap();
    for half_edge in sheet.half_edges() {
        assert_eq!(half_edge.texture_coordinates(), Some(sheet.texture_coordinates().unwrap()[half_edge.index()]));
    }
    assert!(
        sphere(1.0, 2)
            .unwrap()
            .half_edges()
            .all(|h| h.texture_coordinates().is_some() || sphere(1.0, 2).unwrap().texture_coordinates().is_none())
    );
}

/// A cube whose sides are cut along diagonals chosen by the bits of a number.
fn cube_with_diagonals(bits: u32) -> Mesh {
    let corner = |k: usize| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2 & 1) as f64) * 2.0 - 1.0;
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let cut = |(k, [a, b, c, d]): (usize, [u32; 4])| if bits >> k & 1 == 0 { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] };
    let triangles: Vec<[u32; 3]> = sides.into_iter().enumerate().flat_map(cut).collect();
    Mesh::from_triangles((0..8).map(corner).collect(), &triangles).unwrap()
}

#[test]
fn normals_do_not_depend_on_the_diagonals() {
    for bits in 0..64 {
        let cube = cube_with_diagonals(bits);
        assert!(cube.signed_volume() > 7.99, "wound outwards");
        for vertex in cube.vertices() {
            assert!(
                vertex.normal().distance(vertex.position().normalize()) < 1e-12,
                "cut {bits:06b}: {} at {}",
                vertex.normal(),
                vertex.position()
            );
        }
    }
}

#[test]
fn normals_are_those_of_the_smooth_shape_to_second_order() {
    let error =
        |mesh: &Mesh, wanted: fn(DVec3) -> DVec3| mesh.vertices().map(|v| v.normal().distance(wanted(v.position()))).fold(0.0, f64::max);
    let of_torus = |p: DVec3| {
        let ring = DVec3::new(p.x, 0.0, p.z).normalize();
        (p - ring).normalize()
    };
    let coarse = [error(&sphere(1.0, 8).unwrap(), DVec3::normalize), error(&torus(1.0, 0.4, 24, 12).unwrap(), of_torus)];
    let fine = [error(&sphere(1.0, 32).unwrap(), DVec3::normalize), error(&torus(1.0, 0.4, 96, 48).unwrap(), of_torus)];
    println!("normals: {coarse:?} and with edges a quarter as long {fine:?}");
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(coarse < 0.05 && fine < 0.3 * coarse, "{coarse} {fine}");
    }
}

#[test]
fn normals_are_the_same_at_any_scale_one_by_one_or_all_at_once() {
    for (name, mesh) in surfaces() {
        let all = mesh.vertex_normals();
        for scale in [1e-200, 1e-30, 1.0, 1e30, 1e200] {
            let scaled = mesh.with_positions(mesh.positions().iter().map(|&p| scale * p).collect()).unwrap();
            for (vertex, normal) in scaled.vertices().zip(&all) {
                assert!(vertex.normal().distance(*normal) < 1e-12, "{name} × {scale}");
                assert!(vertex.is_referenced() == (vertex.normal() != DVec3::ZERO));
            }
        }
    }
}

/// A sheet split into needles by points that lie ever nearer to its edge, turned in space: still flat, still one normal.
#[test]
fn needles_have_the_normal_of_their_plane() {
    for height in [1e-3, 1e-6, 1e-9, 1e-12] {
        let turn = glam::DQuat::from_euler(EulerRot::XYZ, 0.4, 1.1, -0.7);
        let flat = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, height]];
        let positions = flat.map(|[x, y]| turn * DVec3::new(x, y, 0.0)).to_vec();
        let mesh = Mesh::from_triangles(positions, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]).unwrap();
        // The needle's own normal is as good as its coordinates: their rounding over its height.
        let allowed = 1e-15 / height + 1e-12;
        for vertex in mesh.vertices() {
            let error = vertex.normal().distance(turn * DVec3::Z);
            assert!(error < allowed, "height {height}, {vertex:?}: {error}");
        }
    }
}
