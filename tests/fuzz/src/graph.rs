//! Reading, checking and saving of graphs.

use std::sync::Arc;

use pelage_graph::{Context, Evaluate, Graph, GraphNode, Literal, Node, NodeError, NodeId, Param, Registry};

/// Any bytes are a graph file or not; if they are, it is checked without a panic, and saved as the bytes that were read. A sound one that was changed is
/// saved as a file that says the change.
pub fn graph(bytes: &[u8]) {
    let Some((text, read)) = std::str::from_utf8(bytes).ok().and_then(|text| Some((text, Graph::parse(text).ok()?))) else { return };
    let saved = read.to_ron();
    if is_present(text) {
        assert_eq!(saved, text, "saving changed what nobody changed");
    }
    assert_eq!(Graph::parse(&saved).map(|again| again.to_ron()).as_ref(), Ok(&saved), "saving is not stable");
    let registry = registry();
    if read.check(&registry).is_err() {
        return;
    }
    assert_eq!(Graph::parse(&saved).as_ref(), Ok(&read), "it is saved as another graph");
    for (name, edit) in EDITS {
        for id in read.nodes.keys().take(4) {
            let mut graph = read.clone();
            edit(&mut graph, &registry, id);
            assert_eq!(Graph::parse(&graph.to_ron()).as_ref(), Ok(&graph), "after {name} of {id} it is saved as another graph");
        }
    }
}

/// Whether the file is surely of the present version: older ones are saved in its form. Where the word stands a second time, as
/// it may in a text or a comment, that is left open.
fn is_present(text: &str) -> bool {
    text.matches("version").count() == 1 && text.contains("version: 1,")
}

type Edit = fn(&mut Graph, &Registry, &NodeId);

const EDITS: [(&str, Edit); 6] = [
    ("a rename", |graph, registry, id| drop(graph.rename(registry, id.as_str(), "renamed"))),
    ("a move", |graph, _, id| drop(graph.move_to(id.as_str(), 12.0, 0.5))),
    ("a removal", |graph, registry, id| drop(graph.remove(registry, id.as_str()))),
    ("a setting", |graph, _, id| drop(graph.set_field(id.as_str(), "amount", Some(Literal::from(7_i64))))),
    ("a link", |graph, registry, id| drop(graph.connect(registry, "renamed.words", id.as_str(), "parts"))),
    ("a replacement", |graph, _, id| drop(graph.nodes.insert(id.clone(), GraphNode::new("Everything")))),
];

/// One node with every kind of field, so that a file of any shape can be sound.
fn registry() -> Registry {
    Registry::new().node::<Everything>()
}

/// A shape with fields of its own, or without.
#[derive(Clone, Debug, PartialEq, Param)]
enum Form {
    /// Without.
    Plain,
    /// With one.
    Round {
        /// How far it reaches.
        #[param(default = 0.5, range = 0.0..=1.0, unit = "metres", effect = "larger")]
        radius: f64,
    },
}

/// Takes all that a field can hold.
#[derive(Node)]
#[node(category = "Test", version = 2, was("All"))]
#[output(words: String, "Its parameters in words.")]
struct Everything {
    /// One text.
    #[input]
    first: Option<Arc<String>>,
    /// Many texts.
    #[input(was("items"))]
    parts: Vec<Arc<String>>,
    /// A number.
    #[param(default = 1.0, range = -1e9..=1e9, unit = "1", effect = "is said", was("much"))]
    amount: f64,
    /// A shape.
    #[param(default = Form::Plain)]
    form: Form,
    /// A text that may be linked.
    #[param(default = "name")]
    name: String,
    /// A pair.
    #[param(default = (1, 2), range = 0..=99, unit = "pixels")]
    pair: (u32, u32),
    /// A number that may be left out.
    #[param(range = 1..=100, unit = "steps", effect = "is said")]
    limit: Option<u32>,
    /// A switch.
    #[param(default = false)]
    flag: bool,
}

impl Evaluate for Everything {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let Self { first, parts, amount, form, name, pair, limit, flag } = self;
        Ok(format!("{first:?} {parts:?} {amount} {form:?} {name} {pair:?} {limit:?} {flag}").into())
    }
}
