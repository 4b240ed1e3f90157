//! What can be told of a type by the way it is written.

use syn::{GenericArgument, PathArguments, Type};

/// The argument of `Wrapper<T>`.
pub(crate) fn argument<'t>(ty: &'t Type, wrapper: &str) -> Option<&'t Type> {
    let Type::Path(path) = ty else { return None };
    let last = path.path.segments.last().filter(|last| last.ident == wrapper)?;
    let PathArguments::AngleBracketed(arguments) = &last.arguments else { return None };
    match arguments.args.first() {
        Some(GenericArgument::Type(ty)) if arguments.args.len() == 1 => Some(ty),
        _ => None,
    }
}

/// Whether the type is one of these names.
pub(crate) fn named(ty: &Type, names: &[&str]) -> bool {
    matches!(ty, Type::Path(path) if path.path.segments.last().is_some_and(|last| last.arguments.is_empty() && names.iter().any(|name| last.ident == name)))
}

/// A number, by itself or as an option.
pub(crate) fn is_number(ty: &Type) -> bool {
    named(ty, &["f32", "f64", "i32", "i64", "u32", "u64"]) || argument(ty, "Option").is_some_and(is_number)
}

/// Whether there are numbers in the type that have no documentation of their own.
pub(crate) fn holds_numbers(ty: &Type) -> bool {
    match ty {
        Type::Array(array) => holds_numbers(&array.elem),
        Type::Tuple(tuple) => tuple.elems.iter().any(holds_numbers),
        Type::Paren(inner) => holds_numbers(&inner.elem),
        Type::Group(inner) => holds_numbers(&inner.elem),
        _ => is_number(ty) || ["Option", "Vec"].iter().any(|wrapper| argument(ty, wrapper).is_some_and(holds_numbers)),
    }
}
