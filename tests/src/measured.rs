//! The figures that the book shows, `book/src/measured`, and what its pages say of them.

use std::collections::BTreeMap;
use std::fs;

use crate::{Error, repository};

/// A row of figures by the names of its columns.
pub type Row = BTreeMap<String, String>;

/// The figures of a sweep, a row for each setting in its order.
pub struct Figures(pub Vec<Row>);

impl Figures {
    /// Those of `graphs/sweeps/NAME.ron`.
    ///
    /// # Errors
    /// What is wrong with the file, if it cannot be read.
    pub fn of(name: &str) -> Result<Self, Error> {
        let file = repository().join("book/src/measured").join(format!("{name}.csv"));
        let mut reader = csv::Reader::from_path(&file).map_err(|cause| format!("{}: {cause}", file.display()))?;
        Ok(Self(reader.deserialize().collect::<Result<_, _>>()?))
    }

    /// A number of the one row that has these values.
    ///
    /// # Errors
    /// Where there is no such row, more than one, or no such number.
    pub fn at(&self, column: &str, values: &[(&str, &str)]) -> Result<f64, Error> {
        let found: Vec<&Row> = self.0.iter().filter(|row| values.iter().all(|(input, value)| row[*input] == *value)).collect();
        let [row] = found[..] else { return Err(format!("{} rows have {values:?}", found.len()).into()) };
        number(row, column)
    }

    /// A column of each group of rows that are alike in `by`, in their order.
    ///
    /// # Errors
    /// Where there is no such number.
    pub fn by(&self, by: &[&str], column: &str) -> Result<BTreeMap<String, Vec<f64>>, Error> {
        let mut groups: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for row in &self.0 {
            let group: Vec<&str> = by.iter().map(|input| row[*input].as_str()).collect();
            groups.entry(group.join(", ")).or_default().push(number(row, column)?);
        }
        Ok(groups)
    }
}

/// A number of a row.
///
/// # Errors
/// Where there is no such column, or no number in it.
pub fn number(row: &Row, column: &str) -> Result<f64, Error> {
    let text = row.get(column).ok_or_else(|| format!("no column {column}"))?;
    text.parse().map_err(|_| format!("{column}: {text:?} is no number").into())
}

/// The least and the most of numbers.
#[must_use]
pub fn span(numbers: impl IntoIterator<Item = f64>) -> [f64; 2] {
    numbers.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], number| [least.min(number), most.max(number)])
}

/// A page of the book, to be held against figures.
pub struct Page {
    name: String,
    text: String,
}

impl Page {
    /// `book/src/NAME.md`, its line breaks as blanks.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn read(name: &str) -> Result<Self, Error> {
        let text = fs::read_to_string(repository().join(format!("book/src/{name}.md")))?;
        Ok(Self { name: name.to_owned(), text: text.split_whitespace().collect::<Vec<_>>().join(" ") })
    }

    /// That the page has this sentence, or part of one, whose numbers were worked out from the figures.
    ///
    /// # Errors
    /// Where it says something else: what it ought to say.
    pub fn says(&self, sentence: &str) -> Result<(), Error> {
        if self.text.contains(sentence) { Ok(()) } else { Err(format!("{}.md does not say {sentence:?}", self.name).into()) }
    }
}
