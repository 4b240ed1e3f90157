//! Draws the kept pictures of the graphs named, or of all, anew.
#![allow(clippy::print_stdout, reason = "a program for a person at a terminal")]

use pelage_tests::{Error, Golden, Scene, graph_names};

fn main() -> Result<(), Error> {
    let named: Vec<String> = std::env::args().skip(1).collect();
    for name in if named.is_empty() { graph_names()? } else { named } {
        let path = Golden::keep(&name, &*Scene::evaluate(&name, &[])?.picture()?)?;
        println!("{}: look at it before you commit it", path.display());
    }
    Ok(())
}
