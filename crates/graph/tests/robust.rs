//! No input panics, and what is saved is read again.

mod fixture;

use fixture::registry;
use pelage_graph::{Evaluator, Graph, Literal, Name, Request, Shape};
use proptest::prelude::*;

const VALID: &str = r##"// A comment.
Graph(
    version: 1, /* another */
    nodes: {
        "two": Constant(value: 2e0),
        "x": Add(a: "two.value", b: Some("two.value"), gain: 0x1, times: 1_0),
        "read": ReadText(path: r#"a"b.txt"#),
        "styled": Styled(style: Curly(radius: .1), name: "\u{e9}\"", pins: [(at: (0, 1.5, -2))], limit: Some(3)),
        "joined": Join(parts: ["read.text", "styled.text",], separator: Link("read.text")),
        "é": Constant,
    },
    output: "joined.text",
    layout: { "two": (40, 60.5) },
)
"##;

/// Does all that can be done with a text; says whether it was without fault.
fn exercise(text: &str) -> bool {
    let Ok(graph) = Graph::parse(text) else { return false };
    let saved = graph.to_ron();
    let again = Graph::parse(&saved).map(|again| again.to_ron());
    assert_eq!(again.as_ref(), Ok(&saved), "saving is stable");
    let Ok(checked) = graph.check(&registry()) else { return false };
    assert_eq!(Graph::parse(&saved).as_ref(), Ok(&graph));
    let _ = Evaluator::new(1000).run(&checked, &Request::main().with_context("frame", 1_i64));
    true
}

#[test]
fn every_prefix_of_a_valid_file_is_answered() {
    assert!(exercise(VALID));
    let whole = VALID.trim_end().len();
    for end in (0..whole).filter(|&end| VALID.is_char_boundary(end)) {
        let faults = Graph::parse(&VALID[..end]).expect_err("a prefix is no graph");
        assert!(faults.iter().all(|fault| fault.place.is_some()), "{faults}");
    }
}

#[test]
fn every_file_with_one_byte_changed_is_answered() {
    for at in 0..VALID.len() {
        for byte in *b"\0\"({:,/N" {
            let mut bytes = VALID.as_bytes().to_vec();
            bytes[at] = byte;
            if let Ok(text) = String::from_utf8(bytes) {
                exercise(&text);
            }
        }
    }
}

/// Words of the language, and of the test nodes.
fn token() -> impl Strategy<Value = String> {
    let words: Vec<&'static str> =
        "Graph version nodes layout output Constant Add Styled Curly Some None Link true inf NaN ( ) { } [ ] : , \"a\" \"b\" \
        \"a.value\" \"b.sum\" value a b gain style radius 1 0 -1 2.5 1e400 99999999999999999999999 r# r\" // /* */ # ! .. ..= ' \\ \u{e9}"
            .split(' ')
            .collect();
    prop::sample::select(words).prop_map(|word| format!("{word} "))
}

fn name() -> impl Strategy<Value = String> {
    prop_oneof![Just("true".to_owned()), Just("r".to_owned()), Just("b".to_owned()), Just("Some".to_owned()), "[a-zA-Z_][a-zA-Z0-9_]{0,6}"]
}

fn literal() -> impl Strategy<Value = Literal> {
    let leaf = prop_oneof![
        any::<bool>().prop_map(Shape::Bool),
        any::<i64>().prop_map(|value| Shape::Integer(value.into())),
        any::<u64>().prop_map(|value| Shape::Integer(value.into())),
        any::<f64>().prop_filter("NaN is not equal to itself", |value| !value.is_nan()).prop_map(Shape::Number),
        any::<String>().prop_map(Shape::Text),
        Just(Shape::Absent),
        name().prop_map(Shape::Word),
    ];
    leaf.prop_map(Literal::from).prop_recursive(4, 24, 4, |inner| {
        let items = prop::collection::vec(inner.clone(), 0..4);
        let fields = prop::collection::vec((name(), inner.clone()), 1..4);
        let named = |fields: Vec<(String, Literal)>| fields.into_iter().map(|(text, value)| (Name { text, place: None }, value)).collect();
        prop_oneof![
            inner.clone().prop_map(|inner| Shape::Present(Box::new(inner))),
            items.clone().prop_map(Shape::Tuple),
            items.clone().prop_map(Shape::List),
            prop::collection::vec((inner.clone(), inner), 0..3).prop_map(Shape::Map),
            (name(), items).prop_map(|(name, items)| Shape::Call(name, items)),
            (prop::option::of(name()), fields).prop_map(move |(name, fields)| Shape::Record(name, named(fields))),
        ]
        .prop_map(Literal::from)
    })
}

/// A node of a random kind, its fields linked anywhere or given anything.
fn node(count: usize) -> impl Strategy<Value = String> {
    let link = (0..count + 1, prop::sample::select(vec!["value", "sum", "text", "left", "right", "frame", "nothing"]))
        .prop_map(|(node, port)| format!("\"n{node}.{port}\""));
    let value = prop_oneof![
        4 => link.clone(),
        1 => (-5_i64..50).prop_map(|value| value.to_string()),
        1 => literal().prop_map(|literal| literal.to_string()),
        1 => prop::collection::vec(link, 0..3).prop_map(|links| format!("[{}]", links.join(", "))),
    ];
    let kinds: Vec<(&'static str, Vec<&'static str>)> = vec![
        ("Constant", vec!["value"]),
        ("Add", vec!["a", "b", "gain", "times"]),
        ("Join", vec!["parts", "separator"]),
        ("Styled", vec!["style", "seed", "limit", "flipped", "name"]),
        ("Frame", vec![]),
        ("Halves", vec!["left_from", "right_from", "both"]),
        ("Fail", vec![]),
        ("Unknown", vec!["x"]),
    ];
    prop::sample::select(kinds).prop_flat_map(move |(kind, fields)| {
        let fields: Vec<_> =
            fields.into_iter().map(|field| prop::option::weighted(0.6, value.clone()).prop_map(move |value| (field, value))).collect();
        fields.prop_map(move |fields| {
            let given: Vec<String> =
                fields.into_iter().filter_map(|(field, value)| value.map(|value| format!("{field}: {value}"))).collect();
            format!("{kind}({})", given.join(", "))
        })
    })
}

fn graph_text() -> impl Strategy<Value = String> {
    (1_usize..8).prop_flat_map(|count| {
        (prop::collection::vec(node(count), count), 0..count, prop::sample::select(vec!["sum", "text", "value", "left"])).prop_map(
            |(nodes, output, port)| {
                let nodes: Vec<String> = nodes.into_iter().enumerate().map(|(index, node)| format!("\"n{index}\": {node},\n")).collect();
                format!("Graph(version: 1, nodes: {{\n{}}}, output: \"n{output}.{port}\")", nodes.concat())
            },
        )
    })
}

/// Graphs that have no fault: each number drawn from earlier ones.
fn sound_graph() -> impl Strategy<Value = String> {
    prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 1_u32..4, any::<bool>()), 1..20).prop_map(|adds| {
        let mut text = "Graph(version: 1, nodes: {\"n0\": Add(a: \"c.value\"), \"c\": Constant(value: 1),\n".to_owned();
        for (index, (a, b, times, both)) in adds.iter().enumerate() {
            let (a, b) = (a.index(index + 1), b.index(index + 1));
            let b = if *both { format!(", b: \"n{b}.sum\"") } else { String::new() };
            text += &format!("\"n{}\": Add(a: \"n{a}.sum\"{b}, times: {times}),\n", index + 1);
        }
        text + &format!("}}, output: \"n{}.sum\")", adds.len())
    })
}

proptest! {
    #[test]
    fn random_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        exercise(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn random_words_do_not_panic(tokens in prop::collection::vec(token(), 0..60)) {
        exercise(&tokens.concat());
        exercise(&format!("Graph(version: 1, nodes: {{\"a\": Styled({})}})", tokens.concat()));
    }

    #[test]
    fn any_literal_is_written_so_that_it_reads_the_same(literal in literal()) {
        let text = format!("Graph(version: 1, nodes: {{\"a\": Foreign(field: {literal})}})");
        let graph = Graph::parse(&text).map_err(|faults| TestCaseError::fail(format!("{faults}: {text}")))?;
        prop_assert_eq!(&graph.nodes["a"].fields["field"], &literal);
        prop_assert!(graph.to_ron().contains(&literal.to_string()));
    }

    #[test]
    fn random_graphs_do_not_panic(text in graph_text()) {
        exercise(&text);
    }

    #[test]
    fn random_settings_do_not_panic(
        target in "(two|x|styled|joined|q)\\.(value|a|style|style.radius|name|pins|parts|toward)(\\.x)?",
        value in prop_oneof![literal().prop_map(|l| l.to_string()), any::<String>()],
    ) {
        let mut graph = Graph::parse(VALID).unwrap();
        if graph.set(&registry(), &target, &value, std::path::Path::new("")).is_ok() {
            exercise(&graph.to_ron());
        }
    }

    /// A cold run and one beside a cache of any size give the same; so does the file saved and read, its nodes in any order.
    #[test]
    fn neither_cache_nor_order_nor_saving_changes_a_result(text in sound_graph(), budget in 0_usize..2000) {
        let graph = Graph::parse(&text).unwrap();
        let run = |graph: &Graph, evaluator: &mut Evaluator| {
            *evaluator.run(&graph.check(&registry()).unwrap(), &Request::main()).unwrap().main::<f64>().unwrap()
        };
        let expected = run(&graph, &mut Evaluator::new(0));
        let mut evaluator = Evaluator::new(budget);
        let mut other = Graph::parse(&graph.to_ron()).unwrap();
        prop_assert_eq!(&other, &graph);
        other.nodes.reverse();
        prop_assert_eq!(run(&graph, &mut evaluator), expected);
        prop_assert_eq!(run(&other, &mut evaluator), expected);
        prop_assert_eq!(run(&graph, &mut evaluator), expected);
        prop_assert!(evaluator.cache().bytes <= budget);
    }
}
