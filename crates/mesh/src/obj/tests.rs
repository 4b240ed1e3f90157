#![allow(clippy::print_stdout, reason = "a test says what it tried")]

use super::*;

fn import(text: &str) -> Import {
    parse_obj(text.as_bytes()).unwrap()
}

fn mesh(text: &str) -> Mesh {
    import(text).mesh
}

fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.topology().triangles().collect()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn vertices_keep_their_order_and_objects_share_them() {
    let text = "# two halves\nv 9 9 9\no first\nv 0 0 0\nv 1 0 0\nv 1 1 0\ng second\nusemtl fur\nv 0 1 0\nf 4 5 2\no third\nmtllib none.mtl\nf 2 3 4\n";
    let import = import(text);
    assert_eq!(import.mesh.positions(), [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y]);
    assert_eq!(triangles(&import.mesh), [[2, 3, 0], [0, 1, 2]]);
    assert_eq!(import.repairs, RepairReport { vertices_unreferenced: 1, ..RepairReport::default() });
    assert_eq!((import.face_line(FaceId(0)), import.face_line(FaceId(1))), (10, 13));
}

#[test]
fn a_quad_is_cut_from_its_first_corner() {
    let mesh = mesh(&format!("{SQUARE}f 1 2 3 4\n"));
    assert_eq!(triangles(&mesh), [[0, 1, 2], [0, 2, 3]]);
    assert!((mesh.area() - 1.0).abs() < 1e-15);
}

#[test]
fn relative_indices_count_back_from_the_line() {
    assert_eq!(triangles(&mesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4 -2 -1\n")), [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn a_texture_seam_does_not_tear_the_surface() {
    let coordinates = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0.25 0.25\nvt 0.75 0.75\nvt 0 1\n";
    let mesh = mesh(&format!("{SQUARE}{coordinates}f 1/1 2/2 3/3\nf 1/4 3/5 4/6\n"));
    assert_eq!((mesh.topology().edge_count(), mesh.topology().vertex_count()), (5, 4));
    let expected = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.25, 0.25), (0.75, 0.75), (0.0, 1.0)].map(DVec2::from);
    assert_eq!(mesh.texture_coordinates().unwrap(), expected);
}

#[test]
fn coordinates_are_kept_only_if_every_corner_has_them() {
    let coordinates = "vt 0 0\nvt 1 0\nvt 1 1\n";
    let some = import(&format!("{SQUARE}{coordinates}f 1/1 2/2 3/3\nf 1 3 4\n"));
    assert_eq!(some.mesh.texture_coordinates(), None);
    assert_eq!(some.notes, [Note::CornersWithoutTextureCoordinates { corners: 3 }]);
    let none_there = import(&format!("{SQUARE}f 1/1 2/2 3/3\n"));
    assert_eq!(none_there.mesh.texture_coordinates(), None);
    assert_eq!(none_there.notes, [Note::NoTextureCoordinates]);
}

#[test]
fn what_is_no_surface_is_passed_over() {
    let text =
        "\u{feff}v 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\nv\t0 1 0 1 2 3 4 # café\r\nvn 0 0 1\r\nl 1 2\r\np 3\r\ns off\r\nf 1//1 2//1 3//1\r\n";
    let import = import(text);
    assert_eq!(import.mesh.positions(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!((import.repairs.is_none(), import.face_line(FaceId(0))), (true, 8));
    // Two of three vertices have a colour.
    assert_eq!(import.notes, [Note::VerticesWithoutColour { vertices: 1 }]);
    let mut latin = b"# caf\xe9\no caf\xe9\n".to_vec();
    latin.extend_from_slice(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    assert!(parse_obj(&latin).is_ok());
}

#[test]
fn unknown_statements_are_noted_without_their_bytes() {
    let import = import(&format!("{SQUARE}curv 0 1\n\x1b[2Jboo\nf 1 2 3 4\n"));
    assert_eq!(import.notes, [Note::UnknownStatements { count: 2, line: 5, first: "curv".into() }]);
    let escape = parse_obj(format!("{SQUARE}\x1b[2Jbooooooooooooooooooooo\nf 1 2 3\n").as_bytes()).unwrap();
    assert_eq!(escape.notes[0].to_string(), "statements of unknown kinds passed over: 1, the first in line 5: `?[2Jbooooooooooo`");
}

#[test]
fn statements_go_on_after_a_backslash() {
    let text = "# a path C:\\\nv 0 0 0\nv 1 \\\n 0 \\\r\n0\nv 0 1 0\nf 1 \\\n2 3\nf 1 2 9\n";
    let error = parse_obj(text.as_bytes()).unwrap_err();
    assert_eq!(error.line, Some(9), "{error}");
    let mesh = mesh(text.strip_suffix("f 1 2 9\n").unwrap());
    assert_eq!(mesh.positions(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
}

#[test]
fn carriage_returns_alone_end_lines() {
    let error = parse_obj(b"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\rf 1 2 7\r").unwrap_err();
    assert_eq!(error.line, Some(5), "{error}");
}

#[test]
fn slashes_too_many_do_no_harm() {
    for corner in ["/", "//", "/1", "/1/", "/1/1", "//1", "/1/1/"] {
        let text = format!("{SQUARE}vt 0 0\nvn 0 0 1\nf 1{corner} 2{corner} 3{corner}\n");
        assert_eq!(triangles(&mesh(&text)), [[0, 1, 2]], "{corner}");
    }
}

#[test]
fn numbers_keep_all_their_digits() {
    let mesh = mesh("v 1e-5 0.1234567890123456 1e0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_eq!(mesh.positions()[0], DVec3::new(1e-5, 0.1234567890123456, 1.0));
}

#[test]
fn what_f32_cannot_hold_is_read_and_what_f64_cannot_is_refused_with_its_line() {
    for large in ["1e39", "-3.5e38", "1e-46", "1e300"] {
        let mesh = mesh(&format!("v 0 0 0\nv {large} 0 0\nv 0 {large} 0\nf 1 2 3\n"));
        assert_eq!(mesh.positions()[1].x, large.parse::<f64>().unwrap());
    }
    for none in ["1e400", "-1e309", "inf", "-inf", "+Infinity", "nan", "NaN", "-nan"] {
        let error = parse_obj(format!("v 0 0 0\nv 1 0 0\n\nv 0 {none} 0\nf 1 2 3\n").as_bytes()).unwrap_err();
        assert!(error.line == Some(4) && matches!(error.fault, ObjFault::NotFinite { vertex: 3 } | ObjFault::BadVertex), "{none}: {error}");
    }
}

#[test]
fn faults_are_found_in_their_lines() {
    let check = |text: &str, line: Option<usize>, part: &str| {
        let error = parse_obj(text.as_bytes()).unwrap_err();
        assert_eq!(error.line, line, "{error}");
        assert!(error.to_string().contains(part), "{error}");
    };
    check("", None, "no face");
    check("v 0 0 0\nl 1 1\n", None, "no face");
    check("glTF\x02\0\0\0", None, "binary");
    check("v 0 0 0\nv 1 x 0\nf 1 1 1\n", Some(2), "three numbers");
    check("\n\nv 0 0\nf 1 1 1\n", Some(3), "three numbers");
    check("v 0 0 0\nv 1 0\u{a0}0\nf 1 1 1\n", Some(2), "three numbers");
    check(&format!("{SQUARE}vt 0\nf 1 2 3\n"), Some(5), "two numbers");
    check(&format!("{SQUARE}vt 0 y\nf 1/1 2/1 3/1\n"), Some(5), "two numbers");
    check(&format!("{SQUARE}f 1 2 3\nf 1 b 3\n"), Some(6), "corners like");
    check(&format!("{SQUARE}f 1 2 /3\n"), Some(5), "corners like");
    check(&format!("{SQUARE}f 1 2 3//x\n"), Some(5), "corners like");
    check(&format!("{SQUARE}f 1 2 3\n\nf 1 3 9\n"), Some(7), "names vertex 9, but the file has 4");
    check(&format!("{SQUARE}f 1 2 0\n"), Some(5), "names vertex 0");
    check(&format!("f -1 -2 -3\n{SQUARE}"), Some(1), "names vertex -1");
    check(&format!("{SQUARE}f 1 2 99999999999999999999999\n"), Some(5), "23 digits");
    check(&format!("{SQUARE}vt 0 0\nf 1/1 2/1 3/-2\n"), Some(6), "coordinates -2, but the file has 1");
    check(&format!("{SQUARE}vt 0 0\nf 1/1 2/1 3/2\n"), Some(6), "coordinates 2, but the file has 1");
    check(&format!("{SQUARE}vt 0 0\nf 1/1 2/1 3/0\n"), Some(6), "coordinates 0");
    check(&format!("{SQUARE}vt 0 nan\nf 1/1 2/1 3/1\n"), Some(6), "texture coordinates that are NaN");
    check("v 0 0 0\n\nv nan 0 0\nv 1 0 0\nf 1 2 3\n", Some(3), "vertex 2 has a coordinate");
    check("v 0 0 0\nv 1e400 0 0\nv 1 0 0\nf 1 2 3\n", Some(2), "vertex 2 has a coordinate");
    check("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", None, "no usable surface");
    check("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", None, "no usable surface");
    check(&format!("{SQUARE}f 1 2\nf 3\nf\n"), None, "no usable surface");
}

#[test]
fn two_bytes_a_letter_are_named() {
    for text in ["\u{feff}v 0 0 0\n", "v 0 0 0\nf 1 1 1\n"] {
        for to_bytes in [u16::to_le_bytes, u16::to_be_bytes] {
            let bytes: Vec<u8> = text.encode_utf16().flat_map(to_bytes).collect();
            assert!(matches!(parse_obj(&bytes).unwrap_err().fault, ObjFault::Utf16));
        }
    }
}

#[test]
fn a_missing_file_is_named() {
    let error = read_obj(Path::new("no/such/model.obj")).unwrap_err();
    assert!(error.to_string().starts_with("no/such/model.obj: the file cannot be read"), "{error}");
}

/// A file that uses every statement and every way of writing a face.
fn every_statement() -> String {
    format!(
        "\u{feff}# x\nmtllib a.mtl\no a\ng b\ns 1\nusemtl c\n{SQUARE}v 0.5 0.5 1 1\nv 0.5 0.5 -1 0.1 0.2 0.3\nvt 0 0\nvt 1 0 0\nvt 0 1\nvn 0 0 1\n\
         f 1/1/1 2/2/1 3/3/1 4/1/1\nf -6/-3 -5/-2 \\\n-2/-1\r\nf 2/1/ 3/2 5/3//\nf 3/1 4/2 5/3\nf 4/1 1/2 5/3\nl 1 2\np 1\ncurv 0 1 1\n\
         f 1/1 2/1 2/1\nf 1/1\nf 2/1 1/1 6/1\nf 1/1 2/1 6/1\n"
    )
}

#[test]
fn every_prefix_gives_a_mesh_or_an_error() {
    let whole = every_statement();
    assert_eq!(import(&whole).mesh.topology().check(), Ok(()));
    for end in 0..whole.len() {
        if let Ok(import) = parse_obj(&whole.as_bytes()[..end]) {
            assert_eq!(import.mesh.topology().check(), Ok(()));
        }
    }
    println!("reached: {} prefixes", whole.len());
}

#[test]
fn every_changed_byte_gives_a_mesh_or_an_error() {
    let whole = every_statement().into_bytes();
    for place in 0..whole.len() {
        for byte in 0..=u8::MAX {
            let mut bytes = whole.clone();
            bytes[place] = byte;
            if let Ok(import) = parse_obj(&bytes) {
                assert_eq!(import.mesh.topology().check(), Ok(()));
                assert!(import.mesh.positions().iter().all(|p| p.is_finite()));
            }
        }
    }
    println!("reached: {} files", 256 * whole.len());
}
