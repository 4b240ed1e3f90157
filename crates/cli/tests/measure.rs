//! `pelage measure`: a row for each setting, fronts, files that are whole or not there, and messages before anything is evaluated.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Little hair, drawn small, beside the truth: quick.
const GRAPH: &str = r#"Graph(version: 1, output: "picture.image", nodes: {
    "ball": Sphere(subdivisions: 4),
    "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3),
    "hair": GrowStrands(count: 60, undercoat: (count: 60), steps: 8),
    "shells": SampleShells(strands: "hair.strands", layers: 8, resolution: 32),
    "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells", length: 0.06),
    "camera": Camera(), "light": Light(), "shading": HairLighting(),
    "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (64, 48), step_blur: 0.0),
    "truth": ReferenceImage(fur: "coat.fur", strands: "hair.strands", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (64, 48), samples: 9),
})"#;

/// Runs in a folder, and gives exit code, standard output and standard error.
fn measure(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_pelage")).arg("measure").args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

/// A folder with `fur.ron`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("fur.ron"), GRAPH).unwrap();
    folder
}

fn read(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join(file)).unwrap()
}

fn table(folder: &Path, file: &str) -> Value {
    serde_json::from_str(&read(folder, file)).unwrap()
}

fn column(table: &Value, name: &str) -> Vec<f64> {
    table["rows"].as_array().unwrap().iter().map(|row| row[name].as_f64().unwrap_or(f64::NAN)).collect()
}

#[test]
fn more_layers_cost_more_and_err_less_against_the_truth() {
    let folder = folder();
    let (code, out, error) =
        measure(folder.path(), &["fur.ron", "--vary", "shells.layers=1,4,16", "--against", "truth.image", "--rounds", "3", "-o", "out"]);
    assert_eq!(code, 0, "{error}");
    assert!(out.starts_with("| shells.layers | ") && out.lines().count() == 5, "{out}");

    let csv = read(folder.path(), "out/sweep.csv");
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines.len(), 4);
    assert_eq!(lines[1..].iter().map(|cells| cells[0]).collect::<Vec<_>>(), ["1", "4", "16"]);
    assert_eq!(&lines[0][lines[0].len() - 4..], ["front_fragments", "front_texture_bytes", "front_ms_min", "front"]);
    // Each is worth its cost, as each errs less than the one before; of times only what is quickest is sure.
    let last = lines[0].len() - 4;
    assert!(
        lines[1..]
            .iter()
            .all(|cells| cells.len() == lines[0].len() && cells[last] == "1" && cells[last + 1] == "1" && cells[last + 3] == "1"),
        "{csv}"
    );

    let table = table(folder.path(), "out/sweep.json");
    for (name, falling) in [("fragments", false), ("texture_bytes", false), ("flip_mean", true), ("rmse_linear", true)] {
        let numbers = column(&table, name);
        assert!(numbers.is_sorted_by(|a, b| if falling { a > b } else { a < b }), "{name}: {numbers:?}");
    }
    assert_eq!(column(&table, "shells"), [0.0, 3.0, 15.0]);
    // Layers of 32² with all mips, four bytes a texel, and no fin.
    let texels: usize = (0..6).map(|level| (32usize >> level).pow(2)).sum();
    assert_eq!(column(&table, "texture_bytes"), [1, 4, 16].map(|layers| (4 * layers * texels) as f64));
    assert!(column(&table, "ms_min").iter().zip(column(&table, "ms_median")).all(|(min, median)| 0.0 < *min && *min <= median));
    assert_eq!(column(&table, "ms_ratio")[2], 1.0);
    assert_eq!((&table["against"], &table["output"], &table["width"]), (&"truth.image".into(), &"picture.image".into(), &64.into()));
    let profile = table["rows"][0]["alpha_profile"].as_array().unwrap();
    assert!(profile.len() > 4 && profile.iter().all(|bin| bin.as_array().is_some_and(|bin| bin.len() == 3)));
    // The skin alone is smaller than the coat.
    assert!(column(&table, "outline_shift")[0] < -0.3, "{table:#}");

    let sheet = image::open(folder.path().join("out/sheet.png")).unwrap();
    // The truth and three pictures above their errors, in one row.
    assert_eq!((sheet.width(), sheet.height()), (4 * 64 + 3 * 4, 2 * 48 + 4));
    let svg = read(folder.path(), "out/sweep.svg");
    assert!(svg.contains("fragments") && svg.contains("flip_mean") && svg.contains("<polyline"));
    let names: BTreeSet<String> =
        std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(names, BTreeSet::from(["fur.ron".into(), "out".into()]), "something was left behind");
}

#[test]
fn without_a_truth_the_last_values_are_it() {
    let folder = folder();
    let (code, _, error) = measure(
        folder.path(),
        &["fur.ron", "--vary", "shells.layers=2,8", "--vary", "picture.samples=1,4", "--rounds", "1", "-q", "-o", "out"],
    );
    assert_eq!(code, 0, "{error}");
    let table = table(folder.path(), "out/sweep.json");
    assert_eq!(table["varied"], serde_json::json!(["shells.layers", "picture.samples"]));
    let errors = column(&table, "flip_mean");
    assert!(errors.len() == 4 && errors[3] == 0.0 && errors[..3].iter().all(|&error| error > 0.0), "{errors:?}");
    // 2 layers at 4 samples cost more fragments than 2 at 1.
    let fragments = column(&table, "fragments");
    assert!(fragments[1] > 3.0 * fragments[0], "{fragments:?}");

    let (code, _, error) = measure(
        folder.path(),
        &["fur.ron", "--vary", "shells.layers=2,8", "--finest", "shells.layers=2", "--rounds", "1", "-q", "-o", "out"],
    );
    assert_eq!(code, 0, "{error}");
    let errors = column(&self::table(folder.path(), "out/sweep.json"), "flip_mean");
    assert!(errors[0] == 0.0 && errors[1] > 0.0, "--finest goes before the last value: {errors:?}");
}

#[test]
fn what_is_beaten_is_on_no_front() {
    let folder = folder();
    // The same again is no better.
    let (code, _, error) = measure(
        folder.path(),
        &["fur.ron", "--vary", "shells.layers=4,8", "--vary", "camera.field_of_view=30.0,30.0", "-q", "--rounds", "1", "-o", "out"],
    );
    assert_eq!(code, 0, "{error}");
    let fronts = &table(folder.path(), "out/sweep.json")["fronts"];
    assert_eq!(fronts["fragments"]["rows"], serde_json::json!([0, 2]));
}

#[test]
fn a_saved_sweep_says_the_same_and_twice_the_same_bytes() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("sweeps")).unwrap();
    let sweep = r#"Sweep(title: "two", graph: "../fur.ron", against: Output("truth.image"), rounds: 2, set: { "picture.samples": 1 },
        vary: { "shells.layers": [2, 6], "picture.lighting": [Vertices, Table(size: 4)] })"#;
    std::fs::write(folder.path().join("sweeps/two.ron"), sweep).unwrap();
    for out in ["a", "b"] {
        let (code, said, error) = measure(folder.path(), &["--sweep", "sweeps/two.ron", "-q", "-o", out]);
        assert_eq!((code, said.as_str()), (0, ""), "{error}");
    }
    let (code, _, error) = measure(
        folder.path(),
        &[
            "fur.ron",
            "--against",
            "truth.image",
            "--set",
            "picture.samples=1",
            "--vary",
            "shells.layers=2,6",
            "--vary",
            "picture.lighting=Vertices,Table(size: 4)",
            "--rounds",
            "1",
            "-q",
            "-o",
            "c",
        ],
    );
    assert_eq!(code, 0, "{error}");
    let untimed = |out: &str| {
        let csv = read(folder.path(), &format!("{out}/sweep.csv"));
        let names: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
        // No value of these has a comma in it.
        let steady = |line: &str| {
            line.split(',')
                .zip(&names)
                .filter(|(_, name)| !name.contains("ms_") && **name != "front")
                .map(|(cell, _)| cell.to_owned())
                .collect::<Vec<_>>()
        };
        csv.lines().map(steady).collect::<Vec<_>>()
    };
    assert_eq!(untimed("a").len(), 5);
    assert_eq!(
        ["a", "c"].map(|out| table(folder.path(), &format!("{out}/sweep.json"))["rounds"].clone()),
        [Value::from(2), Value::from(1)]
    );
    assert_eq!(untimed("a"), untimed("b"));
    assert_eq!(untimed("a"), untimed("c"));
    let sheet = |out: &str| std::fs::read(folder.path().join(out).join("sheet.png")).unwrap();
    assert!(sheet("a") == sheet("b") && sheet("a") == sheet("c"));
}

#[test]
fn each_setting_may_have_a_truth_of_its_own() {
    let folder = folder();
    let turned = ["fur.ron", "--vary", "camera.azimuth=0.0,90.0", "--against", "truth.image", "--rounds", "1", "-q", "-o"];
    let errors = |out: &str, more: &[&str]| {
        let (code, _, error) = measure(folder.path(), &[&turned[..], &[out], more].concat());
        assert_eq!(code, 0, "{error}");
        column(&table(folder.path(), &format!("{out}/sweep.json")), "flip_mean")
    };
    let (once, each) = (errors("once", &[]), errors("each", &["--each"]));
    // Against the truth from elsewhere the first picture is as wrong as another hair would be.
    assert!(once[0] > 1.2 * each[0] && once[1] == each[1], "{once:?} {each:?}");
}

#[test]
fn each_case_has_a_truth_of_its_own_and_competes_with_itself() {
    let folder = folder();
    let sweep = r#"Sweep(title: "cases", graph: "fur.ron", against: Output("truth.image"), rounds: 2, finest: { "truth.samples": 16 }, set: { "picture.samples": 1 },
        cases: { "model": { "ball": {}, "turned": { "camera.azimuth": 90.0 } } }, cases_of: "shared/hair.ron",
        vary: { "shells.layers": [8, 2] })"#;
    std::fs::create_dir(folder.path().join("shared")).unwrap();
    std::fs::write(folder.path().join("shared/hair.ron"), r#"{ "hair": { "short": { "coat.length": 0.03 }, "long": {} } }"#).unwrap();
    std::fs::write(folder.path().join("cases.ron"), sweep).unwrap();
    let (code, _, error) = measure(folder.path(), &["--sweep", "cases.ron", "-q", "-o", "out"]);
    assert_eq!(code, 0, "{error}");
    let table = table(folder.path(), "out/sweep.json");
    assert_eq!(table["varied"], serde_json::json!(["model", "hair", "shells.layers"]));
    assert_eq!(table["grouped_by"], serde_json::json!(["model", "hair"]));
    let name = |row: usize| ["model", "hair", "shells.layers"].map(|key| table["rows"][row]["settings"][key].as_str().unwrap().to_owned());
    assert_eq!((name(0), name(3)), (["ball", "short", "8"].map(str::to_owned), ["ball", "long", "2"].map(str::to_owned)));
    // Within each case more shells cost more and err less: both are on its front, the cheaper first, whatever other cases cost.
    assert_eq!(table["fronts"]["fragments"]["rows"], serde_json::json!([1, 0, 3, 2, 5, 4, 7, 6]));
    // The last of each case is what its others' times are over.
    let ratios = column(&table, "ms_ratio");
    assert!([1, 3, 5, 7].iter().all(|&row| ratios[row] == 1.0), "{ratios:?}");
    // Alone, a case measures the same.
    let alone = [
        "fur.ron",
        "--against",
        "truth.image",
        "--finest",
        "truth.samples=16",
        "--set",
        "picture.samples=1",
        "--set",
        "camera.azimuth=90.0",
    ];
    let (code, _, error) =
        measure(folder.path(), &[&alone[..], &["--vary", "shells.layers=8,2", "--rounds", "1", "-q", "-o", "alone"]].concat());
    assert_eq!(code, 0, "{error}");
    let all = column(&table, "flip_mean");
    assert_eq!(column(&self::table(folder.path(), "alone/sweep.json"), "flip_mean"), all[6..]);
}

#[test]
fn a_fingerprint_is_of_all_that_is_measured_and_of_nothing_else() {
    let folder = folder();
    let vary = ["--vary", "shells.layers=2,4"];
    let print = |more: &[&str]| {
        let (code, out, error) = measure(folder.path(), &[&["fur.ron", "--fingerprint"], &vary[..], more].concat());
        assert_eq!(code, 0, "{error}");
        out.trim().to_owned()
    };
    let first = print(&[]);
    assert_eq!(print(&["--rounds", "3"]), first, "times are no part of it");
    assert_ne!(print(&["--set", "coat.length=0.05"]), first);
    assert_ne!(print(&["--against", "truth.image"]), first);
    assert_eq!(print(&["--set", "truth.samples=3"]), first, "what nobody measures against");
    assert_ne!(print(&["--against", "truth.image", "--set", "truth.samples=3"]), print(&["--against", "truth.image"]));
    let text = read(folder.path(), "fur.ron");
    std::fs::write(folder.path().join("fur.ron"), format!("// A remark.\n{}", text.replace("\"ball", "\"round"))).unwrap();
    assert_eq!(print(&[]), first, "names and remarks are no part of it");
    let (code, _, error) = measure(folder.path(), &[&["fur.ron"], &vary[..], &["--rounds", "1", "-q", "-o", "out"]].concat());
    assert_eq!(code, 0, "{error}");
    assert_eq!(table(folder.path(), "out/sweep.json")["fingerprint"], first.as_str());
}

#[test]
fn what_cannot_be_measured_is_said_and_nothing_written() {
    let folder = folder();
    std::fs::write(folder.path().join("file"), "as before").unwrap();
    std::fs::write(folder.path().join("wrong.ron"), "Sweep(graph: \"fur.ron\",\n  vry: {})").unwrap();
    std::fs::write(folder.path().join("empty.ron"), "Sweep(graph: \"fur.ron\", vary: { \"shells.layers\": [] })").unwrap();
    std::fs::write(folder.path().join("caseless.ron"), "Sweep(graph: \"fur.ron\", cases: { \"model\": {} })").unwrap();
    std::fs::write(folder.path().join("elsewhere.ron"), "Sweep(graph: \"fur.ron\", cases_of: \"nowhere.ron\")").unwrap();
    std::fs::write(
        folder.path().join("case.ron"),
        "Sweep(graph: \"fur.ron\", cases: { \"model\": { \"a\": {}, \"b\": { \"coat.size\": 1 } } })",
    )
    .unwrap();
    let budget = concat!(env!("CARGO_MANIFEST_DIR"), "/../../graphs/budget.ron");
    for (arguments, code, expected) in [
        (&[budget, "--output", "near.image", "--vary", "near.fins=false,true"][..], 1, "the budget of near decides it"),
        (&["--sweep", "caseless.ron"], 2, "model has no cases"),
        (&["--sweep", "case.ron"], 1, "b: "),
        (&["fur.ron", "--vary", "shells.layers=1,2", "--group", "picture.fins"], 1, "picture.fins groups settings and does not vary"),
        (&["fur.ron", "--vary", "shels.layers=1,2"], 1, "did you mean shells"),
        (&["fur.ron", "--vary", "shells.layer=1,2"], 1, "layers"),
        (&["fur.ron", "--vary", "shells.layers=1,many"], 1, "many"),
        (&["fur.ron", "--vary", "shells.layers=1,0"], 1, "shells.layers=0"),
        (&["fur.ron", "--vary", "shells.layers="], 2, "value is empty"),
        (&["fur.ron", "--vary", "shells.layers=1,,2"], 2, "value is empty"),
        (&["fur.ron", "--vary", "shells=1"], 2, "NODE.INPUT"),
        (&["fur.ron", "--vary", "shells.layers=1", "--vary", "shells.layers=2"], 2, "given twice"),
        (&["fur.ron"], 2, "--vary"),
        (&["--vary", "shells.layers=1"], 2, "GRAPH.ron"),
        (&["--sweep", "wrong.ron"], 1, "wrong.ron:2:"),
        (&["--sweep", "empty.ron"], 2, "no values"),
        (&["--sweep", "none.ron"], 1, "none.ron"),
        (&["--sweep", "elsewhere.ron"], 1, "nowhere.ron"),
        (&["fur.ron", "--vary", "shells.layers=1,2", "--against", "coat.fur"], 1, "no picture to measure against"),
        (&["fur.ron", "--vary", "shells.layers=1,2", "--output", "truth.image"], 1, "is not drawn"),
        (&["fur.ron", "--vary", "shells.layers=1,2", "--finest", "shells.layers=many"], 1, "many"),
        (&["fur.ron", "--vary", "shells.resolution=32,33"], 1, "power of two"),
        (&["fur.ron", "--vary", "picture.size=(64, 48),(32, 24)"], 1, "one size"),
        (&["fur.ron", "--vary", "shells.layers=1,2", "--set", "picture.size=(48, 64)", "--against", "truth.image"], 1, "one size"),
    ] {
        let (actual, out, error) = measure(folder.path(), &[arguments, &["--rounds", "1", "-q", "-o", "out"]].concat());
        assert_eq!(actual, code, "{arguments:?}: {error}");
        assert!(error.contains(expected) && out.is_empty(), "{arguments:?}: no {expected:?} in: {error}");
        assert!(!folder.path().join("out").exists());
    }
    let (code, _, error) = measure(folder.path(), &["fur.ron", "--vary", "shells.layers=1,2", "-o", "file"]);
    assert!(code == 2 && error.contains("name a folder"), "{error}");
    assert_eq!(read(folder.path(), "file"), "as before");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 7, "something was left behind");
}

#[test]
fn every_saved_sweep_names_a_graph_and_inputs_that_there_are() {
    let sweeps = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/sweeps");
    let folder = folder();
    for entry in std::fs::read_dir(sweeps).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "ron") {
            continue;
        }
        // What cannot be measured against is said after all else has been checked, and before anything is evaluated.
        let (code, _, error) = measure(folder.path(), &["--sweep", path.to_str().unwrap(), "--against", "no.picture", "-o", "out"]);
        assert!(code == 1 && error.contains("no.picture is no picture to measure against"), "{}: {error}", path.display());
    }
}
