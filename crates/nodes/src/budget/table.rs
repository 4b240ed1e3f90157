//! The table of a sweep, as `pelage measure` writes it.

use std::io;
use std::path::{Path, PathBuf};

use csv::StringRecord;
use pelage_graph::{FaultKind, Node, ParamSpec};

use super::quality::{Quality, TableRow, Take};
use crate::{CameraNode, RenderImage};

/// The input whose value is the distance, of a Camera.
const DISTANCE: &str = "margin";

/// The column of errors.
const ERROR: &str = "flip_mean";

/// What is wrong with a table, and how to mend it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The file cannot be read.
    #[error("{path}: {source}", path = path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// It is no table.
    #[error("{path}: {source}", path = path.display())]
    Form {
        /// The file.
        path: PathBuf,
        /// Where and why, as the reader says it.
        source: csv::Error,
    },
    /// A column that is needed.
    #[error("{path}:1: there is no column {column}: {remedy}", path = path.display())]
    NoColumn {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// How to get it.
        remedy: &'static str,
    },
    /// Two columns that say the same thing.
    #[error("{path}:1: the columns {first} and {second} are of one input: keep one of them", path = path.display())]
    Repeated {
        /// The file.
        path: PathBuf,
        /// The one.
        first: String,
        /// The other.
        second: String,
    },
    /// An input that cannot be chosen from frame to frame.
    #[error("{path}:1: column {column}: a picture cannot choose this while it is drawn; vary the margin of a Camera and {known} of a RenderImage only", path = path.display())]
    NotChosen {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// What can be chosen.
        known: String,
    },
    /// A value that does not fit the input of its column.
    #[error("{path}:{line}: column {column}: {fault}", path = path.display())]
    Value {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// The column.
        column: String,
        /// What is wrong with it.
        fault: Box<FaultKind>,
    },
    /// A measure that is no number.
    #[error("{path}:{line}: column {column}: expected a number from 0 up, found {found:?}", path = path.display())]
    Number {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// The column.
        column: String,
        /// What is there.
        found: String,
    },
    /// A table of nothing.
    #[error("{path}: the table has no rows: measure one setting or more", path = path.display())]
    NoRows {
        /// The file.
        path: PathBuf,
    },
}

/// The column of shells drawn, which a table need not have.
const SHELLS: &str = "shells";

/// One setting at one distance.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) quality: Quality,
    pub(super) figures: TableRow,
}

/// Rows, of which there is one at least.
pub(super) struct Rows {
    first: Row,
    rest: Vec<Row>,
}

impl Rows {
    /// Reads a table with the costs of one of its columns; what is in others does not matter.
    pub(super) fn read(path: &Path, cost: &str) -> Result<Self, TableError> {
        let text = std::fs::read_to_string(path).map_err(|source| TableError::Read { path: path.to_owned(), source })?;
        let form = |source| TableError::Form { path: path.to_owned(), source };
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let columns = Columns::of(path, reader.headers().map_err(form)?.clone(), cost)?;
        let rows = reader.records().map(|record| columns.row(&record.map_err(form)?)).collect::<Result<Vec<Row>, TableError>>()?;
        let mut rest = rows.into_iter();
        let first = rest.next().ok_or_else(|| TableError::NoRows { path: path.to_owned() })?;
        Ok(Self { first, rest: rest.collect() })
    }

    pub(super) fn first(&self) -> &Row {
        &self.first
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Row> {
        std::iter::once(&self.first).chain(&self.rest)
    }
}

/// Where in a line each thing is.
struct Columns<'p> {
    path: &'p Path,
    names: StringRecord,
    margin: (usize, ParamSpec),
    decided: Vec<(usize, ParamSpec, Take)>,
    cost: usize,
    error: usize,
    shells: Option<usize>,
}

impl<'p> Columns<'p> {
    fn of(path: &'p Path, names: StringRecord, cost: &str) -> Result<Self, TableError> {
        let (camera, picture) = (CameraNode::specification(), RenderImage::specification());
        let (mut margin, mut decided) = (None::<(usize, ParamSpec)>, Vec::<(usize, ParamSpec, Take)>::new());
        // What varies is called NODE.INPUT, what was measured has no dot.
        for (index, name) in names.iter().enumerate() {
            let Some((_, input)) = name.split_once('.') else { continue };
            let before = margin.iter().map(|(index, param)| (index, param)).chain(decided.iter().map(|(index, param, _)| (index, param)));
            if let Some((before, _)) = before.into_iter().find(|(_, param)| param.name == input) {
                return Err(TableError::Repeated { path: path.to_owned(), first: names[*before].to_owned(), second: name.to_owned() });
            }
            match (picture.param(input).zip(Quality::taker(input)), camera.param(DISTANCE)) {
                (Some((param, take)), _) => decided.push((index, param.clone(), take)),
                (None, Some(param)) if input == DISTANCE => margin = Some((index, param.clone())),
                _ => {
                    let known = Quality::decided().collect::<Vec<_>>().join(", ");
                    return Err(TableError::NotChosen { path: path.to_owned(), column: name.to_owned(), known });
                }
            }
        }
        let missing = |column: &str, remedy| TableError::NoColumn { path: path.to_owned(), column: column.to_owned(), remedy };
        let measured = |column: &str| {
            names.iter().position(|name| name == column).ok_or_else(|| missing(column, "write the table with `pelage measure`"))
        };
        let margin = margin.ok_or_else(|| missing("camera.margin", "vary the margin of the picture's Camera"))?;
        let shells = names.iter().position(|name| name == SHELLS);
        Ok(Self { path, margin, decided, cost: measured(cost)?, error: measured(ERROR)?, shells, names })
    }

    fn row(&self, record: &StringRecord) -> Result<Row, TableError> {
        let line = record.position().map_or(0, csv::Position::line);
        let (at, param) = &self.margin;
        let margin = param.read::<f64>(&record[*at]).map_err(|fault| self.misfit(line, *at, fault))?;
        let mut quality = Quality::default();
        for (at, param, take) in &self.decided {
            take(&mut quality, param, &record[*at]).map_err(|fault| self.misfit(line, *at, fault))?;
        }
        let number = |at: usize| {
            let number = record[at].parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
            number.ok_or_else(|| TableError::Number {
                path: self.path.to_owned(),
                line,
                column: self.names[at].to_owned(),
                found: record[at].to_owned(),
            })
        };
        // As the camera has it, so that the same number is the same distance.
        let shells = self.shells.and_then(|at| record[at].parse().ok());
        let figures = TableRow { line, margin: margin as f32, cost: number(self.cost)?, error: number(self.error)?, shells };
        Ok(Row { quality: Quality { row: Some(figures), ..quality }, figures })
    }

    fn misfit(&self, line: u64, at: usize, fault: impl Into<Box<FaultKind>>) -> TableError {
        TableError::Value { path: self.path.to_owned(), line, column: self.names[at].to_owned(), fault: fault.into() }
    }
}
