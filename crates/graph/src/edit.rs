//! Changes to a graph: an editor's commands.

use indexmap::IndexMap;

use crate::check::link_text;
use crate::graph::{Graph, GraphNode, NodeId};
use crate::literal::{Literal, Shape};
use crate::registry::Registry;
use crate::spec::Arity;

/// A command that does not fit the graph.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The id cannot be used.
    #[error("the id {0:?} cannot be used: ids are made of letters, digits, '_' and '-'")]
    BadId(String),
    /// The id is taken.
    #[error("there is a node {0:?} already")]
    Taken(String),
    /// There is no such node.
    #[error("there is no node {0:?}")]
    NoSuchNode(String),
    /// The node has no such field, or its kind is unknown.
    #[error("node {node:?} has no field {field:?}")]
    NoSuchField {
        /// The node.
        node: String,
        /// The field.
        field: String,
    },
}

/// A link of a graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Link {
    /// The output it comes from, `node.port`; it need not exist.
    pub from: String,
    /// The node it goes to.
    pub node: NodeId,
    /// The field it goes to.
    pub field: String,
}

impl Graph {
    /// Adds a node of a kind, with all fields left out.
    ///
    /// # Errors
    /// If the id cannot be used or is taken.
    pub fn add(&mut self, id: &str, kind: &str) -> Result<NodeId, EditError> {
        let id = self.free_id(id)?;
        self.nodes.insert(id.clone(), GraphNode::new(kind));
        Ok(id)
    }

    /// Removes a node with its layout and the links from it, which come back, so that an editor can say what was cut.
    ///
    /// # Errors
    /// If there is none.
    pub fn remove(&mut self, registry: &Registry, id: &str) -> Result<(GraphNode, Vec<Link>), EditError> {
        let cut: Vec<Link> =
            self.links(registry).into_iter().filter(|link| link.node.as_str() != id && starts_at(&link.from, id)).collect();
        let node = self.nodes.shift_remove(id).ok_or_else(|| EditError::NoSuchNode(id.to_owned()))?;
        self.layout.shift_remove(id);
        self.form.retain(|fault| fault.node.as_ref().is_none_or(|node| node.as_str() != id));
        for link in &cut {
            self.disconnect(link);
        }
        if self.output.as_ref().is_some_and(|output| starts_at(output, id)) {
            self.output = None;
        }
        Ok((node, cut))
    }

    /// Links `from`, a `node.port`, to a field, replacing what was there; to an input of many values the link is added.
    ///
    /// # Errors
    /// If there is no such node or field. Types and cycles are for [`check`](Self::check).
    pub fn connect(&mut self, registry: &Registry, from: &str, node: &str, field: &str) -> Result<(), EditError> {
        let entry = self.nodes.get_mut(node).ok_or_else(|| EditError::NoSuchNode(node.to_owned()))?;
        let specification = registry.specification(&entry.kind);
        let no_field = || EditError::NoSuchField { node: node.to_owned(), field: field.to_owned() };
        let specification = specification.ok_or_else(no_field)?;
        if let Some(input) = specification.input(field) {
            let given = entry.field(&input.name, &input.was);
            let literal = match (input.arity, given.map(|literal| (&literal.shape, literal.place))) {
                (Arity::Many, Some((Shape::List(items), place))) => {
                    Literal { shape: Shape::List(items.iter().cloned().chain([from.into()]).collect()), place }
                }
                (Arity::Many, _) => Shape::List(vec![from.into()]).into(),
                _ => from.into(),
            };
            entry.give(&input.name, &input.was, literal);
        } else {
            let param = specification.param(field).ok_or_else(no_field)?;
            let literal = if param.ty.takes_text() { Literal::link(from) } else { from.into() };
            entry.give(&param.name, &param.was, literal);
        }
        Ok(())
    }

    /// Takes a link away; whether there was one.
    pub fn disconnect(&mut self, link: &Link) -> bool {
        let Some(node) = self.nodes.get_mut(link.node.as_str()) else { return false };
        let Some(literal) = node.fields.get_mut(&link.field) else { return false };
        if let Shape::List(items) = &mut literal.shape {
            let before = items.len();
            items.retain(|item| link_text(item) != Some(&link.from));
            return items.len() < before;
        }
        let linked = match &literal.shape {
            Shape::Present(inner) => link_text(inner),
            _ => link_text(literal),
        };
        linked == Some(&link.from) && node.fields.shift_remove(&link.field).is_some()
    }

    /// Gives a field a value; `None` leaves it out, so that it has its default.
    ///
    /// # Errors
    /// If there is no such node.
    pub fn set_field(&mut self, node: &str, field: &str, value: Option<Literal>) -> Result<(), EditError> {
        let entry = self.nodes.get_mut(node).ok_or_else(|| EditError::NoSuchNode(node.to_owned()))?;
        match value {
            Some(value) => entry.fields.insert(field.to_owned(), value),
            None => entry.fields.shift_remove(field),
        };
        Ok(())
    }

    /// Renames a node, and with it every link, its layout and the main output. Its place in the order stays.
    ///
    /// # Errors
    /// If there is none, or the new id cannot be used or is taken.
    pub fn rename(&mut self, registry: &Registry, old: &str, new: &str) -> Result<(), EditError> {
        if !self.nodes.contains_key(old) {
            return Err(EditError::NoSuchNode(old.to_owned()));
        }
        let id = self.free_id(new)?;
        let renamed = |link: &str| format!("{new}{}", &link[old.len()..]);
        for link in self.links(registry).into_iter().filter(|link| starts_at(&link.from, old)) {
            if let Some(literal) = self.nodes.get_mut(link.node.as_str()).and_then(|node| node.fields.get_mut(&link.field)) {
                relink(literal, &link.from, &renamed(&link.from));
            }
        }
        if let Some(output) = self.output.as_mut().filter(|output| starts_at(output, old)) {
            *output = renamed(output);
        }
        self.nodes = rekeyed(std::mem::take(&mut self.nodes), old, &id);
        self.layout = rekeyed(std::mem::take(&mut self.layout), old, &id);
        Ok(())
    }

    /// Says where an editor shows a node, in points. No result depends on it.
    ///
    /// # Errors
    /// If there is none.
    pub fn move_to(&mut self, id: &str, x: f64, y: f64) -> Result<(), EditError> {
        let (id, _) = self.nodes.get_key_value(id).ok_or_else(|| EditError::NoSuchNode(id.to_owned()))?;
        self.layout.insert(id.clone(), (x, y));
        Ok(())
    }

    /// Every link, in the order of the document, whether or not it leads somewhere. In nodes of unknown kind a string
    /// is taken for a link if it begins with a node's id and a dot.
    pub fn links(&self, registry: &Registry) -> Vec<Link> {
        let mut links = Vec::new();
        for (id, node) in &self.nodes {
            let specification = registry.specification(&node.kind);
            for (field, literal) in &node.fields {
                let takes_text = specification.and_then(|s| s.param(field)).is_some_and(|param| param.ty.takes_text());
                let inner = match &literal.shape {
                    Shape::List(items) => items.as_slice(),
                    Shape::Present(inner) => std::slice::from_ref(&**inner),
                    _ => std::slice::from_ref(literal),
                };
                let texts = inner.iter().filter(|item| !takes_text || matches!(item.shape, Shape::Call(..))).filter_map(link_text);
                let known =
                    |text: &&str| text.split_once('.').is_some_and(|(id, _)| specification.is_some() || self.nodes.contains_key(id));
                links.extend(texts.filter(known).map(|from| Link { from: from.to_owned(), node: id.clone(), field: field.clone() }));
            }
        }
        links
    }

    fn free_id(&self, id: &str) -> Result<NodeId, EditError> {
        let node_id = NodeId::new(id).ok_or_else(|| EditError::BadId(id.to_owned()))?;
        if self.nodes.contains_key(id) { Err(EditError::Taken(id.to_owned())) } else { Ok(node_id) }
    }
}

/// Whether the link begins at the node.
fn starts_at(link: &str, id: &str) -> bool {
    link.split_once('.').is_some_and(|(node, _)| node == id)
}

/// Replaces a link within a field's literal.
fn relink(literal: &mut Literal, from: &str, to: &str) {
    match &mut literal.shape {
        Shape::Text(text) if text == from => to.clone_into(text),
        Shape::Present(inner) => relink(inner, from, to),
        Shape::List(items) | Shape::Call(_, items) => items.iter_mut().for_each(|item| relink(item, from, to)),
        _ => {}
    }
}

fn rekeyed<V>(map: IndexMap<NodeId, V>, old: &str, new: &NodeId) -> IndexMap<NodeId, V> {
    map.into_iter().map(|(id, value)| (if id.as_str() == old { new.clone() } else { id }, value)).collect()
}
