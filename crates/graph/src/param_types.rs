//! Types of parameter that Rust has none for: files and colours.

use std::path::{Path, PathBuf};

use crate::literal::{Literal, Shape};
use crate::param::{Param, ParamError};
use crate::spec::ParamType;

/// A file that a node reads, already resolved against the graph file's folder. Its bytes are part of the node's key, and
/// so is its extension, as that may say how the bytes are to be read; its folder and name are not.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FilePath(PathBuf);

impl FilePath {
    /// The path `path`, taken as it is.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self(path.into())
    }
    /// Where the file is.
    pub fn as_path(&self) -> &Path {
        &self.0
    }
}

impl AsRef<Path> for FilePath {
    fn as_ref(&self) -> &Path {
        &self.0
    }
}

impl From<&str> for FilePath {
    fn from(path: &str) -> Self {
        Self::new(path)
    }
}

impl Param for FilePath {
    fn param_type() -> ParamType {
        ParamType::File
    }
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        match &literal.shape {
            Shape::Text(text) => Ok(Self::new(text)),
            _ => Err(ParamError::of::<Self>(literal)),
        }
    }
    fn to_literal(&self) -> Literal {
        self.0.to_string_lossy().into_owned().into()
    }
}

/// A colour as people pick it: red, green and blue in sRGB, each from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour(
    /// Red, green, blue.
    pub [f64; 3],
);

impl Colour {
    /// The same colour in linear light (IEC 61966-2-1), for computing with.
    pub fn to_linear(self) -> [f64; 3] {
        self.0.map(|c| if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) })
    }
}

impl Param for Colour {
    fn param_type() -> ParamType {
        ParamType::Colour
    }
    fn from_literal(literal: &Literal) -> Result<Self, ParamError> {
        <[f64; 3]>::from_literal(literal).map(Self).map_err(|_| ParamError::of::<Self>(literal))
    }
    fn to_literal(&self) -> Literal {
        self.0.to_literal()
    }
}
