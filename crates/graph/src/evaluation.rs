//! What a run gave: values, and how each node came by them.

use std::collections::HashMap;
use std::error::Error;
use std::sync::Arc;

use crate::graph::NodeId;
use crate::key::Key;
use crate::needs::Part;
use crate::node::NodeError;
use crate::spec::PortType;
use crate::value::Value;

/// A node that failed. Its error is kept whole.
#[derive(Debug, thiserror::Error)]
#[error("node \"{node}\" ({kind}): {source}")]
pub struct NodeFailure {
    /// Which node.
    pub node: NodeId,
    /// Its kind.
    pub kind: String,
    /// Its error.
    pub source: NodeError,
}

impl NodeFailure {
    /// The `E` that caused this, wherever it is in the chain of causes.
    pub fn cause<E: Error + 'static>(&self) -> Option<&E> {
        let mut next: Option<&(dyn Error + 'static)> = Some(&*self.source);
        while let Some(error) = next {
            if let Some(found) = error.downcast_ref::<E>() {
                return Some(found);
            }
            next = error.source();
        }
        None
    }
}

/// One line for each.
fn lines(failures: &[NodeFailure]) -> String {
    failures.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Why a run gave nothing.
#[derive(Debug, thiserror::Error)]
pub enum EvaluateError {
    /// Nodes failed: all that did, in topological order; never empty. What did not draw on them was computed and is in the cache.
    #[error("{}", lines(.0))]
    Nodes(Vec<NodeFailure>),
    /// An output was asked for that the graph does not have.
    #[error("there is no output {output:?}{}", .nearest.as_ref().map(|name| format!("; did you mean {name}?")).unwrap_or_default())]
    NoSuchOutput {
        /// What was asked for.
        output: String,
        /// The output nearest to it.
        nearest: Option<String>,
    },
    /// A value was asked of an evaluation that did not keep it.
    #[error("the value {output:?} was not asked for; ask for it, or for all values, in the request")]
    NotKept {
        /// The output.
        output: String,
    },
    /// The main output was asked for, and the graph names none.
    #[error("the graph names no main output; add output: \"node.port\" to it, or ask for one")]
    NoMainOutput,
    /// An output is of another type than asked for.
    #[error("the output {output:?} is {found}, not {expected}")]
    WrongType {
        /// The output.
        output: String,
        /// What was asked for.
        expected: String,
        /// What it is.
        found: String,
    },
    /// The run was asked to stop.
    #[error("cancelled")]
    Cancelled,
}

impl EvaluateError {
    /// The first `E` that caused this, wherever it is in the chains of causes.
    pub fn cause<E: Error + 'static>(&self) -> Option<&E> {
        let Self::Nodes(failures) = self else { return None };
        failures.iter().find_map(NodeFailure::cause)
    }
}

/// How a node came by its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// It ran.
    Computed,
    /// Its values were there, from an earlier run or from an equal node.
    #[serde(rename = "cached")]
    Hit,
    /// Nobody asked for it, or all who would have were there already.
    #[serde(rename = "not needed")]
    NotNeeded,
}

/// What became of one node in a run.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceEntry {
    /// Which node.
    pub node: NodeId,
    /// Its kind.
    pub kind: String,
    /// How it came by its values.
    pub state: State,
    /// Milliseconds it ran, whatever else ran beside it; 0 unless computed.
    pub ms: f64,
    /// Bytes of its values.
    pub bytes: usize,
    /// Key of each output that was asked for.
    pub keys: Vec<(String, Key)>,
    /// Of each output that is there and has parts, which of them are.
    pub parts: Vec<PortParts>,
}

/// Which parts of an output there are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortParts {
    /// The output.
    pub port: String,
    /// The parts that were made, as somebody wants them or as they come along with those, in the order in which the output declares them.
    pub made: Vec<Part>,
    /// The others that there would be.
    pub left_out: Vec<Part>,
}

/// The values that were asked for, or all that had a part in the run if [the request](crate::Request::with_all_values) says so, and the trace.
#[derive(Debug)]
pub struct Evaluation {
    /// By node and port, in the order of the document.
    pub(crate) values: Vec<(NodeId, String, Value)>,
    pub(crate) by_name: HashMap<String, usize>,
    pub(crate) main: Option<String>,
    pub(crate) trace: Vec<TraceEntry>,
}

impl Evaluation {
    /// An output's value, `node.port`.
    ///
    /// # Errors
    /// If it was not asked for, or is of another type.
    pub fn get<T: Send + Sync + 'static>(&self, output: &str) -> Result<Arc<T>, EvaluateError> {
        let Some(value) = self.value(output) else {
            return Err(EvaluateError::NotKept { output: output.to_owned() });
        };
        value.downcast().ok_or_else(|| EvaluateError::WrongType {
            output: output.to_owned(),
            expected: PortType::of::<T>().name,
            found: value.type_name().to_owned(),
        })
    }

    /// The value of the graph's main output.
    ///
    /// # Errors
    /// If the graph names none, or as [`get`](Self::get).
    pub fn main<T: Send + Sync + 'static>(&self) -> Result<Arc<T>, EvaluateError> {
        self.get(self.main.as_ref().ok_or(EvaluateError::NoMainOutput)?)
    }

    /// An output's value of whatever type.
    pub fn value(&self, output: &str) -> Option<&Value> {
        self.by_name.get(output).map(|&index| &self.values[index].2)
    }

    /// Every value that was kept, in the order of the document.
    pub fn values(&self) -> impl Iterator<Item = (&NodeId, &str, &Value)> {
        self.values.iter().map(|(node, port, value)| (node, port.as_str(), value))
    }

    /// What became of each node, in the order of the document.
    pub fn trace(&self) -> &[TraceEntry] {
        &self.trace
    }
}
