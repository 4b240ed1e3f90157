//! The node reference as Markdown, for the book.

use std::fmt::Write;

use crate::registry::Registry;
use crate::spec::{Arity, ParamSpec, ParamType, Specification};

/// Every node, by category in the order in which the registry first names each, nodes in the order of registration.
pub fn reference_markdown(registry: &Registry) -> String {
    let mut categories: Vec<&str> = Vec::new();
    for specification in registry.specifications() {
        if !categories.contains(&specification.category.as_str()) {
            categories.push(&specification.category);
        }
    }
    let mut out = "# Node reference\n".to_owned();
    for category in categories {
        out.push_str(&format!("\n## {category}\n"));
        for specification in registry.specifications().filter(|specification| specification.category == category) {
            out.push('\n');
            out.push_str(&node_markdown(specification));
        }
    }
    out
}

/// One node: what it does, its inputs, parameters and outputs.
pub fn node_markdown(specification: &Specification) -> String {
    let mut out = String::new();
    // Writing to a String cannot fail.
    let _ = write_node(specification, &mut out);
    out
}

fn write_node(specification: &Specification, out: &mut String) -> std::fmt::Result {
    writeln!(out, "### {}\n\n{}", specification.kind, specification.doc)?;
    if !specification.inputs.is_empty() {
        writeln!(out, "\n| input | type | |\n|---|---|---|")?;
    }
    for input in &specification.inputs {
        let arity = match input.arity {
            Arity::One => "",
            Arity::Optional => ", optional",
            Arity::Many => ", any number",
        };
        writeln!(out, "| `{}` | {}{arity} | {} |", input.name, input.ty.name, cell(&input.doc))?;
    }
    if !specification.params.is_empty() {
        writeln!(out, "\n| parameter | default | range | unit | |\n|---|---|---|---|---|")?;
    }
    for param in &specification.params {
        write_param(param, &param.name, out)?;
    }
    writeln!(out, "\n| output | type | |\n|---|---|---|")?;
    for output in &specification.outputs {
        writeln!(out, "| `{}` | {} | {} |", output.name, output.ty.name, cell(&output.doc))?;
    }
    for output in specification.outputs.iter().filter(|output| !output.parts.is_empty()) {
        let parts: Vec<String> = output.parts.iter().map(|part| format!("`{}`, {}", part.name, cell(part.doc))).collect();
        writeln!(out, "\nOf `{}` are made only where they are wanted: {}.", output.name, parts.join("; "))?;
    }
    if !specification.context.is_empty() {
        writeln!(out, "\nDepends on the context: {}.", specification.context.join(", "))?;
    }
    Ok(())
}

/// One row, and one more for each field within.
fn write_param(param: &ParamSpec, path: &str, out: &mut String) -> std::fmt::Result {
    let default = param.default.as_ref().map_or_else(|| "required".to_owned(), |default| format!("`{default}`"));
    let range = param.range.map_or_else(|| param.ty.to_string(), |range| range.to_string());
    let effect = param.effect.as_ref().map(|effect| format!(" *{}*", cell(effect))).unwrap_or_default();
    let unit = param.unit.as_deref().unwrap_or("");
    writeln!(out, "| `{path}` | {} | {} | {} | {}{effect} |", cell(&default), cell(&range), cell(unit), cell(&param.doc))?;
    write_nested(&param.ty, path, out)
}

fn write_nested(ty: &ParamType, path: &str, out: &mut String) -> std::fmt::Result {
    match ty {
        ParamType::Optional(inner) | ParamType::List(inner) => write_nested(inner, path, out),
        ParamType::Record(record) => record.fields.iter().try_for_each(|field| write_param(field, &format!("{path}.{}", field.name), out)),
        ParamType::Choice(choice) => choice.variants.iter().try_for_each(|variant| {
            writeln!(out, "| `{path}: {}` | | | | {} |", variant.name, cell(&variant.doc))?;
            variant.fields.iter().try_for_each(|field| write_param(field, &format!("{path}.{}", field.name), out))
        }),
        _ => Ok(()),
    }
}

/// Text that cannot break out of a table's cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace("\n\n", "<br>").replace('\n', " ")
}
