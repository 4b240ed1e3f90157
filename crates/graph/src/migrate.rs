//! Files of older versions: each step takes the untyped tree of one version to that of the next.
//!
//! What a step passes on keeps its place, so that a fault of an old file is answered with the line of the old file, and saving keeps what
//! the versions have in common. What a step does not know it leaves as it is, for the reader of the present version to answer.
//!
//! A step is for a change of the format. A node or a field that has another name now needs none: its specification says what it was
//! called (`#[node(was("…"))]`).

use crate::literal::{Literal, Name, Shape, identifier};
use crate::read::read;

/// Takes a tree to the next version.
type Step = fn(&mut Literal);

/// The steps, each under the version that it begins at; the last ends at the present version.
const STEPS: [Step; 1] = [links_and_kinds];

/// The version that the reader reads.
pub(crate) const PRESENT: u32 = STEPS.len() as u32;

/// Takes a tree from a version to the present one.
pub(crate) fn migrate(tree: &mut Literal, version: u32) {
    for step in STEPS.iter().skip(version as usize) {
        step(tree);
    }
}

/// From version 0. A node was a record that said its kind and had its links and its values apart, and a link was a pair:
/// `(kind: "Add", inputs: (a: ("two", "value")), params: (times: 3))` is `Add(a: "two.value", times: 3)` now.
fn links_and_kinds(tree: &mut Literal) {
    let Shape::Record(_, fields) = &mut tree.shape else { return };
    for (name, value) in fields {
        match (name.text.as_str(), &mut value.shape) {
            ("output", _) => link(value),
            ("nodes", Shape::Map(nodes)) => nodes.iter_mut().for_each(|(_, node)| kind(node)),
            _ => {}
        }
    }
}

fn kind(node: &mut Literal) {
    let Shape::Record(None, parts) = &node.shape else { return };
    let Some(kind) = parts.iter().find_map(|(name, value)| match &value.shape {
        Shape::Text(kind) if name.text == "kind" && is_name(kind) => Some(kind.clone()),
        _ => None,
    }) else {
        return;
    };
    let mut fields: Vec<(Name, Literal)> = Vec::new();
    for (name, value) in parts {
        match (name.text.as_str(), &value.shape) {
            ("kind", _) => {}
            ("params", Shape::Record(None, params)) => fields.extend(params.iter().cloned()),
            ("inputs", Shape::Record(None, inputs)) => fields.extend(inputs.iter().cloned().map(|(name, mut value)| {
                links(&mut value);
                (name, value)
            })),
            // `()` says none.
            ("params" | "inputs", Shape::Tuple(none)) if none.is_empty() => {}
            _ => fields.push((name.clone(), value.clone())),
        }
    }
    node.shape = Shape::Record(Some(kind), fields);
}

/// Whether a text can stand as a name in a file: any text could be a kind once.
fn is_name(text: &str) -> bool {
    matches!(read(&format!("{}(a: 1)", identifier(text))), Ok(Literal { shape: Shape::Record(Some(name), _), .. }) if name == text)
}

/// One link, or a list of them.
fn links(value: &mut Literal) {
    match &mut value.shape {
        Shape::List(items) => items.iter_mut().for_each(link),
        _ => link(value),
    }
}

/// `("two", "value")` to `"two.value"`.
fn link(value: &mut Literal) {
    if let Shape::Tuple(pair) = &value.shape
        && let [Literal { shape: Shape::Text(node), .. }, Literal { shape: Shape::Text(port), .. }] = pair.as_slice()
    {
        value.shape = Shape::Text(format!("{node}.{port}"));
    }
}
