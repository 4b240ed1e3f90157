//! What a command prints, quoted by a page: tables that no sweep makes, run anew with the rest so that none is copied by hand.
//!
//! `<!-- said by ARGUMENTS -->`, the arguments of a cargo command with blanks between, stands before what it printed, in Markdown; `<!-- said end -->` ends it.

use std::fs;

use super::pages::pages_below;
use crate::failure::{Failure, Result};
use crate::place::Place;
use crate::process::CommandLine;
use crate::vulkan;

const START: &str = "<!-- said by ";
const END: &str = "<!-- said end -->";

/// Runs every command that a page quotes, and writes what each prints.
pub(crate) fn write(place: &Place) -> Result<()> {
    vulkan::make_sure()?;
    let run = |arguments: &str| {
        println!("cargo {arguments}");
        CommandLine::cargo().with(arguments.split_whitespace()).within(place.root()).output()
    };
    for page in pages_below(&place.at("book/src"))? {
        let text = fs::read_to_string(&page).map_err(|cause| Failure::caused(page.display(), cause))?;
        let wanted = renewed(&text, &run).map_err(|cause| Failure::caused(page.display(), cause))?;
        if wanted != text {
            fs::write(&page, wanted).map_err(|cause| Failure::caused(page.display(), cause))?;
        }
    }
    Ok(())
}

/// A line for each quotation that does not end, or that is empty.
pub(crate) fn faults(place: &Place) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    for page in pages_below(&place.at("book/src"))? {
        let text = fs::read_to_string(&page).map_err(|cause| Failure::caused(page.display(), cause))?;
        faults.extend(faults_of(&text).into_iter().map(|fault| format!("{}: {fault}", page.display())));
    }
    Ok(faults)
}

fn faults_of(text: &str) -> Vec<String> {
    let empty = |quoted: &Quoted<'_>| quoted.said.trim().is_empty();
    let told = |quoted: &Quoted<'_>| format!("nothing is quoted of cargo {}: make it anew with `cargo book said`", quoted.command);
    match quotations(text) {
        Ok((quotations, _)) => quotations.iter().filter(|quoted| empty(quoted)).map(told).collect(),
        Err(fault) => vec![fault],
    }
}

/// A quotation, and what stands between it and the one before.
struct Quoted<'a> {
    before: &'a str,
    command: &'a str,
    said: &'a str,
}

/// The quotations of a text in their order, and what stands after the last.
fn quotations(text: &str) -> std::result::Result<(Vec<Quoted<'_>>, &str), String> {
    let (mut all, mut rest) = (Vec::new(), text);
    while let Some((before, from)) = rest.split_once(START) {
        let (command, from) = from.split_once("-->").ok_or("a comment does not end")?;
        let (said, after) = from.split_once(END).ok_or_else(|| format!("{START}{command}-->: there is no {END} after it"))?;
        all.push(Quoted { before, command: command.trim(), said });
        rest = after;
    }
    Ok((all, rest))
}

/// The page with every quotation made anew.
fn renewed(text: &str, run: &dyn Fn(&str) -> Result<String>) -> Result<String> {
    let (quotations, rest) = quotations(text).map_err(Failure::new)?;
    let mut page = String::new();
    for Quoted { before, command, .. } in quotations {
        page += &format!("{before}{START}{command} -->\n\n{}\n\n{END}", run(command)?.trim());
    }
    Ok(page + rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_said_takes_the_place_of_what_stood_there() {
        let page = "a\n<!-- said by run one -->\n\nold\n\n<!-- said end -->\nb\n<!-- said by run two --><!-- said end -->";
        let said = renewed(page, &|command| Ok(format!("| {command} |\n"))).unwrap();
        assert_eq!(
            said,
            "a\n<!-- said by run one -->\n\n| run one |\n\n<!-- said end -->\nb\n<!-- said by run two -->\n\n| run two |\n\n<!-- said end -->"
        );
        assert_eq!(renewed(&said, &|command| Ok(format!("| {command} |"))).unwrap(), said);
    }

    #[test]
    fn a_quotation_that_does_not_end_or_is_empty_is_told() {
        let told = faults_of("<!-- said by run one -->\nold");
        assert!(told.len() == 1 && told[0].contains("<!-- said end -->"), "{told:?}");
        let told = faults_of("<!-- said by run one -->x<!-- said end --> <!-- said by run two -->\n<!-- said end -->");
        assert!(told.len() == 1 && told[0].contains("cargo run two"), "{told:?}");
    }

    #[test]
    fn a_command_that_fails_leaves_no_page() {
        assert!(renewed("<!-- said by run one --><!-- said end -->", &|_| Err(Failure::new("no"))).is_err());
    }
}
