//! What is wanted of every output in a run: from the outputs asked for back to what they draw on, part by part.
//!
//! Readers of one output may want different parts of it. One value is made, with all parts that any of them wants; but what a reader's own value depends on are the parts
//! that it reads. So an output has a demand for each set of parts that somebody reads, and a key for each; the last is what all of them want together, which is made.

use std::collections::BTreeSet;

use crate::check::{Bound, CheckedGraph, CheckedNode, Source};
use crate::needs::{Needs, PartSet, Reading, Wanted};
use crate::node::{Fields, Params};

/// Some parts of an output, and what they take.
pub(crate) struct Demand {
    /// What is asked for.
    asked: PartSet,
    /// What of it is made, with what comes along.
    pub(crate) made: PartSet,
    /// What there is and nobody asks for.
    pub(crate) left_out: PartSet,
    needs: Needs,
}

/// How an output is wanted: the parts of each reader, and at the end what all want together. None if nobody wants it.
#[derive(Default)]
pub(crate) struct Demands(Vec<Demand>);

/// By node and port.
pub(crate) type AllDemands = Vec<Vec<Demands>>;

/// An output that is asked for.
pub(crate) struct Asked {
    pub(crate) source: Source,
    /// With all its parts; else with those that others want.
    pub(crate) whole: bool,
}

impl Demands {
    /// Each set of parts that somebody wants, all of them together last.
    pub(crate) fn each(&self) -> &[Demand] {
        &self.0
    }

    /// What is to be made.
    pub(crate) fn together(&self) -> Option<&Demand> {
        self.0.last()
    }

    /// The place of the demand for these parts.
    pub(crate) fn place(&self, asked: &PartSet) -> Option<usize> {
        self.0.iter().position(|demand| demand.asked == *asked)
    }
}

impl Demand {
    fn new(node: &CheckedNode, known: &Fields<'_>, port: usize, asked: PartSet) -> Self {
        let output = &node.kind.specification.outputs[port];
        let needs = (node.kind.needs)(&Wanted { output, parts: &asked }, &Params { fields: known });
        let (made, left_out) = needs.made_of(output, &asked);
        Self { asked, made, left_out, needs }
    }

    /// What a field is read for; parameters and inputs that the node cannot do without always are.
    fn reading<'d>(&'d self, node: &CheckedNode, field: usize) -> &'d Reading {
        match node.kind.specification.inputs.get(field).map(|input| (input, self.needs.of(&input.name))) {
            None => &Reading::Whole,
            Some((input, Reading::Nothing)) if input.always => &Reading::Whole,
            Some((_, reading)) => reading,
        }
    }

    /// Whether a field is drawn on.
    pub(crate) fn draws_on(&self, node: &CheckedNode, field: usize) -> bool {
        *self.reading(node, field) != Reading::Nothing
    }

    /// The outputs that a field of the node is linked to and that are drawn on, and which of their parts.
    pub(crate) fn sources<'d>(
        &'d self,
        graph: &'d CheckedGraph,
        node: &'d CheckedNode,
        field: usize,
    ) -> impl Iterator<Item = (&'d Source, PartSet)> {
        let reading = self.reading(node, field);
        node.fields.get(field).map_or(&[][..], Bound::sources).iter().filter_map(move |source| {
            let output = &graph.nodes[source.node].kind.specification.outputs[source.port];
            Some((source, reading.of(output)?))
        })
    }

    /// The same of all fields.
    pub(crate) fn all_sources<'d>(&'d self, graph: &'d CheckedGraph, node: &'d CheckedNode) -> impl Iterator<Item = (&'d Source, PartSet)> {
        (0..node.fields.len()).flat_map(move |field| self.sources(graph, node, field))
    }
}

/// What is wanted of all outputs; `known` are the fields of each node as far as they are before anything has run.
pub(crate) fn demands(graph: &CheckedGraph, known: &[Fields<'_>], asked: &[Asked]) -> AllDemands {
    let mut wanted: Vec<Vec<BTreeSet<PartSet>>> = graph.nodes.iter().map(|node| vec![BTreeSet::new(); node.types.len()]).collect();
    for Asked { source, whole } in asked {
        let parts = graph.nodes[source.node].kind.specification.outputs[source.port].parts.len();
        wanted[source.node][source.port].insert(if *whole { (0..parts).collect() } else { PartSet::new() });
    }
    let mut all: AllDemands = graph.nodes.iter().map(|node| node.types.iter().map(|_| Demands::default()).collect()).collect();
    for (index, node) in graph.nodes.iter().enumerate().rev() {
        for port in 0..node.types.len() {
            let sets = std::mem::take(&mut wanted[index][port]);
            let demand = |parts| Demand::new(node, &known[index], port, parts);
            let each: Vec<Demand> = with_union(sets).into_iter().map(demand).collect();
            for (source, parts) in each.iter().flat_map(|demand| demand.all_sources(graph, node)) {
                wanted[source.node][source.port].insert(parts);
            }
            all[index][port] = Demands(each);
        }
    }
    all
}

/// The sets, and at the end their union, once.
fn with_union(mut sets: BTreeSet<PartSet>) -> Vec<PartSet> {
    let Some(union) = sets.iter().cloned().reduce(|union, parts| &union | &parts) else { return Vec::new() };
    sets.remove(&union);
    sets.into_iter().chain([union]).collect()
}
