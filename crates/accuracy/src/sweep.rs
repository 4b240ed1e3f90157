//! What settings cost and how far they err: plain tables.

use serde_json::{Map, Value, json};

use crate::{AccuracyError, pareto_front, unbeaten};

/// What a column of numbers means.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// A word, for scripts.
    pub name: String,
    /// Its unit, as a person reads it.
    pub unit: String,
    /// Digits after the point: 0 for a count.
    pub digits: usize,
}

impl Column {
    /// A column of counts, or of numbers with so many digits after the point.
    pub fn new(name: &str, unit: &str, digits: usize) -> Self {
        Self { name: name.to_owned(), unit: unit.to_owned(), digits }
    }

    /// A number as the column has it; nothing where there is none.
    fn text(&self, value: f64) -> String {
        if value.is_finite() { format!("{value:.*}", self.digits) } else { String::new() }
    }

    /// The same number, as JSON; null where there is none.
    fn value(&self, value: f64) -> Value {
        if !value.is_finite() {
            return Value::Null;
        }
        if self.digits == 0 { json!(value.round() as i64) } else { self.text(value).parse::<f64>().map_or(Value::Null, Value::from) }
    }
}

/// One setting, and what it came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// A text for each input that varies.
    pub settings: Vec<String>,
    /// A number for each column; NaN where there is none.
    pub values: Vec<f64>,
}

/// A table of settings: what was varied, what each setting costs and how far it errs. Less is better in every column that [`front`](Self::front) is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Names of the inputs that vary.
    pub varied: Vec<String>,
    /// What the numbers mean.
    pub columns: Vec<Column>,
    /// The settings, in the order in which they were tried.
    pub rows: Vec<Row>,
    /// Pairs of names of columns, cost and error, whose fronts are of interest: each is one more column, `front_COST`, of 1 for what is on it and 0 for the others. Then `front`, that of all
    /// of these costs and errors together: what it has, no other setting gives for as little of everything.
    pub fronts: Vec<(String, String)>,
    /// Names out of `varied` by which the rows fall into groups, as by the model that is drawn: only rows of one group compete. None: all do.
    pub grouped_by: Vec<String>,
}

/// Rows that compete with one another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Its values of what the rows are grouped by, with commas between; empty where all rows are one group.
    pub name: String,
    /// Its rows, in their order.
    pub rows: Vec<usize>,
}

impl Group {
    /// Rows that have equal names are of one group; groups stand in the order in which the first row of each comes.
    pub fn of(names: impl IntoIterator<Item = String>) -> Vec<Self> {
        let mut groups: Vec<Self> = Vec::new();
        for (row, name) in names.into_iter().enumerate() {
            match groups.iter_mut().find(|group| group.name == name) {
                Some(group) => group.rows.push(row),
                None => groups.push(Self { name, rows: vec![row] }),
            }
        }
        groups
    }
}

impl Sweep {
    /// Where a column is.
    ///
    /// # Errors
    ///
    /// [`NoSuchColumn`](AccuracyError::NoSuchColumn).
    pub fn column(&self, name: &str) -> Result<usize, AccuracyError> {
        self.columns.iter().position(|column| column.name == name).ok_or_else(|| AccuracyError::NoSuchColumn {
            name: name.to_owned(),
            known: self.columns.iter().map(|column| column.name.as_str()).collect::<Vec<_>>().join(", "),
        })
    }

    /// Which of the inputs that vary this is.
    ///
    /// # Errors
    ///
    /// [`NoSuchColumn`](AccuracyError::NoSuchColumn).
    pub fn varied_index(&self, name: &str) -> Result<usize, AccuracyError> {
        let found = self.varied.iter().position(|varied| varied == name);
        found.ok_or_else(|| AccuracyError::NoSuchColumn { name: name.to_owned(), known: self.varied.join(", ") })
    }

    /// The rows that have the same values of some of the inputs that vary, in the order in which the first of each comes.
    ///
    /// # Errors
    ///
    /// [`RowLength`](AccuracyError::RowLength), [`NoSuchColumn`](AccuracyError::NoSuchColumn).
    pub fn groups(&self, by: &[String]) -> Result<Vec<Group>, AccuracyError> {
        self.check_rows()?;
        let picks = by.iter().map(|name| self.varied_index(name)).collect::<Result<Vec<usize>, _>>()?;
        let name = |row: &Row| picks.iter().map(|&pick| row.settings[pick].as_str()).collect::<Vec<_>>().join(", ");
        Ok(Group::of(self.rows.iter().map(name)))
    }

    fn check_rows(&self) -> Result<(), AccuracyError> {
        for (index, row) in self.rows.iter().enumerate() {
            for (found, expected) in [(row.settings.len(), self.varied.len()), (row.values.len(), self.columns.len())] {
                if found != expected {
                    return Err(AccuracyError::RowLength { row: index, expected, found });
                }
            }
        }
        Ok(())
    }

    /// That every row has a value for each column, and that there is each column that a front is asked of, and each input that rows are grouped by.
    ///
    /// # Errors
    ///
    /// [`RowLength`](AccuracyError::RowLength), [`NoSuchColumn`](AccuracyError::NoSuchColumn).
    pub fn check(&self) -> Result<(), AccuracyError> {
        self.check_rows()?;
        self.grouped_by.iter().try_for_each(|name| self.varied_index(name).map(|_| ()))?;
        self.fronts.iter().try_for_each(|(cost, error)| self.column(cost).and(self.column(error)).map(|_| ()))
    }

    /// Costs and errors, a pair for each row.
    ///
    /// # Errors
    ///
    /// Those of [`check`](Self::check).
    pub fn points(&self, cost: &str, error: &str) -> Result<Vec<(f64, f64)>, AccuracyError> {
        self.check()?;
        let (cost, error) = (self.column(cost)?, self.column(error)?);
        Ok(self.rows.iter().map(|row| (row.values[cost], row.values[error])).collect())
    }

    /// The rows that no other of their group beats, group by group, by rising cost: see [`pareto_front`].
    ///
    /// # Errors
    ///
    /// Those of [`check`](Self::check).
    pub fn front(&self, cost: &str, error: &str) -> Result<Vec<usize>, AccuracyError> {
        let points = self.points(cost, error)?;
        let of_group = |group: Group| {
            let own: Vec<(f64, f64)> = group.rows.iter().map(|&row| points[row]).collect();
            pareto_front(&own).into_iter().map(|index| group.rows[index]).collect::<Vec<usize>>()
        };
        Ok(self.groups(&self.grouped_by)?.into_iter().flat_map(of_group).collect())
    }

    /// The rows that no other of their group beats in all costs and errors of [`fronts`](Self::fronts) together, in their order: see [`unbeaten`].
    ///
    /// # Errors
    ///
    /// Those of [`check`](Self::check).
    pub fn front_of_all(&self) -> Result<Vec<usize>, AccuracyError> {
        self.check()?;
        let columns =
            self.fronts.iter().flat_map(|(cost, error)| [cost, error]).map(|name| self.column(name)).collect::<Result<Vec<usize>, _>>()?;
        let numbers = |&row: &usize| columns.iter().map(|&column| self.rows[row].values[column]).collect();
        let of_group = |group: Group| {
            let own: Vec<Vec<f64>> = group.rows.iter().map(numbers).collect();
            unbeaten(&own).into_iter().map(|index| group.rows[index]).collect::<Vec<usize>>()
        };
        let mut front: Vec<usize> = self.groups(&self.grouped_by)?.into_iter().flat_map(of_group).collect();
        front.sort_unstable();
        Ok(front)
    }

    /// As CSV (RFC 4180, but lines end with a line feed alone): a line of names, and one for each row.
    ///
    /// # Errors
    ///
    /// Those of [`check`](Self::check).
    pub fn to_csv(&self) -> Result<String, AccuracyError> {
        let fronts = self.all_fronts()?;
        let names = self.varied.iter().chain(self.columns.iter().map(|column| &column.name)).map(|name| quoted(name));
        let mut csv = line(names.chain(fronts.iter().map(|(name, _)| quoted(name))));
        for (index, row) in self.rows.iter().enumerate() {
            let settings = row.settings.iter().map(|setting| quoted(setting));
            let values = self.columns.iter().zip(&row.values).map(|(column, &value)| column.text(value));
            let on = fronts.iter().map(|(_, front)| u8::from(front.contains(&index)).to_string());
            csv += &line(settings.chain(values).chain(on));
        }
        Ok(csv)
    }

    /// As JSON: `{ "varied": […], "grouped_by": […], "columns": { NAME: UNIT … }, "fronts": { COST: { "error", "rows" } … }, "rows": [ { "settings": { INPUT: VALUE … }, NAME: NUMBER … } … ] }`.
    ///
    /// # Errors
    ///
    /// Those of [`check`](Self::check).
    pub fn to_json(&self) -> Result<Value, AccuracyError> {
        let mut fronts = Map::new();
        for (cost, error) in &self.fronts {
            fronts.insert(cost.clone(), json!({ "error": error, "rows": self.front(cost, error)? }));
        }
        let columns: Map<String, Value> = self.columns.iter().map(|column| (column.name.clone(), json!(column.unit))).collect();
        let row = |row: &Row| {
            let settings: Map<String, Value> = self.varied.iter().cloned().zip(row.settings.iter().map(|setting| json!(setting))).collect();
            let mut object = Map::from_iter([("settings".to_owned(), Value::Object(settings))]);
            object.extend(self.columns.iter().zip(&row.values).map(|(column, &value)| (column.name.clone(), column.value(value))));
            Value::Object(object)
        };
        self.check()?;
        Ok(
            json!({ "varied": self.varied, "grouped_by": self.grouped_by, "columns": columns, "fronts": fronts, "rows": self.rows.iter().map(row).collect::<Vec<_>>() }),
        )
    }

    /// The name of each column of fronts, and the rows on it.
    fn all_fronts(&self) -> Result<Vec<(String, Vec<usize>)>, AccuracyError> {
        self.check()?;
        let own = self.fronts.iter().map(|(cost, error)| Ok((format!("front_{cost}"), self.front(cost, error)?)));
        let together = if self.fronts.is_empty() { None } else { Some(self.front_of_all().map(|rows| ("front".to_owned(), rows))) };
        own.chain(together).collect()
    }
}

fn line(cells: impl Iterator<Item = String>) -> String {
    cells.collect::<Vec<_>>().join(",") + "\n"
}

/// A text as one cell.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) fn sweep() -> Sweep {
        let row = |layers: &str, cost: f64, error: f64| Row {
            settings: vec![layers.into(), "Table(size: 4, of: \"x\")".into()],
            values: vec![cost, error],
        };
        Sweep {
            varied: vec!["shells.layers".into(), "picture.lighting".into()],
            columns: vec![Column::new("fragments", "samples", 0), Column::new("flip_mean", "0 to 1", 3)],
            rows: vec![row("4", 100.0, 0.5), row("8", 300.0, 0.125), row("16", 400.0, 0.25), row("32", 800.0, f64::NAN)],
            fronts: vec![("fragments".into(), "flip_mean".into())],
            grouped_by: Vec::new(),
        }
    }

    #[test]
    fn what_is_beaten_in_each_cost_may_be_on_the_front_of_all() {
        let mut sweep = sweep();
        sweep.columns.push(Column::new("bytes", "bytes", 0));
        // Cheap in fragments, cheap in bytes, a bit of both, and worse than that in everything.
        for (row, values) in sweep.rows.iter_mut().zip([[100.0, 0.2, 900.0], [900.0, 0.2, 100.0], [300.0, 0.2, 300.0], [400.0, 0.3, 400.0]])
        {
            row.values = values.into();
        }
        sweep.fronts.push(("bytes".into(), "flip_mean".into()));
        assert_eq!((sweep.front("fragments", "flip_mean").unwrap(), sweep.front("bytes", "flip_mean").unwrap()), (vec![0], vec![1]));
        assert_eq!(sweep.front_of_all().unwrap(), [0, 1, 2]);
        sweep.grouped_by = vec!["shells.layers".into()];
        assert_eq!(sweep.front_of_all().unwrap(), [0, 1, 2, 3]);
    }

    #[test]
    fn rows_compete_within_their_group() {
        let mut grouped = sweep();
        grouped.rows[2].settings[1] = "Pixels".into();
        assert_eq!(grouped.front("fragments", "flip_mean").unwrap(), [0, 1]);
        grouped.grouped_by = vec!["picture.lighting".into()];
        assert_eq!(grouped.front("fragments", "flip_mean").unwrap(), [0, 1, 2]);
        let groups = grouped.groups(&grouped.grouped_by).unwrap();
        assert_eq!(groups.iter().map(|group| group.rows.clone()).collect::<Vec<_>>(), [vec![0, 1, 3], vec![2]]);
        assert_eq!(groups[1].name, "Pixels");
        grouped.grouped_by = vec!["model".into()];
        assert!(matches!(grouped.to_csv(), Err(AccuracyError::NoSuchColumn { .. })));
    }

    #[test]
    fn csv_quotes_what_has_to_be_and_says_what_is_on_the_front() {
        let csv = sweep().to_csv().unwrap();
        let lines: Vec<&str> = csv.lines().collect();
        assert_eq!(lines[0], "shells.layers,picture.lighting,fragments,flip_mean,front_fragments,front");
        assert_eq!(lines[1], r#"4,"Table(size: 4, of: ""x"")",100,0.500,1,1"#);
        assert!(lines[2].ends_with(",300,0.125,1,1") && lines[3].ends_with(",400,0.250,0,0") && lines[4].ends_with(",800,,0,0"), "{csv}");
    }

    #[test]
    fn json_has_the_same() {
        let json = sweep().to_json().unwrap();
        assert_eq!(json["fronts"]["fragments"], json!({ "error": "flip_mean", "rows": [0, 1] }));
        assert_eq!(json["rows"][1]["settings"]["shells.layers"], "8");
        assert_eq!((&json["rows"][1]["fragments"], &json["rows"][1]["flip_mean"]), (&json!(300), &json!(0.125)));
        assert_eq!((&json["rows"][3]["flip_mean"], &json["columns"]["fragments"]), (&Value::Null, &json!("samples")));
    }

    #[test]
    fn a_torn_table_is_refused() {
        let mut torn = sweep();
        torn.rows[2].values.pop();
        assert_eq!(torn.to_csv(), Err(AccuracyError::RowLength { row: 2, expected: 2, found: 1 }));
        assert_eq!(torn.to_json(), Err(AccuracyError::RowLength { row: 2, expected: 2, found: 1 }));
        let mut unknown = sweep();
        unknown.fronts[0].0 = "joules".into();
        let error = unknown.to_csv().unwrap_err();
        assert!(error.to_string().contains("joules") && error.to_string().contains("fragments, flip_mean"), "{error}");
    }
}
