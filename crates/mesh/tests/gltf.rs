//! glTF import.
#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(feature = "gltf")]

mod glb;

use std::io;

use glam::{DVec2, DVec3, Vec4};
use glb::Model;
use pelage_mesh::{GltfFault, GltfImport, GltfNote, parse_gltf, read_gltf};
use serde_json::{Value, json};

fn parse(bytes: &[u8]) -> Result<GltfImport, GltfFault> {
    parse_gltf(bytes, &mut |_| Err(io::ErrorKind::NotFound.into())).map_err(|error| error.fault)
}

fn import(model: &Model) -> GltfImport {
    parse(&model.glb()).unwrap()
}

fn fault(model: &Model) -> GltfFault {
    parse(&model.glb()).unwrap_err()
}

/// The square with its document changed.
fn changed(path: &str, value: Value) -> Model {
    let mut model = Model::square();
    let (parent, key) = path.rsplit_once('/').unwrap();
    match model.json.pointer_mut(parent).unwrap() {
        Value::Array(items) => items[key.parse::<usize>().unwrap()] = value,
        other => other[key] = value,
    }
    model
}

#[test]
fn places_corners_and_texture_coordinates_are_those_of_the_file() {
    let import = import(&Model::square());
    assert_eq!(import.mesh.topology().triangles().collect::<Vec<_>>(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(import.mesh.positions(), [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y]);
    // v is down in the file, up here: so the picture lies on the square as x and y.
    for half_edge in import.mesh.half_edges() {
        assert_eq!(half_edge.texture_coordinates(), Some(half_edge.origin().position().truncate()));
    }
    assert!(import.repairs.is_none() && import.notes.is_empty() && import.images.is_empty());
    assert_eq!((import.materials.len(), import.material(1).base_colour), (1, Vec4::ONE));
}

#[test]
fn nodes_scale_turn_move_and_mirror() {
    let mut model = Model::square();
    // A child of a moved, turned and stretched parent: scaled first, turned a quarter about z, then moved; and the parent's own on top.
    model.json["nodes"] = json!([
        { "translation": [0.0, 0.0, 5.0], "scale": [2.0, 2.0, 2.0], "children": [1] },
        { "mesh": 0, "scale": [3.0, 1.0, 1.0], "rotation": [0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()], "translation": [1.0, 0.0, 0.0] },
    ]);
    let turned = import(&model).mesh;
    let expected = [[2.0, 0.0, 5.0], [2.0, 6.0, 5.0], [0.0, 6.0, 5.0], [0.0, 0.0, 5.0]].map(DVec3::from);
    assert!(turned.positions().iter().zip(expected).all(|(p, q)| p.distance(q) < 1e-5), "{:?}", turned.positions());
    // Mirrored, faces still show their outside to +z.
    model.json["nodes"] = json!([{ "mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }]);
    let mirrored = import(&model).mesh;
    assert!(mirrored.faces().all(|face| face.normal() == DVec3::Z) && mirrored.positions()[1] == DVec3::NEG_X);
    let at = |half_edge: pelage_mesh::HalfEdge<'_, pelage_mesh::Mesh>| half_edge.texture_coordinates().unwrap();
    assert!(mirrored.half_edges().all(|h| at(h) == h.origin().position().truncate() * DVec2::new(-1.0, 1.0)));
}

#[test]
fn every_way_of_listing_triangles_is_read() {
    let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let positions: Vec<f32> = square.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect();
    for (mode, numbers) in [(4, vec![0, 1, 2, 2, 1, 3]), (5, vec![0, 1, 2, 3]), (6, vec![0, 1, 3, 2])] {
        for kind in [5121, 5123, 5125] {
            let mut model = Model::new();
            let (position, indices) = (model.floats(&positions, "VEC3"), model.numbers(&numbers, kind));
            model.mesh(&json!([{ "attributes": { "POSITION": position }, "indices": indices, "mode": mode }]));
            let import = import(&model);
            assert!(import.repairs.is_none(), "mode {mode}: {}", import.repairs);
            assert!(import.mesh.area() == 1.0 && import.mesh.faces().all(|face| face.normal() == DVec3::Z), "mode {mode}, {kind}");
        }
    }
    // Without indices the vertices are the corners, in order.
    let mut model = Model::new();
    let position = model.floats(&positions[..9], "VEC3");
    model.mesh(&json!([{ "attributes": { "POSITION": position } }]));
    assert_eq!(import(&model).mesh.area(), 0.5);
}

#[test]
fn colours_materials_and_images_come_along() {
    let mut model = Model::square();
    let half = model.accessor(
        &[0, 51, 102, 255, 255, 255, 255, 0].repeat(2),
        json!({ "componentType": 5121, "type": "VEC4", "count": 4, "normalized": true }),
    );
    let second = model.floats(&[2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 2.0, 1.0, 0.0], "VEC3");
    model.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = half.into();
    model.json["meshes"][0]["primitives"][0]["material"] = 1.into();
    model.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(json!({ "attributes": { "POSITION": second } }));
    model.json["materials"] =
        json!([{}, { "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 1.0, 0.75], "baseColorTexture": { "index": 0 } } }]);
    model.json["textures"] = json!([{ "source": 0 }]);
    model.json["images"] = json!([{ "uri": "fur%20a.png" }]);
    let read = |name: &str| if name == "fur a.png" { Ok(b"pixels".to_vec()) } else { Err(io::ErrorKind::NotFound.into()) };
    let import = parse_gltf(&model.glb(), &mut { read }).unwrap();
    let colours = import.mesh.colours().unwrap();
    assert!(colours[0].distance(Vec4::new(0.0, 0.2, 0.4, 1.0)) < 1e-6 && colours[1] == Vec4::new(1.0, 1.0, 1.0, 0.0));
    // The second triangle has neither: it is white, at (0, 0), of the default material.
    assert_eq!(&colours[4..], [Vec4::ONE; 3]);
    assert_eq!(&import.mesh.texture_coordinates().unwrap()[6..], [DVec2::ZERO; 3]);
    assert_eq!(import.material_of_face, [0, 0, 1]);
    assert_eq!((import.material(0).base_colour, import.material(0).image), (Vec4::new(0.5, 0.25, 1.0, 0.75), Some(0)));
    assert_eq!((import.material(2).base_colour, import.material(2).image), (Vec4::ONE, None));
    assert_eq!((import.images[0].name.as_str(), import.images[0].bytes.as_slice()), ("fur a.png", b"pixels".as_slice()));
}

#[test]
fn vertices_of_a_texture_seam_are_welded_and_keep_their_coordinates() {
    let mut model = Model::new();
    let first = model.floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0], "VEC3");
    let at = model.floats(&[0.0, 1.0, 0.1, 1.0, 0.0, 0.9, 0.5, 0.5, 0.6, 0.4, 0.4, 0.4], "VEC2");
    let red = model.floats(&[1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0], "VEC3");
    model.mesh(&json!([{ "attributes": { "POSITION": first, "TEXCOORD_0": at, "COLOR_0": red } }]));
    let import = import(&model);
    assert_eq!((import.repairs.vertices_welded, import.mesh.topology().edge_count()), (2, 5));
    let at = |corner: usize| import.mesh.texture_coordinates().unwrap()[corner];
    assert!(at(1).distance(DVec2::new(0.1, 0.0)) < 1e-6 && at(3).distance(DVec2::new(0.5, 0.5)) < 1e-6);
    // Where colours differ at one place, theirs is the mean; what stays alone keeps its own.
    assert_eq!(
        import.mesh.colours().unwrap(),
        [Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(0.5, 0.0, 0.5, 1.0), Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(1.0, 0.0, 0.0, 1.0)]
    );
}

#[test]
fn data_in_the_text_and_files_beside_it_are_the_same() {
    let model = Model::square();
    let whole = import(&model);
    use base64::Engine;
    let data = base64::engine::general_purpose::STANDARD.encode(&model.bytes);
    let mut json = model.document();
    json["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{data}").into();
    assert_eq!(parse(json.to_string().as_bytes()).unwrap(), whole);
    json["buffers"][0]["uri"] = "parts/square.bin".into();
    let folder = std::env::temp_dir().join(format!("pelage-gltf-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("parts")).unwrap();
    std::fs::write(folder.join("square.gltf"), json.to_string()).unwrap();
    let missing = read_gltf(&folder.join("square.gltf")).unwrap_err().to_string();
    assert!(missing.contains("square.gltf: ") && missing.contains("parts/square.bin"), "{missing}");
    std::fs::write(folder.join("parts/square.bin"), &model.bytes).unwrap();
    assert_eq!(read_gltf(&folder.join("square.gltf")).unwrap(), whole);
    std::fs::remove_dir_all(&folder).unwrap();
    for uri in ["../square.bin", "/etc/passwd", "https://example.org/square.bin", "a/../../b", "c:\\x", "", "%2e%2e/x", "data:,plain"] {
        json["buffers"][0]["uri"] = uri.into();
        let refused = parse_gltf(json.to_string().as_bytes(), &mut |_| Ok(model.bytes.clone())).unwrap_err().fault;
        assert!(matches!(refused, GltfFault::Elsewhere { .. } | GltfFault::Data { .. }), "{uri}: {refused}");
    }
}

#[test]
fn what_is_not_read_is_said() {
    let mut model = Model::square();
    model.json["nodes"] = json!([{ "mesh": 0, "skin": 0, "translation": [9.0, 0.0, 0.0] }, {}]);
    model.json["skins"] = json!([{ "joints": [1] }]);
    model.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    model.json["extensionsUsed"] = json!(["KHR_materials_sheen"]);
    let lines = json!({ "attributes": { "POSITION": 0 }, "mode": 1 });
    model.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(lines);
    let import = import(&model);
    let expected = [
        GltfNote::NotTriangles { primitives: 1 },
        GltfNote::Skins { meshes: 1 },
        GltfNote::MorphTargets { primitives: 1 },
        GltfNote::Extensions { names: "KHR_materials_sheen".to_owned() },
    ];
    assert_eq!(import.notes, expected);
    // As bound, whatever the node says.
    assert_eq!(import.mesh.positions()[0], DVec3::ZERO);
}

#[test]
fn a_file_that_gives_no_mesh_says_why() {
    assert!(matches!(parse(b"no glTF"), Err(GltfFault::Broken(_))));
    assert!(matches!(parse(b""), Err(GltfFault::Broken(_))));
    assert!(matches!(parse(b"glTF\x02\0\0\0\x05\0\0\0"), Err(GltfFault::CutShort { said: 5, there: 12 })));
    let sparse = json!({ "count": 1, "indices": { "bufferView": 2, "componentType": 5121 }, "values": { "bufferView": 0 } });
    assert!(matches!(fault(&changed("/accessors/0/sparse", sparse)), GltfFault::Sparse { accessor: 0 }));
    assert!(matches!(fault(&changed("/accessors/0/count", json!(5))), GltfFault::OutOfBuffer { .. }));
    assert!(matches!(fault(&changed("/accessors/0/count", json!(u64::MAX))), GltfFault::OutOfBuffer { .. }));
    assert!(matches!(fault(&changed("/accessors/0/byteOffset", json!(u64::MAX))), GltfFault::OutOfBuffer { .. }));
    assert!(matches!(fault(&changed("/bufferViews/0/byteLength", json!(1e9 as u64))), GltfFault::OutOfBuffer { .. }));
    assert!(matches!(fault(&changed("/accessors/0/componentType", json!(5123))), GltfFault::Kind { accessor: 0, .. }));
    assert!(matches!(fault(&changed("/accessors/2/type", json!("VEC2"))), GltfFault::Kind { accessor: 2, .. }));
    assert!(matches!(fault(&changed("/accessors/1/count", json!(3))), GltfFault::Count { found: 3, positions: 4, .. }));
    assert!(matches!(fault(&changed("/nodes/0/children", json!([0]))), GltfFault::NodeTwice { node: 0 }));
    assert!(matches!(fault(&changed("/nodes", json!([{}]))), GltfFault::NoFaces));
    assert!(matches!(fault(&changed("/meshes/0/primitives/0/mode", json!(0))), GltfFault::NoFaces));
    assert!(matches!(fault(&changed("/meshes/0/primitives/0/indices", json!(7))), GltfFault::Broken(_)));
    let needed = fault(&changed("/extensionsRequired", json!(["KHR_draco_mesh_compression"])));
    assert!(needed.to_string().contains("KHR_draco_mesh_compression"), "{needed}");
    let mut model = Model::square();
    model.bytes[48..52].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(matches!(fault(&model), GltfFault::NotFinite { vertex: 0, what: "texture coordinates", .. }));
    let mut model = Model::square();
    model.bytes[12..16].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert!(matches!(fault(&model), GltfFault::NotFinite { mesh: 0, primitive: 0, vertex: 1, what: "coordinates" }));
    let mut model = Model::square();
    let last = model.bytes.len() - 1;
    model.bytes[last] = 200;
    assert!(matches!(fault(&model), GltfFault::VertexOutOfRange { index: 200, count: 4, .. }));
    // No binary part.
    let document = Model::square().document();
    assert!(matches!(parse(document.to_string().as_bytes()), Err(GltfFault::NoBinary { buffer: 0 })));
}

/// A mesh of a thousand triangles shown by a hundred thousand nodes, which are a few megabytes: refused before it is made.
#[test]
fn a_file_cannot_ask_for_any_number_of_faces() {
    let mut model = Model::new();
    let position = model.floats(&[0.0; 9], "VEC3");
    let indices = model.numbers(&[0, 1, 2].repeat(1000), 5121);
    model.mesh(&json!([{ "attributes": { "POSITION": position }, "indices": indices }]));
    let nodes: Vec<Value> = (0..100_000).map(|_| json!({ "mesh": 0 })).collect();
    model.json["scenes"] = json!([{ "nodes": (0..100_000).collect::<Vec<_>>() }]);
    model.json["nodes"] = nodes.into();
    assert!(matches!(fault(&model), GltfFault::TooManyFaces));
}

/// Every prefix of a file, and every byte of it changed, gives a mesh or an error.
#[test]
fn nothing_that_is_cut_or_changed_panics() {
    let mut model = Model::square();
    model.json["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    model.json["textures"] = json!([{ "source": 0 }]);
    model.json["images"] = json!([{ "bufferView": 1, "mimeType": "image/png" }]);
    model.json["meshes"][0]["primitives"][0]["material"] = 0.into();
    let file = model.glb();
    assert!(parse(&file).is_ok());
    let mut meshes = 0;
    for end in 0..file.len() {
        meshes += usize::from(parse(&file[..end]).is_ok());
    }
    assert_eq!(meshes, 0);
    for place in 0..file.len() {
        for byte in [0, b'9', b'"', 0xff, file[place] ^ 1] {
            let mut changed = file.clone();
            changed[place] = byte;
            meshes += usize::from(parse(&changed).is_ok());
        }
    }
    assert!(meshes > 100, "{meshes}");
}
