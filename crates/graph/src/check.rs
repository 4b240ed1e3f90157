//! A document against the registry: every fault at once, or a graph that can be evaluated.

use std::any::TypeId;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use indexmap::IndexMap;

use crate::conform::{conform, unknown_field};
use crate::fault::{Fault, FaultKind, Faults, nearest};
use crate::graph::{Graph, GraphNode, NodeId};
use crate::literal::{Literal, Place, Shape, quoted};
use crate::registry::{Kind, Registry};
use crate::spec::{Arity, InputSpec, ParamSpec, ParamType, PortType};
use crate::value::TypeEntry;

/// A graph without faults, bound to the node kinds of a registry and ready to be evaluated. It owns what it needs.
pub struct CheckedGraph {
    /// In topological order: a node comes after all it takes from.
    pub(crate) nodes: Vec<CheckedNode>,
    /// Position in `nodes`, in the order of the document.
    pub(crate) by_id: IndexMap<NodeId, usize>,
    pub(crate) main: Option<Source>,
    pub(crate) directory: PathBuf,
}

impl CheckedGraph {
    /// Ids and kinds, in the order of the document.
    pub fn nodes(&self) -> impl Iterator<Item = (&NodeId, &str)> {
        self.by_id.iter().map(|(id, &index)| (id, self.nodes[index].kind.specification.kind.as_str()))
    }

    /// Finds `node.port`.
    pub(crate) fn source(&self, link: &str) -> Option<Source> {
        let (id, port) = link.split_once('.')?;
        let node = *self.by_id.get(id)?;
        let port = self.nodes[node].kind.specification.outputs.iter().position(|output| output.name == port)?;
        Some(Source { node, port })
    }

    /// The nodes that an output may draw on, its own among them, in the order of the document; none if there is no such output.
    pub fn behind(&self, output: &str) -> impl Iterator<Item = &NodeId> {
        let mut reached = vec![false; self.nodes.len()];
        let mut open: Vec<usize> = self.source(output).map(|source| source.node).into_iter().collect();
        while let Some(node) = open.pop() {
            if std::mem::replace(&mut reached[node], true) {
                continue;
            }
            for field in &self.nodes[node].fields {
                match field {
                    Bound::Link(source) => open.push(source.node),
                    Bound::Links(sources) => open.extend(sources.iter().map(|source| source.node)),
                    Bound::Absent | Bound::Literal(_) => {}
                }
            }
        }
        self.by_id.iter().filter(move |&(_, &node)| reached[node]).map(|(id, _)| id)
    }

    /// All outputs of all nodes, as `node.port` with the plain name of the type.
    pub fn outputs(&self) -> impl Iterator<Item = (String, &str)> {
        self.by_id.iter().flat_map(|(id, &index)| {
            self.nodes[index]
                .kind
                .specification
                .outputs
                .iter()
                .map(move |output| (format!("{id}.{}", output.name), output.ty.name.as_str()))
        })
    }
}

impl std::fmt::Debug for CheckedGraph {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_map().entries(self.nodes()).finish()
    }
}

/// An output of a node, by positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Source {
    pub(crate) node: usize,
    pub(crate) port: usize,
}

/// What a field was given.
pub(crate) enum Bound {
    Absent,
    /// Canonical; file paths as written.
    Literal(Literal),
    Link(Source),
    Links(Vec<Source>),
}

impl Bound {
    pub(crate) fn sources(&self) -> &[Source] {
        match self {
            Self::Link(source) => std::slice::from_ref(source),
            Self::Links(sources) => sources,
            Self::Absent | Self::Literal(_) => &[],
        }
    }
    fn sources_mut(&mut self) -> &mut [Source] {
        match self {
            Self::Link(source) => std::slice::from_mut(source),
            Self::Links(sources) => sources,
            Self::Absent | Self::Literal(_) => &mut [],
        }
    }
}

pub(crate) struct CheckedNode {
    pub(crate) id: NodeId,
    pub(crate) kind: Arc<Kind>,
    /// One for each of the specification's inputs, then of its parameters.
    pub(crate) fields: Vec<Bound>,
    /// How to measure each output; none if its type is not registered.
    pub(crate) types: Vec<Option<Arc<TypeEntry>>>,
}

impl Graph {
    /// Checks every node, field and link.
    ///
    /// # Errors
    /// All faults of the graph at once, those that [`parse`](Self::parse) passed over included, in the order of the file.
    pub fn check(&self, registry: &Registry) -> Result<CheckedGraph, Faults> {
        let mut checker = Checker { graph: self, registry, faults: self.form.clone() };
        let mut nodes: Vec<Option<CheckedNode>> = self.nodes.iter().map(|(id, node)| checker.node(id, node)).collect();
        let main = checker.main_output();
        let order = checker.order(&nodes);
        if !checker.faults.is_empty() {
            return Err(Faults::new(checker.faults));
        }
        // From positions in the document to positions in topological order.
        let mut rank = vec![0; nodes.len()];
        for (position, &node) in order.iter().enumerate() {
            rank[node] = position;
        }
        let mut sorted: Vec<CheckedNode> = order.iter().filter_map(|&node| nodes[node].take()).collect();
        for source in sorted.iter_mut().flat_map(|node| &mut node.fields).flat_map(Bound::sources_mut) {
            source.node = rank[source.node];
        }
        let by_id = self.nodes.keys().enumerate().map(|(node, id)| (id.clone(), rank[node])).collect();
        let main = main.map(|source| Source { node: rank[source.node], ..source });
        Ok(CheckedGraph { nodes: sorted, by_id, main, directory: self.directory.clone() })
    }
}

struct Checker<'g> {
    graph: &'g Graph,
    registry: &'g Registry,
    faults: Vec<Fault>,
}

impl Checker<'_> {
    fn fault(&mut self, place: Option<Place>, node: Option<&NodeId>, field: Option<&str>, kind: FaultKind) {
        self.faults.push(Fault { place, node: node.cloned(), field: field.map(str::to_owned), kind });
    }

    /// The node, bound; `None` if its kind is unknown.
    fn node(&mut self, id: &NodeId, node: &GraphNode) -> Option<CheckedNode> {
        let Some(kind) = self.registry.kind(&node.kind) else {
            let nearest = nearest(&node.kind, self.registry.kind_names());
            self.fault(node.place, Some(id), None, FaultKind::UnknownKind { kind: node.kind.clone(), nearest });
            return None;
        };
        let specification = &kind.specification;
        for name in node.fields.keys() {
            let place = node.names.get(name).copied();
            let present = specification.input(name).map(|input| &input.name).or_else(|| specification.param(name).map(|param| &param.name));
            match present {
                None => {
                    let known: Vec<&str> = specification.field_names().collect();
                    self.fault(place, Some(id), None, unknown_field(&node.kind, name, known.into_iter()));
                }
                // Under a former name and its present one.
                Some(present) if present != name && node.fields.contains_key(present) => {
                    self.fault(place, Some(id), None, FaultKind::DuplicateField { field: present.clone() });
                }
                Some(_) => {}
            }
        }
        let inputs = specification.inputs.iter().map(|input| self.input(id, node, input)).collect::<Vec<_>>();
        let params = specification.params.iter().map(|param| self.param(id, node, param)).collect::<Vec<_>>();
        let types = specification.outputs.iter().map(|output| self.registry.type_entry(output.ty.id).cloned()).collect();
        Some(CheckedNode { id: id.clone(), kind: Arc::clone(kind), fields: inputs.into_iter().chain(params).collect(), types })
    }

    fn input(&mut self, id: &NodeId, node: &GraphNode, input: &InputSpec) -> Bound {
        let wanted = format!("a link \"node.port\" to {}", input.ty.name);
        let Some(literal) = node.field(&input.name, &input.was) else {
            if input.arity == Arity::One {
                self.fault(node.place, Some(id), None, FaultKind::Missing { field: input.name.clone(), expected: wanted });
            }
            return Bound::Absent;
        };
        let fits = |found| found == input.ty.id;
        match (&literal.shape, input.arity) {
            (Shape::Absent, Arity::Optional | Arity::Many) => Bound::Absent,
            (Shape::Present(inner), Arity::Optional) => self.link(id, &input.name, inner, &wanted, &fits),
            (Shape::List(items), Arity::Many) => {
                Bound::Links(items.iter().flat_map(|item| self.link(id, &input.name, item, &wanted, &fits).sources().to_vec()).collect())
            }
            // One link without its brackets is a list of one.
            (_, Arity::Many) => Bound::Links(self.link(id, &input.name, literal, &wanted, &fits).sources().to_vec()),
            _ => self.link(id, &input.name, literal, &wanted, &fits),
        }
    }

    fn param(&mut self, id: &NodeId, node: &GraphNode, param: &ParamSpec) -> Bound {
        let Some(literal) = node.field(&param.name, &param.was).or(param.default.as_ref()) else {
            let expected = param.ty.to_string();
            self.fault(node.place, Some(id), None, FaultKind::Missing { field: param.name.clone(), expected });
            return Bound::Absent;
        };
        if is_link(&param.ty, literal) {
            let fits = |found| param.links.contains(&found);
            return self.link(id, &param.name, literal, &format!("{}, or a link \"node.port\" to one", param.ty), &fits);
        }
        let mut misfits = Vec::new();
        let canonical = conform(param, literal, &mut misfits);
        for misfit in misfits {
            let field = format!("{}{}", param.name, misfit.path);
            self.fault(misfit.place, Some(id), Some(&field), misfit.kind);
        }
        Bound::Literal(canonical)
    }

    /// Follows a link to an output of a type that `fits`.
    fn link(&mut self, id: &NodeId, field: &str, literal: &Literal, wanted: &str, fits: &dyn Fn(TypeId) -> bool) -> Bound {
        let Some(text) = link_text(literal) else {
            let kind = FaultKind::WrongType { expected: wanted.to_owned(), found: literal.describe() };
            self.fault(literal.place, Some(id), Some(field), kind);
            return Bound::Absent;
        };
        let place = literal.place;
        let Some((source, ty)) = self.target(place, Some(id), field, text, wanted) else { return Bound::Absent };
        if !fits(ty.id) {
            let kind = FaultKind::TypeMismatch { expected: wanted.to_owned(), link: text.to_owned(), found: ty.name.clone() };
            self.fault(place, Some(id), Some(field), kind);
        }
        Bound::Link(source)
    }

    /// The output that `text` names, by its position in the document, with its type.
    fn target(&mut self, place: Option<Place>, node: Option<&NodeId>, field: &str, text: &str, wanted: &str) -> Option<(Source, PortType)> {
        let Some((target, port)) = text.split_once('.') else {
            let found = format!("the text {}", quoted(text));
            let kind = FaultKind::WrongType { expected: wanted.to_owned(), found };
            self.fault(place, node, Some(field), kind);
            return None;
        };
        let Some((index, _, linked)) = self.graph.nodes.get_full(target) else {
            let nearest = nearest(target, self.graph.nodes.keys().map(NodeId::as_str));
            self.fault(place, node, Some(field), FaultKind::NoSuchNode { target: target.to_owned(), nearest });
            return None;
        };
        // A node of unknown kind is one fault; what links to it is none.
        let specification = &self.registry.kind(&linked.kind)?.specification;
        let Some(position) = specification.outputs.iter().position(|output| output.name == port) else {
            let known = || specification.outputs.iter().map(|output| output.name.as_str());
            let kind = FaultKind::NoSuchPort {
                target: target.to_owned(),
                kind: linked.kind.clone(),
                port: port.to_owned(),
                nearest: nearest(port, known()),
                known: known().map(str::to_owned).collect(),
            };
            self.fault(place, node, Some(field), kind);
            return None;
        };
        Some((Source { node: index, port: position }, specification.outputs[position].ty.clone()))
    }

    fn main_output(&mut self) -> Option<Source> {
        let output = self.graph.output.as_ref()?;
        self.target(self.graph.output_place, None, "output", output, "a link \"node.port\"").map(|(source, _)| source)
    }

    /// Positions in topological order, among equals in the order of the document; every cycle is a fault.
    fn order(&mut self, nodes: &[Option<CheckedNode>]) -> Vec<usize> {
        let mut before: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); nodes.len()];
        let mut after: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); nodes.len()];
        for (index, node) in nodes.iter().enumerate() {
            for source in node.iter().flat_map(|node| &node.fields).flat_map(Bound::sources) {
                before[index].insert(source.node);
                after[source.node].insert(index);
            }
        }
        let mut waiting: Vec<usize> = before.iter().map(BTreeSet::len).collect();
        let mut ready: BTreeSet<usize> = (0..nodes.len()).filter(|&node| waiting[node] == 0).collect();
        let mut order = Vec::with_capacity(nodes.len());
        let mut done = vec![false; nodes.len()];
        loop {
            while let Some(node) = ready.pop_first() {
                order.push(node);
                done[node] = true;
                for &next in &after[node] {
                    waiting[next] = waiting[next].saturating_sub(1);
                    if waiting[next] == 0 && !done[next] {
                        ready.insert(next);
                    }
                }
            }
            // What is left waits for a cycle. Walking back from any of it must come round; cut there, and go on for the next.
            let Some(start) = done.iter().position(|done| !done) else { return order };
            let mut path = vec![start];
            let cycle = loop {
                let last = path[path.len() - 1];
                let Some(&previous) = before[last].iter().find(|&&node| !done[node]) else { break vec![last] };
                if let Some(begin) = path.iter().position(|&node| node == previous) {
                    break path.split_off(begin);
                }
                path.push(previous);
            };
            self.cycle(nodes, &cycle);
            ready.extend(cycle);
            for &node in &ready {
                waiting[node] = 0;
            }
        }
    }

    /// Reports a cycle, given against the direction of the data, at its first node in the document.
    fn cycle(&mut self, nodes: &[Option<CheckedNode>], cycle: &[usize]) {
        let Some(first) = cycle.iter().enumerate().min_by_key(|(_, node)| **node).map(|(at, _)| at) else { return };
        let mut ring: Vec<usize> = cycle[first..].iter().chain(&cycle[..first]).copied().collect();
        let link_from = ring.get(1).copied().unwrap_or(ring[0]);
        ring[1..].reverse();
        ring.push(ring[0]);
        let Some((id, node)) = self.graph.nodes.get_index(ring[0]) else { return };
        // The field by which the first node takes from the one before it.
        let field = nodes[ring[0]].iter().flat_map(|bound| {
            bound
                .kind
                .specification
                .field_names()
                .zip(&bound.fields)
                .filter(|(_, bound)| bound.sources().iter().any(|s| s.node == link_from))
        });
        let name = field.map(|(name, _)| name.to_owned()).next();
        let place = name.as_ref().and_then(|name| node.fields.get(name)).and_then(|literal| literal.place).or(node.place);
        let names = ring.iter().filter_map(|&node| self.graph.nodes.get_index(node)).map(|(id, _)| id.to_string()).collect();
        self.fault(place, Some(id), name.as_deref(), FaultKind::Cycle { nodes: names });
    }
}

/// Whether a written value is a link: any string where strings are not the value itself, else `Link("node.port")`.
pub(crate) fn is_link(ty: &ParamType, literal: &Literal) -> bool {
    match &literal.shape {
        Shape::Text(_) => !ty.takes_text(),
        Shape::Call(name, _) => name == "Link",
        _ => false,
    }
}

/// The `node.port` of a link, in either way of writing it.
pub(crate) fn link_text(literal: &Literal) -> Option<&str> {
    match &literal.shape {
        Shape::Text(text) => Some(text),
        Shape::Call(name, items) if name == "Link" => match items.as_slice() {
            [Literal { shape: Shape::Text(text), .. }] => Some(text),
            _ => None,
        },
        _ => None,
    }
}
