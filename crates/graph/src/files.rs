//! File paths within parameters.

use std::path::Path;

use crate::check::is_link;
use crate::conform::conform;
use crate::fault::{Fault, FaultKind, Faults};
use crate::graph::Graph;
use crate::literal::{Literal, Name, Shape};
use crate::registry::Registry;
use crate::spec::{ParamSpec, ParamType};

/// Whether a file path may be in it.
pub(crate) fn holds_files(ty: &ParamType) -> bool {
    match ty {
        ParamType::File => true,
        ParamType::Tuple(items) => items.iter().any(holds_files),
        ParamType::List(inner) | ParamType::Optional(inner) => holds_files(inner),
        ParamType::Choice(choice) => choice.variants.iter().flat_map(|variant| &variant.fields).any(|field| holds_files(&field.ty)),
        ParamType::Record(record) => record.fields.iter().any(|field| holds_files(&field.ty)),
        _ => false,
    }
}

/// Every path in a canonical value.
fn paths<'l>(ty: &ParamType, literal: &'l Literal, found: &mut Vec<&'l Literal>) {
    let mut fields = |specs: &[ParamSpec], given: &'l [(Name, Literal)]| {
        for (name, value) in given {
            if let Some(spec) = specs.iter().find(|spec| spec.name == name.text) {
                paths(&spec.ty, value, found);
            }
        }
    };
    match (ty, &literal.shape) {
        (ParamType::File, Shape::Text(_)) => found.push(literal),
        (ParamType::Record(record), Shape::Record(_, given)) => fields(&record.fields, given),
        (ParamType::Choice(choice), Shape::Record(Some(name), given)) => {
            choice.variants.iter().filter(|variant| variant.name == *name).for_each(|variant| fields(&variant.fields, given));
        }
        (ParamType::Optional(ty), Shape::Present(inner)) => paths(ty, inner, found),
        (ParamType::Tuple(types), Shape::Tuple(items)) => types.iter().zip(items).for_each(|(ty, item)| paths(ty, item, found)),
        (ParamType::List(ty), Shape::List(items)) => items.iter().for_each(|item| paths(ty, item, found)),
        _ => {}
    }
}

impl Graph {
    /// Whether every file that a node names can be opened, whatever else may be wrong with the graph. It is not part of
    /// [`check`](Self::check), which looks at nothing but the graph: a run opens those files only that it needs.
    ///
    /// # Errors
    /// Every file that cannot, with the place of its path.
    pub fn check_files(&self, registry: &Registry) -> Result<(), Faults> {
        let mut faults = Vec::new();
        for (id, node) in &self.nodes {
            for param in registry.specification(&node.kind).into_iter().flat_map(|specification| &specification.params) {
                let given = node.field(&param.name, &param.was).or(param.default.as_ref()).filter(|given| !is_link(&param.ty, given));
                let Some(canonical) = given.filter(|_| holds_files(&param.ty)).map(|given| conform(param, given, &mut Vec::new())) else {
                    continue;
                };
                let mut found = Vec::new();
                paths(&param.ty, &canonical, &mut found);
                for (literal, path) in found.into_iter().filter_map(|literal| Some((literal, literal.as_text()?))) {
                    let path = self.directory().join(path);
                    if let Err(error) = opened(&path) {
                        let kind = FaultKind::File { path: path.display().to_string(), message: error.to_string() };
                        faults.push(Fault { place: literal.place, node: Some(id.clone()), field: Some(param.name.clone()), kind });
                    }
                }
            }
        }
        if faults.is_empty() { Ok(()) } else { Err(Faults::new(faults)) }
    }
}

/// A folder opens, but there is nothing to read in it.
fn opened(path: &Path) -> std::io::Result<()> {
    let is_folder = std::fs::File::open(path)?.metadata()?.is_dir();
    if is_folder { Err(std::io::ErrorKind::IsADirectory.into()) } else { Ok(()) }
}

/// A canonical value with each path in it joined to `directory`; absolute ones stay.
pub(crate) fn resolved(ty: &ParamType, literal: &Literal, directory: &Path) -> Literal {
    with_paths(ty, literal, &|path| directory.join(path).to_string_lossy().into_owned())
}

/// A value, canonical or as it is written, with another path in place of each.
pub(crate) fn with_paths(ty: &ParamType, literal: &Literal, path: &dyn Fn(&str) -> String) -> Literal {
    let all = |types: &mut dyn Iterator<Item = &ParamType>, items: &[Literal]| {
        items.iter().zip(types).map(|(item, ty)| with_paths(ty, item, path)).collect::<Vec<_>>()
    };
    let fields = |specs: &[ParamSpec], fields: &[(Name, Literal)]| {
        let one = |(name, value): &(Name, Literal)| {
            let spec = specs.iter().find(|spec| spec.name == name.text || spec.was.contains(&name.text));
            (name.clone(), spec.map_or_else(|| value.clone(), |spec| with_paths(&spec.ty, value, path)))
        };
        fields.iter().map(one).collect::<Vec<_>>()
    };
    let shape = match (ty, &literal.shape) {
        (ParamType::File, Shape::Text(text)) => Shape::Text(path(text)),
        (ParamType::Optional(ty), Shape::Present(inner)) => Shape::Present(Box::new(with_paths(ty, inner, path))),
        (ParamType::Optional(ty), _) => return with_paths(ty, literal, path),
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
