//! The struct of a node's outputs.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::ext::IdentExt;
use syn::{DeriveInput, Ident};

use crate::attributes::OutputAttribute;

/// The struct's name, its definition, and the specification of each output.
pub(crate) struct OutputTokens {
    pub(crate) ident: Ident,
    pub(crate) definition: TokenStream,
    pub(crate) specs: Vec<TokenStream>,
}

pub(crate) fn outputs(input: &DeriveInput) -> syn::Result<OutputTokens> {
    let attributes = input.attrs.iter().filter(|attribute| attribute.path().is_ident("output"));
    let outputs: Vec<OutputAttribute> = attributes.map(syn::Attribute::parse_args).collect::<syn::Result<_>>()?;
    if outputs.is_empty() {
        return Err(syn::Error::new(input.ident.span(), "a node needs an output: #[output(port: Type, \"What it is.\")]"));
    }
    for (index, output) in outputs.iter().enumerate() {
        if outputs[..index].iter().any(|earlier| earlier.name == output.name) {
            return Err(syn::Error::new(output.name.span(), "this output is given twice"));
        }
    }
    let visibility = &input.vis;
    let node = &input.ident;
    let ident = format_ident!("{}Outputs", input.ident);
    let doc = format!(" Outputs of [`{node}`]; those that are not wanted may be left `None`.");
    let (names, types): (Vec<_>, Vec<_>) = outputs.iter().map(|output| (&output.name, &output.ty)).unzip();
    let docs: Vec<String> = outputs.iter().map(|output| output.doc.value()).collect();
    let labels: Vec<String> = names.iter().map(|name| name.unraw().to_string()).collect();
    let from_one = (outputs.len() == 1).then(|| {
        let (name, ty) = (names[0], types[0]);
        quote! {
            impl ::core::convert::From<#ty> for #ident {
                fn from(value: #ty) -> Self {
                    Self { #name: ::core::option::Option::Some(::std::sync::Arc::new(value)) }
                }
            }
            impl ::core::convert::From<::std::sync::Arc<#ty>> for #ident {
                fn from(value: ::std::sync::Arc<#ty>) -> Self {
                    Self { #name: ::core::option::Option::Some(value) }
                }
            }
        }
    });
    let definition = quote! {
        #[doc = #doc]
        #[derive(Default)]
        #visibility struct #ident {
            #(#[doc = #docs] pub #names: ::core::option::Option<::std::sync::Arc<#types>>,)*
        }
        #from_one
        impl ::pelage_graph::Outputs for #ident {
            fn into_values(self) -> ::std::vec::Vec<(&'static str, ::core::option::Option<::pelage_graph::Value>)> {
                ::std::vec![#((#labels, self.#names.map(::pelage_graph::Value::new))),*]
            }
        }
    };
    let specs = labels.iter().zip(&outputs).zip(&docs).map(|((name, OutputAttribute { ty, parts, .. }), doc)| {
        quote!(::pelage_graph::OutputSpec {
            name: #name.into(),
            doc: #doc.into(),
            ty: ::pelage_graph::PortType::of::<#ty>(),
            parts: ::std::vec![#(#parts),*],
        })
    });
    Ok(OutputTokens { ident, definition, specs: specs.collect() })
}
