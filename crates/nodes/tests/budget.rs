//! A budget: which row of a measured table it draws by, what is wrong with a table, and that a picture does as it is told.
#![cfg(feature = "gpu")]
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

use std::path::Path;
use std::sync::Arc;

use pelage_graph::{Graph, Request};
use pelage_nodes::{FrameReport, LightingAt, Picture, Quality, ShellDetail, TableAxis, TableRow};

/// Two distances; the further away, the less a coarse level errs. What does not matter may be empty.
const TABLE: &str = "\
camera.margin,picture.detail,picture.fins,shells,fragments,flip_mean,ms_min,front_fragments
1.0,Spacing(pixels: 2.0),false,,100,0.30,9.0,1
1.0,Spacing(pixels: 0.5),false,,200,0.10,3.0,1
1.0,Spacing(pixels: 0.0),true,,400,0.02,4.0,1
2.3,Spacing(pixels: 2.0),false,,50,0.04,2.0,1
2.3,Spacing(pixels: 0.5),false,,60,0.03,1.0,1
2.3,Spacing(pixels: 0.0),true,,80,0.00,1.5,1
";

/// What a budget with this limit says at a distance, or why there is none.
fn decided(table: &str, limit: &str, margin: &str) -> Result<Quality, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("table.csv"), table).unwrap();
    let nodes =
        format!(r#""camera": Camera(margin: {margin}), "budget": Budget(camera: "camera.camera", table: "table.csv", limit: {limit})"#);
    let graph = Graph::parse(&format!("Graph(version: 1, nodes: {{{nodes}}})")).unwrap().with_directory(folder.path());
    let graph = graph.check(&pelage_nodes::registry()).map_err(|faults| faults.to_string())?;
    let evaluation = pelage_nodes::evaluator(0).run(&graph, &Request::output("budget.quality"));
    let error = |error: pelage_graph::EvaluateError| error.to_string().replace(&format!("{}/", folder.path().display()), "");
    Ok(Quality::clone(&*evaluation.map_err(error)?.get::<Quality>("budget.quality").unwrap()))
}

/// Pixels between shells, by which the rows of the table are told apart.
fn spacing(limit: &str, margin: &str) -> f64 {
    match decided(TABLE, limit, margin).unwrap().detail {
        Some(ShellDetail::Spacing { pixels }) => pixels,
        other => unreachable!("{other:?}"),
    }
}

#[test]
fn it_is_the_cheapest_within_an_error_or_else_what_errs_least() {
    assert_eq!(spacing("MaxError(flip: 0.4, cost: Fragments)", "1.0"), 2.0);
    assert_eq!(spacing("MaxError(flip: 0.4)", "1.0"), 0.5, "by time the first row is dear");
    assert_eq!(spacing("MaxError(flip: 0.1)", "1.0"), 0.5, "the limit itself is within it");
    assert_eq!(spacing("MaxError(flip: 0.09)", "1.0"), 0.0);
    assert_eq!(spacing("MaxError(flip: 0.01)", "1.0"), 0.0, "none is within it");
    let fine = decided(TABLE, "MaxError(flip: 0.01)", "1.0").unwrap();
    let row = Some(TableRow { line: 4, margin: 1.0, cost: 4.0, error: 0.02, shells: None });
    assert_eq!(fine, Quality { detail: Some(ShellDetail::Spacing { pixels: 0.0 }), fins: Some(true), row, ..Quality::default() });
}

#[test]
fn it_is_what_errs_least_within_a_cost_or_else_the_cheapest() {
    assert_eq!(spacing("MaxFragments(fragments: 400)", "1.0"), 0.0);
    assert_eq!(spacing("MaxFragments(fragments: 399)", "1.0"), 0.5);
    assert_eq!(spacing("MaxFragments(fragments: 10)", "1.0"), 2.0, "none is within it");
    assert_eq!(spacing("MaxMs(ms: 3.5)", "1.0"), 0.5);
    assert_eq!(spacing("MaxMs(ms: 1.0)", "1.0"), 0.5, "none is within it, and this is the quickest");
}

#[test]
fn the_distance_that_counts_is_the_nearest_that_is_not_beyond_the_camera() {
    let within = "MaxError(flip: 0.05, cost: Fragments)";
    // At 1.0 only the finest errs so little, at 2.3 all do.
    assert_eq!(["0.5", "1.0", "2.2"].map(|margin| spacing(within, margin)), [0.0; 3]);
    assert_eq!(["2.3", "4.0", "1000.0"].map(|margin| spacing(within, margin)), [2.0; 3]);
}

#[test]
fn equals_are_taken_in_the_order_of_the_table() {
    let table = "camera.margin,a.march,fragments,flip_mean\n1,4,10,0.1\n1,2,10,0.1\n";
    for limit in ["MaxError(flip: 0.2, cost: Fragments)", "MaxError(flip: 0, cost: Fragments)", "MaxFragments(fragments: 20)"] {
        assert_eq!(decided(table, limit, "1.0").unwrap().march, Some(4), "{limit}");
    }
}

#[test]
fn values_are_read_as_a_graph_reads_them() {
    let table = "camera.margin,p.lighting,p.direction_map,p.march,p.march_steps,p.hair_shadow,p.anisotropy,p.detail,ms_min,flip_mean\n\
        1,\"Table(size: 16, diffuse_by: Cosine)\",false,2,3,0.5,4,Level(level: 1),1.5,0.1\n";
    let quality = decided(table, "MaxMs(ms: 9)", "1.0").unwrap();
    let lighting = LightingAt::Table { size: 16, diffuse_by: TableAxis::Cosine, specular_by: TableAxis::Cosine };
    let expected = Quality {
        detail: Some(ShellDetail::Level { level: 1.0 }),
        fins: None,
        lighting: Some(lighting),
        direction_map: Some(false),
        march: Some(2),
        march_steps: Some(3),
        hair_shadow: Some(0.5),
        anisotropy: Some(4),
        row: Some(TableRow { line: 2, margin: 1.0, cost: 1.5, error: 0.1, shells: None }),
    };
    assert_eq!(quality, expected);
}

#[test]
fn what_is_wrong_with_a_table_is_said_with_line_and_column() {
    let change = |from: &str, to: &str| TABLE.replacen(from, to, 1);
    let head = "camera.margin,picture.march,ms_min,flip_mean\n";
    for (table, expected) in [
        (change("0.5),false,,200", "0.5),false,,none"), "table.csv:3: column fragments: expected a number from 0 up, found \"none\""),
        (change("0.10", ""), "table.csv:3: column flip_mean: expected a number from 0 up, found \"\""),
        (change("0.10", "-0.10"), "table.csv:3: column flip_mean: expected a number from 0 up, found \"-0.10\""),
        (change("0.10", "inf"), "column flip_mean: expected a number from 0 up, found \"inf\""),
        (change("true", "maybe"), "table.csv:4: column picture.fins: expected true or false, found the word maybe"),
        (
            change("2.3,Spacing(pixels: 2.0)", "2.3,Spacing(pixels: 99.0)"),
            "table.csv:5: column picture.detail: 99.0 is out of range: expected 0 to 64 (pixels)",
        ),
        (change("1.0,Spacing", "0.0,Spacing"), "table.csv:2: column camera.margin: 0.0 is out of range"),
        (
            change("picture.detail", "shells.layers"),
            "table.csv:1: column shells.layers: a picture cannot choose this while it is drawn; vary the margin of a Camera and detail, fins, lighting",
        ),
        (
            change("picture.fins", "near.detail"),
            "table.csv:1: the columns picture.detail and near.detail are of one input: keep one of them",
        ),
        (change("picture.fins", "near.margin"), "table.csv:1: the columns camera.margin and near.margin are of one input"),
        (change("camera.margin", "distance"), "table.csv:1: there is no column camera.margin: vary the margin of the picture's Camera"),
        (change("flip_mean", "error"), "table.csv:1: there is no column flip_mean: write the table with `pelage measure`"),
        (change("fragments", "samples"), "table.csv:1: there is no column fragments"),
        (change("false,,200", "false,200"), "found record with 7 fields, but the previous record has 8 fields"),
        (change("200", "2\"00"), "2\\\"00"),
        (head.to_owned(), "table.csv: the table has no rows: measure one setting or more"),
        (String::new(), "table.csv:1: there is no column camera.margin"),
    ] {
        let error = decided(&table, "MaxFragments(fragments: 100)", "1.0").err();
        let by_time = || decided(&table, "MaxMs(ms: 1)", "1.0").err();
        let said = if table.starts_with(head) { by_time() } else { error };
        assert!(said.as_ref().is_some_and(|said| said.contains(expected)), "no {expected:?} in {said:?}");
    }
}

/// A picture of a little ball, with what its node is told; the table says that fins are drawn, and by levels of detail.
fn drawn(picture: &str) -> (Arc<Picture>, Arc<FrameReport>) {
    drawn_by("", picture).unwrap()
}

/// The same where the table says how many shells were drawn, or what is wrong.
fn drawn_by(shells: &str, picture: &str) -> Result<(Arc<Picture>, Arc<FrameReport>), String> {
    let folder = tempfile::tempdir().unwrap();
    let head = "camera.margin,picture.detail,picture.fins,picture.lighting,shells,ms_min,flip_mean";
    let table = format!("{head}\n0.9,Level(level: 1.0),true,Pixels,{shells},1,0\n");
    std::fs::write(folder.path().join("table.csv"), table).unwrap();
    let text = format!(
        r#"Graph(version: 1, output: "picture.image", nodes: {{
        "ball": Sphere(subdivisions: 3), "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3),
        "hair": GrowStrands(count: 40, undercoat: (count: 0), steps: 8), "sampled": SampleShells(strands: "hair.strands", layers: 8, resolution: 32, directions: true),
        "shells": LevelsOfDetail(shells: "sampled.shells"), "fin": SampleFin(strands: "hair.strands", size: (64, 16)),
        "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells", fin: "fin.fin", length: 0.08),
        "camera": Camera(margin: 0.9), "light": Light(), "shading": HairLighting(),
        "budget": Budget(camera: "camera.camera", table: "table.csv"),
        "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (48, 48), {picture}) }})"#
    );
    let graph = Graph::parse(&text).unwrap().with_directory(Path::new(folder.path())).check(&pelage_nodes::registry()).unwrap();
    let request = Request::output("picture.image").and_output("picture.frame");
    let evaluation = pelage_nodes::evaluator(0).run(&graph, &request).map_err(|error| error.to_string())?;
    Ok((evaluation.get("picture.image").unwrap(), evaluation.get("picture.frame").unwrap()))
}

/// Eight layers are seven shells beside the skin, and three at the next level.
#[test]
fn a_table_of_another_coat_is_refused() {
    let budgeted = "budget: \"budget.quality\"";
    assert!(drawn_by("3", budgeted).is_ok());
    let error = drawn_by("15", budgeted).unwrap_err();
    assert!(error.contains("table, line 2, is of 15 shells at this level of detail, and this coat has 3 there"), "{error}");
    // Where no shells are drawn there is nothing to compare.
    assert!(drawn_by("15", &format!("{budgeted}, shells: false")).is_ok());
}

/// What the node itself says would have left out fins, levels and the direction map before the coat was made.
#[test]
fn a_picture_does_as_its_budget_says_and_not_as_its_own_parameters_do() {
    let without = "fins: false, detail: Level(level: 0.0), lighting: Vertices";
    let (budgeted, frame) = drawn(&format!("{without}, budget: \"budget.quality\""));
    let (told, told_frame) = drawn("fins: true, detail: Level(level: 1.0), lighting: Pixels");
    assert!(budgeted.rgba == told.rgba && frame.stats.fins_drawn > 0 && frame.view == told_frame.view);
    let (itself, own_frame) = drawn(without);
    assert!(itself.rgba != told.rgba && own_frame.stats.fins_drawn == 0 && own_frame.stats.shells_drawn > frame.stats.shells_drawn);
}
