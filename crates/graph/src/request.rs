//! What is asked of a run.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::context::{CancelToken, Observer};
use crate::literal::Literal;

/// Which outputs are asked for, and under what context.
#[derive(Clone, Default)]
pub struct Request {
    pub(crate) outputs: Vec<AskedOutput>,
    pub(crate) all_values: bool,
    pub(crate) context: BTreeMap<String, Literal>,
    pub(crate) cancel: CancelToken,
    pub(crate) observer: Option<Arc<dyn Observer>>,
}

/// An output by its name, `node.port`.
#[derive(Clone)]
pub(crate) struct AskedOutput {
    pub(crate) name: String,
    /// With all its parts; else with those that others want.
    pub(crate) whole: bool,
}

impl Request {
    /// The graph's main output.
    pub fn main() -> Self {
        Self::default()
    }
    /// One output, `node.port`, with all its parts.
    pub fn output(output: &str) -> Self {
        Self::default().and_output(output)
    }
    /// Another output besides.
    #[must_use]
    pub fn and_output(mut self, output: &str) -> Self {
        self.outputs.push(AskedOutput { name: output.to_owned(), whole: true });
        self
    }
    /// Another output besides, as it is on the way to the others: with those parts alone that they take, whether they are at hand or have to be made.
    #[must_use]
    pub fn and_on_the_way(mut self, output: &str) -> Self {
        self.outputs.push(AskedOutput { name: output.to_owned(), whole: false });
        self
    }
    /// Keeping every value that has a part in the run, for statistics. Without it a value is dropped when the last node that draws on it
    /// is done, unless it was asked for or the cache has room for it.
    #[must_use]
    pub fn with_all_values(mut self) -> Self {
        self.all_values = true;
        self
    }
    /// A context value, such as `frame`. Only nodes that declare it depend on it.
    #[must_use]
    pub fn with_context(mut self, name: &str, value: impl Into<Literal>) -> Self {
        self.context.insert(name.to_owned(), value.into());
        self
    }
    /// A token by which to stop the run.
    #[must_use]
    pub fn with_cancel(mut self, cancel: CancelToken) -> Self {
        self.cancel = cancel;
        self
    }
    /// Who is told how the run gets on.
    #[must_use]
    pub fn with_observer(mut self, observer: Arc<dyn Observer>) -> Self {
        self.observer = Some(observer);
        self
    }
}
