//! Parsing, checking and running a layered graph: `cargo bench -p pelage-graph`.

use std::sync::Arc;

use divan::{Bencher, black_box};
use pelage_graph::{Context, Evaluate, Evaluator, Graph, Node, NodeError, Registry, Request};

fn main() {
    divan::main();
}

/// Adds two numbers, or begins with one.
#[derive(Node)]
#[node(category = "Numbers")]
#[output(sum: f64, "The sum.")]
struct Add {
    /// One number.
    #[input]
    a: Option<Arc<f64>>,
    /// Another number.
    #[input]
    b: Option<Arc<f64>>,
    /// A third number.
    #[param(default = 0.0, range = -1e6..=1e6, unit = "1", effect = "is added")]
    c: f64,
}

impl Evaluate for Add {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok((self.a.as_deref().unwrap_or(&0.0) + self.b.as_deref().unwrap_or(&0.0) + self.c).into())
    }
}

/// Each node draws on the one before it and on one halfway back.
fn text(nodes: usize) -> String {
    let node = |index: usize| match index {
        0 => "\"n0\": Add(c: 1.0)".to_owned(),
        _ => format!("\"n{index}\": Add(a: \"n{}.sum\", b: \"n{}.sum\", c: {index}.5)", index - 1, index / 2),
    };
    let nodes: Vec<String> = (0..nodes).map(node).collect();
    format!("Graph(version: 1, nodes: {{\n{}\n}}, output: \"n{}.sum\")", nodes.join(",\n"), nodes.len() - 1)
}

const SIZES: [usize; 4] = [20, 200, 2_000, 20_000];

#[divan::bench(args = SIZES)]
fn parse(bencher: Bencher<'_, '_>, nodes: usize) {
    let text = text(nodes);
    bencher.bench(|| Graph::parse(black_box(&text)));
}

#[divan::bench(args = SIZES)]
fn check(bencher: Bencher<'_, '_>, nodes: usize) {
    let registry = Registry::new().node::<Add>();
    let graph = Graph::parse(&text(nodes));
    bencher.bench(|| graph.as_ref().map(|graph| graph.check(&registry).is_ok()).ok());
}

#[divan::bench(args = SIZES)]
fn run_cold(bencher: Bencher<'_, '_>, nodes: usize) {
    let registry = Registry::new().node::<Add>();
    let Ok(Ok(graph)) = Graph::parse(&text(nodes)).map(|graph| graph.check(&registry)) else { return };
    bencher.bench(|| Evaluator::new(1 << 30).run(&graph, &Request::main()));
}

#[divan::bench(args = SIZES)]
fn run_all_hits(bencher: Bencher<'_, '_>, nodes: usize) {
    let registry = Registry::new().node::<Add>();
    let Ok(Ok(graph)) = Graph::parse(&text(nodes)).map(|graph| graph.check(&registry)) else { return };
    let mut evaluator = Evaluator::new(1 << 30);
    let _ = evaluator.run(&graph, &Request::main());
    bencher.bench_local(|| evaluator.run(&graph, &Request::main()).is_ok());
}

#[divan::bench(args = SIZES)]
fn save(bencher: Bencher<'_, '_>, nodes: usize) {
    let graph = Graph::parse(&text(nodes));
    bencher.bench(|| graph.as_ref().map(Graph::to_ron).ok());
}
