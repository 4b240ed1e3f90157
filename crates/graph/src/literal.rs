//! What a file says in one place: a RON value that knows where it stands.

use std::fmt;

/// Where something stands in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// First byte in the text, from 0. With [`end`](Self::end) it lets a later editor change these bytes and no others.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// A RON value as written, with its place if it was read from a text.
///
/// A string may be a text or a link: that is for the node's specification to say, not for the file. So a graph with node
/// kinds nobody here knows can be opened and saved unharmed.
///
/// Two literals are equal when they say the same, wherever they stand.
#[derive(Clone, Debug)]
pub struct Literal {
    /// What is written.
    pub shape: Shape,
    /// Where it is written; `None` for a value that comes from no text.
    pub place: Option<Place>,
}

/// What a [`Literal`] says.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// `true`, `false`.
    Bool(bool),
    /// `7`, `-3`.
    Integer(i128),
    /// `0.5`, `1e-3`, `inf`.
    Number(f64),
    /// `"text"`, also what was written `'c'`.
    Text(String),
    /// `None`.
    Absent,
    /// `Some(…)`.
    Present(Box<Literal>),
    /// `(1, 2)`, also `()`.
    Tuple(Vec<Literal>),
    /// `[1, 2]`.
    List(Vec<Literal>),
    /// `{"a": 1}`.
    Map(Vec<(Literal, Literal)>),
    /// `Straight`.
    Word(String),
    /// `Link("hair.strands")`, also `Straight()`.
    Call(String, Vec<Literal>),
    /// `Curly(radius: 0.02)`, `(from: 0, to: 1)`.
    Record(Option<String>, Vec<(Name, Literal)>),
}

/// The name of a field, with its place.
#[derive(Clone, Debug)]
pub struct Name {
    /// The name itself.
    pub text: String,
    /// Where it is written.
    pub place: Option<Place>,
}

impl PartialEq for Name {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl PartialEq for Literal {
    fn eq(&self, other: &Self) -> bool {
        self.shape == other.shape
    }
}

impl Literal {
    /// The link `"node.port"` as it is written where a text would be taken for a text: `Link("node.port")`.
    pub fn link(target: &str) -> Self {
        Shape::Call("Link".to_owned(), vec![target.into()]).into()
    }

    /// The text, if it is one.
    pub(crate) fn as_text(&self) -> Option<&str> {
        if let Shape::Text(text) = &self.shape { Some(text) } else { None }
    }

    /// What kind of thing this is, for messages: `the text "fur"`, `a list of 3`.
    pub fn describe(&self) -> String {
        match &self.shape {
            Shape::Bool(value) => value.to_string(),
            Shape::Integer(value) => format!("the whole number {value}"),
            Shape::Number(_) => format!("the number {self}"),
            Shape::Text(text) => format!("the text {}", quoted(&shortened(text))),
            Shape::Absent => "None".to_owned(),
            Shape::Present(inner) => format!("Some of {}", inner.describe()),
            Shape::Tuple(items) => format!("a tuple of {}", items.len()),
            Shape::List(items) => format!("a list of {}", items.len()),
            Shape::Map(items) => format!("a map of {}", items.len()),
            Shape::Word(name) => format!("the word {name}"),
            Shape::Call(name, _) => format!("{name}(…)"),
            Shape::Record(Some(name), _) => format!("{name}(…)"),
            Shape::Record(None, fields) => format!("a record of {}", fields.len()),
        }
    }
}

/// At most forty characters of a text, so that a message stays one line.
fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 { text.to_owned() } else { text.chars().take(39).chain(['…']).collect() }
}

/// A text in RON's quotes and escapes.
pub(crate) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            '\r' => out.push_str("\\r"),
            c if c.is_control() => out.push_str(&format!("\\u{{{:x}}}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// A name as RON takes it: plain, or raw where it is a word that RON keeps for itself.
pub(crate) fn identifier(name: &str) -> String {
    let plain =
        name.starts_with(|c: char| c == '_' || c.is_ascii_alphabetic()) && name.chars().all(|c| c == '_' || c.is_ascii_alphanumeric());
    let kept = ["true", "false", "Some", "None", "inf", "NaN", "inff32", "inff64", "NaNf32", "NaNf64"];
    if plain && !kept.contains(&name) || !name.is_ascii() { name.to_owned() } else { format!("r#{name}") }
}

/// Writes `items` with commas between.
fn separated<T>(f: &mut fmt::Formatter<'_>, items: &[T], write: impl Fn(&mut fmt::Formatter<'_>, &T) -> fmt::Result) -> fmt::Result {
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            f.write_str(", ")?;
        }
        write(f, item)?;
    }
    Ok(())
}

/// RON on one line; reading it again gives an equal literal.
impl fmt::Display for Literal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.shape {
            Shape::Bool(value) => write!(f, "{value}"),
            Shape::Integer(value) => write!(f, "{value}"),
            // Rust's shortest form that reads back as the same number: `0.1`, `1.0`, `1e-7`, `inf`, `NaN`.
            Shape::Number(value) => write!(f, "{value:?}"),
            Shape::Text(text) => f.write_str(&quoted(text)),
            Shape::Absent => f.write_str("None"),
            Shape::Present(inner) => write!(f, "Some({inner})"),
            Shape::Tuple(items) => {
                f.write_str("(")?;
                separated(f, items, |f, item| write!(f, "{item}"))?;
                f.write_str(")")
            }
            Shape::List(items) => {
                f.write_str("[")?;
                separated(f, items, |f, item| write!(f, "{item}"))?;
                f.write_str("]")
            }
            Shape::Map(items) => {
                f.write_str("{")?;
                separated(f, items, |f, (key, value)| write!(f, "{key}: {value}"))?;
                f.write_str("}")
            }
            Shape::Word(name) => f.write_str(&identifier(name)),
            Shape::Call(name, items) => {
                write!(f, "{}(", identifier(name))?;
                separated(f, items, |f, item| write!(f, "{item}"))?;
                f.write_str(")")
            }
            Shape::Record(name, fields) => {
                write!(f, "{}(", name.as_deref().map(identifier).unwrap_or_default())?;
                separated(f, fields, |f, (name, value)| write!(f, "{}: {value}", identifier(&name.text)))?;
                f.write_str(")")
            }
        }
    }
}

impl From<Shape> for Literal {
    fn from(shape: Shape) -> Self {
        Self { shape, place: None }
    }
}
impl From<bool> for Literal {
    fn from(value: bool) -> Self {
        Shape::Bool(value).into()
    }
}
impl From<f64> for Literal {
    fn from(value: f64) -> Self {
        Shape::Number(value).into()
    }
}
impl From<&str> for Literal {
    fn from(value: &str) -> Self {
        Shape::Text(value.to_owned()).into()
    }
}
impl From<String> for Literal {
    fn from(value: String) -> Self {
        Shape::Text(value).into()
    }
}
macro_rules! from_integer {
    ($($integer:ty),*) => {$(
        impl From<$integer> for Literal {
            fn from(value: $integer) -> Self {
                Shape::Integer(i128::from(value)).into()
            }
        }
    )*};
}
from_integer!(i32, i64, u32, u64);
