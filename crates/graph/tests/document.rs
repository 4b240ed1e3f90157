//! Settings, an editor's commands, and saving.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

mod fixture;

use std::path::Path;

use fixture::*;
use pelage_graph::{EditError, Evaluator, Graph, Literal, NodeId, Request, Shape};

const GRAPH: &str = r#"Graph(
    version: 1,
    title: "A test",
    about: "Two lines\nand \"quotes\".",
    nodes: {
        "two": Constant(value: 2),
        "x": Add(a: "two.value", b: "two.value"),
        "read": ReadText(path: "a.txt"),
        "styled": Styled(style: Curly(radius: 0.1), name: "two.value"),
        "joined": Join(parts: ["read.text", "styled.text"], separator: Link("read.text")),
    },
    output: "joined.text",
    layout: {
        "two": (40, 60.5),
    },
)
"#;

fn graph() -> Graph {
    Graph::parse(GRAPH).unwrap()
}

fn set(graph: &mut Graph, target: &str, value: &str) -> Result<(), String> {
    graph.set(&registry(), target, value, Path::new("/elsewhere")).map_err(|error| error.to_string())
}

/// The field of a node, as it is written.
fn field(graph: &Graph, node: &str, field: &str) -> String {
    graph.nodes[node].fields.get(field).map_or_else(|| "-".to_owned(), ToString::to_string)
}

#[test]
fn what_is_written_is_saved() {
    assert_eq!(graph().to_ron(), GRAPH);
    assert!(graph().check(&registry()).is_ok());
}

#[test]
fn a_setting_is_ron_or_a_bare_word() {
    let mut graph = graph();
    for (target, value, written) in [
        ("two.value", "3", "3"),
        ("two.value", "-1e2", "-100.0"),
        ("x.a", "\"x.sum\"", "\"x.sum\""),
        ("x.a", "two.value", "\"two.value\""),
        ("x.gain", "\"two.value\"", "\"two.value\""),
        ("styled.style", "Straight", "Straight"),
        ("styled.style", "Curly(turns: 3)", "Curly(turns: 3)"),
        ("styled.style.radius", "0.3", "Curly(turns: 3, radius: 0.3)"),
        ("styled.toward", "(1, 0, 0)", "(1, 0, 0)"),
        ("styled.name", "silk", "\"silk\""),
        ("styled.name", "\"raw silk\"", "\"raw silk\""),
        ("styled.name", "raw silk", "\"raw silk\""),
        ("styled.name", "3", "\"3\""),
        ("styled.name", "Link(\"read.text\")", "Link(\"read.text\")"),
        ("styled.limit", "5", "5"),
        ("styled.limit", "None", "None"),
        ("read.path", "models/b.txt", "\"/elsewhere/models/b.txt\""),
        ("read.path", "/else/b.txt", "\"/else/b.txt\""),
        ("joined.parts", "[\"styled.text\"]", "[\"styled.text\"]"),
    ] {
        let result = set(&mut graph, target, value);
        let mut parts = target.split('.');
        let (node, name) = (parts.next().unwrap(), parts.next().unwrap());
        assert_eq!((result, field(&graph, node, name).as_str()), (Ok(()), written), "{target}={value}");
    }
}

#[test]
fn a_setting_that_does_not_fit_changes_nothing_and_says_why() {
    let mut graph = graph();
    let before = graph.clone();
    for (target, value, said) in [
        ("two", "3", "\"two\" is not of the form NODE.INPUT"),
        ("too.value", "3", "too.value=3: there is no node \"too\"; did you mean two?"),
        ("two.vlaue", "3", "two.vlaue=3: node \"two\": Constant has no field \"vlaue\"; did you mean value?"),
        ("two.value", "3000", "two.value=3000: node \"two\", value: 3000 is out of range: expected -1000 to 1000 (1)"),
        ("two.value", "(3", "two.value=(3: node \"two\", value: expected a number, found \"(3\" (expected comma)"),
        ("two.value", "three", "two.value=three: node \"two\", value: expected a number, found the word three"),
        ("styled.style", "Curley", "styled.style=Curley: node \"styled\", style: Style has no variant Curley; did you mean Curly?"),
        (
            "styled.style.raduis",
            "1",
            "styled.style.raduis=1: node \"styled\", style.raduis: Curly has no field \"raduis\"; did you mean radius?",
        ),
        (
            "styled.style.radius",
            "1",
            "styled.style.radius=1: node \"styled\", style.radius: 1 is out of range: expected 0 to 0.5 (lengths)",
        ),
    ] {
        assert_eq!(set(&mut graph, target, value), Err(said.to_owned()));
    }
    assert_eq!(graph, before);
}

/// A table's cell, say: as in a setting, but of no graph.
#[test]
fn a_parameter_reads_a_value_by_the_rules_of_a_setting() {
    let registry = registry();
    let param = |kind: &str, name: &str| registry.specification(kind).unwrap().param(name).unwrap().clone();
    assert_eq!(param("Add", "times").read::<u32>("7"), Ok(7));
    assert_eq!(param("Join", "separator").read::<String>("and"), Ok("and".to_owned()));
    let refused = |kind: &str, name: &str, value: &str| param(kind, name).read::<f64>(value).unwrap_err().to_string();
    assert_eq!(refused("Add", "gain", "10.0"), "10.0 is out of range: expected 0 to below 10 (1)");
    assert_eq!(refused("Add", "gain", "\"a.value\""), "expected a number, found the text \"a.value\"");
    assert!(refused("Add", "gain", "1 2").starts_with("expected a number, found \"1 2\""));
    assert_eq!(refused("Join", "separator", "x"), "expected a number, found the text \"x\"");
}

#[test]
fn a_link_set_to_nowhere_is_found_when_checked() {
    let mut graph = graph();
    set(&mut graph, "x.a", "three.value").unwrap();
    let faults = graph.check(&registry()).unwrap_err().to_string();
    assert_eq!(faults, "node \"x\", a: there is no node \"three\"");
}

#[test]
fn commands_build_what_a_file_says() {
    let registry = registry();
    let mut built = Graph::default();
    built.title = Some("A test".to_owned());
    built.about = Some("Two lines\nand \"quotes\".".to_owned());
    for (id, kind) in [("two", "Constant"), ("x", "Add"), ("read", "ReadText"), ("styled", "Styled"), ("joined", "Join")] {
        built.add(id, kind).unwrap();
    }
    built.set_field("two", "value", Some(2_i64.into())).unwrap();
    built.connect(&registry, "two.value", "x", "a").unwrap();
    built.connect(&registry, "two.value", "x", "b").unwrap();
    built.set_field("read", "path", Some("a.txt".into())).unwrap();
    set(&mut built, "styled.style", "Curly(radius: 0.1)").unwrap();
    set(&mut built, "styled.name", "two.value").unwrap();
    built.connect(&registry, "read.text", "joined", "parts").unwrap();
    built.connect(&registry, "styled.text", "joined", "parts").unwrap();
    built.connect(&registry, "read.text", "joined", "separator").unwrap();
    built.output = Some("joined.text".to_owned());
    built.move_to("two", 40.0, 60.5).unwrap();
    assert_eq!(built.to_ron(), GRAPH);
    assert_eq!(built.add("x", "Add"), Err(EditError::Taken("x".to_owned())));
    assert_eq!(built.add("x.y", "Add"), Err(EditError::BadId("x.y".to_owned())));
    assert!(built.connect(&registry, "two.value", "x", "c").is_err() && built.connect(&registry, "two.value", "y", "a").is_err());
}

#[test]
fn renaming_follows_every_link_and_no_text() {
    let mut graph = graph();
    graph.rename(&registry(), "two", "zwei").unwrap();
    assert_eq!((field(&graph, "x", "a"), field(&graph, "x", "b")), ("\"zwei.value\"".to_owned(), "\"zwei.value\"".to_owned()));
    assert_eq!(field(&graph, "styled", "name"), "\"two.value\"", "a text is no link");
    assert!(graph.layout.contains_key("zwei") && !graph.layout.contains_key("two"));
    graph.rename(&registry(), "read", "r").unwrap();
    assert_eq!(field(&graph, "joined", "parts"), "[\"r.text\", \"styled.text\"]");
    assert_eq!(field(&graph, "joined", "separator"), "Link(\"r.text\")");
    graph.rename(&registry(), "joined", "j").unwrap();
    assert_eq!(graph.output.as_deref(), Some("j.text"));
    assert!(graph.check(&registry()).is_ok());
    assert_eq!(graph.nodes.keys().map(NodeId::as_str).collect::<Vec<_>>(), ["zwei", "x", "r", "styled", "j"]);
    assert_eq!(graph.rename(&registry(), "x", "r"), Err(EditError::Taken("r".to_owned())));
    graph.rename(&registry(), "zwei", "two").unwrap();
    graph.rename(&registry(), "r", "read").unwrap();
    graph.rename(&registry(), "j", "joined").unwrap();
    assert_eq!(graph.to_ron(), GRAPH);
}

#[test]
fn removing_a_node_cuts_its_links_and_says_which() {
    let mut graph = graph();
    let (node, cut) = graph.remove(&registry(), "read").unwrap();
    assert_eq!(node.kind, "ReadText");
    let cut: Vec<String> = cut.iter().map(|link| format!("{} {}", link.node, link.field)).collect();
    assert_eq!(cut, ["joined parts", "joined separator"]);
    assert_eq!((field(&graph, "joined", "parts"), field(&graph, "joined", "separator")), ("[\"styled.text\"]".to_owned(), "-".to_owned()));
    assert!(graph.check(&registry()).is_ok());
    graph.remove(&registry(), "joined").unwrap();
    assert_eq!(graph.output, None);
    assert!(graph.remove(&registry(), "joined").is_err());
}

#[test]
fn unknown_kinds_and_fields_are_saved_unharmed() {
    let text = GRAPH.replace("Constant(value: 2)", "Foreign(deep: {\"a\": [(1, Some(None))]}, at: \"x.sum\")").replace("name: ", "nom: ");
    let mut graph = Graph::parse(&text).unwrap();
    assert_eq!(graph.to_ron(), text);
    assert_eq!(graph.check(&registry()).unwrap_err().len(), 2);
    graph.rename(&registry(), "x", "y").unwrap();
    assert_eq!(field(&graph, "two", "at"), "\"y.sum\"");
}

#[test]
fn a_file_is_read_with_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("graph.ron");
    std::fs::write(&path, GRAPH).unwrap();
    std::fs::write(folder.path().join("a.txt"), "read").unwrap();
    let graph = Graph::read(&path).unwrap();
    let evaluation = Evaluator::new(0).run(&graph.check(&registry()).unwrap(), &Request::main()).unwrap();
    assert!(evaluation.main::<String>().unwrap().starts_with("readreadCurly { radius: 0.1, turns: 2.0 } [0.0, -0.3, -1.0]"));
    std::fs::write(&path, "Graph(").unwrap();
    let error = Graph::read(&path).unwrap_err().to_string();
    assert!(error.starts_with(&format!("{}:1:", path.display())), "{error}");
    assert!(Graph::read(&folder.path().join("none.ron")).unwrap_err().to_string().contains("none.ron"));
}

#[test]
fn a_graph_may_be_terse() {
    let graph = Graph::parse("(nodes:{\"c\":Constant},version:1)").unwrap();
    assert_eq!(graph.nodes["c"].kind, "Constant");
    assert!(graph.check(&registry()).is_ok());
    assert_eq!(Literal::from(0.5), Shape::Number(0.5).into());
}
