//! Graphs with one fault each, and what is said of it: line, column, node, expectation.

mod fixture;

use fixture::registry;
use pelage_graph::{Faults, Graph};

fn faults(text: &str) -> Option<Faults> {
    match Graph::parse(text) {
        Ok(graph) => graph.check(&registry()).err(),
        Err(faults) => Some(faults),
    }
}

/// A file whose nodes are `nodes`, from the third line on.
fn file(nodes: &str) -> String {
    format!("Graph(version: 1, nodes: {{\n\"c\": Constant(value: 2),\n{nodes}\n}})")
}

/// Whole files.
const FILES: &[(&str, &str)] = &[
    ("", "1:1: unexpected end of RON"),
    ("Graph(version: 1, nodes: {", "1:26: unexpected end of RON"),
    ("Graph(version: 1, nodes: {\n\"c\" Constant() })", "2:4: expected colon"),
    ("Graph(version: 1, nodes: {}) x", "1:30: non-whitespace trailing characters"),
    ("[1, 2]", "1:1: expected Graph(version: 1, nodes: {…}), found a list of 2"),
    ("Grpah(version: 1, nodes: {})", "1:1: expected Graph(version: 1, nodes: {…}), found Grpah(…)"),
    ("Graph(nodes: {})", "1:1: missing \"version\": expected a whole number such as 1"),
    (
        "Graph(version: 99, nodes: {}, from: 4)",
        "1:16: the file is of version 99, this program reads versions up to 1; open it with a newer program",
    ),
    ("Graph(version: -1, nodes: {})", "1:16: there is no version -1; this program reads versions 0 to 1"),
    ("Graph(version: 1.0, nodes: {})", "1:16: expected a version, a whole number, found the number 1.0"),
    ("Graph(version: 0, nodes: {\"x\": Constant()})", "no fault"),
    (
        "Graph(version: 0, nodes: {\"x\": (kid: \"Constant\")})",
        "1:32: node \"x\": expected a node, Kind(field: value), found a record of 1",
    ),
    ("Graph(version: \"1\", nodes: {})", "1:16: expected a version, a whole number, found the text \"1\""),
    ("Graph(version: 1)", "1:1: missing \"nodes\": expected a map of nodes by id"),
    ("Graph(version: 1, nodes: [])", "1:26: nodes: expected a map of nodes by id, {\"id\": Kind(…)}, found a list of 0"),
    ("Graph(version: 1, nodes: {}, lyaout: {})", "1:30: Graph has no field \"lyaout\"; did you mean layout?"),
    ("Graph(version: 1, nodes: {}, nodes: {})", "1:30: the field \"nodes\" is given twice; remove one"),
    ("Graph(version: 1, nodes: {}, title: 3)", "1:37: title: expected a text, found the whole number 3"),
    ("Graph(version: 1, nodes: {}, output: \"c.value\")", "1:38: output: there is no node \"c\""),
    ("Graph(version: 1, nodes: {\"c\": Constant()}, output: \"c\")", "1:53: output: expected a link \"node.port\", found the text \"c\""),
    ("Graph(version: 1, nodes: {\"c\": Constant()}, layout: {\"d\": (1, 2)})", "1:54: layout: there is no node \"d\""),
    (
        "Graph(version: 1, nodes: {\"c\": Constant()}, layout: {\"c\": (1, inf)})",
        "1:59: layout: expected a position (x, y) of two finite numbers, found a tuple of 2",
    ),
    (
        "Graph(version: 1, nodes: {\"c\": Constant()}, layout: {\"c\": (1, 2), \"c\": (1, 2)})",
        "1:67: layout: there is a node \"c\" already; rename one of them",
    ),
];

/// Nodes on the third line.
const NODES: &[(&str, &str)] = &[
    ("\"x\": Constnat()", "3:6: node \"x\": unknown kind of node Constnat; did you mean Constant?"),
    ("\"x\": Rotate()", "3:6: node \"x\": unknown kind of node Rotate"),
    ("\"x\": 7", "3:6: node \"x\": expected a node, Kind(field: value), found the whole number 7"),
    ("\"x\": (value: 7)", "3:6: node \"x\": expected a node, Kind(field: value), found a record of 1"),
    ("\"a b\": Constant()", "3:1: the id \"a b\" cannot be used: ids are made of letters, digits, '_' and '-'"),
    ("7: Constant()", "3:1: nodes: expected an id in quotes, found the whole number 7"),
    ("\"c\": Constant()", "3:1: node \"c\": there is a node \"c\" already; rename one of them"),
    ("\"x\": Constant(vlaue: 1)", "3:15: node \"x\": Constant has no field \"vlaue\"; did you mean value?"),
    ("\"x\": Add(a: \"c.value\", q: 1)", "3:24: node \"x\": Add has no field \"q\"; expected one of a, b, gain, times"),
    ("\"x\": Constant(value: 1, value: 2)", "3:25: node \"x\": the field \"value\" is given twice; remove one"),
    ("\"x\": Constant(value: true)", "3:22: node \"x\", value: expected a number, found true"),
    (
        "\"x\": Constant(value: \"two\")",
        "3:22: node \"x\", value: expected a number, or a link \"node.port\" to one, found the text \"two\"",
    ),
    ("\"x\": Constant(value: 1e4)", "3:22: node \"x\", value: 10000.0 is out of range: expected -1000 to 1000 (1)"),
    ("\"x\": Constant(value: inf)", "3:22: node \"x\", value: expected a finite number, found inf"),
    ("\"x\": Constant(value: NaN)", "3:22: node \"x\", value: expected a finite number, found NaN"),
    ("\"x\": Add(a: \"c.value\", gain: 10)", "3:30: node \"x\", gain: 10 is out of range: expected 0 to below 10 (1)"),
    ("\"x\": Add(a: \"c.value\", times: 2.5)", "3:31: node \"x\", times: expected a whole number, found the number 2.5"),
    ("\"x\": Add(a: \"c.value\", times: -1)", "3:31: node \"x\", times: -1 is out of range: expected 1 to 100 (times)"),
    ("\"x\": Add(b: \"c.value\")", "3:6: node \"x\": missing \"a\": expected a link \"node.port\" to f64"),
    ("\"x\": ReadText()", "3:6: node \"x\": missing \"path\": expected a file path in quotes"),
    ("\"x\": Add(a: \"d.value\")", "3:13: node \"x\", a: there is no node \"d\""),
    ("\"camera\": Constant(),\"x\": Add(a: \"camrea.value\")", "3:34: node \"x\", a: there is no node \"camrea\"; did you mean camera?"),
    ("\"x\": Add(a: \"c.vlue\")", "3:13: node \"x\", a: Constant \"c\" has no output \"vlue\"; did you mean value?"),
    ("\"x\": Add(a: \"c.sum\")", "3:13: node \"x\", a: Constant \"c\" has no output \"sum\"; expected one of value"),
    ("\"x\": Add(a: 3)", "3:13: node \"x\", a: expected a link \"node.port\" to f64, found the whole number 3"),
    ("\"x\": Add(a: \"c\")", "3:13: node \"x\", a: expected a link \"node.port\" to f64, found the text \"c\""),
    ("\"x\": Join(parts: [\"c.value\"])", "3:19: node \"x\", parts: expected a link \"node.port\" to Text, but \"c.value\" is f64"),
    (
        "\"x\": Styled(seed: \"c.value\")",
        "3:19: node \"x\", seed: expected a whole number, or a link \"node.port\" to one, but \"c.value\" is f64",
    ),
    (
        "\"x\": Styled(name: Link(\"c.value\"))",
        "3:19: node \"x\", name: expected a text, or a link \"node.port\" to one, but \"c.value\" is f64",
    ),
    ("\"x\": Add(a: \"x.sum\")", "3:13: node \"x\", a: a cycle: x → x; a node cannot wait for its own result"),
    (
        "\"x\": Add(a: \"z.sum\"), \"y\": Add(a: \"x.sum\"), \"z\": Add(a: \"y.sum\")",
        "3:13: node \"x\", a: a cycle: x → y → z → x; a node cannot wait for its own result",
    ),
    ("\"x\": Styled(style: Curley())", "3:20: node \"x\", style: Style has no variant Curley; did you mean Curly?"),
    ("\"x\": Styled(style: Wavy)", "3:20: node \"x\", style: Style has no variant Wavy; expected one of Straight, Curly"),
    ("\"x\": Styled(style: Curly(radius: 0.6))", "3:34: node \"x\", style.radius: 0.6 is out of range: expected 0 to 0.5 (lengths)"),
    ("\"x\": Styled(style: Curly(raduis: 0.1))", "3:26: node \"x\", style: Curly has no field \"raduis\"; did you mean radius?"),
    ("\"x\": Styled(style: Curly(turns: 1, turns: 2))", "3:36: node \"x\", style: the field \"turns\" is given twice; remove one"),
    ("\"x\": Styled(style: 3)", "3:20: node \"x\", style: expected one of Straight, Curly, found the whole number 3"),
    ("\"x\": Styled(toward: (0, 1))", "3:21: node \"x\", toward: expected (a number, a number, a number), found a tuple of 2"),
    ("\"x\": Styled(toward: (0, inf, 0))", "3:25: node \"x\", toward: expected a finite number, found inf"),
    ("\"x\": Styled(colour: (1, 2, 0))", "3:25: node \"x\", colour: 2 is out of range: expected 0 to 1"),
    ("\"x\": Styled(size: (0, 720))", "3:20: node \"x\", size: 0 is out of range: expected 1 to 16384 (pixels)"),
    ("\"x\": Styled(pins: [(toward: (1, 0, 0))])", "3:20: node \"x\", pins: missing \"at\": expected (a number, a number, a number)"),
    ("\"x\": Styled(limit: Some(0))", "3:25: node \"x\", limit: 0 is out of range: expected 1 to 100 (steps)"),
    (
        "\"x\": Styled(seed: 18446744073709551616)",
        "3:19: node \"x\", seed: expected a whole number, found the number 1.8446744073709552e19",
    ),
    ("\"x\": Styled(seed: -1)", "3:19: node \"x\", seed: -1 is out of range: expected 0 to 18446744073709551615 (seed)"),
    ("\"x\": Styled(flipped: 1)", "3:22: node \"x\", flipped: expected true or false, found the whole number 1"),
    ("\"x\": Styled(name: 1)", "3:19: node \"x\", name: expected a text, found the whole number 1"),
];

#[test]
fn each_fault_is_answered_with_place_node_and_expectation() {
    let nodes = NODES.iter().map(|(nodes, said)| (file(nodes), *said));
    let mut wrong = Vec::new();
    for (text, said) in FILES.iter().map(|(text, said)| ((*text).to_owned(), *said)).chain(nodes) {
        let found = faults(&text).map_or_else(|| "no fault".to_owned(), |faults| faults.to_string());
        if found != said {
            wrong.push(format!("{text}\n  expected {said}\n  found    {found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn all_faults_of_a_file_are_answered_in_one_run() {
    let nodes: Vec<String> = NODES
        .iter()
        .filter(|(node, _)| node.matches("\"x\":").count() == 1 && !node.contains("\"camera\"") && !node.contains("\"y\""))
        .enumerate()
        .map(|(index, (node, _))| node.replace("\"x\"", &format!("\"x{index}\"")).replace("\"x.sum\"", &format!("\"x{index}.sum\"")))
        .collect();
    let text = format!("Graph(version: 1, nodes: {{\n\"c\": Constant(value: 2),\n{}\n}})", nodes.join(",\n"));
    let faults = faults(&text).unwrap();
    assert_eq!(faults.len(), nodes.len(), "{faults}");
    let lines: Vec<u32> = faults.iter().map(|fault| fault.place.unwrap().line).collect();
    assert_eq!(lines, (3..3 + nodes.len() as u32).collect::<Vec<_>>(), "one on each line, in order");
}

#[test]
fn a_path_goes_before_each_line() {
    let found = faults(&file("\"x\": Rotate(),\n\"y\": Rotate()")).unwrap().with_path("graphs/a.ron").to_string();
    assert_eq!(
        found,
        "graphs/a.ron:3:6: node \"x\": unknown kind of node Rotate\ngraphs/a.ron:4:6: node \"y\": unknown kind of node Rotate"
    );
}

#[test]
fn two_cycles_are_two_faults_and_their_tails_none() {
    let text = file(
        "\"a\": Add(a: \"b.sum\"), \"b\": Add(a: \"a.sum\", b: \"c.value\"),\n\"p\": Add(a: \"q.sum\"), \"q\": Add(a: \"p.sum\"), \"tail\": Add(a: \"q.sum\")",
    );
    let found: Vec<String> = faults(&text).unwrap().iter().map(ToString::to_string).collect();
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].contains("a → b → a") && found[1].contains("p → q → p"), "{found:?}");
}
