//! `pelage nodes`.

use clap::Args;
use pelage_graph::{Registry, Specification, node_markdown, reference_markdown};

use crate::failure::Failure;
use crate::output::print;

#[derive(Args)]
pub(crate) struct Nodes {
    /// One node in full; a line for each without.
    #[arg(value_name = "NODE")]
    node: Option<String>,
    /// As JSON.
    #[arg(long)]
    json: bool,
    /// In full, as the page of the book.
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
}

impl Nodes {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let registry = pelage_nodes::registry();
        match &self.node {
            Some(kind) => self.one(&registry, kind),
            None => self.all(&registry),
        }
    }

    fn all(&self, registry: &Registry) -> Result<(), Failure> {
        let all: Vec<&Specification> = registry.specifications().collect();
        if self.json {
            print(&json(&all)?)
        } else if self.markdown {
            print(&reference_markdown(registry))
        } else {
            let lines = all.iter().map(|s| format!("{:<16}{:<10}{}\n", s.kind, s.category, s.doc.lines().next().unwrap_or_default()));
            print(&lines.collect::<String>())
        }
    }

    fn one(&self, registry: &Registry, kind: &str) -> Result<(), Failure> {
        let Some(specification) = registry.specification(kind) else {
            let known: Vec<&str> = registry.specifications().map(|s| s.kind.as_str()).collect();
            return Err(Failure::Input(format!("there is no node {kind}; there are {}", known.join(", "))));
        };
        print(&if self.json { json(specification)? } else { node_markdown(specification) })
    }
}

fn json(value: &impl serde::Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Failure::input("the node reference", &error))?;
    Ok(text + "\n")
}
