//! The book's pictures, each from a saved graph or by an example of the workspace, so that `cargo book pictures` makes them all anew.

use std::fs;
use std::path::PathBuf;

use super::pages::pages_below;
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
const SMALL: &str = "300x225";
const FIGURE: &str = "graphs/figure4.ron";
const CURLS: &str = "graphs/shadows.ron";

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
    Picture { file: "budget.png", graph: "graphs/budget.ron", set: &[], size: "" },
    Picture { file: "levels.png", graph: "graphs/levels.ron", set: &[], size: "" },
    Picture { file: "shadows.png", graph: "graphs/shadows.ron", set: &[], size: HALF },
    Picture { file: "shadows-off.png", graph: "graphs/shadows.ron", set: &["picture.shadows=false"], size: HALF },
    Picture { file: "marched.png", graph: "graphs/marched.ron", set: &[], size: HALF },
    Picture { file: "drawn.png", graph: "graphs/drawn.ron", set: &[], size: HALF },
    Picture { file: "shorn.png", graph: "graphs/shorn.ron", set: &[], size: HALF },
    Picture { file: "shared.png", graph: "graphs/shared.ron", set: &[], size: HALF },
    Picture { file: "one-layer.png", graph: "graphs/straight.ron", set: &[], size: HALF },
    Picture { file: "blocks.png", graph: "graphs/blocks.ron", set: &[], size: HALF },
    Picture { file: "figure4-a.png", graph: FIGURE, set: &["picture.shells=false", "picture.fins=false"], size: SMALL },
    Picture { file: "figure4-b.png", graph: FIGURE, set: &["picture.shells=false"], size: SMALL },
    Picture { file: "figure4-c.png", graph: FIGURE, set: &["picture.fins=false"], size: SMALL },
    Picture { file: "figure4-d.png", graph: FIGURE, set: &[], size: SMALL },
    Picture { file: "fins-all.png", graph: FIGURE, set: &["picture.shells=false", "picture.fins_on=All"], size: SMALL },
    Picture { file: "figure4-g.png", graph: FIGURE, set: &["picture.detail=Level(level: 1.0)"], size: SMALL },
    Picture { file: "figure4-h.png", graph: FIGURE, set: &["coat.length=0.04"], size: SMALL },
    Picture { file: "figure4-i.png", graph: FIGURE, set: &["coat.slant=45.0"], size: SMALL },
    Picture { file: "figure4-j.png", graph: FIGURE, set: &["picture.detail=Level(level: 2.0)"], size: SMALL },
    Picture { file: "figure4-f.png", graph: FIGURE, set: &["coat.lapped=lapped.lapped"], size: SMALL },
    Picture {
        file: "figure4-k.png",
        graph: FIGURE,
        set: &["coat.directions=brushed.directions", "coat.slants=brushed.slants"],
        size: SMALL,
    },
    Picture { file: "figure4-l.png", graph: FIGURE, set: &["coat.directions=parted.directions", "coat.slants=parted.slants"], size: SMALL },
    Picture { file: "lapped.png", graph: "graphs/lapped.ron", set: &[], size: "" },
    Picture { file: "zima.png", graph: "graphs/zima.ron", set: &[], size: "" },
    Picture { file: "rabbit.png", graph: "graphs/rabbit.ron", set: &[], size: "" },
    Picture { file: "patterns.png", graph: "graphs/patterns.ron", set: &[], size: "" },
    Picture { file: "field.png", graph: "graphs/field.ron", set: &[], size: "" },
    Picture { file: "curls.png", graph: "graphs/curls.ron", set: &[], size: "" },
    Picture { file: "crowd.png", graph: "graphs/crowd.ron", set: &[], size: "" },
    Picture { file: "direction-map.png", graph: CURLS, set: &["camera.margin=0.35"], size: HALF },
    Picture { file: "no-direction-map.png", graph: CURLS, set: &["camera.margin=0.35", "picture.direction_map=false"], size: HALF },
    Picture { file: "types.png", graph: "graphs/types.ron", set: &[], size: "" },
    Picture { file: "varied.png", graph: "graphs/varied.ron", set: &[], size: "" },
    Picture { file: "guides.png", graph: "graphs/guides.ron", set: &[], size: "" },
    Picture { file: "spacing.png", graph: "graphs/spacing.ron", set: &[], size: "" },
    Picture { file: "guard.png", graph: "graphs/guard.ron", set: &[], size: HALF },
    Picture { file: "guard-own.png", graph: "graphs/guard.ron", set: &["fin.strands=down.strands"], size: HALF },
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
    Picture { file: "lion.png", graph: "graphs/lion.ron", set: &[], size: HALF },
    Picture { file: "combed.png", graph: "graphs/combed.ron", set: &[], size: HALF },
    Picture { file: "uncombed.png", graph: "graphs/combed.ron", set: &["combed.strokes=[]"], size: HALF },
    Picture { file: "bear.png", graph: "graphs/bear.ron", set: &[], size: HALF },
    Picture { file: "spots.png", graph: "graphs/spots.ron", set: &[], size: HALF },
    Picture { file: "strokes.png", graph: "graphs/strokes.ron", set: &[], size: HALF },
    Picture { file: "caterpillar.png", graph: "graphs/caterpillar.ron", set: &[], size: HALF },
];

/// Pictures that no graph makes: the file, and the example that draws it, which takes the file's path.
const EXAMPLES: &[(&str, [&str; 4])] = &[("submitted.png", ["--package", "pelage-tests", "--example", "submitted"])];

/// Pictures of the gallery that pages show: the file, and what the gallery calls it.
const GALLERY: &[(&str, &str)] = &[
    ("gallery.png", "sheet.png"),
    ("bunny-close.png", "bunny-close.png"),
    ("cat-close.png", "cat-close.png"),
    ("spider-close.png", "spider-close.png"),
    ("dog-close.png", "dog-close.png"),
    ("chimp-close.png", "chimp-close.png"),
    ("die-close.png", "die-close.png"),
];

/// Where every saved graph is said.
const GALLERY_PAGE: &str = "book/src/gallery.md";

const FOLDER: &str = "book/src/pictures";

/// Draws every picture anew, with the release build of the program.
pub(crate) fn draw(place: &Place) -> Result<()> {
    vulkan::make_sure()?;
    let folder = place.at(FOLDER);
    fs::create_dir_all(&folder).map_err(|cause| Failure::caused(folder.display(), cause))?;
    PICTURES.iter().try_for_each(|picture| {
        println!("{FOLDER}/{}", picture.file);
        command(place, picture).run()
    })?;
    draw_gallery(place)?;
    EXAMPLES.iter().try_for_each(|(file, example)| {
        println!("{FOLDER}/{file}");
        let line = CommandLine::cargo().with(["run", "--quiet", "--release"]).with(*example).with(["--"]);
        line.with([place.at(FOLDER).join(file)]).within(place.root()).run()
    })
}

/// Draws all saved graphs, and takes what pages show.
fn draw_gallery(place: &Place) -> Result<()> {
    let out = place.at("target/book-gallery");
    CommandLine::cargo()
        .with(["run", "--quiet", "--release", "--package", "pelage-cli", "--", "gallery", "graphs", "--quiet", "-o"])
        .with([out.clone()])
        .within(place.root())
        .run()?;
    let copy = |(file, from): &(&str, &str)| {
        let to = place.at(FOLDER).join(file);
        fs::copy(out.join(from), &to).map(drop).map_err(|cause| Failure::caused(to.display(), cause))
    };
    GALLERY.iter().try_for_each(copy)
}

/// A line for each saved graph that the gallery's page does not name.
fn unnamed(page: &str, graphs: &[String]) -> Vec<String> {
    let missing = graphs.iter().filter(|graph| !page.contains(&format!("`{graph}`")));
    missing.map(|graph| format!("{GALLERY_PAGE} does not say what graphs/{graph}.ron shows: add a row")).collect()
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

/// A line for each picture of the tables that is not there, or that no page shows.
pub(crate) fn faults(place: &Place) -> Result<Vec<String>> {
    let mut faults = missing(|file| place.at(FOLDER).join(file).is_file());
    let mut pages = pages_below(&place.at("book/src"))?;
    pages.push(place.at("README.md"));
    let read = |page: &PathBuf| fs::read_to_string(page).map_err(|cause| Failure::caused(page.display(), cause));
    let text = pages.iter().map(read).collect::<Result<Vec<String>>>()?.concat();
    faults.extend(unshown(&text));
    faults.extend(unnamed(&read(&place.at(GALLERY_PAGE))?, &place.ron_names("graphs")?));
    Ok(faults)
}

fn files() -> impl Iterator<Item = &'static str> {
    PICTURES.iter().map(|picture| picture.file).chain(EXAMPLES.iter().map(|(file, _)| *file)).chain(GALLERY.iter().map(|(file, _)| *file))
}

fn missing(exists: impl Fn(&str) -> bool) -> Vec<String> {
    files().filter(|file| !exists(file)).map(|file| format!("{FOLDER}/{file} is not there: draw it with `cargo book pictures`")).collect()
}

fn unshown(text: &str) -> Vec<String> {
    let hidden = files().filter(|file| !text.contains(&format!("pictures/{file})")));
    hidden.map(|file| format!("{FOLDER}/{file} is drawn and shown on no page: show it or draw it no more")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn the_table_names_each_file_once() {
        assert_eq!(files().collect::<BTreeSet<&str>>().len(), files().count());
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
    fn a_graph_that_the_gallery_does_not_name_is_told() {
        let graphs = ["fox".to_owned(), "cat".to_owned()];
        assert_eq!(unnamed("| `cat` | a cat |\n| `fox` | a fox |", &graphs), Vec::<String>::new());
        assert!(unnamed("| `cat` | a fox |", &graphs)[0].contains("graphs/fox.ron"));
    }

    #[test]
    fn a_missing_picture_is_told() {
        assert_eq!(missing(|_| false).len(), files().count());
        assert_eq!(missing(|_| true), Vec::<String>::new());
    }

    #[test]
    fn a_picture_that_no_page_shows_is_told() {
        let shown: String = files().map(|file| format!("![x](../pictures/{file})")).collect();
        assert_eq!(unshown(&shown), Vec::<String>::new());
        let told = unshown(&shown.replace("pictures/bunny.png", "pictures/hare.png"));
        assert!(told.len() == 1 && told[0].contains("bunny.png"), "{told:?}");
    }
}
