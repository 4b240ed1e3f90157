//! Tables of measured figures in the pages, each made from a file of `book/src/measured`, so that a page cannot say other than what was measured.
//!
//! A table stands between two comments. `<!-- measured NAME: COLUMN = HEADING | … -->` says which columns of `NAME.csv` it has, each with what it is called, and
//! `<!-- measured end -->` ends it. `COLUMN by INPUT` in place of the list gives a row for each combination of all other inputs, and a column for each value of that one.

use std::fs;
use std::path::Path;

use super::pages::pages_below;
use super::sweeps::FIGURES;
use crate::failure::{Failure, Result};
use crate::place::Place;

const START: &str = "<!-- measured ";
const END: &str = "<!-- measured end -->";

/// Makes every table of the book anew.
pub(crate) fn write(place: &Place) -> Result<()> {
    for page in pages_below(&place.at("book/src"))? {
        let text = read(&page)?;
        let wanted = renewed(&text, &|name| figures(place, name)).map_err(|cause| Failure::caused(page.display(), cause))?;
        if wanted != text {
            fs::write(&page, wanted).map_err(|cause| Failure::caused(page.display(), cause))?;
        }
    }
    Ok(())
}

/// A line for each page that has a table other than its figures make it.
pub(crate) fn faults(place: &Place) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    for page in pages_below(&place.at("book/src"))? {
        let text = read(&page)?;
        match renewed(&text, &|name| figures(place, name)) {
            Ok(wanted) if wanted.lines().eq(text.lines()) => {}
            Ok(_) => faults.push(format!("{}: a table is not that of its figures: make it anew with `cargo book`", page.display())),
            Err(cause) => faults.push(format!("{}: {cause}", page.display())),
        }
    }
    Ok(faults)
}

fn read(page: &Path) -> Result<String> {
    fs::read_to_string(page).map_err(|cause| Failure::caused(page.display(), cause))
}

/// The text of a file of figures.
fn figures(place: &Place, name: &str) -> std::result::Result<String, String> {
    let file = place.at(FIGURES).join(format!("{name}.csv"));
    fs::read_to_string(&file).map_err(|cause| format!("{FIGURES}/{name}.csv: {cause}"))
}

type Found<T> = std::result::Result<T, String>;

/// The page with every table made anew.
fn renewed(text: &str, figures: &dyn Fn(&str) -> Found<String>) -> Found<String> {
    let (mut page, mut rest) = (String::new(), text);
    while let Some(start) = rest.find(START).filter(|&start| !rest[start..].starts_with(END)) {
        let (before, from) = rest.split_at(start);
        let (comment, after) = from.split_once("-->").ok_or("a comment does not end")?;
        let (_, behind) = after.split_once(END).ok_or_else(|| format!("{comment}-->: there is no {END} after it"))?;
        let table = table(comment[START.len()..].trim(), figures)?;
        page += &format!("{before}{comment}-->\n\n{table}\n{END}");
        rest = behind;
    }
    Ok(page + rest)
}

/// What the comment asks for.
fn table(wanted: &str, figures: &dyn Fn(&str) -> Found<String>) -> Found<String> {
    let (name, columns) = wanted.split_once(':').ok_or_else(|| format!("{wanted:?}: expected NAME: COLUMNS"))?;
    let sheet = Sheet::parse(&figures(name.trim())?)?;
    match columns.split_once(" by ") {
        Some((column, input)) => sheet.across(column.trim(), input.trim()),
        None => sheet.along(columns),
    }
    .map_err(|cause| format!("{name}: {cause}"))
}

/// A file of figures.
struct Sheet {
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Sheet {
    fn parse(text: &str) -> Found<Self> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<String>>();
        let heads = cells(reader.headers().map_err(|error| error.to_string())?);
        let rows = reader.records().map(|record| record.map(|record| cells(&record)).map_err(|error| error.to_string()));
        Ok(Self { heads, rows: rows.collect::<Found<_>>()? })
    }

    fn find(&self, name: &str) -> Found<usize> {
        self.heads.iter().position(|head| head == name).ok_or_else(|| format!("no column {name}; there are {}", self.heads.join(", ")))
    }

    /// A row for each row, of the columns named.
    fn along(&self, columns: &str) -> Found<String> {
        let (mut picks, mut heads) = (Vec::new(), Vec::new());
        for column in columns.split('|') {
            let (name, head) = column.split_once('=').unwrap_or((column, column));
            picks.push(self.find(name.trim())?);
            heads.push(head.trim().to_owned());
        }
        let rows = self.rows.iter().map(|row| picks.iter().map(|&pick| shown(&row[pick])).collect());
        Ok(markdown(&heads, rows))
    }

    /// A row for each combination of the other inputs that vary, a column for each value of `input`.
    fn across(&self, column: &str, input: &str) -> Found<String> {
        let (column, input) = (self.find(column)?, self.find(input)?);
        // What varies comes before the first of the columns that every sweep has.
        let varied = self.find("shells")?;
        let others: Vec<usize> = (0..varied).filter(|&other| other != input).collect();
        let mut values: Vec<&String> = Vec::new();
        let mut lines: Vec<(Vec<String>, Vec<String>)> = Vec::new();
        for row in &self.rows {
            if !values.contains(&&row[input]) {
                values.push(&row[input]);
            }
            let key: Vec<String> = others.iter().map(|&other| shown(&row[other])).collect();
            match lines.iter_mut().find(|(before, _)| *before == key) {
                Some((_, cells)) => cells.push(shown(&row[column])),
                None => lines.push((key, vec![shown(&row[column])])),
            }
        }
        let heads = others.iter().map(|&other| self.heads[other].clone()).chain(values.iter().map(|value| shown(value)));
        Ok(markdown(&heads.collect::<Vec<String>>(), lines.into_iter().map(|(key, cells)| [key, cells].concat())))
    }
}

fn markdown(heads: &[String], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let rule = format!("|{}\n", "---|".repeat(heads.len()));
    line(heads) + &rule + &rows.map(|row| line(&row)).collect::<String>()
}

/// A cell as a page shows it: thousands apart, three places after the point, values of inputs as code.
fn shown(cell: &str) -> String {
    if let Ok(whole) = cell.parse::<i64>() {
        return apart(whole);
    }
    match cell.parse::<f64>() {
        Ok(number) if number.abs() >= 100.0 => format!("{number:.1}"),
        Ok(number) => format!("{number:.3}"),
        // A value of an input or its name, but not a length as `0.5 m`.
        Err(_) if cell.contains(['(', '"']) || cell.contains('.') && !cell.starts_with(|first: char| first.is_ascii_digit()) => {
            format!("`{cell}`")
        }
        Err(_) => cell.to_owned(),
    }
}

fn apart(whole: i64) -> String {
    let digits = whole.unsigned_abs().to_string();
    let grouped: Vec<&str> = digits.as_bytes().rchunks(3).rev().filter_map(|chunk| std::str::from_utf8(chunk).ok()).collect();
    format!("{}{}", if whole < 0 { "-" } else { "" }, grouped.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIGURES: &str = "case,picture.fins,shells,flip_mean\nball,false,31,0.5\nball,true,31,0.25125\n\"cat, long\",false,1234567,0.75\n\"cat, long\",true,31,123.456\n";

    fn page(wanted: &str, table: &str) -> String {
        format!("before\n<!-- measured fins: {wanted} -->\n\n{table}\n{END}\nafter\n")
    }

    fn renew(text: &str) -> Found<String> {
        renewed(text, &|name| if name == "fins" { Ok(FIGURES.into()) } else { Err(format!("{name} is not there")) })
    }

    #[test]
    fn a_table_has_the_columns_that_it_names() {
        let table = "| case | number | FLIP |\n|---|---|---|\n| ball | 31 | 0.500 |\n| ball | 31 | 0.251 |\n| cat, long | 1,234,567 | 0.750 |\n| cat, long | 31 | 123.5 |\n";
        let wanted = page("case | shells = number | flip_mean = FLIP", table);
        assert_eq!(renew(&page("case | shells = number | flip_mean = FLIP", "| old |\n")).unwrap(), wanted);
        assert_eq!(renew(&wanted).unwrap(), wanted);
    }

    #[test]
    fn values_of_an_input_stand_side_by_side() {
        let table = "| case | false | true |\n|---|---|---|\n| ball | 0.500 | 0.251 |\n| cat, long | 0.750 | 123.5 |\n";
        assert_eq!(renew(&page("flip_mean by picture.fins", "")).unwrap(), page("flip_mean by picture.fins", table));
    }

    #[test]
    fn values_of_inputs_are_code_and_lengths_are_not() {
        assert_eq!(
            ["1234.5", "0.5 m", "Level(level: 1.0)", "\"a.b\"", "picture.fins"].map(shown),
            ["1234.5", "0.5 m", "`Level(level: 1.0)`", "`\"a.b\"`", "`picture.fins`"]
        );
    }

    #[test]
    fn two_tables_of_a_page_are_both_made() {
        let text = page("case", "") + &page("shells", "");
        let found = renew(&text).unwrap();
        assert!(found.contains("| case |\n") && found.contains("| shells |\n") && found.ends_with("after\n"), "{found}");
    }

    #[test]
    fn what_cannot_be_made_is_told() {
        assert!(renew(&page("joules", "")).unwrap_err().contains("no column joules; there are case"));
        assert!(renew("<!-- measured fins: case -->").unwrap_err().contains("there is no"));
        assert!(renew("<!-- measured none: case -->\n<!-- measured end -->").unwrap_err().contains("none is not there"));
        assert!(renew("<!-- measured fins -->\n<!-- measured end -->").is_err());
    }
}
