//! Each feature of the sources that a saved graph uses is seen in its picture: with the feature changed or switched off, the golden notices.
#![allow(clippy::print_stdout, reason = "the distance that each feature makes")]

use std::collections::BTreeSet;

use pelage_tests::{Bounds, Error, Golden, Scene, VARIANTS, repository};

/// The feature's id in the design, the graph or variant that uses it, and what takes it away.
const FEATURES: &[(&str, &str, &str, &str)] = &[
    ("L2 directions from a few constraints", "ring", "combed.constraints", "[]"),
    ("L2 one direction for the whole surface", "bunny", "combed.toward", "(-1.0, 0.7, 0.15)"),
    ("L3 patches from random places", "die", "patches.seed", "2"),
    ("L4 patches larger than the tile", "meadow", "patches.patch_extent", "0.4"),
    ("L7 hair grown with a style", "ring", "hair.style", "Straight"),
    ("L7 sparse and dense", "ball", "hair.count", "900"),
    ("L7 two coats in one tile", "types", "coats.second_share", "0.0"),
    ("L7 hair shaped by a few guides", "guides", "swirl.guides", "[]"),
    ("L6 patches that overlap", "lapped", "lapped.patch_extent", "0.4"),
    ("K2 noise for hair", "rabbit", "noise.look", "Grains"),
    ("K2 noise by its seed", "patterns", "perlin_shells.seed", "9"),
    ("K2 an artist's picture", "patterns", "drawn_shells.paths", "[\"graphs/images/plain.png\"]"),
    ("K3 grains thin towards the tips", "patterns", "grains_shells.thinning", "0.0"),
    ("Z1 texels at random", "zima", "grains.seed", "2"),
    ("Z2 density", "zima", "grains.density", "0.5"),
    ("Z2 layers", "zima", "grains.layers", "6"),
    ("Z2 length", "zima", "coat.length", "0.01"),
    ("Z3 a colour texture of its own", "zima", "shells.path", "graphs/images/plain.png"),
    ("K12 curl by a field", "curls", "across.to", "-0.7"),
    ("K12 density by a field", "curls", "further.from", "1.0"),
    ("K19 animated layers", "field", "blown.phase", "0.0"),
    ("K19 a crowd", "crowd", "home.taper", "Linear"),
    ("L8 shell layers", "die", "shells.softness", "4.0"),
    ("L9 fin from a slab", "ball", "fin.slab_width", "0.9"),
    ("L9 random intervals", "ball", "coat.seed", "2"),
    ("L10 opaque surface first", "meadow", "picture.surface", "false"),
    ("L11 fins", "ring", "picture.fins", "false"),
    ("L12 shells", "die", "picture.shells", "false"),
    ("L13 diffuse", "bunny", "shading.diffuse_power", "4.0"),
    ("L13 specular", "bunny", "shading.specular", "(0.0, 0.0, 0.0)"),
    ("L13 self-shadow", "die", "shading.shadow", "0.0"),
    ("L13 facing term", "die", "shading.facing", "0.0"),
    ("L17 offsets in the vertex shader", "die", "picture.length_scale", "0.5"),
    ("L18 colour as a field", "bunny", "colours.to", "(1.0, 0.97, 0.93)"),
    ("L18 colour by texture, N5 length in its alpha", "meadow", "map.path", "graphs/images/plain.png"),
    ("L19 local length", "ball", "lengths.from", "0.6"),
    ("L20 global slant", "bunny", "coat.slant", "0.0"),
    ("N3 number of shells", "die", "picture.shell_count", "16"),
    ("N8 depth written or not", "ball", "picture.depth", "Written"),
    ("N1 fins on silhouettes", "nvidia", "picture.fins_on", "Faded"),
    ("N1 the threshold", "nvidia", "picture.fins_on", "Silhouettes(threshold: 0.6)"),
    ("N8 depth tested", "nvidia", "picture.depth", "Written"),
    ("K11 hair bends", "shorn", "coat.bend", "0.0"),
    ("K11 fins bend with it", "shorn", "picture.fin_segments", "1"),
    ("K18 hair is cut where its field says", "shorn", "coat.lengths_as", "Scale"),
    ("alpha to coverage", "coverage", "picture.depth", "Written"),
    ("step blur", "step-blur-off", "picture.step_blur", "1.5"),
    ("anisotropy", "anisotropic", "picture.anisotropy", "1"),
    ("lighting from a table", "by-table", "picture.lighting", "Vertices"),
    ("depth only tested", "depth-tested", "picture.depth", "Written"),
    ("lighting by patch", "by-patch", "picture.lighting", "Vertices"),
    ("L11 all fins, whole", "figure4-e", "picture.fins_on", "Faded"),
    ("L16 a level by hand", "figure4-j", "picture.detail", "Level(level: 0.0)"),
    ("L16 fewer shells from afar", "levels", "far.detail", "Level(level: 0.0)"),
    ("L24 several coats on one creature", "lion", "hair.second", "\"short.strands\""),
    ("L24 which coat stands where", "lion", "where.to", "(0.0, 0.0)"),
    ("L21 local strokes", "combed", "combed.strokes", "[]"),
    ("N4 a comb over all of it", "combed", "combed.everywhere", "(0.0, 40.0, 0.0)"),
    ("L20 the paper's plain shear", "combed", "coat.slant_as", "Sheared"),
    ("a budget that picks by distance", "budget", "near_budget.limit", "MaxError(flip: 0.5, cost: Fragments)"),
    ("L16 eight shells", "figure4", "picture.detail", "Level(level: 1.0)"),
    ("L15 directions by pixel", "shadows", "picture.direction_map", "false"),
    ("lighting by pixel", "shadows", "picture.lighting", "Vertices"),
    ("K10 hairs shade each other", "shadows", "picture.hair_shadow", "0.0"),
    ("shadows cast by skin and fur", "shadows", "picture.shadows", "false"),
    ("several lights", "shadows", "rim.strength", "0.0"),
    ("light from all around by a picture", "shadows", "around.turn", "180.0"),
    ("L22 straight hair as one image", "straight", "coat.shells", "\"sampled.shells\""),
    ("L22 images in blocks", "blocks", "coat.shells", "\"sampled.shells\""),
    ("K5 images shared", "shared", "shells.count", "20"),
    ("K3 hair thins towards the tips", "bunny", "hair.length_variation", "0.0"),
    ("K6 lengths by a pattern", "varied", "spotted.by_pattern.length", "0.0"),
    ("K6 brightness by a pattern", "varied", "striped.by_pattern.colour", "0.0"),
    ("K6 length, brightness and bend by noise", "varied", "patchy.by_noise", "(cells: 3)"),
    ("K6 thickness along the hair", "varied", "grizzled.taper", "Power(exponent: 2.0)"),
    ("K7 woolly", "types", "woolly.style", "Straight"),
    ("K7 zigzag", "types", "zigzag.style", "Straight"),
    ("K7 spiky", "types", "spiky.gather", "Free"),
    ("K7 clumpy", "types", "clumpy.gather", "Free"),
    ("K8 offset along the hair", "types", "spiky.gather", "Spiky(strength: 0.97, offset: Power(exponent: 6.0))"),
    ("K9 bands", "varied", "grizzled.bands", "[]"),
    ("K9 white hairs", "varied", "grizzled.white", "0.0"),
    ("K9 hair that lets light through", "varied", "grizzled.opacity", "(root: 1.0)"),
    ("K4 outer shells closer together", "shared", "shells.spacing", "Even"),
    ("K4 shells spaced by a power", "spacing", "power.spacing", "Even"),
    ("K4 shells spaced exponentially", "spacing", "exponential.spacing", "Even"),
    ("L26 several layers in one shell", "marched", "picture.march", "1"),
    ("N9 the volume between layers", "marched", "picture.march_steps", "1"),
    ("L9 fins of other hair than the shells'", "guard", "fin.strands", "\"down.strands\""),
    ("L9 an artist's fin", "drawn", "fin.path", "graphs/images/plain.png"),
    ("L18 noise in space", "spots", "dots.seed", "6"),
    ("L18 a curve", "spots", "rosettes.course", "Straight"),
    ("L18 arithmetic", "spots", "spotted.operation", "Greatest"),
    ("L18 a mask", "spots", "back.threshold", "0.9"),
    ("L18 colours mixed by numbers", "spots", "marks.second_colour", "(0.6, 0.1, 0.05)"),
    ("L18 painted strokes", "strokes", "dark.strokes", "[]"),
    ("L19 length painted", "strokes", "bare.to", "(1.0, 1.0)"),
    ("L18 colours of a glTF model, blurred", "caterpillar", "soft.radius", "10.0"),
    ("N5 length in a glTF model's alpha", "caterpillar", "coat.lengths_as", "Cut"),
    ("L1 mirrored", "strokes", "other.scale", "(1.0, 1.0, 1.0)"),
    ("L1 subdivided", "strokes", "pillow.times", "0"),
    ("L1 simplified", "strokes", "bead.share", "0.01"),
];

#[test]
fn each_feature_is_seen() -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let mut unseen = Vec::new();
    for (feature, graph, input, value) in FEATURES {
        let (of, set) = VARIANTS.iter().find(|variant| variant.name == *graph).map_or((*graph, &[][..]), |v| (v.graph, v.overrides));
        let overrides: Vec<(&str, &str)> = set.iter().copied().chain([(*input, *value)]).collect();
        let picture = Scene::evaluate_with(&mut evaluator, of, &overrides)?.picture()?;
        let comparison = Golden::read(graph)?.compare(&picture)?;
        println!("{feature}: FLIP mean {:.4}, 99th percentile {:.4}", comparison.mean, comparison.p99);
        if comparison.within(Bounds::KEPT) {
            unseen.push(*feature);
        }
    }
    if unseen.is_empty() { Ok(()) } else { Err(format!("not seen: {unseen:?}").into()) }
}

/// The book's list: every graph, test and page that it names is there, and what is to be seen in a picture is in the list above.
#[test]
fn the_books_list_is_true() -> Result<(), Error> {
    let book = repository().join("book/src");
    let text = std::fs::read_to_string(book.join("features.md"))?;
    let tried: BTreeSet<&str> = FEATURES.iter().flat_map(|(feature, ..)| feature.split([' ', ','])).collect();
    let mut faults = Vec::new();
    let mut rows = 0;
    for line in text.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| id")) {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        let [ids, _, graphs, tests, pages] = cells.as_slice() else { return Err(format!("not five cells: {line}").into()) };
        let missing = |what: &str, path: &std::path::Path| (!path.is_file()).then(|| format!("{ids}: no {what} {}", path.display()));
        faults.extend(quoted(graphs).filter_map(|graph| missing("graph", &repository().join(format!("graphs/{graph}.ron")))));
        faults.extend(quoted(tests).filter_map(|test| missing("test", &repository().join(test))));
        faults.extend(pages.split("](").skip(1).filter_map(|rest| missing("page", &book.join(rest.split(')').next()?))));
        if tests.contains("*picture*") && !ids.split(", ").any(|id| tried.contains(id)) {
            faults.push(format!("{ids}: nothing is taken away"));
        }
        if quoted(tests).next().is_none() && !tests.contains("*picture*") || !pages.contains("](") {
            faults.push(format!("{ids}: no test or no page"));
        }
        rows += 1;
    }
    assert!(rows > 20, "{rows} rows");
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n").into()) }
}

/// What stands between backticks.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}
