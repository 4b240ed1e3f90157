//! A literal taken apart into a name, brackets and items, for who treats all shapes alike.

use crate::literal::{Literal, Name, Shape};

/// A literal with items.
pub(crate) struct Parts<'l> {
    /// The word before the bracket.
    pub(crate) name: Option<&'l str>,
    /// `(`, `[` or `{`; none of a word alone.
    pub(crate) bracket: Option<char>,
    pub(crate) items: Vec<Item<'l>>,
}

#[derive(Clone, Copy)]
pub(crate) struct Item<'l> {
    pub(crate) key: Option<Key<'l>>,
    pub(crate) value: &'l Literal,
}

/// What an item is called.
#[derive(Clone, Copy)]
pub(crate) enum Key<'l> {
    Name(&'l Name),
    Value(&'l Literal),
}

impl Key<'_> {
    /// Whether two keys say the same.
    pub(crate) fn is(self, other: Self) -> bool {
        match (self, other) {
            (Self::Name(a), Self::Name(b)) => a.text == b.text,
            (Self::Value(a), Self::Value(b)) => same(a, b),
            _ => false,
        }
    }
}

impl<'l> Item<'l> {
    /// Whether two items are called the same, as all are that have no name.
    pub(crate) fn called_as(&self, other: &Item<'_>) -> bool {
        match (self.key, other.key) {
            (Some(a), Some(b)) => a.is(b),
            (a, b) => a.is_none() && b.is_none(),
        }
    }

    fn plain(value: &'l Literal) -> Self {
        Self { key: None, value }
    }
}

/// The parts of a literal that has any.
pub(crate) fn parts(literal: &Literal) -> Option<Parts<'_>> {
    Some(match &literal.shape {
        Shape::Present(inner) => Parts { name: Some("Some"), bracket: Some('('), items: vec![Item::plain(inner)] },
        Shape::Tuple(items) => Parts { name: None, bracket: Some('('), items: items.iter().map(Item::plain).collect() },
        Shape::List(items) => Parts { name: None, bracket: Some('['), items: items.iter().map(Item::plain).collect() },
        Shape::Call(name, items) => Parts { name: Some(name), bracket: Some('('), items: items.iter().map(Item::plain).collect() },
        Shape::Word(name) => Parts { name: Some(name), bracket: None, items: Vec::new() },
        Shape::Record(name, fields) => Parts {
            name: name.as_deref(),
            bracket: Some('('),
            items: fields.iter().map(|(name, value)| Item { key: Some(Key::Name(name)), value }).collect(),
        },
        Shape::Map(entries) => Parts {
            name: None,
            bracket: Some('{'),
            items: entries.iter().map(|(key, value)| Item { key: Some(Key::Value(key)), value }).collect(),
        },
        Shape::Bool(_) | Shape::Integer(_) | Shape::Number(_) | Shape::Text(_) | Shape::Absent => return None,
    })
}

/// Whether two literals say the same, however they are written: `Straight` is `Straight()`, and what is no number is itself.
pub(crate) fn same(a: &Literal, b: &Literal) -> bool {
    if let (Shape::Number(a), Shape::Number(b)) = (&a.shape, &b.shape) {
        return a == b || a.is_nan() && b.is_nan();
    }
    let (Some(a), Some(b)) = (parts(a), parts(b)) else { return a.shape == b.shape };
    let round = |bracket: Option<char>| bracket.unwrap_or('(');
    a.name == b.name
        && round(a.bracket) == round(b.bracket)
        && a.items.len() == b.items.len()
        && a.items.iter().zip(&b.items).all(|(a, b)| a.called_as(b) && same(a.value, b.value))
}
