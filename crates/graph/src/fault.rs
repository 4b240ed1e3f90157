//! What is wrong with a graph: where, in which node, what was expected, and what may have been meant.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::graph::NodeId;
use crate::literal::Place;

/// One thing wrong with a graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Where in the file; `None` for what was set or edited since.
    pub place: Option<Place>,
    /// The node it is about.
    pub node: Option<NodeId>,
    /// The node's field it is about, as `style` or `style.radius`.
    pub field: Option<String>,
    /// What is wrong.
    pub kind: FaultKind,
}

/// Ways in which a graph can be wrong. Each says what was expected, and the known name nearest to an unknown one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaultKind {
    /// Not RON at all; nothing else of the file can be said.
    #[error("{message}")]
    Syntax {
        /// The parser's message.
        message: String,
    },
    /// A version this program does not read.
    #[error("{}", no_version(*.found, *.supported))]
    Version {
        /// The version in the file.
        found: i128,
        /// The newest version that can be read; so can all before it.
        supported: u32,
    },
    /// A part of the file's frame that is missing or of another form.
    #[error("expected {expected}, found {found}")]
    Form {
        /// What belongs here.
        expected: String,
        /// What is here.
        found: String,
    },
    /// A node id that a link could not name.
    #[error("the id {id:?} cannot be used: ids are made of letters, digits, '_' and '-'")]
    BadId {
        /// The id.
        id: String,
    },
    /// An id used before.
    #[error("there is a node {id:?} already; rename one of them")]
    DuplicateId {
        /// The id.
        id: String,
    },
    /// A field given before.
    #[error("the field {field:?} is given twice; remove one")]
    DuplicateField {
        /// The field.
        field: String,
    },
    /// A node kind nobody registered.
    #[error("unknown kind of node {kind}{}", meant(.nearest.as_deref()))]
    UnknownKind {
        /// The kind.
        kind: String,
        /// The registered kind nearest to it.
        nearest: Option<String>,
    },
    /// A field the owner does not have.
    #[error("{owner} has no field {field:?}{}", meant_or(.nearest.as_deref(), .known))]
    UnknownField {
        /// Kind of node, variant or record.
        owner: String,
        /// The field.
        field: String,
        /// The field nearest to it.
        nearest: Option<String>,
        /// All fields.
        known: Vec<String>,
    },
    /// A variant the enumeration does not have.
    #[error("{choice} has no variant {variant}{}", meant_or(.nearest.as_deref(), .known))]
    UnknownVariant {
        /// The enumeration.
        choice: String,
        /// The variant.
        variant: String,
        /// The variant nearest to it.
        nearest: Option<String>,
        /// All variants.
        known: Vec<String>,
    },
    /// A value of another type.
    #[error("expected {expected}, found {found}")]
    WrongType {
        /// What the field takes.
        expected: String,
        /// What is written.
        found: String,
    },
    /// A number beyond its bounds.
    #[error("{value} is out of range: expected {range}{}", in_unit(.unit.as_deref()))]
    OutOfRange {
        /// The number.
        value: String,
        /// Its bounds.
        range: String,
        /// Its unit.
        unit: Option<String>,
    },
    /// An infinity or NaN.
    #[error("expected a finite number, found {value}")]
    NotFinite {
        /// What is written.
        value: String,
    },
    /// A field that has no default and is not given.
    #[error("missing {field:?}: expected {expected}")]
    Missing {
        /// The field.
        field: String,
        /// What it takes.
        expected: String,
    },
    /// A link to a node that is not there.
    #[error("there is no node {target:?}{}", meant(.nearest.as_deref()))]
    NoSuchNode {
        /// The node linked to.
        target: String,
        /// The node nearest to it.
        nearest: Option<String>,
    },
    /// A link to an output that is not there.
    #[error("{kind} {target:?} has no output {port:?}{}", meant_or(.nearest.as_deref(), .known))]
    NoSuchPort {
        /// The node linked to.
        target: String,
        /// Its kind.
        kind: String,
        /// The output.
        port: String,
        /// The output nearest to it.
        nearest: Option<String>,
        /// All outputs.
        known: Vec<String>,
    },
    /// A link to an output of another type.
    #[error("expected {expected}, but {link:?} is {found}")]
    TypeMismatch {
        /// What the field takes.
        expected: String,
        /// The link.
        link: String,
        /// Type of the output.
        found: String,
    },
    /// A file that cannot be opened.
    #[error("cannot read {path}: {message}")]
    File {
        /// The file.
        path: String,
        /// The system's message.
        message: String,
    },
    /// Links that lead back to where they began.
    #[error("a cycle: {}; a node cannot wait for its own result", .nodes.join(" → "))]
    Cycle {
        /// The nodes on it, in the direction of the data, the first repeated at the end.
        nodes: Vec<String>,
    },
}

/// `; did you mean X?`
fn meant(nearest: Option<&str>) -> String {
    nearest.map(|name| format!("; did you mean {name}?")).unwrap_or_default()
}

/// `; did you mean X?`, or if nothing is near, all there is.
fn meant_or(nearest: Option<&str>, known: &[String]) -> String {
    match (nearest, known) {
        (Some(_), _) => meant(nearest),
        (None, []) => "; it has none".to_owned(),
        (None, known) => format!("; expected one of {}", known.join(", ")),
    }
}

fn no_version(found: i128, supported: u32) -> String {
    if found > i128::from(supported) {
        format!("the file is of version {found}, this program reads versions up to {supported}; open it with a newer program")
    } else {
        format!("there is no version {found}; this program reads versions 0 to {supported}")
    }
}

fn in_unit(unit: Option<&str>) -> String {
    unit.map(|unit| format!(" ({unit})")).unwrap_or_default()
}

/// `3:14: node "patches", tile_size: 2 is out of range: expected 0.005 to 1 (model diameters)`.
impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = self.place {
            write!(f, "{}:{}: ", place.line, place.column)?;
        }
        if let Some(node) = &self.node {
            write!(f, "node \"{node}\"")?;
            if let Some(field) = &self.field {
                write!(f, ", {field}")?;
            }
            f.write_str(": ")?;
        } else if let Some(field) = &self.field {
            write!(f, "{field}: ")?;
        }
        write!(f, "{}", self.kind)
    }
}

impl std::error::Error for Fault {}

/// Everything wrong with a graph, in the order of the file. Never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Faults {
    faults: Vec<Fault>,
    path: Option<PathBuf>,
}

impl Faults {
    pub(crate) fn new(mut faults: Vec<Fault>) -> Self {
        faults.sort_by_key(|fault| fault.place.map_or((u32::MAX, 0), |place| (place.line, place.column)));
        Self { faults, path: None }
    }
    /// These and others of the same file, in its order.
    #[must_use]
    pub fn and(mut self, others: Self) -> Self {
        self.faults.extend(others.faults);
        Self { path: self.path, ..Self::new(self.faults) }
    }
    /// The same, each line beginning with the file's path.
    #[must_use]
    pub fn with_path(mut self, path: impl Into<PathBuf>) -> Self {
        self.path = Some(path.into());
        self
    }
    /// The file they are in, if it was said.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }
    /// Each fault.
    pub fn iter(&self) -> std::slice::Iter<'_, Fault> {
        self.faults.iter()
    }
    /// How many.
    #[allow(clippy::len_without_is_empty, reason = "faults are never empty")]
    pub fn len(&self) -> usize {
        self.faults.len()
    }
}

impl<'f> IntoIterator for &'f Faults {
    type Item = &'f Fault;
    type IntoIter = std::slice::Iter<'f, Fault>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// One line for each fault.
impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, fault) in self.faults.iter().enumerate() {
            if index > 0 {
                f.write_str("\n")?;
            }
            if let Some(path) = &self.path {
                write!(f, "{}:{}", path.display(), if fault.place.is_some() { "" } else { " " })?;
            }
            write!(f, "{fault}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Faults {}

/// The name of `known` nearest to `name`, if any is near enough to have been meant.
pub(crate) fn nearest<'k>(name: &str, known: impl IntoIterator<Item = &'k str>) -> Option<String> {
    known
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(&name.to_lowercase(), &candidate.to_lowercase()), candidate))
        .filter(|(likeness, _)| *likeness >= 0.75)
        // The first of equals, so that the answer does not depend on the sort.
        .fold(None, |best: Option<(f64, &str)>, next| if best.is_some_and(|best| best.0 >= next.0) { best } else { Some(next) })
        .map(|(_, candidate)| candidate.to_owned())
}
