//! Lights add up along a chain, and a picture lights from where it is bright.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

use std::path::Path;
use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Irradiance, Lights};
use pelage_graph::{Colour, EvaluateError, Evaluator, Graph, Request};

/// The lights of the node "last"; files are beside `folder`.
fn lights_in(folder: &Path, nodes: &str) -> Result<Arc<Lights>, EvaluateError> {
    let graph = Graph::parse(&format!("Graph(version: 1, nodes: {{{nodes}}})")).unwrap().with_directory(folder);
    let checked = graph.check(&pelage_nodes::registry()).unwrap();
    Ok(Evaluator::new(0).run(&checked, &Request::output("last.light"))?.get::<Lights>("last.light").unwrap())
}

fn lights(nodes: &str) -> Arc<Lights> {
    lights_in(Path::new("."), nodes).unwrap()
}

fn linear(colour: [f64; 3]) -> Vec3 {
    DVec3::from(Colour(colour).to_linear()).as_vec3()
}

/// A folder with `around.png` of 8 × 4 texels.
fn picture(colour: impl Fn(u32, u32) -> [u8; 3]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    image::RgbImage::from_fn(8, 4, |column, row| image::Rgb(colour(column, row))).save(folder.path().join("around.png")).unwrap();
    folder
}

#[test]
fn a_light_alone_is_what_it_was_before_there_were_chains() {
    let alone = lights(r#""last": Light(azimuth: 90.0, elevation: 0.0)"#);
    assert_eq!(alone.directional.len(), 1);
    assert!(alone.directional[0].direction.abs_diff_eq(Vec3::X, 1e-6));
    assert_eq!(alone.directional[0].colour, linear([1.0, 0.96, 0.9]) * 2.2);
    assert_eq!(alone.ambient, Irradiance::hemisphere(linear([0.62, 0.68, 0.78]), linear([0.45, 0.4, 0.36])));
    assert_eq!(alone, lights(r#""last": Light(azimuth: 90.0, elevation: 0.0, sky: (0.62, 0.68, 0.78), ground: (0.45, 0.4, 0.36))"#));
}

#[test]
fn a_light_added_to_others_goes_last_and_brings_no_sky_unless_asked_to() {
    const KEY: &str = r#""key": Light(strength: 3.0), "#;
    let key = lights(r#""last": Light(strength: 3.0)"#);
    let two = lights(&format!("{KEY}{}", r#""last": Light(with: "key.light", azimuth: 200.0, strength: 0.5)"#));
    assert_eq!((two.directional.len(), two.directional[0]), (2, key.directional[0]));
    assert_eq!(two.directional[1].colour, linear([1.0, 0.96, 0.9]) * 0.5);
    assert_eq!(two.ambient, key.ambient);
    let asked = lights(&format!("{KEY}{}", r#""last": Light(with: "key.light", sky: (1.0, 0.0, 0.0))"#));
    let sky = Irradiance::hemisphere(Vec3::X, Vec3::ZERO);
    for normal in [Vec3::Y, Vec3::X, Vec3::NEG_Y] {
        assert!(asked.ambient.at(normal).abs_diff_eq(key.ambient.at(normal) + sky.at(normal), 1e-6));
    }
}

#[test]
fn four_lights_are_drawn_and_the_fifth_is_refused_where_it_is_added() {
    let chain = |count: usize| {
        let name = |k: usize| if k + 1 == count { "last".to_owned() } else { format!("l{k}") };
        let first = format!("\"{}\": Light()", name(0));
        (1..count).fold(first, |nodes, k| format!("{nodes}, \"{}\": Light(with: \"{}.light\")", name(k), name(k - 1)))
    };
    assert_eq!(lights(&chain(4)).directional.len(), Lights::MOST);
    let error = lights_in(Path::new("."), &chain(5)).unwrap_err().to_string();
    assert!(error.contains("last") && error.contains("light 5") && error.contains("at most 4"), "{error}");
}

#[test]
fn an_environment_of_one_grey_is_its_linear_light_from_everywhere() {
    let folder = picture(|_, _| [188, 188, 188]);
    let around = lights_in(folder.path(), r#""last": Environment(path: "around.png", strength: 2.0, turn: 77.0)"#).unwrap();
    assert!(around.directional.is_empty());
    for normal in [Vec3::X, Vec3::Y, Vec3::NEG_Z, Vec3::splat(1.0).normalize()] {
        assert!(around.ambient.at(normal).abs_diff_eq(2.0 * linear([188.0 / 255.0; 3]), 1e-6), "{}", around.ambient.at(normal));
    }
}

#[test]
fn what_is_bright_in_the_picture_lights_from_the_azimuth_a_light_would_have() {
    // Columns 1 and 2 are about a quarter from the left: azimuth 90.
    let folder = picture(|column, row| if (1..=2).contains(&column) && (1..=2).contains(&row) { [255; 3] } else { [0; 3] });
    for turn in [0.0, 30.0, -120.0] {
        let nodes = format!("\"last\": Environment(path: \"around.png\", turn: {turn:?})");
        let around = lights_in(folder.path(), &nodes).unwrap();
        let toward = lights(&format!("\"last\": Light(azimuth: {:?}, elevation: 0.0)", 90.0 + turn)).directional[0].direction;
        let most = around.ambient.at(toward);
        for k in 0..36 {
            let (sin, cos) = (10.0 * k as f32).to_radians().sin_cos();
            assert!(around.ambient.at(Vec3::new(sin, 0.0, cos)).x <= most.x + 1e-6, "turned by {turn}: brighter at {}", 10 * k);
        }
        assert!(most.x > 2.0 * around.ambient.at(Vec3::Y).x && around.ambient.at(-toward).x < 0.2 * most.x);
    }
}

#[test]
fn an_environment_adds_to_lights_and_lights_to_it_alike() {
    let folder = picture(|column, row| [(20 * column) as u8, (60 * row) as u8, 90]);
    const SKY: &str = r#"Environment(path: "around.png""#;
    let black = "sky: (0.0, 0.0, 0.0), ground: (0.0, 0.0, 0.0)";
    let first = lights_in(folder.path(), &format!("\"sky\": {SKY}), \"last\": Light(with: \"sky.light\")")).unwrap();
    let after = lights_in(folder.path(), &format!("\"sun\": Light({black}), \"last\": {SKY}, with: \"sun.light\")")).unwrap();
    assert_eq!(first, after);
    assert_eq!(first.directional.len(), 1);
}

#[test]
fn a_picture_that_is_none_is_said_with_its_path() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("around.png"), "no picture").unwrap();
    let error = lights_in(folder.path(), r#""last": Environment(path: "around.png")"#).unwrap_err().to_string();
    assert!(error.contains("around.png"), "{error}");
}

#[test]
fn the_studio_lights_cool_from_above_warm_from_the_sun_and_little_from_below() {
    let graphs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs");
    let around = lights_in(&graphs, r#""last": Environment(path: "images/studio.png")"#).unwrap();
    let sun = lights(r#""last": Light(azimuth: 60.0, elevation: 12.0)"#).directional[0].direction;
    let [above, below, lit, away] = [Vec3::Y, Vec3::NEG_Y, sun, -sun].map(|normal| around.ambient.at(normal));
    assert!(above.x > 3.0 * below.x && above.z > above.x, "{above} {below}");
    assert!(lit.x > lit.z && lit.x > 1.5 * away.x, "{lit} {away}");
}
