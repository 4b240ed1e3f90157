//! What is to be varied: from the command line, or saved as a file.

use std::path::{Path, PathBuf};

use indexmap::IndexMap;
use ron::value::RawValue;
use serde::Deserialize;

use super::here;
use crate::failure::Failure;

/// A sweep, its values as text.
pub(crate) struct Description {
    /// One line that names it.
    pub(crate) title: String,
    pub(crate) graph: PathBuf,
    /// The output that is measured; the graph's own without.
    pub(crate) output: Option<String>,
    /// The output that is measured against; the measured one without.
    pub(crate) against: Option<String>,
    /// What the one measured against has set.
    pub(crate) finest: IndexMap<String, String>,
    /// Whether that is made anew for each setting.
    pub(crate) each: bool,
    /// Times that each frame is timed.
    pub(crate) rounds: Option<u32>,
    pub(crate) set: IndexMap<String, String>,
    /// What is measured anew in: axes, as by model or by hair, of named cases, each what it sets. Every combination of one of each axis is a case.
    pub(crate) cases: IndexMap<String, Axis>,
    pub(crate) vary: IndexMap<String, Vec<String>>,
    /// Those inputs that vary by which settings are told apart, so that only those alike in them compete.
    pub(crate) groups: Vec<String>,
    /// Where paths in its values begin.
    pub(crate) directory: PathBuf,
}

/// Cases by name, and what each sets.
pub(crate) type Axis = IndexMap<String, IndexMap<String, String>>;

/// Cases as they are in a file.
type SavedCases = IndexMap<String, IndexMap<String, IndexMap<String, Box<RawValue>>>>;

/// The file: `Sweep(graph: …, vary: { "node.input": [ … ] … })`.
#[derive(Deserialize)]
#[serde(rename = "Sweep", deny_unknown_fields)]
struct Saved {
    #[serde(default)]
    title: String,
    graph: PathBuf,
    #[serde(default)]
    output: Option<String>,
    #[serde(default)]
    against: Against,
    #[serde(default)]
    finest: IndexMap<String, Box<RawValue>>,
    #[serde(default)]
    each: bool,
    #[serde(default)]
    rounds: Option<u32>,
    #[serde(default)]
    set: IndexMap<String, Box<RawValue>>,
    #[serde(default)]
    cases: SavedCases,
    #[serde(default)]
    cases_of: Option<PathBuf>,
    #[serde(default)]
    vary: IndexMap<String, Vec<Box<RawValue>>>,
    #[serde(default)]
    groups: Vec<String>,
}

#[derive(Default, Deserialize)]
enum Against {
    /// The measured output at its finest.
    #[default]
    Finest,
    /// Another output.
    Output(String),
}

impl Description {
    pub(crate) fn of_graph(graph: &Path) -> Self {
        Self {
            title: graph.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default(),
            graph: graph.to_owned(),
            output: None,
            against: None,
            finest: IndexMap::new(),
            each: false,
            rounds: None,
            set: IndexMap::new(),
            cases: IndexMap::new(),
            vary: IndexMap::new(),
            groups: Vec::new(),
            directory: here(),
        }
    }

    /// Reads a saved sweep; paths in it are relative to its folder.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let text = read(path)?;
        let mut saved: Saved = parsed(path, &text)?;
        let directory = path.parent().unwrap_or(Path::new("")).to_owned();
        if let Some(file) = &saved.cases_of {
            let file = directory.join(file);
            let shared: SavedCases = parsed(&file, &read(&file)?)?;
            saved.cases.extend(shared);
        }
        let text = |raw: &RawValue| raw.trim().get_ron().to_owned();
        let texts = |map: IndexMap<String, Box<RawValue>>| -> IndexMap<String, String> {
            map.into_iter().map(|(target, raw)| (target, text(&raw))).collect()
        };
        Ok(Self {
            title: if saved.title.is_empty() { Self::of_graph(path).title } else { saved.title },
            graph: directory.join(saved.graph),
            output: saved.output,
            against: match saved.against {
                Against::Finest => None,
                Against::Output(output) => Some(output),
            },
            finest: texts(saved.finest),
            each: saved.each,
            rounds: saved.rounds,
            set: texts(saved.set),
            cases: saved
                .cases
                .into_iter()
                .map(|(axis, cases)| (axis, cases.into_iter().map(|(name, sets)| (name, texts(sets))).collect()))
                .collect(),
            groups: saved.groups,
            vary: saved.vary.into_iter().map(|(target, values)| (target, values.iter().map(|raw| text(raw)).collect())).collect(),
            directory,
        })
    }
}

fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| Failure::input(path.display(), &error))
}

/// What a file says, or where it does not.
fn parsed<T: serde::de::DeserializeOwned>(path: &Path, text: &str) -> Result<T, Failure> {
    let options = ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME);
    options.from_str(text).map_err(|error| {
        let start = error.span.start;
        Failure::Input(format!("{}:{}:{}: {}", path.display(), start.line, start.col, error.code))
    })
}

/// The values of each `--vary NODE.INPUT=a,b,c`, in order.
pub(crate) fn varied(options: &[String]) -> Result<IndexMap<String, Vec<String>>, Failure> {
    let mut all = IndexMap::new();
    for option in options {
        let (target, values) = split_assignment("--vary", option)?;
        if all.insert(target.to_owned(), split_values(option, values)?).is_some() {
            return Err(Failure::Usage(format!("--vary {target} is given twice; give all its values at once: {target}=a,b,c")));
        }
    }
    Ok(all)
}

/// The value of each `NODE.INPUT=VALUE`; of one that is given twice the last.
pub(crate) fn assigned(option: &str, assignments: &[String]) -> Result<IndexMap<String, String>, Failure> {
    let split = |assignment: &String| split_assignment(option, assignment).map(|(target, value)| (target.to_owned(), value.to_owned()));
    assignments.iter().map(split).collect()
}

/// `NODE.INPUT` and what follows the `=`.
fn split_assignment<'a>(option: &str, text: &'a str) -> Result<(&'a str, &'a str), Failure> {
    let parts = text.split_once('=').filter(|(target, _)| target.contains('.'));
    parts.ok_or_else(|| Failure::Usage(format!("{option} {text}: expected NODE.INPUT=VALUE")))
}

/// Values with commas between; those within brackets or quotes are theirs.
fn split_values(option: &str, text: &str) -> Result<Vec<String>, Failure> {
    let (mut values, mut depth, mut quoted, mut escaped) = (vec![String::new()], 0i32, false, false);
    for letter in text.chars() {
        match letter {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            '(' | '[' | '{' if !quoted => depth += 1,
            ')' | ']' | '}' if !quoted => depth -= 1,
            ',' if depth == 0 && !quoted => {
                values.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(last) = values.last_mut() {
            last.push(letter);
        }
    }
    let values: Vec<String> = values.into_iter().map(|value| value.trim().to_owned()).collect();
    if values.iter().any(String::is_empty) {
        return Err(Failure::Usage(format!("--vary {option}: a value is empty; give NODE.INPUT=a,b,c")));
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_within_a_value_are_its_own() {
        let split = |text| split_values(text, text).ok();
        assert_eq!(split("4, 8,16"), Some(vec!["4".into(), "8".into(), "16".into()]));
        assert_eq!(split("(1, 2),Table(size: 4, by: [1,2])"), Some(vec!["(1, 2)".into(), "Table(size: 4, by: [1,2])".into()]));
        assert_eq!(split(r#""a,b","c\",d""#), Some(vec![r#""a,b""#.into(), r#""c\",d""#.into()]));
        assert!(split("").is_none() && split("4,,8").is_none() && split("4,").is_none());
    }
}
