//! What has to run: from the outputs asked for back to what is at hand.
//!
//! Everything is done port by port. The key of a port is the hash of all that its value depends on, the parts that are made of it and the keys of the ports
//! it draws from included; so what is wanted is in the key, and a run that wants more of a node shares what a run that wanted less has
//! made. Three sweeps over the topological order: back to see what is asked for, forth to make keys, back to see what has to be computed.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use crate::cache::{Age, Cache};
use crate::check::{Bound, CheckedGraph, CheckedNode, Source};
use crate::demand::{AllDemands, Asked, Demand, demands};
use crate::evaluation::NodeFailure;
use crate::files::resolved;
use crate::key::{Files, Key, KeyHasher};
use crate::literal::Literal;
use crate::needs::PartSet;
use crate::node::{Fetched, Fields, NodeError};
use crate::schedule::Order;
use crate::value::Value;

/// Why the key of a node cannot be made.
pub(crate) fn failed(node: &CheckedNode, source: impl Into<NodeError>) -> NodeFailure {
    NodeFailure { node: node.id.clone(), kind: node.kind.specification.kind.clone(), source: source.into() }
}

/// Gives the context values that a node declares.
pub(crate) type ContextOf<'c> = dyn FnMut(&str) -> Result<Option<Literal>, NodeError> + 'c;

/// Keys of the values of all asked ports, by node and port.
pub(crate) type Keys = Vec<Vec<Option<Key>>>;

/// Keys of all ports, by node and port, one for each of its demands.
type DemandKeys = Vec<Vec<Vec<Key>>>;

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
    pub(crate) demands: AllDemands,
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

/// The fields as far as they are known before anything has run, for [`needs`](crate::Evaluate::needs) to look at.
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
    asked: &[Asked],
    cache: &mut Cache,
    context: &mut ContextOf<'_>,
) -> Result<Plan, Vec<NodeFailure>> {
    let (demands, keys) = demanded(graph, asked, context)?;
    let mut plan = steps(graph, asked, demands, keys, cache);
    for make in plan.steps.iter_mut().flat_map(|step| &mut step.make) {
        make.age = cache.next_age();
    }
    Ok(plan)
}

/// The keys of all ports that the making of `asked` would have.
///
/// Errors: those of [`plan`].
pub(crate) fn output_keys(graph: &CheckedGraph, asked: &[Asked], context: &mut ContextOf<'_>) -> Result<Keys, Vec<NodeFailure>> {
    demanded(graph, asked, context).map(|(_, keys)| keys)
}

/// What is asked of every port, and the keys of what is.
fn demanded(graph: &CheckedGraph, asked: &[Asked], context: &mut ContextOf<'_>) -> Result<(AllDemands, Keys), Vec<NodeFailure>> {
    let known: Vec<Fields<'_>> = graph.nodes.iter().map(|node| known_fields(node, &graph.directory)).collect();
    let demands = demands(graph, &known, asked);
    let keys = keys(graph, &known, &demands, context)?;
    // What is made of a port is what all want of it together.
    let keys = keys.into_iter().map(|ports| ports.into_iter().map(|keys| keys.last().copied()).collect()).collect();
    Ok((demands, keys))
}

/// Forth: the keys of every wanted port.
fn keys(
    graph: &CheckedGraph,
    known: &[Fields<'_>],
    demands: &AllDemands,
    context: &mut ContextOf<'_>,
) -> Result<DemandKeys, Vec<NodeFailure>> {
    let mut keys: DemandKeys = graph.nodes.iter().map(|node| vec![Vec::new(); node.types.len()]).collect();
    let mut files = Files::new();
    let mut failures = Vec::new();
    let is_wanted = |index: usize| demands[index].iter().any(|demands| demands.together().is_some());
    for (index, node) in graph.nodes.iter().enumerate().filter(|(index, _)| is_wanted(*index)) {
        let base = match base_key(node, &known[index], &mut files, context) {
            Ok(base) => base,
            Err(failure) => {
                failures.push(failure);
                continue;
            }
        };
        for port in 0..node.types.len() {
            let key_of = |source: &Source, parts: &PartSet| {
                let place = demands[source.node][source.port].place(parts)?;
                keys[source.node][source.port].get(place).copied()
            };
            let each = demands[index][port].each().iter();
            keys[index][port] = each.map(|demand| port_key(graph, node, port, demand, base.clone(), &key_of)).collect();
        }
    }
    if failures.is_empty() { Ok(keys) } else { Err(failures) }
}

/// Back again: what is not at hand is to be made, and requires what it draws on. Of equal ports the first is made.
fn steps(graph: &CheckedGraph, asked: &[Asked], demands: AllDemands, keys: Keys, cache: &mut Cache) -> Plan {
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
    asked.iter().for_each(|asked| require(key(&asked.source), &mut required));
    let (mut have, mut steps) = (HashMap::new(), Vec::new());
    for (index, node) in graph.nodes.iter().enumerate().rev() {
        let mut step = Step { node: index, make: Vec::new(), draws: BTreeSet::new() };
        for (output, own) in keys[index].iter().enumerate() {
            let (Some(own), Some(demand)) = (own, demands[index][output].together()) else { continue };
            if !required.contains(&(index, output)) {
                continue;
            }
            if let Some(value) = cache.get(own) {
                have.insert(*own, value);
                continue;
            }
            step.make.push(Make { port: output, key: *own, age: 0 });
            for drawn in demand.all_sources(graph, node).filter_map(|(source, _)| key(source)) {
                step.draws.insert(drawn);
                require(Some(drawn), &mut required);
            }
        }
        if !step.make.is_empty() {
            steps.push(step);
        }
    }
    steps.reverse();
    Plan { demands, keys, steps, have }
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

/// Adds to `base` which parts of the output are made, and what it draws on.
fn port_key(
    graph: &CheckedGraph,
    node: &CheckedNode,
    port: usize,
    demand: &Demand,
    mut base: KeyHasher,
    key_of: &dyn Fn(&Source, &PartSet) -> Option<Key>,
) -> Key {
    let output = &node.kind.specification.outputs[port];
    base.text(&output.name);
    base.number(demand.made.len() as u64);
    demand.made.iter().for_each(|&place| base.text(output.parts[place].name));
    for (field, name) in node.kind.specification.field_names().enumerate() {
        let sources: Vec<_> = demand.sources(graph, node, field).collect();
        if sources.is_empty() {
            continue;
        }
        base.text(name);
        base.number(sources.len() as u64);
        for key in sources.iter().filter_map(|(source, parts)| key_of(source, parts)) {
            base.key(&key);
        }
    }
    base.finish()
}

/// Context values in order of name.
pub(crate) type ContextValues = BTreeMap<String, Literal>;
