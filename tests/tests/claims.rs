//! What the book says holds in the figures that it shows, `book/src/measured`: each claim where it was measured, and the saved bunny's own settings on the measured front.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeMap;

use pelage_graph::Graph;
use pelage_tests::repository;

/// A row of figures by the names of its columns.
type Row = BTreeMap<String, String>;

fn figures(name: &str) -> Vec<Row> {
    let file = repository().join("book/src/measured").join(format!("{name}.csv"));
    let mut reader = csv::Reader::from_path(&file).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap()
}

/// A column of each case's rows, in their order: three models, three kinds of hair.
fn by_case(name: &str, column: &str) -> BTreeMap<String, Vec<f64>> {
    let mut cases: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for row in figures(name) {
        cases.entry(format!("{}, {}", row["model"], row["hair"])).or_default().push(number(&row, column));
    }
    assert_eq!(cases.len(), 9, "{name}: {:?}", cases.keys());
    cases
}

#[test]
fn fins_take_three_quarters_of_the_error_of_the_silhouette() {
    for (case, rms) in by_case("claim-fins", "outline_rms") {
        assert!(rms[1] < 0.25 * rms[0], "{case}: {rms:?}");
    }
}

#[test]
fn direction_by_pixel_is_for_curls() {
    for (case, flip) in by_case("claim-direction", "flip_mean") {
        let gain = flip[0] - flip[1];
        assert!(if case.ends_with("curly") { gain > 0.02 } else { gain.abs() < 0.01 }, "{case}: {flip:?}");
    }
}

#[test]
fn the_opacity_rule_leaves_less_than_half_of_the_dependence_on_the_number_of_shells() {
    // 8, 16, 32 and 64 shells without the rule, then with it.
    for (case, flip) in by_case("claim-opacity", "flip_mean") {
        for shells in [0, 2, 3] {
            assert!(flip[shells + 4] < 0.5 * flip[shells], "{case}: {flip:?}");
        }
    }
}

#[test]
fn each_axis_of_the_table_lowers_the_error_of_its_part() {
    for (case, p99) in by_case("claim-table", "flip_p99") {
        // The cosine to the half vector against its angle: the highlight.
        assert!(p99[2] < 0.75 * p99[1], "{case}: {p99:?}");
        // The angle to the light against its cosine: the diffuse part, where hair points at the light.
        let points_at_the_light = !case.starts_with("bunny") && !case.ends_with("curly");
        assert!(p99[2] < if points_at_the_light { 0.3 } else { 1.02 } * p99[0], "{case}: {p99:?}");
    }
}

#[test]
fn blending_lowers_the_pop() {
    for (case, steps) in by_case("claim-blend", "flip_mean") {
        let largest = steps[1..].iter().copied().fold(0.0, f64::max);
        assert!(steps.len() == 9 && largest < 0.8 * steps[0], "{case}: {steps:?}");
    }
}

#[test]
fn the_bunnys_own_settings_are_on_the_measured_front() {
    let bunny = Graph::read(&repository().join("graphs/bunny.ron")).unwrap();
    let set = |node: &str, input: &str, default: &str| {
        bunny.nodes.get(node).unwrap().fields.get(input).map_or_else(|| default.to_owned(), ToString::to_string)
    };
    let own = [
        ("shells.layers", set("shells", "layers", "16")),
        ("shells.resolution", set("shells", "resolution", "128")),
        ("shells.spacing", set("shells", "spacing", "Even")),
        ("picture.lighting", set("picture", "lighting", "Vertices")),
    ];
    let rows = figures("bunny");
    let row = rows.iter().find(|row| own.iter().all(|(input, value)| row[*input] == *value));
    let row = row.unwrap_or_else(|| panic!("{own:?} are not among the settings measured: add them to graphs/sweeps/bunny.ron"));
    assert_eq!(row["front"], "1", "{row:?}");
    assert!(rows.iter().any(|row| row["front"] == "0"), "the front leaves nothing out");
}
