//! The nodes of fields and of meshes from meshes: what they hand to the libraries, and what they say where they cannot.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::path::Path;
use std::sync::Arc;

use glam::Vec3;
use pelage_field::{ColourField, ScalarField};
use pelage_graph::{Evaluator, Graph, Request};
use pelage_mesh::Mesh;
use proptest::prelude::*;

fn made<T: Send + Sync + 'static>(nodes: &str, output: &str) -> Result<Arc<T>, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs");
    let graph = Graph::parse(&format!("Graph(version: 1, nodes: {{{nodes}}})")).map_err(|fault| fault.to_string())?.with_directory(&folder);
    let checked = graph.check(&pelage_nodes::registry()).map_err(|faults| faults.to_string())?;
    let evaluation = Evaluator::new(1 << 28).run(&checked, &Request::output(output)).map_err(|error| error.to_string())?;
    evaluation.get::<T>(output).map_err(|error| error.to_string())
}

/// A ball with a field that rises from 0 at its foot to 1 at its top, and one of 0.25.
const BALL: &str =
    r#""ball": Sphere(subdivisions: 6), "a": ScalarRamp(mesh: "ball.mesh"), "b": ConstantField(mesh: "ball.mesh", value: 0.25), "#;

fn values(nodes: &str) -> Vec<f32> {
    made::<ScalarField>(&format!("{BALL}{nodes}"), "out.values").unwrap().values().to_vec()
}

#[test]
fn each_operation_does_what_it_says_with_a_field_and_with_a_number() {
    let a = values(r#""out": FieldMath(first: "a.values", operation: Add, number: 0.0)"#);
    type By = fn(f32) -> f32;
    let operations: [(&str, By); 9] = [
        ("Add", |a| a + 0.25),
        ("Subtract", |a| a - 0.25),
        ("Multiply", |a| a * 0.25),
        ("Divide", |a| a / 0.25),
        ("Least", |a| a.min(0.25)),
        ("Greatest", |a| a.max(0.25)),
        ("Difference", |a| (a - 0.25).abs()),
        ("Power", |a| a.powf(0.25)),
        ("Mix", |a| 0.5 * a + 0.125),
    ];
    for (operation, expected) in operations {
        let by_field = values(&format!(r#""out": FieldMath(first: "a.values", second: "b.values", operation: {operation})"#));
        let by_number = values(&format!(r#""out": FieldMath(first: "a.values", operation: {operation}, number: 0.25)"#));
        assert!(by_field == by_number, "{operation}");
        assert!(a.iter().zip(&by_field).all(|(&a, &value)| (expected(a) - value).abs() < 1e-6), "{operation}");
    }
    let mixed = values(r#""out": FieldMath(first: "b.values", second: "a.values", amounts: "a.values", operation: Mix)"#);
    assert!(a.iter().zip(&mixed).all(|(a, m)| ((1.0 - a) * 0.25 + a * a - m).abs() < 1e-6));
    let error = made::<ScalarField>(
        &format!("{BALL}{}", r#""out": FieldMath(first: "b.values", second: "a.values", operation: Divide)"#),
        "out.values",
    )
    .unwrap_err();
    assert!(error.contains("\"out\"") && error.contains("not finite"), "{error}");
}

#[test]
fn masks_remaps_and_noise_are_the_librarys() {
    let a = values(r#""out": RemapField(values: "a.values")"#);
    let mask = values(r#""out": MaskField(values: "a.values", threshold: 0.4, softness: 0.2)"#);
    let inverse = values(r#""out": MaskField(values: "a.values", threshold: 0.4, softness: 0.2, invert: true)"#);
    let field = ScalarField::new(a).unwrap();
    assert_eq!(mask, field.mask(0.4, 0.2).unwrap().values());
    assert!(mask.iter().zip(&inverse).all(|(m, i)| m + i == 1.0));
    let curve =
        values(r#""out": RemapField(values: "a.values", to: (2.0, 5.0), course: Curve(points: [(0.0, 1.0), (0.5, 0.0), (1.0, 1.0)]))"#);
    let expected = field.remapped((0.0, 1.0), (2.0, 5.0), &pelage_field::Course::Curve(vec![(0.0, 1.0), (0.5, 0.0), (1.0, 1.0)])).unwrap();
    assert_eq!(curve, expected.values());
    for (look, kind) in [("Perlin", pelage_field::NoiseKind::Perlin), ("Patches", pelage_field::NoiseKind::Patches)] {
        let noise =
            values(&format!(r#""out": NoiseField(mesh: "ball.mesh", look: {look}, size: 0.2, octaves: 2, roughness: 0.4, seed: 9)"#));
        let settings = pelage_field::Noise { kind, size: 0.2, octaves: 2, roughness: 0.4, seed: 9 };
        assert_eq!(noise, ScalarField::noise(&pelage_mesh::sphere(1.0, 6).unwrap(), &settings).unwrap().values());
    }
    assert_eq!(
        values(r#""out": NoiseField(mesh: "ball.mesh")"#),
        ScalarField::noise(&pelage_mesh::sphere(1.0, 6).unwrap(), &pelage_field::Noise::default()).unwrap().values()
    );
}

#[test]
fn colours_are_mixed_measured_and_blurred() {
    let nodes = format!(
        "{BALL}{}",
        r#""mix": MixColours(amounts: "b.values", first_colour: (1.0, 0.0, 0.0), second: "ramp.colours"),
        "ramp": ColourRamp(mesh: "ball.mesh", from: (0.0, 0.0, 1.0), to: (0.0, 0.0, 1.0)), "red": ColourAmount(colours: "mix.colours", measure: Red),
        "light": ColourAmount(colours: "mix.colours"), "soft": BlurColours(mesh: "ball.mesh", colours: "mix.colours", radius: 0.3)"#
    );
    let mixed = made::<ColourField>(&nodes, "mix.colours").unwrap();
    assert!(mixed.values().iter().all(|c| c.distance(Vec3::new(0.75, 0.0, 0.25)) < 1e-6));
    assert!(made::<ScalarField>(&nodes, "red.values").unwrap().values().iter().all(|v| (v - 0.75).abs() < 1e-6));
    let light = 0.75 * 0.2126 + 0.25 * 0.0722;
    assert!(made::<ScalarField>(&nodes, "light.values").unwrap().values().iter().all(|v| (v - light).abs() < 1e-6));
    // What is one colour stays so.
    assert!(made::<ColourField>(&nodes, "soft.colours").unwrap().values().iter().all(|c| c.distance(Vec3::new(0.75, 0.0, 0.25)) < 1e-5));
}

#[test]
fn strokes_say_which_one_is_off_the_surface() {
    let good = values(
        r#""out": StrokeField(mesh: "ball.mesh", strokes: [(points: [(0.0, 1.0, 0.0)], radius: 0.2, value: 3.0)], background: 1.0)"#,
    );
    assert!(good.contains(&3.0) && good.contains(&1.0));
    let off = format!(
        "{BALL}{}",
        r#""out": StrokeField(mesh: "ball.mesh", strokes: [(points: [(0.0, 1.0, 0.0)]), (points: [(0.0, 3.0, 0.0)])])"#
    );
    let error = made::<ScalarField>(&off, "out.values").unwrap_err();
    assert!(error.contains("stroke 1: point 0") && error.contains("off the surface"), "{error}");
    let distances = made::<ScalarField>(&off.replace("3.0, 0.0", "-1.0, 0.0"), "out.distances").unwrap();
    assert!(distances.values().iter().all(|d| (0.0..0.5).contains(d)));
}

#[test]
fn a_field_of_another_mesh_is_refused() {
    let two = format!(
        "{BALL}{}",
        r#""ring": Torus(), "c": ConstantField(mesh: "ring.mesh"), "out": FieldMath(first: "a.values", second: "c.values")"#
    );
    let error = made::<ScalarField>(&two, "out.values").unwrap_err();
    assert!(error.contains("same mesh"), "{error}");
    let blur = format!("{BALL}{}", r#""ring": Torus(), "out": BlurField(mesh: "ring.mesh", values: "a.values")"#);
    assert!(made::<ScalarField>(&blur, "out.values").is_err());
    let error = made::<ColourField>(&format!("{BALL}{}", r#""out": VertexColours(mesh: "ball.mesh")"#), "out.colours").unwrap_err();
    assert!(error.contains("no colours of its own"), "{error}");
}

#[test]
fn meshes_are_made_of_meshes() {
    let nodes = r#""ball": Sphere(subdivisions: 8), "fine": Subdivide(mesh: "ball.mesh", times: 2), "few": Simplify(mesh: "fine.mesh", share: 0.1),
        "moved": Transform(mesh: "few.mesh", scale: (-2.0, 1.0, 1.0), turn: (0.0, 90.0, 0.0), shift: (5.0, 0.0, 0.0)), "both": Join(first: "moved.mesh", second: "ball.mesh")"#;
    let [ball, fine, few, moved, both] =
        ["ball", "fine", "few", "moved", "both"].map(|node| made::<Mesh>(nodes, &format!("{node}.mesh")).unwrap());
    let faces = |mesh: &Mesh| mesh.topology().face_count();
    assert_eq!((faces(&fine), faces(&both)), (16 * faces(&ball), faces(&few) + faces(&ball)));
    assert!(faces(&few) <= faces(&fine) / 10 + 1);
    // Twice as long along x, which the turn about y brings to −z.
    let (low, high) = moved.bounds().unwrap();
    assert!(
        (high.z - low.z - 4.0).abs() < 0.1 && (0.5 * (low.x + high.x) - 5.0).abs() < 0.05 && moved.signed_volume() > 0.0,
        "{low} {high}"
    );
    let error = made::<Mesh>(r#""ball": Sphere(), "out": Transform(mesh: "ball.mesh", scale: (1.0, 0.0, 1.0))"#, "out.mesh").unwrap_err();
    assert!(error.contains("flat"), "{error}");
    let error = made::<Mesh>(r#""ball": Sphere(subdivisions: 60), "out": Subdivide(mesh: "ball.mesh", times: 8)"#, "out.mesh").unwrap_err();
    assert!(error.contains("8000000"), "{error}");
}

#[test]
fn a_gltf_model_has_its_materials_colours() {
    let model = r#""model": GltfFile(path: "models/caterpillar.glb")"#;
    let [colours, lengths] = [
        made::<ColourField>(model, "model.colours").map(|c| c.values().to_vec()),
        made::<ScalarField>(model, "model.lengths").map(|v| v.values().iter().map(|&l| Vec3::splat(l)).collect()),
    ]
    .map(Result::unwrap);
    let mesh = made::<Mesh>(model, "model.mesh").unwrap();
    assert_eq!(mesh.components().iter().count(), 11);
    let (mut rust, mut black, mut eyes) = (0, 0, 0);
    for (colour, length) in colours.iter().zip(&lengths) {
        if length.x == 0.0 {
            assert!(colour.distance(Vec3::new(0.72, 0.5, 0.1)) < 1e-6);
            eyes += 1;
        } else if colour.x > 0.3 {
            assert!(colour.x > 2.0 * colour.y && colour.y > 2.0 * colour.z, "{colour}");
            rust += 1;
        } else {
            assert!(colour.max_element() < 0.06, "{colour}");
            black += 1;
        }
    }
    assert!(rust > 800 && black > 1000 && eyes > 500, "{rust} {black} {eyes}");
}

/// A model in text names its buffer; the graph has to as well, so that a change of the buffer is one of the graph.
#[test]
fn files_beside_a_gltf_model_are_those_that_the_graph_lists() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "parts/corners.bin"}]}"#;
    std::fs::write(folder.path().join("model.gltf"), text).unwrap();
    std::fs::create_dir(folder.path().join("parts")).unwrap();
    let corners = [0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    std::fs::write(folder.path().join("parts/corners.bin"), corners.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>()).unwrap();
    let node = |beside: &str| {
        format!("\"model\": GltfFile(path: {:?}, beside: [{beside}])", folder.path().join("model.gltf").display().to_string())
    };
    let error = made::<Mesh>(&node(""), "model.mesh").unwrap_err();
    assert!(error.contains("model.gltf") && error.contains("list it in `beside`, as \"parts/corners.bin\""), "{error}");
    let listed = format!("{:?}", folder.path().join("parts/corners.bin").display().to_string());
    assert_eq!(made::<Mesh>(&node(&listed), "model.mesh").unwrap().area(), 0.5);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    /// Any numbers in a field's parameters give values or a fault, and no panic.
    #[test]
    fn any_parameters_give_values_or_say_why(kind in 0..6_usize, numbers in prop::collection::vec(prop_oneof![Just(0.0), Just(-1000.0), Just(1000.0), Just(1e9), Just(1e-9), -2.0..2.0_f64], 4)) {
        let [a, b, c, d] = [numbers[0], numbers[1], numbers[2], numbers[3]];
        let node = [
            format!(r#"NoiseField(mesh: "ball.mesh", size: {a:?}, roughness: {b:?})"#),
            format!(r#"RemapField(values: "a.values", from: ({a:?}, {b:?}), to: ({c:?}, {d:?}), course: Waves(count: {d:?}))"#),
            format!(r#"MaskField(values: "a.values", threshold: {a:?}, softness: {b:?})"#),
            format!(r#"BlurField(mesh: "ball.mesh", values: "a.values", radius: {a:?})"#),
            format!(r#"StrokeField(mesh: "ball.mesh", strokes: [(points: [({a:?}, {b:?}, {c:?})], radius: {d:?}, softness: {a:?}, value: {b:?})])"#),
            format!(r#"FieldMath(first: "a.values", number: {a:?}, operation: Power)"#),
        ][kind].clone();
        match made::<ScalarField>(&format!("{BALL}\"out\": {node}"), "out.values") {
            Ok(field) => prop_assert!(field.values().iter().all(|v| v.is_finite())),
            Err(error) => prop_assert!(error.len() > 20, "{}", error),
        }
    }
}
