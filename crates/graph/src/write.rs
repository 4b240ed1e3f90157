//! A graph to the text of its file.

use std::fmt::Write;

use crate::graph::{Graph, GraphNode};
use crate::literal::{Literal, Name, Shape, quoted};

/// One node a line, so that a diff of two files shows which nodes changed.
pub(crate) fn to_ron(graph: &Graph) -> String {
    let mut out = String::new();
    // Writing to a String cannot fail.
    let _ = write(graph, &mut out);
    out
}

fn write(graph: &Graph, out: &mut String) -> std::fmt::Result {
    writeln!(out, "Graph(")?;
    writeln!(out, "    version: {},", Graph::VERSION)?;
    for (name, text) in [("title", &graph.title), ("about", &graph.about)] {
        if let Some(text) = text {
            writeln!(out, "    {name}: {},", quoted(text))?;
        }
    }
    writeln!(out, "    nodes: {{")?;
    for (id, node) in &graph.nodes {
        writeln!(out, "        {}: {},", quoted(id.as_str()), literal(node))?;
    }
    writeln!(out, "    }},")?;
    if let Some(output) = &graph.output {
        writeln!(out, "    output: {},", quoted(output))?;
    }
    if !graph.layout.is_empty() {
        writeln!(out, "    layout: {{")?;
        for (id, (x, y)) in &graph.layout {
            writeln!(out, "        {}: ({}, {}),", quoted(id.as_str()), position(*x), position(*y))?;
        }
        writeln!(out, "    }},")?;
    }
    writeln!(out, ")")
}

/// A whole number of points without its fraction, as a person would write it.
fn position(value: f64) -> String {
    if value == value.trunc() && value.abs() < 1e15 { format!("{}", value + 0.0) } else { format!("{value:?}") }
}

fn literal(node: &GraphNode) -> Literal {
    let fields = node.fields.iter().map(|(name, value)| (Name { text: name.clone(), place: None }, value.clone())).collect();
    Shape::Record(Some(node.kind.clone()), fields).into()
}
