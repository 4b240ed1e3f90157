//! What a node is to the engine, and how its struct is filled before it runs.

use std::error::Error;
use std::sync::Arc;

use crate::conform::conform;
use crate::context::Context;
use crate::literal::Literal;
use crate::needs::{Needs, Wanted};
use crate::param::Param;
use crate::spec::PortType;
use crate::spec::{ParamSpec, Specification};
use crate::value::Value;

/// Why a node failed: any error. The program gets it back whole and may downcast it.
pub type NodeError = Box<dyn Error + Send + Sync>;

/// A documented struct that is a node. Implemented by `#[derive(Node)]`; see there for the attributes.
///
/// What leaves something out does not compile, nor does a default outside its range, be it written out or a constant:
///
/// ```compile_fail,E0080
/// const TOO_MUCH: f64 = 3.0;
///
/// /// A node.
/// #[derive(pelage_graph::Node)]
/// #[node(category = "Test")]
/// #[output(value: f64, "A number.")]
/// struct Wide {
///     /// A number.
///     #[param(default = TOO_MUCH, range = 0.0..=2.0, unit = "metres")]
///     number: f64,
/// }
/// ```
///
/// With `range = 0.0..=3.0` it does:
///
/// ```
/// const WIDE_ENOUGH: f64 = 3.0;
///
/// /// A node.
/// #[derive(pelage_graph::Node)]
/// #[node(category = "Test")]
/// #[output(value: f64, "A number.")]
/// struct Wide {
///     /// A number.
///     #[param(default = WIDE_ENOUGH, range = 0.0..=3.0, unit = "metres")]
///     number: f64,
/// }
/// ```
pub trait Node: Sized + Send + Sync + 'static {
    /// The struct of its outputs, `<Name>Outputs`, made by the derive: `Option<Arc<T>>` for each.
    type Outputs: Outputs;

    /// What its documentation and attributes say.
    fn specification() -> Specification;

    /// The struct with its inputs fetched and its parameters read.
    ///
    /// # Errors
    /// If a linked value does not convert to its parameter or is out of its range.
    fn fetch(fields: &Fields<'_>) -> Result<Self, NodeError>;
}

/// What a node does.
pub trait Evaluate: Node {
    /// Makes the wanted outputs: those for which [`Context::wants`] says so must be `Some`, the others had better be `None`.
    ///
    /// A port's value may depend on the inputs, the parameters, the declared context, the content of the files and
    /// [its own wanted parts](Context::wants_part) only, never on which other ports are wanted: the engine keeps and shares each by itself.
    ///
    /// # Errors
    /// Whatever goes wrong; the engine adds which node it was.
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError>;

    /// What of its inputs the node needs to make the wanted output, given the parameters: by default all, whole. So requirements travel upstream: what only
    /// a switched-off feature would read is not made.
    ///
    /// A node that makes pictures of a coat reads no fins where they are switched off; one that lays the coat needs no fin texture where its readers want none:
    ///
    /// ```
    /// # use pelage_graph::{Needs, Params, Part, Wanted};
    /// # const FINS: Part = Part { name: "fins", doc: "The fins." };
    /// # struct Draw;
    /// # impl Draw {
    /// fn needs(_: &Wanted<'_>, params: &Params<'_>) -> Needs {
    ///     let fins = params.get::<bool>("fins").unwrap_or(true);
    ///     Needs::all().parts("fur", fins.then_some(FINS))
    /// }
    /// # }
    /// # struct Lay;
    /// # impl Lay {
    /// fn needs(wanted: &Wanted<'_>, _: &Params<'_>) -> Needs {
    ///     if wanted.part(FINS) { Needs::all() } else { Needs::all().without("fin") }
    /// }
    /// # }
    /// ```
    fn needs(wanted: &Wanted<'_>, params: &Params<'_>) -> Needs {
        let _ = (wanted, params);
        Needs::all()
    }
}

/// A struct of outputs. Implemented by `#[derive(Node)]`.
pub trait Outputs {
    /// Each port with its value, if it was made.
    fn into_values(self) -> Vec<(&'static str, Option<Value>)>;
}

/// The parameters of a node before its inputs are there.
pub struct Params<'a> {
    pub(crate) fields: &'a Fields<'a>,
}

impl Params<'_> {
    /// The parameter `name`; `None` if there is no such parameter of this type, or it is linked and so not known yet.
    pub fn get<P: Param>(&self, name: &str) -> Option<P> {
        match self.fields.find(name)? {
            Fetched::Literal(literal) => P::from_literal(literal).ok(),
            _ => None,
        }
    }

    /// Whether the input or parameter `name` is linked to an output.
    pub fn is_linked(&self, name: &str) -> bool {
        matches!(self.fields.find(name), Some(Fetched::Pending | Fetched::Linked(_) | Fetched::List(_)))
    }
}

/// A field with what it was given.
pub(crate) enum Fetched {
    Absent,
    /// In canonical form, file paths resolved.
    Literal(Literal),
    Linked(Value),
    List(Vec<Value>),
    /// A linked value that is not there yet.
    Pending,
}

/// What the fields of one node were given; `#[derive(Node)]` reads the struct out of it.
pub struct Fields<'a> {
    pub(crate) specification: &'a Specification,
    /// One for each of [`Specification::field_names`].
    pub(crate) fetched: Vec<Fetched>,
}

/// A field of the struct that does not fit the specification it was made from.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FieldError {
    /// A required input without a value.
    #[error("input {field:?} has no value")]
    NoValue {
        /// The field.
        field: String,
    },
    /// An input of another type.
    #[error("input {field:?} is {found}, not {expected}")]
    WrongInput {
        /// The field.
        field: String,
        /// Type it takes.
        expected: String,
        /// Type it was given.
        found: String,
    },
    /// A parameter that cannot be read.
    #[error("parameter {field:?}: {message}")]
    WrongParam {
        /// The field.
        field: String,
        /// What is wrong with it.
        message: String,
    },
}

impl Fields<'_> {
    fn find(&self, name: &str) -> Option<&Fetched> {
        self.specification.field_names().position(|field| field == name).and_then(|index| self.fetched.get(index))
    }

    fn cast<T: Send + Sync + 'static>(name: &str, value: &Value) -> Result<Arc<T>, NodeError> {
        value.downcast::<T>().ok_or_else(|| {
            let (expected, found) = (PortType::of::<T>().name, value.type_name().to_owned());
            FieldError::WrongInput { field: name.to_owned(), expected, found }.into()
        })
    }

    /// A required input.
    ///
    /// # Errors
    /// If it has no value or one of another type.
    pub fn input<T: Send + Sync + 'static>(&self, name: &str) -> Result<Arc<T>, NodeError> {
        self.optional_input(name)?.ok_or_else(|| FieldError::NoValue { field: name.to_owned() }.into())
    }

    /// An optional input.
    ///
    /// # Errors
    /// If it has a value of another type.
    pub fn optional_input<T: Send + Sync + 'static>(&self, name: &str) -> Result<Option<Arc<T>>, NodeError> {
        match self.find(name) {
            Some(Fetched::Linked(value)) => Self::cast(name, value).map(Some),
            _ => Ok(None),
        }
    }

    /// An input of any number of values.
    ///
    /// # Errors
    /// If one is of another type.
    pub fn input_list<T: Send + Sync + 'static>(&self, name: &str) -> Result<Vec<Arc<T>>, NodeError> {
        match self.find(name) {
            Some(Fetched::List(values)) => values.iter().map(|value| Self::cast(name, value)).collect(),
            _ => Ok(Vec::new()),
        }
    }

    /// A parameter, written or linked.
    ///
    /// # Errors
    /// If a linked value does not convert or is out of range.
    pub fn param<P: Param>(&self, name: &str) -> Result<P, NodeError> {
        let wrong = |message: String| FieldError::WrongParam { field: name.to_owned(), message };
        match self.find(name) {
            Some(Fetched::Literal(literal)) => P::from_literal(literal).map_err(|error| wrong(error.to_string()).into()),
            Some(Fetched::Linked(value)) => {
                let value = P::from_value(value).map_err(|error| wrong(error.to_string()))?;
                if let Some(spec) = self.specification.param(name) {
                    within(spec, &value).map_err(wrong)?;
                }
                Ok(value)
            }
            _ => Err(FieldError::NoValue { field: name.to_owned() }.into()),
        }
    }
}

/// Whether a linked value keeps the bounds that a written one has to.
fn within<P: Param>(spec: &ParamSpec, value: &P) -> Result<(), String> {
    let mut misfits = Vec::new();
    conform(spec, &value.to_literal(), &mut misfits);
    misfits.first().map_or(Ok(()), |misfit| Err(misfit.kind.to_string()))
}
