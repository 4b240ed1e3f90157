//! Overrides given as text: what `--set` does.

use std::path::Path;

use crate::check::is_link;
use crate::conform::{conform, unknown_field};
use crate::fault::{Fault, FaultKind, nearest};
use crate::files::{holds_files, resolved};
use crate::graph::{Graph, NodeId};
use crate::literal::{Literal, Name, Shape};
use crate::param::Param;
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
        fault: Box<Fault>,
    },
}

/// A fault and the field it is in.
type Misplaced = (Option<String>, Box<FaultKind>);

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
            let fault = Box::new(Fault { place: None, node, field: at, kind: *kind });
            SetError::Fault { target: target.to_owned(), value: value.to_owned(), fault }
        })?;
        if let Some(node) = self.nodes.get_mut(id) {
            let specification = registry.specification(&node.kind);
            let input = specification.and_then(|s| s.input(field)).map(|input| (&input.name, &input.was));
            let param = || specification.and_then(|s| s.param(field)).map(|param| (&param.name, &param.was));
            if let Some((name, was)) = input.or_else(param) {
                node.give(name, was, literal);
            }
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
    ) -> Result<Literal, Misplaced> {
        let node = self.nodes.get(id).ok_or_else(|| {
            let nearest = nearest(id, self.nodes.keys().map(NodeId::as_str));
            (None, Box::new(FaultKind::NoSuchNode { target: id.to_owned(), nearest }))
        })?;
        let specification = registry.specification(&node.kind).ok_or_else(|| {
            let nearest = nearest(&node.kind, registry.kind_names());
            (None, Box::new(FaultKind::UnknownKind { kind: node.kind.clone(), nearest }))
        })?;
        if specification.input(field).is_some() && within.is_none() {
            return Ok(unplaced(read(value).ok().filter(|read| !matches!(read.shape, Shape::Word(_))).unwrap_or_else(|| value.into())));
        }
        let Some(param) = specification.param(field) else {
            let known: Vec<&str> = specification.field_names().collect();
            return Err((None, Box::new(unknown_field(&node.kind, field, known.into_iter()))));
        };
        let current = node.field(&param.name, &param.was).or(param.default.as_ref());
        let literal = match within {
            None => read_value(param, value).map_err(|kind| (Some(field.to_owned()), kind))?,
            Some(inner) => {
                let whole = current.filter(|current| !is_link(&param.ty, current)).cloned();
                replaced(param, whole, inner, value).map_err(|kind| (Some(format!("{field}.{inner}")), kind))?
            }
        };
        if is_link(&param.ty, &literal) {
            return Ok(literal);
        }
        let mut misfits = Vec::new();
        let canonical = conform(param, &literal, &mut misfits);
        match misfits.into_iter().next() {
            Some(misfit) => Err((Some(format!("{field}{}", misfit.path)), Box::new(misfit.kind))),
            None if holds_files(&param.ty) => Ok(resolved(&param.ty, &canonical, directory)),
            None => Ok(literal),
        }
    }
}

impl ParamSpec {
    /// A value given as text, as [`Graph::set`] takes it: in range, and complete with the defaults of what is left out in it.
    ///
    /// # Errors
    /// If it does not fit the parameter, or is a link.
    pub fn read<P: Param>(&self, value: &str) -> Result<P, FaultKind> {
        let literal = read_value(self, value).map_err(|kind| *kind)?;
        let mut misfits = Vec::new();
        let canonical = conform(self, &literal, &mut misfits);
        match misfits.into_iter().next() {
            Some(misfit) => Err(misfit.kind),
            None => P::from_literal(&canonical).map_err(|error| FaultKind::WrongType { expected: error.expected, found: error.found }),
        }
    }
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
fn read_value(param: &ParamSpec, value: &str) -> Result<Literal, Box<FaultKind>> {
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
    literal.map_err(|error| {
        let found = format!("{value:?} ({})", error.message);
        Box::new(FaultKind::WrongType { expected: param.ty.to_string(), found })
    })
}

/// A parameter's value with one field within it replaced, the rest as it is written; `inner` is `radius`, or `outer.radius`.
fn replaced(param: &ParamSpec, whole: Option<Literal>, inner: &str, value: &str) -> Result<Literal, Box<FaultKind>> {
    let (first, rest) = inner.split_once('.').map_or((inner, None), |(first, rest)| (first, Some(rest)));
    let no_field = |owner: &str, known: &[&str]| Box::new(unknown_field(owner, first, known.iter().copied()));
    let Some(mut whole) = whole else { return Err(no_field(&param.name, &[])) };
    let target = match &mut whole.shape {
        Shape::Present(inner) => &mut **inner,
        _ => &mut whole,
    };
    match &target.shape {
        Shape::Word(name) => target.shape = Shape::Record(Some(name.clone()), Vec::new()),
        Shape::Call(name, items) if items.is_empty() => target.shape = Shape::Record(Some(name.clone()), Vec::new()),
        Shape::Tuple(items) if items.is_empty() => target.shape = Shape::Record(None, Vec::new()),
        _ => {}
    }
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
        Some(rest) => replaced(spec, position.map(|at| fields[at].1.clone()).or_else(|| spec.default.clone()), rest, value)?,
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
