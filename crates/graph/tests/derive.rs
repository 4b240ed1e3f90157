//! What the derives make of a struct, and what they refuse.

mod fixture;

use fixture::*;
use pelage_graph::{
    Arity, Context, Evaluate, Limits, Node, NodeError, Param, ParamType, PortType, Registry, node_markdown, reference_markdown,
};

#[test]
fn what_leaves_something_out_does_not_compile() {
    trybuild::TestCases::new().compile_fail("tests/refused/*.rs");
}

#[test]
fn a_struct_says_everything_about_its_node() {
    let registry = registry();
    let add = registry.specification("Add").unwrap();
    assert_eq!((add.doc.as_str(), add.category.as_str(), add.version), ("Adds numbers.", "Numbers", 1));
    assert_eq!((add.input("a").unwrap().arity, add.input("b").unwrap().arity), (Arity::One, Arity::Optional));
    assert_eq!(add.input("b").unwrap().doc, "Another number, if any.");
    let gain = add.param("gain").unwrap();
    assert_eq!(gain.ty, ParamType::Number { bits: 32 });
    assert_eq!(gain.range, Some(Limits { min: Some(0.0), max: Some(10.0), max_excluded: true }));
    assert_eq!((gain.unit.as_deref(), gain.effect.as_deref()), (Some("1"), Some("scales the result")));
    assert_eq!(add.output("sum").unwrap().ty, PortType { name: "f64".to_owned(), ..PortType::of::<f64>() });
    let styled = registry.specification("Styled").unwrap();
    assert_eq!(styled.version, 3);
    let defaults: Vec<String> = styled.params.iter().map(|param| format!("{}: {}", param.name, param.default.as_ref().unwrap())).collect();
    assert_eq!(
        defaults.join(", "),
        "style: Straight, toward: (0.0, -0.3, -1.0), colour: (1.0, 0.9, 0.8), size: (960, 720), pins: [], limit: None, seed: 7, \
         flipped: false, name: \"fur\""
    );
    assert_eq!(registry.specification("Frame").unwrap().context, ["frame"]);
    assert!(registry.specification("ReadText").unwrap().param("path").unwrap().default.is_none());
}

#[test]
fn parameters_write_themselves_as_they_are_read() {
    let curly = Style::Curly { radius: 0.1, turns: 3.0 };
    assert_eq!(curly.to_literal().to_string(), "Curly(radius: 0.1, turns: 3.0)");
    assert_eq!(Style::from_literal(&curly.to_literal()).unwrap(), curly);
    assert_eq!(Style::from_literal(&Style::Straight.to_literal()).unwrap(), Style::Straight);
    let pin = Pin { at: [0.0, 1.0, 2.0], toward: [1.0, 0.0, 0.0] };
    assert_eq!(Pin::from_literal(&pin.to_literal()).unwrap(), pin);
    assert_eq!(0.1_f32.to_literal().to_string(), "0.1");
    assert!(u32::from_literal(&(-1_i64).into()).is_err());
    assert_eq!(Option::<u32>::from_literal(&3_u32.into()).unwrap(), Some(3));
}

#[test]
fn what_a_run_touches_may_be_shared_between_threads() {
    fn shared<T: Send + Sync>() {}
    shared::<Registry>();
    shared::<pelage_graph::CheckedGraph>();
    shared::<pelage_graph::Graph>();
    shared::<pelage_graph::Value>();
    shared::<pelage_graph::Evaluation>();
    shared::<pelage_graph::EvaluateError>();
    shared::<pelage_graph::Evaluator>();
    shared::<pelage_graph::Request>();
}

#[test]
fn the_test_nodes_are_in_order() {
    registry().validate().unwrap();
}

/// A node that keeps the compiler content and a reader not.
#[derive(Node)]
#[node(category = "Test", name = "Sloppy")]
#[output(block: Block, "Some bytes.")]
struct Sloppy {
    /// Has no range and says nothing of its effect.
    #[param(default = 1.0, unit = "metres")]
    width: f64,
    /// Has a default that only a run can tell.
    #[param(default = one() * 5.0, range = 0.0..=1.0, unit = "metres", effect = "wider")]
    height: f64,
}

fn one() -> f64 {
    1.0
}

impl Evaluate for Sloppy {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(Block(vec![0; (self.width * self.height) as usize]).into())
    }
}

#[test]
fn validation_finds_what_the_compiler_cannot() {
    let faults = Registry::new().node::<Sloppy>().node::<Sloppy>().validate().unwrap_err().to_string();
    assert_eq!(
        faults,
        "Sloppy: registered twice\n\
         Sloppy.block: its type Block is not registered; add .value::<Block>(…)\n\
         Sloppy.width: a number without a range\n\
         Sloppy.width: a number that does not say what turning it does: add effect = \"…\"\n\
         Sloppy.height: its default does not fit: 5.0 is out of range: expected 0 to 1 (metres)"
    );
    let faults = Registry::new().value::<Block>("f64", |block| block.0.len()).validate().unwrap_err().to_string();
    assert_eq!(faults, "f64: registered twice");
}

#[test]
fn a_type_may_be_named_before_or_after_its_nodes() {
    let name = |registry: &Registry| registry.specification("Fill").unwrap().output("block").unwrap().ty.name.clone();
    let after = Registry::new().node::<Fill>().value::<Block>("Bytes", |block| block.0.len());
    let before = Registry::new().value::<Block>("Bytes", |block| block.0.len()).node::<Fill>();
    assert_eq!((name(&after), name(&before)), ("Bytes".to_owned(), "Bytes".to_owned()));
}

#[test]
fn specifications_are_json() {
    let registry = registry();
    let json = serde_json::to_value(registry.specification("Add").unwrap()).unwrap();
    assert_eq!(
        json,
        serde_json::json!({
            "kind": "Add", "doc": "Adds numbers.", "category": "Numbers", "version": 1, "context": [],
            "inputs": [
                {"name": "a", "doc": "One number.", "type": "f64", "arity": "one"},
                {"name": "b", "doc": "Another number, if any.", "type": "f64", "arity": "optional", "was": ["other"]},
            ],
            "params": [
                {"name": "gain", "doc": "Scales the sum.", "type": {"number": {"bits": 32}}, "default": "1.0",
                 "range": {"min": 0.0, "max": 10.0, "max_excluded": true}, "unit": "1", "effect": "scales the result"},
                {"name": "times", "doc": "Adds it so often.", "type": {"integer": {"min": 0, "max": u32::MAX}}, "default": "1",
                 "range": {"min": 1.0, "max": 100.0, "max_excluded": false}, "unit": "times", "effect": "scales the result", "was": ["often"]},
            ],
            "outputs": [{"name": "sum", "doc": "The sum.", "type": "f64"}],
        })
    );
    let all: Vec<_> = registry.specifications().collect();
    assert!(serde_json::to_string(&all).unwrap().contains("\"Curly\""));
}

#[test]
fn the_reference_lists_every_field_by_category() {
    let text = reference_markdown(&registry());
    let headings: Vec<&str> = text.lines().filter(|line| line.starts_with('#')).collect();
    assert_eq!(
        headings,
        [
            "# Node reference",
            "## Numbers",
            "### Constant",
            "### Add",
            "### Frame",
            "### Halves",
            "### Fail",
            "## Texts",
            "### ReadText",
            "### Join",
            "### Styled",
            "## Blocks",
            "### Fill",
        ]
    );
    let styled = node_markdown(registry().specification("Styled").unwrap());
    assert!(styled.contains("| `style.radius` | `0.02` | 0 to 0.5 | lengths | Radius of the helix. *wider* |"), "{styled}");
    for specification in registry().specifications() {
        for name in specification.field_names() {
            assert!(node_markdown(specification).contains(&format!("| `{name}` | ")));
        }
    }
}
