//! `pelage gallery`: a picture for each graph, one from near where there is a close-up, a sheet of them all, and messages before anything is drawn.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::process::Command;

/// A bald ball, drawn small: quick. With a picture from near, or without.
fn graph(title: &str, close: bool) -> String {
    let close = if close {
        r#", "near": Camera(margin: 0.3), "close": RenderImage(fur: "coat.fur", camera: "near.camera", light: "light.light", shading: "shading.shading", size: (32, 32))"#
    } else {
        ""
    };
    format!(
        r#"Graph(version: 1, {title} output: "picture.image", nodes: {{
        "ball": Sphere(subdivisions: 3), "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3), "shells": PatternShells(layers: 4, resolution: 16, cells: 16),
        "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", shells: "shells.shells", length: 0.05),
        "camera": Camera(), "light": Light(), "shading": HairLighting(),
        "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (60, 30)){close} }})"#
    )
}

fn gallery(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_pelage")).arg("gallery").args(arguments).current_dir(folder).output().unwrap();
    (output.status.code().unwrap(), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn size(path: &Path) -> (u32, u32) {
    image::image_dimensions(path).unwrap()
}

#[test]
fn every_graph_of_a_folder_is_on_the_sheet() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("graphs")).unwrap();
    std::fs::write(at("graphs/b.ron"), graph(r#"title: "A | ball","#, true)).unwrap();
    std::fs::write(at("graphs/a.ron"), graph("", false)).unwrap();
    std::fs::write(at("graphs/notes.txt"), "no graph").unwrap();
    let (code, error) = gallery(folder.path(), &["graphs", "--size", "20x20", "--across", "2", "-q", "-o", "out"]);
    assert_eq!(code, 0, "{error}");
    let mut names: Vec<String> =
        std::fs::read_dir(at("out")).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["a.png", "b-close.png", "b.png", "index.md", "sheet.png"]);
    assert_eq!((size(&at("out/a.png")), size(&at("out/b-close.png"))), ((60, 30), (32, 32)));
    // Two in a row, with a gap: 20 wide and as high as the highest, that from near.
    assert_eq!(size(&at("out/sheet.png")), (44, 44));
    let index = std::fs::read_to_string(at("out/index.md")).unwrap();
    assert!(
        index.contains("| [a](a.png) | a |\n| [b](b.png) | A \\| ball |\n| [b-close](b-close.png) | A \\| ball, from near |"),
        "{index}"
    );
    // The pictures are those that are drawn alone.
    let alone = Command::new(env!("CARGO_BIN_EXE_pelage"))
        .args(["render", "graphs/a.ron", "-q", "-o", "a.png"])
        .current_dir(folder.path())
        .status()
        .unwrap();
    assert!(alone.success() && std::fs::read(at("a.png")).unwrap() == std::fs::read(at("out/a.png")).unwrap());
}

#[test]
fn what_cannot_be_shown_is_said_and_nothing_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir_all(at("empty")).unwrap();
    std::fs::create_dir_all(at("other")).unwrap();
    std::fs::write(at("fine.ron"), graph("", false)).unwrap();
    std::fs::write(at("other/fine.ron"), graph("", false)).unwrap();
    std::fs::write(at("wrong.ron"), graph("", false).replace("layers: 4", "layers: 0")).unwrap();
    std::fs::write(at("aimless.ron"), graph("", false).replace(r#"output: "picture.image","#, "")).unwrap();
    std::fs::write(at("coat.ron"), graph("", false).replace("picture.image", "coat.fur")).unwrap();
    for (arguments, code, expected) in [
        (&[][..], 2, "GRAPH.ron"),
        (&["empty"], 1, "no graph"),
        (&["fine.ron", "wrong.ron"], 1, "wrong.ron"),
        (&["fine.ron", "none.ron"], 1, "none.ron"),
        (&["fine.ron", "other/fine.ron"], 1, "two pictures would be fine.png"),
        (&["fine.ron", "aimless.ron"], 1, "names no output"),
        (&["coat.ron"], 1, "Coat, not Picture"),
        (&["fine.ron", "--size", "20"], 2, "WIDTHxHEIGHT"),
    ] {
        let (actual, error) = gallery(folder.path(), &[arguments, &["-q", "-o", "out"]].concat());
        assert!(actual == code && error.contains(expected), "{arguments:?}: {actual}: no {expected:?} in {error}");
        assert!(!at("out").exists());
    }
    let (code, error) = gallery(folder.path(), &["fine.ron", "-q", "-o", "wrong.ron"]);
    assert!(code == 2 && error.contains("name a folder"), "{error}");
}
