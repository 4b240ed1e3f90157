//! Table 1 as printed in Lengyel, Praun, Finkelstein and Hoppe 2001 (*Real-time fur over arbitrary surfaces*, section 4).

use serde_json::{Value, json};

use super::row::line;

/// What it was measured on.
const MACHINE: &str = "AMD-K7 at 700 MHz, NVIDIA GeForce DDR 32 MB, DirectX 7, 2001";

/// Model, faces, edges, patches, frames per second with half and with all of the layers, and how many those are.
const TABLE_1: [(&str, [u64; 3], [u64; 2], u64); 6] = [
    ("bunny", [5000, 7547, 306], [23, 12], 16),
    ("cat", [5000, 7500, 252], [26, 14], 16),
    ("spider", [5000, 7500, 338], [31, 15], 16),
    ("dog", [5000, 7500, 192], [20, 10], 16),
    ("chimp", [4910, 7365, 228], [21, 11], 16),
    ("die", [1450, 2400, 246], [25, 13], 32),
];

/// The paper's rows in the columns of ours, under what they were measured on.
pub(crate) fn table() -> String {
    let mut text = format!("\nthe paper's Table 1, on its own hardware ({MACHINE})\n");
    for (model, counts, [half, all], layers) in TABLE_1 {
        let rate = |fps: u64, layers: u64| format!("{fps} fps {:.0} ms ({layers})", 1000.0 / fps as f64);
        text += &line(&format!("the paper's {model}"), counts, [&rate(half, layers / 2), &rate(all, layers)], "-", "-");
    }
    text
}

pub(crate) fn to_json() -> Value {
    let rows = TABLE_1.map(|(model, [faces, edges, patches], [half, all], layers)| {
        json!({
            "model": model, "faces": faces, "edges": edges, "patches": patches,
            "half_layers": { "layers": layers / 2, "fps": half }, "all_layers": { "layers": layers, "fps": all },
        })
    });
    json!({ "hardware": MACHINE, "models": rows })
}
