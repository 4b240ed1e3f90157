//! What each file of `nasty` in the folder `PELAGE_MODELS` comes to; `manifest.json` says what is wrong with it.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

use std::collections::BTreeSet;
use std::path::PathBuf;

use pelage_mesh::{Import, Note, ObjError, ObjFault, RepairReport, Summary, read_obj};
use serde_json::Value;

/// What a file is expected to come to.
enum Expected {
    /// A surface.
    Surface(Counts),
    /// An error in this line, or of the whole file, that says this.
    Error(Option<usize>, &'static str),
}

/// The surface and what it took.
struct Counts {
    vertices: usize,
    edges: usize,
    faces: usize,
    loops: usize,
    components: usize,
    genus: usize,
    repairs: RepairReport,
    notes: usize,
}

use Expected::{Error, Surface};

const NONE: RepairReport = RepairReport::NONE;

/// The closed control of most files.
const SPHERE: Counts = Counts { vertices: 258, edges: 768, faces: 512, loops: 0, components: 1, genus: 0, repairs: NONE, notes: 0 };

const fn sphere(repairs: RepairReport) -> Expected {
    Surface(Counts { repairs, ..SPHERE })
}

const fn open(vertices: usize, edges: usize, faces: usize, loops: usize, components: usize, repairs: RepairReport) -> Expected {
    Surface(Counts { vertices, edges, faces, loops, components, genus: 0, repairs, notes: 0 })
}

const NOT_FINITE: &str = "vertex 11 has a coordinate that is NaN, infinite or too large";

/// By file, as the manifest lists them.
const TABLE: [(&str, &str, Expected); 43] = [
    ("ok_tetra", "accept", open(4, 6, 4, 0, 1, NONE)),
    ("ok_sphere512", "accept", Surface(SPHERE)),
    ("ok_annulus_unref", "repair", open(96, 240, 144, 2, 1, RepairReport { vertices_unreferenced: 4, ..NONE })),
    ("ok_quads_cube", "accept", open(8, 18, 12, 0, 1, NONE)),
    // Opposite pages go together: three sheets through one line.
    ("nm_edge_book6", "repair", open(12, 15, 6, 3, 3, RepairReport { edges_split: 1, faces_turned: 3, vertices_added: 4, ..NONE })),
    ("nm_bowtie_open", "repair", open(6, 6, 2, 2, 2, RepairReport { vertices_split: 1, vertices_added: 1, ..NONE })),
    ("dup_faces", "repair", sphere(RepairReport { faces_duplicated: 20, ..NONE })),
    ("winding_10pct_flipped", "repair", sphere(RepairReport { faces_turned: 51, ..NONE })),
    ("winding_all_inverted", "accept", sphere(RepairReport { pieces_turned: 1, ..NONE })),
    // A figure-eight bottle: it passes through itself along 32 edges, and is cut along 16 others, into a ring.
    ("klein_closed", "repair", open(528, 1552, 1024, 2, 1, KLEIN)),
    ("high_valence_5000", "accept", open(5001, 10000, 5000, 1, 1, NONE)),
    ("coincident_shells", "accept", sphere(RepairReport { vertices_welded: 258, faces_duplicated: 512, ..NONE })),
    ("zero_area_repeat_index", "repair", sphere(RepairReport { faces_collapsed: 3, ..NONE })),
    // The face across its long side is split, and no slit is left.
    ("zero_area_collinear", "repair", open(5, 8, 4, 1, 1, RepairReport { junctions_split: 1, ..NONE })),
    // The dragged vertex lies on another one now, but none of their faces do.
    ("sliver_in_sphere", "accept", sphere(RepairReport { vertices_welded: 1, vertices_split: 1, vertices_added: 1, ..NONE })),
    ("all_same_point", "error", Error(None, "no usable surface")),
    ("nan_coord", "error", Error(Some(11), NOT_FINITE)),
    ("overflow_1e400", "error", Error(Some(11), NOT_FINITE)),
    ("tiny_1e-15", "accept", Surface(SPHERE)),
    // Nothing to repair for a reader that keeps `f64`.
    ("tiny_1e-30", "repair", Surface(SPHERE)),
    // The manifest lets a reader that normalises in `f64` accept it; one of `f32` cannot.
    ("denormal_1e-42", "error", Surface(SPHERE)),
    ("comments_only", "error", Error(None, "no face")),
    ("lines_only", "error", Error(None, "no face")),
    ("index_zero", "error", Error(Some(771), "names vertex 0, but the file has 258; indices start at 1")),
    ("index_negative_ok", "accept", sphere(RepairReport { vertices_welded: 1278, ..NONE })),
    ("index_overflow", "error", Error(Some(771), "an index of 23 digits")),
    ("face_two_vertices", "repair", sphere(RepairReport { faces_with_few_corners: 3, ..NONE })),
    ("ngons_mixed", "accept", open(8, 18, 12, 0, 1, NONE)),
    ("ngon_nonplanar", "accept", open(4, 5, 2, 1, 1, NONE)),
    ("vt_missing", "repair", Surface(Counts { notes: 1, ..SPHERE })),
    ("attr_extra_slashes", "repair", Surface(SPHERE)),
    ("vertex_colours_w", "accept", Surface(Counts { notes: 1, ..SPHERE })),
    ("vertex_two_coords", "error", Error(Some(11), "a vertex needs three numbers")),
    ("crlf", "accept", Surface(SPHERE)),
    ("tabs_spaces", "accept", Surface(SPHERE)),
    ("backslash_continuation", "accept", Surface(SPHERE)),
    ("utf16le", "error", Error(None, "UTF-16")),
    ("latin1_comment", "accept", Surface(SPHERE)),
    ("binary_junk", "error", Error(None, "the file is binary")),
    ("stl_named_obj", "error", Error(None, "no face")),
    ("long_comment_1MB", "accept", Surface(SPHERE)),
    ("unknown_statements", "accept", Surface(Counts { notes: 1, ..SPHERE })),
    // Once it is closed, one sees that it is wound inwards.
    (
        "seam_uv_sphere",
        "repair",
        open(482, 1440, 960, 0, 1, RepairReport { vertices_welded: 79, faces_collapsed: 64, pieces_turned: 1, ..NONE }),
    ),
];

const KLEIN: RepairReport =
    RepairReport { vertices_welded: 32, edges_split: 32, edges_cut: 16, vertices_added: 48, vertices_unreferenced: 49, ..NONE };

/// The files of the folder, by name, with their class; nothing where no folder is given.
fn manifest() -> Option<(PathBuf, Vec<(String, String)>)> {
    let Some(folder) = std::env::var_os("PELAGE_MODELS") else {
        println!("PELAGE_MODELS is not set: the nasty models are not looked at");
        return None;
    };
    let nasty = PathBuf::from(folder).join("nasty");
    let entries: Vec<Value> = serde_json::from_str(&std::fs::read_to_string(nasty.join("manifest.json")).unwrap()).unwrap();
    let name = |entry: &Value| entry["file"].as_str().unwrap().trim_end_matches(".obj").to_owned();
    let entries = entries.iter().map(|entry| (name(entry), entry["cls"].as_str().unwrap().to_owned())).collect();
    Some((nasty, entries))
}

fn read(name: &str) -> Option<Result<Import, ObjError>> {
    let (nasty, _) = manifest()?;
    Some(read_obj(&nasty.join(format!("{name}.obj"))))
}

#[test]
fn the_table_names_every_file_and_no_other() {
    let Some((nasty, entries)) = manifest() else { return };
    let in_folder: BTreeSet<String> = std::fs::read_dir(&nasty)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "obj"))
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    let in_table: BTreeSet<String> = TABLE.iter().map(|(name, ..)| (*name).to_owned()).collect();
    assert_eq!(in_folder, in_table);
    let classes: Vec<(String, String)> = TABLE.iter().map(|(name, class, _)| ((*name).to_owned(), (*class).to_owned())).collect();
    assert_eq!(entries, classes);
}

#[test]
fn every_file_does_what_is_expected() {
    let Some((nasty, _)) = manifest() else { return };
    for (name, class, expected) in &TABLE {
        match (read_obj(&nasty.join(format!("{name}.obj"))), expected) {
            (Ok(import), Surface(counts)) => check(name, class, &import, counts),
            (Err(error), Error(line, part)) => {
                assert_eq!(*class, "error", "{name}");
                let text = error.to_string();
                assert!(error.line == *line && text.contains(part), "{name}: {text}");
                assert!(text.len() < 400 && text.chars().all(|c| !c.is_control()), "{name} shows what is in the file");
            }
            (Ok(import), Error(..)) => panic!("{name} gives a surface: {:?}", Summary::of(&import.mesh)),
            (Err(error), Surface(_)) => panic!("{name}: {error}"),
        }
    }
    let refused = TABLE.iter().filter(|(.., expected)| matches!(expected, Error(..))).count();
    println!("reached: {} surfaces, {refused} errors, as expected", TABLE.len() - refused);
}

fn check(name: &str, class: &str, import: &Import, counts: &Counts) {
    let mesh = &import.mesh;
    assert_eq!(mesh.topology().check(), Ok(()), "{name}");
    let summary = Summary::of(mesh);
    let found = [summary.vertices, summary.edges, summary.faces, summary.boundary_loops, summary.components, summary.genus];
    let expected = [counts.vertices, counts.edges, counts.faces, counts.loops, counts.components, counts.genus];
    assert_eq!(found, expected, "{name}");
    assert_eq!(summary.unreferenced_vertices, 0, "{name}");
    assert_eq!(summary.faces_without_area, 0, "{name}");
    assert_eq!(import.repairs, counts.repairs, "{name}");
    assert_eq!(import.notes.len(), counts.notes, "{name}: {:?}", import.notes);
    assert_eq!(import.face_lines.len(), summary.faces, "{name}");
    assert!(mesh.positions().iter().all(|p| p.is_finite()) && mesh.vertex_normals().iter().all(|n| n.is_finite()), "{name}");
    let mended = !import.repairs.is_none() || !import.notes.is_empty();
    // What the manifest calls a repair is said, but for two files that this reader takes as they are: slashes, and what is tiny only for `f32`.
    assert!(class != "repair" || mended || ["attr_extra_slashes", "tiny_1e-30"].contains(&name), "{name}");
    // What is closed faces outwards.
    assert!(summary.boundary_loops > 0 || summary.signed_volume > 0.0, "{name}: {}", summary.signed_volume);
}

/// Positions and triangles, each from its lowest corner on.
fn content(import: &Import) -> (Vec<[u64; 3]>, Vec<[u32; 3]>) {
    let from_lowest = |mut corners: [u32; 3]| {
        let lowest = (0..3).min_by_key(|&k| corners[k]).unwrap();
        corners.rotate_left(lowest);
        corners
    };
    let places = import.mesh.positions().iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    (places, import.mesh.topology().triangles().map(from_lowest).collect())
}

#[test]
fn what_says_the_same_as_the_control_is_the_same() {
    let Some(Ok(control)) = read("ok_sphere512") else { return };
    let same = [
        "winding_10pct_flipped",
        "winding_all_inverted",
        "dup_faces",
        "coincident_shells",
        "zero_area_repeat_index",
        "face_two_vertices",
        "vt_missing",
        "attr_extra_slashes",
        "crlf",
        "tabs_spaces",
        "backslash_continuation",
        "latin1_comment",
        "long_comment_1MB",
        "unknown_statements",
    ];
    for name in same {
        let import = read(name).unwrap().unwrap();
        let ((places, mut faces), (control_places, mut control_faces)) = (content(&import), content(&control));
        faces.sort_unstable();
        control_faces.sort_unstable();
        assert!(places == control_places && faces == control_faces, "{name} is not the control");
    }
}

#[test]
fn a_tiny_sphere_is_the_sphere_made_tiny() {
    let Some(Ok(control)) = read("ok_sphere512") else { return };
    for (name, scale) in [("tiny_1e-15", 1e-15), ("tiny_1e-30", 1e-30), ("denormal_1e-42", 1e-42)] {
        let import = read(name).unwrap().unwrap();
        assert!(import.mesh.topology() == control.mesh.topology(), "{name}");
        let normals = import.mesh.vertex_normals();
        for (a, b) in control.mesh.vertex_normals().iter().zip(&normals) {
            assert!(a.distance(*b) < 1e-8, "{name}: {a} became {b}");
        }
        for (a, b) in control.mesh.positions().iter().zip(import.mesh.positions()) {
            assert!((*a * scale).distance(*b) < 1e-8 * scale, "{name}");
        }
    }
}

#[test]
fn what_is_left_out_is_said() {
    let Some(Ok(import)) = read("unknown_statements") else { return };
    assert_eq!(import.notes, [Note::UnknownStatements { count: 4, line: 7, first: "cstype".into() }]);
    assert_eq!(read("vt_missing").unwrap().unwrap().notes, [Note::NoTextureCoordinates]);
    assert!(matches!(read("utf16le").unwrap().unwrap_err().fault, ObjFault::Utf16));
}
