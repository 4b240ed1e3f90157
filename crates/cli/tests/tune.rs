//! `pelage tune`: as good as a sweep of everything, written as a graph that differs in nothing else, and messages before anything is evaluated.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Little hair, drawn small: quick.
const GRAPH: &str = r#"// A ball.
Graph(version: 1, output: "picture.image", nodes: {
    "ball": Sphere(subdivisions: 4), // Round.
    "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3),
    "hair": GrowStrands(count: 60, undercoat: (count: 60), steps: 8),
    "shells": SampleShells(strands: "hair.strands", layers: 8, resolution: 32),
    "fin": FinImage(path: "images/fin.png"), // Drawn.
    "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells", fin: "fin.fin", length: 0.06),
    "camera": Camera(), "light": Light(), "shading": HairLighting(),
    "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (64, 48), step_blur: 0.0),
    "truth": ReferenceImage(fur: "coat.fur", strands: "hair.strands", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (64, 48), samples: 9),
})"#;

/// Twelve settings.
const GRID: &[&str] = &[
    "--vary",
    "shells.layers=2,6,12",
    "--vary",
    "shells.resolution=32",
    "--vary",
    "picture.fins=false,true",
    "--vary",
    "picture.lighting=Vertices,Pixels",
];

/// Twenty-four settings of a coat that has levels of detail.
const LEVELS: &[&str] = &[
    "--vary",
    "sampled.layers=4,8,12",
    "--vary",
    "sampled.resolution=16,32",
    "--vary",
    "picture.fins=false,true",
    "--vary",
    "picture.lighting=Vertices",
    "--vary",
    "picture.detail=Level(level: 1.0),Level(level: 0.0)",
];

/// Runs in a folder, and gives exit code, standard output and standard error.
fn pelage(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_pelage")).args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

fn tune(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    pelage(folder, &[&["tune"], arguments].concat())
}

/// A folder with `fur.ron` and the image it names.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("fur.ron"), GRAPH).unwrap();
    std::fs::create_dir(folder.path().join("images")).unwrap();
    let image = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/images/fin.png");
    std::fs::copy(image, folder.path().join("images/fin.png")).unwrap();
    folder
}

fn read(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join(file)).unwrap()
}

/// The rows of the table that is printed, by column.
fn rows(table: &str) -> Vec<Vec<(String, String)>> {
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
    let mut lines = table.lines().take_while(|line| line.starts_with('|'));
    let heads = cells(lines.next().unwrap());
    // The rule, and the graph as it is.
    lines.skip(2).map(|line| heads.iter().cloned().zip(cells(line)).collect()).collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    &row.iter().find(|(head, _)| head == name).unwrap().1
}

fn number(row: &[(String, String)], name: &str) -> f64 {
    cell(row, name).parse().unwrap()
}

/// Every setting of the grid, measured: cost and error.
fn exhaustive(folder: &Path, cost: &str) -> Vec<(f64, f64)> {
    let sweep: Value = serde_json::from_str(&read(folder, "all/sweep.json")).unwrap();
    let number = |row: &Value, name: &str| row[name].as_f64().unwrap();
    sweep["rows"].as_array().unwrap().iter().map(|row| (number(row, cost), number(row, "flip_mean"))).collect()
}

#[test]
fn it_is_within_a_tenth_of_the_best_of_all() {
    let folder = folder();
    within_a_tenth(folder.path(), GRID, 12, "shells.layers");
}

#[test]
fn with_levels_of_detail_and_two_resolutions_it_is_too() {
    let folder = folder();
    let levels = GRAPH.replace(
        r#""shells": SampleShells(strands: "hair.strands", layers: 8, resolution: 32)"#,
        r#""sampled": SampleShells(strands: "hair.strands", layers: 8, resolution: 32), "shells": LevelsOfDetail(shells: "sampled.shells")"#,
    );
    assert_ne!(levels, GRAPH);
    std::fs::write(folder.path().join("fur.ron"), levels).unwrap();
    within_a_tenth(folder.path(), LEVELS, 24, "sampled.layers");
}

/// Tunes `fur.ron` for goals of every kind that can be counted, over a grid of so many settings.
fn within_a_tenth(folder: &Path, grid: &[&str], count: usize, layers: &str) {
    let (code, _, error) = pelage(folder, &[&["measure", "fur.ron"], grid, &["--rounds", "1", "-q", "-o", "all"]].concat());
    assert_eq!(code, 0, "{error}");
    let (mut evaluated, mut all) = (0, 0);
    for (cost, column) in [("fragments", "fragments"), ("bytes", "texture_bytes")] {
        let settings = exhaustive(folder, column);
        let sorted = |of: fn(&(f64, f64)) -> f64| {
            let mut values: Vec<f64> = settings.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let (costs, errors) = (sorted(|row| row.0), sorted(|row| row.1));
        let mut goals: Vec<(Vec<String>, f64)> = Vec::new();
        for place in [1, count / 2] {
            // The table has five digits.
            let limit = errors[place] + 1e-5;
            let best = settings.iter().filter(|row| row.1 <= limit).map(|row| row.0).fold(f64::INFINITY, f64::min);
            goals.push((vec!["--max-error".into(), limit.to_string(), "--cost".into(), cost.into()], best));
        }
        let limit = costs[count / 2 - 1];
        let best = settings.iter().filter(|row| row.0 <= limit).map(|row| row.1).fold(f64::INFINITY, f64::min);
        goals.push((vec![format!("--max-{cost}"), limit.to_string()], best));
        for (goal, best) in goals {
            let goal: Vec<&str> = goal.iter().map(String::as_str).collect();
            let (code, out, error) = tune(folder, &[&["fur.ron", "-o", "out.ron"], grid, &goal].concat());
            assert_eq!(code, 0, "{goal:?}: {error}");
            let rows = rows(&out);
            let chosen: Vec<_> = rows.iter().filter(|row| cell(row, "chosen") == "yes").collect();
            assert_eq!(chosen.len(), 1, "{out}");
            let (sought, limited) = if goal[0] == "--max-error" { (column, "flip_mean") } else { ("flip_mean", column) };
            assert!(number(chosen[0], limited) <= goal[1].parse::<f64>().unwrap(), "{goal:?}\n{out}");
            assert!(number(chosen[0], sought) <= 1.1 * best + 1e-9, "{goal:?}: {best}\n{out}");
            assert!(out.contains(&format!("{} of {count} settings evaluated", rows.len())), "{out}");
            let written = read(folder, "out.ron");
            assert!(written.contains(&format!("layers: {},", cell(chosen[0], layers))), "{written}");
            evaluated += rows.len();
            all += settings.len();
        }
    }
    assert!(4 * evaluated < 3 * all, "{evaluated} of {all} evaluated");
}

#[test]
fn what_is_written_is_the_graph_with_what_was_chosen() {
    let folder = folder();
    let arguments = [
        "fur.ron",
        "--max-error",
        "1",
        "--cost",
        "bytes",
        "--size",
        "32x24",
        "--set",
        "coat.length=0.07",
        "--vary",
        "shells.layers=4",
        "--vary",
        "shells.resolution=32",
    ];
    let (code, out, error) = tune(folder.path(), &[&arguments[..], &["-o", "deep/er/out.ron"]].concat());
    assert_eq!(code, 0, "{error}");
    // What the graph has to turn, less what was pinned: the cheapest of it, as any error will do.
    assert!(out.starts_with("| shells.layers | shells.resolution | picture.fins | picture.lighting | fragments |"), "{out}");
    let row = &rows(&out).into_iter().find(|row| cell(row, "chosen") == "yes").unwrap();
    assert_eq!((cell(row, "shells.layers"), cell(row, "shells.resolution"), cell(row, "ms")), ("4", "32", ""));
    let expected = GRAPH
        .replace("layers: 8", "layers: 4")
        .replace("images/fin.png", "../../images/fin.png")
        .replace("length: 0.06", "length: 0.07")
        .replace(
            "step_blur: 0.0)",
            &format!("step_blur: 0.0, fins: {}, lighting: {})", cell(row, "picture.fins"), cell(row, "picture.lighting")),
        );
    assert_eq!(read(folder.path(), "deep/er/out.ron"), expected);
    let (code, _, error) = pelage(folder.path(), &["check", "deep/er/out.ron"]);
    assert_eq!(code, 0, "{error}");

    // Quietly, with other threads, the same; and over what was there.
    std::fs::write(folder.path().join("deep/er/again.ron"), "as before").unwrap();
    let (code, out, error) = tune(folder.path(), &[&arguments[..], &["--threads", "1", "-q", "-o", "deep/er/again.ron"]].concat());
    assert_eq!((code, out.as_str()), (0, ""), "{error}");
    assert_eq!(read(folder.path(), "deep/er/again.ron"), expected);
}

#[test]
fn a_limit_is_kept_at_the_size_of_the_graph() {
    let folder = folder();
    let (code, _, error) =
        pelage(folder.path(), &[&["measure", "fur.ron"], GRID, &["--against", "truth.image", "--rounds", "1", "-q", "-o", "all"]].concat());
    assert_eq!(code, 0, "{error}");
    let settings = exhaustive(folder.path(), "fragments");
    let mut errors: Vec<f64> = settings.iter().map(|row| row.1).collect();
    errors.sort_by(f64::total_cmp);
    let limit = errors[3] + 1e-5;
    let (goal, small) = (limit.to_string(), ["--size", "32x24", "--cost", "fragments", "--against", "truth.image"]);
    let (code, out, error) = tune(folder.path(), &[&["fur.ron", "-o", "out.ron", "--max-error", &goal], GRID, &small[..]].concat());
    assert_eq!(code, 0, "{error}");
    let said = out.lines().find_map(|line| line.strip_prefix("At its own size: FLIP ")).unwrap();
    let (error, cost) = said.split_once(" fragments (as it is: FLIP ").unwrap().0.split_once(", ").unwrap();
    let (cost, error): (f64, f64) = (cost.parse().unwrap(), error.parse().unwrap());
    assert!(error <= limit && settings.contains(&(cost, error)), "{out}");
    // No setting is much cheaper, though a small picture is not quite a large one.
    let best = settings.iter().filter(|row| row.1 <= limit).map(|row| row.0).fold(f64::INFINITY, f64::min);
    assert!(cost <= 1.1 * best, "{best}: {out}");
    // What no setting keeps at its own size is said to be out of reach there.
    let (code, _, error) = tune(folder.path(), &[&["fur.ron", "-o", "no.ron", "--max-error", "0.0001"], GRID, &small[..]].concat());
    assert!(code == 1 && error.contains("no setting errs by 0.0001 or less at its own size"), "{error}");
    assert!(!folder.path().join("no.ron").exists());
}

#[test]
fn times_are_of_a_frame_and_the_limit_is_kept() {
    let folder = folder();
    let grid = ["--vary", "shells.layers=2,8", "--vary", "shells.resolution=32", "--vary", "picture.lighting=Vertices", "--rounds", "2"];
    let (code, out, error) =
        tune(folder.path(), &[&["fur.ron", "--max-ms", "1e6", "--against", "truth.image", "-o", "out.ron"], &grid[..]].concat());
    assert_eq!(code, 0, "{error}");
    let rows = rows(&out);
    assert!(rows.iter().all(|row| number(row, "ms") > 0.0), "{out}");
    // Any time will do: what errs least of all that was tried, against the truth.
    let least = rows.iter().map(|row| number(row, "flip_mean")).fold(f64::INFINITY, f64::min);
    let chosen = rows.iter().find(|row| cell(row, "chosen") == "yes").unwrap();
    assert!(least > 0.0 && number(chosen, "flip_mean") == least, "{out}");
    // By itself an error is had for the least time.
    let (code, out, error) = tune(folder.path(), &[&["fur.ron", "--max-error", "0.9", "-o", "out.ron"], &grid[..]].concat());
    assert!(code == 0 && out.contains(" ms (as it is: "), "{out}{error}");
}

#[test]
fn what_is_out_of_reach_is_said_with_what_comes_nearest_and_nothing_written() {
    let folder = folder();
    std::fs::write(folder.path().join("out.ron"), "as before").unwrap();
    let inputs = ["shells.layers=2,6", "shells.resolution=32", "picture.fins=true", "picture.lighting=Vertices"];
    let grid: Vec<&str> = inputs.iter().flat_map(|input| ["--vary", input]).collect();
    for (goal, expected) in [
        (
            &["--max-error", "0.0001", "--cost", "bytes", "--finest", "shells.layers=32"][..],
            "no setting errs by 0.0001 or less; the least found is 0.",
        ),
        (&["--max-fragments", "10"], "no setting costs 10 fragments or less; the least found is "),
        (&["--max-bytes", "10"], "no setting costs 10 bytes or less; the least found is "),
        (&["--max-ms", "1e-6", "--rounds", "1"], "no setting costs 0.000001 ms or less; the least found is "),
    ] {
        let (code, out, error) = tune(folder.path(), &[&["fur.ron", "-o", "out.ron"], &grid[..], goal].concat());
        assert!(code == 1 && out.is_empty() && error.contains(expected), "{goal:?}: {error}");
        assert!(error.contains(", with shells.layers=") && error.contains(" of 2 settings evaluated): allow more"), "{error}");
        assert_eq!(read(folder.path(), "out.ron"), "as before");
    }
    let (code, _, error) =
        tune(folder.path(), &[&["fur.ron", "-o", "out.ron"], GRID, &["--max-bytes", "10", "--evaluations", "2"]].concat());
    assert!(code == 1 && error.contains("(2 of 12 settings evaluated): allow more, or more --evaluations"), "{error}");
    let (code, out, error) = tune(
        folder.path(),
        &[&["fur.ron", "-o", "out.ron"], GRID, &["--max-error", "0.9", "--cost", "bytes", "--evaluations", "2"]].concat(),
    );
    assert!(code == 0 && out.contains("the search was cut short"), "{out}{error}");
}

#[test]
fn what_cannot_be_tuned_is_said_and_nothing_written() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("a folder")).unwrap();
    let bare = GRAPH.replace("RenderImage(fur", "RenderImage(lighting: \"light.light\", fur");
    std::fs::write(folder.path().join("wrong.ron"), bare).unwrap();
    for (arguments, code, expected) in [
        (&["fur.ron", "-o", "out.ron"][..], 2, "--max-error"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "0.1", "--max-ms", "2"], 2, "cannot be used with"),
        (&["fur.ron", "-o", "out.ron", "--max-ms", "2", "--cost", "bytes"], 2, "--max-error"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "much"], 2, "expected a number"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "-0.1"], 2, "--max-error"),
        (&["fur.ron", "-o", "out.ron", "--max-ms", "0"], 2, "expected a number above 0"),
        (&["fur.ron", "--max-error", "0.1"], 2, "--out"),
        (&["fur.ron", "-o", "a folder", "--max-error", "0.1"], 2, "name a file"),
        (&["fur.ron", "-o", "./fur.ron", "--max-error", "0.1"], 2, "that is the graph itself"),
        (&["fur.ron", "-o", "out.png", "--max-error", "0.1"], 2, "ends in .ron"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "1.5"], 2, "expected a number from 0 to 1"),
        (&["none.ron", "-o", "out.ron", "--max-error", "0.1"], 1, "none.ron"),
        (&["wrong.ron", "-o", "out.ron", "--max-error", "0.1"], 1, "lighting"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "0.1", "--vary", "shels.layers=1,2"], 1, "did you mean shells"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "0.1", "--vary", "shells.layers=1,0"], 1, "shells.layers=0"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "0.1", "--vary", "shells.layers=1,,2"], 2, "value is empty"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "0.1", "--vary", "shells.layers=1", "--vary", "shells.layers=2"], 2, "given twice"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "0.1", "--finest", "shells.layers=many"], 1, "many"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "0.1", "--against", "coat.fur"], 1, "no picture to measure against"),
        (&["fur.ron", "-o", "out.ron", "--max-error", "0.1", "--output", "truth.image"], 1, "is not drawn"),
        (
            &[
                "fur.ron",
                "-o",
                "out.ron",
                "--max-error",
                "0.1",
                "--vary",
                "hair.count=1,2,3,4,5,6,7,8,9",
                "--vary",
                "hair.seed=1,2,3,4,5,6,7,8,9",
            ],
            2,
            "more than 5000",
        ),
    ] {
        let (actual, out, error) = tune(folder.path(), arguments);
        assert_eq!(actual, code, "{arguments:?}: {error}");
        assert!(error.contains(expected) && out.is_empty(), "{arguments:?}: no {expected:?} in: {error}");
    }
    let mut names: Vec<String> =
        std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["a folder", "fur.ron", "images", "wrong.ron"], "something was left behind");
}
