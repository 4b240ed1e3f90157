//! What the book says holds in the figures that it shows, `book/src/measured`: each claim where it was measured, and the saved bunny's own settings on the measured front.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeMap;

use pelage_graph::Graph;
use pelage_tests::{Figures, Row, number, repository};

/// A column of each case's rows, in their order: three models, three kinds of hair.
fn by_case(name: &str, column: &str) -> BTreeMap<String, Vec<f64>> {
    let cases = Figures::of(name).unwrap().by(&["model", "hair"], column).unwrap();
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
        assert!(if case.ends_with("curly") { gain > 0.02 } else { gain.abs() < 0.005 }, "{case}: {flip:?}");
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

/// The costs and the errors by which one setting is no worse than another: what is counted, the time, how far the picture is off on the mean, and its outline.
const MEASURES: [&str; 5] = ["fragments", "texture_bytes", "ms_ratio", "flip_mean", "outline_rms"];

/// Whether a setting is worse than another by nothing that counts, and better by something. Times of one picture waver by a few hundredths.
fn is_beaten(row: &Row, other: &Row) -> bool {
    let pairs = MEASURES.map(|measure| (number(row, measure).unwrap(), number(other, measure).unwrap()));
    pairs.iter().all(|(own, other)| other <= own) && pairs.iter().any(|(own, other)| *other < 0.99 * own)
}

#[test]
fn the_bunnys_own_settings_are_on_the_measured_front() {
    let bunny = Graph::read(&repository().join("graphs/bunny.ron")).unwrap();
    let set = |input: &str, default: &str| {
        let (node, field) = input.split_once('.').unwrap();
        bunny.nodes.get(node).unwrap().fields.get(field).map_or_else(|| default.to_owned(), ToString::to_string)
    };
    // The defaults of inputs that the graph does not say.
    let images = [("shells.layers", "16"), ("shells.resolution", "128"), ("shells.spacing", "Even")];
    let drawn = [("picture.lighting", "Vertices"), ("picture.samples", "4"), ("picture.depth", "Written"), ("picture.fins_on", "Faded")];
    for (sweep, inputs) in [("bunny", &images[..]), ("bunny-picture", &drawn[..])] {
        let own: Vec<(&str, String)> = inputs.iter().map(|(input, default)| (*input, set(input, default))).collect();
        let rows = Figures::of(sweep).unwrap().0;
        let row = rows.iter().find(|row| own.iter().all(|(input, value)| row[*input] == *value));
        let row = row.unwrap_or_else(|| panic!("{own:?} are not among the settings measured: add them to graphs/sweeps/{sweep}.ron"));
        let beaten: Vec<&Row> = rows.iter().filter(|other| is_beaten(row, other)).collect();
        assert!(beaten.is_empty(), "{row:?} is beaten by {beaten:?}");
        assert!(rows.iter().any(|row| rows.iter().any(|other| is_beaten(row, other))), "{sweep}: the front leaves nothing out");
    }
}
