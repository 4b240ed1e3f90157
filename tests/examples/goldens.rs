//! Draws the kept pictures of the graphs and variants named, or of all, anew.
#![allow(clippy::print_stdout, reason = "a program for a person at a terminal")]

use pelage_tests::{Error, Golden, Scene, VARIANTS, graph_names};

fn main() -> Result<(), Error> {
    let named: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &str| named.is_empty() || named.iter().any(|wanted| wanted == name);
    let keep = |name: &str, graph: &str, overrides| -> Result<(), Error> {
        let path = Golden::keep(name, &*Scene::evaluate(graph, overrides)?.picture()?)?;
        println!("{}: look at it before you commit it", path.display());
        Ok(())
    };
    for name in graph_names()?.iter().filter(|name| wanted(name)) {
        keep(name, name, &[])?;
    }
    for variant in VARIANTS.iter().filter(|variant| wanted(variant.name)) {
        keep(variant.name, variant.graph, variant.overrides)?;
    }
    Ok(())
}
