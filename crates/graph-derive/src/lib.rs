//! The derives of [`pelage-graph`](../pelage_graph/index.html): a documented struct becomes a node, a documented enum or struct a
//! parameter.
//!
//! Nothing here is of use alone; `pelage-graph` exports both derives beside the traits they implement.
//!
//! # `#[derive(Node)]`
//!
//! On a struct with named fields:
//!
//! | attribute | says |
//! |---|---|
//! | `#[node(category = "…")]` | the group it is listed under; required |
//! | `#[node(version = 2)]` | version of the implementation, 1 if left out |
//! | `#[node(name = "…")]` | its kind in files, the struct's name if left out |
//! | `#[node(was("…"))]` | kinds it had in files before; also on `#[input(…)]` and `#[param(…)]`, for fields that were renamed |
//! | `#[node(context("frame", "adapter"))]` | context values it reads |
//! | `#[output(port: Type, "What it is.")]` | one for each output, at least one; makes the struct `<Name>Outputs` |
//! | `#[output(port: Type, "What it is.", parts = [A, B])]` | the same of a value with parts that are made only where they are wanted, constants of type `Part` |
//! | `#[input]` on a field `Arc<T>`, `Option<Arc<T>>`, `Vec<Arc<T>>` | a value from another node |
//! | `#[input(required)]` on a field `Option<Arc<T>>` | one that files must link, and that is `None` where no wanted output needs it |
//! | `#[param(default = …, range = …, unit = "…", effect = "…")]` on a field | a value in the file |
//!
//! # `#[derive(Param)]`
//!
//! On an enum with unit and struct variants, or a struct with named fields; each field takes `#[param(…)]` as above.
//!
//! # What does not compile
//!
//! Anything without documentation; numbers without a unit; a default outside its range.

mod attributes;
mod docs;
mod limits;
mod node;
mod outputs;
mod param;
mod types;

use proc_macro::TokenStream;
use syn::{DeriveInput, parse_macro_input};

/// Makes a documented struct a node. See the [crate](self) for the attributes.
#[proc_macro_derive(Node, attributes(node, output, input, param))]
pub fn derive_node(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    node::derive(&input).unwrap_or_else(syn::Error::into_compile_error).into()
}

/// Makes a documented enum or struct a parameter. See the [crate](self) for the attributes.
#[proc_macro_derive(Param, attributes(param))]
pub fn derive_param(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    param::derive(&input).unwrap_or_else(syn::Error::into_compile_error).into()
}
