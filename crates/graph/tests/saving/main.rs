//! What was not changed keeps its bytes: comments, layout, spelling, explicit defaults.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

#[path = "../fixture/mod.rs"]
mod fixture;
mod random;

use std::path::Path;

use fixture::registry;
use pelage_graph::Graph;

/// A file in a hand's own style.
const FILE: &str = r##"// What it is.
/* And more, /* nested */. */
Graph(
    version: 1, // the first
    output: "joined.text",  // what is asked for
    title: r#"A "test""#,

    nodes: { // all of them
        // Numbers.
        "two":    Constant(value: 2e0),      // a two
        "x":      Add(a: "two.value", b: Some("two.value"), gain: 0x1, /* so often: */ times: 1_0),

        // Texts.
        "read":   ReadText(path: r#"a"b.txt"#),
        "styled": Styled(style: Curly(radius: .1, /* default */ turns: 2.0), name: "\u{e9}", pins: [
                      (at: (0, 1.5, -2)), // the first pin
                      (at: (1, +2, 3.0), toward: (0, 1, 0)),
                  ], limit: Some(3), seed: 7),
        "joined": Join(
            parts: ["read.text", "styled.text",],
            separator: Link("read.text") // no comma
        ),
        "camera": Constant, "light": Constant(), "é": Constant( ),
        // The end.
    },
    layout: { "two": (40.0, 6e1), "x": (1, 2) },
) // over
"##;

fn parsed(text: &str) -> Graph {
    Graph::parse(text).unwrap()
}

/// Saves after a change; the result reads as what was changed.
fn changed(text: &str, change: impl FnOnce(&mut Graph)) -> String {
    let mut graph = parsed(text);
    change(&mut graph);
    let saved = graph.to_ron();
    assert_eq!(Graph::parse(&saved).as_ref(), Ok(&graph), "{saved}");
    saved
}

fn set(graph: &mut Graph, target: &str, value: &str) {
    graph.set(&registry(), target, value, Path::new("/elsewhere")).unwrap();
}

/// That a change replaces these bytes and no others.
#[track_caller]
fn replaces(change: impl FnOnce(&mut Graph), old: &str, new: &str) {
    let change = std::cell::Cell::new(Some(change));
    assert_eq!(FILE.matches(old).count(), 1, "{old} is there once");
    assert_eq!(changed(FILE, change.take().unwrap()), FILE.replacen(old, new, 1));
}

#[test]
fn what_was_only_read_is_saved_as_it_was() {
    for text in [FILE.to_owned(), FILE.replace('\n', "\r\n"), format!("#![enable(implicit_some)]\n{FILE}"), FILE.replace("    ", "\t")] {
        let graph = Graph::parse(&text).unwrap();
        assert_eq!(graph.to_ron(), text);
        assert_eq!(graph.clone().to_ron(), text, "and so is a copy");
    }
    assert!(parsed(FILE).check(&registry()).is_ok());
}

#[test]
fn a_change_taken_back_leaves_no_trace() {
    let saved = changed(FILE, |graph| {
        let before = graph.clone();
        graph.rename(&registry(), "two", "zwei").unwrap();
        graph.remove(&registry(), "read").unwrap();
        set(graph, "x.times", "3");
        graph.nodes.reverse();
        *graph = before;
        graph.rename(&registry(), "x", "y").unwrap();
        graph.rename(&registry(), "y", "x").unwrap();
        set(graph, "x.times", "3");
        set(graph, "x.times", "10");
        graph.move_to("x", 3.0, 4.0).unwrap();
        graph.move_to("x", 1.0, 2.0).unwrap();
        graph.nodes.reverse();
        graph.nodes.reverse();
    });
    assert_eq!(saved, FILE);
}

#[test]
fn a_value_that_is_set_replaces_its_bytes() {
    replaces(|graph| set(graph, "two.value", "3"), "2e0", "3");
    replaces(|graph| set(graph, "x.times", "7"), "1_0", "7");
    replaces(|graph| set(graph, "styled.style.radius", "0.2"), ".1, /*", "0.2, /*");
    replaces(|graph| set(graph, "styled.style", "Straight"), "Curly(radius: .1, /* default */ turns: 2.0)", "Straight");
    replaces(|graph| set(graph, "styled.limit", "4"), "Some(3)", "4");
    replaces(|graph| graph.title = Some("Another".to_owned()), "r#\"A \"test\"\"#", "\"Another\"");
    replaces(|graph| graph.move_to("x", 5.0, 2.5).unwrap(), "(1, 2)", "(5, 2.5)");
    replaces(|graph| graph.output = Some("x.sum".to_owned()), "output: \"joined.text\"", "output: \"x.sum\"");
    // Within a list and a tuple.
    let pins = |graph: &mut Graph, pins: &str| set(graph, "styled.pins", pins);
    replaces(|graph| pins(graph, "[(at: (0, 1.5, -2)), (at: (1, 2, 4), toward: (0, 1, 0))]"), "3.0)", "4)");
}

#[test]
fn a_field_that_is_added_or_left_out_changes_its_own_bytes() {
    let registry = registry();
    let leave_out = |node: &'static str, field: &'static str| move |graph: &mut Graph| graph.set_field(node, field, None).unwrap();
    replaces(leave_out("two", "value"), "value: 2e0", "");
    replaces(leave_out("x", "a"), "a: \"two.value\", b", "b");
    replaces(leave_out("x", "gain"), " gain: 0x1,", "");
    replaces(leave_out("x", "times"), "0x1, /* so often: */ times: 1_0", "0x1 /* so often: */");
    replaces(leave_out("styled", "seed"), ", seed: 7", "");
    replaces(leave_out("joined", "parts"), "            parts: [\"read.text\", \"styled.text\",],\n", "");
    // The last has no comma, and so it is with the one that is the last now.
    let separator = ",\n            separator: Link(\"read.text\") // no comma\n";
    replaces(leave_out("joined", "separator"), separator, "\n");
    replaces(|graph| set(graph, "styled.flipped", "true"), "seed: 7)", "seed: 7, flipped: true)");
    replaces(|graph| set(graph, "camera.value", "1"), "Constant, \"light\"", "Constant(value: 1), \"light\"");
    replaces(|graph| set(graph, "light.value", "1"), "Constant(),", "Constant(value: 1),");
    replaces(|graph| set(graph, "joined.separator", "-"), "Link(\"read.text\")", "\"-\"");
    replaces(
        |graph| graph.connect(&registry, "read.text", "joined", "parts").unwrap(),
        "\"styled.text\",]",
        "\"styled.text\", \"read.text\",]",
    );
    replaces(|graph| graph.about = Some("Much".to_owned()), "\"#,\n\n", "\"#,\n    about: \"Much\",\n\n");
    replaces(|graph| graph.title = None, "    title: r#\"A \"test\"\"#,\n", "");
    // A list item, with the comment that ends its line.
    let first = |graph: &mut Graph| set(graph, "styled.pins", "[(at: (1, 2, 3.0), toward: (0, 1, 0))]");
    replaces(first, "                      (at: (0, 1.5, -2)), // the first pin\n", "");
}

#[test]
fn a_node_that_is_added_stands_in_the_style_of_the_others() {
    let add = |graph: &mut Graph| {
        graph.add("sum", "Add").unwrap();
        graph.connect(&registry(), "x.sum", "sum", "a").unwrap();
    };
    replaces(
        add,
        "        // The end.\n",
        "        \"sum\":    Add(a: \"x.sum\"),\n        // The end.\n".replace("sum\":    ", "sum\": ").as_str(),
    );
    let aligned = "Graph(\n\tversion: 1,\n\tnodes: {\n\t\t\"one\":   Constant(),\n\t\t\"three\": Constant(), // 3\n\t},\n)";
    let added = aligned.replace("// 3\n", "// 3\n\t\t\"sum\":   Add(a: \"x.sum\"),\n");
    assert_eq!(changed(aligned, add), added);
    let windows = aligned.replace('\n', "\r\n");
    assert_eq!(changed(&windows, add), added.replace('\n', "\r\n"));
    for (text, added) in [
        ("(nodes:{\"c\":Constant},version:1)", "(nodes:{\"c\":Constant, \"sum\": Add(a: \"x.sum\")},version:1)"),
        ("Graph(version: 1, nodes: {})", "Graph(version: 1, nodes: {\n    \"sum\": Add(a: \"x.sum\"),\n})"),
        ("Graph(version: 1, nodes: { // none\n})", "Graph(version: 1, nodes: { // none\n    \"sum\": Add(a: \"x.sum\"),\n})"),
        (
            "Graph(\n  version: 1,\n  nodes: {\n    \"c\": Constant() // no comma\n  }\n)",
            "Graph(\n  version: 1,\n  nodes: {\n    \"c\": Constant(), // no comma\n    \"sum\": Add(a: \"x.sum\")\n  }\n)",
        ),
    ] {
        assert_eq!(changed(text, add), added);
    }
    let placed = changed("Graph(\n    version: 1,\n    nodes: {\n        \"c\": Constant(),\n    },\n)\n", |graph| {
        graph.move_to("c", 1.0, 2.5).unwrap();
    });
    assert!(placed.ends_with("    },\n    layout: {\n        \"c\": (1, 2.5),\n    },\n)\n"), "{placed}");
}

#[test]
fn a_node_that_is_removed_takes_its_own_line_and_leaves_the_comments_above() {
    let registry = registry();
    let remove = |id: &'static str| {
        let registry = &registry;
        move |graph: &mut Graph| {
            graph.nodes.shift_remove(id);
            graph.layout.shift_remove(id);
            let _ = registry;
        }
    };
    replaces(remove("read"), "        \"read\":   ReadText(path: r#\"a\"b.txt\"#),\n", "");
    replaces(remove("light"), " \"light\": Constant(),", "");
    replaces(remove("camera"), "\"camera\": Constant, ", "");
    replaces(remove("é"), " \"é\": Constant( ),\n", "\n");
    let text = changed(FILE, remove("two"));
    assert_eq!(text, FILE.replace("        \"two\":    Constant(value: 2e0),      // a two\n", "").replace("\"two\": (40.0, 6e1), ", ""));
    // With the links to it.
    let text = changed(FILE, |graph| drop(graph.remove(&registry, "styled").unwrap()));
    assert!(text.contains("            parts: [\"read.text\",],\n") && !text.contains("pins"), "{text}");
}

#[test]
fn a_rename_changes_names_and_links_and_nothing_else() {
    let text = changed(FILE, |graph| graph.rename(&registry(), "two", "zwei").unwrap());
    assert_eq!(text, FILE.replace("\"two\"", "\"zwei\"").replace("\"two.value\"", "\"zwei.value\""));
    let text = changed(FILE, |graph| {
        graph.rename(&registry(), "joined", "j").unwrap();
        graph.nodes["styled"].kind = "Stiled".to_owned();
    });
    assert_eq!(text, FILE.replace("\"joined", "\"j").replace("Styled(", "Stiled("));
}

#[test]
fn nodes_in_another_order_take_their_lines_and_comments_along() {
    let text = changed(FILE, |graph| graph.nodes.swap_indices(1, 2));
    let (x, read) = ("        \"x\":      Add(", "\n        // Texts.\n        \"read\":   ReadText(path: r#\"a\"b.txt\"#),\n");
    let expected = FILE.replace(read, "").replace(x, &format!("{read}{x}"));
    assert_eq!(text, expected);
    let text = changed(FILE, |graph| graph.nodes.reverse());
    for comment in ["// Numbers.", "// a two", "/* so often: */", "// Texts.", "// the first pin", "// no comma", "// The end.", "// over"]
    {
        assert!(text.contains(comment), "{comment} in {text}");
    }
}

#[test]
fn what_the_reader_passed_over_is_saved_unharmed() {
    let text = "Graph(\n    version: 1,\n    lyaout: {}, // what?\n    title: 3,\n    nodes: {\n        \"x\": Constant(value: 1, value: 2),\n        \"y\": 7, \"x\": Add(),\n        8: Constant(),\n        \"z\": Constant(),\n    },\n    layout: { \"none\": (1, 2), \"z\": 3 },\n)";
    let graph = parsed(text);
    assert!(graph.check(&registry()).unwrap_err().len() >= 7);
    assert_eq!(graph.to_ron(), text);
    let mut graph = graph;
    set(&mut graph, "z.value", "4");
    set(&mut graph, "x.value", "5");
    graph.add("w", "Constant").unwrap();
    let expected = text
        .replace("\"z\": Constant()", "\"z\": Constant(value: 4)")
        .replace("value: 1", "value: 5")
        .replace("(value: 4),\n", "(value: 4),\n        \"w\": Constant(),\n");
    assert_eq!(graph.to_ron(), expected);
    graph.nodes.shift_remove("z");
    graph.nodes.shift_remove("w");
    let text = graph.to_ron();
    assert!(text.contains("\"y\": 7, \"x\": Add(),\n        8: Constant(),\n    }"), "{text}");
    assert!(Graph::parse(&text).is_ok());
}

/// Found by fuzzing: `nodes: {}` was added, or put in the place of what is no map.
#[test]
fn a_file_without_a_map_of_nodes_is_saved_without_one() {
    let fields = [
        "nodezs: { \"a\": Constant() }",
        "nodes: \"A\"",
        "nodes: [],\n    layout: 3",
        "nodes: \"A\",\n    nodes: { \"a\": Constant() }",
        "nodes: {}, r#tle: 3",
    ];
    for field in fields {
        let text = format!("Graph(\n    version: 1,\n    {field},\n)\n");
        assert_eq!(Graph::parse(&text).unwrap().to_ron(), text);
    }
}
