//! What a picture does not need is not made, the trace says so, and no pixel changes by it.

use pelage_coat::Coat;
use pelage_graph::{CheckedGraph, Evaluation, Graph, Request, State};
use pelage_nodes::{Curves, FrameReport, Picture, Stats};
use pelage_tests::Error;

/// A ball with every part that a coat can have, and skin that is bare at one end.
const BALL: &str = r#"Graph(version: 1, nodes: {
    "ball": Sphere(subdivisions: 4),
    "combed": DirectionField(mesh: "ball.mesh"),
    "patches": GrowPatches(mesh: "ball.mesh", directions: "combed.directions", tile_size: 0.3),
    "lengths": ScalarRamp(mesh: "ball.mesh", from: -0.2),
    "colours": ColourRamp(mesh: "ball.mesh"),
    "hair": GrowStrands(count: 60, undercoat: (count: 60), steps: 8, lean: 20.0),
    "sampled": SampleShells(strands: "hair.strands", layers: 7, resolution: 32, directions: true),
    "levels": LevelsOfDetail(shells: "sampled.shells"),
    "small": CompressShells(shells: "levels.shells", form: Texels),
    "fin": SampleFin(strands: "hair.strands", size: (64, 32)),
    "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "hair.strands", shells: "small.shells", fin: "fin.fin",
        directions: "combed.directions", lengths: "lengths.values", colours: "colours.colours", length: 0.1, slant: 20.0, bend: 0.5),
    "camera": Camera(elevation: 20.0), "light": Light(), "shading": HairLighting(),
    "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (48, 40)),
    "truth": ReferenceImage(fur: "coat.fur", strands: "hair.strands", camera: "camera.camera", light: "light.light", shading: "shading.shading",
        size: (24, 20), samples: 2),
    "curves": StrandCurves(fur: "coat.fur", strands: "hair.strands"),
})"#;

/// What is asked for, and what is not made for it.
struct Case {
    output: &'static str,
    set: &'static [(&'static str, &'static str)],
    /// Nodes behind the output that do not run.
    idle: &'static [&'static str],
    /// Outputs that are made in part, and what they are without.
    without: &'static [&'static str],
}

const FINEST: (&str, &str) = ("picture.detail", "Level(level: 0.0)");
const NO_SHELLS: (&str, &str) = ("picture.shells", "false");
const NO_FINS: (&str, &str) = ("picture.fins", "false");

const NO_DIRECTIONS: &[&str] =
    &["sampled without directions", "levels without directions", "small without directions", "coat without directions"];
const NO_LEVELS: &[&str] = &[
    "sampled without directions",
    "levels without levels, directions",
    "small without levels, directions",
    "coat without levels, directions",
];
/// Coarser levels come with the shells that they are made of.
const LEVELS_ALONE: &[&str] =
    &["sampled without directions", "levels without directions", "small without layers, directions", "coat without layers, directions"];
const SKIN_AND_FINS: &[&str] = &[
    "sampled without layers, directions",
    "levels without layers, levels, directions",
    "small without layers, levels, directions",
    "coat without layers, levels, directions",
];
const SKIN: &[&str] = &[
    "sampled without layers, directions",
    "levels without layers, levels, directions",
    "small without layers, levels, directions",
    "coat without layers, levels, directions, fins",
];
const NO_SHELL_TEXTURES: &[&str] = &["sampled", "levels", "small"];

const CASES: &[Case] = &[
    Case { output: "picture.image", set: &[], idle: &[], without: NO_DIRECTIONS },
    Case { output: "picture.image", set: &[("picture.lighting", "Pixels")], idle: &[], without: &[] },
    Case { output: "picture.image", set: &[("picture.lighting", "Table()")], idle: &[], without: &[] },
    Case {
        output: "picture.image",
        set: &[("picture.lighting", "Pixels"), ("picture.direction_map", "false")],
        idle: &[],
        without: NO_DIRECTIONS,
    },
    Case { output: "picture.image", set: &[("picture.lighting", "Pixels"), NO_SHELLS], idle: &[], without: LEVELS_ALONE },
    Case {
        output: "picture.image",
        set: &[NO_FINS],
        idle: &["fin"],
        without: &["sampled without directions", "levels without directions", "small without directions", "coat without directions, fins"],
    },
    // The skin shows the hair that a coarser level lays on it, and fins go with the last shell.
    Case { output: "picture.image", set: &[NO_SHELLS], idle: &[], without: LEVELS_ALONE },
    Case { output: "picture.image", set: &[("picture.detail", "Level(level: 1.4)"), NO_SHELLS], idle: &[], without: LEVELS_ALONE },
    // Where there are none, the skin alone is sampled.
    Case {
        output: "picture.image",
        set: &[NO_SHELLS, ("coat.shells", "sampled.shells")],
        idle: &[],
        without: &["sampled without layers, directions", "coat without layers, directions"],
    },
    Case { output: "picture.image", set: &[FINEST], idle: &[], without: NO_LEVELS },
    Case { output: "picture.image", set: &[("picture.detail", "Spacing(pixels: 0.0)")], idle: &[], without: NO_LEVELS },
    Case { output: "picture.image", set: &[("picture.march_steps", "2")], idle: &[], without: NO_LEVELS },
    // Levels round up how many layers a shell shows, and choose which shells cast shadows.
    Case { output: "picture.image", set: &[FINEST, ("picture.march", "2")], idle: &[], without: NO_LEVELS },
    Case { output: "picture.image", set: &[FINEST, ("picture.march", "3")], idle: &[], without: NO_DIRECTIONS },
    Case { output: "picture.image", set: &[FINEST, ("picture.shadows", "true")], idle: &[], without: NO_DIRECTIONS },
    // What is not drawn casts its shadow all the same.
    Case { output: "picture.image", set: &[FINEST, NO_SHELLS, ("picture.shadows", "true")], idle: &[], without: NO_DIRECTIONS },
    Case { output: "picture.image", set: &[FINEST, NO_SHELLS], idle: &[], without: SKIN_AND_FINS },
    Case { output: "picture.image", set: &[FINEST, ("picture.shell_count", "1")], idle: &[], without: SKIN_AND_FINS },
    Case { output: "picture.image", set: &[FINEST, NO_SHELLS, NO_FINS], idle: &["fin"], without: SKIN },
    Case {
        output: "picture.image",
        set: &[FINEST, ("picture.length_scale", "0.0"), ("picture.shadows", "true")],
        idle: &["fin"],
        without: SKIN,
    },
    Case {
        output: "picture.image",
        set: &[FINEST, NO_SHELLS, ("picture.surface", "false")],
        idle: NO_SHELL_TEXTURES,
        without: &["coat without skin, layers, levels, directions"],
    },
    // Cut hair ends over the distance between two shells, on fins too.
    Case {
        output: "picture.image",
        set: &[FINEST, NO_SHELLS, ("picture.surface", "false"), ("coat.lengths_as", "Cut")],
        idle: &[],
        without: &[
            "sampled without directions",
            "levels without levels, directions",
            "small without levels, directions",
            "coat without skin, levels, directions",
        ],
    },
    Case {
        output: "truth.image",
        set: &[],
        idle: &["sampled", "levels", "small", "fin"],
        without: &["coat without skin, layers, levels, directions, fins"],
    },
    Case {
        output: "truth.image",
        set: &[("truth.length_scale", "0.0")],
        idle: &["sampled", "levels", "small", "fin"],
        without: &["coat without skin, layers, levels, directions, fins"],
    },
    Case {
        output: "curves.curves",
        set: &[],
        idle: &["colours", "sampled", "levels", "small", "fin"],
        without: &["coat without skin, layers, levels, directions, fins, looks"],
    },
];

fn checked(set: &[(&str, &str)]) -> Result<CheckedGraph, Error> {
    let registry = pelage_nodes::registry();
    let mut graph = Graph::parse(BALL)?;
    for (input, value) in set {
        graph.set(&registry, input, value, ".".as_ref())?;
    }
    Ok(graph.check(&registry)?)
}

/// Nodes behind an output that did not run, and what the outputs of the others are without.
fn left_out(graph: &CheckedGraph, evaluation: &Evaluation, output: &str) -> (Vec<String>, Vec<String>) {
    let behind: Vec<_> = graph.behind(output).collect();
    let (mut idle, mut without) = (Vec::new(), Vec::new());
    for entry in evaluation.trace().iter().filter(|entry| behind.contains(&&entry.node)) {
        if entry.state == State::NotNeeded {
            idle.push(entry.node.to_string());
        }
        for parts in entry.parts.iter().filter(|parts| !parts.left_out.is_empty()) {
            let names: Vec<&str> = parts.left_out.iter().map(|part| part.name).collect();
            without.push(format!("{} without {}", entry.node, names.join(", ")));
        }
    }
    (idle, without)
}

/// Pixels, or all points of the curves.
fn bytes(evaluation: &Evaluation, output: &str) -> Result<Vec<u8>, Error> {
    if let Ok(curves) = evaluation.get::<Curves>(output) {
        return Ok(bytemuck::cast_slice(curves.0.concat().as_flattened()).to_vec());
    }
    let picture = evaluation.get::<Picture>(output)?;
    Ok([&picture.rgba[..], &picture.coverage].concat())
}

#[test]
fn what_is_switched_off_is_not_made_and_changes_no_pixel() -> Result<(), Error> {
    // Engines of their own: one would answer with the other's picture, as what it depends on is the same.
    let (mut sparing, mut lavish) = (pelage_nodes::evaluator(1 << 30), pelage_nodes::evaluator(1 << 30));
    let mut seen: Vec<Vec<u8>> = Vec::new();
    for Case { output, set, idle, without } in CASES {
        let graph = checked(set)?;
        let evaluation = sparing.run(&graph, &Request::output(output))?;
        let (really_idle, really_without) = left_out(&graph, &evaluation, output);
        assert_eq!((&really_idle[..], &really_without[..]), (&owned(idle)[..], &owned(without)[..]), "{output} {set:?}");
        // Asked for by itself, the coat has all its parts.
        let whole = lavish.run(&graph, &Request::output(output).and_output("coat.fur"))?;
        assert_eq!(left_out(&graph, &whole, output), (Vec::new(), Vec::new()), "{output} {set:?}");
        let picture = bytes(&evaluation, output)?;
        assert!(picture == bytes(&whole, output)?, "{output} {set:?}: another picture");
        seen.push(picture);
    }
    seen.sort();
    seen.dedup();
    assert!(seen.len() >= 15, "of {} pictures {} are alike", CASES.len(), CASES.len() - seen.len());
    Ok(())
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

#[test]
fn one_truth_serves_all_settings_of_the_textures() -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let both = Request::output("picture.image").and_output("truth.image");
    let state =
        |evaluation: &Evaluation, node: &str| evaluation.trace().iter().find(|entry| entry.node.as_str() == node).map(|entry| entry.state);
    let first = evaluator.run(&checked(&[])?, &both)?;
    assert_eq!((state(&first, "picture"), state(&first, "truth")), (Some(State::Computed), Some(State::Computed)));
    for set in [("sampled.layers", "3"), ("fin.slab_width", "0.3"), ("small.form", "Blocks"), ("sampled.skin_colour", "(0.1, 0.9, 0.2)")] {
        let next = evaluator.run(&checked(&[set])?, &Request::output("truth.image"))?;
        assert_eq!(state(&next, "truth"), Some(State::Hit), "{set:?}");
    }
    let next = evaluator.run(&checked(&[("sampled.layers", "3")])?, &both)?;
    assert_eq!((state(&next, "picture"), state(&next, "truth")), (Some(State::Computed), Some(State::Hit)));
    Ok(())
}

#[test]
fn figures_are_of_what_there_is() -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let mut figures = |set: &[(&str, &str)]| -> Result<Stats, Error> {
        let request = Request::output("picture.image").and_output("picture.frame").and_on_the_way("coat.fur").with_all_values();
        let evaluation = evaluator.run(&checked(set)?, &request)?;
        let mut stats = Stats::of(&evaluation);
        stats.insert_frame(&*evaluation.get::<FrameReport>("picture.frame")?);
        assert_eq!(evaluation.get::<Coat>("coat.fur")?.fin.is_none(), set.contains(&NO_FINS));
        Ok(stats)
    };
    // The items of a list, or the keys of an object, of which no order is promised.
    let names = |stats: &Stats, pointer: &str| -> Vec<String> {
        let Some(figure) = stats.figure(pointer) else { return Vec::new() };
        let mut keys: Vec<String> = figure.as_object().into_iter().flatten().map(|(key, _)| key.clone()).collect();
        keys.sort();
        let items = figure.as_array().into_iter().flatten().filter_map(|item| item.as_str());
        items.map(str::to_owned).chain(keys).collect()
    };
    let all = figures(&[("picture.repeat", "1")])?;
    assert_eq!(names(&all, "/nodes/coat/parts/fur/made"), ["skin", "layers", "levels", "fins", "looks"]);
    assert_eq!(names(&all, "/nodes/coat/parts/fur/left_out"), ["directions"]);
    assert!(all.figure("/nodes/hair/parts").is_none());
    let bald = figures(&[NO_SHELLS, NO_FINS, FINEST, ("picture.repeat", "1")])?;
    assert_eq!(names(&bald, "/nodes/coat/parts/fur/made"), ["skin", "looks"]);
    let number = |stats: &Stats, pointer: &str| stats.figure(pointer)?.as_u64();
    assert_eq!((number(&bald, "/textures/fin_bytes"), number(&bald, "/textures/layers")), (Some(0), Some(1)));
    // Where the device has timestamps, each pass is named that there is.
    if !names(&all, "/frame/pass_ms").is_empty() {
        assert_eq!(names(&all, "/frame/pass_ms"), ["compute", "fins", "shells", "surface"]);
        assert_eq!(names(&bald, "/frame/pass_ms"), ["surface"]);
    }
    assert_eq!(number(&bald, "/frame/fragments/shells"), Some(0));
    let nothing = figures(&[NO_SHELLS, NO_FINS, FINEST, ("picture.surface", "false")])?;
    assert!(nothing.figure("/textures").is_none());
    Ok(())
}
