//! The untyped tree of a file to a [`Graph`], with what is wrong with its form.

use std::sync::Arc;

use indexmap::IndexMap;

use crate::conform::unknown_field;
use crate::fault::{Fault, FaultKind, Faults};
use crate::graph::{Graph, GraphNode, NodeId};
use crate::literal::{Literal, Name, Place, Shape};
use crate::migrate::migrate;
use crate::read::read;
use crate::rewrite::Source;

const FIELDS: [&str; 6] = ["version", "title", "about", "nodes", "output", "layout"];

/// The graph that a text says, with what is wrong with its form.
pub(crate) fn parse(text: &str) -> Result<Graph, Faults> {
    let only = |place, kind| Faults::new(vec![Fault { place, node: None, field: None, kind }]);
    let mut tree = read(text).map_err(|error| only(Some(error.place), FaultKind::Syntax { message: error.message }))?;
    let source = Arc::new(Source { text: text.to_owned(), tree: tree.clone() });
    let place = tree.place;
    let Shape::Record(name, fields) = &tree.shape else { return Err(only(place, no_graph(&tree))) };
    if name.as_ref().is_some_and(|name| name != "Graph") {
        return Err(only(place, no_graph(&tree)));
    }
    let version = version(fields, place).map_err(|(place, kind)| only(place, *kind))?;
    migrate(&mut tree, version);
    let Shape::Record(_, fields) = tree.shape else { return Err(only(place, no_graph(&tree))) };
    let mut reader = Reader { graph: Graph { source: Some(source), ..Graph::default() }, layout_places: Vec::new() };
    reader.frame(fields, place);
    Ok(reader.graph)
}

fn no_graph(tree: &Literal) -> FaultKind {
    FaultKind::Form { expected: format!("Graph(version: {}, nodes: {{…}})", Graph::VERSION), found: tree.describe() }
}

/// The version alone, before anything else is read: what another version means by its fields is for its own step to say.
fn version(fields: &[(Name, Literal)], place: Option<Place>) -> Result<u32, (Option<Place>, Box<FaultKind>)> {
    let Some((_, version)) = fields.iter().find(|(name, _)| name.text == "version") else {
        let expected = format!("a whole number such as {}", Graph::VERSION);
        return Err((place, Box::new(FaultKind::Missing { field: "version".to_owned(), expected })));
    };
    let Shape::Integer(found) = version.shape else {
        let kind = FaultKind::WrongType { expected: "a version, a whole number".to_owned(), found: version.describe() };
        return Err((version.place, Box::new(kind)));
    };
    let known = u32::try_from(found).ok().filter(|found| *found <= Graph::VERSION);
    known.ok_or_else(|| (version.place, Box::new(FaultKind::Version { found, supported: Graph::VERSION })))
}

struct Reader {
    graph: Graph,
    layout_places: Vec<(NodeId, Option<Place>)>,
}

impl Reader {
    fn fault(&mut self, place: Option<Place>, node: Option<&NodeId>, field: Option<&str>, kind: FaultKind) {
        self.graph.form.push(Fault { place, node: node.cloned(), field: field.map(str::to_owned), kind });
    }

    fn form(&mut self, field: &str, expected: &str, found: &Literal) {
        let kind = FaultKind::Form { expected: expected.to_owned(), found: found.describe() };
        self.fault(found.place, None, Some(field), kind);
    }

    /// The fields of `Graph(…)`.
    fn frame(&mut self, fields: Vec<(Name, Literal)>, place: Option<Place>) {
        let mut seen: Vec<String> = Vec::new();
        for (name, value) in fields {
            if !FIELDS.contains(&name.text.as_str()) {
                self.fault(name.place, None, None, unknown_field("Graph", &name.text, FIELDS.into_iter()));
                continue;
            }
            if seen.contains(&name.text) {
                self.fault(name.place, None, None, FaultKind::DuplicateField { field: name.text });
                continue;
            }
            match name.text.as_str() {
                "title" => self.graph.title = self.text("title", &value),
                "about" => self.graph.about = self.text("about", &value),
                "output" => {
                    self.graph.output = self.text("output", &value);
                    self.graph.output_place = value.place;
                }
                "nodes" => self.nodes(value),
                "layout" => self.layout(value),
                _ => {}
            }
            seen.push(name.text);
        }
        if !seen.iter().any(|name| name == "nodes") {
            let expected = "a map of nodes by id".to_owned();
            self.fault(place, None, None, FaultKind::Missing { field: "nodes".to_owned(), expected });
        }
        self.layout_names_nodes();
    }

    fn text(&mut self, field: &str, value: &Literal) -> Option<String> {
        if let Shape::Text(text) = &value.shape {
            return Some(text.clone());
        }
        self.form(field, "a text", value);
        None
    }

    fn nodes(&mut self, value: Literal) {
        let Shape::Map(entries) = value.shape else {
            return self.form("nodes", "a map of nodes by id, {\"id\": Kind(…)}", &value);
        };
        for (key, value) in entries {
            let Shape::Text(id) = &key.shape else {
                self.form("nodes", "an id in quotes", &key);
                continue;
            };
            if NodeId::new(id).is_none() {
                self.fault(key.place, None, None, FaultKind::BadId { id: id.clone() });
            }
            let node_id = NodeId::unchecked(id);
            let Some(node) = self.node(&node_id, value) else { continue };
            if self.graph.nodes.contains_key(&node_id) {
                self.fault(key.place, Some(&node_id), None, FaultKind::DuplicateId { id: id.clone() });
            } else {
                self.graph.nodes.insert(node_id, node);
            }
        }
    }

    fn node(&mut self, id: &NodeId, value: Literal) -> Option<GraphNode> {
        let place = value.place;
        let (kind, fields) = match value.shape {
            Shape::Record(Some(kind), fields) => (kind, fields),
            Shape::Word(kind) => (kind, Vec::new()),
            Shape::Call(kind, items) if items.is_empty() => (kind, Vec::new()),
            _ => {
                let kind = FaultKind::Form { expected: "a node, Kind(field: value)".to_owned(), found: value.describe() };
                self.fault(place, Some(id), None, kind);
                return None;
            }
        };
        let mut node = GraphNode { kind, fields: IndexMap::new(), place, names: IndexMap::new() };
        for (name, value) in fields {
            if node.fields.contains_key(&name.text) {
                self.fault(name.place, Some(id), None, FaultKind::DuplicateField { field: name.text });
                continue;
            }
            if let Some(place) = name.place {
                node.names.insert(name.text.clone(), place);
            }
            node.fields.insert(name.text, value);
        }
        Some(node)
    }

    fn layout(&mut self, value: Literal) {
        let Shape::Map(entries) = value.shape else {
            return self.form("layout", "a map of positions by id, {\"id\": (x, y)}", &value);
        };
        for (key, value) in entries {
            let Shape::Text(id) = &key.shape else {
                self.form("layout", "an id in quotes", &key);
                continue;
            };
            let Some(position) = position(&value) else {
                self.form("layout", "a position (x, y) of two finite numbers", &value);
                continue;
            };
            if self.graph.layout.contains_key(id.as_str()) {
                self.fault(key.place, None, Some("layout"), FaultKind::DuplicateId { id: id.clone() });
                continue;
            }
            self.graph.layout.insert(NodeId::unchecked(id), position);
            self.layout_places.push((NodeId::unchecked(id), key.place));
        }
    }

    /// A layout entry for no node would never be seen again.
    fn layout_names_nodes(&mut self) {
        let places = std::mem::take(&mut self.layout_places);
        for (id, place) in places {
            if !self.graph.nodes.contains_key(&id) {
                let nearest = crate::fault::nearest(id.as_str(), self.graph.nodes.keys().map(NodeId::as_str));
                self.fault(place, None, Some("layout"), FaultKind::NoSuchNode { target: id.to_string(), nearest });
            }
        }
    }
}

/// A position of the layout.
pub(crate) fn position(value: &Literal) -> Option<(f64, f64)> {
    let Shape::Tuple(items) = &value.shape else { return None };
    let number = |item: &Literal| match item.shape {
        Shape::Integer(value) => Some(value as f64),
        Shape::Number(value) if value.is_finite() => Some(value),
        _ => None,
    };
    match items.as_slice() {
        [x, y] => Some((number(x)?, number(y)?)),
        _ => None,
    }
}
