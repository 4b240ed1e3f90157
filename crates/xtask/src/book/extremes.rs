//! The values of the page of extremes: what the tests named there print as they hold their limits, so that no number is measured twice or by hand.

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fs;
use std::io::Cursor;

use cargo_metadata::Message;

use crate::failure::{Failure, Result};
use crate::place::Place;
use crate::process::CommandLine;
use crate::vulkan;

const PAGE: &str = "book/src/extremes.md";
/// How a test says what it came to: a line for each row of the page that names it.
const REACHED: &str = "reached: ";
/// What is written of a test that passed and says nothing: its limit is all there is to say.
const HOLDS: &str = "holds";
/// The place of the value among a row's cells: what was tried, the limit, the value, the test, its file.
const VALUE: usize = 2;

/// A test, by its file from the repository's root and its name.
type Test = (String, String);

/// Whether the models are there that half of the values are of.
pub(crate) fn has_models() -> bool {
    env::var_os("PELAGE_MODELS").is_some()
}

/// Writes the values anew.
pub(crate) fn write(place: &Place) -> Result<()> {
    if !has_models() {
        let missing = Failure::new("PELAGE_MODELS is not set, and half of the values are of the models in that folder");
        return Err(missing.remedy("set it to the folder that holds `real` and `nasty`"));
    }
    vulkan::make_sure()?;
    let page = place.at(PAGE);
    let text = fs::read_to_string(&page).map_err(|cause| Failure::caused(page.display(), cause))?;
    let named: BTreeSet<Test> = text.lines().filter_map(test_of).collect();
    let reached = measure(place, &named)?;
    let text = with_values(&text, &reached).map_err(|faults| Failure::faults(PAGE, &faults))?;
    fs::write(&page, text).map_err(|cause| Failure::caused(page.display(), cause))
}

/// The test that a line of the page names, if it is a row.
fn test_of(line: &str) -> Option<Test> {
    let [.., test, file] = cells(line)[..] else { return None };
    let unquoted = |cell: &str| cell.strip_prefix('`')?.strip_suffix('`').map(str::to_owned);
    Some((unquoted(file)?, unquoted(test)?))
}

/// The cells of a row of five; nothing of any other line.
fn cells(line: &str) -> Vec<&str> {
    let inside = line.strip_prefix("| ").and_then(|line| line.strip_suffix(" |")).unwrap_or("");
    let cells: Vec<&str> = inside.split(" | ").collect();
    if cells.len() == 5 { cells } else { Vec::new() }
}

/// Runs the tests and gathers what each says.
fn measure(place: &Place, named: &BTreeSet<Test>) -> Result<BTreeMap<Test, Vec<String>>> {
    let programs = programs(place)?;
    let mut by_program: BTreeMap<String, Vec<&Test>> = BTreeMap::new();
    for test in named {
        by_program.entry(root_of(&test.0)).or_default().push(test);
    }
    let mut reached = BTreeMap::new();
    for (root, tests) in by_program {
        let program = programs.get(&root).ok_or_else(|| Failure::new(format!("no program of tests is made of {root}")))?;
        println!("{root}");
        let names = tests.iter().map(|(_, name)| name);
        let folder = place.at(root.split("/src/").next().and_then(|root| root.split("/tests/").next()).unwrap_or(&root));
        let said = said(&CommandLine::new(program).with(["--show-output"]).with(names).within(&folder).output()?);
        for test in tests {
            let lines = said.get(&test.1).ok_or_else(|| Failure::new(format!("{}: no test {} ran", test.0, test.1)))?;
            lines.iter().for_each(|line| println!("  {}: {line}", test.1));
            reached.insert(test.clone(), lines.clone());
        }
    }
    Ok(reached)
}

/// The program of tests that cargo makes of each root file, by its path from the repository's root. Built as `cargo verify tests` builds them.
fn programs(place: &Place) -> Result<BTreeMap<String, String>> {
    let build = ["test", "--workspace", "--features", "pelage-xtask/checks", "--locked", "--tests", "--no-run"];
    let messages = CommandLine::cargo().with(build).with(["--message-format=json-render-diagnostics"]).within(place.root()).output()?;
    let mut programs = BTreeMap::new();
    for message in Message::parse_stream(Cursor::new(messages)) {
        if let Message::CompilerArtifact(artifact) = message.map_err(|cause| Failure::caused("cargo's messages", cause))?
            && let (Some(program), Ok(root)) = (artifact.executable, artifact.target.src_path.strip_prefix(place.root()))
            && artifact.profile.test
        {
            programs.insert(root.as_str().replace('\\', "/"), program.into_string());
        }
    }
    Ok(programs)
}

/// The root file of the program that a file's tests are in.
fn root_of(file: &str) -> String {
    if let Some((folder, _)) = file.split_once("/src/") {
        return format!("{folder}/src/lib.rs");
    }
    match file.split_once("/tests/").map(|(folder, within)| (folder, within.split_once('/'))) {
        Some((folder, Some((program, _)))) => format!("{folder}/tests/{program}/main.rs"),
        _ => file.to_owned(),
    }
}

/// What each test of a run with `--show-output` said it reached, by its name without its modules; nothing of one that said nothing.
fn said(output: &str) -> BTreeMap<String, Vec<String>> {
    let name = |path: &str| path.rsplit("::").next().unwrap_or(path).to_owned();
    let mut said: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut speaking = None;
    for line in output.lines() {
        if let Some(path) = line.strip_prefix("test ").and_then(|line| line.strip_suffix(" ... ok")) {
            said.entry(name(path)).or_default();
        } else if let Some(path) = line.strip_prefix("---- ").and_then(|line| line.strip_suffix(" stdout ----")) {
            speaking = Some(name(path));
        } else if line == "successes:" {
            speaking = None;
        } else if let (Some(test), Some(value)) = (&speaking, line.strip_prefix(REACHED)) {
            said.entry(test.clone()).or_default().push(value.to_owned());
        }
    }
    said
}

/// The page with its values put in. A test that is named in several rows says a line for each, in their order.
fn with_values(text: &str, reached: &BTreeMap<Test, Vec<String>>) -> std::result::Result<String, Vec<String>> {
    let mut rows: BTreeMap<Test, usize> = BTreeMap::new();
    let mut faults = Vec::new();
    let mut lines = Vec::new();
    for line in text.lines() {
        let Some(test) = test_of(line) else {
            lines.push(line.to_owned());
            continue;
        };
        let values = reached.get(&test).map_or(&[][..], Vec::as_slice);
        let row = rows.entry(test).or_default();
        let value = if values.is_empty() { HOLDS } else { values.get(*row).map_or("", String::as_str) };
        if value.contains('|') {
            faults.push(format!("{value} has a bar in it, which ends a cell"));
        }
        *row += 1;
        let mut cells = cells(line);
        cells[VALUE] = value;
        lines.push(format!("| {} |", cells.join(" | ")));
    }
    for (test, row) in &rows {
        let said = reached.get(test).map_or(0, Vec::len);
        if said > 0 && said != *row {
            faults.push(format!("{} is in {row} rows and says {said} lines", test.1));
        }
    }
    if faults.is_empty() { Ok(lines.join("\n") + "\n") } else { Err(faults) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: &str = "# Extremes\n\n| tried | limit | reached | test | file |\n|---|---|---|---|---|\n\
        | a | < 1 | old | `one_is_small` | `crates/mesh/src/obj/tests.rs` |\n| b | < 2 |  | `one_is_small` | `crates/mesh/src/obj/tests.rs` |\n\
        | c | never | 7 | `two` | `tests/tests/goldens.rs` |\n";

    fn reached(one: &[&str], two: &[&str]) -> BTreeMap<Test, Vec<String>> {
        let test = |file: &str, name: &str, lines: &[&str]| ((file.into(), name.into()), lines.iter().map(ToString::to_string).collect());
        [test("crates/mesh/src/obj/tests.rs", "one_is_small", one), test("tests/tests/goldens.rs", "two", two)].into()
    }

    #[test]
    fn values_are_put_where_their_tests_are_named() {
        let text = with_values(ROWS, &reached(&["0.1", "0.2"], &[])).unwrap();
        assert!(text.contains("| a | < 1 | 0.1 | `one_is_small`") && text.contains("| b | < 2 | 0.2 | `one_is_small`"), "{text}");
        assert!(text.contains("| c | never | holds | `two`") && text.starts_with("# Extremes\n\n| tried | limit | reached |"), "{text}");
        assert_eq!(with_values(&text, &reached(&["0.1", "0.2"], &[])).unwrap(), text);
    }

    #[test]
    fn a_line_too_many_or_too_few_is_told() {
        for lines in [&["0.1"][..], &["0.1", "0.2", "0.3"]] {
            let faults = with_values(ROWS, &reached(lines, &[])).unwrap_err();
            assert!(faults.len() == 1 && faults[0].contains("one_is_small is in 2 rows"), "{faults:?}");
        }
    }

    #[test]
    fn a_value_that_would_end_its_cell_is_told() {
        assert!(with_values(ROWS, &reached(&["0.1", "|v| = 2"], &[])).unwrap_err()[0].contains("|v| = 2"));
    }

    #[test]
    fn what_a_run_says_goes_to_its_test() {
        let output = "running 3 tests\ntest obj::tests::a ... ok\ntest b ... ok\ntest c ... ok\n\nsuccesses:\n\n---- obj::tests::a stdout ----\n\
            more\nreached: 1\n\n---- b stdout ----\nreached: 2\nreached: 3\n\n\nsuccesses:\n    b\n    obj::tests::a\nreached: 4\n";
        let said = said(output);
        assert_eq!((&said["a"], &said["b"], &said["c"]), (&vec!["1".to_owned()], &vec!["2".to_owned(), "3".to_owned()], &vec![]));
    }

    #[test]
    fn tests_are_looked_for_in_the_program_of_their_file() {
        assert_eq!(root_of("crates/mesh/src/obj/tests.rs"), "crates/mesh/src/lib.rs");
        assert_eq!(root_of("crates/mesh/tests/memory.rs"), "crates/mesh/tests/memory.rs");
        assert_eq!(root_of("crates/nodes/tests/engine/saved.rs"), "crates/nodes/tests/engine/main.rs");
        assert_eq!(root_of("tests/tests/goldens.rs"), "tests/tests/goldens.rs");
    }
}
