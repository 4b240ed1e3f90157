//! Changes to a graph: what `--set` and an editor's commands do.

use std::path::Path;

use indexmap::IndexMap;

use crate::check::{is_link, link_text};
use crate::conform::{conform, unknown_field};
use crate::fault::{Fault, FaultKind, nearest};
use crate::graph::{Graph, GraphNode, NodeId};
use crate::literal::{Literal, Name, Shape};
use crate::read::read;
use crate::registry::Registry;
use crate::spec::{ParamSpec, ParamType};

/// A setting that does not fit the graph.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetError {
    /// Not of the form `node.input`.
    #[error("{target:?} is not of the form NODE.INPUT")]
    Form {
        /// What was to be set.
        target: String,
    },
    /// There is no such node or field, or the value does not fit it.
    #[error("{target}={value}: {fault}")]
    Fault {
        /// What was to be set.
        target: String,
        /// The value, as given.
        value: String,
        /// What is wrong.
        fault: Fault,
    },
}

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
    /// Overrides a field by a value given as text: `set(registry, "patches.tile_size", "0.1", …)`.
    ///
    /// The value is RON. For a text or a file, what is no string in quotes is taken as it stands, and a path is relative to
    /// `directory` (the working directory of who gives it) rather than to the graph file. For an input the quotes of
    /// a link may be left out. A field within a variant is named with one more dot: `hair.style.radius`.
    ///
    /// # Errors
    /// If there is no such node or field, or the value does not fit. Whether a link leads somewhere is for
    /// [`check`](Self::check) to say.
    pub fn set(&mut self, registry: &Registry, target: &str, value: &str, directory: &Path) -> Result<(), SetError> {
        let mut parts = target.splitn(3, '.');
        let (Some(id), Some(field), within) = (parts.next(), parts.next(), parts.next()) else {
            return Err(SetError::Form { target: target.to_owned() });
        };
        // Absolute, as the graph's own folder would be put before it otherwise.
        let directory = if directory.as_os_str().is_empty() { Path::new(".") } else { directory };
        let directory = std::path::absolute(directory).unwrap_or_else(|_| directory.to_owned());
        let literal = self.parse_setting(registry, id, field, within, value, &directory).map_err(|(at, kind)| {
            let node = NodeId::new(id).filter(|id| self.nodes.contains_key(id));
            let fault = Fault { place: None, node, field: at, kind };
            SetError::Fault { target: target.to_owned(), value: value.to_owned(), fault }
        })?;
        if let Some(node) = self.nodes.get_mut(id) {
            node.fields.insert(field.to_owned(), literal);
        }
        Ok(())
    }

    /// The literal that a setting stands for, or what is wrong with it, and in which field.
    fn parse_setting(
        &self,
        registry: &Registry,
        id: &str,
        field: &str,
        within: Option<&str>,
        value: &str,
        directory: &Path,
    ) -> Result<Literal, (Option<String>, FaultKind)> {
        let node = self.nodes.get(id).ok_or_else(|| {
            let nearest = nearest(id, self.nodes.keys().map(NodeId::as_str));
            (None, FaultKind::NoSuchNode { target: id.to_owned(), nearest })
        })?;
        let specification = registry.specification(&node.kind).ok_or_else(|| {
            let nearest = nearest(&node.kind, registry.kind_names());
            (None, FaultKind::UnknownKind { kind: node.kind.clone(), nearest })
        })?;
        if specification.input(field).is_some() && within.is_none() {
            return Ok(unplaced(read(value).ok().filter(|read| !matches!(read.shape, Shape::Word(_))).unwrap_or_else(|| value.into())));
        }
        let Some(param) = specification.param(field) else {
            let known: Vec<&str> = specification.field_names().collect();
            return Err((None, unknown_field(&node.kind, field, known.into_iter())));
        };
        let current = node.fields.get(field).or(param.default.as_ref());
        let literal = match within {
            None => read_value(param, value).map_err(|kind| (Some(field.to_owned()), kind))?,
            Some(inner) => {
                let mut misfits = Vec::new();
                let whole = current.filter(|current| !is_link(&param.ty, current)).map(|current| conform(param, current, &mut misfits));
                replaced(param, whole, inner, value).map_err(|kind| (Some(format!("{field}.{inner}")), kind))?
            }
        };
        if is_link(&param.ty, &literal) {
            return Ok(literal);
        }
        let mut misfits = Vec::new();
        let canonical = conform(param, &literal, &mut misfits);
        match misfits.into_iter().next() {
            Some(misfit) => Err((Some(format!("{field}{}", misfit.path)), misfit.kind)),
            None if holds_files(&param.ty) => Ok(resolved(&param.ty, &canonical, directory)),
            None => Ok(literal),
        }
    }

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
        let literal = if let Some(input) = specification.input(field) {
            match (input.arity, entry.fields.get(field).map(|literal| &literal.shape)) {
                (crate::spec::Arity::Many, Some(Shape::List(items))) => {
                    Shape::List(items.iter().cloned().chain([from.into()]).collect()).into()
                }
                (crate::spec::Arity::Many, _) => Shape::List(vec![from.into()]).into(),
                _ => from.into(),
            }
        } else {
            let param = specification.param(field).ok_or_else(no_field)?;
            if param.ty.takes_text() { Literal::link(from) } else { from.into() }
        };
        entry.fields.insert(field.to_owned(), literal);
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

/// The literal without its places, which were those of a setting's text and not of the graph's.
fn unplaced(mut literal: Literal) -> Literal {
    literal.place = None;
    match &mut literal.shape {
        Shape::Present(inner) => **inner = unplaced(std::mem::replace(inner, Shape::Absent.into())),
        Shape::Tuple(items) | Shape::List(items) | Shape::Call(_, items) => {
            for item in items {
                *item = unplaced(std::mem::replace(item, Shape::Absent.into()));
            }
        }
        Shape::Record(_, fields) => {
            for (name, item) in fields {
                name.place = None;
                *item = unplaced(std::mem::replace(item, Shape::Absent.into()));
            }
        }
        Shape::Map(entries) => {
            for (key, item) in entries {
                *key = unplaced(std::mem::replace(key, Shape::Absent.into()));
                *item = unplaced(std::mem::replace(item, Shape::Absent.into()));
            }
        }
        _ => {}
    }
    literal
}

/// A setting's value for a parameter; a text that is no RON is itself.
fn read_value(param: &ParamSpec, value: &str) -> Result<Literal, FaultKind> {
    let literal = read(value).map(unplaced);
    if param.ty.takes_text() {
        let given = literal.ok().filter(|literal| match &literal.shape {
            Shape::Text(_) => true,
            Shape::Call(name, _) => name == "Link",
            Shape::Absent | Shape::Present(_) => matches!(param.ty, ParamType::Optional(_)),
            _ => false,
        });
        return Ok(given.unwrap_or_else(|| value.into()));
    }
    literal.map_err(|error| FaultKind::WrongType { expected: param.ty.to_string(), found: format!("{value:?} ({})", error.message) })
}

/// A parameter's value with one field within it replaced; `inner` is `radius`, or `outer.radius`.
fn replaced(param: &ParamSpec, whole: Option<Literal>, inner: &str, value: &str) -> Result<Literal, FaultKind> {
    let (first, rest) = inner.split_once('.').map_or((inner, None), |(first, rest)| (first, Some(rest)));
    let no_field = |owner: &str, known: &[&str]| unknown_field(owner, first, known.to_vec().into_iter());
    let Some(mut whole) = whole else { return Err(no_field(&param.name, &[])) };
    let target = match &mut whole.shape {
        Shape::Present(inner) => &mut **inner,
        _ => &mut whole,
    };
    let Shape::Record(name, fields) = &mut target.shape else { return Err(no_field(&param.name, &[])) };
    let record = match strip_optional(&param.ty) {
        ParamType::Choice(choice) => choice.variants.iter().find(|variant| Some(&variant.name) == name.as_ref()),
        ParamType::Record(record) => Some(record),
        _ => None,
    };
    let Some(record) = record else { return Err(no_field(&param.name, &[])) };
    let known: Vec<&str> = record.fields.iter().map(|field| field.name.as_str()).collect();
    let Some(spec) = record.fields.iter().find(|field| field.name == first) else { return Err(no_field(&record.name, &known)) };
    let position = fields.iter().position(|(name, _)| name.text == first);
    let new = match rest {
        None => read_value(spec, value)?,
        Some(rest) => replaced(spec, position.map(|at| fields[at].1.clone()), rest, value)?,
    };
    match position {
        Some(at) => fields[at].1 = new,
        None => fields.push((Name { text: first.to_owned(), place: None }, new)),
    }
    Ok(whole)
}

fn strip_optional(ty: &ParamType) -> &ParamType {
    if let ParamType::Optional(inner) = ty { strip_optional(inner) } else { ty }
}

/// Whether a file path may be in it.
fn holds_files(ty: &ParamType) -> bool {
    match ty {
        ParamType::File => true,
        ParamType::Tuple(items) => items.iter().any(holds_files),
        ParamType::List(inner) | ParamType::Optional(inner) => holds_files(inner),
        ParamType::Choice(choice) => choice.variants.iter().flat_map(|variant| &variant.fields).any(|field| holds_files(&field.ty)),
        ParamType::Record(record) => record.fields.iter().any(|field| holds_files(&field.ty)),
        _ => false,
    }
}

/// A canonical value with each path in it joined to `directory`; absolute ones stay.
pub(crate) fn resolved(ty: &ParamType, literal: &Literal, directory: &Path) -> Literal {
    let all = |types: &mut dyn Iterator<Item = &ParamType>, items: &[Literal]| {
        items.iter().zip(types).map(|(item, ty)| resolved(ty, item, directory)).collect::<Vec<_>>()
    };
    let fields = |specs: &[ParamSpec], fields: &[(Name, Literal)]| {
        let one = |(name, value): &(Name, Literal)| {
            let spec = specs.iter().find(|spec| spec.name == name.text);
            (name.clone(), spec.map_or_else(|| value.clone(), |spec| resolved(&spec.ty, value, directory)))
        };
        fields.iter().map(one).collect::<Vec<_>>()
    };
    let shape = match (ty, &literal.shape) {
        (ParamType::File, Shape::Text(path)) => Shape::Text(directory.join(path).to_string_lossy().into_owned()),
        (ParamType::Optional(ty), Shape::Present(inner)) => Shape::Present(Box::new(resolved(ty, inner, directory))),
        (ParamType::Tuple(types), Shape::Tuple(items)) => Shape::Tuple(all(&mut types.iter(), items)),
        (ParamType::List(ty), Shape::List(items)) => Shape::List(all(&mut std::iter::repeat(&**ty), items)),
        (ParamType::Record(record), Shape::Record(name, given)) => Shape::Record(name.clone(), fields(&record.fields, given)),
        (ParamType::Choice(choice), Shape::Record(Some(name), given)) => {
            let variant = choice.variants.iter().find(|variant| variant.name == *name);
            Shape::Record(Some(name.clone()), variant.map_or_else(|| given.clone(), |variant| fields(&variant.fields, given)))
        }
        (_, shape) => shape.clone(),
    };
    Literal { shape, place: literal.place }
}
