//! What has to run: from the outputs asked for back to what is at hand.
//!
//! Everything is done port by port. The key of a port is the hash of all that its value depends on, the keys of the ports
//! it draws from included; so what is wanted is in the key, and a run that wants more of a node shares what a run that wanted less has
//! made. Three sweeps over the topological order: back to see what is asked for, forth to make keys, back to see what has to be computed.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use crate::cache::Cache;
use crate::check::{Bound, CheckedGraph, CheckedNode, Source};
use crate::evaluation::EvaluateError;
use crate::files::resolved;
use crate::key::{Files, Key, KeyHasher};
use crate::literal::Literal;
use crate::node::{Fetched, Fields, NodeError, Params};
use crate::spec::Arity;
use crate::value::Value;

/// Why the key of a node cannot be made.
pub(crate) fn failed(node: &CheckedNode, source: impl Into<NodeError>) -> EvaluateError {
    EvaluateError::Node { node: node.id.clone(), kind: node.kind.specification.kind.clone(), source: source.into() }
}

/// Gives the context values that a node declares.
pub(crate) type ContextOf<'c> = dyn FnMut(&str) -> Result<Option<Literal>, NodeError> + 'c;

/// What one port depends on.
#[derive(Clone, Default)]
struct Port {
    asked: bool,
    key: Option<Key>,
}

/// The steps of a run.
pub(crate) struct Plan {
    /// Keys of all asked ports.
    pub(crate) keys: Vec<Vec<Option<Key>>>,
    /// For each node the ports it has to make; steps in topological order, so that those which do not depend on each other
    /// could run side by side.
    pub(crate) make: Vec<Vec<usize>>,
    /// Values at hand.
    pub(crate) have: HashMap<Key, Value>,
}

/// Whether `output` of the node draws on its field number `field`. Parameters and required inputs have part in every output.
pub(crate) fn draws(node: &CheckedNode, needs: &Params<'_>, field: usize, output: usize) -> bool {
    let specification = &node.kind.specification;
    match specification.inputs.get(field) {
        Some(input) if input.arity != Arity::One => (node.kind.needs)(&input.name, &specification.outputs[output].name, needs),
        _ => true,
    }
}

/// The fields as far as they are known before anything has run, for `needs` to look at.
pub(crate) fn known_fields<'n>(node: &'n CheckedNode, directory: &Path) -> Fields<'n> {
    let specification = &node.kind.specification;
    let fetched = node.fields.iter().enumerate().map(|(index, bound)| match bound {
        Bound::Absent => Fetched::Absent,
        Bound::Link(_) | Bound::Links(_) => Fetched::Pending,
        Bound::Literal(literal) => {
            let param = specification.params.get(index.wrapping_sub(specification.inputs.len()));
            Fetched::Literal(param.map_or_else(|| literal.clone(), |param| resolved(&param.ty, literal, directory)))
        }
    });
    Fields { specification, fetched: fetched.collect() }
}

pub(crate) fn plan(graph: &CheckedGraph, asked: &[Source], cache: &mut Cache, context: &mut ContextOf<'_>) -> Result<Plan, EvaluateError> {
    let known: Vec<Fields<'_>> = graph.nodes.iter().map(|node| known_fields(node, &graph.directory)).collect();
    let mut ports: Vec<Vec<Port>> = graph.nodes.iter().map(|node| vec![Port::default(); node.types.len()]).collect();
    for source in asked {
        ports[source.node][source.port].asked = true;
    }
    // Back: a port that is asked asks for the ports it draws on.
    for (index, node) in graph.nodes.iter().enumerate().rev() {
        for output in (0..node.types.len()).filter(|&output| ports[index][output].asked).collect::<Vec<_>>() {
            for (field, bound) in node.fields.iter().enumerate() {
                if draws(node, &Params { fields: &known[index] }, field, output) {
                    for source in bound.sources() {
                        ports[source.node][source.port].asked = true;
                    }
                }
            }
        }
    }
    // Forth: keys. Of equal ports the first is the one to compute.
    let mut first: HashMap<Key, Source> = HashMap::new();
    let mut files = Files::new();
    for (index, node) in graph.nodes.iter().enumerate() {
        if !ports[index].iter().any(|port| port.asked) {
            continue;
        }
        let base = base_key(node, &known[index], &mut files, context)?;
        for output in 0..node.types.len() {
            if ports[index][output].asked {
                let key = port_key(node, &known[index], output, base.clone(), &ports);
                ports[index][output].key = Some(key);
                first.entry(key).or_insert(Source { node: index, port: output });
            }
        }
    }
    // Back again: what is not at hand is to be made, and needs what it draws on.
    let mut have = HashMap::new();
    let mut make: Vec<Vec<usize>> = vec![Vec::new(); graph.nodes.len()];
    let mut required: Vec<Vec<bool>> = graph.nodes.iter().map(|node| vec![false; node.types.len()]).collect();
    let owner = |source: &Source, ports: &[Vec<Port>]| ports[source.node][source.port].key.and_then(|key| first.get(&key)).copied();
    for source in asked.iter().filter_map(|source| owner(source, &ports)) {
        required[source.node][source.port] = true;
    }
    for (index, node) in graph.nodes.iter().enumerate().rev() {
        for output in 0..node.types.len() {
            let Some(key) = ports[index][output].key.filter(|_| required[index][output]) else { continue };
            if let Some(value) = cache.get(&key) {
                have.insert(key, value);
                continue;
            }
            make[index].push(output);
            for (field, bound) in node.fields.iter().enumerate() {
                if draws(node, &Params { fields: &known[index] }, field, output) {
                    for source in bound.sources().iter().filter_map(|source| owner(source, &ports)) {
                        required[source.node][source.port] = true;
                    }
                }
            }
        }
    }
    let keys = ports.into_iter().map(|ports| ports.into_iter().map(|port| port.key).collect()).collect();
    Ok(Plan { keys, make, have })
}

/// All that every output of the node depends on: the kind and its version, written parameters and files, declared context.
fn base_key(node: &CheckedNode, known: &Fields<'_>, files: &mut Files, context: &mut ContextOf<'_>) -> Result<KeyHasher, EvaluateError> {
    let specification = &node.kind.specification;
    let mut hasher = KeyHasher::new();
    hasher.text(&specification.kind);
    hasher.number(specification.version.into());
    for name in &specification.context {
        hasher.text(name);
        match context(name).map_err(|source| failed(node, source))? {
            Some(value) => hasher.literal(&value),
            None => hasher.tag(0),
        }
    }
    for (param, fetched) in specification.params.iter().zip(&known.fetched[specification.inputs.len()..]) {
        if let Fetched::Literal(literal) = fetched {
            hasher.text(&param.name);
            hasher.param(&param.ty, literal, files).map_err(|source| failed(node, source))?;
        }
    }
    Ok(hasher)
}

/// Adds to `base` what the output draws on.
fn port_key(node: &CheckedNode, known: &Fields<'_>, output: usize, mut base: KeyHasher, ports: &[Vec<Port>]) -> Key {
    base.text(&node.kind.specification.outputs[output].name);
    for (field, (name, bound)) in node.kind.specification.field_names().zip(&node.fields).enumerate() {
        if bound.sources().is_empty() || !draws(node, &Params { fields: known }, field, output) {
            continue;
        }
        base.text(name);
        base.number(bound.sources().len() as u64);
        for key in bound.sources().iter().filter_map(|source| ports[source.node][source.port].key) {
            base.key(&key);
        }
    }
    base.finish()
}

/// Context values in order of name.
pub(crate) type ContextValues = BTreeMap<String, Literal>;
