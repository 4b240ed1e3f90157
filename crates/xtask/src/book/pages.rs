//! The book's pages are those of its contents: none missing, none left out, none twice.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::markdown::Page;
use crate::failure::{Failure, Result};

/// The book's contents.
pub(crate) const SUMMARY: &str = "SUMMARY.md";

/// Compares `SUMMARY.md` with the pages in the folder `source` and below. A line for each fault.
pub(crate) fn faults(source: &Path) -> Result<Vec<String>> {
    let summary = source.join(SUMMARY);
    let text = fs::read_to_string(&summary).map_err(|cause| Failure::caused(summary.display(), cause))?;
    let listed: Vec<String> = Page::read(&text).references.into_iter().map(|reference| reference.target).collect();
    let there: BTreeSet<String> = pages_below(source)?.iter().filter_map(|page| relative(source, page)).collect();
    Ok(compare(&listed, &there))
}

/// Every Markdown file in `folder` and below, sorted.
pub(crate) fn pages_below(folder: &Path) -> Result<Vec<PathBuf>> {
    let failed = |cause| Failure::caused(folder.display(), cause);
    let mut pages = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() {
            pages.extend(pages_below(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            pages.push(path);
        }
    }
    pages.sort();
    Ok(pages)
}

/// `page` from `source`, with slashes.
fn relative(source: &Path, page: &Path) -> Option<String> {
    let path = page.strip_prefix(source).ok()?;
    Some(path.to_string_lossy().replace('\\', "/"))
}

fn compare(listed: &[String], there: &BTreeSet<String>) -> Vec<String> {
    let mut faults = Vec::new();
    let mut seen = BTreeSet::new();
    for page in listed {
        if !seen.insert(page) {
            faults.push(format!("{SUMMARY} lists {page} twice"));
        } else if !there.contains(page) {
            faults.push(format!("{SUMMARY} lists {page}, which is not there"));
        }
    }
    faults.extend(there.iter().filter(|page| *page != SUMMARY && !seen.contains(page)).map(|page| format!("{page} is not in {SUMMARY}")));
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    fn book(summary: &str, pages: &[&str]) -> Vec<String> {
        let source = tempfile::tempdir().unwrap();
        fs::create_dir(source.path().join("algorithms")).unwrap();
        fs::write(source.path().join(SUMMARY), summary).unwrap();
        for page in pages {
            fs::write(source.path().join(page), "# Page").unwrap();
        }
        faults(source.path()).unwrap()
    }

    #[test]
    fn contents_and_pages_agree() {
        let summary = "# Summary\n\n[Introduction](introduction.md)\n\n# Algorithms\n\n- [Fins](algorithms/fins.md)\n";
        assert_eq!(book(summary, &["introduction.md", "algorithms/fins.md"]), Vec::<String>::new());
    }

    #[test]
    fn each_disagreement_is_told() {
        let summary = "[A](a.md)\n\n- [A again](a.md)\n- [Gone](algorithms/gone.md)\n";
        let found = book(summary, &["a.md", "algorithms/forgotten.md", "picture.png"]);
        assert_eq!(
            found,
            [
                "SUMMARY.md lists a.md twice",
                "SUMMARY.md lists algorithms/gone.md, which is not there",
                "algorithms/forgotten.md is not in SUMMARY.md"
            ]
        );
    }

    #[test]
    fn a_book_without_contents_fails() {
        assert!(faults(tempfile::tempdir().unwrap().path()).is_err());
    }
}
