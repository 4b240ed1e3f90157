//! What the nodes of the hair textures hand on is whole, and is what they say.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use pelage_coat::{Encoding, FinTexture, MipImage, ShellLayer, ShellTexture};
use pelage_graph::{Evaluator, Graph, Request};
use pelage_nodes::OneLayerReport;

/// Straight and upright, and short of nothing; and the default, which waves and leans.
const HAIR: &str = r#"
    "straight": GrowStrands(style: Straight, count: 120, lean: 0.0, splay: 0.0, gravity: 0.0, wander: 0.0, separation: 0.0, clump: 0.0,
        length_variation: 0.0, undercoat: (count: 0)),
    "wavy": GrowStrands(count: 120, undercoat: (count: 60)),
    "upright": SampleShells(strands: "straight.strands", layers: 8, resolution: 32),
    "leaning": SampleShells(strands: "wavy.strands", layers: 8, resolution: 32, directions: true, stretch: 0.5),
"#;

fn made_by<T: Send + Sync + 'static>(nodes: &str, output: &str) -> Result<Arc<T>, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs");
    let text = format!("Graph(version: 1, nodes: {{{HAIR}{nodes}}})");
    let checked = Graph::parse(&text)?.with_directory(&folder).check(&pelage_nodes::registry())?;
    Ok(Evaluator::new(1 << 28).run(&checked, &Request::output(output))?.get::<T>(output)?)
}

fn shells(nodes: &str, output: &str) -> Arc<ShellTexture> {
    let texture = made_by::<ShellTexture>(nodes, output).unwrap();
    assert_eq!(texture.check(), Ok(()), "{output}");
    texture
}

#[test]
fn every_texture_on_the_way_is_whole() {
    const CHAIN: &str = r#"
        "more": ShareImages(shells: "leaning.shells", count: 20, spacing: Power(power: 1.5)),
        "far": LevelsOfDetail(shells: "more.shells"),
        "small": CompressShells(shells: "far.shells"),
        "back": CompressShells(shells: "far.shells", form: Texels),
        "again": LevelsOfDetail(shells: "small.shells"),
    "#;
    let shared = shells(CHAIN, "more.shells");
    assert_eq!((shared.layers(), shared.images, shared.levels.len()), (20, 8, 1));
    let far = shells(CHAIN, "far.shells");
    assert_eq!(far.levels.iter().map(Vec::len).collect::<Vec<_>>(), [20, 10, 5, 3, 2, 1]);
    let (small, back) = (shells(CHAIN, "small.shells"), shells(CHAIN, "back.shells"));
    assert_eq!((small.encoding, back.encoding), (Encoding::Bc3, Encoding::Rgba8));
    assert_eq!((&small.levels, &small.directions), (&far.levels, &far.directions));
    assert_eq!(4 * small.mips[0].texels.len(), far.mips[0].texels.len());
    assert!(back.byte_size() == far.byte_size() && back.mips != far.mips);
    // Levels of blocks are made from what the blocks decode to.
    assert_eq!(shells(CHAIN, "again.shells").encoding, Encoding::Rgba8);
    assert!(shells(CHAIN, "leaning.shells").directions.is_some() && shells(CHAIN, "upright.shells").directions.is_none());
}

/// The innermost shell, and its image at every size.
fn skin(texture: &ShellTexture) -> (Encoding, ShellLayer, Vec<Vec<u8>>) {
    let shell = texture.levels[0][0];
    let image = |mip: &MipImage| {
        let size = texture.encoding.bytes(mip.width, mip.height);
        mip.texels[shell.image as usize * size..][..size].to_vec()
    };
    (texture.encoding, ShellLayer { image: 0, ..shell }, texture.mips.iter().map(image).collect())
}

#[test]
fn the_skin_is_the_same_with_no_shells_above_it() {
    const CHAIN: &str = r#"
        "more": ShareImages(shells: "leaning.shells", count: 20, spacing: Power(power: 1.5)),
        "far": LevelsOfDetail(shells: "more.shells"),
        "small": CompressShells(shells: "far.shells"),
        "back": CompressShells(shells: "far.shells", form: Texels),
        "again": LevelsOfDetail(shells: "small.shells"),
        "one": OneLayer(shells: "again.shells", tolerance: 1.0),
    "#;
    let checked = Graph::parse(&format!("Graph(version: 1, nodes: {{{HAIR}{CHAIN}}})")).unwrap().check(&pelage_nodes::registry()).unwrap();
    for (node, layers) in [("leaning", 1), ("more", 1), ("far", 1), ("small", 1), ("back", 1), ("again", 1), ("one", 20)] {
        let output = format!("{node}.shells");
        let get = |request: &Request| Evaluator::new(1 << 28).run(&checked, request).unwrap().get::<ShellTexture>(&output).unwrap();
        // Nobody is on whose way it would be, so that no part is wanted.
        let (whole, alone) = (get(&Request::output(&output)), get(&Request::output("wavy.strands").and_on_the_way(&output)));
        assert_eq!((alone.check(), alone.layers()), (Ok(()), layers), "{node}");
        assert!(skin(&alone) == skin(&whole), "{node}");
        assert!(whole.directions.is_some() && alone.directions.is_none(), "{node}");
    }
}

#[test]
fn a_straight_coat_is_noticed_and_another_is_kept_or_refused() {
    let one = shells(r#""one": OneLayer(shells: "upright.shells", tolerance: 0.6)"#, "one.shells");
    assert_eq!((one.images, one.layers()), (2, 8));
    assert!(one.levels[0][1..].iter().all(|shell| shell.image == 1));
    let wavy = r#""one": OneLayer(shells: "leaning.shells")"#;
    assert_eq!(shells(wavy, "one.shells"), shells(wavy, "leaning.shells"));
    let report = made_by::<OneLayerReport>(wavy, "one.report").unwrap();
    assert!(!report.kept && report.unlikeness > 0.5 && report.alpha_largest > 0.2, "{report:?}");
    let refused = made_by::<ShellTexture>(r#""one": OneLayer(shells: "leaning.shells", otherwise: Refuse)"#, "one.shells");
    let message = refused.unwrap_err().to_string();
    assert!(message.contains(&format!("{:.3}", report.unlikeness)) && message.contains("0.250"), "{message}");
}

#[test]
fn shells_stand_where_their_spacing_says() {
    let sampled = shells(
        r#""close": SampleShells(strands: "wavy.strands", layers: 6, resolution: 16, spacing: Exponential(rate: 2.0))"#,
        "close.shells",
    );
    let gaps: Vec<f32> = sampled.levels[0].windows(2).map(|pair| pair[1].height - pair[0].height).collect();
    assert!(gaps.windows(2).all(|pair| pair[1] < pair[0]) && (gaps.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{gaps:?}");
    assert!(sampled.levels[0].iter().all(|shell| shell.layers == 1.0));
}

#[test]
fn a_picture_is_a_fin_and_what_is_none_is_named() {
    let fin = made_by::<FinTexture>(r#""drawn": FinImage(path: "images/meadow.png", tiles_across: 2)"#, "drawn.fin").unwrap();
    let image = image::open(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/images/meadow.png")).unwrap();
    assert_eq!(fin.tiles_across, 2.0);
    assert_eq!((fin.mips[0].width, fin.mips[0].height), (image.width().next_power_of_two(), image.height().next_power_of_two()));
    assert_eq!(fin.mips.last().map(|mip| (mip.width, mip.height)), Some((1, 1)));
    for path in ["images/none.png", "ball.ron"] {
        let wrong = made_by::<FinTexture>(&format!(r#""drawn": FinImage(path: "{path}")"#), "drawn.fin").unwrap_err();
        assert!(wrong.to_string().contains(path.rsplit('/').next().unwrap()), "{wrong}");
    }
}

#[test]
fn stats_itemise_what_textures_take() {
    const COAT: &str = r#"
        "ball": Sphere(subdivisions: 4),
        "patches": GrowPatches(mesh: "ball.mesh"),
        "small": CompressShells(shells: "leaning.shells"),
        "fin": SampleFin(strands: "wavy.strands", size: (64, 16)),
        "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "wavy.strands", shells: "small.shells", fin: "fin.fin"),
    "#;
    let checked = Graph::parse(&format!("Graph(version: 1, nodes: {{{HAIR}{COAT}}})")).unwrap().check(&pelage_nodes::registry()).unwrap();
    let evaluation = Evaluator::new(1 << 28).run(&checked, &Request::output("coat.fur")).unwrap();
    let stats: serde_json::Value = serde_json::from_str(&pelage_nodes::Stats::of(&evaluation).to_json()).unwrap();
    // Eight images: 64 + 16 + 4 + 1 + 1 + 1 blocks; a map of 1365 texels each; 64 × 16 texels and their halves.
    let (shells, directions, fin) = (8 * 16 * 87, 8 * 4 * 1365, 4 * (1024 + 256 + 64 + 16 + 4 + 2 + 1));
    let wanted = serde_json::json!({
        "shell_bytes": shells, "fin_bytes": fin, "direction_bytes": directions, "total_bytes": shells + fin + directions,
        "layers": 8, "resolution": 32, "images": 8, "encoding": "bc3",
    });
    assert_eq!(stats["textures"], wanted);
}
