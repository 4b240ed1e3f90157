//! The node reference, `book/src/nodes.md`: what the program says of its nodes, so that it cannot grow old unnoticed.

use std::env::consts::EXE_SUFFIX;
use std::fs;

use cargo_metadata::MetadataCommand;

use crate::failure::{Failure, Result};
use crate::place::Place;
use crate::process::CommandLine;

const PAGE: &str = "book/src/nodes.md";

/// Writes the page anew.
pub(crate) fn write(place: &Place) -> Result<()> {
    let page = place.at(PAGE);
    fs::write(&page, generate(place)?).map_err(|cause| Failure::caused(page.display(), cause))
}

/// Fails unless the page is what would be written now.
pub(crate) fn check(place: &Place) -> Result<()> {
    let page = place.at(PAGE);
    let committed = fs::read_to_string(&page).map_err(|cause| Failure::caused(page.display(), cause))?;
    match first_difference(&committed, &generate(place)?) {
        None => Ok(()),
        Some(line) => Err(Failure::new(format!("{PAGE}:{line} is not what the nodes say now")).remedy("write it anew: cargo book")),
    }
}

/// The page, from the program.
///
/// Built for the whole workspace with its examples: the libraries' features are then those that `cargo test` builds, so that the two
/// share wgpu and all else. `--package pelage-cli` alone would compile most of it a second time.
fn generate(place: &Place) -> Result<String> {
    let build = ["build", "--workspace", "--features", "pelage-xtask/checks", "--locked", "--bin", "pelage", "--examples"];
    CommandLine::cargo().with(build).within(place.root()).run()?;
    CommandLine::new(&program(place)?).with(["nodes", "--markdown"]).output()
}

/// Where cargo put the program.
pub(crate) fn program(place: &Place) -> Result<String> {
    let metadata = MetadataCommand::new().manifest_path(place.at("Cargo.toml")).no_deps().exec();
    let target = metadata.map_err(|cause| Failure::caused("cargo metadata", cause))?.target_directory;
    Ok(target.join("debug").join(format!("pelage{EXE_SUFFIX}")).into_string())
}

/// The number, from 1, of the first line that differs. Line endings do not count, as git may change them.
fn first_difference(committed: &str, generated: &str) -> Option<usize> {
    let (committed, generated): (Vec<&str>, Vec<&str>) = (committed.lines().collect(), generated.lines().collect());
    let length = committed.len().max(generated.len());
    (0..length).find(|&line| committed.get(line) != generated.get(line)).map(|line| line + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_old_page_is_told_by_its_line() {
        assert_eq!(first_difference("a\nb\n", "a\r\nb"), None);
        assert_eq!(first_difference("a\nb\n", "a\nc\n"), Some(2));
        assert_eq!(first_difference("a\n", "a\nb\n"), Some(2));
        assert_eq!(first_difference("a\nb\n", ""), Some(1));
    }
}
