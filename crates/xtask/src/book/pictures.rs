//! The book's pictures, each from a saved graph, so that `cargo book pictures` makes them all anew.

use std::fs;

use crate::failure::{Failure, Result};
use crate::place::Place;
use crate::process::CommandLine;
use crate::vulkan;

/// How a picture of the book is made.
struct Picture {
    /// Its file in `book/src/pictures`.
    file: &'static str,
    /// The saved graph, from the root.
    graph: &'static str,
    /// What is set in it: `NODE.INPUT=VALUE` each.
    set: &'static [&'static str],
    /// Its size in pixels, `WxH`; empty: the graph's own.
    size: &'static str,
}

const BUNNY: &str = "graphs/bunny.ron";
const HALF: &str = "480x360";

/// Every picture of the book, and of the README.
const PICTURES: &[Picture] = &[
    Picture { file: "bunny.png", graph: BUNNY, set: &[], size: "960x720" },
    Picture { file: "surface.png", graph: BUNNY, set: &["picture.shells=false", "picture.fins=false"], size: HALF },
    Picture { file: "fins.png", graph: BUNNY, set: &["picture.shells=false"], size: HALF },
    Picture { file: "shells.png", graph: BUNNY, set: &["picture.fins=false"], size: HALF },
    Picture { file: "eight-shells.png", graph: BUNNY, set: &["shells.layers=8"], size: HALF },
    Picture { file: "upright.png", graph: BUNNY, set: &["coat.slant=0.0"], size: HALF },
    Picture { file: "long.png", graph: BUNNY, set: &["coat.length=0.07"], size: HALF },
    Picture { file: "close.png", graph: BUNNY, set: &["camera.margin=0.25"], size: HALF },
    Picture { file: "far.png", graph: BUNNY, set: &["camera.margin=4.0"], size: HALF },
    Picture { file: "no-step-blur.png", graph: BUNNY, set: &["camera.margin=0.25", "picture.step_blur=0.0"], size: HALF },
    Picture { file: "backlit.png", graph: BUNNY, set: &["light.azimuth=140.0"], size: HALF },
    Picture { file: "no-facing.png", graph: BUNNY, set: &["light.azimuth=140.0", "shading.facing=0.0"], size: HALF },
    Picture { file: "deep-shadow.png", graph: BUNNY, set: &["shading.shadow=3.0"], size: HALF },
    Picture { file: "isotropic.png", graph: BUNNY, set: &["patches.alignment=0.0"], size: HALF },
    Picture { file: "no-shadow.png", graph: BUNNY, set: &["shading.shadow=0.0"], size: HALF },
    Picture { file: "sparse.png", graph: BUNNY, set: &["hair.count=150", "hair.undercoat=(count: 0)"], size: HALF },
    Picture { file: "straight.png", graph: BUNNY, set: &["hair.style=Straight"], size: HALF },
    Picture { file: "meadow.png", graph: "graphs/meadow.ron", set: &[], size: HALF },
    Picture { file: "ring.png", graph: "graphs/ring.ron", set: &[], size: HALF },
    Picture { file: "ball.png", graph: "graphs/ball.ron", set: &[], size: HALF },
    Picture { file: "die.png", graph: "graphs/die.ron", set: &[], size: HALF },
    Picture { file: "levels.png", graph: "graphs/levels.ron", set: &[], size: "" },
    Picture { file: "shadows.png", graph: "graphs/shadows.ron", set: &[], size: HALF },
    Picture { file: "shadows-off.png", graph: "graphs/shadows.ron", set: &["picture.shadows=false"], size: HALF },
    Picture { file: "marched.png", graph: "graphs/marched.ron", set: &[], size: HALF },
    Picture { file: "drawn.png", graph: "graphs/drawn.ron", set: &[], size: HALF },
    Picture { file: "shorn.png", graph: "graphs/shorn.ron", set: &[], size: HALF },
    Picture { file: "shared.png", graph: "graphs/shared.ron", set: &[], size: HALF },
    Picture { file: "one-layer.png", graph: "graphs/straight.ron", set: &[], size: HALF },
    Picture { file: "blocks.png", graph: "graphs/blocks.ron", set: &[], size: HALF },
    Picture { file: "fins-all.png", graph: "graphs/figure4.ron", set: &["picture.shells=false", "picture.fins_on=All"], size: HALF },
    Picture { file: "by-patch.png", graph: "graphs/blocks.ron", set: &["picture.lighting=Patches"], size: HALF },
    Picture { file: "truth.png", graph: "graphs/truth.ron", set: &["truth.samples=64"], size: "" },
    Picture {
        file: "truth-close.png",
        graph: "graphs/truth.ron",
        set: &["truth.samples=64", "camera.margin=0.2", "shells.resolution=512", "shells.layers=128", "picture.step_blur=0.0"],
        size: "",
    },
    Picture { file: "truth-rays.png", graph: "graphs/truth.ron", set: &["truth.samples=64", "truth.shadows=Rays"], size: "" },
    Picture { file: "truth-free.png", graph: "graphs/truth.ron", set: &["truth.samples=64", "truth.placement=Free"], size: "" },
    Picture { file: "fox.png", graph: "graphs/fox.ron", set: &[], size: HALF },
    Picture { file: "cat.png", graph: "graphs/cat.ron", set: &[], size: HALF },
    Picture { file: "bear.png", graph: "graphs/bear.ron", set: &[], size: HALF },
];

const FOLDER: &str = "book/src/pictures";

/// Draws every picture anew, with the release build of the program.
pub(crate) fn draw(place: &Place) -> Result<()> {
    vulkan::make_sure()?;
    let folder = place.at(FOLDER);
    fs::create_dir_all(&folder).map_err(|cause| Failure::caused(folder.display(), cause))?;
    PICTURES.iter().try_for_each(|picture| {
        println!("{FOLDER}/{}", picture.file);
        command(place, picture).run()
    })
}

fn command(place: &Place, picture: &Picture) -> CommandLine {
    let set = picture.set.iter().flat_map(|value| ["--set", value]);
    let size = [["--size", picture.size]].into_iter().filter(|_| !picture.size.is_empty()).flatten();
    CommandLine::cargo()
        .with(["run", "--quiet", "--release", "--package", "pelage-cli", "--", "render", picture.graph])
        .with(size)
        .with(set)
        .with(["-o".into(), place.at(FOLDER).join(picture.file)])
        .within(place.root())
}

/// A line for each picture of the table that is not there.
pub(crate) fn faults(place: &Place) -> Vec<String> {
    missing(PICTURES, |file| place.at(FOLDER).join(file).is_file())
}

fn missing(pictures: &[Picture], exists: impl Fn(&str) -> bool) -> Vec<String> {
    let absent = pictures.iter().filter(|picture| !exists(picture.file));
    absent.map(|picture| format!("{FOLDER}/{} is not there: draw it with `cargo book pictures`", picture.file)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn the_table_names_each_file_once() {
        let files: BTreeSet<&str> = PICTURES.iter().map(|picture| picture.file).collect();
        assert_eq!(files.len(), PICTURES.len());
        let sizes = PICTURES.iter().map(|picture| picture.size).filter(|size| !size.is_empty());
        assert!(sizes.flat_map(|size| size.split('x')).all(|side| side.parse::<u32>().is_ok_and(|side| side > 0)));
    }

    #[test]
    fn a_picture_is_drawn_by_the_program() {
        let picture = Picture { file: "x.png", graph: "graphs/x.ron", set: &["hair.seed=7", "coat.length=0.1"], size: "64x48" };
        let line = command(&Place::find().unwrap(), &picture).to_string();
        assert!(line.contains("render graphs/x.ron --size 64x48 --set hair.seed=7 --set coat.length=0.1 -o "), "{line}");
        assert!(line.contains("x.png"), "{line}");
    }

    #[test]
    fn a_missing_picture_is_told() {
        assert_eq!(missing(PICTURES, |_| false).len(), PICTURES.len());
        assert_eq!(missing(PICTURES, |_| true), Vec::<String>::new());
    }
}
