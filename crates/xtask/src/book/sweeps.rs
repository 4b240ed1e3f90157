//! The saved sweeps, `graphs/sweeps`: every one is measured for the book, and its figures and its plot are kept there, with a fingerprint of what they are of, so that figures of what has
//! changed since are found out.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use super::nodes;
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
/// What the figures are of: a line for each sweep, its name and what `pelage measure --fingerprint` said of it.
const FINGERPRINTS: &str = "book/src/measured/fingerprints.txt";

/// Measures the sweeps named, or all, with the release build of the program.
pub(crate) fn measure(place: &Place, wanted: &[String]) -> Result<()> {
    vulkan::make_sure()?;
    let all = place.ron_names(SWEEPS)?;
    check_names(wanted, &all)?;
    let text = text_of_pages(place)?;
    all.iter().filter(|name| wanted.is_empty() || wanted.contains(name)).try_for_each(|name| {
        measure_one(place, name, &text)?;
        keep_fingerprint(place, name, &all)
    })
}

/// That there are sweeps of these names.
fn check_names(wanted: &[String], all: &[String]) -> Result<()> {
    match wanted.iter().find(|name| !all.contains(name)) {
        Some(unknown) => {
            Err(Failure::new(format!("there is no {SWEEPS}/{unknown}.ron")).remedy(format!("name some of {}", all.join(", "))))
        }
        None => Ok(()),
    }
}

/// Puts the fingerprint of a sweep in the place of the one before; those of sweeps that there are no more go.
fn keep_fingerprint(place: &Place, name: &str, all: &[String]) -> Result<()> {
    let mut kept = fingerprints(place)?;
    kept.retain(|of, _| all.contains(of));
    kept.insert(name.to_owned(), fingerprint(place, &nodes::program(place)?, name)?);
    let text: String = kept.iter().map(|(name, fingerprint)| format!("{name} {fingerprint}\n")).collect();
    let file = place.at(FINGERPRINTS);
    fs::write(&file, text).map_err(|cause| Failure::caused(file.display(), cause))
}

/// Those that are kept, by name.
fn fingerprints(place: &Place) -> Result<BTreeMap<String, String>> {
    let file = place.at(FINGERPRINTS);
    let text =
        if file.is_file() { fs::read_to_string(&file).map_err(|cause| Failure::caused(file.display(), cause))? } else { String::new() };
    Ok(text.lines().filter_map(|line| line.split_once(' ')).map(|(name, print)| (name.to_owned(), print.to_owned())).collect())
}

/// What the program says of a sweep.
fn fingerprint(place: &Place, program: &str, name: &str) -> Result<String> {
    let sweep = place.at(SWEEPS).join(format!("{name}.ron"));
    let said = CommandLine::new(program).with(["measure", "--fingerprint", "--sweep"]).with([sweep]).within(place.root()).output()?;
    Ok(said.trim().to_owned())
}

/// A line for each sweep whose figures are of what was before a change. Asks the program, which has to be built.
pub(crate) fn old(place: &Place) -> Result<Vec<String>> {
    let (kept, program) = (fingerprints(place)?, nodes::program(place)?);
    let now = |name: String| fingerprint(place, &program, &name).map(|now| (name, now));
    let now = place.ron_names(SWEEPS)?.into_iter().map(now).collect::<Result<Vec<_>>>()?;
    Ok(now.iter().filter_map(|(name, now)| old_of(name, now, kept.get(name))).collect())
}

fn old_of(name: &str, now: &str, kept: Option<&String>) -> Option<String> {
    let is_old = kept.is_none_or(|kept| kept != now);
    is_old.then(|| {
        format!("{FIGURES}/{name}.csv is of a graph, a node or a file that has changed: measure it anew with `cargo book sweeps {name}`")
    })
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
    Ok(place.ron_names(SWEEPS)?.iter().flat_map(|name| faults_of(name, &text, there)).collect())
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
    fn figures_of_what_has_changed_are_told() {
        assert_eq!(old_of("fins", "a1", Some(&"a1".to_owned())), None);
        assert!(old_of("fins", "a1", Some(&"b2".to_owned())).is_some_and(|told| told.contains("cargo book sweeps fins")));
        assert!(old_of("fins", "a1", None).is_some());
    }

    #[test]
    fn a_sweep_that_there_is_not_is_refused() {
        let all = ["fins".to_owned(), "shells".to_owned()];
        assert!(check_names(&all[..1], &all).is_ok() && check_names(&[], &all).is_ok());
        let refused = check_names(&["shels".to_owned()], &all).unwrap_err().to_string();
        assert!(refused.contains("no graphs/sweeps/shels.ron") && refused.contains("fins, shells"), "{refused}");
    }
}
