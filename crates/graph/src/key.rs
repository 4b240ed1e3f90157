//! What a value depends on, in 32 bytes.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

use crate::literal::{Literal, Name, Shape};
use crate::spec::{ParamSpec, ParamType};

/// Identifies a value by all it depends on: equal keys, equal values. Ids and layout have no part in it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Key([u8; 32]);

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Key({self})")
    }
}

/// A file that a node names and that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("cannot read {}: {source}", path.display())]
pub struct FileError {
    /// The file.
    pub path: PathBuf,
    /// The system's error.
    pub source: std::io::Error,
}

/// Hashes of the files of one run, each read once.
pub(crate) type Files = BTreeMap<PathBuf, [u8; 32]>;

/// A hash that cannot mistake where one part ends and the next begins.
#[derive(Clone)]
pub(crate) struct KeyHasher(blake3::Hasher);

impl KeyHasher {
    pub(crate) fn new() -> Self {
        Self(blake3::Hasher::new_derive_key("pelage-graph node key, version 1"))
    }
    pub(crate) fn finish(&self) -> Key {
        Key(*self.0.finalize().as_bytes())
    }
    pub(crate) fn tag(&mut self, tag: u8) {
        self.0.update(&[tag]);
    }
    pub(crate) fn text(&mut self, text: &str) {
        self.0.update(&(text.len() as u64).to_le_bytes());
        self.0.update(text.as_bytes());
    }
    pub(crate) fn number(&mut self, number: u64) {
        self.0.update(&number.to_le_bytes());
    }
    pub(crate) fn key(&mut self, key: &Key) {
        self.0.update(&key.0);
    }

    /// A literal as it is written.
    pub(crate) fn literal(&mut self, literal: &Literal) {
        match &literal.shape {
            Shape::Bool(value) => {
                self.tag(1);
                self.tag(u8::from(*value));
            }
            Shape::Integer(value) => {
                self.tag(2);
                self.0.update(&value.to_le_bytes());
            }
            Shape::Number(value) => {
                self.tag(3);
                self.number(value.to_bits());
            }
            Shape::Text(text) => {
                self.tag(4);
                self.text(text);
            }
            Shape::Absent => self.tag(5),
            Shape::Present(inner) => {
                self.tag(6);
                self.literal(inner);
            }
            Shape::Tuple(items) => self.literals(7, items),
            Shape::List(items) => self.literals(8, items),
            Shape::Map(entries) => {
                self.tag(9);
                self.number(entries.len() as u64);
                for (key, value) in entries {
                    self.literal(key);
                    self.literal(value);
                }
            }
            Shape::Word(name) => {
                self.tag(10);
                self.text(name);
            }
            Shape::Call(name, items) => {
                self.tag(11);
                self.text(name);
                self.literals(7, items);
            }
            Shape::Record(name, fields) => {
                self.record(name.as_deref(), fields.len());
                for (name, value) in fields {
                    self.text(&name.text);
                    self.literal(value);
                }
            }
        }
    }

    fn literals(&mut self, tag: u8, items: &[Literal]) {
        self.tag(tag);
        self.number(items.len() as u64);
        items.iter().for_each(|item| self.literal(item));
    }

    fn record(&mut self, name: Option<&str>, fields: usize) {
        self.tag(12);
        self.text(name.unwrap_or(""));
        self.number(fields as u64);
    }

    /// A canonical value of a parameter: as it is written, but for files their content and extension in place of the path.
    pub(crate) fn param(&mut self, ty: &ParamType, literal: &Literal, files: &mut Files) -> Result<(), FileError> {
        match (ty, &literal.shape) {
            (ParamType::File, Shape::Text(path)) => return self.file(Path::new(path), files),
            (ParamType::Optional(ty), Shape::Present(inner)) => {
                self.tag(6);
                return self.param(ty, inner, files);
            }
            (ParamType::Tuple(types), Shape::Tuple(items)) => {
                self.tag(7);
                return types.iter().zip(items).try_for_each(|(ty, item)| self.param(ty, item, files));
            }
            (ParamType::List(ty), Shape::List(items)) => {
                self.tag(8);
                self.number(items.len() as u64);
                return items.iter().try_for_each(|item| self.param(ty, item, files));
            }
            (ParamType::Record(record), Shape::Record(_, fields)) => return self.params(None, &record.fields, fields, files),
            (ParamType::Choice(choice), Shape::Record(Some(name), fields)) => {
                if let Some(variant) = choice.variants.iter().find(|variant| variant.name == *name) {
                    return self.params(Some(name), &variant.fields, fields, files);
                }
            }
            _ => {}
        }
        self.literal(literal);
        Ok(())
    }

    fn params(&mut self, name: Option<&str>, specs: &[ParamSpec], fields: &[(Name, Literal)], files: &mut Files) -> Result<(), FileError> {
        self.record(name, fields.len());
        for (spec, (name, value)) in specs.iter().zip(fields) {
            self.text(&name.text);
            self.param(&spec.ty, value, files)?;
        }
        Ok(())
    }

    fn file(&mut self, path: &Path, files: &mut Files) -> Result<(), FileError> {
        let hash = match files.get(path) {
            Some(hash) => *hash,
            None => {
                let failed = |source| FileError { path: path.to_owned(), source };
                let mut hasher = blake3::Hasher::new();
                let file = std::fs::File::open(path).map_err(failed)?;
                hasher.update_reader(file).map_err(failed)?;
                *files.entry(path.to_owned()).or_insert(*hasher.finalize().as_bytes())
            }
        };
        self.tag(13);
        self.text(&path.extension().unwrap_or_default().to_string_lossy().to_lowercase());
        self.0.update(&hash);
        Ok(())
    }
}
