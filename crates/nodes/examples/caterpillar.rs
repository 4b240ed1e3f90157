//! Draws `graphs/models/caterpillar.glb`: a woolly bear of balls, each a node that shows one of three meshes of the same vertices, with an embedded image and, for the
//! eyes, colours at the vertices.
//!
//! `cargo run -p pelage-nodes --example caterpillar -- graphs/models/caterpillar.glb`

use std::error::Error;
use std::f32::consts::{PI, TAU};
use std::io::Cursor;

use image::{ImageFormat, Rgba, RgbaImage};
use serde_json::{Value, json};

/// Cells around a ball and from pole to pole.
const AROUND: u32 = 24;
const DOWN: u32 = 14;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("where to? give a path")?;
    let mut file = File::default();
    let ball = ball();
    let position = file.floats(&ball.positions, "VEC3");
    let at = file.floats(&ball.coordinates, "VEC2");
    let amber: Vec<f32> = [0.72, 0.5, 0.1, 0.0].repeat(ball.positions.len() / 3);
    let amber = file.floats(&amber, "VEC4");
    let indices = file.indices(&ball.indices);
    let coat = file.view(&coat()?);
    let primitive =
        |material: u32| json!([{ "attributes": { "POSITION": position, "TEXCOORD_0": at }, "indices": indices, "material": material }]);
    let eye = json!([{ "attributes": { "POSITION": position, "COLOR_0": amber }, "indices": indices }]);
    let material = |red: f64, green: f64, blue: f64| json!({ "pbrMetallicRoughness": { "baseColorFactor": [red, green, blue, 1.0], "baseColorTexture": { "index": 0 } } });
    let nodes = nodes();
    let scene = json!({
        "asset": { "version": "2.0", "generator": "pelage-nodes, example caterpillar", "copyright": "The Pelage authors, MIT OR Apache-2.0" },
        "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": nodes,
        "meshes": [{ "primitives": primitive(0) }, { "primitives": primitive(1) }, { "primitives": eye }],
        "materials": [material(0.62, 0.2, 0.045), material(0.035, 0.028, 0.026)],
        "textures": [{ "source": 0 }], "images": [{ "bufferView": coat, "mimeType": "image/png" }],
        "accessors": file.accessors, "bufferViews": file.views, "buffers": [{ "byteLength": file.bytes.len() }],
    });
    std::fs::write(path, glb(&scene, file.bytes))?;
    Ok(())
}

/// The body, head and eyes, below a node that bends nothing but holds them: it looks along +z.
fn nodes() -> Vec<Value> {
    const SEGMENTS: usize = 9;
    let mut nodes = Vec::new();
    for k in 0..SEGMENTS {
        // From the rump to the head, in an arch that lifts a little in the middle and at the head.
        let along = k as f32 / (SEGMENTS - 1) as f32;
        let (z, x) = (2.2 * (along - 0.5), 0.22 * (4.0 * along).sin());
        let lift = 0.10 * (PI * along).sin() + 0.16 * (along - 0.72).max(0.0) / 0.28;
        let round = 0.30 - 0.07 * (2.0 * along - 1.0).powi(2) - if k == 0 { 0.04 } else { 0.0 };
        // Black at both ends, rust between, as the moth's are.
        let mesh = if (3..6).contains(&k) { 0 } else { 1 };
        let turn = 0.5 * (0.88 * (4.0 * along).cos() / 2.2).atan();
        nodes.push(json!({
            "mesh": mesh, "translation": [x, round + lift, z], "scale": [round, 0.94 * round, 1.08 * round],
            "rotation": [0.0, turn.sin(), 0.0, turn.cos()],
        }));
    }
    let head = [0.22 * 4.0_f32.sin(), 0.23 + 0.16, 1.1];
    for side in [-1.0, 1.0] {
        nodes.push(
            json!({ "mesh": 2, "translation": [head[0] + 0.13 * side, head[1] + 0.12, head[2] + 0.26], "scale": [0.075, 0.075, 0.075] }),
        );
    }
    let children: Vec<usize> = (1..=nodes.len()).collect();
    nodes.insert(0, json!({ "children": children }));
    nodes
}

struct Ball {
    positions: Vec<f32>,
    coordinates: Vec<f32>,
    indices: Vec<u16>,
}

/// Poles before and behind, the seam below; u around from the belly, v from before to behind.
fn ball() -> Ball {
    let (mut positions, mut coordinates, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..=DOWN {
        for j in 0..=AROUND {
            let (u, v) = (j as f32 / AROUND as f32, i as f32 / DOWN as f32);
            let (turn, fall) = (TAU * u, PI * v);
            // The seam's two sides are one place, and so is a pole.
            let ring = if i == 0 || i == DOWN { 0.0 } else { fall.sin() };
            let (sin, cos) = if j == AROUND { (0.0, 1.0) } else { turn.sin_cos() };
            positions.extend([ring * sin, -ring * cos, fall.cos()]);
            coordinates.extend([u, v]);
        }
    }
    let vertex = |i: u32, j: u32| (i * (AROUND + 1) + j) as u16;
    for i in 0..DOWN {
        for j in 0..AROUND {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            if i < DOWN - 1 {
                indices.extend([a, b, c]);
            }
            if i > 0 {
                indices.extend([a, c, d]);
            }
        }
    }
    Ball { positions, coordinates, indices }
}

/// Pale bristles in tufts on the flanks, and short hair below: a PNG file, u from belly over the back to the belly.
fn coat() -> Result<Vec<u8>, image::ImageError> {
    let pixels = RgbaImage::from_fn(128, 32, |x, _| {
        let around = (x as f32 + 0.5) / 128.0;
        let back = 0.5 - 0.5 * (TAU * around).cos();
        let pale = (1.0 - (around - 0.5).abs() / 0.07).clamp(0.0, 1.0);
        let shade = |light: f32| (255.0 * (light + (1.0 - light) * 0.25 * pale)).round() as u8;
        let length = (255.0 * (0.35 + 0.65 * back.sqrt())).round() as u8;
        Rgba([shade(0.78 + 0.2 * back), shade(0.76 + 0.2 * back), shade(0.72 + 0.2 * back), length])
    });
    let mut file = Cursor::new(Vec::new());
    pixels.write_to(&mut file, ImageFormat::Png)?;
    Ok(file.into_inner())
}

/// The binary part and what is said of it.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl File {
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend_from_slice(bytes);
        self.views.len() - 1
    }

    fn floats(&mut self, numbers: &[f32], kind: &str) -> usize {
        let width = if kind == "VEC2" {
            2
        } else if kind == "VEC3" {
            3
        } else {
            4
        };
        let view = self.view(&numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>());
        let end = |k: usize, least: bool| {
            numbers
                .iter()
                .skip(k)
                .step_by(width)
                .copied()
                .fold(if least { f32::MAX } else { f32::MIN }, if least { f32::min } else { f32::max })
        };
        let [least, most] = [true, false].map(|least| (0..width).map(|k| end(k, least)).collect::<Vec<f32>>());
        self.accessors.push(
            json!({ "bufferView": view, "componentType": 5126, "type": kind, "count": numbers.len() / width, "min": least, "max": most }),
        );
        self.accessors.len() - 1
    }

    fn indices(&mut self, numbers: &[u16]) -> usize {
        let view = self.view(&numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>());
        self.accessors.push(json!({ "bufferView": view, "componentType": 5123, "type": "SCALAR", "count": numbers.len() }));
        self.accessors.len() - 1
    }
}

/// A binary file of a document and its buffer.
fn glb(document: &Value, mut bytes: Vec<u8>) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((28 + text.len() as u32 + bytes.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &bytes)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend_from_slice(kind);
        file.extend_from_slice(chunk);
    }
    file
}
