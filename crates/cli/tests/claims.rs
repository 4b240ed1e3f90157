//! What the project claims to be worth its cost, switched off and on, on three models and three kinds of hair: `graphs/sweeps/claim-*.ron`, small and of little hair. The book has the same
//! in full, from the same files.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// A number of each setting, by case, in the order of the settings.
type ByCase = BTreeMap<String, Vec<f64>>;

/// Runs the saved sweep on a small picture of little hair.
fn measured(claim: &str, more: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let sweep = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/sweeps").join(format!("claim-{claim}.ron"));
    let small = [
        "hair.count=180",
        "hair.thickness=0.018",
        "hair.undercoat=(count: 250, thickness: 0.7, length: 0.5, colour: (0.584, 0.532, 0.473))",
        "hair.steps=16",
        "cat.faces=1500",
        "ring.cells=(32, 14)",
    ];
    let set = small.iter().chain(more).flat_map(|value| ["--set", value]);
    let output = Command::new(env!("CARGO_BIN_EXE_pelage"))
        .args(["measure", "--sweep", sweep.to_str().unwrap(), "--size", "96x72", "--rounds", "1", "-q", "-o", "out"])
        .args(set)
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_str(&std::fs::read_to_string(folder.path().join("out/sweep.json")).unwrap()).unwrap()
}

fn by_case(table: &Value, column: &str) -> ByCase {
    let mut cases = ByCase::new();
    for row in table["rows"].as_array().unwrap() {
        let case = ["model", "hair"].map(|axis| row["settings"][axis].as_str().unwrap()).join(", ");
        cases.entry(case).or_default().push(row[column].as_f64().unwrap());
    }
    assert_eq!(cases.len(), 9, "three models, three kinds of hair");
    cases
}

/// That it holds in every case.
fn everywhere(cases: &ByCase, holds: impl Fn(&[f64]) -> bool) {
    let broken: Vec<_> = cases.iter().filter(|(_, numbers)| !holds(numbers)).collect();
    assert!(broken.is_empty(), "{broken:?}");
}

const COARSE: &[&str] = &["shells.layers=12", "shells.resolution=64", "few.layers=8", "few.resolution=64", "fin.size=(128, 32)"];

#[test]
fn fins_lower_the_error_of_the_silhouette() {
    let table = measured("fins", &[COARSE, &["truth.samples=9"]].concat());
    everywhere(&by_case(&table, "outline_rms"), |rms| rms[1] < 0.4 * rms[0]);
}

#[test]
fn direction_by_pixel_lowers_the_error_of_curly_hair() {
    let table = measured("direction", COARSE);
    let errors = by_case(&table, "rmse_linear");
    for model in ["bunny", "cat", "ring"] {
        let curly = &errors[&format!("{model}, curly")];
        assert!(curly[1] < curly[0], "{model}: {curly:?}");
    }
}

#[test]
fn the_opacity_rule_lowers_the_dependence_on_the_number_of_shells() {
    let table = measured("opacity", COARSE);
    // 8, 16, 32 and 64 shells without the rule, then with it; eight are what was sampled.
    everywhere(&by_case(&table, "flip_mean"), |flip| flip[7] < 0.6 * flip[3] && flip[6] < 0.6 * flip[2] && flip[0].max(flip[4]) < 1e-6);
}

#[test]
fn the_axes_of_the_table_lower_the_error_of_the_highlight() {
    let table = measured("table", COARSE);
    // Within the noise of a few pixels where hair of all directions leaves no highlight.
    everywhere(&by_case(&table, "flip_mean"), |flip| flip[2] < 1.05 * flip[0] && flip[2] < flip[1]);
    let smooth = by_case(&table, "flip_p99");
    assert!(smooth["ring, straight"][2] < 0.5 * smooth["ring, straight"][0], "{smooth:?}");
}

#[test]
fn blending_lowers_the_pop() {
    let table = measured("blend", COARSE);
    everywhere(&by_case(&table, "rmse_linear"), |steps| steps[1..].iter().all(|step| *step < 0.8 * steps[0]));
}
