//! Files that a graph names and that are not there.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

mod fixture;

use fixture::registry;
use pelage_graph::{Evaluator, Graph, Request};

/// Three nodes whose files are not there, and one whose file is.
const GRAPH: &str = r#"Graph(version: 1, nodes: {
"a": ReadText(path: "none.txt"),
"b": ReadText(path: "there.txt"), "c": ReadText(path: "folder"),
"d": ReadText(path: "gone.txt"),
"all": Join(parts: ["a.text", "b.text", "c.text"]),
"x": Add(a: "y.sum"), "styled": Styled(name: Link("b.text")),
}, output: "all.text")"#;

#[test]
fn every_missing_file_is_answered_beside_what_else_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("there.txt"), "").unwrap();
    std::fs::create_dir(folder.path().join("folder")).unwrap();
    let graph = Graph::parse(GRAPH).unwrap().with_directory(folder.path());
    let files = graph.check_files(&registry()).unwrap_err();
    let said: Vec<String> = files.iter().map(|fault| fault.to_string().replace(folder.path().to_str().unwrap(), "")).collect();
    assert_eq!(said.len(), 3);
    assert!(said[0].starts_with("2:21: node \"a\", path: cannot read /none.txt: "), "{}", said[0]);
    assert!(said[1].starts_with("3:55: node \"c\", path: cannot read /folder: "), "{}", said[1]);
    assert!(said[2].starts_with("4:21: node \"d\", path: cannot read /gone.txt: "), "{}", said[2]);
    let all = graph.check(&registry()).unwrap_err().and(files).to_string();
    assert_eq!(all.lines().count(), 4);
    assert!(all.lines().last().unwrap().starts_with("6:13: node \"x\", a: there is no node \"y\""), "{all}");
}

/// And a run answers with those that it needs, before any node runs.
#[test]
fn a_run_answers_with_every_missing_file_that_it_needs() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("there.txt"), "").unwrap();
    let text = GRAPH.replace("\"x\": Add(a: \"y.sum\"), ", "");
    let graph = Graph::parse(&text).unwrap().with_directory(folder.path()).check(&registry()).unwrap();
    let error = Evaluator::new(0).run(&graph, &Request::main()).unwrap_err().to_string();
    let nodes: Vec<&str> = error.lines().map(|line| line.split('"').nth(1).unwrap()).collect();
    assert_eq!(nodes, ["a", "c"], "{error}");
}
