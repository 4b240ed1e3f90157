//! What runs, what does not, and what a key depends on.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

mod fixture;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use fixture::*;
use pelage_graph::{
    CancelToken, Evaluate, EvaluateError, Evaluation, Evaluator, Graph, Key, Literal, Node, NodeError, NodeId, Observer, Registry, Request,
    Resources, State, TraceEntry,
};

/// A diamond, and a node beside it.
const DIAMOND: &str = r#"Graph(version: 1, nodes: {
    "sum": Add(a: "left.sum", b: "right.sum"),
    "left": Add(a: "two.value", times: 3),
    "right": Add(a: "two.value", times: 5),
    "two": Constant(value: 2),
    "aside": Constant(value: 9),
}, output: "sum.sum")"#;

fn keys(evaluation: &Evaluation) -> BTreeMap<String, Vec<(String, Key)>> {
    evaluation.trace().iter().map(|entry| (entry.node.to_string(), entry.keys.clone())).collect()
}

fn states(evaluation: &Evaluation) -> Vec<(&str, State)> {
    evaluation.trace().iter().map(|entry| (entry.node.as_str(), entry.state)).collect()
}

#[test]
fn what_nobody_asks_for_does_not_run() {
    let mut evaluator = counting(1 << 20);
    let evaluation = evaluator.run(&checked(DIAMOND), &Request::main()).unwrap();
    assert_eq!(*evaluation.main::<f64>().unwrap(), 16.0);
    assert_eq!(ran(&evaluator), ["two", "left", "right", "sum"]);
    use State::{Computed, NotNeeded};
    let expected = [("sum", Computed), ("left", Computed), ("right", Computed), ("two", Computed), ("aside", NotNeeded)];
    assert_eq!(states(&evaluation), expected);
    assert!(matches!(evaluation.get::<f64>("aside.value"), Err(EvaluateError::NotKept { .. })));
}

#[test]
fn a_second_run_is_all_hits() {
    let mut evaluator = counting(1 << 20);
    let first = evaluator.run(&checked(DIAMOND), &Request::main()).unwrap();
    ran(&evaluator);
    let second = evaluator.run(&checked(DIAMOND), &Request::main().with_all_values()).unwrap();
    assert!(ran(&evaluator).is_empty());
    assert_eq!(keys(&first), keys(&second));
    let hits = second.trace().iter().filter(|entry| entry.state == State::Hit).count();
    assert_eq!((hits, second.trace().len()), (4, 5));
    assert_eq!(second.values().count(), 4, "the values are all there for statistics");
}

#[test]
fn renaming_moving_and_reordering_nodes_changes_no_key() {
    let mut evaluator = counting(1 << 20);
    let first = evaluator.run(&checked(DIAMOND), &Request::main()).unwrap();
    ran(&evaluator);
    let mut graph = Graph::parse(DIAMOND).unwrap();
    graph.rename(&registry(), "two", "zwei").unwrap();
    graph.rename(&registry(), "sum", "all").unwrap();
    graph.move_to("left", 400.0, 20.0).unwrap();
    graph.nodes.reverse();
    let second = evaluator.run(&graph.check(&registry()).unwrap(), &Request::main()).unwrap();
    assert_eq!(ran(&evaluator), Vec::<String>::new());
    let (first, second) = (keys(&first), keys(&second));
    assert_eq!((&first["two"], &first["sum"], &first["left"]), (&second["zwei"], &second["all"], &second["left"]));
}

#[test]
fn a_changed_parameter_recomputes_only_what_is_downstream() {
    let mut evaluator = counting(1 << 20);
    evaluator.run(&checked(DIAMOND), &Request::main()).unwrap();
    ran(&evaluator);
    let mut graph = Graph::parse(DIAMOND).unwrap();
    graph.set(&registry(), "left.times", "4", Path::new(".")).unwrap();
    let evaluation = evaluator.run(&graph.check(&registry()).unwrap(), &Request::main()).unwrap();
    assert_eq!(ran(&evaluator), ["left", "sum"]);
    assert_eq!(*evaluation.main::<f64>().unwrap(), 18.0);
}

#[test]
fn saying_a_default_changes_no_key() {
    let mut evaluator = counting(1 << 20);
    evaluator.run(&checked(DIAMOND), &Request::main()).unwrap();
    ran(&evaluator);
    let said = DIAMOND.replace("times: 3", "gain: 1, times: 3").replace("value: 2", "value: 2.0");
    evaluator.run(&checked(&said), &Request::main()).unwrap();
    assert!(ran(&evaluator).is_empty());
}

#[test]
fn equal_nodes_run_once() {
    // c runs before a, whose value equals that of b, which c draws on.
    let text = r#"Graph(version: 1, nodes: {
        "b": Constant(value: 2), "c": Add(a: "b.value", times: 2), "a": Constant(value: 2), "d": Add(a: "a.value"),
        "sum": Add(a: "c.sum", b: "d.sum"),
    }, output: "sum.sum")"#;
    let mut evaluator = counting(1 << 20);
    let evaluation = evaluator.run(&checked(text), &Request::main().with_all_values()).unwrap();
    assert_eq!(ran(&evaluator), ["b", "c", "d", "sum"]);
    assert_eq!(*evaluation.main::<f64>().unwrap(), 6.0);
    assert!(Arc::ptr_eq(&evaluation.get::<f64>("a.value").unwrap(), &evaluation.get::<f64>("b.value").unwrap()));
}

#[test]
fn the_bytes_of_a_file_are_in_the_key_and_its_folder_is_not() {
    let (one, two) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let text = r#"Graph(version: 1, nodes: {"read": ReadText(path: "a.txt")}, output: "read.text")"#;
    let graph = |directory: &Path| Graph::parse(text).unwrap().with_directory(directory).check(&registry()).unwrap();
    let mut evaluator = counting(1 << 20);
    let mut read = |directory: &Path| {
        let text = evaluator.run(&graph(directory), &Request::main()).unwrap().main::<String>().unwrap();
        (text.to_string(), ran(&evaluator).len())
    };
    std::fs::write(one.path().join("a.txt"), "first").unwrap();
    assert_eq!(read(one.path()), ("first".to_owned(), 1));
    assert_eq!(read(one.path()), ("first".to_owned(), 0));
    std::fs::write(one.path().join("a.txt"), "other").unwrap();
    assert_eq!(read(one.path()), ("other".to_owned(), 1));
    std::fs::write(two.path().join("a.txt"), "first").unwrap();
    assert_eq!(read(two.path()), ("first".to_owned(), 0));
}

#[test]
fn a_missing_file_is_the_fault_of_its_node() {
    let graph = checked(r#"Graph(version: 1, nodes: {"read": ReadText(path: "nowhere.txt")}, output: "read.text")"#);
    let error = Evaluator::new(0).run(&graph, &Request::main()).unwrap_err();
    assert!(error.to_string().starts_with("node \"read\" (ReadText): cannot read nowhere.txt: "), "{error}");
    assert_eq!(error.cause::<std::io::Error>().map(std::io::Error::kind), Some(std::io::ErrorKind::NotFound));
}

#[test]
fn requirements_travel_upstream() {
    let text = r#"Graph(version: 1, nodes: {
        "l": Constant(value: 2), "r": Constant(value: 4),
        "halves": Halves(left_from: "l.value", right_from: "r.value"),
    })"#;
    let mut evaluator = counting(1 << 20);
    let left = evaluator.run(&checked(text), &Request::output("halves.left")).unwrap();
    assert_eq!((*left.main::<f64>().unwrap(), ran(&evaluator)), (1.0, vec!["l".to_owned(), "halves".to_owned()]));
    // Who wants both later shares what was made for the one.
    let both = evaluator.run(&checked(text), &Request::output("halves.left").and_output("halves.right")).unwrap();
    assert_eq!((*both.get::<f64>("halves.right").unwrap(), ran(&evaluator)), (2.0, vec!["r".to_owned(), "halves".to_owned()]));
    // A parameter may say that an input is not needed; then it is not made, and has no part in the key.
    let one = text.replace("Halves(", "Halves(both: false, ");
    let right = evaluator.run(&checked(&one), &Request::output("halves.right")).unwrap();
    assert_eq!((*right.main::<f64>().unwrap(), ran(&evaluator)), (0.0, vec!["halves".to_owned()]));
    let unneeded = &right.trace()[1];
    assert_eq!((unneeded.node.as_str(), unneeded.state, unneeded.keys.len()), ("r", State::NotNeeded, 0));
    let changed = one.replace("value: 4", "value: 6");
    evaluator.run(&checked(&changed), &Request::output("halves.right")).unwrap();
    assert!(ran(&evaluator).is_empty());
}

/// Both outputs are made of the same, so that only their names tell them apart.
#[test]
fn outputs_made_of_the_same_are_told_apart() {
    /// Two numbers about one.
    #[derive(Node)]
    #[node(category = "Numbers")]
    #[output(below: f64, "One less.")]
    #[output(above: f64, "One more.")]
    struct Neighbours {
        /// The number.
        #[param(default = 5.0, range = -1000.0..=1000.0, unit = "1", effect = "moves both results")]
        of: f64,
    }
    impl Evaluate for Neighbours {
        fn evaluate(&self, cx: &mut pelage_graph::Context<'_>) -> Result<Self::Outputs, NodeError> {
            let made = |port: &str, value: f64| cx.wants(port).then(|| Arc::new(value));
            Ok(NeighboursOutputs { below: made("below", self.of - 1.0), above: made("above", self.of + 1.0) })
        }
    }
    let registry = Registry::new().node::<Neighbours>();
    let graph = Graph::parse(r#"Graph(version: 1, nodes: {"n": Neighbours()})"#).unwrap().check(&registry).unwrap();
    let mut evaluator = Evaluator::new(1 << 20);
    let mut value = |output: &str| *evaluator.run(&graph, &Request::output(output)).unwrap().main::<f64>().unwrap();
    assert_eq!((value("n.below"), value("n.above"), value("n.below")), (4.0, 6.0, 4.0));
}

#[test]
fn only_declared_context_is_in_the_key() {
    let text = r#"Graph(version: 1, nodes: {
        "now": Frame(), "still": Constant(value: 1), "sum": Styled(seed: "now.frame"),
        "fixed": Add(a: "still.value"),
    })"#;
    let mut evaluator = counting(1 << 20);
    let mut frame = |frame: i64| {
        let request = Request::output("sum.text").and_output("fixed.sum").and_output("now.frame").with_context("frame", frame);
        let evaluation = evaluator.run(&checked(text), &request).unwrap();
        (*evaluation.get::<i64>("now.frame").unwrap(), ran(&evaluator))
    };
    assert_eq!(frame(1).1.len(), 4);
    assert_eq!(frame(2), (2, vec!["now".to_owned(), "sum".to_owned()]));
    assert_eq!(frame(1), (1, vec![]));
    let error = evaluator.run(&checked(text), &Request::output("now.frame")).unwrap_err();
    assert_eq!(error.to_string(), "node \"now\" (Frame): the request gives no context value \"frame\"");
}

#[test]
fn a_context_value_is_made_only_if_a_needed_node_declares_it() {
    let made = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&made);
    let mut evaluator = Evaluator::new(1 << 20).context_value("frame", move |_: &Resources| {
        count.fetch_add(1, Ordering::Relaxed);
        Ok(Literal::from(41_i64))
    });
    let text = r#"Graph(version: 1, nodes: {"now": Frame(), "still": Constant(value: 1)})"#;
    evaluator.run(&checked(text), &Request::output("still.value")).unwrap();
    assert_eq!(made.load(Ordering::Relaxed), 0);
    for _ in 0..2 {
        let evaluation = evaluator.run(&checked(text), &Request::output("now.frame")).unwrap();
        assert_eq!((*evaluation.main::<i64>().unwrap(), made.load(Ordering::Relaxed)), (41, 1));
    }
}

#[test]
fn the_cache_keeps_within_its_bytes_and_forgets_the_oldest() {
    let nodes: Vec<String> = (0..10).map(|n| format!("\"b{n}\": Fill(length: 1000, byte: {n})")).collect();
    let graph = checked(&format!("Graph(version: 1, nodes: {{{}}})", nodes.join(", ")));
    let mut evaluator = counting(3500);
    let mut ask = |n: usize| {
        evaluator.run(&graph, &Request::output(&format!("b{n}.block"))).unwrap();
        let usage = evaluator.cache();
        assert!(usage.bytes <= usage.budget && usage.bytes == 1000 * usage.entries, "{usage:?}");
        ran(&evaluator).len()
    };
    assert_eq!((0..4).map(&mut ask).sum::<usize>(), 4);
    // 0 was forgotten for 3; asking for 1 makes 2 the oldest, which goes for 0.
    assert_eq!([ask(1), ask(0), ask(1), ask(3), ask(2)], [0, 1, 0, 0, 1]);
    let text = r#"Graph(version: 1, nodes: {"big": Fill(length: 4000)})"#;
    let evaluation = evaluator.run(&checked(text), &Request::output("big.block")).unwrap();
    assert_eq!(evaluation.values().next().unwrap().2.bytes(), 4000, "larger than the cache and still there for who asked");
    assert_eq!(evaluator.cache().entries, 3, "and it pushes nothing out");
}

#[test]
fn no_budget_is_no_hindrance() {
    let mut evaluator = counting(0);
    let evaluation = evaluator.run(&checked(DIAMOND), &Request::main()).unwrap();
    assert_eq!((*evaluation.main::<f64>().unwrap(), ran(&evaluator).len()), (16.0, 4));
}

#[test]
fn linked_parameters_convert_and_keep_their_range() {
    let linked = |value: &str, field: &str| {
        let text = format!(
            "Graph(version: 1, nodes: {{\"c\": Constant(value: {value}), \"f\": Frame(), \"x\": Add(a: \"c.value\", {field})}}, output: \"x.sum\")"
        );
        Evaluator::new(0).run(&checked(&text), &Request::main().with_context("frame", 3_i64)).map(|e| *e.main::<f64>().unwrap())
    };
    assert_eq!(linked("2", "gain: \"c.value\"").unwrap(), 4.0);
    assert_eq!(linked("2", "times: \"f.frame\"").unwrap(), 6.0);
    let error = linked("20", "gain: \"c.value\"").unwrap_err().to_string();
    assert_eq!(error, "node \"x\" (Add): parameter \"gain\": 20.0 is out of range: expected 0 to below 10 (1)");
}

#[test]
fn a_nodes_error_comes_back_whole_with_its_node() {
    let text = r#"Graph(version: 1, nodes: {"bad": Fail(), "x": Add(a: "bad.value"), "mute": Fail(silent: true)}, output: "x.sum")"#;
    let mut evaluator = counting(0);
    let error = evaluator.run(&checked(text), &Request::main()).unwrap_err();
    assert_eq!(error.to_string(), "node \"bad\" (Fail): no adapter");
    assert_eq!(error.cause::<NoAdapter>(), Some(&NoAdapter));
    assert!(error.cause::<std::fmt::Error>().is_none());
    assert!(ran(&evaluator).is_empty());
    let error = evaluator.run(&checked(text), &Request::output("mute.value")).unwrap_err();
    assert_eq!(error.to_string(), "node \"mute\" (Fail): the node made no \"value\", which is wanted");
}

#[test]
fn a_resource_is_made_once_when_asked_for_and_its_error_comes_back_whole() {
    /// A number from a resource.
    #[derive(Node)]
    #[node(category = "Numbers")]
    #[output(value: u64, "The number.")]
    struct Shared {
        /// Makes nodes differ.
        #[param(default = 0, unit = "seed", effect = "none")]
        seed: u64,
    }
    impl Evaluate for Shared {
        fn evaluate(&self, cx: &mut pelage_graph::Context<'_>) -> Result<Self::Outputs, NodeError> {
            Ok((*cx.resource::<u64>()? + self.seed).into())
        }
    }
    let registry = Registry::new().node::<Shared>();
    let graph = Graph::parse(r#"Graph(version: 1, nodes: {"a": Shared(), "b": Shared(seed: 1)})"#).unwrap().check(&registry).unwrap();
    let tries = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&tries);
    // Fails at first, as a device may that is not there yet.
    let mut evaluator = Evaluator::new(0).resource(move || match count.fetch_add(1, Ordering::Relaxed) {
        0 => Err(NoAdapter),
        _ => Ok(7_u64),
    });
    assert_eq!(tries.load(Ordering::Relaxed), 0);
    let request = Request::output("a.value").and_output("b.value");
    assert_eq!(evaluator.run(&graph, &request).unwrap_err().cause::<NoAdapter>(), Some(&NoAdapter));
    let evaluation = evaluator.run(&graph, &request).unwrap();
    assert_eq!((*evaluation.get::<u64>("b.value").unwrap(), tries.load(Ordering::Relaxed)), (8, 2));
    let error = Evaluator::new(0).run(&graph, &request).unwrap_err().to_string();
    assert_eq!(error, "node \"a\" (Shared): this program provides no u64\nnode \"b\" (Shared): this program provides no u64");
}

#[test]
fn outputs_that_are_not_there_are_answered_with_the_nearest() {
    let error = Evaluator::new(0).run(&checked(DIAMOND), &Request::output("sum.smu")).unwrap_err();
    assert_eq!(error.to_string(), "there is no output \"sum.smu\"; did you mean sum.sum?");
    let graph = checked("Graph(version: 1, nodes: {})");
    assert!(matches!(Evaluator::new(0).run(&graph, &Request::main()), Err(EvaluateError::NoMainOutput)));
    let evaluation = Evaluator::new(0).run(&checked(DIAMOND), &Request::main()).unwrap();
    assert!(matches!(evaluation.main::<String>(), Err(EvaluateError::WrongType { .. })));
}

/// Notes what it is told, and cancels after so many nodes.
struct Watcher {
    told: Mutex<Vec<String>>,
    cancel: CancelToken,
    after: usize,
}

impl Observer for Watcher {
    fn started(&self, node: &NodeId, done: usize, total: usize) {
        self.told.lock().unwrap().push(format!("{node} {done}/{total}"));
    }
    fn finished(&self, entry: &TraceEntry) {
        self.told.lock().unwrap().push(format!("{} {:?}", entry.node, entry.state));
        if self.told.lock().unwrap().len() >= 2 * self.after {
            self.cancel.cancel();
        }
    }
}

#[test]
fn a_run_is_told_of_and_stops_when_cancelled() {
    let mut evaluator = counting(1 << 20);
    let cancel = CancelToken::new();
    let watcher = Arc::new(Watcher { told: Mutex::default(), cancel: cancel.clone(), after: 2 });
    let request = Request::main().with_observer(watcher.clone()).with_cancel(cancel);
    assert!(matches!(evaluator.run(&checked(DIAMOND), &request), Err(EvaluateError::Cancelled)));
    assert_eq!(*watcher.told.lock().unwrap(), ["two 0/4", "two Computed", "left 1/4", "left Computed"]);
    ran(&evaluator);
    evaluator.run(&checked(DIAMOND), &Request::main()).unwrap();
    assert_eq!(ran(&evaluator), ["right", "sum"], "what was done before is not lost");
}

#[test]
fn a_long_chain_overflows_no_stack() {
    let nodes: Vec<String> = (1..5_000).map(|n| format!("\"n{n}\": Add(a: \"n{}.sum\")", n - 1)).collect();
    let text = format!(
        "Graph(version: 1, nodes: {{\"c\": Constant(value: 1), \"n0\": Add(a: \"c.value\"), {}}}, output: \"n4999.sum\")",
        nodes.join(",\n")
    );
    let evaluation = Evaluator::new(1 << 20).run(&checked(&text), &Request::main()).unwrap();
    assert_eq!(*evaluation.main::<f64>().unwrap(), 1.0);
}
