//! `pelage nodes`.

use clap::Args;
use pelage_graph::{node_markdown, reference_markdown};

use crate::failure::Failure;
use crate::output::print;

#[derive(Args)]
pub(crate) struct Nodes {
    /// One node; all of them without.
    #[arg(value_name = "NODE")]
    node: Option<String>,
    /// As JSON.
    #[arg(long)]
    json: bool,
}

impl Nodes {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let registry = pelage_nodes::registry();
        let Some(kind) = &self.node else {
            let all: Vec<_> = registry.specifications().collect();
            return print(&if self.json { json(&all)? } else { reference_markdown(&registry) });
        };
        let Some(specification) = registry.specification(kind) else {
            let known: Vec<&str> = registry.specifications().map(|s| s.kind.as_ref()).collect();
            return Err(Failure::Input(format!("there is no node {kind}; there are {}", known.join(", "))));
        };
        print(&if self.json { json(specification)? } else { node_markdown(specification) })
    }
}

fn json(value: &impl serde::Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Failure::input("the node reference", &error))?;
    Ok(text + "\n")
}
