//! Parts of a value: made where a reader wants them, and only there.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

use std::sync::{Arc, Mutex};

use pelage_graph::{
    Context, Evaluate, Evaluation, Evaluator, Graph, Key, Needs, Node, NodeError, Params, Part, Registry, Request, State, TraceEntry,
    Wanted,
};

const LEFT: Part = Part { name: "left", doc: "The left side." };
const RIGHT: Part = Part { name: "right", doc: "The right side." };

/// A value of two parts.
#[derive(Debug, PartialEq)]
struct Sides {
    left: Option<f64>,
    right: Option<f64>,
}

/// Which nodes ran.
#[derive(Default)]
struct Runs(Mutex<Vec<String>>);

fn note(cx: &Context<'_>) {
    if let Ok(runs) = cx.resource::<Runs>() {
        runs.0.lock().unwrap().push(cx.node().to_string());
    }
}

/// A number.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "The number.")]
struct Number {
    /// The number.
    #[param(default = 0.0, range = -1000.0..=1000.0, unit = "1", effect = "is the result")]
    value: f64,
}

impl Evaluate for Number {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        note(cx);
        Ok(self.value.into())
    }
}

/// Puts two sides together.
#[derive(Node)]
#[node(category = "Test")]
#[output(sides: Sides, "Both.", parts = [LEFT, RIGHT])]
struct Gather {
    /// One side.
    #[input(required)]
    left: Option<Arc<f64>>,
    /// The other.
    #[input]
    right: Option<Arc<f64>>,
}

impl Evaluate for Gather {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        note(cx);
        let side = |part, from: &Option<Arc<f64>>| from.as_deref().copied().filter(|_| cx.wants_part("sides", part));
        Ok(Sides { left: side(LEFT, &self.left), right: side(RIGHT, &self.right) }.into())
    }

    fn needs(wanted: &Wanted<'_>, params: &Params<'_>) -> Needs {
        let mut needs = Needs::all();
        if !wanted.part(LEFT) {
            needs = needs.without("left");
        }
        if !wanted.part(RIGHT) {
            needs = needs.without("right");
        }
        if params.is_linked("right") { needs } else { needs.absent(RIGHT) }
    }
}

/// Cuts a number in two; it takes nothing more to make both sides than to make one.
#[derive(Node)]
#[node(category = "Test")]
#[output(sides: Sides, "Both.", parts = [LEFT, RIGHT])]
struct Halve {
    /// The number.
    #[param(default = 8.0, range = -1000.0..=1000.0, unit = "1", effect = "is the sum")]
    value: f64,
    /// Whether the right comes with the left.
    #[param(default = false)]
    joined: bool,
}

impl Evaluate for Halve {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        note(cx);
        let [left, right] = [LEFT, RIGHT].map(|part| cx.wants_part("sides", part));
        let side = |made: bool| made.then_some(0.5 * self.value);
        Ok(Sides { left: side(left), right: side(right || self.joined && left) }.into())
    }

    fn needs(wanted: &Wanted<'_>, params: &Params<'_>) -> Needs {
        let joined = params.get::<bool>("joined").unwrap_or(true);
        if joined && wanted.part(LEFT) { Needs::all().present(RIGHT) } else { Needs::all() }
    }
}

/// Hands on what is wanted.
#[derive(Node)]
#[node(category = "Test")]
#[output(sides: Sides, "The same.", parts = [RIGHT, LEFT])]
struct Pass {
    /// What is handed on.
    #[input]
    sides: Arc<Sides>,
}

impl Evaluate for Pass {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        note(cx);
        Ok(Arc::clone(&self.sides).into())
    }

    fn needs(wanted: &Wanted<'_>, _: &Params<'_>) -> Needs {
        Needs::all().parts("sides", wanted.parts())
    }
}

/// Adds up some sides.
#[derive(Node)]
#[node(category = "Test")]
#[output(sum: f64, "The sum.")]
struct Sum {
    /// Of these.
    #[input]
    of: Vec<Arc<Sides>>,
    /// Whether the left sides count.
    #[param(default = true)]
    left: bool,
    /// Whether the right sides count.
    #[param(default = true)]
    right: bool,
}

impl Evaluate for Sum {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        note(cx);
        let side = |counts: bool, side: Option<f64>| if counts { side.unwrap_or(-1000.0) } else { 0.0 };
        Ok(self.of.iter().map(|sides| side(self.left, sides.left) + side(self.right, sides.right)).sum::<f64>().into())
    }

    fn needs(_: &Wanted<'_>, params: &Params<'_>) -> Needs {
        let counts = |name| params.get::<bool>(name).unwrap_or(true);
        Needs::all().parts("of", [(LEFT, "left"), (RIGHT, "right")].into_iter().filter(|(_, name)| counts(name)).map(|(part, _)| part))
    }
}

/// Says yes or no.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: bool, "The answer.")]
struct Answer {
    /// The answer.
    #[param(default = false)]
    value: bool,
}

impl Evaluate for Answer {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(self.value.into())
    }
}

fn registry() -> Registry {
    Registry::new()
        .value::<Sides>("Sides", |_| size_of::<Sides>())
        .node::<Number>()
        .node::<Gather>()
        .node::<Halve>()
        .node::<Pass>()
        .node::<Sum>()
        .node::<Answer>()
}

/// Two readers of one value, each of another side, and one of both.
const GRAPH: &str = r#"Graph(version: 1, nodes: {
    "l": Number(value: 1), "r": Number(value: 20),
    "both": Gather(left: "l.value", right: "r.value"),
    "passed": Pass(sides: "both.sides"),
    "lefts": Sum(of: ["passed.sides"], right: false),
    "rights": Sum(of: ["both.sides"], left: false),
    "all": Sum(of: ["both.sides", "passed.sides"]),
})"#;

fn run(evaluator: &mut Evaluator, text: &str, request: &Request) -> Evaluation {
    let registry = registry();
    registry.validate().unwrap();
    evaluator.run(&Graph::parse(text).unwrap().check(&registry).unwrap(), request).unwrap()
}

/// An engine that notes what runs.
fn counting() -> Evaluator {
    Evaluator::new(1 << 20).threads(1).resource(|| Ok::<_, NodeError>(Runs::default()))
}

fn ran(evaluator: &Evaluator) -> Vec<String> {
    std::mem::take(&mut *evaluator.resources().get::<Runs>().unwrap().0.lock().unwrap())
}

fn entry<'e>(evaluation: &'e Evaluation, node: &str) -> &'e TraceEntry {
    evaluation.trace().iter().find(|entry| entry.node.as_str() == node).unwrap()
}

/// The parts of a node that were made, and those left out.
fn parts(evaluation: &Evaluation, node: &str) -> (Vec<&'static str>, Vec<&'static str>) {
    let names = |parts: &[Part]| parts.iter().map(|part| part.name).collect();
    let [parts] = &entry(evaluation, node).parts[..] else { return (Vec::new(), Vec::new()) };
    (names(&parts.made), names(&parts.left_out))
}

fn key(evaluation: &Evaluation, node: &str) -> Key {
    entry(evaluation, node).keys[0].1
}

#[test]
fn a_part_that_no_reader_wants_is_not_made() {
    let mut evaluator = counting();
    let evaluation = run(&mut evaluator, GRAPH, &Request::output("lefts.sum").with_all_values());
    assert_eq!((*evaluation.main::<f64>().unwrap(), ran(&evaluator)), (1.0, ["l", "both", "passed", "lefts"].map(str::to_owned).to_vec()));
    assert_eq!(*evaluation.get::<Sides>("both.sides").unwrap(), Sides { left: Some(1.0), right: None });
    assert_eq!(parts(&evaluation, "both"), (vec!["left"], vec!["right"]));
    assert_eq!(parts(&evaluation, "passed"), (vec!["left"], vec!["right"]), "whatever the order in which it declares them");
    assert_eq!((entry(&evaluation, "r").state, entry(&evaluation, "r").keys.len()), (State::NotNeeded, 0));
    // So nothing depends on it either.
    run(&mut evaluator, &GRAPH.replace("20", "30"), &Request::output("lefts.sum"));
    assert!(ran(&evaluator).is_empty());
}

#[test]
fn of_two_readers_each_has_what_it_wants_of_one_value() {
    let mut evaluator = counting();
    let request = Request::output("lefts.sum").and_output("rights.sum").with_all_values();
    let evaluation = run(&mut evaluator, GRAPH, &request);
    assert_eq!((*evaluation.get::<f64>("lefts.sum").unwrap(), *evaluation.get::<f64>("rights.sum").unwrap()), (1.0, 20.0));
    assert_eq!(ran(&evaluator), ["l", "r", "both", "passed", "lefts", "rights"]);
    assert_eq!(parts(&evaluation, "both"), (vec!["left", "right"], vec![]));
    assert_eq!(parts(&evaluation, "passed"), (vec!["left"], vec!["right"]), "what the one reads is not made for the other");
}

#[test]
fn what_a_reader_depends_on_is_what_it_reads() {
    let mut evaluator = counting();
    let alone = run(&mut evaluator, GRAPH, &Request::output("lefts.sum"));
    ran(&evaluator);
    // Another who reads more makes no difference to the one who reads less: its value is at hand.
    let beside = run(&mut evaluator, GRAPH, &Request::output("lefts.sum").and_output("all.sum"));
    assert_eq!(*beside.get::<f64>("all.sum").unwrap(), 42.0);
    assert_eq!(ran(&evaluator), ["r", "both", "passed", "all"]);
    assert_eq!(key(&alone, "lefts"), key(&beside, "lefts"));
    // Nor does what only the other depends on.
    let changed = run(&mut evaluator, &GRAPH.replace("20", "30"), &Request::output("lefts.sum").and_output("all.sum"));
    assert_eq!((*changed.get::<f64>("lefts.sum").unwrap(), *changed.get::<f64>("all.sum").unwrap()), (1.0, 62.0));
    assert_eq!((key(&changed, "lefts"), entry(&changed, "lefts").state), (key(&alone, "lefts"), State::Hit));
    assert_ne!(key(&changed, "all"), key(&beside, "all"));
}

#[test]
fn a_value_with_fewer_parts_is_never_there_for_who_wants_more() {
    let mut evaluator = counting();
    let few = run(&mut evaluator, GRAPH, &Request::output("lefts.sum"));
    ran(&evaluator);
    let more = run(&mut evaluator, GRAPH, &Request::output("all.sum"));
    assert_eq!((*more.main::<f64>().unwrap(), ran(&evaluator)), (42.0, ["r", "both", "passed", "all"].map(str::to_owned).to_vec()));
    assert_ne!(key(&few, "both"), key(&more, "both"));
    // And both are at hand from then on.
    for output in ["lefts.sum", "all.sum"] {
        run(&mut evaluator, GRAPH, &Request::output(output));
    }
    assert!(ran(&evaluator).is_empty());
    // The same where all are made of the same.
    let text = GRAPH.replace("Gather(left: \"l.value\", right: \"r.value\")", "Halve()");
    let sum = |evaluator: &mut Evaluator, output: &str| *run(evaluator, &text, &Request::output(output)).main::<f64>().unwrap();
    assert_eq!(["lefts.sum", "rights.sum", "all.sum"].map(|output| sum(&mut evaluator, output)), [4.0, 4.0, 16.0]);
}

#[test]
fn who_asks_for_an_output_has_it_whole_unless_it_is_to_be_as_it_is_on_the_way() {
    let mut evaluator = counting();
    let sides = |evaluation: &Evaluation| {
        (evaluation.get::<Sides>("both.sides").unwrap().left, evaluation.get::<Sides>("both.sides").unwrap().right)
    };
    let asked = run(&mut evaluator, GRAPH, &Request::output("both.sides"));
    assert_eq!((sides(&asked), parts(&asked, "both")), ((Some(1.0), Some(20.0)), (vec!["left", "right"], vec![])));
    let beside = run(&mut evaluator, GRAPH, &Request::output("lefts.sum").and_output("both.sides"));
    assert_eq!(sides(&beside), (Some(1.0), Some(20.0)));
    let on_the_way = Request::output("lefts.sum").and_on_the_way("both.sides");
    // Also where who reads it is at hand, and it would not be looked for.
    for _ in 0..2 {
        assert_eq!(sides(&run(&mut evaluator, GRAPH, &on_the_way)), (Some(1.0), None));
    }
    assert_eq!(sides(&run(&mut evaluator, GRAPH, &Request::output("l.value").and_on_the_way("both.sides"))), (None, None));
}

#[test]
fn a_part_that_there_is_not_makes_no_difference() {
    let text = GRAPH.replace(", right: \"r.value\"", "");
    let mut evaluator = counting();
    let few = run(&mut evaluator, &text, &Request::output("lefts.sum"));
    assert_eq!(parts(&few, "both"), (vec!["left"], vec![]), "nor is it left out");
    ran(&evaluator);
    let whole = run(&mut evaluator, &text, &Request::output("both.sides"));
    assert_eq!((key(&few, "both"), ran(&evaluator)), (key(&whole, "both"), vec![]));
}

#[test]
fn a_part_that_comes_along_makes_no_difference() {
    let text = GRAPH.replace("Gather(left: \"l.value\", right: \"r.value\")", "Halve(joined: true)");
    let mut evaluator = counting();
    let few = run(&mut evaluator, &text, &Request::output("lefts.sum").and_on_the_way("both.sides"));
    assert_eq!(parts(&few, "both"), (vec!["left", "right"], vec![]));
    assert_eq!(few.get::<Sides>("both.sides").unwrap().right, Some(4.0));
    ran(&evaluator);
    let whole = run(&mut evaluator, &text, &Request::output("both.sides"));
    assert_eq!((key(&few, "both"), ran(&evaluator)), (key(&whole, "both"), vec![]));
    // By itself it is made by itself.
    assert_eq!(parts(&run(&mut evaluator, &text, &Request::output("rights.sum")), "both"), (vec!["right"], vec!["left"]));
}

#[test]
fn a_switch_that_is_linked_may_be_on() {
    let text = GRAPH.replace("right: false", r#"right: "no.value""#).replace("\"l\":", "\"no\": Answer(), \"l\":");
    let evaluation = run(&mut counting(), &text, &Request::output("lefts.sum"));
    assert_eq!(*evaluation.main::<f64>().unwrap(), 1.0);
    assert_eq!(parts(&evaluation, "both"), (vec!["left", "right"], vec![]));
}

#[test]
fn equal_nodes_are_one_where_the_same_of_them_is_wanted() {
    let twin = |right: &str| {
        GRAPH.replace(
            "    \"rights\"",
            &format!(
                "    \"twin\": Gather(left: \"l.value\", right: \"r.value\"), \"more\": Sum(of: [\"twin.sides\"], {right}),\n    \"rights\""
            ),
        )
    };
    let mut evaluator = counting();
    let request = Request::output("lefts.sum").and_output("more.sum");
    run(&mut evaluator, &twin("right: false"), &request);
    assert_eq!(ran(&evaluator), ["l", "both", "passed", "lefts", "more"]);
    let other = run(&mut evaluator, &twin("left: false"), &request);
    assert_eq!(*other.get::<f64>("more.sum").unwrap(), 20.0);
    assert_eq!(ran(&evaluator), ["r", "twin", "more"]);
}

#[test]
fn it_is_the_same_on_any_number_of_threads() {
    let of = |threads: usize| {
        let mut evaluator = Evaluator::new(1 << 20).threads(threads);
        let request = Request::output("lefts.sum").and_output("rights.sum").and_output("all.sum").and_on_the_way("passed.sides");
        let runs = [GRAPH, &GRAPH.replace("right: false", "left: false"), GRAPH].map(|text| run(&mut evaluator, text, &request));
        let said = |evaluation: Evaluation| {
            let sums = ["lefts", "rights", "all"].map(|node| *evaluation.get::<f64>(&format!("{node}.sum")).unwrap());
            let trace: Vec<TraceEntry> = evaluation.trace().iter().map(|entry| TraceEntry { ms: 0.0, ..entry.clone() }).collect();
            (sums, trace, evaluation.get::<Sides>("passed.sides").unwrap().left)
        };
        runs.map(said)
    };
    let alone = of(1);
    assert_eq!((alone[0].0, alone[1].0, alone[2].0), ([1.0, 20.0, 42.0], [20.0, 20.0, 42.0], [1.0, 20.0, 42.0]));
    for threads in [2, 8] {
        assert!(of(threads) == alone, "{threads} threads");
    }
}

/// Says that it needs what it has not.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.", parts = [LEFT, LEFT])]
struct Wrong {
    /// Some sides.
    #[input]
    sides: Arc<Sides>,
}

impl Evaluate for Wrong {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(self.sides.left.unwrap_or_default().into())
    }

    fn needs(wanted: &Wanted<'_>, _: &Params<'_>) -> Needs {
        let needs = Needs::all().without("side");
        if wanted.part(LEFT) { needs.parts("sides", [LEFT, Part { name: "top", doc: "The top." }]) } else { needs.without("sides") }
    }
}

#[test]
fn needs_that_there_are_not_are_found() {
    let registry = registry().node::<Wrong>();
    let faults = registry.validate().unwrap_err().to_string();
    assert_eq!(
        faults,
        "Wrong.value: two parts are called \"left\"\n\
         Wrong.value: its needs name an input \"side\" that the node does not have\n\
         Wrong.value: its needs name a part \"top\" of \"sides\" that no output of type Sides has\n\
         Wrong.value: its needs name an input \"side\" that the node does not have\n\
         Wrong.value: its needs leave \"sides\" out, which is always read; make it Option<Arc<…>> and #[input(required)]"
    );
    // What it cannot do without is there all the same.
    let text = GRAPH.replace("    \"rights\"", "    \"wrong\": Wrong(sides: \"both.sides\"),\n    \"rights\"");
    let graph = Graph::parse(&text).unwrap().check(&registry).unwrap();
    let evaluation = Evaluator::new(0).run(&graph, &Request::output("l.value").and_on_the_way("wrong.value")).unwrap();
    assert_eq!(*evaluation.get::<f64>("wrong.value").unwrap(), 1.0);
}

#[test]
fn a_required_input_that_may_be_left_out_must_be_linked() {
    let faults = Graph::parse(&GRAPH.replace("left: \"l.value\", ", "")).unwrap().check(&registry()).unwrap_err().to_string();
    assert_eq!(faults, "3:13: node \"both\": missing \"left\": expected a link \"node.port\" to f64");
}
