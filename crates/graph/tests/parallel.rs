//! Branches side by side: they meet, they give the same as one after another, they wait for nobody who waits for them.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

mod fixture;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;

use fixture::{checked, counting, ran};
use pelage_graph::{
    CancelToken, CheckedGraph, Context, Evaluate, EvaluateError, Evaluation, Evaluator, Graph, Node, NodeError, NodeId, Observer, Registry,
    Request, TraceEntry,
};
use proptest::prelude::*;
use rayon::prelude::*;

/// A place where nodes wait until enough are there. Only a test that fails comes near the time.
#[derive(Default)]
struct Meeting(Mutex<usize>, Condvar);

impl Meeting {
    fn of(&self, count: usize) -> Result<(), NodeError> {
        let mut there = self.0.lock().unwrap();
        *there += 1;
        self.1.notify_all();
        let (there, _) = self.1.wait_timeout_while(there, Duration::from_secs(60), |there| *there < count).unwrap();
        if *there < count { Err("nobody came".into()) } else { Ok(()) }
    }
}

/// How many `Tracked` there are, and were at most.
#[derive(Default)]
struct Alive {
    now: AtomicUsize,
    most: AtomicUsize,
}

/// With how many came before.
struct Tracked(Arc<Alive>, usize);

impl Tracked {
    fn new(alive: &Arc<Alive>, before: usize) -> Self {
        alive.most.fetch_max(1 + alive.now.fetch_add(1, Ordering::SeqCst), Ordering::SeqCst);
        Self(Arc::clone(alive), before)
    }
}

impl Drop for Tracked {
    fn drop(&mut self) {
        self.0.now.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Waits for others of its kind.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: u64, "Its number.")]
struct Meet {
    /// Tells it from others.
    #[param(default = 0, unit = "seed", effect = "none")]
    number: u64,
    /// For how many it waits.
    #[param(default = 2, range = 1..=8, unit = "nodes", effect = "none")]
    count: u32,
}

impl Evaluate for Meet {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        cx.resource::<Meeting>()?.of(self.count as usize)?;
        Ok(self.number.into())
    }
}

/// Waits to be cancelled, as a long computation that looks now and then.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: u64, "Its number.")]
struct Patient {
    /// Tells it from others.
    #[param(default = 0, unit = "seed", effect = "none")]
    number: u64,
}

impl Evaluate for Patient {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        cx.resource::<Meeting>()?.of(2)?;
        for _ in 0..100_000_000_u64 {
            cx.stop_if_cancelled()?;
            std::thread::yield_now();
        }
        Err(format!("nobody cancelled {}", self.number).into())
    }
}

/// Cancels the run, once another node runs.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: u64, "Its number.")]
struct Cancel {}

impl Evaluate for Cancel {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        cx.resource::<Meeting>()?.of(2)?;
        cx.resource::<CancelToken>()?.cancel();
        Ok(0.into())
    }
}

/// Adds up numbers with rayon, holding a lock that all nodes share.
#[derive(Node)]
#[node(category = "Test")]
#[output(sum: u64, "The sum.")]
struct Locked {
    /// Numbers to begin with.
    #[input]
    parts: Vec<Arc<u64>>,
    /// Tells it from others.
    #[param(default = 0, unit = "seed", effect = "none")]
    number: u64,
    /// Whether it fails.
    #[param(default = false)]
    fails: bool,
}

impl Evaluate for Locked {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let lock = cx.resource::<Mutex<()>>()?;
        let held = lock.lock().unwrap();
        let sum = (0..200_u32).into_par_iter().with_max_len(1).map(|n| u64::from(n) * self.number % 7).sum::<u64>();
        drop(held);
        if self.fails {
            Err(format!("{} fails", self.number).into())
        } else {
            Ok((self.parts.iter().map(|part| **part).sum::<u64>() + sum).into())
        }
    }
}

/// Passes on something that says how much of its kind there is.
#[derive(Node)]
#[node(category = "Test")]
#[output(tracked: Tracked, "The thing.")]
struct Track {
    /// What comes before.
    #[input]
    before: Option<Arc<Tracked>>,
}

impl Evaluate for Track {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let before = self.before.as_ref().map_or(0, |before| before.1 + 1);
        Ok(Tracked::new(&cx.resource::<Alive>()?, before).into())
    }
}

fn graph(text: &str) -> CheckedGraph {
    let registry = Registry::new()
        .value::<Tracked>("Tracked", |_| 1000)
        .node::<Meet>()
        .node::<Patient>()
        .node::<Cancel>()
        .node::<Locked>()
        .node::<Track>();
    registry.validate().unwrap();
    Graph::parse(text).unwrap().check(&registry).unwrap()
}

fn evaluator(budget: usize, threads: usize) -> Evaluator {
    Evaluator::new(budget)
        .threads(threads)
        .resource(|| Ok::<_, NodeError>(Meeting::default()))
        .resource(|| Ok::<_, NodeError>(Mutex::new(())))
        .resource(|| Ok::<_, NodeError>(Alive::default()))
        .resource(|| Ok::<_, NodeError>(CancelToken::new()))
}

#[test]
fn independent_branches_run_at_the_same_time() {
    let graph = graph(
        r#"Graph(version: 1, nodes: {"a": Meet(number: 1), "b": Meet(number: 2), "sum": Locked(parts: ["a.value", "b.value"])}, output: "sum.sum")"#,
    );
    assert_eq!(*evaluator(0, 2).run(&graph, &Request::main()).unwrap().main::<u64>().unwrap(), 3);
}

#[test]
fn cancelling_stops_every_branch() {
    let graph = graph(
        r#"Graph(version: 1, nodes: {"a": Patient(number: 1), "b": Cancel(), "c": Locked(parts: ["b.value"]), "sum": Locked(parts: ["a.value", "c.sum"])}, output: "sum.sum")"#,
    );
    let mut evaluator = evaluator(0, 2);
    let token = evaluator.resources().get::<CancelToken>().unwrap();
    let error = evaluator.run(&graph, &Request::main().with_cancel((*token).clone())).unwrap_err();
    assert!(matches!(error, EvaluateError::Cancelled), "{error}");
}

/// A layered graph of nodes that hold a lock while they use rayon; every fifth fails if they are to.
fn layers(fails: bool) -> CheckedGraph {
    let node = |n: usize| {
        let parts: Vec<String> = [n / 2, n / 3].into_iter().filter(|&part| part < n).map(|part| format!("\"n{part}.sum\"")).collect();
        let fails = if fails && n > 20 && n.is_multiple_of(5) { ", fails: true" } else { "" };
        format!("\"n{n}\": Locked(parts: [{}], number: {n}{fails})", parts.join(", "))
    };
    let nodes: Vec<String> = (0..60).map(node).collect();
    let all: Vec<String> = (0..60).map(|n| format!("\"n{n}.sum\"")).collect();
    graph(&format!(
        "Graph(version: 1, nodes: {{{}, \"all\": Locked(parts: [{}])}}, output: \"all.sum\")",
        nodes.join(",\n"),
        all.join(", ")
    ))
}

#[test]
fn nodes_that_use_rayon_under_a_shared_lock_do_not_wait_for_each_other() {
    let graph = layers(false);
    let sum = |threads| *evaluator(0, threads).run(&graph, &Request::main()).unwrap().main::<u64>().unwrap();
    let expected = sum(1);
    assert_eq!([sum(2), sum(8)], [expected; 2]);
    // And from within rayon, where every worker runs a graph.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    assert!(pool.install(|| (0..16_u32).into_par_iter().with_max_len(1).all(|_| sum(8) == expected)));
}

#[test]
fn a_failing_run_fails_with_all_that_fails_for_any_number_of_threads() {
    let graph = layers(true);
    let error = |threads| {
        let error = evaluator(1 << 20, threads).run(&graph, &Request::main()).unwrap_err();
        let EvaluateError::Nodes(failures) = &error else { panic!("{error}") };
        assert!(failures.iter().all(|failure| failure.source.to_string().ends_with("fails")));
        error.to_string()
    };
    let one = error(1);
    // 25, 30, 35 and so on to 55, none of which draws on another: 50 draws on 25, and so is not reached.
    let nodes: Vec<&str> = one.lines().map(|line| line.split('"').nth(1).unwrap()).collect();
    assert_eq!(nodes, ["n25", "n30", "n35", "n40", "n45", "n55"]);
    for _ in 0..10 {
        assert_eq!((error(2), error(8)), (one.clone(), one.clone()));
    }
}

#[test]
fn equal_nodes_run_once_also_side_by_side() {
    let nodes: Vec<String> = (0..40).map(|n| format!("\"a{n}\": Constant(value: 2), \"b{n}\": Add(a: \"a{n}.value\", times: 3)")).collect();
    let ask = (0..40).fold(Request::default(), |request, n| request.and_output(&format!("b{n}.sum")));
    let mut evaluator = counting(1 << 20).threads(8);
    evaluator.run(&checked(&format!("Graph(version: 1, nodes: {{{}}})", nodes.join(", "))), &ask).unwrap();
    assert_eq!(ran(&evaluator), ["a0", "b0"]);
}

#[test]
fn a_value_nobody_needs_any_more_is_dropped() {
    let nodes: Vec<String> = (1..50).map(|n| format!("\"n{n}\": Track(before: \"n{}.tracked\")", n - 1)).collect();
    let graph = graph(&format!("Graph(version: 1, nodes: {{\"n0\": Track(), {}}}, output: \"n49.tracked\")", nodes.join(", ")));
    let most = |budget: usize, request: Request| {
        let mut evaluator = evaluator(budget, 2);
        let evaluation = evaluator.run(&graph, &request).unwrap();
        assert_eq!(evaluation.main::<Tracked>().unwrap().1, 49);
        let alive = evaluator.resources().get::<Alive>().unwrap();
        (alive.most.load(Ordering::SeqCst), alive.now.load(Ordering::SeqCst), evaluation.values().count())
    };
    assert_eq!(most(0, Request::main()), (2, 1, 1), "a node's input and its output");
    let (most_cached, kept, _) = most(5000, Request::main());
    assert!(most_cached <= 7 && kept == 5, "the cache and what is needed: {most_cached}, {kept}");
    assert_eq!(most(0, Request::main().with_all_values()), (50, 50, 50));
}

/// Notes how many nodes are done at each beginning, and how many end.
#[derive(Default)]
struct Counts {
    begun: Mutex<Vec<(usize, usize)>>,
    ended: AtomicUsize,
}

impl Observer for Counts {
    fn started(&self, _: &NodeId, done: usize, total: usize) {
        assert!(self.ended.load(Ordering::SeqCst) == done, "what it is told agrees");
        self.begun.lock().unwrap().push((done, total));
    }
    fn finished(&self, _: &TraceEntry) {
        self.ended.fetch_add(1, Ordering::SeqCst);
    }
}

#[test]
fn progress_never_falls() {
    let graph = layers(false);
    for threads in [1, 2, 8] {
        let counts = Arc::new(Counts::default());
        evaluator(0, threads).run(&graph, &Request::main().with_observer(counts.clone())).unwrap();
        let begun = counts.begun.lock().unwrap();
        assert!(begun.windows(2).all(|pair| pair[0].0 <= pair[1].0) && begun.iter().all(|&(_, total)| total == 61), "{begun:?}");
        assert_eq!((begun.len(), counts.ended.load(Ordering::SeqCst)), (61, 61));
    }
}

/// All that a run says but its times.
fn said(evaluation: &Evaluation) -> Vec<TraceEntry> {
    evaluation.trace().iter().map(|entry| TraceEntry { ms: 0.0, ..entry.clone() }).collect()
}

/// Graphs without faults, of numbers and of blocks, each drawn from earlier ones.
fn sound_graph() -> impl Strategy<Value = String> {
    prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 1_u32..4, 0_u32..1500), 1..40).prop_map(|nodes| {
        let mut text = "Graph(version: 1, nodes: {\"n0\": Constant(value: 1),\n".to_owned();
        for (index, (a, b, times, length)) in nodes.iter().enumerate() {
            let name = |to: usize| if to == 0 { "n0.value".to_owned() } else { format!("n{to}.sum") };
            let (a, b) = (name(a.index(index + 1)), name(b.index(index + 1)));
            text += &format!("\"n{}\": Add(a: \"{a}\", b: \"{b}\", times: {times}),\n\"f{index}\": Fill(length: {length}),\n", index + 1);
        }
        text + "})"
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]
    /// Values, keys, states and what is left in a small cache, of two runs one after the other.
    #[test]
    fn one_two_and_eight_threads_give_the_same(text in sound_graph(), budget in 0_usize..6000) {
        let graph = checked(&text);
        let outputs: Vec<String> = graph.outputs().map(|(name, _)| name).collect();
        let all = outputs.iter().fold(Request::default(), |request, output| request.and_output(output));
        let half = outputs.iter().step_by(2).fold(Request::default(), |request, output| request.and_output(output));
        let run = |threads: usize| {
            let mut evaluator = Evaluator::new(budget).threads(threads);
            let first = evaluator.run(&graph, &half).unwrap();
            let second = evaluator.run(&graph, &all).unwrap();
            let numbers: Vec<Option<u64>> = second.values().map(|(_, _, value)| value.downcast_ref::<f64>().map(|v| v.to_bits())).collect();
            (said(&first), said(&second), numbers, evaluator.cache())
        };
        let one = run(1);
        prop_assert_eq!(&run(2), &one);
        prop_assert_eq!(&run(8), &one);
    }
}
