//! Runs a graph up to its tiling, and prints what came of it.
#![allow(clippy::print_stdout, reason = "an example for a terminal")]

use pelage_graph::{Evaluator, Graph, Request};
use pelage_mesh::Mesh;
use pelage_patch::PatchTiling;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let graph = Graph::parse(
        r#"Graph(version: 1, nodes: {
            "ball": Sphere(subdivisions: 16),
            "combed": DirectionField(mesh: "ball.mesh", toward: (0.0, -1.0, 0.2)),
            "patches": GrowPatches(mesh: "ball.mesh", directions: "combed.directions"),
        })"#,
    )?;
    let checked = graph.check(&pelage_nodes::registry())?;
    let evaluation = Evaluator::new(64 << 20).run(&checked, &Request::output("patches.patches").and_output("ball.mesh"))?;
    let quality = evaluation.get::<PatchTiling>("patches.patches")?.quality(&*evaluation.get::<Mesh>("ball.mesh")?, None);
    println!(
        "{} patches, {} faces each at the median, stretch {:.3} at the median",
        quality.patch_count, quality.faces_per_patch_p50, quality.stretch_p50
    );
    Ok(())
}
