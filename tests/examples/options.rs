//! What each option of drawing costs and how far its picture is from a more exact one: the tables of the book.
//!
//! `cargo run --release -p pelage-tests --example options`; `-- WORD…` for the groups alone whose titles have one of the words in them. Times are the least of the rounds, as a ratio to the exact picture's.
#![allow(clippy::print_stdout, reason = "a program for a person at a terminal")]

use std::sync::Arc;

use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, Image, flip};
use pelage_graph::Evaluator;
use pelage_nodes::{FrameReport, Picture};
use pelage_tests::{Error, Scene};

/// What is set in a graph.
type Set = &'static [(&'static str, &'static str)];

/// Options of one graph, beside a more exact picture of it.
struct Group {
    title: &'static str,
    graph: &'static str,
    /// What all of them have set.
    common: Set,
    /// What the exact picture has set beside.
    exact: (&'static str, Set),
    options: &'static [(&'static str, Set)],
}

/// How often each frame is measured.
const ROUNDS: &str = "5";

const SIZE: (&str, &str) = ("picture.size", "(640, 480)");

const GROUPS: &[Group] = &[
    Group {
        title: "how far a shell looks into the fur",
        graph: "marched",
        common: &[("picture.step_blur", "0.0"), ("shells.layers", "33")],
        exact: ("each shell sampled eight times", &[("picture.march", "1"), ("picture.march_steps", "8")]),
        options: &[
            ("33 shells, one layer each", &[("picture.march", "1"), ("picture.march_steps", "1")]),
            ("33 shells, each sampled twice", &[("picture.march", "1"), ("picture.march_steps", "2")]),
            ("33 shells, each sampled four times", &[("picture.march", "1"), ("picture.march_steps", "4")]),
            ("16 shells of two layers", &[("picture.march", "2"), ("picture.march_steps", "1")]),
            ("8 shells of four layers", &[("picture.march", "4"), ("picture.march_steps", "1")]),
            ("4 shells of eight layers", &[("picture.march", "8"), ("picture.march_steps", "1")]),
            ("one shell of all layers", &[("picture.march", "32"), ("picture.march_steps", "1")]),
            ("8 shells, their own layers alone", &[("shells.layers", "9"), ("picture.march", "1"), ("picture.march_steps", "1")]),
        ],
    },
    Group {
        title: "level of detail, near",
        graph: "figure4",
        common: &[],
        exact: ("the finest", &[]),
        options: &[
            ("half the shells", &[("picture.detail", "Level(level: 1.0)")]),
            ("a quarter", &[("picture.detail", "Level(level: 2.0)")]),
            ("an eighth", &[("picture.detail", "Level(level: 3.0)")]),
            ("the skin alone", &[("picture.detail", "Level(level: 4.0)")]),
            ("half way to half", &[("picture.detail", "Level(level: 0.75)")]),
        ],
    },
    Group {
        title: "level of detail by distance, four times as far",
        graph: "figure4",
        common: &[("camera.margin", "3.2")],
        exact: ("the finest", &[]),
        options: &[
            ("0.125 pixels between shells", &[("picture.detail", "Spacing(pixels: 0.125)")]),
            ("0.25 pixels (default)", &[("picture.detail", "Spacing(pixels: 0.25)")]),
            ("0.5 pixels", &[("picture.detail", "Spacing(pixels: 0.5)")]),
            ("1 pixel", &[("picture.detail", "Spacing(pixels: 1.0)")]),
            ("2 pixels", &[("picture.detail", "Spacing(pixels: 2.0)")]),
        ],
    },
    Group {
        title: "light on curls",
        graph: "shadows",
        common: &[("picture.hair_shadow", "0.0"), ("picture.shadows", "false")],
        exact: ("by pixel, by the map", &[]),
        options: &[
            ("by pixel, interpolated directions", &[("picture.direction_map", "false")]),
            ("by a table of 64²", &[("picture.lighting", "Table(size: 64)")]),
            ("by the paper's table", &[("picture.lighting", "Table(size: 32, diffuse_by: Cosine, specular_by: Cosine)")]),
            ("at vertices", &[("picture.lighting", "Vertices")]),
            ("by patch", &[("picture.lighting", "Patches")]),
        ],
    },
    Group {
        title: "shadows",
        graph: "shadows",
        common: &[("picture.shadow_size", "1024")],
        exact: ("map of 4096²", &[("picture.shadow_size", "4096")]),
        options: &[
            ("map of 2048²", &[("picture.shadow_size", "2048")]),
            ("map of 1024²", &[]),
            ("map of 512²", &[("picture.shadow_size", "512")]),
            ("map of 256²", &[("picture.shadow_size", "256")]),
            ("no map", &[("picture.shadows", "false")]),
            ("no hair shadow", &[("picture.hair_shadow", "0.0")]),
        ],
    },
    Group {
        title: "depth and blending",
        graph: "bunny",
        common: &[("shells.layers", "16")],
        exact: ("depth written", &[]),
        options: &[
            ("depth tested", &[("picture.depth", "Tested")]),
            ("alpha to coverage", &[("picture.depth", "Coverage")]),
            ("one sample a pixel", &[("picture.samples", "1")]),
            ("anisotropy 2", &[("picture.anisotropy", "2")]),
            ("everything submitted", &[("picture.culling", "false")]),
            ("what the skin hides left out", &[("picture.hidden", "true")]),
        ],
    },
    Group {
        title: "fins",
        graph: "shorn",
        common: &[],
        exact: ("sixteen quads each", &[("picture.fin_segments", "16")]),
        options: &[
            ("six quads", &[]),
            ("two quads", &[("picture.fin_segments", "2")]),
            ("one quad", &[("picture.fin_segments", "1")]),
            ("NVIDIA's rule, six quads", &[("picture.fins_on", "Silhouettes(threshold: 0.2)")]),
            ("none", &[("picture.fins", "false")]),
        ],
    },
    Group {
        title: "one image for straight hair",
        graph: "straight",
        common: &[],
        exact: ("all 32 images", &[("shells.tolerance", "0.0"), ("shells.otherwise", "Keep")]),
        options: &[("one image and a ramp", &[])],
    },
    Group {
        title: "twenty images",
        graph: "shared",
        common: &[],
        exact: ("sixty of its own for each shell", &[("sampled.layers", "60")]),
        options: &[
            ("shown by sixty shells", &[]),
            ("shown by twenty", &[("shells.count", "20")]),
            ("shown by sixty, evenly spaced", &[("shells.spacing", "Even")]),
        ],
    },
];

fn main() -> Result<(), Error> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |group: &&Group| words.is_empty() || words.iter().any(|word| group.title.contains(word.as_str()));
    GROUPS.iter().filter(wanted).try_for_each(print)
}

/// A picture, and the least that its frame took, in milliseconds.
struct Drawn {
    picture: Arc<Picture>,
    least: f64,
}

fn print(group: &Group) -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(2 << 30);
    println!("\n{} ({}.ron), against: {}", group.title, group.graph, group.exact.0);
    println!("{:36} {:>7} {:>9} {:>9} {:>9} {:>8} {:>8}", "", "shells", "fins", "triangles", "of exact", "FLIP", "p99");
    let exact = draw(&mut evaluator, group, group.exact.1)?;
    for (name, set) in group.options {
        let drawn = draw(&mut evaluator, group, set)?;
        let (mean, p99) = difference(&exact.picture, &drawn.picture)?;
        let frame = &drawn.picture.frame;
        let ratio = drawn.least / exact.least;
        println!("{name:36} {:7} {:9} {:9} {ratio:9.2} {mean:8.4} {p99:8.4}", frame.shells_drawn, frame.fins_drawn, frame.triangles);
    }
    Ok(())
}

fn draw(evaluator: &mut Evaluator, group: &Group, set: Set) -> Result<Drawn, Error> {
    let overrides: Vec<(&str, &str)> =
        [SIZE, ("picture.repeat", ROUNDS)].into_iter().chain(group.common.iter().copied()).chain(set.iter().copied()).collect();
    let scene = Scene::evaluate_measured(evaluator, group.graph, &overrides)?;
    let report = scene.only::<FrameReport>("frame")?;
    Ok(Drawn { picture: scene.picture()?, least: report.times.map_or(f64::NAN, |times| times.ms_min) })
}

/// FLIP's mean and 99th percentile where either picture has fur.
fn difference(exact: &Picture, test: &Picture) -> Result<(f64, f64), Error> {
    let rgb = |picture: &Picture| picture.rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect::<Vec<u8>>();
    let (a, b) = (rgb(exact), rgb(test));
    let mask: Vec<u8> = exact.coverage.iter().zip(&test.coverage).map(|(&a, &b)| a.max(b)).collect();
    let report =
        flip(Image::new(exact.width, exact.height, &a)?, Image::new(test.width, test.height, &b)?, Some(&mask), DEFAULT_PIXELS_PER_DEGREE)?;
    Ok((report.mean, report.p99))
}
