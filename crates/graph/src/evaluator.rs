//! Runs what has to run, and keeps what came of it.

use std::collections::{BTreeMap, HashMap};
use std::time::Instant;

use crate::cache::{Cache, CacheUse};
use crate::check::{Bound, CheckedGraph, Source};
use crate::context::{Cancelled, Context};
use crate::evaluation::{EvaluateError, Evaluation, State, TraceEntry};
use crate::fault::nearest;
use crate::key::Key;
use crate::literal::Literal;
use crate::node::{Fetched, Fields, NodeError, Params};
use crate::plan::{ContextValues, Plan, draws, failed, known_fields, plan};
use crate::request::Request;
use crate::resources::Resources;
use crate::value::Value;

type MakeContext = Box<dyn Fn(&Resources) -> Result<Literal, NodeError> + Send + Sync>;

/// Evaluates graphs, and keeps values from run to run within a bound of bytes.
///
/// Only what is asked for runs, and only if no equal value is at hand. The result depends on the graph, the files it names and the
/// context alone: not on the ids or layout of the nodes, on earlier runs, or on the order in which nodes run.
pub struct Evaluator {
    cache: Cache,
    resources: Resources,
    makers: BTreeMap<String, MakeContext>,
    made: BTreeMap<String, Literal>,
}

/// An output that is wanted and that the node did not make.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the node made no {0:?}, which is wanted")]
pub struct NotMade(
    /// The port.
    pub String,
);

impl Evaluator {
    /// An evaluator whose cache keeps at most `budget` bytes.
    pub fn new(budget: usize) -> Self {
        Self { cache: Cache::new(budget), resources: Resources::default(), makers: BTreeMap::new(), made: BTreeMap::new() }
    }

    /// With a resource that nodes get by [`Context::resource`], made when the first asks for it.
    #[must_use]
    pub fn resource<R, E>(mut self, make: impl Fn() -> Result<R, E> + Send + Sync + 'static) -> Self
    where
        R: Send + Sync + 'static,
        E: Into<NodeError>,
    {
        self.resources.provide(make);
        self
    }

    /// With a context value that is made when a node that is asked for declares it, such as the name of the graphics adapter, without
    /// which no adapter need be looked for. A request's own value goes before it.
    #[must_use]
    pub fn context_value(mut self, name: &str, make: impl Fn(&Resources) -> Result<Literal, NodeError> + Send + Sync + 'static) -> Self {
        self.makers.insert(name.to_owned(), Box::new(make));
        self
    }

    /// The shared resources, for the program's own use.
    pub fn resources(&self) -> &Resources {
        &self.resources
    }

    /// How full the cache is.
    pub fn cache(&self) -> CacheUse {
        self.cache.usage()
    }

    /// Forgets all values.
    pub fn clear_cache(&mut self) {
        self.cache.clear();
    }

    /// Evaluates what `request` asks for.
    ///
    /// # Errors
    /// If there is no such output, a node fails (the first in topological order), or the run is cancelled. What was computed before stays
    /// in the cache.
    pub fn run(&mut self, graph: &CheckedGraph, request: &Request) -> Result<Evaluation, EvaluateError> {
        let asked = asked(graph, request)?;
        let mut values = request.context.clone();
        let (makers, made, resources) = (&self.makers, &mut self.made, &self.resources);
        let mut context = |name: &str| -> Result<Option<Literal>, NodeError> {
            if let Some(value) = values.get(name) {
                return Ok(Some(value.clone()));
            }
            let Some(make) = makers.get(name) else { return Ok(None) };
            let value = match made.get(name) {
                Some(value) => value.clone(),
                None => made.entry(name.to_owned()).or_insert(make(resources)?).clone(),
            };
            values.insert(name.to_owned(), value.clone());
            Ok(Some(value))
        };
        let mut plan = plan(graph, &asked, &mut self.cache, &mut context)?;
        let ms = self.execute(graph, request, &values, &mut plan)?;
        Ok(self.collect(graph, request, &plan, &ms))
    }

    /// Runs the steps of the plan in order; milliseconds of each node that ran.
    fn execute(
        &mut self,
        graph: &CheckedGraph,
        request: &Request,
        values: &ContextValues,
        plan: &mut Plan,
    ) -> Result<Vec<Option<f64>>, EvaluateError> {
        let total = plan.make.iter().filter(|ports| !ports.is_empty()).count();
        let mut ms = vec![None; graph.nodes.len()];
        let steps = graph.nodes.iter().enumerate().filter(|(index, _)| !plan.make[*index].is_empty()).collect::<Vec<_>>();
        for (done, (index, node)) in steps.into_iter().enumerate() {
            if request.cancel.is_cancelled() {
                return Err(EvaluateError::Cancelled);
            }
            let observer = request.observer.as_deref();
            if let Some(observer) = observer {
                observer.started(&node.id, done, total);
            }
            let ports = &plan.make[index];
            let wanted: Vec<&str> = ports.iter().map(|&port| node.kind.specification.outputs[port].name.as_str()).collect();
            let mut cx = Context {
                node: &node.id,
                wanted: &wanted,
                declared: &node.kind.specification.context,
                values,
                resources: &self.resources,
                cancel: &request.cancel,
                observer,
            };
            let fields = fetch(graph, index, plan);
            let start = Instant::now();
            let made = (node.kind.run)(&fields, &mut cx);
            let elapsed = start.elapsed().as_secs_f64() * 1e3;
            let made = made.map_err(|source| match source.downcast_ref::<Cancelled>() {
                Some(_) => EvaluateError::Cancelled,
                None => failed(node, source),
            })?;
            for &port in ports {
                let name = &node.kind.specification.outputs[port].name;
                let value = made.iter().find(|(port, _)| port == name).and_then(|(_, value)| value.clone());
                let value = value.ok_or_else(|| failed(node, NotMade(name.clone())))?;
                let value = match &node.types[port] {
                    Some(ty) => value.measured(ty),
                    None => value,
                };
                if let Some(key) = plan.keys[index][port] {
                    self.cache.insert(key, value.clone());
                    plan.have.insert(key, value);
                }
            }
            ms[index] = Some(elapsed);
            if let Some(observer) = observer {
                observer.finished(&self.trace_entry(graph, index, plan, ms[index]));
            }
        }
        Ok(ms)
    }

    /// The value of a key: of this run, or kept from an earlier one.
    fn at_hand<'v>(&'v self, have: &'v HashMap<Key, Value>, key: &Key) -> Option<&'v Value> {
        have.get(key).or_else(|| self.cache.peek(key))
    }

    fn trace_entry(&self, graph: &CheckedGraph, index: usize, plan: &Plan, ms: Option<f64>) -> TraceEntry {
        let node = &graph.nodes[index];
        let named = node.kind.specification.outputs.iter().zip(&plan.keys[index]);
        let keys: Vec<(String, Key)> = named.filter_map(|(output, key)| Some((output.name.clone(), (*key)?))).collect();
        let values: Vec<&Value> = keys.iter().filter_map(|(_, key)| self.at_hand(&plan.have, key)).collect();
        let state = match ms {
            Some(_) => State::Computed,
            None if !keys.is_empty() && values.len() == keys.len() => State::Hit,
            None => State::NotNeeded,
        };
        let bytes = values.iter().map(|value| value.bytes()).sum();
        TraceEntry { node: node.id.clone(), kind: node.kind.specification.kind.clone(), state, ms: ms.unwrap_or(0.0), bytes, keys }
    }

    fn collect(&self, graph: &CheckedGraph, request: &Request, plan: &Plan, ms: &[Option<f64>]) -> Evaluation {
        let mut evaluation = Evaluation { values: Vec::new(), by_name: HashMap::new(), main: main_name(graph, request), trace: Vec::new() };
        for (id, &index) in &graph.by_id {
            let entry = self.trace_entry(graph, index, plan, ms[index]);
            for (port, key) in &entry.keys {
                if let Some(value) = self.at_hand(&plan.have, key) {
                    evaluation.by_name.insert(format!("{id}.{port}"), evaluation.values.len());
                    evaluation.values.push((id.clone(), port.clone(), value.clone()));
                }
            }
            evaluation.trace.push(entry);
        }
        evaluation
    }
}

/// The outputs asked for.
fn asked(graph: &CheckedGraph, request: &Request) -> Result<Vec<Source>, EvaluateError> {
    if request.outputs.is_empty() {
        return graph.main.map(|main| vec![main]).ok_or(EvaluateError::NoMainOutput);
    }
    let find = |output: &String| {
        graph.source(output).ok_or_else(|| {
            let known: Vec<String> = graph.outputs().map(|(name, _)| name).collect();
            EvaluateError::NoSuchOutput { output: output.clone(), nearest: nearest(output, known.iter().map(String::as_str)) }
        })
    };
    request.outputs.iter().map(find).collect()
}

/// The one output that [`Evaluation::main`] gives: the first asked for, or the graph's own.
fn main_name(graph: &CheckedGraph, request: &Request) -> Option<String> {
    request.outputs.first().cloned().or_else(|| {
        let main = graph.main?;
        let node = &graph.nodes[main.node];
        Some(format!("{}.{}", node.id, node.kind.specification.outputs[main.port].name))
    })
}

/// The node's fields, filled with the values of the ports they are linked to.
fn fetch<'g>(graph: &'g CheckedGraph, index: usize, plan: &Plan) -> Fields<'g> {
    let node = &graph.nodes[index];
    let known = known_fields(node, &graph.directory);
    let value = |source: &Source| plan.keys[source.node][source.port].and_then(|key| plan.have.get(&key)).cloned();
    let drawn = |field| plan.make[index].iter().any(|&output| draws(node, &Params { fields: &known }, field, output));
    let linked: Vec<Option<Fetched>> = node
        .fields
        .iter()
        .enumerate()
        .map(|(field, bound)| match bound {
            Bound::Absent | Bound::Literal(_) => None,
            Bound::Link(_) | Bound::Links(_) if !drawn(field) => Some(Fetched::Absent),
            Bound::Link(source) => Some(value(source).map_or(Fetched::Absent, Fetched::Linked)),
            Bound::Links(sources) => Some(Fetched::List(sources.iter().filter_map(value).collect())),
        })
        .collect();
    let fetched = known.fetched.into_iter().zip(linked).map(|(known, linked)| linked.unwrap_or(known)).collect();
    Fields { specification: known.specification, fetched }
}
