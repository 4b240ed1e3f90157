//! Random files in random hands, read, edited and saved.

use std::path::Path;

use pelage_graph::{Graph, GraphNode, Literal, NodeId, Shape};
use proptest::prelude::*;

use super::fixture::registry;
use super::set;

/// Something to stand between two tokens.
fn space() -> impl Strategy<Value = String> {
    let one = prop_oneof![
        6 => Just(String::new()),
        6 => Just(" ".to_owned()),
        2 => Just("\n    ".to_owned()),
        1 => Just("\r\n\t".to_owned()),
        1 => Just(" /* a, b: \"c\" ) */ ".to_owned()),
        1 => Just(" // d, \"e\": (\n".to_owned()),
        1 => Just("/* /* f\n */ }*/\n".to_owned()),
        1 => Just("\n\n        ".to_owned()),
    ];
    prop::collection::vec(one, 0..3).prop_map(|parts| parts.concat())
}

/// A file of some nodes, with anything between its tokens, and commas at its ends or not.
fn file() -> impl Strategy<Value = String> {
    let tokens: Vec<&'static str> = vec![
        "Graph(",
        "version",
        ":",
        "1",
        ",",
        "title",
        ":",
        "\"t\"",
        ",",
        "nodes",
        ":",
        "{",
        "\"a\"",
        ":",
        "Constant(",
        "value",
        ":",
        "2",
        "?,",
        ")",
        ",",
        "\"b\"",
        ":",
        "Add(",
        "a",
        ":",
        "\"a.value\"",
        ",",
        "b",
        ":",
        "Some(",
        "\"a.value\"",
        "?,",
        ")",
        ",",
        "gain",
        ":",
        "0.5",
        "?,",
        ")",
        ",",
        "\"c\"",
        ":",
        "Constant",
        ",",
        "\"d\"",
        ":",
        "Join(",
        "parts",
        ":",
        "[",
        "\"s.text\"",
        ",",
        "\"s.text\"",
        "?,",
        "]",
        "?,",
        ")",
        ",",
        "\"s\"",
        ":",
        "Styled(",
        "style",
        ":",
        "Curly(",
        "turns",
        ":",
        "3",
        "?,",
        ")",
        ",",
        "toward",
        ":",
        "(",
        "0",
        ",",
        "1",
        ",",
        "0",
        "?,",
        ")",
        "?,",
        ")",
        "?,",
        "}",
        ",",
        "layout",
        ":",
        "{",
        "\"a\"",
        ":",
        "(",
        "1",
        ",",
        "2",
        "?,",
        ")",
        ",",
        "\"c\"",
        ":",
        "(",
        "3",
        ",",
        "4.5",
        "?,",
        ")",
        "?,",
        "}",
        "?,",
        ")",
    ];
    let count = tokens.len();
    (prop::collection::vec((space(), any::<bool>()), count + 1)).prop_map(move |spaces| {
        let mut text = String::new();
        for (token, (space, comma)) in tokens.iter().zip(&spaces) {
            // A comment may stand in a name's way to its bracket, but not in its middle.
            text += space;
            text += if *token == "?," { if *comma { "," } else { "" } } else { token };
        }
        text + &spaces[count].0
    })
}

/// A command, by numbers.
fn edit(graph: &mut Graph, (what, which, value): (u8, prop::sample::Index, i32)) {
    let registry = registry();
    let ids: Vec<String> = graph.nodes.keys().map(ToString::to_string).collect();
    if ids.is_empty() {
        return;
    }
    let id = ids[which.index(ids.len())].as_str();
    let number = || Some(Literal::from(value));
    let fields: Vec<String> = graph.nodes[id].fields.keys().cloned().collect();
    match what {
        0 => drop(graph.set_field(id, "value", number())),
        1 => drop(graph.set_field(id, "gain", number())),
        2 => fields.iter().take(1).for_each(|field| drop(graph.set_field(id, field, None))),
        3 => drop(graph.remove(&registry, id)),
        4 => drop(graph.rename(&registry, id, &format!("n{value}"))),
        5 => drop(graph.add(&format!("m{value}"), "Add")),
        6 => drop(graph.connect(&registry, "a.value", id, "a")),
        7 => drop(graph.connect(&registry, "s.text", id, "parts")),
        8 => drop(graph.move_to(id, f64::from(value), 0.5)),
        9 => graph.nodes.swap_indices(0, which.index(ids.len())),
        10 => drop(graph.set(&registry, &format!("{id}.style.radius"), "0.3", Path::new("."))),
        11 => graph.title = (value % 2 == 0).then(|| value.to_string()),
        12 => graph.output = (value % 2 == 0).then(|| format!("{id}.sum")),
        13 => drop(graph.layout.shift_remove(id)),
        14 => {
            let copy = graph.nodes[id].clone();
            drop(NodeId::new(&format!("k{value}")).map(|id| graph.nodes.insert(id, copy)));
        }
        15 => graph.nodes.reverse(),
        16 => drop(graph.set_field(id, "parts", Some(Shape::List(vec!["s.text".into(), "x.text".into(), "s.text".into()]).into()))),
        _ => drop(graph.nodes.insert(NodeId::new(id).unwrap_or_else(|| unreachable!()), GraphNode::new("Frame"))),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]
    #[test]
    fn any_file_that_was_only_read_is_saved_as_it_was(text in file()) {
        let graph = Graph::parse(&text).map_err(|faults| TestCaseError::fail(format!("{faults}\n{text}")))?;
        prop_assert!(graph.check(&registry()).is_ok());
        prop_assert_eq!(graph.to_ron(), text);
    }

    /// Whatever was changed, the saved file says so, saving it again changes nothing, and undoing gives the first bytes.
    #[test]
    fn any_edits_of_any_file_are_saved(text in file(), edits in prop::collection::vec((0_u8..18, any::<prop::sample::Index>(), 0..40), 1..8)) {
        let read = Graph::parse(&text).map_err(|faults| TestCaseError::fail(format!("{faults}\n{text}")))?;
        let mut graph = read.clone();
        for one in edits {
            edit(&mut graph, one);
            let saved = graph.to_ron();
            let again = Graph::parse(&saved).map_err(|faults| TestCaseError::fail(format!("{faults}\n{text}\n->\n{saved}")))?;
            prop_assert_eq!(&again, &graph, "{}\n->\n{}", text, saved);
            prop_assert_eq!(again.to_ron(), saved);
        }
        prop_assert_eq!(read.to_ron(), text);
    }

    /// A setting changes one run of bytes: what stands before and after it is as it was.
    #[test]
    fn one_setting_changes_one_place(text in file(), value in 3_i32..900) {
        let mut graph = Graph::parse(&text).map_err(|faults| TestCaseError::fail(format!("{faults}\n{text}")))?;
        set(&mut graph, "a.value", &value.to_string());
        let saved = graph.to_ron();
        let at = graph.nodes["a"].place.map(|place| (place.start, place.end)).unwrap();
        let (before, after) = (&text[..at.0], &text[at.1..]);
        prop_assert!(saved.starts_with(before) && saved.ends_with(after));
        let changed = &saved[before.len()..saved.len() - after.len()];
        // Within the node, too: all but the number.
        let (old, new) = (text[at.0..at.1].to_owned(), value.to_string());
        prop_assert!(old.match_indices('2').any(|(index, _)| changed == format!("{}{new}{}", &old[..index], &old[index + 1..])), "{old} -> {changed}");
    }
}
