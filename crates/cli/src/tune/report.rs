//! What is said of a search.

use super::Cost;
use super::trial::Tried;
use crate::measure::plan::Plan;

/// What was tried, for a person.
pub(super) struct Report<'a> {
    plan: &'a Plan,
    cost: Cost,
    tried: &'a [Tried],
}

impl<'a> Report<'a> {
    pub(super) fn new(plan: &'a Plan, cost: Cost, tried: &'a [Tried]) -> Self {
        Self { plan, cost, tried }
    }

    /// The table in Markdown, in the order in which settings were tried, and what was chosen.
    pub(super) fn to_text(&self, chosen: usize, settled: bool) -> String {
        let heads = ["fragments", "texture_bytes", "ms", "flip_mean", "flip_p99", "chosen"].map(String::from);
        let heads: Vec<String> = self.plan.varied.iter().cloned().chain(heads).collect();
        let mut text = line(&heads) + &format!("|{}\n", "---|".repeat(heads.len()));
        for one in self.tried {
            text += &line(&self.row(one, one.number == chosen));
        }
        if let Some(one) = self.tried.iter().find(|one| one.number == chosen) {
            let cost = self.cost_of(one).map(|cost| format!("{} {}", self.cost_text(cost), self.unit())).unwrap_or_default();
            let values = &self.plan.settings[chosen].values;
            text += &format!("\n{}: FLIP {:.5}, {cost}; {}\n", self.named(values), one.flip_mean, self.evaluated());
        }
        if !settled {
            text += "There may be better: the search was cut short; allow more --evaluations.\n";
        }
        text
    }

    fn row(&self, one: &Tried, chosen: bool) -> Vec<String> {
        let fragments = one.fragments.map(|fragments| fragments.to_string()).unwrap_or_default();
        let ms = one.ms.map(|ms| format!("{ms:.3}")).unwrap_or_default();
        let numbers = [fragments, one.bytes.to_string(), ms, format!("{:.5}", one.flip_mean), format!("{:.5}", one.flip_p99)];
        let mark = if chosen { "yes" } else { "" }.to_owned();
        self.plan.settings[one.number].values.iter().cloned().chain(numbers).chain([mark]).collect()
    }

    fn cost_of(&self, one: &Tried) -> Option<f64> {
        match self.cost {
            Cost::Ms => one.ms,
            Cost::Fragments => one.fragments.map(|fragments| fragments as f64),
            Cost::Bytes => Some(one.bytes as f64),
        }
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
        format!("{} of {} settings evaluated", self.tried.len(), self.plan.settings.len())
    }

    /// `shells.layers=8, picture.fins=true`.
    pub(super) fn named(&self, values: &[String]) -> String {
        let pairs = self.plan.varied.iter().zip(values).map(|(input, value)| format!("{input}={value}"));
        pairs.collect::<Vec<_>>().join(", ")
    }
}

fn line(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}
