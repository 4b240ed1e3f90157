//! The book's page of extremes names tests that are there.

use std::collections::BTreeSet;
use std::path::Path;

use pelage_tests::{Error, repository};

/// Every row: what was tried, the limit, the value that `cargo book extremes` wrote, the test, its file.
fn rows(text: &str) -> Result<Vec<[&str; 5]>, Error> {
    let lines = text.lines().filter(|line| line.starts_with("| ") && line.matches(".rs` |").count() == 1);
    lines
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
            <[&str; 5]>::try_from(cells).map_err(|cells| format!("{} cells and not five: {line}", cells.len()).into())
        })
        .collect()
}

/// Whether the file has a test of the name: a function that follows `#[test]`, other attributes aside.
fn has_test(file: &Path, name: &str) -> Result<bool, Error> {
    let text = std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let mut marked = false;
    for line in text.lines().map(str::trim) {
        let function = line.strip_prefix("fn ").and_then(|rest| rest.split(['(', '<']).next());
        // One that is left out is none.
        if marked && function == Some(name) {
            return Ok(true);
        }
        marked = line == "#[test]" || (marked && (line.starts_with("#[") || line.starts_with("//")) && !line.starts_with("#[ignore"));
    }
    Ok(false)
}

#[test]
fn every_test_that_the_page_names_is_there() -> Result<(), Error> {
    let text = std::fs::read_to_string(repository().join("book/src/extremes.md"))?;
    let rows = rows(&text)?;
    let mut faults = Vec::new();
    for [tried, limit, reached, test, file] in &rows {
        let (test, file) = (test.trim_matches('`'), file.trim_matches('`'));
        if !has_test(&repository().join(file), test)? {
            faults.push(format!("{file} has no test {test}"));
        }
        if [tried, limit, reached].iter().any(|cell| ["", "-"].contains(cell)) {
            faults.push(format!("{test}: a cell says nothing; `cargo book extremes` writes the values"));
        }
    }
    let crates: BTreeSet<&str> =
        rows.iter().filter_map(|row| row[4].trim_matches('`').strip_prefix("crates/")?.split('/').next()).collect();
    assert!(rows.len() >= 80 && crates.len() >= 10, "{} rows of {crates:?}", rows.len());
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n").into()) }
}
