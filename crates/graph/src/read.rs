//! RON text to a [`Literal`] in which every value and name knows its place.
//!
//! `ron` reports where parsing failed but gives a value no position. It does hand out each value's own text, borrowed from
//! the source (`&RawValue`), and where a borrowed text begins in the source is a subtraction of addresses. So the library
//! parses, level by level, and this file only measures; comments, escapes, raw strings and the recursion limit of
//! 128 stay `ron`'s business.

use ron::Deserializer;
use ron::value::RawValue;
use serde::de::{self, Deserialize, MapAccess, SeqAccess, Visitor};

use crate::literal::{Literal, Name, Place, Shape};

/// Why a text is not RON.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SyntaxError {
    pub(crate) message: String,
    pub(crate) place: Place,
}

/// Reads the one value that `text` holds.
pub(crate) fn read(text: &str) -> Result<Literal, SyntaxError> {
    let lines = Lines::new(text);
    let raw: &RawValue =
        ron::from_str(text).map_err(|error| SyntaxError { message: sentence(&error.code), place: lines.at(&error.span.start) })?;
    lines.literal(raw)
}

/// The library's message, beginning as ours do.
fn sentence(error: &ron::Error) -> String {
    let message = error.to_string();
    let mut chars = message.chars();
    match chars.next() {
        Some(first) => first.to_lowercase().chain(chars).collect(),
        None => message,
    }
}

/// A text and where its lines begin.
struct Lines<'t> {
    text: &'t str,
    starts: Vec<usize>,
}

impl<'t> Lines<'t> {
    fn new(text: &'t str) -> Self {
        Self { text, starts: std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect() }
    }

    /// The place of `part`, which is borrowed from the text.
    fn place(&self, part: &str) -> Place {
        let start = (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize).min(self.text.len());
        let end = (start + part.len()).min(self.text.len());
        let line = self.starts.partition_point(|&s| s <= start);
        let line_start = self.starts.get(line.saturating_sub(1)).copied().unwrap_or(0);
        let column = 1 + self.text.get(line_start..start).map_or(0, |before| before.chars().count());
        Place { line: line as u32, column: column as u32, start, end }
    }

    /// The place of one of the library's positions.
    fn at(&self, position: &ron::error::Position) -> Place {
        let line_start = self.starts.get(position.line.saturating_sub(1)).copied().unwrap_or(self.text.len());
        let rest = &self.text[line_start..];
        let start = line_start + rest.char_indices().nth(position.col.saturating_sub(1)).map_or(rest.len(), |(at, _)| at);
        Place { line: position.line as u32, column: position.col as u32, start, end: start }
    }

    fn literal(&self, raw: &'t RawValue) -> Result<Literal, SyntaxError> {
        let raw = raw.trim().get_ron();
        let place = self.place(raw);
        let failed = |error: ron::Error| SyntaxError { message: sentence(&error), place };
        let name = leading_name(raw);
        let level = Deserializer::from_str(raw).map_err(|error| failed(error.code)).and_then(|mut level| {
            de::Deserializer::deserialize_any(&mut level, LevelVisitor { map: raw.starts_with('{') }).map_err(failed)
        })?;
        let items = |items: Vec<&'t RawValue>| items.into_iter().map(|item| self.literal(item)).collect::<Result<Vec<_>, _>>();
        let shape = match (level, name) {
            (Level::Leaf(shape), _) => shape,
            (Level::Some(inner), _) => Shape::Present(Box::new(self.literal(inner)?)),
            (Level::Unit, Some(name)) => Shape::Word(name.to_owned()),
            (Level::Unit, None) => Shape::Tuple(Vec::new()),
            (Level::Items(list), _) if raw.starts_with('[') => Shape::List(items(list)?),
            (Level::Items(list), Some(name)) => Shape::Call(name.to_owned(), items(list)?),
            (Level::Items(list), None) => Shape::Tuple(items(list)?),
            (Level::Entries(list), _) => Shape::Map(
                list.into_iter().map(|(key, value)| Ok((self.literal(key)?, self.literal(value)?))).collect::<Result<_, SyntaxError>>()?,
            ),
            (Level::Fields(list), name) => Shape::Record(
                name.map(str::to_owned),
                list.into_iter()
                    .map(|(field, value)| Ok((Name { text: field.to_owned(), place: Some(self.place(field)) }, self.literal(value)?)))
                    .collect::<Result<_, SyntaxError>>()?,
            ),
        };
        Ok(Literal { shape, place: Some(place) })
    }
}

/// The identifier that a value begins with, as in `Curly(…)`; texts such as `r"…"` begin with none.
fn leading_name(raw: &str) -> Option<&str> {
    let (raw_name, rest) = match raw.strip_prefix("r#") {
        Some(rest) if !rest.starts_with(['"', '#']) => (true, rest),
        _ => (false, raw),
    };
    let end = rest.find(|c: char| !(c == '_' || c.is_alphanumeric() || raw_name && matches!(c, '.' | '+' | '-'))).unwrap_or(rest.len());
    (end > 0 && (raw_name || !rest.starts_with(|c: char| c.is_ascii_digit()))).then(|| &rest[..end])
}

/// One level of a value; what lies deeper is still text.
enum Level<'t> {
    Leaf(Shape),
    Unit,
    Some(&'t RawValue),
    Items(Vec<&'t RawValue>),
    Entries(Vec<(&'t RawValue, &'t RawValue)>),
    Fields(Vec<(&'t str, &'t RawValue)>),
}

struct LevelVisitor {
    /// Whether named values are those of a map, whose keys are values, or those of a struct, whose keys are names.
    map: bool,
}

impl<'t> Visitor<'t> for LevelVisitor {
    type Value = Level<'t>;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a boolean, number, text, tuple, list, map or named value")
    }
    fn visit_bool<E>(self, value: bool) -> Result<Level<'t>, E> {
        Ok(Level::Leaf(Shape::Bool(value)))
    }
    fn visit_i64<E>(self, value: i64) -> Result<Level<'t>, E> {
        Ok(Level::Leaf(Shape::Integer(value.into())))
    }
    fn visit_u64<E>(self, value: u64) -> Result<Level<'t>, E> {
        Ok(Level::Leaf(Shape::Integer(value.into())))
    }
    fn visit_f64<E>(self, value: f64) -> Result<Level<'t>, E> {
        Ok(Level::Leaf(Shape::Number(value)))
    }
    fn visit_str<E>(self, value: &str) -> Result<Level<'t>, E> {
        Ok(Level::Leaf(Shape::Text(value.to_owned())))
    }
    fn visit_unit<E>(self) -> Result<Level<'t>, E> {
        Ok(Level::Unit)
    }
    fn visit_none<E>(self) -> Result<Level<'t>, E> {
        Ok(Level::Leaf(Shape::Absent))
    }
    fn visit_some<D: de::Deserializer<'t>>(self, inner: D) -> Result<Level<'t>, D::Error> {
        Deserialize::deserialize(inner).map(Level::Some)
    }
    fn visit_newtype_struct<D: de::Deserializer<'t>>(self, inner: D) -> Result<Level<'t>, D::Error> {
        Deserialize::deserialize(inner).map(|item| Level::Items(vec![item]))
    }
    fn visit_seq<A: SeqAccess<'t>>(self, mut access: A) -> Result<Level<'t>, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = access.next_element()? {
            items.push(item);
        }
        Ok(Level::Items(items))
    }
    /// Duplicates are kept: they are faults to report, not entries to lose.
    fn visit_map<A: MapAccess<'t>>(self, mut access: A) -> Result<Level<'t>, A::Error> {
        if self.map {
            let mut entries = Vec::new();
            while let Some(entry) = access.next_entry()? {
                entries.push(entry);
            }
            return Ok(Level::Entries(entries));
        }
        let mut fields = Vec::new();
        while let Some(field) = access.next_entry()? {
            fields.push(field);
        }
        Ok(Level::Fields(fields))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> String {
        read(text).map_or_else(|error| format!("{}:{} {}", error.place.line, error.place.column, error.message), |value| value.to_string())
    }

    #[test]
    fn every_shape_reads_and_writes_itself() {
        for text in [
            "true",
            "7",
            "-3",
            "0.1",
            "1.0",
            "1e-7",
            "18446744073709551615",
            "\"a\\\"b\\n\"",
            "None",
            "Some(1)",
            "()",
            "(1, 2)",
            "[1, 2]",
            "[]",
            "{\"a\": 1}",
            "Straight",
            "Straight()",
            "Link(\"a.b\")",
            "Curly(radius: 0.02, deep: (a: 1))",
            "(from: 0, to: 1)",
            "inf",
            "-inf",
            "NaN",
        ] {
            assert_eq!(shown(text), text);
        }
    }

    #[test]
    fn numbers_keep_every_digit() {
        assert_eq!(read("0.1").unwrap().shape, Shape::Number(0.1));
        assert_eq!(read("0.12345678901234566").unwrap().shape, Shape::Number(0.12345678901234566));
        assert_eq!(read("16777217.0").unwrap().shape, Shape::Number(16_777_217.0));
    }

    #[test]
    fn values_and_names_know_their_places_past_comments_and_wide_letters() {
        let text = "A(\n  // \"é\"\n  x: /* é */ (1, \"é\", B(y: 2)),\n)";
        let Shape::Record(_, fields) = read(text).unwrap().shape else { panic!("a record") };
        let (name, value) = &fields[0];
        let at = |place: Option<Place>| place.map(|p| (p.line, p.column, &text[p.start..p.end])).unwrap();
        assert_eq!(at(name.place), (3, 3, "x"));
        assert_eq!(at(value.place), (3, 14, "(1, \"é\", B(y: 2))"));
        let Shape::Tuple(items) = &value.shape else { panic!("a tuple") };
        assert_eq!(at(items[2].place), (3, 23, "B(y: 2)"));
    }

    #[test]
    fn a_syntax_error_knows_its_place() {
        assert_eq!(shown("A(\n  x: 1\n  y: 2)"), "3:3 expected comma");
    }

    #[test]
    fn depth_is_bounded() {
        assert!(shown(&"[".repeat(100_000)).contains("recursion"), "{}", shown(&"[".repeat(100_000)));
    }
}
