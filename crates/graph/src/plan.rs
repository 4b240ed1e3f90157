//! What has to run: from the outputs asked for back to what is at hand.
//!
//! Everything is done port by port. The key of a port is the hash of all that its value depends on, the keys of the ports
//! it draws from included; so what is wanted is in the key, and a run that wants more of a node shares what a run that wanted less has
//! made. Three sweeps over the topological order: back to see what is asked for, forth to make keys, back to see what has to be computed.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use crate::cache::{Age, Cache};
use crate::check::{Bound, CheckedGraph, CheckedNode, Source};
use crate::evaluation::NodeFailure;
use crate::files::resolved;
use crate::key::{Files, Key, KeyHasher};
use crate::literal::Literal;
use crate::node::{Fetched, Fields, NodeError, Params};
use crate::schedule::Order;
use crate::spec::Arity;
use crate::value::Value;

/// Why the key of a node cannot be made.
pub(crate) fn failed(node: &CheckedNode, source: impl Into<NodeError>) -> NodeFailure {
    NodeFailure { node: node.id.clone(), kind: node.kind.specification.kind.clone(), source: source.into() }
}

/// Gives the context values that a node declares.
pub(crate) type ContextOf<'c> = dyn FnMut(&str) -> Result<Option<Literal>, NodeError> + 'c;

/// Keys of all asked ports, by node and port.
pub(crate) type Keys = Vec<Vec<Option<Key>>>;

/// An output that has to be made.
pub(crate) struct Make {
    pub(crate) port: usize,
    pub(crate) key: Key,
    /// Its age in the cache.
    pub(crate) age: Age,
}

/// A node that has to run.
pub(crate) struct Step {
    pub(crate) node: usize,
    pub(crate) make: Vec<Make>,
    /// Keys of all it draws on.
    pub(crate) draws: BTreeSet<Key>,
}

/// What a run has to do.
pub(crate) struct Plan {
    pub(crate) keys: Keys,
    /// In topological order. No two make the same key.
    pub(crate) steps: Vec<Step>,
    /// Values of earlier runs that steps draw on or that are asked for.
    pub(crate) have: HashMap<Key, Value>,
}

impl Plan {
    /// Which steps wait for which.
    pub(crate) fn order(&self) -> Order {
        let makers = self.steps.iter().enumerate().flat_map(|(index, step)| step.make.iter().map(move |make| (make.key, index)));
        let makers: HashMap<Key, usize> = makers.collect();
        let before = |step: &Step| step.draws.iter().filter_map(|key| makers.get(key)).copied().collect();
        Order::new(&self.steps.iter().map(before).collect::<Vec<_>>())
    }
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

/// Plans the making of `asked`.
///
/// Errors: every node whose key cannot be made, as its files or its context cannot be had.
pub(crate) fn plan(
    graph: &CheckedGraph,
    asked: &[Source],
    cache: &mut Cache,
    context: &mut ContextOf<'_>,
) -> Result<Plan, Vec<NodeFailure>> {
    let known: Vec<Fields<'_>> = graph.nodes.iter().map(|node| known_fields(node, &graph.directory)).collect();
    let keys = keys(graph, &known, &wanted(graph, &known, asked), context)?;
    let mut plan = steps(graph, &known, asked, keys, cache);
    for make in plan.steps.iter_mut().flat_map(|step| &mut step.make) {
        make.age = cache.next_age();
    }
    Ok(plan)
}

/// Sources of the fields that an output draws on.
fn sources<'n>(node: &'n CheckedNode, known: &'n Fields<'n>, output: usize) -> impl Iterator<Item = &'n Source> {
    let drawn = move |(field, _): &(usize, &Bound)| draws(node, &Params { fields: known }, *field, output);
    let linked = node.fields.iter().enumerate().filter(|(_, bound)| !bound.sources().is_empty());
    linked.filter(drawn).flat_map(|(_, bound)| bound.sources())
}

/// Back: a port that is asked for asks for the ports it draws on.
fn wanted(graph: &CheckedGraph, known: &[Fields<'_>], asked: &[Source]) -> Vec<Vec<bool>> {
    let mut wanted: Vec<Vec<bool>> = graph.nodes.iter().map(|node| vec![false; node.types.len()]).collect();
    for source in asked {
        wanted[source.node][source.port] = true;
    }
    for (index, node) in graph.nodes.iter().enumerate().rev() {
        for output in (0..node.types.len()).filter(|&output| wanted[index][output]).collect::<Vec<_>>() {
            for source in sources(node, &known[index], output) {
                wanted[source.node][source.port] = true;
            }
        }
    }
    wanted
}

/// Forth: the key of every wanted port.
fn keys(graph: &CheckedGraph, known: &[Fields<'_>], wanted: &[Vec<bool>], context: &mut ContextOf<'_>) -> Result<Keys, Vec<NodeFailure>> {
    let mut keys: Keys = graph.nodes.iter().map(|node| vec![None; node.types.len()]).collect();
    let mut files = Files::new();
    let mut failures = Vec::new();
    for (index, node) in graph.nodes.iter().enumerate().filter(|(index, _)| wanted[*index].contains(&true)) {
        match base_key(node, &known[index], &mut files, context) {
            Ok(base) => {
                for output in (0..node.types.len()).filter(|&output| wanted[index][output]) {
                    keys[index][output] = Some(port_key(node, &known[index], output, base.clone(), &keys));
                }
            }
            Err(failure) => failures.push(failure),
        }
    }
    if failures.is_empty() { Ok(keys) } else { Err(failures) }
}

/// Back again: what is not at hand is to be made, and requires what it draws on. Of equal ports the first is made.
fn steps(graph: &CheckedGraph, known: &[Fields<'_>], asked: &[Source], keys: Keys, cache: &mut Cache) -> Plan {
    let mut first: HashMap<Key, Source> = HashMap::new();
    for (node, ports) in keys.iter().enumerate() {
        for (port, key) in ports.iter().enumerate() {
            if let Some(key) = key {
                first.entry(*key).or_insert(Source { node, port });
            }
        }
    }
    let key = |source: &Source| keys[source.node][source.port];
    let mut required: BTreeSet<(usize, usize)> = BTreeSet::new();
    let require = |key: Option<Key>, required: &mut BTreeSet<(usize, usize)>| {
        required.extend(key.and_then(|key| first.get(&key)).map(|source| (source.node, source.port)));
    };
    asked.iter().for_each(|source| require(key(source), &mut required));
    let (mut have, mut steps) = (HashMap::new(), Vec::new());
    for (index, node) in graph.nodes.iter().enumerate().rev() {
        let mut step = Step { node: index, make: Vec::new(), draws: BTreeSet::new() };
        for (output, own) in keys[index].iter().enumerate() {
            let Some(own) = own.filter(|_| required.contains(&(index, output))) else { continue };
            if let Some(value) = cache.get(&own) {
                have.insert(own, value);
                continue;
            }
            step.make.push(Make { port: output, key: own, age: 0 });
            for drawn in sources(node, &known[index], output).filter_map(key) {
                step.draws.insert(drawn);
                require(Some(drawn), &mut required);
            }
        }
        if !step.make.is_empty() {
            steps.push(step);
        }
    }
    steps.reverse();
    Plan { keys, steps, have }
}

/// All that every output of the node depends on: the kind and its version, written parameters and files, declared context.
fn base_key(node: &CheckedNode, known: &Fields<'_>, files: &mut Files, context: &mut ContextOf<'_>) -> Result<KeyHasher, NodeFailure> {
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
fn port_key(node: &CheckedNode, known: &Fields<'_>, output: usize, mut base: KeyHasher, keys: &Keys) -> Key {
    base.text(&node.kind.specification.outputs[output].name);
    for (field, (name, bound)) in node.kind.specification.field_names().zip(&node.fields).enumerate() {
        if bound.sources().is_empty() || !draws(node, &Params { fields: known }, field, output) {
            continue;
        }
        base.text(name);
        base.number(bound.sources().len() as u64);
        for key in bound.sources().iter().filter_map(|source| keys[source.node][source.port]) {
            base.key(&key);
        }
    }
    base.finish()
}

/// Context values in order of name.
pub(crate) type ContextValues = BTreeMap<String, Literal>;
