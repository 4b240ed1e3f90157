//! glTF files made for tests.
#![allow(dead_code, reason = "each test file uses its own part")]

use serde_json::{Value, json};

/// A document and its one buffer, put together piece by piece.
pub(crate) struct Model {
    pub(crate) json: Value,
    pub(crate) bytes: Vec<u8>,
}

impl Model {
    /// A scene of one node without a mesh.
    pub(crate) fn new() -> Self {
        let json = json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }], "meshes": [],
            "accessors": [], "bufferViews": [],
        });
        Self { json, bytes: Vec::new() }
    }

    /// Two triangles that make the unit square of the xy plane, with texture coordinates that have v down, facing +z.
    pub(crate) fn square() -> Self {
        let mut model = Self::new();
        let position = model.floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0], "VEC3");
        let at = model.floats(&[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0], "VEC2");
        let indices = model.numbers(&[0, 1, 2, 0, 2, 3], 5121);
        model.mesh(&json!([{ "attributes": { "POSITION": position, "TEXCOORD_0": at }, "indices": indices }]));
        model
    }

    /// The number of an accessor with these bytes.
    pub(crate) fn accessor(&mut self, bytes: &[u8], mut accessor: Value) -> usize {
        while !self.bytes.len().is_multiple_of(4) {
            self.bytes.push(0);
        }
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        accessor["bufferView"] = views.len().into();
        views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend_from_slice(bytes);
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(accessor);
        accessors.len() - 1
    }

    pub(crate) fn floats(&mut self, floats: &[f32], kind: &str) -> usize {
        let components = kind.trim_start_matches("VEC").parse::<usize>().unwrap();
        let column = |k: usize| floats.iter().skip(k).step_by(components).copied();
        let least: Vec<f32> = (0..components).map(|k| column(k).fold(f32::MAX, f32::min)).collect();
        let most: Vec<f32> = (0..components).map(|k| column(k).fold(f32::MIN, f32::max)).collect();
        let bytes: Vec<u8> = floats.iter().flat_map(|x| x.to_le_bytes()).collect();
        let accessor = json!({ "componentType": 5126, "type": kind, "count": floats.len() / components, "min": least, "max": most });
        self.accessor(&bytes, accessor)
    }

    /// Indices: of 8 bits (5121), 16 (5123) or 32 (5125).
    pub(crate) fn numbers(&mut self, numbers: &[u32], kind: u32) -> usize {
        let size = [1, 2, 4][(kind as usize - 5121) / 2];
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()[..size].to_vec()).collect();
        self.accessor(&bytes, json!({ "componentType": kind, "type": "SCALAR", "count": numbers.len() }))
    }

    /// Adds a mesh of primitives.
    pub(crate) fn mesh(&mut self, primitives: &Value) {
        self.json["meshes"].as_array_mut().unwrap().push(json!({ "primitives": primitives }));
    }

    /// The document with the buffer in its text.
    pub(crate) fn document(&self) -> Value {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        json
    }

    /// A binary file.
    pub(crate) fn glb(&self) -> Vec<u8> {
        glb(&self.document(), &self.bytes)
    }
}

pub(crate) fn glb(json: &Value, bytes: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = bytes.to_vec();
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((12 + 8 + text.len() as u32 + 8 + bytes.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &bytes)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}
