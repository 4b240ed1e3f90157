//! What each option of drawing costs and how far its picture is from a more exact one: the tables of the book, as the book has them.
//!
//! `cargo run --release -p pelage-tests --example options`; `-- WORD…` for the groups alone whose titles have one of the words in them. The frames of a group take turns; a time is
//! the least of the rounds over the least of the option that the group names. Fragments are samples that pass the tests, all of a pixel's counted. Bytes are those of the textures.
#![allow(clippy::print_stdout, reason = "a program for a person at a terminal")]

use std::sync::Arc;

use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, Image, flip};
use pelage_coat::Coat;
use pelage_graph::Evaluator;
use pelage_nodes::{FrameReport, Picture};
use pelage_render::Headless;
use pelage_tests::{Contender, Error, Fur, Scene, Stage, gpu, race};

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
    /// Whose time the others' are given by: the default, or what is nearest to it here.
    beside: &'static str,
    /// Whether the shadow map is drawn anew each frame, as if the light moved.
    redraw: bool,
}

/// How often each frame is measured.
const ROUNDS: usize = 7;

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
        beside: "33 shells, one layer each",
        redraw: false,
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
            ("between the finest and half, at level 0.75", &[("picture.detail", "Level(level: 0.75)")]),
        ],
        beside: "the finest",
        redraw: false,
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
        beside: "0.25 pixels (default)",
        redraw: false,
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
        beside: "at vertices",
        redraw: false,
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
        beside: "map of 1024²",
        redraw: true,
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
        beside: "depth written",
        redraw: false,
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
        beside: "one quad",
        redraw: false,
    },
    Group {
        title: "one image for straight hair",
        graph: "straight",
        common: &[],
        exact: ("all 32 images", &[("shells.tolerance", "0.0"), ("shells.otherwise", "Keep")]),
        options: &[("one image and a ramp", &[])],
        beside: "all 32 images",
        redraw: false,
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
        beside: "shown by sixty shells",
        redraw: false,
    },
    Group {
        title: "where shells stand",
        graph: "ball",
        common: &[("shells.layers", "16"), ("coat.length", "0.12")],
        exact: ("128 shells, evenly spaced", &[("shells.layers", "128")]),
        options: &[
            ("evenly", &[]),
            ("power 1.5", &[("shells.spacing", "Power(power: 1.5)")]),
            ("power 2", &[("shells.spacing", "Power(power: 2.0)")]),
            ("exponential, rate 1", &[("shells.spacing", "Exponential(rate: 1.0)")]),
            ("exponential, rate 3", &[("shells.spacing", "Exponential(rate: 3.0)")]),
        ],
        beside: "evenly",
        redraw: false,
    },
];

fn main() -> Result<(), Error> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |group: &&Group| words.is_empty() || words.iter().any(|word| group.title.contains(word.as_str()));
    let headless = gpu()?.headless();
    let stages = [1, 4].map(|samples| Stage::new(headless, samples));
    GROUPS.iter().filter(wanted).try_for_each(|group| print(group, headless, &stages))
}

/// A picture, the coat on it, and how it was drawn.
struct Drawn {
    name: &'static str,
    picture: Arc<Picture>,
    coat: Arc<Coat>,
    report: Arc<FrameReport>,
}

fn print(group: &Group, headless: &Headless, stages: &[Stage; 2]) -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(2 << 30);
    let all = [&[group.exact][..], group.options].concat();
    let drawn = all.into_iter().map(|(name, set)| draw(&mut evaluator, group, name, set)).collect::<Result<Vec<Drawn>, Error>>()?;
    let costs = measure(headless, stages, &drawn, group.redraw)?;
    let base = drawn.iter().position(|drawn| drawn.name == group.beside).ok_or("the option beside which times are given is not there")?;
    println!("\n{} ({}.ron), against: {}", group.title, group.graph, group.exact.0);
    println!(
        "| | shells | fins | triangles | fragments | bytes | time | FLIP, mean | 99th percentile |\n|---|---|---|---|---|---|---|---|---|"
    );
    for (drawn_so, cost) in drawn.iter().zip(&costs) {
        let frame = &drawn_so.picture.frame;
        let counts = [frame.shells_drawn.into(), frame.fins_drawn.into(), frame.triangles].map(thousands).join(" | ");
        let fragments = cost.fragments.map_or("–".into(), thousands);
        let (bytes, time) = (thousands(bytes(&drawn_so.coat) as u64), cost.least / costs[base].least);
        let (mean, p99) = difference(&drawn[0].picture, &drawn_so.picture)?;
        println!("| {} | {counts} | {fragments} | {bytes} | {time:.2} | {mean:.4} | {p99:.4} |", drawn_so.name);
    }
    println!("times beside: {}, {:.1} ms", group.beside, costs[base].least);
    Ok(())
}

fn draw(evaluator: &mut Evaluator, group: &Group, name: &'static str, set: Set) -> Result<Drawn, Error> {
    let overrides: Vec<(&str, &str)> = [SIZE].iter().chain(group.common).chain(set).copied().collect();
    let scene = Scene::evaluate_measured(evaluator, group.graph, &overrides)?;
    Ok(Drawn { name, picture: scene.picture()?, coat: scene.coat()?, report: scene.only::<FrameReport>("frame")? })
}

/// Bytes of a coat's textures.
fn bytes(coat: &Coat) -> usize {
    coat.shells.byte_size() + coat.shells.direction_bytes() + coat.fin.as_ref().map_or(0, |fin| fin.byte_size())
}

/// What a frame costs.
struct Cost {
    /// Milliseconds, the least of the rounds.
    least: f64,
    /// Samples that passed the tests, every sample of a pixel counted; none where passes are split.
    fragments: Option<u64>,
}

/// The frames of one group in turn, in races of those with as many samples a pixel.
fn measure(headless: &Headless, stages: &[Stage; 2], drawn: &[Drawn], redraw: bool) -> Result<Vec<Cost>, Error> {
    let stage_of = |drawn: &Drawn| &stages[usize::from(drawn.report.samples > 1)];
    let fur = |drawn: &Drawn| Fur::new(headless, stage_of(drawn), &drawn.coat, &drawn.report.view);
    let mut furs = drawn.iter().map(fur).collect::<Result<Vec<Fur>, Error>>()?;
    let mut contenders = Vec::new();
    for (drawn, fur) in drawn.iter().zip(&mut furs) {
        let stage = stage_of(drawn);
        contenders.push(if drawn.report.view.options.hidden {
            Contender::hidden(headless, stage, fur, drawn.name)
        } else {
            Contender::ours(headless, stage, fur, drawn.name, redraw)?
        });
    }
    let finishes = race(headless, &stages[1], contenders, ROUNDS, [0, 0])?;
    Ok(finishes.into_iter().map(|finish| Cost { least: finish.least, fragments: finish.fragments }).collect())
}

/// A count with a comma between thousands.
fn thousands(count: u64) -> String {
    let digits = count.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().map(|group| str::from_utf8(group).unwrap_or_default()).collect();
    groups.join(",")
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
