//! File paths within parameters.

use std::path::Path;

use crate::literal::{Literal, Name, Shape};
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
