//! What is known of a node kind: the one source of the reader's checks, the reference, and the editor's widgets.

use std::any::TypeId;

use serde::Serialize;

use crate::literal::Literal;
use crate::needs::Part;
use crate::param::Param;

/// Everything about a node kind that its documented struct says. Made by `#[derive(Node)]`.
#[derive(Clone, Debug, Serialize)]
pub struct Specification {
    /// Plain name, as graph files write it.
    pub kind: String,
    /// What it does.
    pub doc: String,
    /// The group it is listed under.
    pub category: String,
    /// Version of the implementation; raised when the same inputs begin to give another result, so that old keys miss.
    pub version: u32,
    /// Names of the context values it reads, such as `frame`.
    pub context: Vec<String>,
    /// Kinds it had before, which files may still say.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub was: Vec<String>,
    /// Values it takes from other nodes.
    pub inputs: Vec<InputSpec>,
    /// Values written in the file; each may be linked too.
    pub params: Vec<ParamSpec>,
    /// Values it gives.
    pub outputs: Vec<OutputSpec>,
}

impl Specification {
    /// The input called `name`, now or before.
    pub fn input(&self, name: &str) -> Option<&InputSpec> {
        self.inputs.iter().find(|input| input.name == name || input.was.iter().any(|was| was == name))
    }
    /// The parameter called `name`, now or before.
    pub fn param(&self, name: &str) -> Option<&ParamSpec> {
        self.params.iter().find(|param| param.name == name || param.was.iter().any(|was| was == name))
    }
    /// The output called `name`.
    pub fn output(&self, name: &str) -> Option<&OutputSpec> {
        self.outputs.iter().find(|output| output.name == name)
    }
    /// Names of inputs, then of parameters, in the order of the struct.
    pub fn field_names(&self) -> impl Iterator<Item = &str> {
        self.inputs.iter().map(|input| input.name.as_str()).chain(self.params.iter().map(|param| param.name.as_str()))
    }
}

/// The Rust type of a port, and the plain name the registry gives it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct PortType {
    /// Plain name; until the type is registered, its Rust name.
    pub name: String,
    /// Which type it is; two ports may be linked when these are equal.
    #[serde(skip)]
    pub id: TypeId,
}

impl PortType {
    /// The type `T`, under its Rust name until a registry knows better.
    pub fn of<T: 'static>() -> Self {
        let full = std::any::type_name::<T>();
        let plain = full.split('<').next().and_then(|path| path.rsplit("::").next()).unwrap_or(full);
        Self { name: plain.to_owned(), id: TypeId::of::<T>() }
    }
}

/// How many values an input takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Arity {
    /// Exactly one: `Arc<T>`, or `Option<Arc<T>>` that is `#[input(required)]`.
    One,
    /// None or one: `Option<Arc<T>>`.
    Optional,
    /// Any number: `Vec<Arc<T>>`, written as a list of links.
    Many,
}

/// A value a node takes from other nodes.
#[derive(Clone, Debug, Serialize)]
pub struct InputSpec {
    /// Field name.
    pub name: String,
    /// What it is for.
    pub doc: String,
    /// Type of the value.
    #[serde(rename = "type")]
    pub ty: PortType,
    /// How many.
    pub arity: Arity,
    /// Whether the node cannot run without it: `Arc<T>`. Else it is there only where [`Needs`](crate::Needs) leave it.
    #[serde(skip)]
    pub always: bool,
    /// Names it had before, which files may still say.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub was: Vec<String>,
}

/// A value a node gives.
#[derive(Clone, Debug, Serialize)]
pub struct OutputSpec {
    /// Port name.
    pub name: String,
    /// What it is.
    pub doc: String,
    /// Type of the value.
    #[serde(rename = "type")]
    pub ty: PortType,
    /// What of it is made only where somebody wants it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Part>,
}

/// A value written in the file: a parameter of a node, or a field of a record or variant within one.
#[derive(Clone, Debug, Serialize)]
pub struct ParamSpec {
    /// Field name.
    pub name: String,
    /// What it is for.
    pub doc: String,
    /// What may be written.
    #[serde(rename = "type")]
    pub ty: ParamType,
    /// What it is when left out; `None` if it may not be.
    #[serde(serialize_with = "as_ron")]
    pub default: Option<Literal>,
    /// Bounds of every number in it.
    pub range: Option<Limits>,
    /// Unit of its numbers.
    pub unit: Option<String>,
    /// What turning it does to cost and error.
    pub effect: Option<String>,
    /// Names it had before, which files may still say.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub was: Vec<String>,
    /// Types of output it may be linked to.
    #[serde(skip)]
    pub links: Vec<TypeId>,
}

/// The default as a person would write it.
fn as_ron<S: serde::Serializer>(default: &Option<Literal>, serializer: S) -> Result<S::Ok, S::Error> {
    default.as_ref().map(ToString::to_string).serialize(serializer)
}

impl ParamSpec {
    /// A parameter of type `P` with no default, range, unit or effect yet.
    pub fn new<P: Param>(name: &str, doc: &str) -> Self {
        Self {
            name: name.to_owned(),
            doc: doc.to_owned(),
            ty: P::param_type(),
            default: None,
            range: None,
            unit: None,
            effect: None,
            was: Vec::new(),
            links: P::link_types(),
        }
    }
    /// With the value it has when left out.
    #[must_use]
    pub fn with_default(mut self, default: Literal) -> Self {
        self.default = Some(default);
        self
    }
    /// With bounds.
    #[must_use]
    pub fn with_range(mut self, range: Limits) -> Self {
        self.range = Some(range);
        self
    }
    /// With a unit.
    #[must_use]
    pub fn with_unit(mut self, unit: &str) -> Self {
        self.unit = Some(unit.to_owned());
        self
    }
    /// With a name that it had before.
    #[must_use]
    pub fn with_former_name(mut self, name: &str) -> Self {
        self.was.push(name.to_owned());
        self
    }
    /// With its effect on cost and error.
    #[must_use]
    pub fn with_effect(mut self, effect: &str) -> Self {
        self.effect = Some(effect.to_owned());
        self
    }
}

/// Bounds of a number. Whole numbers are compared as `f64`, so bounds beyond 2⁵³ are approximate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limits {
    /// Least value.
    pub min: Option<f64>,
    /// Greatest value.
    pub max: Option<f64>,
    /// Whether `max` itself is outside, as in `0.0..1.0`.
    pub max_excluded: bool,
}

impl Limits {
    /// Whether `value` is within; a NaN is not.
    pub fn contains(&self, value: f64) -> bool {
        !value.is_nan()
            && self.min.is_none_or(|min| value >= min)
            && self.max.is_none_or(|max| if self.max_excluded { value < max } else { value <= max })
    }
}

/// `0.005 to 1`, `at least 1`.
impl std::fmt::Display for Limits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.min, self.max, self.max_excluded) {
            (Some(min), Some(max), false) => write!(f, "{min} to {max}"),
            (Some(min), Some(max), true) => write!(f, "{min} to below {max}"),
            (Some(min), None, _) => write!(f, "at least {min}"),
            (None, Some(max), false) => write!(f, "at most {max}"),
            (None, Some(max), true) => write!(f, "below {max}"),
            (None, None, _) => f.write_str("any"),
        }
    }
}

/// What may be written for a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ParamType {
    /// `true` or `false`.
    Bool,
    /// A whole number from `min` to `max`, both included, the bounds of its Rust type.
    Integer {
        /// Least value of the type.
        min: i128,
        /// Greatest value of the type.
        max: i128,
    },
    /// A finite number.
    Number {
        /// 32 or 64.
        bits: u8,
    },
    /// A text.
    Text,
    /// A path, relative to the graph file.
    File,
    /// `(red, green, blue)`, sRGB from 0 to 1.
    Colour,
    /// `(a, b)`.
    Tuple(Vec<ParamType>),
    /// `[a, b]`.
    List(Box<ParamType>),
    /// `None`, or the value with or without `Some(…)` around it.
    Optional(Box<ParamType>),
    /// One of several variants, each with fields of its own.
    Choice(ChoiceSpec),
    /// `(field: value)`.
    Record(RecordSpec),
}

/// An enumeration that may be written as a parameter. Made by `#[derive(Param)]`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChoiceSpec {
    /// Name of the enumeration.
    pub name: String,
    /// What is chosen.
    pub doc: String,
    /// The variants.
    pub variants: Vec<RecordSpec>,
}

/// A variant, or a struct, with its fields. Made by `#[derive(Param)]`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RecordSpec {
    /// Name of the variant or struct.
    pub name: String,
    /// What it is.
    pub doc: String,
    /// Its fields.
    pub fields: Vec<ParamSpec>,
}

impl PartialEq for ParamSpec {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
            && self.ty == other.ty
            && self.default == other.default
            && self.range == other.range
            && self.unit == other.unit
    }
}

impl ParamType {
    /// Whether it is a number, or a number that may be left out.
    pub fn is_scalar_number(&self) -> bool {
        match self {
            Self::Integer { .. } | Self::Number { .. } => true,
            Self::Optional(inner) => inner.is_scalar_number(),
            _ => false,
        }
    }

    /// Whether numbers are in it that are not documented on their own, as those of variants and records are.
    pub fn holds_numbers(&self) -> bool {
        match self {
            Self::Integer { .. } | Self::Number { .. } => true,
            Self::Optional(inner) | Self::List(inner) => inner.holds_numbers(),
            Self::Tuple(items) => items.iter().any(Self::holds_numbers),
            _ => false,
        }
    }

    /// Whether a bare string is the value itself, so that a link must be written `Link("node.port")`.
    pub fn takes_text(&self) -> bool {
        match self {
            Self::Text | Self::File => true,
            Self::Optional(inner) => inner.takes_text(),
            _ => false,
        }
    }
}

/// As a person would ask for it: `a number`, `one of Straight, Curly`.
impl std::fmt::Display for ParamType {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bool => f.write_str("true or false"),
            Self::Integer { .. } => f.write_str("a whole number"),
            Self::Number { .. } => f.write_str("a number"),
            Self::Text => f.write_str("a text"),
            Self::File => f.write_str("a file path in quotes"),
            Self::Colour => f.write_str("a colour (red, green, blue)"),
            Self::Tuple(items) => {
                f.write_str("(")?;
                for (index, item) in items.iter().enumerate() {
                    write!(f, "{}{item}", if index > 0 { ", " } else { "" })?;
                }
                f.write_str(")")
            }
            Self::List(item) => write!(f, "a list, each {item}"),
            Self::Optional(inner) => write!(f, "{inner}, or None"),
            Self::Choice(choice) => {
                let names: Vec<_> = choice.variants.iter().map(|variant| variant.name.as_str()).collect();
                write!(f, "one of {}", names.join(", "))
            }
            Self::Record(record) => {
                let names: Vec<_> = record.fields.iter().map(|field| format!("{}: …", field.name)).collect();
                write!(f, "({})", names.join(", "))
            }
        }
    }
}
