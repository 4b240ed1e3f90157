//! What is said of a search.

use super::Cost;
use super::trial::{Bench, Worth};
use crate::measure::plan::Plan;

/// What was tried, for a person.
pub(super) struct Report<'a> {
    plan: &'a Plan,
    cost: Cost,
    bench: &'a Bench<'a>,
}

impl<'a> Report<'a> {
    pub(super) fn new(plan: &'a Plan, cost: Cost, bench: &'a Bench<'a>) -> Self {
        Self { plan, cost, bench }
    }

    /// The table in Markdown, the graph as it is and then in the order in which settings were tried, and what was chosen; `own` is what that is worth at its own size, if it was tried at
    /// another, and what the graph as it is is worth there.
    pub(super) fn to_text(&self, chosen: usize, settled: bool, own: Option<(&Worth, &Worth)>) -> String {
        let heads = ["fragments", "texture_bytes", "ms", "flip_mean", "flip_p99", "chosen"].map(String::from);
        let heads: Vec<String> = self.plan.varied.iter().cloned().chain(heads).collect();
        let mut text = line(&heads) + &format!("|{}\n", "---|".repeat(heads.len()));
        let blank = std::iter::repeat_n(String::new(), self.plan.varied.len().saturating_sub(1));
        text += &line(&row(std::iter::once("as it is".to_owned()).chain(blank), self.bench.as_it_is(), ""));
        for one in self.bench.tried() {
            let mark = if one.number == chosen { "yes" } else { "" };
            text += &line(&row(self.plan.settings[one.number].values.iter().cloned(), &one.worth, mark));
        }
        if let Some(one) = self.bench.tried().iter().find(|one| one.number == chosen) {
            let values = &self.plan.settings[chosen].values;
            text += &format!("\n{}: {}; {}\n", self.named(values), self.beside(&one.worth, self.bench.as_it_is()), self.evaluated());
        }
        if let Some((chosen, start)) = own {
            text += &format!("At its own size: {}\n", self.beside(chosen, start));
        }
        if !settled {
            text += "There may be better: the search was cut short; allow more --evaluations.\n";
        }
        text
    }

    /// What the chosen is worth, and the graph as it is.
    fn beside(&self, chosen: &Worth, start: &Worth) -> String {
        let of = |worth: &Worth| {
            let cost = worth.cost(self.cost).map(|cost| format!(", {} {}", self.cost_text(cost), self.unit())).unwrap_or_default();
            format!("FLIP {:.5}{cost}", worth.flip_mean)
        };
        format!("{} (as it is: {})", of(chosen), of(start))
    }

    /// A cost with its digits.
    pub(super) fn cost_text(&self, cost: f64) -> String {
        if self.cost == Cost::Ms { format!("{cost:.3}") } else { format!("{cost:.0}") }
    }

    pub(super) fn unit(&self) -> &'static str {
        match self.cost {
            Cost::Ms => "ms",
            Cost::Fragments => "fragments",
            Cost::Bytes => "bytes",
        }
    }

    pub(super) fn evaluated(&self) -> String {
        format!("{} of {} settings evaluated", self.bench.tried().len(), self.plan.settings.len())
    }

    /// `shells.layers=8, picture.fins=true`.
    pub(super) fn named(&self, values: &[String]) -> String {
        let pairs = self.plan.varied.iter().zip(values).map(|(input, value)| format!("{input}={value}"));
        pairs.collect::<Vec<_>>().join(", ")
    }
}

/// The cells of a row.
fn row(values: impl Iterator<Item = String>, worth: &Worth, mark: &str) -> Vec<String> {
    let fragments = worth.fragments.map(|fragments| fragments.to_string()).unwrap_or_default();
    let ms = worth.ms.map(|ms| format!("{ms:.3}")).unwrap_or_default();
    let numbers = [fragments, worth.bytes.to_string(), ms, format!("{:.5}", worth.flip_mean), format!("{:.5}", worth.flip_p99)];
    values.chain(numbers).chain([mark.to_owned()]).collect()
}

fn line(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}
