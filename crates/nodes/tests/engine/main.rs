//! The engine with the nodes of fur, nothing drawn: any number of threads gives the same bytes, and no graph of any nodes panics.
#![allow(clippy::unwrap_used, clippy::panic, reason = "clippy excuses test functions only, not what they call")]

mod generator;
mod random;
mod saved;

use pelage_coat::{Coat, FinTexture, Lights, ShellTexture};
use pelage_creature::Creature;
use pelage_field::{ColourField, DirectionField, ScalarField};
use pelage_graph::{CheckedGraph, EvaluateError, Evaluation, Evaluator, Registry, Request, Value};
use pelage_lighting::Shading;
use pelage_mesh::Mesh;
use pelage_nodes::Framing;
use pelage_patch::PatchTiling;
use pelage_strand::StrandTile;

/// All of a value: Rust writes a number with as many digits as it takes to tell it from every other.
fn print(value: &Value) -> String {
    macro_rules! first_of {
        ($($ty:ty),*) => {
            None$(.or_else(|| value.downcast_ref::<$ty>().map(|value| format!("{value:?}"))))*
        };
    }
    let printed = first_of!(
        Mesh,
        DirectionField,
        ScalarField,
        ColourField,
        PatchTiling,
        StrandTile,
        ShellTexture,
        FinTexture,
        Coat,
        Framing,
        Lights,
        Shading,
        pelage_mesh::RepairReport,
        pelage_nodes::Curves,
        pelage_patch::LappedPatches,
        pelage_nodes::CurlReport,
        pelage_nodes::OneLayerReport
    );
    #[cfg(feature = "gpu")]
    let printed = printed.or_else(|| first_of!(pelage_nodes::Quality));
    // Its shapes show in where its skin is and in how fur lies on it.
    let creature = || value.downcast_ref::<Creature>().map(|creature| format!("{:?} {:?}", creature.mesh(), creature.lie()));
    printed.or_else(creature).unwrap_or_else(|| panic!("{} cannot be compared", value.type_name()))
}

/// Asks for every output of the nodes that draw nothing.
fn everything(graph: &CheckedGraph) -> Request {
    let drawing: Vec<&str> = graph
        .nodes()
        .filter(|(_, kind)| ["RenderImage", "ReferenceImage", "SideBySide"].contains(kind))
        .map(|(id, _)| id.as_str())
        .collect();
    let outputs = graph.outputs().map(|(name, _)| name).filter(|name| !drawing.contains(&name.split('.').next().unwrap()));
    outputs.fold(Request::default(), |request, output| request.and_output(&output))
}

/// The key and the hash of every value, or why there are none.
fn outcome(result: Result<Evaluation, EvaluateError>) -> Result<Vec<(String, u64)>, String> {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let evaluation = result.map_err(|error| error.to_string())?;
    let keys = evaluation.trace().iter().flat_map(|entry| entry.keys.iter().map(|(port, key)| format!("{}.{port} {key}", entry.node)));
    let hash = |value: &Value| {
        let mut hasher = DefaultHasher::new();
        print(value).hash(&mut hasher);
        hasher.finish()
    };
    Ok(keys.zip(evaluation.values().map(|(_, _, value)| hash(value))).collect())
}

/// The outcome with so many nodes at a time.
fn with_threads(graph: &CheckedGraph, threads: usize) -> Result<Vec<(String, u64)>, String> {
    outcome(Evaluator::new(0).threads(threads).run(graph, &everything(graph)))
}

fn registry() -> Registry {
    pelage_nodes::registry()
}
