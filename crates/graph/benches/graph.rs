//! Parsing, checking and running a layered graph: `cargo bench -p pelage-graph`.

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use divan::{Bencher, black_box};
use pelage_graph::{Context, Evaluate, Evaluator, Graph, Node, NodeError, Registry, Request};

fn main() {
    wide();
    println!();
    divan::main();
}

/// Works for a while, and says what came of it.
#[derive(Node)]
#[node(category = "Numbers")]
#[output(value: f64, "What came of it.")]
struct Work {
    /// Where it begins.
    #[param(default = 0, unit = "seed")]
    seed: u64,
}

impl Evaluate for Work {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(work(self.seed).into())
    }
}

/// Some tenths of a millisecond of arithmetic that nothing can be left out of.
fn work(seed: u64) -> f64 {
    (0..100_000).fold(seed as f64, |x, _| black_box(x * 0.999 + 1.0))
}

const WIDE: usize = 200;

/// Nodes that do not wait for each other, beside the same work on as many plain threads: what is left over is the engine's.
fn wide() {
    let nodes: Vec<String> = (0..WIDE).map(|index| format!("\"n{index}\": Work(seed: {index})")).collect();
    let registry = Registry::new().node::<Work>();
    let text = format!("Graph(version: 1, nodes: {{\n{}\n}})", nodes.join(",\n"));
    let Ok(Ok(graph)) = Graph::parse(&text).map(|graph| graph.check(&registry)) else { return };
    let request = (0..WIDE).fold(Request::default(), |request, index| request.and_output(&format!("n{index}.value")));
    println!("{WIDE} nodes that do not wait for each other, beside the same work on plain threads (least of 9, ms)");
    for threads in [1, 2] {
        let (mut run, mut floor) = (Duration::MAX, Duration::MAX);
        for _ in 0..9 {
            run = run.min(time(|| Evaluator::new(0).threads(threads).run(&graph, &request).is_ok()));
            floor = floor.min(time(|| on_plain_threads(threads)));
        }
        let [run, floor] = [run, floor].map(|time| time.as_secs_f64() * 1e3);
        println!(
            "  {threads} threads: {run:6.2}, floor {floor:6.2}, ratio {:.3}, {:.1} µs a node over it",
            run / floor,
            (run - floor) * 1e3 / WIDE as f64
        );
    }
}

fn on_plain_threads(threads: usize) {
    std::thread::scope(|scope| {
        for thread in 0..threads {
            scope.spawn(move || (thread..WIDE).step_by(threads).map(|seed| work(seed as u64)).sum::<f64>());
        }
    });
}

fn time<T>(work: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    black_box(work());
    start.elapsed()
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

/// One parameter changed in a file of so many nodes, and saved: every other byte is kept.
#[divan::bench(args = SIZES)]
fn set_and_save(bencher: Bencher<'_, '_>, nodes: usize) {
    let registry = Registry::new().node::<Add>();
    let graph = Graph::parse(&text(nodes));
    bencher.with_inputs(|| graph.clone()).bench_values(|graph| {
        graph.ok().and_then(|mut graph| {
            graph.set(&registry, "n3.c", "7.25", Path::new(".")).ok()?;
            Some(graph.to_ron())
        })
    });
}
