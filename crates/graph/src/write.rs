//! A graph to the text of its file.
//!
//! There is one way of writing: the tree of what the graph says goes in the place of a text that says something else, that of the file it was read
//! from, or of an empty graph.

use std::collections::{BTreeSet, HashMap};

use crate::graph::{Graph, GraphNode, NodeId};
use crate::literal::{Literal, Name, Place, Shape};
use crate::parse::position;
use crate::read::read;
use crate::rewrite::{Source, rewrite};

/// A graph without nodes.
const EMPTY: &str = "Graph(\n    version: 1,\n    nodes: {\n    },\n)\n";

/// The fields of a file in the order in which new ones are written.
const ORDER: [&str; 6] = ["version", "title", "about", "nodes", "output", "layout"];

pub(crate) fn to_ron(graph: &Graph) -> String {
    let kept: BTreeSet<usize> = graph.form.iter().filter_map(|fault| fault.place).map(|place| place.start).collect();
    match &graph.source {
        Some(source) => rewrite(source, &tree(graph, &source.tree, &kept), &kept),
        None => match read(EMPTY) {
            Ok(empty) => {
                let source = Source { text: EMPTY.to_owned(), tree: empty };
                rewrite(&source, &tree(graph, &source.tree, &kept), &kept)
            }
            // It is a constant and does read; if it did not, one line would do.
            Err(_) => tree(graph, &Shape::Absent.into(), &kept).to_string(),
        },
    }
}

/// What the graph says, its fields in the order of `old`. Of a field whose value the reader passed over, which is in `kept`, it says nothing unless there
/// is something new to say.
fn tree(graph: &Graph, old: &Literal, kept: &BTreeSet<usize>) -> Literal {
    let (name, old) = match &old.shape {
        Shape::Record(name, fields) => (name.clone(), fields.as_slice()),
        _ => (Some("Graph".to_owned()), &[][..]),
    };
    let find = |field: &str| old.iter().find(|(name, _)| name.text == field).map(|(_, value)| value);
    let said = |field: &str| -> Option<Literal> {
        let old = find(field);
        let was_read = old.is_some_and(|old| old.place.is_none_or(|place| !kept.contains(&place.start)));
        match field {
            "version" => Some(Literal { place: old.and_then(|old| old.place), ..i64::from(Graph::VERSION).into() }),
            "title" => graph.title.as_deref().map(Literal::from),
            "about" => graph.about.as_deref().map(Literal::from),
            "nodes" => (was_read || !graph.nodes.is_empty()).then(|| nodes(graph)),
            "output" => graph.output.as_deref().map(Literal::from),
            "layout" => (was_read || !graph.layout.is_empty()).then(|| layout(graph, entries(old), entries(find("nodes")))),
            _ => None,
        }
    };
    let mut order: Vec<&str> = Vec::new();
    for (name, _) in old {
        if ORDER.contains(&name.text.as_str()) && !order.contains(&name.text.as_str()) {
            order.push(&name.text);
        }
    }
    for (index, field) in ORDER.into_iter().enumerate().filter(|(_, field)| !old.iter().any(|(name, _)| name.text == *field)) {
        let after = ORDER[..index].iter().rev().find_map(|before| order.iter().position(|field| field == before));
        order.insert(after.map_or(0, |after| after + 1), field);
    }
    let fields = order.into_iter().filter_map(|field| Some((Name { text: field.to_owned(), place: None }, said(field)?)));
    Shape::Record(name, fields.collect()).into()
}

fn nodes(graph: &Graph) -> Literal {
    Shape::Map(graph.nodes.iter().map(|(id, node)| (id.as_str().into(), literal(node))).collect()).into()
}

fn literal(node: &GraphNode) -> Literal {
    let fields = node.fields.iter().map(|(name, value)| (Name { text: name.clone(), place: None }, value.clone())).collect();
    Literal { shape: Shape::Record(Some(node.kind.clone()), fields), place: node.place }
}

fn entries(map: Option<&Literal>) -> &[(Literal, Literal)] {
    match map.map(|map| &map.shape) {
        Some(Shape::Map(entries)) => entries,
        _ => &[],
    }
}

/// Positions as they were written where they are the same, of a node that was renamed under the name that it had.
fn layout(graph: &Graph, old: &[(Literal, Literal)], nodes: &[(Literal, Literal)]) -> Literal {
    let text = |id: &Literal| if let Shape::Text(id) = &id.shape { Some(id.clone()) } else { None };
    let written: HashMap<String, &Literal> =
        old.iter().rev().filter(|(_, at)| position(at).is_some()).filter_map(|(id, at)| Some((text(id)?, at))).collect();
    let read_as: HashMap<Place, String> = nodes.iter().filter_map(|(id, value)| Some((value.place?, text(id)?))).collect();
    let entry = |(id, &at): (&NodeId, &(f64, f64))| {
        let was = graph.nodes.get(id).and_then(|node| read_as.get(&node.place?)).map_or(id.as_str(), String::as_str);
        let same = written.get(was).filter(|written| position(written) == Some(at)).map(|&written| written.clone());
        (id.as_str().into(), same.unwrap_or_else(|| Shape::Tuple(vec![points(at.0), points(at.1)]).into()))
    };
    Shape::Map(graph.layout.iter().map(entry).collect()).into()
}

/// A whole number of points without its fraction, as a person would write it.
fn points(value: f64) -> Literal {
    if value == value.trunc() && value.abs() < 1e15 { (value as i64).into() } else { value.into() }
}
