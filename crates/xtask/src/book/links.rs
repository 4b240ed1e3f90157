//! Every relative link and picture of the book and of the READMEs leads to something that exists.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use super::markdown::{Page, Reference};
use super::pages::{SUMMARY, pages_below};
use crate::failure::{Failure, Result};
use crate::place::Place;

/// Checks the book's pages and every README of the repository. A line for each fault.
pub(crate) fn faults(place: &Place) -> Result<Vec<String>> {
    let source = place.at("book/src");
    let mut pages = Pages::default();
    let mut faults = Vec::new();
    // The contents are compared with the pages elsewhere.
    for page in pages_below(&source)?.into_iter().filter(|page| !page.ends_with(SUMMARY)) {
        faults.extend(pages.faults_of(place.root(), &page, &source)?);
    }
    for readme in readmes(place)? {
        faults.extend(pages.faults_of(place.root(), &readme, place.root())?);
    }
    Ok(faults)
}

/// The repository's README and one of every crate that has one.
fn readmes(place: &Place) -> Result<Vec<PathBuf>> {
    let crates = place.at("crates");
    let entries = fs::read_dir(&crates).map_err(|cause| Failure::caused(crates.display(), cause))?;
    let mut folders: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    folders.push(place.root().to_owned());
    folders.sort();
    Ok(folders.into_iter().map(|folder| folder.join("README.md")).filter(|readme| readme.is_file()).collect())
}

/// The pages read so far, by path.
#[derive(Default)]
struct Pages(BTreeMap<PathBuf, Page>);

impl Pages {
    fn read(&mut self, path: &Path) -> Result<&Page> {
        if !self.0.contains_key(path) {
            let text = fs::read_to_string(path).map_err(|cause| Failure::caused(path.display(), cause))?;
            self.0.insert(path.to_owned(), Page::read(&text));
        }
        self.0.get(path).ok_or_else(|| Failure::new(format!("{} was not read", path.display())))
    }

    /// The faults of the page at `path`, whose links must stay inside `bounds`; told by paths from `root`.
    fn faults_of(&mut self, root: &Path, path: &Path, bounds: &Path) -> Result<Vec<String>> {
        let references = self.read(path)?.references.clone();
        let shown = path.strip_prefix(root).unwrap_or(path).display();
        let mut faults = Vec::new();
        for Reference { line, target } in references {
            if let Some(fault) = self.fault(path, &target, bounds)? {
                faults.push(format!("{shown}:{line}: {target} {fault}"));
            }
        }
        Ok(faults)
    }

    /// What is wrong with one reference, if anything.
    fn fault(&mut self, page: &Path, target: &str, bounds: &Path) -> Result<Option<&'static str>> {
        let address =
            target.split_once(':').is_some_and(|(scheme, _)| scheme.len() > 1 && scheme.chars().all(|c| c.is_ascii_alphanumeric()));
        if address {
            return Ok(None);
        }
        let (file, anchor) = target.split_once('#').map_or((target, None), |(file, anchor)| (file, Some(anchor)));
        let folder = page.parent().unwrap_or(page);
        let path = if file.is_empty() { page.to_owned() } else { tidy(&folder.join(file)) };
        if !path.starts_with(bounds) {
            return Ok(Some("leaves the book, so that the built page would not have it: name it as code"));
        }
        if !path.exists() {
            return Ok(Some("does not exist"));
        }
        let is_page = path.extension().is_some_and(|extension| extension == "md");
        match anchor {
            Some(anchor) if is_page && !self.read(&path)?.anchors.contains(anchor) => Ok(Some("names a heading that is not there")),
            _ => Ok(None),
        }
    }
}

/// `path` without `.` and `..`, by its words alone.
fn tidy(path: &Path) -> PathBuf {
    let mut tidied = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => {
                tidied.pop();
            }
            Component::CurDir => {}
            other => tidied.push(other),
        }
    }
    tidied
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The faults of a page `book/src/deep/page.md` beside a few things it may refer to.
    fn check(text: &str) -> Vec<String> {
        let root = tempfile::tempdir().unwrap();
        let source = root.path().join("book/src");
        fs::create_dir_all(source.join("deep")).unwrap();
        for (file, content) in [("deep/page.md", text), ("other.md", "# Other\n## Second part"), ("bunny.png", ""), ("../../README.md", "")]
        {
            fs::write(source.join(file), content).unwrap();
        }
        Pages::default().faults_of(root.path(), &source.join("deep/page.md"), &source).unwrap()
    }

    #[test]
    fn what_exists_passes() {
        let text = "# Here\n[a](../other.md) [b](../other.md#second-part) [c](#here) ![d](../bunny.png) <img src=\"../bunny.png\">\n\n\
            [e](https://example.org/gone.md) [f](mailto:a@example.org) [g](./page.md)";
        assert_eq!(check(text), Vec::<String>::new());
    }

    #[test]
    fn what_does_not_exist_is_told_with_its_line() {
        for (target, why) in [
            ("../gone.md", "does not exist"),
            ("other.md", "does not exist"),
            ("../other.md#third-part", "names a heading that is not there"),
            ("#there", "names a heading that is not there"),
            ("../gone.png", "does not exist"),
        ] {
            assert_eq!(check(&format!("# Here\n\n[a]({target})")), [format!("book/src/deep/page.md:3: {target} {why}")]);
        }
        assert_eq!(check("![a](../gone.png)").len(), 1);
        assert_eq!(check("x <img src=\"../gone.png\">").len(), 1);
        assert_eq!(check("```rust\n{{#include ../gone.rs}}\n```").len(), 1);
    }

    #[test]
    fn a_page_keeps_to_the_book() {
        assert!(check("[a](../../../README.md)")[0].contains("leaves the book"));
    }
}
