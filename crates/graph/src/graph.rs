//! The document: what a graph file says, as a person reads it and an editor changes it.

use std::borrow::Borrow;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use indexmap::IndexMap;

use crate::fault::{Fault, Faults};
use crate::literal::{Literal, Place};
use crate::migrate::PRESENT;
use crate::parse::parse;
use crate::rewrite::Source;
use crate::write::to_ron;

/// Name of a node in its graph, chosen by people: letters, digits, `_` and `-`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(String);

impl NodeId {
    /// The id `id`, if it is one.
    pub fn new(id: &str) -> Option<Self> {
        let fits = !id.is_empty() && id.chars().all(|c| c == '_' || c == '-' || c.is_alphanumeric());
        fits.then(|| Self(id.to_owned()))
    }
    /// An id that a file gave, fit or not; the fault is reported elsewhere.
    pub(crate) fn unchecked(id: &str) -> Self {
        Self(id.to_owned())
    }
    /// As text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// So that a map of nodes can be asked for a `&str`.
impl Borrow<str> for NodeId {
    fn borrow(&self) -> &str {
        &self.0
    }
}

/// A node as written: its kind and the fields that are given, in the order written.
///
/// A field holds the literal of the file. Whether a string in it is a link depends on the specification, so it is decided when the
/// graph is checked; unknown kinds and fields are kept as they are.
#[derive(Clone, Debug)]
pub struct GraphNode {
    /// Plain name of the kind.
    pub kind: String,
    /// Given fields; those left out have their defaults.
    pub fields: IndexMap<String, Literal>,
    /// Where the kind is written; faults of the whole node are reported there.
    pub place: Option<Place>,
    /// Where each field's name is written.
    pub(crate) names: IndexMap<String, Place>,
}

/// Places apart: two nodes are equal when they say the same.
impl PartialEq for GraphNode {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind && self.fields.as_slice() == other.fields.as_slice()
    }
}

impl GraphNode {
    /// A node of a kind, with all fields left out.
    pub fn new(kind: &str) -> Self {
        Self { kind: kind.to_owned(), fields: IndexMap::new(), place: None, names: IndexMap::new() }
    }

    /// What a field was given, under its name or one that it had before.
    pub(crate) fn field(&self, name: &str, was: &[String]) -> Option<&Literal> {
        self.fields.get(name).or_else(|| was.iter().find_map(|was| self.fields.get(was)))
    }

    /// Gives a field a value; where it goes by a former name, under its present one from now on.
    pub(crate) fn give(&mut self, name: &str, was: &[String], value: Literal) {
        let former = was.iter().find_map(|was| self.fields.get_index_of(was));
        match former.filter(|_| !self.fields.contains_key(name)) {
            Some(index) => {
                self.fields.shift_remove_index(index);
                self.fields.shift_insert(index, name.to_owned(), value);
            }
            None => drop(self.fields.insert(name.to_owned(), value)),
        }
    }
}

/// A graph as its file has it: nodes by id, what it is about, its main output, and where an editor shows each node.
///
/// The one model of a graph: the command line's `--set` and an editor's commands change it, and [`check`](Self::check) turns it into
/// what can be evaluated. It is a plain value, so a copy of it is a step of an undo history.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// One line that names it.
    pub title: Option<String>,
    /// What it shows.
    pub about: Option<String>,
    /// Nodes in the order of the file.
    pub nodes: IndexMap<NodeId, GraphNode>,
    /// The main output, `node.port`.
    pub output: Option<String>,
    /// Where an editor shows each node, in points. It has no part in the result.
    pub layout: IndexMap<NodeId, (f64, f64)>,
    pub(crate) output_place: Option<Place>,
    pub(crate) directory: PathBuf,
    /// The text that was read, shared by all copies; saving changes what differs.
    pub(crate) source: Option<Arc<Source>>,
    /// What was wrong with the form of the file, for [`check`](Self::check) to report beside the rest.
    pub(crate) form: Vec<Fault>,
}

/// Places and directory apart.
impl PartialEq for Graph {
    fn eq(&self, other: &Self) -> bool {
        (&self.title, &self.about, &self.output) == (&other.title, &other.about, &other.output)
            && self.nodes.as_slice() == other.nodes.as_slice()
            && self.layout.as_slice() == other.layout.as_slice()
    }
}

/// Why a graph file could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be read.
    #[error("{path}: {source}", path = path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// It is no graph.
    #[error(transparent)]
    Faults(#[from] Faults),
}

impl Graph {
    /// The version of the file format that is written. Older ones are read too, and saved as this one.
    pub const VERSION: u32 = PRESENT;

    /// Reads a graph from its text. Only what hides the whole document is an error here, that is broken syntax, something that is
    /// no `Graph(…)`, and a version that is none or that of a newer program; whatever else is wrong is reported by [`check`](Self::check), all of it together.
    ///
    /// # Errors
    /// As said, with line and column.
    pub fn parse(text: &str) -> Result<Self, Faults> {
        parse(text)
    }

    /// Reads a graph file; paths in it are relative to its folder.
    ///
    /// # Errors
    /// If it cannot be read, or as [`parse`](Self::parse), the path before each line.
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        let text = std::fs::read_to_string(path).map_err(|source| ReadError::Io { path: path.to_owned(), source })?;
        let graph = Self::parse(&text).map_err(|faults| faults.with_path(path))?;
        Ok(graph.with_directory(path.parent().unwrap_or(Path::new(""))))
    }

    /// With the folder that relative paths begin at.
    #[must_use]
    pub fn with_directory(mut self, directory: impl Into<PathBuf>) -> Self {
        self.directory = directory.into();
        self
    }

    /// The folder that relative paths begin at.
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// The graph as a file; reading it gives an equal graph.
    ///
    /// What was read keeps its bytes, comments, layout and spelling, but for what was changed since: a graph that was only read is
    /// saved as the bytes that were read, and so is one whose changes were taken back. What is new is written in the style of what stands
    /// beside it; a graph that was never read has one node a line. A node or field that is left out takes the comment along that ends its line.
    pub fn to_ron(&self) -> String {
        to_ron(self)
    }
}
