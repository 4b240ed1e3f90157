//! The promises of the command line: exit codes, messages, figures, and nothing half-written.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn pelage(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pelage"));
    command.args(arguments).current_dir(root());
    command
}

/// Runs, and gives exit code, standard output and standard error.
fn run(arguments: &[&str]) -> (i32, String, String) {
    said(&pelage(arguments).output().unwrap())
}

fn said(output: &Output) -> (i32, String, String) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

/// A ball with little hair, drawn small: quick.
const BALL: &str = r#"Graph(version: 1, output: "picture.image", nodes: {
    "ball": Sphere(subdivisions: 4),
    "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3),
    "hair": GrowStrands(count: 60, undercoat: (count: 60), steps: 8),
    "shells": SampleShells(strands: "hair.strands", layers: 6, resolution: 32),
    "fin": SampleFin(strands: "hair.strands", size: (64, 16)),
    "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells", fin: "fin.fin", length: 0.06),
    "unasked": Torus(),
    "camera": Camera(), "light": Light(), "shading": HairLighting(),
    "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (48, 40)),
})"#;

/// A folder with `ball.ron`.
fn folder() -> (tempfile::TempDir, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let graph = folder.path().join("ball.ron");
    std::fs::write(&graph, BALL).unwrap();
    let out = folder.path().join("out.png");
    let text = |path: PathBuf| path.to_str().unwrap().to_owned();
    (folder, text(graph), text(out))
}

#[test]
fn render_writes_the_picture_and_the_figures_that_were_promised() {
    let (folder, graph, out) = folder();
    let stats = folder.path().join("stats.json");
    let (code, _, error) = run(&["render", &graph, "-o", &out, "--size", "64x48", "--repeat", "2", "--stats", stats.to_str().unwrap()]);
    assert_eq!(code, 0, "{error}");
    let picture = image::open(&out).unwrap();
    assert_eq!((picture.width(), picture.height()), (64, 48));
    let stats: Value = serde_json::from_slice(&std::fs::read(stats).unwrap()).unwrap();
    for key in [
        "/pelage",
        "/graph",
        "/adapter/name",
        "/adapter/backend",
        "/adapter/software",
        "/nodes/hair/kind",
        "/nodes/hair/ms",
        "/model/vertices",
        "/model/genus",
        "/patches/count",
        "/patches/faces_per_patch_p50",
        "/patches/stretch_p50",
        "/patches/stretch_p99",
        "/patches/seam_length",
        "/patches/discs",
        "/patches/tile_repeats_p50",
        "/textures/shell_bytes",
        "/textures/fin_bytes",
        "/textures/total_bytes",
        "/textures/layers",
        "/frame/shells_drawn",
        "/frame/fins_drawn",
        "/frame/triangles",
        "/frame/ms_median",
        "/frame/frames",
        "/image_hash",
    ] {
        assert!(stats.pointer(key).is_some_and(|value| !value.is_null()), "{key} is missing in {stats:#}");
    }
    assert_eq!(stats.pointer("/model/repairs"), None, "no file was read");
    assert_eq!(stats.pointer("/patches/misalignment_deg_mean"), None, "a key that does not apply is absent");
    assert_eq!(stats.pointer("/model/faces"), Some(&Value::from(320)));
    assert_eq!(stats.pointer("/patches/faces_covered"), Some(&Value::from(320)));
    assert_eq!(stats.pointer("/patches/faces_flipped"), Some(&Value::from(0)));
    assert_eq!(stats.pointer("/nodes/unasked/state"), Some(&Value::from("not needed")));
    assert_eq!(stats.pointer("/nodes/hair/state"), Some(&Value::from("computed")));
}

#[test]
fn curves_are_written_a_blank_line_between_strands() {
    let (folder, graph, _) = folder();
    let out = folder.path().join("hair.txt").to_str().unwrap().to_owned();
    let (code, _, error) = run(&["curves", &graph, "-o", &out]);
    assert!(code == 1 && error.contains("add a StrandCurves node"), "{code}: {error}");
    let with_curves = BALL.replace(r#""camera""#, r#""curves": StrandCurves(fur: "coat.fur", strands: "hair.strands"), "camera""#);
    std::fs::write(&graph, with_curves).unwrap();
    assert_eq!(run(&["curves", &graph, "-o", &out]).0, 0);
    let text = std::fs::read_to_string(&out).unwrap();
    let strands: Vec<&str> = text.split("\n\n").collect();
    assert!(strands.len() > 500, "{} strands", strands.len());
    for strand in strands {
        let points: Vec<Vec<f64>> = strand.lines().map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect()).collect();
        assert!(points.len() >= 2 && points.iter().all(|point| point.len() == 4 && point[3] > 0.0), "{strand}");
        // From the skin of the ball: the diagonal of its box is 1.
        let off_centre = points[0][..3].iter().map(|c| c * c).sum::<f64>().sqrt();
        assert!((off_centre - 0.2887).abs() < 0.02, "{off_centre}");
    }
}

#[test]
fn any_number_of_threads_makes_the_same_picture() {
    let (_folder, graph, out) = folder();
    let picture = |threads: &str| {
        assert_eq!(run(&["render", &graph, "-o", &out, "--threads", threads]).0, 0);
        std::fs::read(&out).unwrap()
    };
    let one = picture("1");
    assert!(one == picture("2") && one == picture("8"));
}

#[test]
fn a_failure_leaves_what_was_there() {
    let (folder, graph, out) = folder();
    std::fs::write(&out, "as before").unwrap();
    let (code, _, error) = run(&["render", &graph, "-o", &out, "--set", "shells.resolution=100"]);
    assert_eq!(code, 1);
    assert!(error.contains("shells") && error.contains("power of two"), "{error}");
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "as before");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "something was left behind");
}

#[test]
fn check_answers_with_every_fault_and_where() {
    let folder = tempfile::tempdir().unwrap();
    let graph = folder.path().join("wrong.ron");
    std::fs::write(&graph, "Graph(version: 1, nodes: {\n  \"ball\": Sphere(subdivision: 2),\n  \"tiles\": GrowPatches(mesh: \"bal.mesh\", tile_size: 99.0),\n})").unwrap();
    let (code, _, error) = run(&["check", graph.to_str().unwrap()]);
    assert_eq!(code, 1);
    for expected in ["wrong.ron:2:", "subdivision", "wrong.ron:3:", "bal", "tile_size", "99"] {
        assert!(error.contains(expected), "no {expected:?} in: {error}");
    }
}

#[test]
fn every_saved_graph_is_valid() {
    let graphs: Vec<PathBuf> = std::fs::read_dir(root().join("graphs")).unwrap().map(|entry| entry.unwrap().path()).collect();
    let graphs: Vec<&str> = graphs.iter().filter_map(|path| path.to_str()).filter(|path| path.ends_with(".ron")).collect();
    assert!(graphs.len() >= 5);
    let (code, _, error) = run(&[&["check"], &graphs[..]].concat());
    assert_eq!(code, 0, "{error}");
}

#[test]
fn overrides_say_what_is_wrong_with_them() {
    let (_folder, graph, out) = folder();
    for (set, code, expected) in [
        ("nonsense", 2, "NODE.INPUT=VALUE"),
        ("ball.subdivisions=0", 1, "600"),
        ("bal.subdivisions=2", 1, "ball"),
        ("ball.subdivision=2", 1, "subdivisions"),
        ("ball.subdivisions=999", 1, "600"),
        ("hair.style=Curlly(radius: 0.1)", 1, "Curly"),
    ] {
        let (actual, _, error) = run(&["render", &graph, "-o", &out, "--set", set]);
        assert_eq!(actual, code, "{set}: {error}");
        assert!(error.contains(expected), "{set}: no {expected:?} in: {error}");
        assert!(!Path::new(&out).exists());
    }
}

#[test]
fn curls_too_fine_for_the_shells_are_warned_of_where_one_asks() {
    let (folder, graph, out) = folder();
    let fine = ["hair.style=Curly(radius: 0.02, turns: 4)", "hair.thickness=0.0005", "hair.lean=0", "hair.steps=40", "hair.clump=0"];
    let set: Vec<&str> = fine.iter().flat_map(|value| ["--set", value]).collect();
    let stats = folder.path().join("stats.json");
    let (code, _, error) = run(&[&["render", &graph, "-o", &out, "-v"], &set[..]].concat());
    assert!(code == 0 && error.contains("warning: shells: curls are"), "{error}");
    let (code, _, error) = run(&[&["render", &graph, "-o", &out, "--stats", stats.to_str().unwrap()], &set[..]].concat());
    assert!(code == 0 && !error.contains("warning"), "{error}");
    let stats: Value = serde_json::from_slice(&std::fs::read(stats).unwrap()).unwrap();
    assert!(stats.pointer("/curls/warning").and_then(Value::as_str).is_some_and(|warning| warning.contains("texels wide")));
    let (code, _, error) = run(&["render", &graph, "-o", &out, "-v"]);
    assert!(code == 0 && !error.contains("warning"), "{error}");
}

#[test]
fn a_path_given_here_is_relative_to_here() {
    let (_folder, _, out) = folder();
    let small = ["--set", "picture.size=(32, 24)", "--set", "shells.layers=2", "--set", "shells.resolution=16"];
    let mut command = pelage(&[&["render", "../bunny.ron", "-o", &out, "--set", "bunny.path=bunny.obj"], &small[..]].concat());
    let (code, _, error) = said(&command.current_dir(root().join("graphs/models")).output().unwrap());
    assert_eq!(code, 0, "{error}");
    let (code, _, error) = run(&["render", "graphs/bunny.ron", "-o", &out, "--set", "bunny.path=no-such.obj"]);
    assert_eq!(code, 1);
    assert!(error.contains("no-such.obj") && error.contains("bunny"), "{error}");
}

#[cfg(unix)]
#[test]
fn a_link_is_followed_and_not_replaced() {
    let (folder, graph, out) = folder();
    let link = folder.path().join("link.png");
    std::os::unix::fs::symlink(&out, &link).unwrap();
    std::fs::write(&out, "before").unwrap();
    assert_eq!(run(&["render", &graph, "-o", link.to_str().unwrap()]).0, 0);
    assert!(link.symlink_metadata().unwrap().is_symlink());
    assert!(image::open(&out).is_ok());
}

#[test]
fn files_that_cannot_be_what_they_are_asked_to_be_are_refused() {
    let (_folder, graph, out) = folder();
    assert_eq!(run(&["render", &graph, "-o", "x.jpg"]).0, 2);
    assert_eq!(run(&["render", &graph, "-o", &out, "--stats", &out]).0, 2);
    let (code, _, error) = run(&["render", &graph, "-o", &out, "--output", "coat.fur", "--stats", "x.json"]);
    assert_eq!(code, 1);
    assert!(error.contains("Coat, not Picture"), "{error}");
    let (code, _, error) = run(&["render", &graph, "-o", &out, "--output", "coat.fur"]);
    assert_eq!(code, 1);
    assert!(error.contains("Coat, not Picture"), "{error}");
}

#[test]
fn wrong_usage_is_2() {
    for arguments in [&["render"][..], &["paint"], &["render", "x.ron", "-o", "y.png", "--size", "big"], &[]] {
        assert_eq!(run(arguments).0, 2, "{arguments:?}");
    }
}

#[test]
fn no_adapter_is_3_and_says_what_to_install() {
    let (_folder, graph, out) = folder();
    let mut command = pelage(&["render", &graph, "-o", &out]);
    command.env("VK_DRIVER_FILES", "none").env("VK_ICD_FILENAMES", "none").env("WGPU_BACKEND", "vulkan");
    let (code, _, error) = said(&command.output().unwrap());
    assert_eq!(code, 3, "{error}");
    assert!(error.contains("mesa-vulkan-drivers"), "{error}");
}

#[test]
fn inspect_counts() {
    let (code, out, error) = run(&["inspect", "graphs/models/bunny.obj", "--json"]);
    assert_eq!(code, 0, "{error}");
    let counts: Value = serde_json::from_str(&out).unwrap();
    for (key, count) in [("vertices", 1839), ("faces", 3674), ("edges", 5511), ("boundary_loops", 0), ("components", 1), ("genus", 0)] {
        assert_eq!(counts[key], Value::from(count), "{key}");
    }
    assert!(run(&["inspect", "graphs/models/bunny.obj"]).1.contains("3674"));
    let (code, out, error) = run(&["inspect", "graphs/models/caterpillar.glb", "--json"]);
    assert_eq!(code, 0, "{error}");
    let balls: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&balls["components"], &balls["boundary_loops"]), (&Value::from(11), &Value::from(0)));
    let (code, _, error) = run(&["inspect", "Cargo.toml"]);
    assert_eq!(code, 1);
    assert!(error.contains("Cargo.toml"), "{error}");
}

/// A ball with a face given twice, one turned, and its first vertex given twice.
fn broken_ball() -> String {
    let ball = pelage_mesh::sphere(1.0, 4).unwrap();
    let mut vertices: Vec<String> = ball.positions().iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z)).collect();
    vertices.push(vertices[0].clone());
    let copy = vertices.len();
    let name = |v: u32| if v == 0 { copy } else { v as usize + 1 };
    let mut faces: Vec<[usize; 3]> = ball.topology().triangles().map(|corners| corners.map(|v| v as usize + 1)).collect();
    faces[0] = ball.topology().triangles().next().unwrap().map(name);
    faces.push(faces[7]);
    faces[9].swap(0, 1);
    let faces = faces.iter().map(|[a, b, c]| format!("f {a} {b} {c}\n"));
    vertices.into_iter().chain(faces).chain(["bevel off please\n".to_owned()]).collect()
}

#[test]
fn inspect_says_what_was_mended_and_what_it_is_worth() {
    let (folder, ..) = folder();
    let model = folder.path().join("ball.obj");
    std::fs::write(&model, broken_ball()).unwrap();
    let model = model.to_str().unwrap();
    let (code, out, error) = run(&["inspect", model, "--json"]);
    assert_eq!(code, 0, "{error}");
    let found: Value = serde_json::from_str(&out).unwrap();
    for (key, count) in
        [("/faces", 320), ("/vertices", 162), ("/boundary_loops", 0), ("/quality/valence_min", 5), ("/quality/valence_max", 6)]
    {
        assert_eq!(found.pointer(key), Some(&Value::from(count)), "{key} of {found:#}");
    }
    for (key, count) in [("vertices_welded", 1), ("faces_duplicated", 1), ("faces_turned", 1), ("edges_cut", 0), ("pieces_turned", 0)] {
        assert_eq!(found["repairs"][key], Value::from(count), "{key}");
    }
    assert_eq!(found["notes"].as_array().map(Vec::len), Some(1));
    assert!(found["quality"]["angle_min_deg"].as_f64().is_some_and(|angle| (50.0..60.0).contains(&angle)));
    let (_, text, _) = run(&["inspect", model]);
    for part in [
        "repairs\n  vertices welded to one at the same place: 1\n",
        "duplicate faces dropped: 1",
        "note: statements of unknown kinds passed over: 1",
        "`bevel`",
    ] {
        assert!(text.contains(part), "{part:?} in {text}");
    }
    assert!(run(&["inspect", "graphs/models/bunny.obj"]).1.contains("repairs\n  none\n"));
}

#[test]
fn figures_say_what_was_mended_in_the_model_that_is_drawn_and_read_no_other() {
    let (folder, graph, out) = folder();
    std::fs::write(folder.path().join("ball.obj"), broken_ball()).unwrap();
    let from_file =
        BALL.replace("Sphere(subdivisions: 4)", "ObjFile(path: \"ball.obj\")").replace("Torus()", "ObjFile(path: \"missing.obj\")");
    std::fs::write(&graph, from_file).unwrap();
    let stats = folder.path().join("stats.json");
    let (code, _, error) = run(&["render", &graph, "-o", &out, "--stats", stats.to_str().unwrap()]);
    assert_eq!(code, 0, "{error}");
    let stats: Value = serde_json::from_slice(&std::fs::read(stats).unwrap()).unwrap();
    for (key, count) in [("faces_duplicated", 1), ("faces_turned", 1), ("vertices_welded", 1), ("faces_without_area", 0)] {
        assert_eq!(stats["model"]["repairs"][key], Value::from(count), "{key}");
    }
    assert_eq!(stats.pointer("/nodes/unasked/state"), Some(&Value::from("not needed")));
}

#[test]
fn the_node_reference_is_whole() {
    let (_, out, _) = run(&["nodes", "--json"]);
    let nodes: Value = serde_json::from_str(&out).unwrap();
    assert!(nodes.as_array().is_some_and(|nodes| nodes.len() >= 18));
    let (code, out, _) = run(&["nodes", "GrowPatches"]);
    assert_eq!(code, 0);
    assert!(out.contains("tile_size") && out.contains("model diameters"));
    assert_eq!(run(&["nodes", "GrowPatch"]).0, 1);
}
