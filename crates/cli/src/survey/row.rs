//! A row of the table, as text and as JSON.

use serde_json::{Value, json};

use super::pipeline::Drawn;

/// What there is to say about a model.
pub(crate) struct Row {
    pub(crate) faces: u64,
    pub(crate) edges: u64,
    pub(crate) patches: u64,
    pub(crate) half: Rate,
    pub(crate) all: Rate,
    pub(crate) fins: (u64, u64),
    pub(crate) texture_bytes: u64,
}

/// How fast it is drawn.
pub(crate) struct Rate {
    layers: u64,
    ms_min: f64,
    ms_median: f64,
    ms_max: f64,
}

impl Rate {
    fn of(drawn: &Drawn) -> Self {
        let ms = |key: &str| drawn.stats.figure(&format!("/frame/{key}")).and_then(Value::as_f64).unwrap_or(f64::NAN);
        Self { layers: drawn.layers, ms_min: ms("ms_min"), ms_median: ms("ms_median"), ms_max: ms("ms_max") }
    }

    fn fps(&self) -> f64 {
        1000.0 / self.ms_median
    }

    fn to_json(&self) -> Value {
        let Self { layers, ms_min, ms_median, ms_max } = self;
        json!({ "layers": layers, "fps": self.fps(), "ms_min": ms_min, "ms_median": ms_median, "ms_max": ms_max })
    }
}

impl Row {
    pub(crate) fn new(all: &Drawn, half: &Drawn) -> Self {
        let count = |key: &str| all.stats.figure(key).and_then(Value::as_u64).unwrap_or_default();
        Self {
            faces: count("/model/faces"),
            edges: count("/model/edges"),
            patches: count("/patches/count"),
            half: Rate::of(half),
            all: Rate::of(all),
            fins: (count("/frame/fins_drawn"), count("/frame/fins_considered")),
            texture_bytes: count("/textures/total_bytes"),
        }
    }

    pub(crate) fn to_line(&self, model: &str) -> String {
        let rate = |rate: &Rate| format!("{:.1} fps {:.1} ms ({})", rate.fps(), rate.ms_median, rate.layers);
        let fins = format!("{} of {}", self.fins.0, self.fins.1);
        line(model, [self.faces, self.edges, self.patches], [&rate(&self.half), &rate(&self.all)], &fins, &self.texture_bytes.to_string())
    }

    pub(crate) fn to_json(&self, model: &str) -> Value {
        json!({
            "model": model, "faces": self.faces, "edges": self.edges, "patches": self.patches,
            "half_layers": self.half.to_json(), "all_layers": self.all.to_json(),
            "fins_drawn": self.fins.0, "fins_considered": self.fins.1, "texture_bytes": self.texture_bytes,
        })
    }
}

/// The names of the columns.
pub(crate) fn head() -> String {
    let [faces, edges, patches] = ["faces", "edges", "patches"];
    format!(
        "{:<28}{faces:>8}{edges:>8}{patches:>8}{:>24}{:>24}{:>16}{:>14}\n",
        "model", "half the layers", "all layers", "fins drawn", "texture bytes"
    )
}

/// A row in those columns.
pub(crate) fn line(model: &str, counts: [u64; 3], rates: [&str; 2], fins: &str, texture_bytes: &str) -> String {
    let [faces, edges, patches] = counts;
    format!("{model:<28}{faces:>8}{edges:>8}{patches:>8}{:>24}{:>24}{fins:>16}{texture_bytes:>14}\n", rates[0], rates[1])
}
