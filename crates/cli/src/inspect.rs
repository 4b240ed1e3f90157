//! `pelage inspect`.

use std::path::{Path, PathBuf};

use clap::Args;
use pelage_mesh::{Mesh, Quality, RepairReport, Summary, read_gltf, read_obj};
use serde_json::json;

use crate::failure::Failure;
use crate::output::print;

#[derive(Args)]
pub(crate) struct Inspect {
    /// The model: Wavefront OBJ, or glTF where its name ends in `.glb` or `.gltf`.
    #[arg(value_name = "MODEL")]
    model: PathBuf,
    /// As JSON.
    #[arg(long)]
    json: bool,
}

/// What is looked at, whichever format it came in.
struct Import {
    mesh: Mesh,
    repairs: RepairReport,
    notes: Vec<String>,
}

impl Import {
    fn read(path: &Path) -> Result<Self, Failure> {
        let is_gltf = path.extension().is_some_and(|end| ["glb", "gltf"].iter().any(|known| end.eq_ignore_ascii_case(known)));
        if is_gltf {
            let import = read_gltf(path).map_err(|error| Failure::Input(error.to_string()))?;
            return Ok(Self { mesh: import.mesh, repairs: import.repairs, notes: import.notes.iter().map(ToString::to_string).collect() });
        }
        let import = read_obj(path).map_err(|error| Failure::Input(error.to_string()))?;
        Ok(Self { mesh: import.mesh, repairs: import.repairs, notes: import.notes.iter().map(ToString::to_string).collect() })
    }
}

impl Inspect {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let import = Import::read(&self.model)?;
        let (summary, quality) = (Summary::of(&import.mesh), Quality::of(&import.mesh));
        if self.json {
            return print(&format!("{:#}\n", as_json(&import, &summary, &quality)));
        }
        print(&as_text(&import, &summary, &quality))
    }
}

fn as_text(import: &Import, summary: &Summary, quality: &Quality) -> String {
    let lines = [
        ("vertices", summary.vertices.to_string()),
        ("edges", summary.edges.to_string()),
        ("faces", summary.faces.to_string()),
        ("boundary loops", summary.boundary_loops.to_string()),
        ("components", summary.components.to_string()),
        ("genus", summary.genus.to_string()),
        ("Euler characteristic", summary.euler_characteristic.to_string()),
        ("diameter", number(summary.diameter)),
        ("area", number(summary.area)),
        ("mean edge", number(summary.mean_edge_length)),
        ("edges, longest/least", number(quality.edge_ratio)),
        ("angles, degrees", format!("{:.2} to {:.2}", quality.angle_min_deg, quality.angle_max_deg)),
        ("aspect R/2r, median", number(quality.aspect_p50)),
        ("aspect R/2r, 99 %", number(quality.aspect_p99)),
        ("aspect R/2r, worst", number(quality.aspect_max)),
        ("valence", format!("{} to {}", quality.valence_min, quality.valence_max)),
    ];
    let mut text = lines.map(|(name, value)| format!("{name:<22}{value:>18}\n")).concat();
    text += "repairs";
    for line in import.repairs.to_string().lines() {
        text += &format!("\n  {line}");
    }
    for note in &import.notes {
        text += &format!("\nnote: {note}");
    }
    text + "\n"
}

/// Six digits, whatever the model's scale.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e7).contains(&value.abs()) { format!("{value:.6}") } else { format!("{value:.5e}") }
}

fn as_json(import: &Import, summary: &Summary, quality: &Quality) -> serde_json::Value {
    json!({
        "vertices": summary.vertices, "unreferenced_vertices": summary.unreferenced_vertices, "edges": summary.edges, "faces": summary.faces,
        "boundary_loops": summary.boundary_loops, "components": summary.components, "euler_characteristic": summary.euler_characteristic,
        "genus": summary.genus, "boundary_edges": summary.boundary_edges,
        "area": summary.area, "diameter": summary.diameter,
        "repairs": pelage_nodes::repair_counts(&import.repairs),
        "notes": import.notes,
        "quality": {
            "faces_without_area": summary.faces_without_area, "mean_edge_length": summary.mean_edge_length,
            "edge_ratio": quality.edge_ratio, "angle_min_deg": quality.angle_min_deg, "angle_max_deg": quality.angle_max_deg,
            "aspect_p50": quality.aspect_p50, "aspect_p99": quality.aspect_p99, "aspect_max": quality.aspect_max,
            "valence_min": quality.valence_min, "valence_max": quality.valence_max,
        },
    })
}
