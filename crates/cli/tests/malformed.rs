//! Malformed graphs, one fault each: `check` and `render` end with 1 and say where and what, and nothing is written.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::process::Command;

/// Nodes of a picture that is quick to make, on one line.
const SOUND: &str = r#""ball": Sphere(subdivisions: 4), "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3), "hair": GrowStrands(count: 60, undercoat: (count: 60), steps: 8), "shells": SampleShells(strands: "hair.strands", layers: 6, resolution: 32), "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells", length: 0.06), "camera": Camera(), "light": Light(), "shading": HairLighting(), "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (48, 40)),"#;

/// A file with `nodes` on its third line.
fn file(nodes: &str) -> String {
    format!("Graph(version: 1, output: \"picture.image\", nodes: {{\n{SOUND}\n{nodes}\n}})")
}

/// Whole files.
const FILES: &[(&str, &str)] = &[
    ("", "1:1: unexpected end of RON"),
    ("Graph(version: 1, nodes: {\n\"ball\": Sphere(\n", "2:16: unexpected end of RON"),
    ("Graph(version: 1, nodes: {\n\"ball\": Sphere() \"hair\": GrowStrands()})", "2:18: expected comma"),
    ("Graph(version: 1, nodes: {}) Graph()", "1:30: non-whitespace trailing characters"),
    ("{\"nodes\": {}}", "1:1: expected Graph(version: 1, nodes: {…}), found a map of 1"),
    ("Coat(version: 1, nodes: {})", "1:1: expected Graph(version: 1, nodes: {…}), found Coat(…)"),
    ("Graph(nodes: {\"ball\": Sphere()})", "1:1: missing \"version\": expected a whole number such as 1"),
    (
        "Graph(version: 2, nodes: {\"ball\": Sphere()})",
        "1:16: the file is of version 2, this program reads versions up to 1; open it with a newer program",
    ),
    ("Graph(version: \"one\", nodes: {\"ball\": Sphere()})", "1:16: expected a version, a whole number, found the text \"one\""),
    (
        "Graph(version: 0, output: (\"ball\", \"mesh\"), nodes: {\n\"ball\": (kind: \"Sphere\", params: (subdivision: 3))})",
        "2:35: node \"ball\": Sphere has no field \"subdivision\"; did you mean subdivisions?",
    ),
    ("Graph(version: 1)", "1:1: missing \"nodes\": expected a map of nodes by id"),
    ("Graph(version: 1, nodes: [Sphere()])", "1:26: nodes: expected a map of nodes by id, {\"id\": Kind(…)}, found a list of 1"),
    (
        "Graph(version: 1, output: \"ball.mesh\", nodes: {\"ball\": Sphere()}, seed: 3)",
        "1:67: Graph has no field \"seed\"; expected one of version, title, about, nodes, output, layout",
    ),
    ("Graph(version: 1, output: \"bal.mesh\", nodes: {\"ball\": Sphere()})", "1:27: output: there is no node \"bal\"; did you mean ball?"),
    (
        "Graph(version: 1, output: \"ball.mesch\", nodes: {\"ball\": Sphere()})",
        "1:27: output: Sphere \"ball\" has no output \"mesch\"; did you mean mesh?",
    ),
    (
        "Graph(version: 1, output: \"ball.mesh\", nodes: {\"ball\": Sphere()}, layout: {\"ring\": (0, 0)})",
        "1:76: layout: there is no node \"ring\"",
    ),
];

/// Nodes on the third line.
const NODES: &[(&str, &str)] = &[
    ("\"x\": Spher()", "3:6: node \"x\": unknown kind of node Spher; did you mean Sphere?"),
    ("\"x\": Teapot()", "3:6: node \"x\": unknown kind of node Teapot"),
    ("\"x\": \"Sphere\"", "3:6: node \"x\": expected a node, Kind(field: value), found the text \"Sphere\""),
    ("\"x.y\": Sphere()", "3:1: the id \"x.y\" cannot be used: ids are made of letters, digits, '_' and '-'"),
    ("\"ball\": Torus()", "3:1: node \"ball\": there is a node \"ball\" already; rename one of them"),
    ("x: Sphere()", "3:1: nodes: expected an id in quotes, found the word x"),
    ("\"x\": Sphere(subdivision: 3)", "3:13: node \"x\": Sphere has no field \"subdivision\"; did you mean subdivisions?"),
    ("\"x\": Sphere(radius: 3)", "3:13: node \"x\": Sphere has no field \"radius\"; expected one of subdivisions"),
    ("\"x\": Sphere(subdivisions: 3, subdivisions: 4)", "3:30: node \"x\": the field \"subdivisions\" is given twice; remove one"),
    ("\"x\": Sphere(subdivisions: 0)", "3:27: node \"x\", subdivisions: 0 is out of range: expected 1 to 600 (parts)"),
    ("\"x\": Sphere(subdivisions: 601)", "3:27: node \"x\", subdivisions: 601 is out of range: expected 1 to 600 (parts)"),
    ("\"x\": Sphere(subdivisions: 2.5)", "3:27: node \"x\", subdivisions: expected a whole number, found the number 2.5"),
    (
        "\"x\": Sphere(subdivisions: \"many\")",
        "3:27: node \"x\", subdivisions: expected a whole number, or a link \"node.port\" to one, found the text \"many\"",
    ),
    ("\"x\": Torus(tube: NaN)", "3:18: node \"x\", tube: expected a finite number, found NaN"),
    ("\"x\": Torus(tube: -inf)", "3:18: node \"x\", tube: expected a finite number, found -inf"),
    ("\"x\": Torus(tube: 1e400)", "3:18: node \"x\", tube: expected a finite number, found inf"),
    ("\"x\": Torus(cells: 64)", "3:19: node \"x\", cells: expected (a whole number, a whole number), found the whole number 64"),
    ("\"x\": Torus(cells: (64, 2))", "3:24: node \"x\", cells: 2 is out of range: expected 3 to 2048 (cells)"),
    ("\"x\": Torus(cells: (64, 28, 3))", "3:19: node \"x\", cells: expected (a whole number, a whole number), found a tuple of 3"),
    ("\"x\": ObjFile()", "3:6: node \"x\": missing \"path\": expected a file path in quotes"),
    ("\"x\": ObjFile(path: 3)", "3:20: node \"x\", path: expected a file path in quotes, found the whole number 3"),
    (
        "\"x\": ObjFile(path: Link(\"ball.mesh\"))",
        "3:20: node \"x\", path: expected a file path in quotes, or a link \"node.port\" to one, but \"ball.mesh\" is Mesh",
    ),
    ("\"x\": GrowPatches()", "3:6: node \"x\": missing \"mesh\": expected a link \"node.port\" to Mesh"),
    ("\"x\": GrowPatches(mesh: 3)", "3:24: node \"x\", mesh: expected a link \"node.port\" to Mesh, found the whole number 3"),
    ("\"x\": GrowPatches(mesh: \"ball\")", "3:24: node \"x\", mesh: expected a link \"node.port\" to Mesh, found the text \"ball\""),
    ("\"x\": GrowPatches(mesh: \"bal.mesh\")", "3:24: node \"x\", mesh: there is no node \"bal\"; did you mean ball?"),
    ("\"x\": GrowPatches(mesh: \"ball.skin\")", "3:24: node \"x\", mesh: Sphere \"ball\" has no output \"skin\"; expected one of mesh"),
    (
        "\"x\": GrowPatches(mesh: \"hair.strands\")",
        "3:24: node \"x\", mesh: expected a link \"node.port\" to Mesh, but \"hair.strands\" is StrandTile",
    ),
    (
        "\"x\": GrowPatches(mesh: \"ball.mesh\", directions: \"ball.mesh\")",
        "3:49: node \"x\", directions: expected a link \"node.port\" to DirectionField, but \"ball.mesh\" is Mesh",
    ),
    (
        "\"x\": GrowPatches(mesh: \"ball.mesh\", tile_size: \"camera.camera\")",
        "3:48: node \"x\", tile_size: expected a number, or a link \"node.port\" to one, but \"camera.camera\" is Framing",
    ),
    (
        "\"x\": GrowPatches(mesh: \"ball.mesh\", max_turning: 91)",
        "3:50: node \"x\", max_turning: 91 is out of range: expected 1 to 90 (degrees)",
    ),
    (
        "\"x\": GrowPatches(mesh: \"ball.mesh\", seed: -1)",
        "3:43: node \"x\", seed: -1 is out of range: expected 0 to 18446744073709551615 (seed)",
    ),
    ("\"x\": GrowStrands(style: Curley(radius: 0.1))", "3:25: node \"x\", style: HairStyle has no variant Curley; did you mean Curly?"),
    ("\"x\": GrowStrands(style: Curly(raduis: 0.1))", "3:31: node \"x\", style: Curly has no field \"raduis\"; did you mean radius?"),
    ("\"x\": GrowStrands(style: Curly(radius: 9))", "3:39: node \"x\", style.radius: 9 is out of range: expected 0 to 1 (heights)"),
    (
        "\"x\": GrowStrands(style: 3)",
        "3:25: node \"x\", style: expected one of Straight, Wavy, Curly, Zigzag, Woolly, found the whole number 3",
    ),
    (
        "\"x\": GrowStrands(undercoat: (count: \"many\"))",
        "3:37: node \"x\", undercoat.count: expected a whole number, found the text \"many\"",
    ),
    ("\"x\": GrowStrands(root_colour: (1, 2, 0))", "3:35: node \"x\", root_colour: 2 is out of range: expected 0 to 1"),
    (
        "\"x\": GrowStrands(root_colour: \"red\")",
        "3:31: node \"x\", root_colour: expected a colour (red, green, blue), or a link \"node.port\" to one, found the text \"red\"",
    ),
    (
        "\"x\": DirectionField(mesh: \"ball.mesh\", toward: (0, 1))",
        "3:48: node \"x\", toward: expected (a number, a number, a number), found a tuple of 2",
    ),
    (
        "\"x\": DirectionField(mesh: \"ball.mesh\", constraints: (0, 1))",
        "3:53: node \"x\", constraints: expected a list, each (at: …, along: …), found a tuple of 2",
    ),
    (
        "\"x\": RenderImage(fur: \"coat.fur\", camera: \"camera.camera\", light: \"light.light\", shading: \"shading.shading\", surface: 1)",
        "3:119: node \"x\", surface: expected true or false, found the whole number 1",
    ),
    (
        "\"x\": RenderImage(fur: \"coat.fur\", camera: \"camera.camera\", light: \"light.light\", shading: \"shading.shading\", depth: Writen)",
        "3:117: node \"x\", depth: DepthMode has no variant Writen; did you mean Written?",
    ),
    (
        "\"x\": SampleShells(strands: \"shells.shells\")",
        "3:28: node \"x\", strands: expected a link \"node.port\" to StrandTile, but \"shells.shells\" is ShellTexture",
    ),
    (
        "\"x\": SampleShells(strands: [\"hair.strands\", \"hair.strands\"])",
        "3:28: node \"x\", strands: expected a link \"node.port\" to StrandTile, found a list of 2",
    ),
    (
        "\"x\": ScalarRamp(mesh: \"ball.mesh\", from: \"ball.mesh\")",
        "3:42: node \"x\", from: expected a number, or a link \"node.port\" to one, but \"ball.mesh\" is Mesh",
    ),
];

/// What `pelage` says of each file, after the file's name, and with which code it ends.
fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_pelage")).args(arguments).current_dir(folder).output().unwrap();
    assert!(output.stdout.is_empty(), "{arguments:?}");
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// What is wrong with how the program answers a malformed file.
fn wrong(text: &str, expected: &str) -> Option<String> {
    let folder = tempfile::tempdir().unwrap();
    let (graph, picture, stats) = (folder.path().join("graph.ron"), folder.path().join("out.png"), folder.path().join("stats.json"));
    std::fs::write(&graph, text).unwrap();
    std::fs::write(&picture, "as before").unwrap();
    std::fs::write(&stats, "as before").unwrap();
    let expected = (Some(1), format!("error: graph.ron:{expected}\n"));
    for arguments in [&["check", "graph.ron"][..], &["render", "graph.ron", "-o", "out.png", "--stats", "stats.json"]] {
        let found = said(folder.path(), arguments);
        if found != expected {
            return Some(format!("{text}\n  {}: expected {expected:?}\n  found    {found:?}", arguments[0]));
        }
    }
    let as_before = [(graph, text), (picture, "as before"), (stats, "as before")]
        .iter()
        .all(|(path, text)| std::fs::read_to_string(path).unwrap() == *text);
    let files = std::fs::read_dir(folder.path()).unwrap().count();
    (!as_before || files != 3).then(|| format!("{text}\n  something was written"))
}

#[test]
fn each_is_answered_with_place_and_cause_and_nothing_is_written() {
    let whole = FILES.iter().map(|(text, said)| ((*text).to_owned(), *said));
    let all: Vec<(String, &str)> = whole.chain(NODES.iter().map(|(nodes, said)| (file(nodes), *said))).collect();
    assert!(all.len() >= 40);
    // Four at a time: a program that begins waits more than it works.
    let wrong: Vec<String> = std::thread::scope(|scope| {
        let quarter = |part: usize| {
            let all = &all;
            scope.spawn(move || all.iter().skip(part).step_by(4).filter_map(|(text, said)| wrong(text, said)).collect::<Vec<_>>())
        };
        let quarters = [0, 1, 2, 3].map(quarter);
        quarters.into_iter().flat_map(|quarter| quarter.join().unwrap()).collect()
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_file_that_they_are_made_of_is_sound() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("graph.ron"), file("\"x\": Torus()")).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_pelage")).args(["check", "graph.ron"]).current_dir(folder.path()).output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stdout).as_ref()), (Some(0), "1 graph, no faults\n"));
}

/// Of the file and of the command line, of files that are missing, and of several graphs.
#[test]
fn all_faults_come_at_once() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("one.ron"),
        file("\"x\": ObjFile(path: \"none.obj\"),\n\"y\": Spher(),\n\"z\": ObjFile(path: \"gone.obj\")"),
    )
    .unwrap();
    std::fs::write(folder.path().join("two.ron"), file("\"x\": Sphere(subdivisions: 0)")).unwrap();
    std::fs::write(folder.path().join("three.ron"), "Graph(").unwrap();
    let (code, message) = said(folder.path(), &["check", "one.ron", "two.ron", "three.ron", "four.ron"]);
    let begins = [
        "error: one.ron:3:20: node \"x\", path: cannot read none.obj",
        "one.ron:4:6: node \"y\": unknown kind",
        "one.ron:5:20: node \"z\", path: cannot read gone.obj",
        "two.ron:3:27: node \"x\", subdivisions: 0 is out of range",
        "three.ron:1:6: ",
        "four.ron: ",
    ];
    assert_eq!((code, message.lines().count()), (Some(1), begins.len()), "{message}");
    for (line, begin) in message.lines().zip(begins) {
        assert!(line.starts_with(begin), "{line}\n{begin}");
    }
    // Rendering answers with as much: an unknown kind hides no missing file.
    let (code, message) = said(folder.path(), &["render", "one.ron", "-o", "out.png"]);
    assert_eq!((code, message.lines().count()), (Some(1), 3), "{message}");
    let settings = ["--set", "ball.subdivisions=0", "--set", "camra.azimuth=3", "--set", "hair.style=Curley"];
    let (code, message) = said(folder.path(), &[&["render", "two.ron", "-o", "out.png"], &settings[..]].concat());
    let begins = ["error: --set ball.subdivisions=0: ", "--set camra.azimuth=3: ", "--set hair.style=Curley: ", "two.ron:3:27: "];
    assert_eq!((code, message.lines().count()), (Some(1), begins.len()), "{message}");
    for (line, begin) in message.lines().zip(begins) {
        assert!(line.starts_with(begin), "{line}\n{begin}");
    }
    // Nodes that fail while they run, both of them.
    let faults = r#"Graph(version: 1, output: "picture.image", nodes: {
        "ball": Sphere(subdivisions: 4), "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3), "hair": GrowStrands(count: 60),
        "model": ObjFile(path: "wrong.obj"), "shells": SampleShells(strands: "hair.strands", resolution: 33),
        "coat": LayFur(mesh: "model.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells"),
        "camera": Camera(), "light": Light(), "shading": HairLighting(),
        "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading"),
    })"#;
    std::fs::write(folder.path().join("run.ron"), faults).unwrap();
    std::fs::write(folder.path().join("wrong.obj"), "f 1 2 3").unwrap();
    let (code, message) = said(folder.path(), &["render", "run.ron", "-o", "out.png", "--output", "coat.fur"]);
    assert_eq!((code, message.lines().count()), (Some(1), 2), "{message}");
    assert!(message.contains("\"model\" (ObjFile)") && message.contains("\"shells\" (SampleShells)"), "{message}");
    assert!(!folder.path().join("out.png").exists());
}
