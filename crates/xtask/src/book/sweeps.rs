//! The saved sweeps, `graphs/sweeps`: every one is measured for the book, and its figures and its plot are kept there.

use std::fs;
use std::path::PathBuf;

use super::pages::pages_below;
use crate::failure::{Failure, Result};
use crate::place::Place;
use crate::process::CommandLine;
use crate::vulkan;

const SWEEPS: &str = "graphs/sweeps";
/// Where the figures are kept, `NAME.csv`.
pub(crate) const FIGURES: &str = "book/src/measured";
/// Where the plots are kept, `sweep-NAME.svg`, and the contact sheets that a page shows, `sweep-NAME.png`.
const PICTURES: &str = "book/src/pictures";

/// Measures the sweeps named, or all, with the release build of the program.
pub(crate) fn measure(place: &Place, wanted: &[String]) -> Result<()> {
    vulkan::make_sure()?;
    let all = names(place)?;
    if let Some(unknown) = wanted.iter().find(|name| !all.contains(name)) {
        return Err(Failure::new(format!("there is no {SWEEPS}/{unknown}.ron")).remedy(format!("name some of {}", all.join(", "))));
    }
    let text = text_of_pages(place)?;
    all.iter().filter(|name| wanted.is_empty() || wanted.contains(name)).try_for_each(|name| measure_one(place, name, &text))
}

/// Runs a sweep, and takes from it what the book shows.
fn measure_one(place: &Place, name: &str, text: &str) -> Result<()> {
    println!("{SWEEPS}/{name}.ron");
    let out = place.at("target/book-sweeps").join(name);
    CommandLine::cargo()
        .with(["run", "--quiet", "--release", "--package", "pelage-cli", "--", "measure", "--quiet", "--sweep"])
        .with([place.at(SWEEPS).join(format!("{name}.ron"))])
        .with(["-o".into(), out.clone()])
        .within(place.root())
        .run()?;
    let sheet = shown(text, &sheet(name)).then(|| ("sheet.png", place.at(PICTURES).join(sheet(name))));
    let kept = [("sweep.csv", place.at(FIGURES).join(format!("{name}.csv"))), ("sweep.svg", place.at(PICTURES).join(plot(name)))];
    let copy = |(file, to): (&str, PathBuf)| fs::copy(out.join(file), &to).map(drop).map_err(|cause| Failure::caused(to.display(), cause));
    kept.into_iter().chain(sheet).try_for_each(copy)
}

/// A line for each sweep whose figures or plot are not there, or that no page shows.
pub(crate) fn faults(place: &Place) -> Result<Vec<String>> {
    let text = text_of_pages(place)?;
    let there = |file: &str| place.at(file).is_file();
    Ok(names(place)?.iter().flat_map(|name| faults_of(name, &text, there)).collect())
}

fn faults_of(name: &str, text: &str, there: impl Fn(&str) -> bool) -> Vec<String> {
    let mut wanted = vec![format!("{FIGURES}/{name}.csv"), format!("{PICTURES}/{}", plot(name))];
    wanted.extend(shown(text, &sheet(name)).then(|| format!("{PICTURES}/{}", sheet(name))));
    let missing = wanted.iter().filter(|file| !there(file));
    let mut faults: Vec<String> = missing.map(|file| format!("{file} is not there: measure it with `cargo book sweeps {name}`")).collect();
    if !shown(text, &plot(name)) {
        faults.push(format!("{SWEEPS}/{name}.ron is measured and {} shown on no page: show it, or delete the sweep", plot(name)));
    }
    faults
}

fn plot(name: &str) -> String {
    format!("sweep-{name}.svg")
}

fn sheet(name: &str) -> String {
    format!("sweep-{name}.png")
}

fn shown(text: &str, picture: &str) -> bool {
    text.contains(&format!("pictures/{picture})"))
}

/// Names of the sweeps, sorted.
fn names(place: &Place) -> Result<Vec<String>> {
    let folder = place.at(SWEEPS);
    let failed = |cause| Failure::caused(folder.display(), cause);
    let mut names = Vec::new();
    for entry in fs::read_dir(&folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|extension| extension == "ron") {
            names.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
        }
    }
    names.sort();
    Ok(names)
}

fn text_of_pages(place: &Place) -> Result<String> {
    let read = |page: &PathBuf| fs::read_to_string(page).map_err(|cause| Failure::caused(page.display(), cause));
    Ok(pages_below(&place.at("book/src"))?.iter().map(read).collect::<Result<Vec<String>>>()?.concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_or_not_shown_is_told() {
        let text = "![a](pictures/sweep-shells.svg) ![b](../pictures/sweep-shells.png)";
        assert_eq!(faults_of("shells", text, |_| true), Vec::<String>::new());
        assert_eq!(faults_of("shells", text, |_| false).len(), 3);
        let told = faults_of("fins", text, |_| true);
        assert!(told.len() == 1 && told[0].contains("sweep-fins.svg shown on no page"), "{told:?}");
    }

    #[test]
    fn a_sweep_that_there_is_not_is_refused() {
        let place = Place::find().unwrap();
        assert!(names(&place).unwrap().contains(&"shells".to_owned()));
    }
}
