//! A registry of three nodes, a graph in a string, two runs: `cargo run -p pelage-graph --example arithmetic`.
#![allow(clippy::print_stdout, reason = "an example shows what it does")]

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use pelage_graph::{Context, Evaluate, Evaluator, Graph, Node, NodeError, Param, Registry, Request, node_markdown};

/// Numbers in equal steps.
#[derive(Node)]
#[node(category = "Lists")]
#[output(list: Vec<f64>, "The numbers, in order.")]
pub struct Steps {
    /// The first number.
    #[param(default = 0.0, range = -1e9..=1e9, unit = "1", effect = "moves all numbers")]
    from: f64,
    /// The last number.
    #[param(default = 1.0, range = -1e9..=1e9, unit = "1", effect = "widens the steps")]
    to: f64,
    /// How many numbers.
    #[param(default = 11, range = 2..=1_000_000, unit = "numbers", effect = "time and memory go with it")]
    count: u32,
}

impl Evaluate for Steps {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let step = (self.to - self.from) / f64::from(self.count - 1);
        Ok((0..self.count).map(|index| self.from + step * f64::from(index)).collect::<Vec<_>>().into())
    }
}

/// A function of one number.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum Function {
    /// The number itself.
    Identity,
    /// A sine.
    Sine {
        /// Periods from 0 to 1.
        #[param(default = 1.0, range = 0.0..=100.0, unit = "periods", effect = "finer waves")]
        periods: f64,
    },
}

/// Applies a function to each number.
#[derive(Node)]
#[node(category = "Lists")]
#[output(list: Vec<f64>, "One result for each number.")]
pub struct Map {
    /// Numbers to apply it to.
    #[input]
    list: Arc<Vec<f64>>,
    /// What to apply.
    #[param(default = Function::Identity)]
    function: Function,
}

impl Evaluate for Map {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let apply = |&x: &f64| match self.function {
            Function::Identity => x,
            Function::Sine { periods } => (std::f64::consts::TAU * periods * x).sin(),
        };
        Ok(self.list.iter().map(apply).collect::<Vec<_>>().into())
    }
}

/// Sum and greatest of some numbers.
#[derive(Node)]
#[node(category = "Numbers")]
#[output(sum: f64, "The sum.")]
#[output(greatest: f64, "The greatest; there must be one.")]
pub struct Summary {
    /// Numbers to sum up.
    #[input]
    list: Arc<Vec<f64>>,
}

impl Evaluate for Summary {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let greatest = || self.list.iter().copied().reduce(f64::max).ok_or("an empty list has no greatest number");
        Ok(SummaryOutputs {
            sum: Some(Arc::new(self.list.iter().sum())),
            greatest: if cx.wants("greatest") { Some(Arc::new(greatest()?)) } else { None },
        })
    }
}

const FILE: &str = r#"
Graph(
    version: 1,
    nodes: {
        "x": Steps(count: 101),
        "wave": Map(list: "x.list", function: Sine(periods: 2)),
        "result": Summary(list: "wave.list"),
        "aside": Summary(list: "x.list"),
    },
    output: "result.greatest",
)
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let registry = Registry::new()
        .value::<Vec<f64>>("List", |list| list.capacity() * size_of::<f64>())
        .node::<Steps>()
        .node::<Map>()
        .node::<Summary>();
    registry.validate()?;
    let mut graph = Graph::parse(FILE)?;
    let mut evaluator = Evaluator::new(1 << 20);
    for setting in [None, Some(("wave.function.periods", "3"))] {
        if let Some((target, value)) = setting {
            graph.set(&registry, target, value, Path::new("."))?;
            println!("after {target}={value}:");
        }
        let evaluation = evaluator.run(&graph.check(&registry)?, &Request::main())?;
        println!("greatest: {}", evaluation.main::<f64>()?);
        for entry in evaluation.trace() {
            println!("  {:8} {:8} {:?}, {} bytes", entry.node.as_str(), entry.kind, entry.state, entry.bytes);
        }
    }
    println!("\n{}", graph.to_ron());
    if let Some(specification) = registry.specification("Map") {
        println!("{}", node_markdown(specification));
    }
    Ok(())
}
