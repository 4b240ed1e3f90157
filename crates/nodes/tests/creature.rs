//! The nodes of animals make what is asked of them, and say what cannot be had.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

use pelage_graph::{CheckedGraph, Evaluator, Graph, Request};

fn graph(parts: &str) -> CheckedGraph {
    let nodes = format!("\"cat\": Creature(faces: 600), \"marks\": PartFields(creature: \"cat.creature\", parts: [{parts}])");
    Graph::parse(&format!("Graph(version: 1, nodes: {{{nodes}}})")).unwrap().check(&pelage_nodes::registry()).unwrap()
}

#[test]
fn a_part_given_twice_is_refused() {
    let twice = graph("(part: Head), (part: Paws), (part: Head, length: 2.0)");
    let error = Evaluator::new(0).run(&twice, &Request::output("marks.lengths")).unwrap_err().to_string();
    assert!(error.contains("Head is given twice"), "{error}");
    assert!(Evaluator::new(0).run(&graph("(part: Head), (part: Paws)"), &Request::output("marks.lengths")).is_ok());
}

#[test]
fn what_nobody_asks_for_is_not_made() {
    let request = Request::output("marks.lengths").with_all_values();
    let evaluation = Evaluator::new(0).run(&graph("(part: Head)"), &request).unwrap();
    let made: Vec<String> = evaluation.values().map(|(node, port, _)| format!("{node}.{port}")).collect();
    assert_eq!(made, ["cat.creature", "marks.lengths"]);
}
