//! Files of older versions are read, evaluated, and saved as the present one; kinds and fields may go by what they were called before.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

mod fixture;

use std::path::{Path, PathBuf};

use fixture::{checked, registry};
use pelage_graph::{Evaluator, Graph, Registry, Request};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/versions").join(name)
}

#[test]
fn a_file_of_version_0_is_read_evaluated_and_saved_as_the_present_one() {
    let graph = Graph::read(&file("0.ron")).unwrap();
    let request = Request::output("sum.sum").and_output("joined.text");
    let evaluation = Evaluator::new(0).run(&graph.check(&registry()).unwrap(), &request).unwrap();
    assert_eq!(*evaluation.main::<f64>().unwrap(), 12.0);
    assert!(evaluation.get::<String>("joined.text").unwrap().contains("Curly { radius: 0.1, turns: 2.0 }"));
    // What the versions have in common stays as it is; within a node its values do, and the new form is in the style of the old.
    let saved = graph.to_ron();
    assert_eq!(saved, std::fs::read_to_string(file("0-saved.ron")).unwrap());
    let again = Graph::parse(&saved).unwrap();
    assert_eq!((&again, again.to_ron()), (&graph, saved), "and from then on nothing changes");
}

#[test]
fn a_fault_of_an_old_file_is_answered_with_its_line() {
    let text = std::fs::read_to_string(file("0.ron")).unwrap();
    for (old, new, said) in [
        ("value: 2e0", "value: 2e9", "7:52: node \"two\", value: 2000000000.0 is out of range: expected -1000 to 1000 (1)"),
        ("often: 0x3", "offen: 0x3", "14:22: node \"sum\": Add has no field \"offen\"; expected one of a, b, gain, times"),
        ("\"Number\"", "\"Nubmer\"", "7:19: node \"two\": unknown kind of node Nubmer"),
        ("a: (\"two\"", "a: (\"tow\"", "11:20: node \"sum\", a: there is no node \"tow\""),
        ("output: (\"sum\"", "output: (\"mus\"", "19:13: output: there is no node \"mus\""),
        ("kind: \"Add\"", "kin: \"Add\"", "8:19: node \"sum\": expected a node, Kind(field: value), found a record of 3"),
        ("inputs: ()", "imputs: ()", "16:36: node \"styled\": Styled has no field \"imputs\""),
    ] {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        let faults = Graph::parse(&text.replace(old, new)).unwrap().check(&registry()).unwrap_err().to_string();
        assert!(faults.starts_with(said), "{faults}\n{said}");
    }
}

#[test]
fn an_older_file_may_say_things_the_present_way() {
    let text = r#"Graph(version: 0, nodes: {"c": Constant(value: 2), "x": (kind: "Add", inputs: (a: "c.value"))}, output: "x.sum")"#;
    assert_eq!(*Evaluator::new(0).run(&checked(text), &Request::main()).unwrap().main::<f64>().unwrap(), 2.0);
    assert!(Graph::parse(text).unwrap().to_ron().contains("version: 1"));
}

#[test]
fn former_names_are_understood_and_stay_until_they_are_changed() {
    let text = "Graph(version: 1, nodes: {\n    \"c\": Number(value: 2), /* c */\n    \"x\": Add(a: \"c.value\", often: 4, other: \"c.value\"),\n}, output: \"x.sum\")";
    let mut graph = Graph::parse(text).unwrap();
    let sum = |graph: &Graph| *Evaluator::new(0).run(&graph.check(&registry()).unwrap(), &Request::main()).unwrap().main::<f64>().unwrap();
    assert_eq!(sum(&graph), 16.0);
    assert_eq!(graph.to_ron(), text);
    graph.rename(&registry(), "c", "d").unwrap();
    graph.set(&registry(), "x.times", "5", Path::new("")).unwrap();
    graph.connect(&registry(), "d.value", "x", "b").unwrap();
    let expected = text.replace("c.value", "d.value").replace("\"c\"", "\"d\"").replace("often: 4", "times: 5").replace("other", "b");
    assert_eq!((graph.to_ron(), sum(&graph)), (expected, 20.0));
    let faults = Graph::parse(&text.replace("often: 4", "often: 4, times: 4")).unwrap().check(&registry()).unwrap_err();
    assert_eq!(faults.to_string(), "3:28: node \"x\": the field \"times\" is given twice; remove one");
}

#[test]
fn a_former_name_that_is_taken_is_a_fault_of_the_registry() {
    /// A number.
    #[derive(pelage_graph::Node)]
    #[node(category = "Numbers", was("Constant"))]
    #[output(value: f64, "The number.")]
    struct Other {
        /// A number.
        #[param(default = 0.0, range = 0.0..=1.0, unit = "1", effect = "none", was("b"))]
        a: f64,
        /// Another.
        #[param(default = 0.0, range = 0.0..=1.0, unit = "1", effect = "none")]
        b: f64,
    }
    impl pelage_graph::Evaluate for Other {
        fn evaluate(&self, _: &mut pelage_graph::Context<'_>) -> Result<Self::Outputs, pelage_graph::NodeError> {
            Ok((self.a + self.b).into())
        }
    }
    let faults = Registry::new().node::<fixture::Constant>().node::<Other>().validate().unwrap_err().to_string();
    assert!(faults.contains("Constant is the name of a kind") && faults.contains("two fields are called \"b\""), "{faults}");
}

/// Found by fuzzing: the kind was written as a name, which no file can hold.
#[test]
fn a_kind_that_is_no_name_is_a_fault_and_stays_a_text() {
    for kind in ["All\u{14}\0", "", "A b", "Add(", "Add(a: 1), //"] {
        let text = format!("Graph(version: 0, nodes: {{ \"a\": (kind: {kind:?}) }})");
        let graph = Graph::parse(&text).unwrap();
        let saved = graph.to_ron();
        assert_eq!(Graph::parse(&saved).map(|again| again.to_ron()).as_ref(), Ok(&saved), "{kind:?}");
        assert!(graph.check(&registry()).unwrap_err().to_string().contains("expected a node"), "{kind:?}");
    }
}
