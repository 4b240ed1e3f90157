//! The table of a sweep, and the files it is written to.

use std::path::Path;

use pelage_accuracy::{Column, Panel, Row, Sweep};
use serde_json::{Value, json};

use super::description::Description;
use super::plan::Plan;
use super::run::{Measured, MeasuredSetting};
use crate::failure::Failure;
use crate::output::write_files;

/// By which pictures are judged where one number has to do.
const ERROR: &str = "flip_mean";

/// Costs whose fronts are sought and drawn. The first two do not depend on how busy the machine is.
const COSTS: [&str; 3] = ["fragments", "texture_bytes", "ms_min"];

/// A column, and its number of a setting.
type Measure = (&'static str, &'static str, usize, fn(&MeasuredSetting) -> f64);

const MEASURES: &[Measure] = &[
    ("shells", "shells drawn", 0, |one| f64::from(one.contender.report().stats.shells_drawn)),
    ("fins", "fins drawn", 0, |one| f64::from(one.contender.report().stats.fins_drawn)),
    ("triangles", "triangles", 0, |one| one.contender.report().stats.triangles as f64),
    ("fragments", "samples that pass the tests", 0, |one| {
        one.contender.report().stats.fragments.map_or(f64::NAN, |fragments| fragments.total() as f64)
    }),
    ("texture_bytes", "bytes", 0, |one| one.contender.texture_bytes() as f64),
    ("flip_mean", "0 to 1", 5, |one| one.errors.flip_mean),
    ("flip_p99", "0 to 1", 5, |one| one.errors.flip_p99),
    ("rmse_linear", "0 to 1, linear light", 5, |one| one.errors.rmse_linear),
    ("light", "of the light that should be", 4, |one| one.errors.light),
    ("outline_shift", "pixels outwards", 3, |one| one.errors.outline_shift),
    ("outline_rms", "alpha", 5, |one| one.errors.outline_rms),
    ("alpha_bias", "alpha", 5, |one| one.errors.alpha_bias),
];

/// What was found out.
pub(crate) struct Results {
    sweep: Sweep,
    title: String,
    /// What is said beside the table.
    about: Value,
    /// For each row, distance and the alpha of reference and test.
    profiles: Vec<Value>,
}

impl Results {
    pub(crate) fn new(description: &Description, plan: &Plan, measured: &Measured, rounds: u32) -> Self {
        let columns = MEASURES.iter().map(|(name, unit, digits, _)| Column::new(name, unit, *digits));
        let times = [("ms_min", "ms"), ("ms_median", "ms"), ("ms_ratio", "of the last setting's of the group, in the same round")];
        let columns = columns.chain(times.map(|(name, unit)| Column::new(name, unit, 3))).collect();
        let row = |(index, one): (usize, &MeasuredSetting)| {
            let values = MEASURES.iter().map(|(_, _, _, value)| value(one)).chain(measured.times[index]).collect();
            Row { settings: plan.settings[index].values.clone(), values }
        };
        let rows = measured.settings.iter().enumerate().map(row).collect();
        let fronts = COSTS.iter().map(|&cost| (cost.to_owned(), ERROR.to_owned())).collect();
        let profile = |one: &MeasuredSetting| one.errors.profile.iter().map(|bin| json!([bin.distance, bin.reference, bin.test])).collect();
        Self {
            sweep: Sweep { varied: plan.varied.clone(), columns, rows, fronts, grouped_by: plan.grouped_by.clone() },
            title: description.title.clone(),
            about: about(description, plan, measured, rounds),
            profiles: measured.settings.iter().map(profile).collect(),
        }
    }

    /// For a person: Markdown.
    pub(crate) fn to_table(&self) -> String {
        let columns: Vec<usize> = [
            "shells",
            "fragments",
            "texture_bytes",
            "ms_min",
            "ms_ratio",
            "flip_mean",
            "flip_p99",
            "rmse_linear",
            "light",
            "outline_shift",
        ]
        .iter()
        .filter_map(|name| self.sweep.column(name).ok())
        .collect();
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let names = columns.iter().map(|&column| self.sweep.columns[column].name.clone());
        let heads: Vec<String> = self.sweep.varied.iter().cloned().chain(names).collect();
        let mut table = line(heads.clone()) + &format!("|{}\n", "---|".repeat(heads.len()));
        for row in &self.sweep.rows {
            let number = |&column: &usize| format!("{:.*}", self.sweep.columns[column].digits.min(4), row.values[column]);
            table += &line(row.settings.iter().cloned().chain(columns.iter().map(number)).collect());
        }
        table
    }

    /// All files at once into the folder.
    pub(crate) fn write(&self, folder: &Path, sheet: Vec<u8>) -> Result<(), Failure> {
        let failed = |error| Failure::input(&self.title, &error);
        let knob = self.sweep.varied.iter().rev().find(|name| !self.sweep.grouped_by.contains(name)).or(self.sweep.varied.last());
        let over_knob = knob.map(|input| Panel::Knob { input: input.clone(), error: ERROR.into() });
        let over_costs = COSTS.map(|cost| Panel::Cost { cost: cost.into(), error: ERROR.into() });
        let panels: Vec<Panel> = over_knob.into_iter().chain(over_costs).collect();
        let svg = self.sweep.to_svg(&self.title, &panels).map_err(failed)?;
        let files = [
            ("sweep.csv", self.sweep.to_csv().map_err(failed)?.into_bytes()),
            ("sweep.json", format!("{:#}\n", self.to_json()?).into_bytes()),
            ("sweep.svg", svg.into_bytes()),
            ("sheet.png", sheet),
        ];
        write_files(folder, &files)
    }

    fn to_json(&self) -> Result<Value, Failure> {
        let mut json = self.about.clone();
        let mut table = self.sweep.to_json().map_err(|error| Failure::input(&self.title, &error))?;
        if let Some(rows) = table["rows"].as_array_mut() {
            for (row, profile) in rows.iter_mut().zip(&self.profiles) {
                row["alpha_profile"] = profile.clone();
            }
        }
        if let (Some(json), Value::Object(table)) = (json.as_object_mut(), table) {
            json.extend(table);
        }
        Ok(json)
    }
}

/// What was measured, on what.
fn about(description: &Description, plan: &Plan, measured: &Measured, rounds: u32) -> Value {
    let mut about = json!({
        "pelage": env!("CARGO_PKG_VERSION"), "title": description.title, "graph": description.graph.display().to_string(),
        "output": plan.output, "against": plan.against, "finest": description.finest, "each": description.each, "set": description.set,
        "cases": description.cases,
        "rounds": rounds, "fingerprint": measured.fingerprint,
    });
    if let Some(one) = measured.settings.first() {
        let report = one.contender.report();
        let adapter = &report.adapter;
        about["adapter"] = json!({ "name": adapter.name, "backend": adapter.backend, "software": adapter.software });
        (about["width"], about["height"]) = (report.size.0.into(), report.size.1.into());
    }
    about
}
