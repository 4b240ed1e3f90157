//! Repairs, one at a time on small soups.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

mod mending;

use glam::{DVec2, DVec3};
use mending::{NONE, counts, flat, mend, soup_of, triangles};
use pelage_mesh::{
    Face, Mesh, RepairError, RepairReport, RepairSettings, Soup, Summary, Vertex, parse_obj, plane, repair, rounded_die, sphere, torus,
};

#[test]
fn a_surface_that_is_one_keeps_every_bit() {
    for mesh in [sphere(1.0, 5).unwrap(), torus(1.0, 0.4, 9, 7).unwrap(), plane(1.0, 2.0, 4, 3).unwrap(), rounded_die(1.0, 0.0, 3).unwrap()]
    {
        let repaired = mend(soup_of(&mesh));
        assert_eq!(repaired.report, NONE);
        assert!(repaired.mesh.topology() == mesh.topology() && repaired.mesh.positions() == mesh.positions());
        assert!(repaired.polygons.iter().enumerate().all(|(face, &polygon)| face == polygon as usize));
    }
}

#[test]
fn near_vertices_weld_and_others_do_not() {
    let pair = |gap: f64| {
        let mut positions = flat(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]);
        positions.extend([DVec3::new(1.0 + gap, 0.0, 0.0), DVec3::new(0.0, 1.0, gap)]);
        Soup::from_polygons(positions, [[0, 1, 2], [4, 3, 5]])
    };
    let welded = |gap: f64| mend(pair(gap)).report.vertices_welded;
    assert_eq!((welded(0.0), welded(-0.0), welded(1e-6), welded(2e-6)), (2, 2, 2, 0));
    let exact = RepairSettings { weld: 0.0 };
    assert_eq!(repair(pair(0.0), &exact).unwrap().report.vertices_welded, 2);
    assert_eq!(repair(pair(1e-15), &exact).unwrap().report.vertices_welded, 0);
    // The first keeps its place.
    assert_eq!(mend(pair(1e-6)).mesh.positions(), &pair(0.0).positions[..4]);
}

#[test]
fn one_face_far_away_swallows_nothing() {
    let ball = sphere(1.0, 20).unwrap();
    for distance in [1e3, 1e6, 1e9] {
        let mut soup = soup_of(&ball);
        let first = soup.positions.len() as u32;
        soup.positions.extend(flat(&[(distance, 0.0), (1.5 * distance, 0.0), (distance, distance)]));
        soup.corners.extend([first, first + 1, first + 2]);
        soup.ends.push(soup.corners.len() as u32);
        let repaired = mend(soup);
        assert_eq!((repaired.report, repaired.mesh.topology().face_count()), (NONE, 8001), "{distance}");
    }
}

#[test]
fn a_chain_of_near_vertices_does_not_collapse() {
    // A thousand vertices, each within reach of the next, along a tenth of the side.
    let count = 1000;
    let arc = (0..count).map(|k| DVec3::new(0.5e-6 * f64::from(k), 1.0, 0.0));
    let positions: Vec<DVec3> = [DVec3::ZERO, DVec3::X].into_iter().chain(arc).collect();
    let fan = (0..count as u32 - 1).map(|k| [0, k + 3, k + 2]);
    let repaired = mend(Soup::from_polygons(positions, fan.chain([[0, 1, 2 + count as u32 - 1]])));
    let kept = repaired.mesh.topology().vertex_count();
    assert!((180..=380).contains(&kept), "{kept}");
    let moved = repaired.mesh.area() - 0.5 * (1.0 + 0.5e-6 * f64::from(count - 1));
    assert!(moved.abs() < 1e-5, "{moved}");
}

#[test]
fn polygons_keep_their_area_whatever_their_shape() {
    let arrow = flat(&[(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (0.5, 1.0)]);
    let star: Vec<(f64, f64)> = (0..10)
        .map(|k| {
            let (angle, radius) = (std::f64::consts::PI * f64::from(k) / 5.0, if k % 2 == 0 { 1.0 } else { 0.3 });
            (radius * angle.cos(), radius * angle.sin())
        })
        .collect();
    let comb = [
        (0.0, 0.0),
        (5.0, 0.0),
        (5.0, 3.0),
        (4.0, 3.0),
        (4.0, 1.0),
        (3.0, 1.0),
        (3.0, 3.0),
        (2.0, 3.0),
        (2.0, 1.0),
        (1.0, 1.0),
        (1.0, 3.0),
        (0.0, 3.0),
    ];
    let straight = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (3.0, 1.0), (0.0, 1.0)];
    let mut worst = 0.0_f64;
    for polygon in [arrow, flat(&star), flat(&comb), flat(&straight)] {
        let count = polygon.len();
        let area: f64 = (0..count).map(|k| 0.5 * polygon[k].cross(polygon[(k + 1) % count]).z).sum();
        for shift in 0..count {
            for axis in 0..3 {
                let placed = |p: &DVec3| [*p, DVec3::new(p.z, p.x, p.y), DVec3::new(p.y, p.z, p.x)][axis];
                let ring: Vec<u32> = (0..count).map(|k| ((k + shift) % count) as u32).collect();
                let repaired = mend(Soup::from_polygons(polygon.iter().map(placed).collect(), [ring]));
                let mesh = &repaired.mesh;
                assert_eq!((mesh.topology().face_count(), mesh.topology().edge_count()), (count - 2, 2 * count - 3));
                assert!((mesh.area() - area).abs() < 1e-12 * area, "{} for {area}", mesh.area());
                let upwards = mesh.faces().map(Face::area_vector).sum::<DVec3>();
                assert!((upwards.length() - area).abs() < 1e-12 * area, "some faces are turned");
                assert_eq!(repaired.report, NONE);
                worst = worst.max((mesh.area() - area).abs() / area);
            }
        }
    }
    println!("reached: areas within {worst:.0e}");
}

#[test]
fn a_round_polygon_is_not_cut_into_needles() {
    let circle: Vec<DVec3> =
        (0..64).map(|k| f64::from(k) * std::f64::consts::TAU / 64.0).map(|a| DVec3::new(a.cos(), a.sin(), 0.0)).collect();
    let repaired = mend(Soup::from_polygons(circle, [(0..64).collect::<Vec<u32>>()]));
    let valence = repaired.mesh.vertices().map(Vertex::valence).max().unwrap();
    assert!(valence <= 12, "a fan would have 63, this has {valence}");
}

#[test]
fn a_saddle_gives_two_triangles_and_a_ring_with_a_bridge_its_hole() {
    let saddle = [DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0), DVec3::new(1.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 1.0)];
    assert_eq!(triangles(&mend(Soup::from_polygons(saddle.to_vec(), [[0, 1, 2, 3]])).mesh), [[0, 1, 2], [0, 2, 3]]);
    // Around a square, over to a square within, around that the other way, and back.
    let corners = flat(&[(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0), (1.0, 1.0), (1.0, 2.0), (2.0, 2.0), (2.0, 1.0)]);
    let keyhole = mend(Soup::from_polygons(corners, [[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]]));
    assert_eq!((counts(&keyhole.mesh), keyhole.report), ([8, 16, 8, 8, 2, 1, 0], NONE));
    assert!((keyhole.mesh.area() - 8.0).abs() < 1e-12);
}

#[test]
fn polygons_that_cross_themselves_are_cut_anyhow() {
    let corners = flat(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0), (0.5, 2.0), (0.5, -1.0)]);
    let repaired = mend(Soup::from_polygons(corners, [[0, 1, 2, 3, 4, 5]]));
    assert!(repaired.mesh.topology().face_count() >= 2);
    let bow = flat(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]);
    let lopsided = flat(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 2.0)]);
    for polygon in [bow, lopsided] {
        assert_eq!(mend(Soup::from_polygons(polygon, [[0, 1, 2, 3]])).report.polygons_tangled, 1);
    }
}

#[test]
fn corners_that_repeat_are_left_out() {
    let corners = flat(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 1.0)]);
    let polygons: [&[u32]; 5] = [&[0, 1, 2, 2], &[0, 0, 2, 4, 3, 0], &[0, 0, 1], &[1, 2], &[]];
    let repaired = mend(Soup::from_polygons(corners, polygons));
    assert_eq!(triangles(&repaired.mesh), [[0, 1, 2], [0, 2, 3]]);
    let expected = RepairReport { vertices_welded: 1, corners_repeated: 4, faces_collapsed: 1, faces_with_few_corners: 2, ..NONE };
    assert_eq!(repaired.report, expected);
}

#[test]
fn a_flat_face_in_a_t_junction_leaves_no_slit() {
    // Above the line two faces, below it one, and a flat one between.
    let corners = flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0), (1.0, -1.0)]);
    let mut soup = Soup::from_polygons(corners, [[0, 1, 3], [1, 2, 3], [0, 2, 1], [0, 4, 2]]);
    soup.texture_coordinates = soup.positions.iter().map(|p| p.truncate() * 0.25).collect();
    soup.corner_coordinates = soup.corners.clone();
    let repaired = mend(soup);
    assert_eq!((counts(&repaired.mesh), repaired.report), ([5, 8, 4, 4, 1, 1, 0], RepairReport { junctions_split: 1, ..NONE }));
    assert!((repaired.mesh.area() - 2.0).abs() < 1e-15);
    // The halves have the texture that the whole had.
    for (corner, uv) in repaired.mesh.half_edges().zip(repaired.mesh.texture_coordinates().unwrap()) {
        assert_eq!(*uv, corner.origin().position().truncate() * 0.25);
    }
    // Without a face below, the flat one was the border, and the border moves up.
    let corners = flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0)]);
    let repaired = mend(Soup::from_polygons(corners, [[0, 1, 3], [1, 2, 3], [0, 2, 1]]));
    assert_eq!((counts(&repaired.mesh), repaired.report), ([4, 5, 4, 2, 1, 1, 0], RepairReport { faces_without_area: 1, ..NONE }));
}

#[test]
fn a_row_of_flat_faces_is_split_one_after_another() {
    // Twenty vertices along a line, faces to each above it, one face below it, and a fan of flat faces between.
    let count = 20_u32;
    let mut corners = flat(&[(0.0, 1.0), (0.0, -1.0)]);
    corners.extend((0..count).map(|k| DVec3::new(f64::from(k), 0.0, 0.0)));
    let above = (0..count - 1).map(|k| [k + 2, k + 3, 0]);
    let between = (1..count - 1).map(|k| [2, k + 3, k + 2]);
    let below = [[2, 1, count + 1]];
    for reversed in [false, true] {
        let mut faces: Vec<[u32; 3]> = above.clone().chain(between.clone()).chain(below).collect();
        if reversed {
            faces.reverse();
        }
        let repaired = mend(Soup::from_polygons(corners.clone(), faces));
        assert_eq!(repaired.report, RepairReport { junctions_split: count as usize - 2, ..NONE });
        let n = count as usize;
        assert_eq!(counts(&repaired.mesh), [n + 2, 3 * n - 1, 4, 2 * n - 2, 1, 1, 0]);
        assert!((repaired.mesh.area() - f64::from(count - 1)).abs() < 1e-9);
    }
}

#[test]
fn a_sheet_given_from_both_sides_is_one_sheet() {
    let sheet = plane(1.0, 1.0, 3, 3).unwrap();
    let both = sheet.topology().triangles().chain(sheet.topology().triangles().map(|[a, b, c]| [a, c, b]));
    let repaired = mend(Soup::from_polygons(sheet.positions().to_vec(), both));
    assert_eq!((counts(&repaired.mesh), repaired.report), (counts(&sheet), RepairReport { faces_duplicated: 18, ..NONE }));
    // A lone face from both sides would be a closed surface of two.
    let lone = mend(Soup::from_polygons(flat(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]), [[0, 1, 2], [0, 2, 1]]));
    assert_eq!(lone.report, RepairReport { faces_duplicated: 1, ..NONE });
}

#[test]
fn two_boxes_that_share_an_edge_stay_two_boxes() {
    // Unit boxes at (0, 0) and (1, 1), each a hexahedron of quads.
    let mut positions = Vec::new();
    let mut polygons: Vec<[u32; 4]> = Vec::new();
    for shift in [DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0)] {
        let first = positions.len() as u32;
        positions.extend((0..8).map(|k| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2 & 1)) + shift));
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        polygons.extend(sides.map(|side| side.map(|k: u32| first + k)));
    }
    let repaired = mend(Soup::from_polygons(positions, polygons));
    assert_eq!(counts(&repaired.mesh), [16, 36, 0, 24, 0, 2, 0]);
    assert_eq!(repaired.report, RepairReport { vertices_welded: 2, edges_split: 1, vertices_added: 2, ..NONE });
}

#[test]
fn a_wall_within_a_ball_is_taken_out_whole() {
    // A ball of two halves and a disc across its middle.
    let ball = sphere(1.0, 4).unwrap();
    let mut faces = triangles(&ball);
    let mut positions = ball.positions().to_vec();
    // The rim of half the faces, closed with a fan.
    let half = |face: &[u32; 3]| face.iter().map(|&v| ball.positions()[v as usize].z).sum::<f64>() > 0.0;
    let cap = Mesh::from_triangles(positions.clone(), &faces.iter().copied().filter(half).collect::<Vec<_>>()).unwrap();
    let rim: Vec<[u32; 2]> = cap.boundary_loops()[0].half_edges().map(|h| [h.origin().id().0, h.tip().id().0]).collect();
    let centre = positions.len() as u32;
    positions.push(DVec3::ZERO);
    faces.extend(rim.iter().map(|&[a, b]| [a, b, centre]));
    let repaired = mend(Soup::from_polygons(positions, faces));
    assert_eq!((repaired.report.edges_split, repaired.report.vertices_added), (rim.len(), rim.len()));
    let n = rim.len();
    let expected = [ball.topology().vertex_count() + n + 1, ball.topology().edge_count() + 2 * n, n, 320 + n, 1, 2, 0];
    assert_eq!(counts(&repaired.mesh), expected);
}

#[test]
fn a_book_of_very_many_pages_is_taken_apart() {
    let pages = 40_000_u32;
    let page = |k: u32| DVec3::new(1.0 + f64::from(k), (0.01 * f64::from(k)).sin(), 0.0);
    let positions = [DVec3::ZERO, DVec3::Z].into_iter().chain((0..pages).map(page)).collect();
    let repaired = mend(Soup::from_polygons(positions, (0..pages).map(|k| [0, 1, k + 2])));
    assert_eq!(repaired.mesh.components().count(), pages as usize);
}

#[test]
fn a_fan_that_comes_by_an_edge_twice_is_opened() {
    // A ring of three faces around, pinched until two opposite vertices of its waist are one: an edge of four faces whose ends have one fan each.
    let tube = torus(1.0, 0.4, 6, 3).unwrap();
    for other in 1..tube.topology().vertex_count() as u32 {
        let faces = tube.topology().triangles().map(|face| face.map(|v| if v == other { 0 } else { v }));
        let repaired = mend(Soup::from_polygons(tube.positions().to_vec(), faces));
        assert!(repaired.mesh.topology().face_count() >= 30, "{other}: {}", repaired.report);
    }
}

#[test]
fn one_sided_strips_of_any_length_are_cut_into_discs() {
    for length in 3..12 {
        let at = |k: usize, side: f64| {
            let angle = std::f64::consts::TAU * k as f64 / length as f64;
            let (half, radius) = (0.5 * angle, 1.0 + 0.4 * side * (0.5 * angle).cos());
            DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.4 * side * half.sin())
        };
        let positions: Vec<DVec3> = (0..length).flat_map(|k| [at(k, -1.0), at(k, 1.0)]).collect();
        let name = |k: usize, side: usize| (if k < length { 2 * k + side } else { 1 - side }) as u32;
        let quads = (0..length).map(|k| [name(k, 0), name(k + 1, 0), name(k + 1, 1), name(k, 1)]);
        let repaired = mend(Soup::from_polygons(positions, quads));
        let summary = Summary::of(&repaired.mesh);
        assert_eq!((summary.components, summary.boundary_loops, summary.genus, summary.faces), (1, 1, 0, 2 * length), "{length}");
        assert_eq!(repaired.report, RepairReport { edges_cut: 1, vertices_added: 2, ..NONE }, "{length}");
    }
}

#[test]
fn closed_pieces_face_outwards_but_for_the_walls_of_cavities() {
    let (outer, inner) = (sphere(1.0, 3).unwrap(), sphere(0.5, 3).unwrap());
    let (count, shift) = (outer.topology().vertex_count() as u32, DVec3::new(3.0, 0.1, -0.2));
    let inwards = |first: u32| outer.topology().triangles().map(move |[a, b, c]| [a + first, c + first, b + first]);
    // A ball with a cavity in it, and beside it a ball turned inside out.
    let positions =
        outer.positions().iter().copied().chain(inner.positions().iter().copied()).chain(outer.positions().iter().map(|&p| p + shift));
    let faces = outer.topology().triangles().chain(inwards(count)).chain(inwards(2 * count));
    let repaired = mend(Soup::from_polygons(positions.collect(), faces));
    assert_eq!(repaired.report, RepairReport { pieces_turned: 1, ..NONE });
    let volume = outer.signed_volume();
    let summary = Summary::of(&repaired.mesh);
    assert!((summary.signed_volume - (2.0 - 0.125) * volume).abs() < 1e-9 * volume, "{} balls", summary.signed_volume / volume);
    // An open piece has no inside.
    let open = plane(1.0, 1.0, 2, 2).unwrap();
    let upside_down = open.topology().triangles().map(|[a, b, c]| [a, c, b]);
    assert_eq!(mend(Soup::from_polygons(open.positions().to_vec(), upside_down)).report, NONE);
}

#[test]
fn faults_say_where() {
    let fail = |soup: Soup| repair(soup, &RepairSettings::default()).unwrap_err();
    let corners = flat(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
    let soup = |polygons: &[[u32; 3]]| Soup::from_polygons(corners.clone(), polygons.iter().copied());
    assert_eq!(fail(soup(&[])), RepairError::NoFaces);
    assert_eq!(fail(soup(&[[0, 0, 1]])), RepairError::NoSurface { faces: 1 });
    assert_eq!(fail(soup(&[[0, 1, 2], [0, 1, 3]])), RepairError::VertexOutOfRange { polygon: 1, vertex: 3, count: 3 });
    let mut nowhere = soup(&[[0, 1, 2]]);
    nowhere.positions[2].y = f64::NAN;
    assert_eq!(fail(nowhere), RepairError::NotFinite { vertex: 2 });
    let textured =
        |coordinates: Vec<DVec2>| Soup { texture_coordinates: coordinates, corner_coordinates: vec![0, 0, 1], ..soup(&[[0, 1, 2]]) };
    assert_eq!(fail(textured(vec![DVec2::ZERO])), RepairError::CoordinateOutOfRange { polygon: 0, index: 1, count: 1 });
    assert_eq!(fail(textured(vec![DVec2::ZERO, DVec2::NAN])), RepairError::CoordinateNotFinite { polygon: 0 });
    assert!(matches!(fail(Soup { ends: vec![4], ..soup(&[[0, 1, 2]]) }), RepairError::Arrays { .. }));
    assert!(matches!(fail(Soup { corner_coordinates: vec![0], ..soup(&[[0, 1, 2]]) }), RepairError::Arrays { .. }));
    assert!(matches!(fail(Soup { ends: vec![2, 1, 3], ..soup(&[[0, 1, 2]]) }), RepairError::Arrays { .. }));
}

#[test]
fn scale_and_place_change_no_repair() {
    let torn = torn_sample();
    let here = mend(torn.clone());
    assert!(here.report.counts().iter().filter(|(_, _, count)| *count > 0).count() >= 8, "{}", here.report);
    for scale in [1e-300, 1e-42, 1e-30, 1e-15, 1e15, 1e30, 1e300] {
        let soup = Soup { positions: torn.positions.iter().map(|&p| p * scale).collect(), ..torn.clone() };
        let scaled = mend(soup);
        assert_eq!(scaled.report, here.report, "× {scale}");
        assert!(scaled.mesh.topology() == here.mesh.topology(), "× {scale}");
    }
    // A power of two, so that the coordinates hold the offset exactly, about ten million times the size.
    let offset = DVec3::new(f64::from(1 << 25), -f64::from(1 << 24), f64::from(1 << 23));
    let positions: Vec<DVec3> = torn.positions.iter().map(|&p| p + offset).collect();
    assert_eq!(mend(Soup { positions, ..torn }).report, here.report);
}

/// A ball and a sheet with nearly everything wrong with them.
fn torn_sample() -> Soup {
    let ball = sphere(1.0, 4).unwrap();
    let mut positions = ball.positions().to_vec();
    let mut polygons: Vec<Vec<u32>> = triangles(&ball).into_iter().map(Vec::from).collect();
    polygons.push(polygons[5].clone());
    polygons[11].reverse();
    polygons.push(vec![3, 3, 4]);
    polygons.push(vec![3, 4]);
    // A corner of its own, a fin, and a vertex without a face.
    let first = positions.len() as u32;
    positions.push(positions[polygons[20][0] as usize]);
    polygons[20][0] = first;
    positions.extend([DVec3::new(2.0, 2.0, 0.5), DVec3::splat(0.25)]);
    let [a, b] = [polygons[40][0], polygons[40][1]];
    polygons.push(vec![a, b, first + 1]);
    // The flat face of a T-junction, and a concave polygon.
    let sheet = positions.len() as u32;
    positions
        .extend(flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0), (1.0, -1.0), (1.5, -0.5)]).into_iter().map(|p| p + 3.0 * DVec3::X));
    polygons.extend([[0, 1, 3], [1, 2, 3], [0, 2, 1]].map(|face| face.map(|v: u32| sheet + v).to_vec()));
    polygons.push([0, 4, 2].map(|v: u32| sheet + v).to_vec());
    Soup::from_polygons(positions, polygons)
}

#[test]
fn faces_know_the_lines_they_come_from() {
    let import = parse_obj(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 1 2\nf 1 2 3 4\nf 2 3 5\n").unwrap();
    assert_eq!(import.face_lines, [7, 7, 8]);
    assert_eq!(import.repairs, RepairReport { faces_collapsed: 1, faces_turned: 1, ..NONE });
}
