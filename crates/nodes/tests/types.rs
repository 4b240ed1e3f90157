//! Types of hair as a file says them: what the nodes make is what the crate makes, and what is wrong is said.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::error::Error;
use std::sync::Arc;

use pelage_coat::ShellTexture;
use pelage_graph::{Evaluator, Graph, Request};
use pelage_nodes::CurlReport;
use pelage_strand::{
    Amounts, Bands, ByNoise, ByPattern, Curve, Gather, GrowSettings, Guide, Offset, Opacity, Pattern, Stop, StrandTile, Style, Taper,
    Undercoat, grow, guided, mix,
};

fn made_by<T: Send + Sync + 'static>(nodes: &str, output: &str) -> Result<Arc<T>, Box<dyn Error>> {
    let checked = Graph::parse(&format!("Graph(version: 1, nodes: {{{nodes}}})"))?.check(&pelage_nodes::registry())?;
    Ok(Evaluator::new(1 << 28).run(&checked, &Request::output(output))?.get::<T>(output)?)
}

/// Every setting of the types in another place than its default, white so that no colour is rounded on the way.
const HAIR: &str = r#"
    "hair": GrowStrands(count: 60, undercoat: (count: 20), style: Woolly(radius: 0.1, turns: 2.0, irregularity: 0.4),
        gather: Clumpy(strength: 0.6, mess: 0.2, offset: Exponential(rate: 1.5)), taper: Curve(values: [0.5, 1.0, 0.25]),
        thickness_variation: 0.3, tip_variation: 0.4, bend_variation: 0.5, white: 0.25, opacity: (root: 0.9, tip: 0.5, variation: 0.25),
        bands: [(along: 0.25, colour: (0.0, 0.0, 0.0)), (along: 0.75, colour: (1.0, 1.0, 1.0))],
        root_colour: (1.0, 1.0, 1.0), tip_colour: (1.0, 1.0, 1.0),
        by_noise: (cells: 5, length: 0.1, thickness: 0.2, colour: 0.3, tip: 0.4, bend: 0.5),
        by_pattern: (pattern: Checks(count: 3), softness: 0.1, length: 0.5, thickness: 0.4, colour: 0.3, tip: 0.2, bend: 0.1)),
    "bent": GuideStrands(strands: "hair.strands", guides: [
        (root: (0.25, 0.5), points: [(0.1, 0.2, 0.5), (0.3, 0.4, 0.8)]), (root: (0.75, 1.5), points: [(-0.5, 0.0, 0.5)])]),
    "both": MixStrands(first: "hair.strands", second: "bent.strands", first_share: 0.5, second_share: 0.25),
"#;

fn settings() -> GrowSettings {
    let stop = |along: f32, grey: f32| Stop { along, colour: [grey; 3] };
    GrowSettings {
        count: 60,
        undercoat: Undercoat { count: 20, ..Undercoat::default() },
        style: Style::Woolly { radius: 0.1, turns: 2.0, irregularity: 0.4 },
        gather: Gather::Clumpy { strength: 0.6, mess: 0.2, offset: Offset::Exponential { rate: 1.5 } },
        taper: Taper::Curve(Curve::new(&[0.5, 1.0, 0.25]).unwrap()),
        thickness_variation: 0.3,
        tip_variation: 0.4,
        bend_variation: 0.5,
        white: 0.25,
        opacity: Opacity { root: 0.9, tip: 0.5, variation: 0.25 },
        bands: Bands::new(&[stop(0.25, 0.0), stop(0.75, 1.0)]).unwrap(),
        root_colour: [1.0; 3],
        tip_colour: [1.0; 3],
        by_noise: ByNoise { cells: 5, amounts: Amounts { length: 0.1, thickness: 0.2, colour: 0.3, tip: 0.4, bend: 0.5 } },
        by_pattern: ByPattern {
            pattern: Pattern::Checks { count: 3 },
            softness: 0.1,
            amounts: Amounts { length: 0.5, thickness: 0.4, colour: 0.3, tip: 0.2, bend: 0.1 },
        },
        ..GrowSettings::default()
    }
}

#[test]
fn a_file_says_all_that_the_crate_knows() {
    let hair = grow(&settings()).unwrap();
    let guides = [
        Guide { root: [0.25, 0.5], points: vec![[0.1, 0.2, 0.5], [0.3, 0.4, 0.8]] },
        Guide { root: [0.75, 1.5], points: vec![[-0.5, 0.0, 0.5]] },
    ];
    let bent = guided(&hair, &guides).unwrap();
    let both = mix([&hair, &bent], [0.5, 0.25]).unwrap();
    for (output, wanted) in [("hair.strands", &hair), ("bent.strands", &bent), ("both.strands", &both)] {
        let made = made_by::<StrandTile>(HAIR, output).unwrap();
        assert_eq!((made.strand_count(), made.height()), (wanted.strand_count(), wanted.height()), "{output}");
        for (a, b) in made.strands().zip(wanted.strands()) {
            assert_eq!((a.points, a.radii, a.opacity, a.shade, a.bands), (b.points, b.radii, b.opacity, b.shade, b.bands), "{output}");
        }
    }
}

#[test]
fn other_types_are_read_as_they_are_written() {
    let hair = |node: &str| {
        made_by::<StrandTile>(&format!(r#""hair": GrowStrands(count: 40, undercoat: (count: 0), {node})"#), "hair.strands").unwrap()
    };
    let base = GrowSettings { count: 40, undercoat: Undercoat { count: 0, ..Undercoat::default() }, ..GrowSettings::default() };
    let spiky = |offset| Gather::Spiky { strength: 0.5, offset };
    let stripes = ByPattern {
        pattern: Pattern::Stripes { along_s: 1, along_t: 2 },
        softness: 0.3,
        amounts: Amounts { length: 0.5, ..Amounts::default() },
    };
    for (node, settings) in [
        ("gather: Spiky(strength: 0.5, offset: Sine)", GrowSettings { gather: spiky(Offset::Sine), ..base }),
        (
            "gather: Spiky(strength: 0.5, offset: Power(exponent: 3.0))",
            GrowSettings { gather: spiky(Offset::Power { exponent: 3.0 }), ..base },
        ),
        ("taper: Fixed", GrowSettings { taper: Taper::Fixed, ..base }),
        ("taper: Linear", GrowSettings { taper: Taper::Linear, ..base }),
        ("taper: Exponential(rate: -2.0)", GrowSettings { taper: Taper::Exponential { rate: -2.0 }, ..base }),
        ("by_pattern: (pattern: Stripes(along_s: 1, along_t: 2), length: 0.5)", GrowSettings { by_pattern: stripes, ..base }),
        (
            "by_pattern: (pattern: Dots(count: 3), length: 0.5)",
            GrowSettings { by_pattern: ByPattern { pattern: Pattern::Dots { count: 3 }, ..stripes }, ..base },
        ),
    ] {
        let (made, wanted) = (hair(node), grow(&settings).unwrap());
        assert!(made.strands().zip(wanted.strands()).all(|(a, b)| (a.points, a.radii) == (b.points, b.radii)), "{node}");
    }
}

#[test]
fn what_is_wrong_in_a_file_is_said() {
    let refused = |nodes: &str, output: &str| made_by::<StrandTile>(nodes, output).unwrap_err().to_string();
    for (field, says) in [
        ("style: Woolly(irregularity: 1.5)", "1.5 is out of range"),
        ("gather: Spiky(strength: NaN)", "NaN"),
        ("taper: Curve(values: [0.5, 9.0])", "9"),
        ("taper: Curve(values: [])", "taper.values has 0 entries, but must have 1 to 16: add some"),
        ("bands: [(along: 0.5), (along: 0.25)]", "bands.along is 0.25"),
        ("bands: [(), (), (), (), (), (), (), (), ()]", "bands has 9 entries"),
        ("by_pattern: (pattern: Dots(count: 0))", "0 is out of range"),
        ("by_noise: (cells: 65)", "65 is out of range"),
        ("opacity: (tip: -0.1)", "-0.1 is out of range"),
    ] {
        let error = refused(&format!(r#""hair": GrowStrands({field})"#), "hair.strands");
        assert!(error.contains(says), "{field}: {error}");
    }
    for (guides, says) in [
        ("(root: (0.5, 0.5), points: [])", "guides.points has 0 entries"),
        ("(root: (0.5, 0.5), points: [(0.0, 0.0, -0.5)])", "guide 0 is not usable at point 1"),
        ("(root: (0.5, 0.5)), (root: (2.5, -0.5))", "guides 0 and 1 have the same root"),
        ("(root: (0.5, 0.5), points: [(0.0, inf, 0.5)])", "inf"),
    ] {
        let nodes = format!(
            r#""hair": GrowStrands(count: 3, undercoat: (count: 0)), "bent": GuideStrands(strands: "hair.strands", guides: [{guides}])"#
        );
        let error = refused(&nodes, "bent.strands");
        assert!(error.contains(says), "{guides}: {error}");
    }
}

/// Curls finer than a texel are no error: the shells are made, and it is said what they lack and how to mend it.
#[test]
fn curls_finer_than_a_texel_are_told_of() {
    let nodes = |resolution: u32, layers: u32| {
        format!(
            r#""hair": GrowStrands(style: Curly(radius: 0.02, turns: 6.0), lean: 0.0, thickness: 0.001, count: 60, steps: 64, undercoat: (count: 0)),
            "shells": SampleShells(strands: "hair.strands", resolution: {resolution}, layers: {layers})"#
        )
    };
    // Two per cent of 0.35 either way: 0.014 tile sides.
    let report = |resolution, layers| *made_by::<CurlReport>(&nodes(resolution, layers), "shells.report").unwrap();
    let coarse = report(32, 32);
    assert!((coarse.texels / (0.014 * 32.0) - 1.0).abs() < 0.1 && coarse.share > 0.9, "{coarse:?}");
    assert!(coarse.warning().is_some_and(|warning| warning.contains("texels wide") && warning.contains("raise the resolution")));
    assert!(made_by::<ShellTexture>(&nodes(32, 32), "shells.shells").is_ok());
    let few = report(256, 8);
    assert!(few.texels > 3.0 && few.layers < 2.0, "{few:?}");
    assert!(few.warning().is_some_and(|warning| warning.contains("layers in a turn")));
    assert_eq!(report(256, 32).warning(), None);
    // The default coat is fine enough for its own shells.
    let default =
        made_by::<CurlReport>(r#""hair": GrowStrands(), "shells": SampleShells(strands: "hair.strands")"#, "shells.report").unwrap();
    assert_eq!(default.warning(), None, "{default:?}");
    // An evaluation hands warnings on by the node's name.
    let checked =
        Graph::parse(&format!("Graph(version: 1, nodes: {{{}}})", nodes(32, 32))).unwrap().check(&pelage_nodes::registry()).unwrap();
    let evaluation =
        Evaluator::new(1 << 28).run(&checked, &Request::output("shells.shells").and_output("shells.report").with_all_values()).unwrap();
    assert!(pelage_nodes::warnings(&evaluation).iter().any(|warning| warning.starts_with("shells: curls are")));
    let stats: serde_json::Value = serde_json::from_str(&pelage_nodes::Stats::of(&evaluation).to_json()).unwrap();
    assert!(
        stats["curls"]["warning"].as_str().is_some_and(|warning| warning.contains("texels wide"))
            && stats["curls"]["share"].as_f64() > Some(0.9)
    );
}
