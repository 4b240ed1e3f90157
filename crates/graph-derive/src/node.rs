//! `#[derive(Node)]`.

use proc_macro2::TokenStream;
use quote::quote;
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{Data, DeriveInput, Field, Fields};

use crate::attributes::{InputAttribute, NodeAttribute, single};
use crate::docs::documentation;
use crate::outputs::{OutputTokens, outputs};
use crate::param::param_field;
use crate::types::argument;

pub(crate) fn derive(input: &DeriveInput) -> syn::Result<TokenStream> {
    if !input.generics.params.is_empty() {
        return Err(syn::Error::new(input.generics.span(), "a node has no generics"));
    }
    let ident = &input.ident;
    let fields = match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(fields) => fields.named.iter().collect(),
            Fields::Unit => Vec::new(),
            Fields::Unnamed(_) => return Err(syn::Error::new(ident.span(), "a node's fields need names: they are written in the file")),
        },
        _ => return Err(syn::Error::new(ident.span(), "a node is a struct")),
    };
    let doc = documentation(&input.attrs, ident.span(), &format!("the node `{ident}`"))?;
    let attribute: NodeAttribute = match single(&input.attrs, "node")? {
        Some(attribute) => attribute.parse_args()?,
        None => NodeAttribute::default(),
    };
    let category = attribute.category.filter(|category| !category.value().trim().is_empty());
    let category = category.ok_or_else(|| syn::Error::new(ident.span(), "a node needs a category: #[node(category = \"…\")]"))?;
    let version = attribute.version.map_or_else(|| quote!(1), |version| quote!(#version));
    let kind = attribute.name.map_or_else(|| ident.unraw().to_string(), |name| name.value());
    let (context, was) = (&attribute.context, &attribute.was);
    let OutputTokens { ident: outputs, definition, specs } = outputs(input)?;
    let (mut inputs, mut params, mut reads, mut assertions) = (Vec::new(), Vec::new(), Vec::new(), TokenStream::new());
    for field in fields {
        let Some(name) = &field.ident else { continue };
        let label = name.unraw().to_string();
        match (single(&field.attrs, "input")?, single(&field.attrs, "param")?) {
            (Some(attribute), None) => {
                let (spec, read) = input_field(field, &label, &InputAttribute::read(attribute)?)?;
                inputs.push(spec);
                reads.push(quote!(#name: #read));
            }
            (None, Some(_)) => {
                let tokens = param_field(field)?;
                params.push(tokens.spec);
                assertions.extend(tokens.assertions);
                reads.push(quote!(#name: fields.param(#label)?));
            }
            _ => return Err(syn::Error::new(name.span(), format!("`{label}` needs one of #[input] and #[param]"))),
        }
    }
    Ok(quote! {
        #definition
        #assertions
        impl ::pelage_graph::Node for #ident {
            type Outputs = #outputs;
            fn specification() -> ::pelage_graph::Specification {
                ::pelage_graph::Specification {
                    kind: #kind.into(),
                    doc: #doc.into(),
                    category: #category.into(),
                    version: #version,
                    context: ::std::vec![#(#context.into()),*],
                    was: ::std::vec![#(#was.into()),*],
                    inputs: ::std::vec![#(#inputs),*],
                    params: ::std::vec![#(#params),*],
                    outputs: ::std::vec![#(#specs),*],
                }
            }
            fn fetch(fields: &::pelage_graph::Fields<'_>) -> ::core::result::Result<Self, ::pelage_graph::NodeError> {
                let _ = fields;
                ::core::result::Result::Ok(Self { #(#reads),* })
            }
        }
    })
}

/// The specification of an input and the expression that fetches it.
fn input_field(field: &Field, label: &str, attribute: &InputAttribute) -> syn::Result<(TokenStream, TokenStream)> {
    let doc = documentation(&field.attrs, field.ident.span(), &format!("the input `{label}`"))?;
    let ty = &field.ty;
    let shared = |wrapper| argument(ty, wrapper).and_then(|inner| argument(inner, "Arc"));
    let (inner, arity, read) = if let Some(inner) = argument(ty, "Arc") {
        (inner, quote!(One), quote!(fields.input(#label)?))
    } else if let Some(inner) = shared("Option") {
        let arity = if attribute.required { quote!(One) } else { quote!(Optional) };
        (inner, arity, quote!(fields.optional_input(#label)?))
    } else if let Some(inner) = shared("Vec") {
        (inner, quote!(Many), quote!(fields.input_list(#label)?))
    } else {
        return Err(syn::Error::new(ty.span(), "an input is Arc<T>, Option<Arc<T>> or Vec<Arc<T>>"));
    };
    if attribute.required && shared("Option").is_none() {
        return Err(syn::Error::new(ty.span(), "a required input that may be left out where nobody needs it is Option<Arc<T>>"));
    }
    let always = argument(ty, "Arc").is_some();
    let was = &attribute.was;
    let spec = quote!(::pelage_graph::InputSpec {
        name: #label.into(),
        doc: #doc.into(),
        ty: ::pelage_graph::PortType::of::<#inner>(),
        arity: ::pelage_graph::Arity::#arity,
        always: #always,
        was: ::std::vec![#(#was.into()),*],
    });
    Ok((spec, read))
}
