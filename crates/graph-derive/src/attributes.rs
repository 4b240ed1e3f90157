//! The attributes `#[node(…)]`, `#[output(…)]` and `#[param(…)]`.

use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Attribute, Expr, ExprArray, Ident, LitInt, LitStr, Token, Type, parenthesized};

/// The one attribute of a name; more than one is an error.
pub(crate) fn single<'a>(attributes: &'a [Attribute], name: &str) -> syn::Result<Option<&'a Attribute>> {
    let mut found = attributes.iter().filter(|attribute| attribute.path().is_ident(name));
    let first = found.next();
    match found.next() {
        Some(second) => Err(syn::Error::new(second.span(), format!("#[{name}] is given twice"))),
        None => Ok(first),
    }
}

/// `#[node(category = "…", version = 1, name = "…", was("…"), context("frame"))]`
#[derive(Default)]
pub(crate) struct NodeAttribute {
    pub(crate) category: Option<LitStr>,
    pub(crate) version: Option<LitInt>,
    pub(crate) name: Option<LitStr>,
    pub(crate) was: Vec<LitStr>,
    pub(crate) context: Vec<LitStr>,
}

impl Parse for NodeAttribute {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut attribute = Self::default();
        while !input.is_empty() {
            let key: Ident = input.parse()?;
            match key.to_string().as_str() {
                "category" => attribute.category = Some(value(input)?),
                "version" => attribute.version = Some(value(input)?),
                "name" => attribute.name = Some(value(input)?),
                "was" => attribute.was.extend(names(input)?),
                "context" => attribute.context.extend(names(input)?),
                _ => return Err(syn::Error::new(key.span(), "expected category, version, name, was or context")),
            }
            comma(input)?;
        }
        Ok(attribute)
    }
}

/// `#[output(port: Type, "What it is.", parts = [A, B])]`
pub(crate) struct OutputAttribute {
    pub(crate) name: Ident,
    pub(crate) ty: Type,
    pub(crate) doc: LitStr,
    /// Constants of type `Part`.
    pub(crate) parts: Vec<Expr>,
}

impl Parse for OutputAttribute {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name: Ident = input.parse()?;
        input.parse::<Token![:]>()?;
        let ty: Type = input.parse()?;
        if input.is_empty() {
            return Err(syn::Error::new(name.span(), format!("the output `{name}` needs a text after its type: what it is")));
        }
        input.parse::<Token![,]>()?;
        let doc: LitStr = input.parse()?;
        comma(input)?;
        if doc.value().trim().is_empty() {
            return Err(syn::Error::new(doc.span(), "say what the output is"));
        }
        let mut parts = Vec::new();
        if input.peek(Ident) && !input.peek2(Token![:]) {
            let key: Ident = input.parse()?;
            if key != "parts" {
                return Err(syn::Error::new(key.span(), "expected parts"));
            }
            parts = value::<ExprArray>(input)?.elems.into_iter().collect();
            comma(input)?;
        }
        if !input.is_empty() {
            return Err(input.error("one output for each #[output(…)]"));
        }
        Ok(Self { name, ty, doc, parts })
    }
}

/// `#[input(required, was("…"))]`
#[derive(Default)]
pub(crate) struct InputAttribute {
    pub(crate) required: bool,
    pub(crate) was: Vec<LitStr>,
}

impl Parse for InputAttribute {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut attribute = Self::default();
        while !input.is_empty() {
            let key: Ident = input.parse()?;
            match key.to_string().as_str() {
                "required" => attribute.required = true,
                "was" => attribute.was.extend(names(input)?),
                _ => return Err(syn::Error::new(key.span(), "expected required or was")),
            }
            comma(input)?;
        }
        Ok(attribute)
    }
}

impl InputAttribute {
    /// `#[input]` alone says nothing.
    pub(crate) fn read(attribute: &Attribute) -> syn::Result<Self> {
        if matches!(attribute.meta, syn::Meta::Path(_)) { Ok(Self::default()) } else { attribute.parse_args() }
    }
}

/// `#[param(default = …, range = …, unit = "…", effect = "…", was("…"))]`
#[derive(Default)]
pub(crate) struct ParamAttribute {
    pub(crate) default: Option<Expr>,
    pub(crate) range: Option<Expr>,
    pub(crate) unit: Option<LitStr>,
    pub(crate) effect: Option<LitStr>,
    pub(crate) was: Vec<LitStr>,
}

impl Parse for ParamAttribute {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut attribute = Self::default();
        while !input.is_empty() {
            let key: Ident = input.parse()?;
            match key.to_string().as_str() {
                "default" => attribute.default = Some(value(input)?),
                "range" => attribute.range = Some(value(input)?),
                "unit" => attribute.unit = Some(value(input)?),
                "effect" => attribute.effect = Some(value(input)?),
                "was" => attribute.was.extend(names(input)?),
                _ => return Err(syn::Error::new(key.span(), "expected default, range, unit, effect or was")),
            }
            comma(input)?;
        }
        Ok(attribute)
    }
}

impl ParamAttribute {
    /// `#[param]` alone says nothing.
    pub(crate) fn read(attribute: &Attribute) -> syn::Result<Self> {
        if matches!(attribute.meta, syn::Meta::Path(_)) { Ok(Self::default()) } else { attribute.parse_args() }
    }
}

fn value<T: Parse>(input: ParseStream<'_>) -> syn::Result<T> {
    input.parse::<Token![=]>()?;
    input.parse()
}

/// `= "…"`, or `("…", "…")`.
fn names(input: ParseStream<'_>) -> syn::Result<Vec<LitStr>> {
    if input.peek(Token![=]) {
        return value(input).map(|name| vec![name]);
    }
    let names;
    parenthesized!(names in input);
    Ok(Punctuated::<LitStr, Token![,]>::parse_terminated(&names)?.into_iter().collect())
}

/// A comma, or the end.
fn comma(input: ParseStream<'_>) -> syn::Result<()> {
    if !input.is_empty() {
        input.parse::<Token![,]>()?;
    }
    Ok(())
}
