//! `pelage survey`: a row for each model, those that fail among them.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Little hair, drawn small: quick.
const GRAPH: &str = r#"Graph(version: 1, output: "picture.image", nodes: {
    "model": ObjFile(path: "no-such-model.obj"),
    "patches": GrowPatches(mesh: "model.mesh", tile_size: 0.3),
    "hair": GrowStrands(count: 60, undercoat: (count: 60), steps: 8),
    "shells": SampleShells(strands: "hair.strands", layers: 6, resolution: 32),
    "fin": SampleFin(strands: "hair.strands", size: (64, 16)),
    "coat": LayFur(mesh: "model.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells", fin: "fin.fin", length: 0.06),
    "camera": Camera(), "light": Light(), "shading": HairLighting(),
    "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (48, 40)),
})"#;

/// Runs in a folder, and gives exit code, standard output and standard error.
fn survey(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_pelage")).arg("survey").args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

/// A folder with a graph, and in `models` two balls and what is no model.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("models")).unwrap();
    std::fs::write(folder.path().join("fur.ron"), GRAPH).unwrap();
    for (name, parts) in [("b coarse.obj", 2), ("a fine.OBJ", 4)] {
        let ball = pelage_mesh::sphere(1.0, parts).unwrap();
        let mut obj = String::new();
        for p in ball.positions() {
            writeln!(obj, "v {} {} {}", p.x, p.y, p.z).unwrap();
        }
        for [a, b, c] in ball.topology().triangles() {
            writeln!(obj, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
        }
        std::fs::write(folder.path().join("models").join(name), obj).unwrap();
    }
    std::fs::write(folder.path().join("models/notes.txt"), "no model").unwrap();
    folder
}

fn figures(folder: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join("table.json")).unwrap()).unwrap()
}

#[test]
fn every_model_has_a_row_in_order_of_name_beside_those_of_the_paper() {
    let folder = folder();
    let (code, out, error) =
        survey(folder.path(), &["models", "--graph", "fur.ron", "--frames", "3", "--size", "32x24", "--json", "table.json"]);
    assert_eq!(code, 0, "{error}");
    let rows: Vec<&str> = out.lines().collect();
    assert!(rows[1].starts_with("a fine ") && rows[2].starts_with("b coarse "), "{out}");
    assert!(rows[3].contains("32 × 24 pixels, medians of 3 frames"), "{out}");
    let table = figures(folder.path());
    let models = table["models"].as_array().unwrap();
    assert_eq!(models.len(), 2);
    for (row, faces) in models.iter().zip([320, 80]) {
        assert_eq!((&row["faces"], &row["edges"]), (&Value::from(faces), &Value::from(faces * 3 / 2)), "{row:#}");
        assert!(row["patches"].as_u64().is_some_and(|count| (2..faces).contains(&count)), "{row:#}");
        for (key, layers) in [("half_layers", 3), ("all_layers", 6)] {
            let rate = &row[key];
            let number = |key: &str| rate[key].as_f64().unwrap();
            assert_eq!(rate["layers"], Value::from(layers));
            assert!(
                0.0 < number("ms_min") && number("ms_min") <= number("ms_median") && number("ms_median") <= number("ms_max"),
                "{rate:#}"
            );
            assert!((number("fps") * number("ms_median") - 1000.0).abs() < 1e-6, "{rate:#}");
        }
        let fins = |key: &str| row[key].as_u64().unwrap();
        assert!(0 < fins("fins_drawn") && fins("fins_drawn") < fins("fins_considered"), "{row:#}");
        // Six layers of 32² with mips, and a fin of 64 × 16 with its own, four bytes each.
        let mips = |width: u64, height: u64| (0..7).map(|level| (width >> level).max(1) * (height >> level).max(1)).collect::<Vec<_>>();
        let texels = 6 * mips(32, 32)[..6].iter().sum::<u64>() + mips(64, 16).iter().sum::<u64>();
        assert_eq!(row["texture_bytes"], Value::from(4 * texels));
    }
    assert_eq!((&table["width"], &table["height"], &table["frames"]), (&Value::from(32), &Value::from(24), &Value::from(3)));
    assert!(table["adapter"]["name"].is_string());
}

#[test]
fn the_papers_rows_are_as_printed_and_named_as_the_papers() {
    let folder = folder();
    let (_, out, _) = survey(folder.path(), &["models", "--graph", "fur.ron", "--frames", "1", "--json", "table.json"]);
    let (_, paper) = out.split_once("the paper's Table 1, on its own hardware (AMD-K7 at 700 MHz").unwrap();
    let rows: Vec<&str> = paper.lines().skip(1).collect();
    assert_eq!(rows.len(), 6);
    assert!(rows.iter().all(|row| row.starts_with("the paper's ")), "{paper}");
    let table = figures(folder.path());
    let column = |key: &str| {
        table["paper"]["models"].as_array().unwrap().iter().map(|row| row.pointer(key).unwrap().as_u64().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(column("/faces"), [5000, 5000, 5000, 5000, 4910, 1450]);
    assert_eq!(column("/edges"), [7547, 7500, 7500, 7500, 7365, 2400]);
    assert_eq!(column("/patches"), [306, 252, 338, 192, 228, 246]);
    assert_eq!(column("/half_layers/fps"), [23, 26, 31, 20, 21, 25]);
    assert_eq!(column("/all_layers/fps"), [12, 14, 15, 10, 11, 13]);
}

#[test]
fn a_model_that_fails_says_so_in_its_row_and_the_others_are_done() {
    let folder = folder();
    std::fs::write(folder.path().join("models/a broken.obj"), "v 0 0 0\nf 1 2 3\n").unwrap();
    let (code, out, error) = survey(folder.path(), &["models", "--graph", "fur.ron", "--frames", "1", "--json", "table.json"]);
    assert_eq!(code, 1);
    assert!(error.contains("1 of 3 models failed: a broken"), "{error}");
    let rows: Vec<&str> = out.lines().collect();
    assert!(rows[1].starts_with("a broken ") && rows[1].contains("error: ") && rows[1].contains("a broken.obj"), "{out}");
    assert!(rows[2].starts_with("a fine ") && rows[2].contains(" fps ") && rows[3].contains(" fps "), "{out}");
    let table = figures(folder.path());
    assert!(table["models"][0]["error"].is_string() && table["models"][2]["all_layers"]["fps"].is_number(), "{table:#}");
}

#[test]
fn what_cannot_be_surveyed_is_said_before_anything_is_drawn() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("none")).unwrap();
    let ball = GRAPH.replace(r#"ObjFile(path: "no-such-model.obj")"#, "Sphere()");
    std::fs::write(folder.path().join("ball.ron"), ball).unwrap();
    std::fs::write(folder.path().join("coat.ron"), GRAPH.replace("picture.image", "coat.fur")).unwrap();
    for (arguments, code, expected) in [
        (&["none"][..], 1, "no model in it"),
        (&["no-such-folder"], 1, "no-such-folder"),
        (&["models", "--graph", "ball.ron"], 1, "draws on 0 ObjFile nodes"),
        (&["models", "--graph", "coat.ron"], 1, "no picture"),
        (&["models", "--graph", "fur.ron", "--set", "hair.count=-1"], 1, "hair.count"),
        (&["models", "--set", "nonsense"], 2, "NODE.INPUT=VALUE"),
        (&["models", "--frames", "0"], 2, "--frames"),
        (&["models", "--size", "big"], 2, "--size"),
    ] {
        let (actual, out, error) = survey(folder.path(), arguments);
        assert_eq!(actual, code, "{arguments:?}: {error}");
        assert!(error.contains(expected) && out.is_empty(), "{arguments:?}: no {expected:?} in: {error}");
    }
}

#[test]
fn without_a_graph_it_is_the_bunnys() {
    let folder = folder();
    let small = ["shells.layers=4", "shells.resolution=16", "hair.count=40", "hair.undercoat.count=40", "fin.size=(32, 8)"];
    let small: Vec<&str> = small.iter().flat_map(|value| ["--set", value]).collect();
    let (code, _, error) =
        survey(folder.path(), &[&["models", "--frames", "1", "--size", "32x24", "--json", "table.json"], &small[..]].concat());
    assert_eq!(code, 0, "{error}");
    let table = figures(folder.path());
    assert_eq!((&table["graph"], &table["models"][0]["all_layers"]["layers"]), (&Value::from("bunny, built in"), &Value::from(4)));
}
