//! What the code that `#[derive(Param)]` writes calls. Not part of the interface.

use crate::literal::{Literal, Name, Shape};
use crate::param::{Param, ParamError};

/// The name and fields of a variant, in any way of writing it.
#[doc(hidden)]
pub fn read_variant(literal: &Literal) -> Option<(&str, &[(Name, Literal)])> {
    match &literal.shape {
        Shape::Word(name) => Some((name, &[])),
        Shape::Call(name, items) if items.is_empty() => Some((name, &[])),
        Shape::Record(Some(name), fields) => Some((name, fields)),
        _ => None,
    }
}

/// The field `name` among `fields`, or its default.
#[doc(hidden)]
pub fn read_field<P: Param>(
    literal: &Literal,
    fields: &[(Name, Literal)],
    name: &str,
    default: impl FnOnce() -> Option<P>,
) -> Result<P, ParamError> {
    match fields.iter().find(|(field, _)| field.text == name) {
        Some((_, value)) => P::from_literal(value),
        None => default().ok_or_else(|| ParamError { expected: format!("the field {name:?}"), found: literal.describe() }),
    }
}

/// A record or variant as it is written.
#[doc(hidden)]
pub fn write_record(name: Option<&str>, fields: Vec<(&str, Literal)>) -> Literal {
    let fields = fields.into_iter().map(|(name, value)| (Name { text: name.to_owned(), place: None }, value)).collect();
    Shape::Record(name.map(str::to_owned), fields).into()
}
