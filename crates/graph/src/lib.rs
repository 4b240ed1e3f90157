//! Node graphs that are files: a documented struct is a node, a RON file is a graph, and only what is asked for is evaluated.
//!
//! The crate knows neither what travels on the links nor who looks at it. A program lists its nodes in a [`Registry`]; from there the
//! reader's checks, the command line's overrides, the reference and an editor's widgets all follow.
//!
//! # Conventions
//!
//! * A link is `"node.port"`. Where a string is a value itself, in a text or a file path, a link is written `Link("node.port")`.
//! * Every value on a link is shared: `Arc<T>` of any `T: Send + Sync + 'static`.
//! * Every number has a unit and a range; see [`Registry::validate`].
//! * A value's [`Key`] is the hash of all it depends on: the kind and version of its node, canonical parameters, bytes of the files named,
//!   declared context, and the keys of the outputs it draws on. Ids, layout and the order of the file have no part in it.
//! * Nothing panics on any input, nothing is printed, there is no global state.
//!
//! # Example
//!
//! ```
//! use pelage_graph::{Context, Evaluate, Evaluator, Graph, Node, NodeError, Registry, Request, State};
//!
//! /// A number, as it is written.
//! #[derive(Node)]
//! #[node(category = "Numbers")]
//! #[output(value: f64, "The number.")]
//! pub struct Constant {
//!     /// The number.
//!     #[param(default = 0.0, range = -1e6..=1e6, unit = "1", effect = "is the result")]
//!     value: f64,
//! }
//!
//! impl Evaluate for Constant {
//!     fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
//!         Ok(self.value.into())
//!     }
//! }
//!
//! /// Sum and product of two numbers.
//! #[derive(Node)]
//! #[node(category = "Numbers")]
//! #[output(sum: f64, "The two added.")]
//! #[output(product: f64, "The two multiplied.")]
//! pub struct Combine {
//!     /// One number.
//!     #[param(range = -1e6..=1e6, unit = "1", effect = "moves both results")]
//!     a: f64,
//!     /// Another number.
//!     #[param(default = 1.0, range = -1e6..=1e6, unit = "1", effect = "moves both results")]
//!     b: f64,
//! }
//!
//! impl Evaluate for Combine {
//!     fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
//!         Ok(CombineOutputs {
//!             sum: Some((self.a + self.b).into()),
//!             product: cx.wants("product").then(|| (self.a * self.b).into()),
//!         })
//!     }
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let registry = Registry::new().node::<Constant>().node::<Combine>();
//! registry.validate()?;
//! let graph = Graph::parse(r#"
//!     Graph(
//!         version: 1,
//!         nodes: {
//!             "three": Constant(value: 3),
//!             "both": Combine(a: "three.value", b: 4),
//!             "idle": Constant(value: 5),
//!         },
//!         output: "both.product",
//!     )
//! "#)?;
//! let mut evaluator = Evaluator::new(1 << 20);
//! let evaluation = evaluator.run(&graph.check(&registry)?, &Request::main())?;
//! assert_eq!(*evaluation.main::<f64>()?, 12.0);
//! let states: Vec<State> = evaluation.trace().iter().map(|entry| entry.state).collect();
//! assert_eq!(states, [State::Computed, State::Computed, State::NotNeeded]);
//!
//! // All faults at once, each with its place and what was expected.
//! let faults = Graph::parse("Graph(version: 1, nodes: {\n\"x\": Combine(a: 2e6, c: 1),\n\"y\": Constnat() })")?.check(&registry).unwrap_err();
//! assert_eq!(faults.to_string(), "\
//! 2:17: node \"x\", a: 2000000.0 is out of range: expected -1000000 to 1000000 (1)\n\
//! 2:22: node \"x\": Combine has no field \"c\"; expected one of a, b\n\
//! 3:6: node \"y\": unknown kind of node Constnat; did you mean Constant?");
//! # Ok(())
//! # }
//! ```
//!
//! # How it is made
//!
//! *Reading.* `ron` parses; its errors carry places, its values do not. But it hands out each value's own text, borrowed from the
//! source (`&RawValue`), and where a borrowed text begins is a subtraction of addresses: so a tree in which every value and name knows
//! its bytes is had without a parser of our own, and with it faults at the right column and, later, edits that change no other byte.
//!
//! *Checking.* The tree becomes a [`Graph`], which may hold anything, unknown kinds included; [`Graph::check`] holds it against the registry
//! and reports all faults at once. A field is a [`Literal`] in the document: whether a string in it is a link is for the specification to say.
//!
//! *Evaluation.* Keys and caching are per output, so that what is wanted is in the key and a later run that wants more shares what an earlier
//! one made. This is the key of ComfyUI's `caching.py` and Graphite's `proto.rs` (hash of kind, version, parameters and input keys), taken to single ports.
//! Requirements travel upstream by [`Evaluate::needs`]: inputs that an output can do without, and [`Part`]s of a value that its readers can, are not made. Steps that do not wait for each other run side by side on threads of the run's own.
//!
//! *Saving.* The tree of what the graph says is laid beside the tree that was read, and only where they differ is text written anew; a graph made from nothing
//! is an edited empty file. *Older versions* are brought up to today's by one step a version, on the tree, before anything knows of types.

// The derives name the crate; its own tests and documentation use them too.
extern crate self as pelage_graph;

mod cache;
mod check;
mod conform;
mod context;
mod demand;
mod derived;
mod edit;
mod evaluation;
mod evaluator;
mod fault;
mod files;
mod foreseen;
mod graph;
mod key;
mod literal;
mod matching;
mod migrate;
mod needs;
mod node;
mod param;
mod param_types;
mod parse;
mod parts;
mod plan;
mod read;
mod reference;
mod registry;
mod relocate;
mod request;
mod resources;
mod rewrite;
mod run;
mod schedule;
mod sequence;
mod setting;
mod spec;
mod trivia;
mod validate;
mod value;
mod write;

pub use cache::CacheUse;
pub use check::CheckedGraph;
pub use context::{CancelToken, Cancelled, Context, ContextError, Observer};
#[doc(hidden)]
pub use derived::{read_field, read_variant, write_record};
pub use edit::{EditError, Link};
pub use evaluation::{EvaluateError, Evaluation, NodeFailure, PortParts, State, TraceEntry};
pub use evaluator::Evaluator;
pub use fault::{Fault, FaultKind, Faults};
pub use graph::{Graph, GraphNode, NodeId, ReadError};
pub use key::{FileError, Key};
pub use literal::{Literal, Name, Place, Shape};
pub use needs::{Needs, Part, Wanted};
pub use node::{Evaluate, FieldError, Fields, Node, NodeError, Outputs, Params};
pub use param::{Param, ParamError};
pub use param_types::{Colour, FilePath};
pub use pelage_graph_derive::{Node, Param};
pub use reference::{node_markdown, reference_markdown};
pub use registry::Registry;
pub use relocate::RelocateError;
pub use request::Request;
pub use resources::{NoSuchResource, Resources};
pub use run::NotMade;
pub use setting::SetError;
pub use spec::{Arity, ChoiceSpec, InputSpec, Limits, OutputSpec, ParamSpec, ParamType, PortType, RecordSpec, Specification};
pub use validate::{SpecificationFault, SpecificationFaults};
pub use value::Value;

/// The example of the read-me, kept working.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
