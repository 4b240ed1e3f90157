use super::*;

fn fault(text: &str) -> ObjError {
    parse_obj(text.as_bytes()).unwrap_err()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn vertices_keep_their_places_and_objects_share_them() {
    let text = "# two halves\nv 9 9 9\no first\nv 0 0 0\nv 1 0 0\nv 1 1 0\ng second\nusemtl fur\nv 0 1 0\nf 4 5 2\no third\nmtllib none.mtl\nf 2 3 4\n";
    let mesh = parse_obj(text.as_bytes()).unwrap();
    assert_eq!(mesh.positions()[0], DVec3::splat(9.0));
    assert_eq!(mesh.positions()[4], DVec3::Y);
    let topology = mesh.topology();
    assert_eq!((topology.face_count(), topology.edge_count(), topology.referenced_vertex_count()), (2, 5, 4));
    assert_eq!(topology.triangles().collect::<Vec<_>>(), [[3, 4, 1], [1, 2, 3]]);
}

#[test]
fn polygons_become_fans() {
    let mesh = parse_obj(format!("{SQUARE}f 1 2 3 4\n").as_bytes()).unwrap();
    assert_eq!(mesh.topology().triangles().collect::<Vec<_>>(), [[0, 1, 2], [0, 2, 3]]);
    assert!((mesh.area() - 1.0).abs() < 1e-15);
}

#[test]
fn relative_indices_count_back_from_the_line() {
    let mesh = parse_obj(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4 -2 -1\n").unwrap();
    assert_eq!(mesh.topology().triangles().collect::<Vec<_>>(), [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn a_texture_seam_does_not_tear_the_surface() {
    let coordinates = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0.25 0.25\nvt 0.75 0.75\nvt 0 1\n";
    let mesh = parse_obj(format!("{SQUARE}{coordinates}f 1/1 2/2 3/3\nf 1/4 3/5 4/6\n").as_bytes()).unwrap();
    assert_eq!((mesh.topology().edge_count(), mesh.topology().vertex_count()), (5, 4));
    let expected = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.25, 0.25), (0.75, 0.75), (0.0, 1.0)].map(DVec2::from);
    assert_eq!(mesh.texture_coordinates().unwrap(), expected);
}

#[test]
fn coordinates_are_kept_only_if_every_corner_has_them() {
    let coordinates = "vt 0 0\nvt 1 0\nvt 1 1\n";
    let some = parse_obj(format!("{SQUARE}{coordinates}f 1/1 2/2 3/3\nf 1 3 4\n").as_bytes()).unwrap();
    assert_eq!(some.texture_coordinates(), None);
    let none_there = parse_obj(format!("{SQUARE}f 1/1 2/2 3/3\n").as_bytes()).unwrap();
    assert_eq!(none_there.texture_coordinates(), None);
}

#[test]
fn what_is_no_surface_is_passed_over() {
    let text = "\u{feff}v 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\nv\t0 1 0\r\nvn 0 0 1\r\nl 1 2\r\np 3\r\ns off\r\nf 1//1 2//1 3//1\r\n";
    let mesh = parse_obj(text.as_bytes()).unwrap();
    assert_eq!(mesh.positions(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
    let mut latin = b"# caf\xe9\n".to_vec();
    latin.extend_from_slice(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    assert!(parse_obj(&latin).is_ok());
}

#[test]
fn numbers_keep_all_their_digits() {
    let mesh = parse_obj(b"v 1e-30 0.1234567890123456 1e30\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    assert_eq!(mesh.positions()[0], DVec3::new(1e-30, 0.1234567890123456, 1e30));
}

#[test]
fn faults_are_found_in_their_lines() {
    let check = |text: &str, line: Option<usize>, part: &str| {
        let error = fault(text);
        assert_eq!(error.line, line, "{error}");
        assert!(error.to_string().contains(part), "{error}");
    };
    check("", None, "no face");
    check("v 0 0 0\nl 1 1\n", None, "no face");
    check("v 0 0 0\nv 1 x 0\nf 1 1 1\n", Some(2), "three numbers");
    check("\n\nv 0 0\nf 1 1 1\n", Some(3), "three numbers");
    check(&format!("{SQUARE}vt 0\nf 1 2 3\n"), Some(5), "two numbers");
    check(&format!("{SQUARE}f 1 2 3\nf 1 b 3\n"), Some(6), "corners like");
    check(&format!("{SQUARE}f 1 2 /3\n"), Some(5), "corners like");
    check(&format!("{SQUARE}f 1 2 3\n\nf 1 3 9\n"), Some(7), "names vertex 9, but the file has 4");
    check(&format!("{SQUARE}f 1 2 0\n"), Some(5), "names vertex 0");
    check(&format!("f -1 -2 -3\n{SQUARE}"), Some(1), "names vertex -1");
    check(&format!("{SQUARE}vt 0 0\nf 1/1 2/1 3/-2\n"), Some(6), "coordinates -2, but the file has 1");
    check(&format!("{SQUARE}vt 0 0\nf 1/1 2/1 3/2\n"), Some(6), "coordinates 2, but the file has 1");
    check(&format!("{SQUARE}f 1 2 3 4\nf 1 2\n"), Some(6), "2 corners");
    check(&format!("{SQUARE}f\n"), Some(5), "0 corners");
    check("v 0 0 0\n\nv nan 0 0\nv 1 0 0\nf 1 2 3\n", Some(3), "vertex 2 has a coordinate");
    check("v 0 0 0\nv 1e400 0 0\nv 1 0 0\nf 1 2 3\n", Some(2), "vertex 2 has a coordinate");
    check(&format!("{SQUARE}f 1 2 3 4\nf 4 4 1\n"), Some(6), "vertex 4 twice");
    check(&format!("{SQUARE}f 1 2 3 4\nf 1 2 4\n"), Some(6), "line 5 run along the edge from vertex 1 to 2");
    check(&format!("{SQUARE}v 2 2 0\nv 2 3 0\nf 1 2 3\nf 3 5 6\n"), Some(3), "touch at vertex 3");
}

#[test]
fn a_one_sided_surface_is_named() {
    let strip: String = (0..6).map(|k| format!("v {k} 0 0\nv {k} 1 0\n")).collect();
    let quads: String = (0..5).map(|k| format!("f {} {} {} {}\n", 2 * k + 1, 2 * k + 3, 2 * k + 4, 2 * k + 2)).collect();
    let error = fault(&format!("{strip}{quads}f 11 2 1 12\n"));
    assert!(matches!(error.fault, ObjFault::NotOrientable { .. }), "{error}");
    let turned = fault(&format!("{strip}{quads}f 12 2 1 11\n"));
    assert!(matches!(turned.fault, ObjFault::EdgeUsedTwice { .. }), "{turned}");
}

#[test]
fn a_missing_file_is_named() {
    let error = read_obj(Path::new("no/such/model.obj")).unwrap_err();
    assert!(error.to_string().starts_with("no/such/model.obj: the file cannot be read"), "{error}");
}

#[test]
fn every_prefix_and_every_changed_byte_gives_a_mesh_or_an_error() {
    let whole = format!("# x\n{SQUARE}vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nf -4/-3 -2/-2 -1/-1\n");
    for end in 0..whole.len() {
        let _ = parse_obj(&whole.as_bytes()[..end]);
    }
    for place in 0..whole.len() {
        for byte in [b' ', b'\n', b'-', b'9', b'/', b'f', b'v', 0, 0x0b, 0xff] {
            let mut bytes = whole.clone().into_bytes();
            bytes[place] = byte;
            if let Ok(mesh) = parse_obj(&bytes) {
                assert_eq!(mesh.topology().check(), Ok(()));
            }
        }
    }
}
