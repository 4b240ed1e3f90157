//! The row "Scale" of the numbers at their extremes: a file of any scale and place is the same model, and what is lost is said.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use std::path::Path;

use glam::{DVec3, Vec3};
use pelage_mesh::{Import, Mesh, Note, ObjError, parse_obj, read_obj};

/// The bunny that is shipped.
fn bunny() -> Mesh {
    read_obj(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/models/bunny.obj")).unwrap().mesh
}

/// The text of a mesh whose positions are mapped, with as many digits as tell them from any other.
fn text(mesh: &Mesh, place: impl Fn(DVec3) -> DVec3) -> String {
    let positions = mesh.positions().iter().map(|&p| place(p)).map(|p| format!("v {:e} {:e} {:e}\n", p.x, p.y, p.z));
    let faces = mesh.topology().triangles().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    positions.chain(faces).collect()
}

/// Every position seen from the middle of the box, in diameters.
fn normalised(mesh: &Mesh) -> Vec<DVec3> {
    let (low, high) = mesh.bounds().unwrap();
    let (centre, diameter) = (0.5 * low + 0.5 * high, mesh.diameter());
    mesh.positions().iter().map(|&p| (p - centre) / diameter).collect()
}

fn worst(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// Somewhere so many diameters away.
fn far(mesh: &Mesh, diameters: f64) -> DVec3 {
    diameters * mesh.diameter() * DVec3::new(1.0, -0.7, 0.3)
}

const SCALES: [f64; 5] = [1e-30, 1e-15, 1.0, 1e15, 1e30];

#[test]
fn a_file_of_any_scale_and_place_is_the_same_model() {
    let bunny = bunny();
    let (here, normals) = (normalised(&bunny), bunny.vertex_normals());
    let (mut places, mut turned) = (0.0_f64, 0.0_f64);
    for scale in SCALES {
        for offset in [DVec3::ZERO, far(&bunny, 1e7)] {
            let import = parse_obj(text(&bunny, |p| scale * (p + offset)).as_bytes()).unwrap();
            assert!(import.mesh.topology() == bunny.topology() && import.repairs.is_none(), "× {scale} at {offset}");
            assert_eq!(import.notes, [], "nothing to speak of is lost");
            places = places.max(worst(&here, &normalised(&import.mesh)));
            turned = turned.max(worst(&normals, &import.mesh.vertex_normals()));
        }
    }
    println!("reached: places within {places:.1e} diameters, normals within {turned:.1e}");
    assert!(places < 1e-8 && turned < 1e-4, "{places} {turned}");
}

/// How many of a mesh's faces have no unit normal, worked out in `f32` from positions that were rounded to it.
fn faces_lost(mesh: &Mesh, scale: f64) -> usize {
    let at = |v: u32| (scale * mesh.positions()[v as usize]).as_vec3();
    let normal = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a) / (b - a).cross(c - a).length();
    // A square beyond the range makes it zero or no number.
    mesh.topology().triangles().filter(|face| !normal(face.map(at)).is_normalized()).count()
}

/// Why models are kept in `f64`: rounded first, every face of a model that is small or large enough loses its normal.
#[test]
fn rounded_to_f32_first_a_model_would_lose_its_faces() {
    let bunny = bunny();
    let faces = bunny.topology().face_count();
    for scale in [1e-30, 1e-15, 1e15, 1e30] {
        assert_eq!(faces_lost(&bunny, scale), faces, "× {scale}");
        let ours = bunny.with_positions(bunny.positions().iter().map(|&p| scale * p).collect()).unwrap();
        assert!(ours.faces().all(|face| (face.normal().length() - 1.0).abs() < 1e-12), "× {scale}");
    }
    let offset = far(&bunny, 1e7);
    let rounded: Vec<DVec3> = bunny.positions().iter().map(|&p| (p + offset).as_vec3().as_dvec3() - offset).collect();
    let off = worst(bunny.positions(), &rounded) / bunny.diameter();
    println!("reached: {faces} of {faces} faces lost in f32, 0 in f64");
    println!("reached: {off:.2} diameters off in f32");
    assert!(off > 0.1, "{off}");
}

/// What a file comes to that lies so many diameters away.
fn moved(bunny: &Mesh, diameters: f64) -> Result<Import, ObjError> {
    let offset = far(bunny, diameters);
    parse_obj(text(bunny, |p| p + offset).as_bytes())
}

#[test]
fn what_is_lost_far_away_is_said() {
    let bunny = bunny();
    let here = normalised(&bunny);
    let mut said = Vec::new();
    for exponent in 7..=20 {
        let import = match moved(&bunny, 10_f64.powi(exponent)) {
            Ok(import) => import,
            Err(error) => {
                assert!(error.to_string().contains("no usable surface"), "1e{exponent}: {error}");
                said.push(format!("1e{exponent}: refused"));
                continue;
            }
        };
        assert!(!said.iter().any(|said| said.ends_with("refused")), "nearer it was refused");
        let digits = import.notes.iter().find_map(|note| if let Note::CoarseCoordinates { digits } = note { Some(*digits) } else { None });
        // A vertex moves by a step in each coordinate at most; where some were welded they cannot be compared one by one.
        let kept = import.mesh.positions().len() == here.len();
        let off = if kept { worst(&here, &normalised(&import.mesh)) } else { 1.0 };
        assert_eq!(digits.is_some(), exponent >= 10, "1e{exponent}: {:?}", import.notes);
        assert!(digits.is_some() || off < 1e-6, "1e{exponent}: off by {off} and nothing said");
        if let Some(digits) = digits {
            assert!(
                !kept || off < 2.0 * 10_f64.powi(-(digits as i32)),
                "1e{exponent}: off by {off}, and {digits} digits are said to be left"
            );
            said.push(format!("1e{exponent}: {digits} digits"));
        }
    }
    let first_refused = said.iter().position(|said| said.ends_with("refused")).unwrap();
    println!("reached: {} and beyond", said[..=first_refused].join(", "));
    assert!(first_refused >= 3, "{said:?}");
}
