//! Colours of vertices: in OBJ files, and through repairs.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use glam::{DVec3, Vec4};
use pelage_mesh::{MeshError, Note, ObjFault, RepairError, RepairSettings, Soup, parse_obj, plane, repair, srgb_to_linear};

fn opaque(red: f64, green: f64, blue: f64) -> Vec4 {
    let [red, green, blue] = [red, green, blue].map(|channel| srgb_to_linear(channel) as f32);
    Vec4::new(red, green, blue, 1.0)
}

#[test]
fn an_obj_files_colours_are_read_as_srgb() {
    let text = "v 0 0 0 1 0 0.5\nv 1 0 0 0 0.25 1\nv 0 1 0 0 0 0\nf 1 2 3\n";
    let import = parse_obj(text.as_bytes()).unwrap();
    assert_eq!(import.mesh.colours().unwrap(), [opaque(1.0, 0.0, 0.5), opaque(0.0, 0.25, 1.0), opaque(0.0, 0.0, 0.0)]);
    assert!(import.notes.is_empty());
    // 188 of 255 is half the light.
    assert!((srgb_to_linear(188.0 / 255.0) - 0.502_886).abs() < 1e-6 && (srgb_to_linear(0.04) - 0.04 / 12.92).abs() < 1e-12);
    // Four numbers are a place and a weight.
    assert_eq!(parse_obj(b"v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n").unwrap().mesh.colours(), None);
}

#[test]
fn odd_colours_are_said() {
    let some = parse_obj(b"v 0 0 0 1 0 0.5\nv 1 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n").unwrap();
    assert_eq!((some.mesh.colours(), some.notes.as_slice()), (None, [Note::VerticesWithoutColour { vertices: 1 }].as_slice()));
    let bytes = parse_obj(b"v 0 0 0 255 0 0.5\nv 1 0 0 0 -1 0\nv 0 1 0 0 0 0\nf 1 2 3\n").unwrap();
    assert_eq!(bytes.mesh.colours().unwrap()[..2], [opaque(1.0, 0.0, 0.5), opaque(0.0, 0.0, 0.0)]);
    assert_eq!(bytes.notes, [Note::ColoursOutOfRange { vertices: 2 }]);
    for number in ["nan", "inf", "1e300"] {
        let error = parse_obj(format!("v 0 0 0 0 0 0\nv 1 0 0 0 {number} 0\nv 0 1 0 0 0 0\nf 1 2 3\n").as_bytes()).unwrap_err();
        assert!(error.line == Some(2) && matches!(error.fault, ObjFault::ColourNotFinite { vertex: 2 }), "{number}: {error}");
    }
    // Words that are no numbers are none.
    assert_eq!(parse_obj(b"v 0 0 0 a b c\nv 1 0 0 a b c\nv 0 1 0 a b c\nf 1 2 3\n").unwrap().mesh.colours(), None);
}

/// Through welding, splitting, dropping and turning each vertex keeps the colour that was given at its place.
#[test]
fn repairs_keep_colours_with_their_places() {
    let colour_at = |p: &DVec3| Vec4::new(0.1 * p.x as f32, 0.1 * p.y as f32, 0.1 * p.z as f32, 0.5);
    // Two tetrahedra that touch in a vertex and have a stray one, corners doubled, one turned.
    let corners = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 3, 0]];
    let places = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let far = places.map(|p| p + DVec3::Z);
    let mut positions: Vec<DVec3> = places.into_iter().chain([DVec3::splat(7.0)]).chain(far).collect();
    let mut faces: Vec<[u32; 3]> = corners.into_iter().chain(corners.map(|c| c.map(|v| v + 5))).collect();
    positions.extend([places[0], places[1], places[2]]);
    faces[0] = [9, 11, 10];
    let mut soup = Soup::from_polygons(positions, faces);
    soup.colours = soup.positions.iter().map(colour_at).collect();
    let repaired = repair(soup.clone(), &RepairSettings::default()).unwrap();
    let report = repaired.report;
    assert!(
        report.vertices_welded > 0 && report.vertices_added > 0 && report.faces_turned > 0 && report.vertices_unreferenced > 0,
        "{report}"
    );
    let colours = repaired.mesh.colours().unwrap();
    assert!(repaired.mesh.positions().iter().zip(colours).all(|(p, colour)| *colour == colour_at(p)), "{colours:?}");
    soup.colours[3].y = f32::NAN;
    assert_eq!(repair(soup.clone(), &RepairSettings::default()), Err(RepairError::ColourNotFinite { vertex: 3 }));
    soup.colours.pop();
    assert!(matches!(repair(soup, &RepairSettings::default()), Err(RepairError::ColourCount { .. })));
}

#[test]
fn a_mesh_has_one_finite_colour_a_vertex_or_none() {
    let sheet = plane(1.0, 1.0, 1, 1).unwrap();
    assert_eq!(sheet.clone().with_colours(vec![Vec4::ONE; 3]), Err(MeshError::ColourCount { colours: 3, vertices: 4 }));
    let broken = vec![Vec4::ONE, Vec4::new(0.0, f32::NAN, 0.0, 1.0), Vec4::ONE, Vec4::ONE];
    assert_eq!(sheet.clone().with_colours(broken), Err(MeshError::ColourNotFinite { vertex: 1 }));
    let coloured = sheet.with_colours(vec![Vec4::X; 4]).unwrap();
    assert_eq!(coloured.with_positions(coloured.positions().to_vec()).unwrap(), coloured);
}
