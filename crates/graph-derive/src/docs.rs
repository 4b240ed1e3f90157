//! Documentation comments, without which nothing compiles.

use proc_macro2::Span;
use syn::{Attribute, Expr, ExprLit, Lit, Meta};

/// The documentation of an item: its lines joined, paragraphs kept apart.
pub(crate) fn documentation(attributes: &[Attribute], span: Span, what: &str) -> syn::Result<String> {
    let lines = attributes.iter().filter_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
            Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    });
    let mut doc = String::new();
    for line in lines.flat_map(|text| text.lines().map(|line| line.trim().to_owned()).collect::<Vec<_>>()) {
        if line.is_empty() {
            doc.push_str("\n\n");
        } else {
            if !doc.is_empty() && !doc.ends_with('\n') {
                doc.push(' ');
            }
            doc.push_str(&line);
        }
    }
    let doc = doc.trim().to_owned();
    if doc.is_empty() {
        return Err(syn::Error::new(span, format!("{what} needs a doc comment: it is the text of the reference and the tooltip")));
    }
    Ok(doc)
}
