//! The book: built, checked, its node reference, its pictures and what it says of extremes made anew.

mod extremes;
mod links;
mod markdown;
mod nodes;
mod pages;
mod pictures;
mod plot;
mod said;
mod sweeps;
mod tables;

use clap::ValueEnum;
use mdbook_driver::MDBook;

use crate::failure::{Failure, Result};
use crate::place::Place;

/// What `cargo book` makes besides the pages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum What {
    /// Draw the book's pictures anew, each from its saved graph, and its plots.
    Pictures,
    /// Draw its plots alone anew, from the figures that benchmarks wrote.
    Plots,
    /// Measure the saved sweeps anew, all or those named after it: their figures, plots, contact sheets and tables.
    Sweeps,
    /// Run the commands whose tables pages quote, and quote them anew.
    Said,
    /// Run the tests that the page of extremes names, and write what each reached. Wants the models that `PELAGE_MODELS` names.
    Extremes,
    /// All of these: pictures, plots, sweeps, what is said, and extremes, which are left as they are where there are no models.
    All,
}

/// Makes the node reference and the tables of figures anew, what is asked for besides, and builds the book into `book/book`.
pub(crate) fn run(place: &Place, what: Option<What>, sweeps: &[String]) -> Result<()> {
    nodes::write(place)?;
    let wants = |one: &[What]| what.is_some_and(|what| what == What::All || one.contains(&what));
    if wants(&[What::Pictures]) {
        pictures::draw(place)?;
    }
    if wants(&[What::Pictures, What::Plots]) {
        plot::draw(place)?;
    }
    if wants(&[What::Sweeps]) {
        sweeps::measure(place, sweeps)?;
    }
    if wants(&[What::Said]) {
        said::write(place)?;
    }
    if what == Some(What::All) && !extremes::has_models() {
        println!("PELAGE_MODELS is not set: the page of extremes stays as it is, as half of its values are of those models");
    } else if wants(&[What::Extremes]) {
        extremes::write(place)?;
    }
    tables::write(place)?;
    check_sources(place)?;
    build(place)?;
    println!("the book: {}", place.at("book/book/index.html").display());
    Ok(())
}

/// Checks the sources and the node reference, and builds the book. Changes no source.
pub(crate) fn verify(place: &Place) -> Result<()> {
    check_sources(place)?;
    nodes::check(place)?;
    hold(&sweeps::old(place)?)?;
    build(place)
}

fn hold(faults: &[String]) -> Result<()> {
    if faults.is_empty() { Ok(()) } else { Err(Failure::faults("the book does not hold together", faults)) }
}

/// All that can be seen without building.
fn check_sources(place: &Place) -> Result<()> {
    let mut faults = pages::faults(&place.at("book/src"))?;
    faults.extend(pictures::faults(place)?);
    faults.extend(plot::faults(place)?);
    faults.extend(sweeps::faults(place)?);
    faults.extend(tables::faults(place)?);
    faults.extend(said::faults(place)?);
    faults.extend(links::faults(place)?);
    hold(&faults)
}

fn build(place: &Place) -> Result<()> {
    let built = MDBook::load(place.at("book")).and_then(|book| book.build());
    built.map_err(|cause| Failure::new(format!("mdBook: {cause:#}")))
}
