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

/// A graph that moves says how to get to the same files from where it is; all else keeps its bytes.
#[test]
fn a_graph_that_moves_still_finds_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let (graphs, elsewhere) = (folder.path().join("graphs"), folder.path().join("out/deep"));
    std::fs::create_dir_all(graphs.join("texts")).unwrap();
    std::fs::write(graphs.join("texts/a.txt"), "a").unwrap();
    std::fs::write(folder.path().join("b.txt"), "b").unwrap();
    let absolute = folder.path().join("b.txt").display().to_string();
    let text = format!(
        r#"Graph(version: 1, nodes: {{
    // As it is written.
    "a": ReadText( path: "texts/a.txt" ), "b": ReadText(path: "../b.txt"), // The other one.
    "c": ReadText(path: "{absolute}"), "d": ReadText(path: Link("a.text")),
}}, output: "a.text")"#
    );
    std::fs::write(graphs.join("graph.ron"), &text).unwrap();
    let graph = Graph::read(&graphs.join("graph.ron")).unwrap();

    let mut same = graph.clone();
    same.relocate(&registry(), &folder.path().join("graphs/../graphs")).unwrap();
    assert_eq!(same.to_ron(), text);

    // The folder need not be there yet.
    let mut moved = graph.clone();
    moved.relocate(&registry(), &elsewhere).unwrap();
    let expected = text.replace("\"texts/a.txt\"", "\"../../graphs/texts/a.txt\"").replace("\"../b.txt\"", "\"../../b.txt\"");
    assert_eq!(moved.to_ron(), expected);
    std::fs::create_dir_all(&elsewhere).unwrap();
    std::fs::write(elsewhere.join("graph.ron"), moved.to_ron()).unwrap();
    for graph in [moved, Graph::read(&elsewhere.join("graph.ron")).unwrap()] {
        graph.check_files(&registry()).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn a_link_on_the_way_does_not_mislead() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("one/two/graphs")).unwrap();
    std::fs::write(folder.path().join("one/two/a.txt"), "a").unwrap();
    std::os::unix::fs::symlink("one/two/graphs", folder.path().join("link")).unwrap();
    std::fs::write(folder.path().join("link/graph.ron"), r#"Graph(version: 1, nodes: {"a": ReadText(path: "../a.txt")})"#).unwrap();
    let mut graph = Graph::read(&folder.path().join("link/graph.ron")).unwrap();
    graph.relocate(&registry(), folder.path()).unwrap();
    assert!(graph.to_ron().contains("\"one/two/a.txt\""), "{}", graph.to_ron());
    graph.check_files(&registry()).unwrap();
}
