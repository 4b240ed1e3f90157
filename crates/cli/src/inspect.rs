//! `pelage inspect`.

use std::path::PathBuf;

use clap::Args;
use pelage_mesh::{Summary, read_obj};
use serde_json::json;

use crate::failure::Failure;
use crate::output::print;

#[derive(Args)]
pub(crate) struct Inspect {
    /// The model.
    #[arg(value_name = "MODEL.obj")]
    model: PathBuf,
    /// As JSON.
    #[arg(long)]
    json: bool,
}

impl Inspect {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let mesh = read_obj(&self.model).map_err(|error| Failure::Input(error.to_string()))?.mesh;
        let summary = Summary::of(&mesh);
        if self.json {
            return print(&format!("{:#}\n", as_json(&summary)));
        }
        print(&as_text(&summary))
    }
}

fn as_text(summary: &Summary) -> String {
    let lines = [
        ("vertices", summary.vertices.to_string()),
        ("unreferenced", summary.unreferenced_vertices.to_string()),
        ("edges", summary.edges.to_string()),
        ("faces", summary.faces.to_string()),
        ("without area", summary.faces_without_area.to_string()),
        ("boundary loops", summary.boundary_loops.to_string()),
        ("components", summary.components.to_string()),
        ("genus", summary.genus.to_string()),
        ("Euler characteristic", summary.euler_characteristic.to_string()),
        ("diameter", format!("{:.6}", summary.diameter)),
        ("area", format!("{:.6}", summary.area)),
        ("mean edge", format!("{:.6}", summary.mean_edge_length)),
    ];
    lines.map(|(name, value)| format!("{name:<22}{value:>14}\n")).concat()
}

fn as_json(summary: &Summary) -> serde_json::Value {
    json!({
        "vertices": summary.vertices, "unreferenced_vertices": summary.unreferenced_vertices, "edges": summary.edges, "faces": summary.faces,
        "boundary_loops": summary.boundary_loops, "components": summary.components, "euler_characteristic": summary.euler_characteristic,
        "genus": summary.genus, "boundary_edges": summary.boundary_edges,
        "area": summary.area, "diameter": summary.diameter,
        "quality": { "faces_without_area": summary.faces_without_area, "mean_edge_length": summary.mean_edge_length },
    })
}
