//! What a node may ask while it runs.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::evaluation::TraceEntry;
use crate::graph::NodeId;
use crate::literal::{Literal, Shape};
use crate::needs::{Part, Wanted};
use crate::node::NodeError;
use crate::resources::Resources;

/// Stops a run from outside. Clones are the same token.
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// A token nobody has pulled.
    pub fn new() -> Self {
        Self::default()
    }
    /// Asks the run to stop: no node begins any more, and those that run stop if they look.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
    /// Whether it was asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// The run was asked to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// Is told how a run gets on. Calls come from any thread; of `started` and `finished` one at a time, so that `done` never falls.
pub trait Observer: Send + Sync {
    /// A node begins, perhaps beside others; `done` of the `total` nodes that have to be computed are done.
    fn started(&self, node: &NodeId, done: usize, total: usize) {
        let _ = (node, done, total);
    }
    /// The running node has got so far, from 0 to 1. Nodes that run side by side may tell at the same time.
    fn progress(&self, node: &NodeId, fraction: f64) {
        let _ = (node, fraction);
    }
    /// A node is done.
    fn finished(&self, entry: &TraceEntry) {
        let _ = entry;
    }
}

/// A context value that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ContextError {
    /// The node does not declare it, so its key would not know of it.
    #[error("the context value {0:?} is not declared; add context({0:?}) to the node's attribute")]
    Undeclared(String),
    /// The request does not give it.
    #[error("the request gives no context value {0:?}")]
    NotGiven(String),
    /// It is of another type.
    #[error("the context value {name:?} is {found}, not {expected}")]
    WrongType {
        /// Its name.
        name: String,
        /// What was asked for.
        expected: &'static str,
        /// What it is.
        found: String,
    },
}

/// What a running node may ask: which outputs are wanted, the declared context values, shared resources; and what it may tell.
pub struct Context<'a> {
    pub(crate) node: &'a NodeId,
    pub(crate) wanted: &'a [Wanted<'a>],
    pub(crate) declared: &'a [String],
    pub(crate) values: &'a BTreeMap<String, Literal>,
    pub(crate) resources: &'a Resources,
    pub(crate) cancel: &'a CancelToken,
    pub(crate) observer: Option<&'a dyn Observer>,
}

impl Context<'_> {
    /// The node's id, for messages. No result may depend on it.
    pub fn node(&self) -> &NodeId {
        self.node
    }

    /// Whether the output `port` is wanted. Those that are not need not be made, and are not kept.
    pub fn wants(&self, port: &str) -> bool {
        self.wanted.iter().any(|wanted| wanted.output() == port)
    }

    /// Whether this part of the output `port` is wanted. One that is not need not be made; what the output is without it is for the type of value to say.
    pub fn wants_part(&self, port: &str, part: Part) -> bool {
        self.wanted.iter().any(|wanted| wanted.output() == port && wanted.part(part))
    }

    /// A shared resource of the program, made if nobody asked before.
    ///
    /// # Errors
    /// The error of making it, as it is, so that the program can tell a missing graphics adapter from a bad graph.
    pub fn resource<R: Send + Sync + 'static>(&self) -> Result<Arc<R>, NodeError> {
        self.resources.get()
    }

    /// A declared context value.
    ///
    /// # Errors
    /// If the node does not declare it, or the request does not give it.
    pub fn value(&self, name: &str) -> Result<&Literal, ContextError> {
        if !self.declared.iter().any(|declared| declared == name) {
            return Err(ContextError::Undeclared(name.to_owned()));
        }
        self.values.get(name).ok_or_else(|| ContextError::NotGiven(name.to_owned()))
    }

    /// A declared context value that is a number, such as a time in seconds.
    ///
    /// # Errors
    /// As [`value`](Self::value), or if it is no number.
    pub fn number(&self, name: &str) -> Result<f64, ContextError> {
        match self.value(name)?.shape {
            Shape::Number(value) => Ok(value),
            Shape::Integer(value) => Ok(value as f64),
            _ => Err(self.wrong(name, "a number")),
        }
    }

    /// A declared context value that is a whole number, such as a frame.
    ///
    /// # Errors
    /// As [`value`](Self::value), or if it is no whole number.
    pub fn integer(&self, name: &str) -> Result<i64, ContextError> {
        match self.value(name)?.shape {
            Shape::Integer(value) => i64::try_from(value).map_err(|_| self.wrong(name, "a whole number of 64 bits")),
            _ => Err(self.wrong(name, "a whole number")),
        }
    }

    /// A declared context value that is a text.
    ///
    /// # Errors
    /// As [`value`](Self::value), or if it is no text.
    pub fn text(&self, name: &str) -> Result<&str, ContextError> {
        match &self.value(name)?.shape {
            Shape::Text(text) => Ok(text),
            _ => Err(self.wrong(name, "a text")),
        }
    }

    fn wrong(&self, name: &str, expected: &'static str) -> ContextError {
        let found = self.values.get(name).map(Literal::describe).unwrap_or_default();
        ContextError::WrongType { name: name.to_owned(), expected, found }
    }

    /// Tells how far the node has got, from 0 to 1.
    pub fn progress(&self, fraction: f64) {
        if let Some(observer) = self.observer {
            observer.progress(self.node, fraction.clamp(0.0, 1.0));
        }
    }

    /// Whether the run was asked to stop; a long node looks now and then.
    pub fn cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// Leaves the node if the run was asked to stop: `cx.stop_if_cancelled()?`.
    ///
    /// # Errors
    /// [`Cancelled`] if so.
    pub fn stop_if_cancelled(&self) -> Result<(), Cancelled> {
        if self.cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}
