//! Ranges, and the check that a default lies within.

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Expr, ExprLit, ExprRange, Lit, RangeLimits, Type, UnOp};

use crate::types::is_number;

/// The range as the expression of a `Limits`.
pub(crate) fn limits(range: &Expr) -> syn::Result<TokenStream> {
    let ExprRange { start, end, limits, .. } = as_range(range)?;
    let bound = |bound: &Option<Box<Expr>>| match bound {
        Some(bound) => quote!(::core::option::Option::Some((#bound) as f64)),
        None => quote!(::core::option::Option::None),
    };
    let (min, max) = (bound(start), bound(end));
    let excluded = end.is_some() && matches!(limits, RangeLimits::HalfOpen(_));
    Ok(quote!(::pelage_graph::Limits { min: #min, max: #max, max_excluded: #excluded }))
}

fn as_range(range: &Expr) -> syn::Result<&ExprRange> {
    match range {
        Expr::Range(range) if range.start.is_some() || range.end.is_some() => Ok(range),
        _ => Err(syn::Error::new(range.span(), "expected a range such as 0.0..=1.0")),
    }
}

/// Refuses a default outside the range: here if both are plain numbers, else, for a number, by an assertion that the
/// compiler evaluates.
pub(crate) fn within(ty: &Type, default: &Expr, range: &Expr) -> syn::Result<TokenStream> {
    let range = as_range(range)?;
    let bounds = |bound: &Option<Box<Expr>>| bound.as_ref().map(|bound| literal(bound));
    let (min, max) = (bounds(&range.start), bounds(&range.end));
    let mut numbers = Vec::new();
    let plain = collect(default, &mut numbers) && min != Some(None) && max != Some(None);
    if !plain {
        return Ok(if is_number(ty) && is_constant(default) { assertion(ty, default, range) } else { TokenStream::new() });
    }
    let open = matches!(range.limits, RangeLimits::HalfOpen(_));
    for (number, span) in numbers {
        let below = min.flatten().is_some_and(|min| number < min);
        let above = max.flatten().is_some_and(|max| if open { number >= max } else { number > max });
        if below || above {
            return Err(syn::Error::new(span, format!("the default {number} is outside its range")));
        }
    }
    Ok(TokenStream::new())
}

fn assertion(ty: &Type, default: &Expr, range: &ExprRange) -> TokenStream {
    let min = range.start.as_ref().map(|min| quote!(assert!(DEFAULT >= #min, "the default is outside its range");));
    let max = range.end.as_ref().map(|max| match range.limits {
        RangeLimits::HalfOpen(_) => quote!(assert!(DEFAULT < #max, "the default is outside its range");),
        RangeLimits::Closed(_) => quote!(assert!(DEFAULT <= #max, "the default is outside its range");),
    });
    quote_spanned!(default.span()=> const _: () = { const DEFAULT: #ty = #default; #min #max };)
}

/// Whether the expression is the path of a constant or a plain number.
fn is_constant(expr: &Expr) -> bool {
    literal(expr).is_some()
        || matches!(expr, Expr::Path(path) if path.path.segments.last().is_some_and(|last| last.ident.to_string().chars().all(|c| c == '_' || c.is_ascii_uppercase() || c.is_ascii_digit())))
}

/// A plain number.
fn literal(expr: &Expr) -> Option<f64> {
    match expr {
        Expr::Lit(ExprLit { lit: Lit::Float(value), .. }) => value.base10_parse().ok(),
        Expr::Lit(ExprLit { lit: Lit::Int(value), .. }) => value.base10_parse::<u64>().ok().map(|value| value as f64),
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => literal(&unary.expr).map(|value| -value),
        Expr::Paren(inner) => literal(&inner.expr),
        Expr::Group(inner) => literal(&inner.expr),
        _ => None,
    }
}

/// The plain numbers of an array, a tuple or `Some(…)`; whether it is made of nothing else.
fn collect(expr: &Expr, numbers: &mut Vec<(f64, proc_macro2::Span)>) -> bool {
    if let Some(number) = literal(expr) {
        numbers.push((number, expr.span()));
        return true;
    }
    match expr {
        Expr::Array(array) => array.elems.iter().all(|item| collect(item, numbers)),
        Expr::Tuple(tuple) => tuple.elems.iter().all(|item| collect(item, numbers)),
        Expr::Paren(inner) => collect(&inner.expr, numbers),
        Expr::Call(call) => call.args.iter().all(|item| collect(item, numbers)),
        Expr::Path(path) => path.path.is_ident("None"),
        _ => false,
    }
}
