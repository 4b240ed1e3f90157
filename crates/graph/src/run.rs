//! One run: the steps of a plan, several at a time, and what comes of them.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use crate::cache::Cache;
use crate::check::{Bound, CheckedGraph, CheckedNode, Source};
use crate::context::{Cancelled, Context};
use crate::demand::{Asked, Demand};
use crate::evaluation::{EvaluateError, Evaluation, NodeFailure, PortParts, State, TraceEntry};
use crate::key::Key;
use crate::needs::{PartSet, Wanted};
use crate::node::{Fetched, Fields};
use crate::plan::{ContextValues, Plan, Step, failed, known_fields};
use crate::registry::Ports;
use crate::request::Request;
use crate::resources::Resources;
use crate::value::Value;

/// An output that is wanted and that the node did not make.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the node made no {0:?}, which is wanted")]
pub struct NotMade(
    /// The port.
    pub String,
);

pub(crate) struct Run<'r> {
    graph: &'r CheckedGraph,
    request: &'r Request,
    plan: Plan,
    values: &'r ContextValues,
    resources: &'r Resources,
    board: Mutex<Board<'r>>,
    /// Nodes done. Held while the observer is told, so that it hears one thing at a time and never of fewer nodes than before.
    done: Mutex<usize>,
}

/// What the threads of a run share.
struct Board<'r> {
    cache: &'r mut Cache,
    /// Values that are still needed.
    have: HashMap<Key, Value>,
    /// How many steps have yet to draw on each value; one more where it is to be there at the end.
    uses: HashMap<Key, usize>,
    /// Bytes of every value that had a part.
    bytes: HashMap<Key, usize>,
    /// Milliseconds of each node that ran.
    ms: HashMap<usize, f64>,
    /// By step.
    failures: BTreeMap<usize, NodeFailure>,
    cancelled: bool,
}

/// A lock that a panic of another thread does not take away.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<'r> Run<'r> {
    pub(crate) fn new(
        graph: &'r CheckedGraph,
        request: &'r Request,
        asked: &[Asked],
        mut plan: Plan,
        values: &'r ContextValues,
        resources: &'r Resources,
        cache: &'r mut Cache,
    ) -> Self {
        let mut have = std::mem::take(&mut plan.have);
        let mut bytes: HashMap<Key, usize> = have.iter().map(|(key, value)| (*key, value.bytes())).collect();
        // What nobody draws on, as all who would are at hand, may be at hand itself.
        for key in plan.keys.iter().flatten().flatten() {
            if let (false, Some(value)) = (bytes.contains_key(key), cache.peek(key)) {
                bytes.insert(*key, value.bytes());
                if request.all_values {
                    have.insert(*key, value.clone());
                }
            }
        }
        let mut uses: HashMap<Key, usize> = HashMap::new();
        let kept: Vec<Key> = match request.all_values {
            true => plan.keys.iter().flatten().flatten().copied().collect(),
            false => asked.iter().filter_map(|asked| plan.keys[asked.source.node][asked.source.port]).collect(),
        };
        for key in plan.steps.iter().flat_map(|step| &step.draws).chain(&kept) {
            *uses.entry(*key).or_default() += 1;
        }
        let board = Board { cache, have, uses, bytes, ms: HashMap::new(), failures: BTreeMap::new(), cancelled: false };
        Self { graph, request, plan, values, resources, board: Mutex::new(board), done: Mutex::new(0) }
    }

    /// Runs all steps.
    pub(crate) fn execute(&self, threads: usize) -> Result<(), EvaluateError> {
        self.plan.order().run(threads, &|index| self.step(index));
        let mut board = lock(&self.board);
        if board.cancelled {
            return Err(EvaluateError::Cancelled);
        }
        let failures: Vec<NodeFailure> = std::mem::take(&mut board.failures).into_values().collect();
        if failures.is_empty() { Ok(()) } else { Err(EvaluateError::Nodes(failures)) }
    }

    /// Runs a node; whether what draws on it may run.
    fn step(&self, index: usize) -> bool {
        let step = &self.plan.steps[index];
        let node = &self.graph.nodes[step.node];
        if self.request.cancel.is_cancelled() {
            lock(&self.board).cancelled = true;
            return false;
        }
        self.started(node);
        let fields = self.fetch(step);
        let start = Instant::now();
        let made = self.evaluate(step, &fields);
        let ms = start.elapsed().as_secs_f64() * 1e3;
        drop(fields);
        match made.and_then(|ports| measured(node, step, ports)) {
            Ok(values) => {
                let bytes = self.keep(step, values, ms);
                self.finished(step, ms, bytes);
                true
            }
            Err(failure) => {
                let mut board = lock(&self.board);
                if failure.source.is::<Cancelled>() {
                    board.cancelled = true;
                } else {
                    board.failures.insert(index, failure);
                }
                false
            }
        }
    }

    fn evaluate(&self, step: &Step, fields: &Fields<'_>) -> Result<Ports, NodeFailure> {
        let node = &self.graph.nodes[step.node];
        let outputs = &node.kind.specification.outputs;
        let wanted = self.made(step).map(|(port, demand)| Wanted { output: &outputs[port], parts: &demand.made });
        let wanted: Vec<Wanted<'_>> = wanted.collect();
        let mut cx = Context {
            node: &node.id,
            wanted: &wanted,
            declared: &node.kind.specification.context,
            values: self.values,
            resources: self.resources,
            cancel: &self.request.cancel,
            observer: self.request.observer.as_deref(),
        };
        (node.kind.run)(fields, &mut cx).map_err(|source| failed(node, source))
    }

    /// The outputs that a step makes, and what of them.
    fn made(&self, step: &Step) -> impl Iterator<Item = (usize, &Demand)> {
        let demands = &self.plan.demands[step.node];
        step.make.iter().filter_map(|make| Some((make.port, demands[make.port].together()?)))
    }

    /// The node's fields, filled with the values of the ports they are linked to.
    fn fetch(&self, step: &Step) -> Fields<'r> {
        let node = &self.graph.nodes[step.node];
        let drawn: HashMap<Key, Value> = {
            let board = lock(&self.board);
            step.draws.iter().filter_map(|key| Some((*key, board.have.get(key)?.clone()))).collect()
        };
        let known = known_fields(node, &self.graph.directory);
        let value = |source: &Source| self.plan.keys[source.node][source.port].and_then(|key| drawn.get(&key)).cloned();
        let is_drawn = |field| self.made(step).any(|(_, demand)| demand.draws_on(node, field));
        let linked = node.fields.iter().enumerate().map(|(field, bound)| match bound {
            Bound::Absent | Bound::Literal(_) => None,
            Bound::Link(_) | Bound::Links(_) if !is_drawn(field) => Some(Fetched::Absent),
            Bound::Link(source) => Some(value(source).map_or(Fetched::Absent, Fetched::Linked)),
            Bound::Links(sources) => Some(Fetched::List(sources.iter().filter_map(value).collect())),
        });
        let linked: Vec<Option<Fetched>> = linked.collect();
        let fetched = known.fetched.into_iter().zip(linked).map(|(known, linked)| linked.unwrap_or(known)).collect();
        Fields { specification: known.specification, fetched }
    }

    /// Keeps what a step made and drops what was drawn on for the last time; bytes of what it made.
    fn keep(&self, step: &Step, values: Vec<Value>, ms: f64) -> usize {
        let mut dropped = Vec::new();
        let mut board = lock(&self.board);
        let mut bytes = 0;
        for (make, value) in step.make.iter().zip(values) {
            bytes += value.bytes();
            board.bytes.insert(make.key, value.bytes());
            board.cache.insert(make.key, value.clone(), make.age);
            board.have.insert(make.key, value);
        }
        for key in &step.draws {
            if let Some(uses) = board.uses.get_mut(key) {
                *uses -= 1;
                if *uses == 0 {
                    dropped.extend(board.have.remove(key));
                }
            }
        }
        board.ms.insert(step.node, ms);
        // To free a large value takes a while, which nobody else should wait for.
        drop(board);
        drop(dropped);
        bytes
    }

    fn started(&self, node: &CheckedNode) {
        if let Some(observer) = &self.request.observer {
            let done = lock(&self.done);
            observer.started(&node.id, *done, self.plan.steps.len());
        }
    }

    fn finished(&self, step: &Step, ms: f64, bytes: usize) {
        if let Some(observer) = &self.request.observer {
            let mut done = lock(&self.done);
            *done += 1;
            observer.finished(&self.entry(step.node, State::Computed, ms, bytes));
        }
    }

    fn entry(&self, index: usize, state: State, ms: f64, bytes: usize) -> TraceEntry {
        let node = &self.graph.nodes[index];
        let parts = if state == State::NotNeeded { Vec::new() } else { self.parts(index) };
        TraceEntry { node: node.id.clone(), kind: node.kind.specification.kind.clone(), state, ms, bytes, keys: self.keys(index), parts }
    }

    /// Which parts of the node's outputs were asked for.
    fn parts(&self, index: usize) -> Vec<PortParts> {
        let outputs = self.graph.nodes[index].kind.specification.outputs.iter();
        let asked = outputs.zip(&self.plan.demands[index]).filter(|(output, _)| !output.parts.is_empty());
        let parts = asked.filter_map(|(output, demands)| {
            let demand = demands.together()?;
            let named = |parts: &PartSet| parts.iter().map(|&place| output.parts[place]).collect();
            Some(PortParts { port: output.name.clone(), made: named(&demand.made), left_out: named(&demand.left_out) })
        });
        parts.collect()
    }

    /// Key of each output of the node that was asked for.
    fn keys(&self, index: usize) -> Vec<(String, Key)> {
        let named = self.graph.nodes[index].kind.specification.outputs.iter().zip(&self.plan.keys[index]);
        named.filter_map(|(output, key)| Some((output.name.clone(), (*key)?))).collect()
    }

    /// What became of the node.
    fn trace_entry(&self, board: &Board<'_>, index: usize) -> TraceEntry {
        let keys: Vec<&Key> = self.plan.keys[index].iter().flatten().collect();
        let bytes: Vec<usize> = keys.iter().filter_map(|key| board.bytes.get(key)).copied().collect();
        let state = match board.ms.get(&index) {
            Some(_) => State::Computed,
            None if !keys.is_empty() && bytes.len() == keys.len() => State::Hit,
            None => State::NotNeeded,
        };
        self.entry(index, state, board.ms.get(&index).copied().unwrap_or(0.0), bytes.iter().sum())
    }

    /// The values that are left, and what became of each node.
    pub(crate) fn into_evaluation(self, main: Option<String>) -> Evaluation {
        let board = lock(&self.board);
        let mut evaluation = Evaluation { values: Vec::new(), by_name: HashMap::new(), main, trace: Vec::new() };
        for (id, &index) in &self.graph.by_id {
            let entry = self.trace_entry(&board, index);
            for (port, key) in &entry.keys {
                if let Some(value) = board.have.get(key) {
                    evaluation.by_name.insert(format!("{id}.{port}"), evaluation.values.len());
                    evaluation.values.push((id.clone(), port.clone(), value.clone()));
                }
            }
            evaluation.trace.push(entry);
        }
        evaluation
    }
}

/// The wanted values of a node, measured.
fn measured(node: &CheckedNode, step: &Step, mut ports: Ports) -> Result<Vec<Value>, NodeFailure> {
    let one = |port: usize| {
        let name = &node.kind.specification.outputs[port].name;
        let value = ports.iter_mut().find(|(port, _)| port == name).and_then(|(_, value)| value.take());
        let value = value.ok_or_else(|| failed(node, NotMade(name.clone())))?;
        Ok(match &node.types[port] {
            Some(ty) => value.measured(ty),
            None => value,
        })
    };
    step.make.iter().map(|make| make.port).map(one).collect()
}
