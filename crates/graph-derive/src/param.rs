//! `#[derive(Param)]`, and the specification of one parameter, which `#[derive(Node)]` needs too.

use proc_macro2::TokenStream;
use quote::quote;
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{Data, DeriveInput, Expr, ExprLit, Field, Fields, FieldsNamed, Lit};

use crate::attributes::{ParamAttribute, single};
use crate::docs::documentation;
use crate::limits::{limits, within};
use crate::types::{argument, holds_numbers, named};

/// A parameter's specification, and assertions to be made beside it.
pub(crate) struct ParamTokens {
    pub(crate) spec: TokenStream,
    pub(crate) assertions: TokenStream,
    /// An expression of type `Option<Self>`: the value when left out.
    pub(crate) default: TokenStream,
}

/// Reads a field with `#[param(…)]`; a variant's field may go without the attribute.
pub(crate) fn param_field(field: &Field) -> syn::Result<ParamTokens> {
    let Some(ident) = &field.ident else { return Err(syn::Error::new(field.span(), "a parameter needs a name")) };
    let name = ident.unraw().to_string();
    let doc = documentation(&field.attrs, ident.span(), &format!("the parameter `{name}`"))?;
    let attribute = single(&field.attrs, "param")?.map(ParamAttribute::read).transpose()?.unwrap_or_default();
    let ty = &field.ty;
    if holds_numbers(ty) && attribute.unit.as_ref().is_none_or(|unit| unit.value().trim().is_empty()) {
        let message = format!("`{name}` is a number and needs a unit, as in unit = \"model diameters\" (a ratio has unit = \"1\")");
        return Err(syn::Error::new(ident.span(), message));
    }
    let assertions = match (&attribute.default, &attribute.range) {
        (Some(default), Some(range)) => within(ty, default, range)?,
        _ => TokenStream::new(),
    };
    let default = match &attribute.default {
        Some(Expr::Lit(literal @ ExprLit { lit: Lit::Str(_), .. })) if named(ty, &["String", "FilePath"]) => {
            quote!(::core::option::Option::Some(<#ty as ::core::convert::From<&str>>::from(#literal)))
        }
        Some(default) => quote!(::core::option::Option::Some({ let default: #ty = #default; default })),
        None if argument(ty, "Option").is_some() => quote!(::core::option::Option::Some::<#ty>(::core::option::Option::None)),
        None => quote!(::core::option::Option::None::<#ty>),
    };
    let with_default = (attribute.default.is_some() || argument(ty, "Option").is_some())
        .then(|| quote!(if let ::core::option::Option::Some(default) = #default { spec = spec.with_default(::pelage_graph::Param::to_literal(&default)); }));
    let with_range = attribute.range.as_ref().map(limits).transpose()?.map(|range| quote!(spec = spec.with_range(#range);));
    let with_unit = attribute.unit.as_ref().map(|unit| quote!(spec = spec.with_unit(#unit);));
    let with_effect = attribute.effect.as_ref().map(|effect| quote!(spec = spec.with_effect(#effect);));
    let was = &attribute.was;
    let spec = quote!({
        #[allow(unused_mut, reason = "a parameter may have nothing to add")]
        let mut spec = ::pelage_graph::ParamSpec::new::<#ty>(#name, #doc);
        #with_default #with_range #with_unit #with_effect
        #(spec = spec.with_former_name(#was);)*
        spec
    });
    Ok(ParamTokens { spec, assertions, default })
}

pub(crate) fn derive(input: &DeriveInput) -> syn::Result<TokenStream> {
    if !input.generics.params.is_empty() {
        return Err(syn::Error::new(input.generics.span(), "a parameter type has no generics"));
    }
    let name = input.ident.unraw().to_string();
    let doc = documentation(&input.attrs, input.ident.span(), &format!("the parameter type `{name}`"))?;
    let ident = &input.ident;
    let Body { ty, from, to, assertions } = match &input.data {
        Data::Enum(data) => choice(&name, &doc, data)?,
        Data::Struct(data) => match &data.fields {
            Fields::Named(fields) => record(&name, &doc, fields)?,
            _ => return Err(syn::Error::new(ident.span(), "a parameter struct has named fields")),
        },
        Data::Union(_) => return Err(syn::Error::new(ident.span(), "a parameter is an enum or a struct")),
    };
    Ok(quote! {
        #assertions
        impl ::pelage_graph::Param for #ident {
            fn param_type() -> ::pelage_graph::ParamType {
                #ty
            }
            fn from_literal(literal: &::pelage_graph::Literal) -> ::core::result::Result<Self, ::pelage_graph::ParamError> {
                #from
            }
            fn to_literal(&self) -> ::pelage_graph::Literal {
                #to
            }
        }
    })
}

/// What the derive has to say of one type.
struct Body {
    ty: TokenStream,
    from: TokenStream,
    to: TokenStream,
    assertions: TokenStream,
}

/// The parts that named fields contribute, of a struct or of a variant.
struct FieldTokens {
    specs: Vec<TokenStream>,
    /// `field: value read from fields`
    reads: Vec<TokenStream>,
    idents: Vec<syn::Ident>,
    names: Vec<String>,
    assertions: TokenStream,
}

fn field_tokens(fields: &FieldsNamed) -> syn::Result<FieldTokens> {
    let mut out = FieldTokens { specs: vec![], reads: vec![], idents: vec![], names: vec![], assertions: TokenStream::new() };
    for field in &fields.named {
        let ParamTokens { spec, assertions, default } = param_field(field)?;
        let Some(ident) = field.ident.clone() else { continue };
        let name = ident.unraw().to_string();
        out.specs.push(spec);
        out.reads.push(quote!(#ident: ::pelage_graph::read_field(literal, fields, #name, || #default)?));
        out.assertions.extend(assertions);
        out.names.push(name);
        out.idents.push(ident);
    }
    Ok(out)
}

fn choice(name: &str, doc: &str, data: &syn::DataEnum) -> syn::Result<Body> {
    let (mut specs, mut reads, mut writes, mut all) = (vec![], vec![], vec![], TokenStream::new());
    for variant in &data.variants {
        let ident = &variant.ident;
        let label = ident.unraw().to_string();
        let doc = documentation(&variant.attrs, ident.span(), &format!("the variant `{label}`"))?;
        match &variant.fields {
            Fields::Unit => {
                specs.push(quote!(::pelage_graph::RecordSpec { name: #label.into(), doc: #doc.into(), fields: ::std::vec![] }));
                reads.push(quote!(#label => ::core::result::Result::Ok(Self::#ident)));
                writes.push(quote!(Self::#ident => ::pelage_graph::Shape::Word(#label.into()).into()));
            }
            Fields::Named(fields) => {
                let FieldTokens { specs: fields, reads: read, idents, names, assertions } = field_tokens(fields)?;
                specs.push(quote!(::pelage_graph::RecordSpec { name: #label.into(), doc: #doc.into(), fields: ::std::vec![#(#fields),*] }));
                reads.push(quote!(#label => ::core::result::Result::Ok(Self::#ident { #(#read),* })));
                writes.push(quote!(Self::#ident { #(#idents),* } => ::pelage_graph::write_record(
                    ::core::option::Option::Some(#label),
                    ::std::vec![#((#names, ::pelage_graph::Param::to_literal(#idents))),*],
                )));
                all.extend(assertions);
            }
            Fields::Unnamed(_) => {
                return Err(syn::Error::new(variant.span(), "a variant's fields need names: they are written in the file"));
            }
        }
    }
    Ok(Body {
        ty: quote!(::pelage_graph::ParamType::Choice(::pelage_graph::ChoiceSpec {
            name: #name.into(),
            doc: #doc.into(),
            variants: ::std::vec![#(#specs),*],
        })),
        from: quote! {
            let ::core::option::Option::Some((name, fields)) = ::pelage_graph::read_variant(literal) else {
                return ::core::result::Result::Err(::pelage_graph::ParamError::of::<Self>(literal));
            };
            let _ = fields;
            match name {
                #(#reads,)*
                _ => ::core::result::Result::Err(::pelage_graph::ParamError::of::<Self>(literal)),
            }
        },
        to: quote!(match self { #(#writes,)* }),
        assertions: all,
    })
}

fn record(name: &str, doc: &str, fields: &FieldsNamed) -> syn::Result<Body> {
    let FieldTokens { specs, reads, idents, names, assertions } = field_tokens(fields)?;
    Ok(Body {
        ty: quote!(::pelage_graph::ParamType::Record(::pelage_graph::RecordSpec {
            name: #name.into(),
            doc: #doc.into(),
            fields: ::std::vec![#(#specs),*],
        })),
        from: quote! {
            let ::pelage_graph::Shape::Record(_, fields) = &literal.shape else {
                return ::core::result::Result::Err(::pelage_graph::ParamError::of::<Self>(literal));
            };
            ::core::result::Result::Ok(Self { #(#reads),* })
        },
        to: quote!(::pelage_graph::write_record(
            ::core::option::Option::None,
            ::std::vec![#((#names, ::pelage_graph::Param::to_literal(&self.#idents))),*],
        )),
        assertions,
    })
}
