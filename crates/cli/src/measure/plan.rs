//! Every setting as a graph that has been checked, before anything is evaluated.

use std::path::Path;

use pelage_graph::{CheckedGraph, Graph, Registry};
use pelage_nodes::fur_of;

use super::description::Description;
use crate::failure::Failure;
use crate::graph::{Overrides, with_files};
use crate::render::{makes_pictures, node_of};

/// What is evaluated, in order.
pub(crate) struct Plan {
    /// The node whose pictures are measured.
    pub(crate) picture: String,
    /// Its port, with the node's name.
    pub(crate) output: String,
    /// What is measured against.
    pub(crate) against: String,
    /// The inputs that vary.
    pub(crate) varied: Vec<String>,
    /// The graph as it is, with none of them set.
    pub(crate) start: Setting,
    /// Each combination of values, the last input's changing first.
    pub(crate) settings: Vec<Setting>,
    /// What makes the picture that all are measured against; none if each setting has its own.
    pub(crate) finest: Option<CheckedGraph>,
}

/// One combination.
pub(crate) struct Setting {
    /// A value for each input that varies.
    pub(crate) values: Vec<String>,
    pub(crate) graph: CheckedGraph,
    /// The output of the coat that is drawn.
    pub(crate) fur: String,
    /// What makes the picture that it is measured against, where that is its own.
    pub(crate) finest: Option<CheckedGraph>,
}

/// Sets inputs of a graph, and checks it.
struct Setter<'a> {
    registry: &'a Registry,
    path: &'a Path,
    directory: &'a Path,
}

impl Setter<'_> {
    fn set(&self, graph: &mut Graph, target: &str, value: &str) -> Result<(), Failure> {
        graph.set(self.registry, target, value, self.directory).map_err(|error| Failure::Input(error.to_string()))
    }

    fn check(&self, graph: &Graph) -> Result<CheckedGraph, Failure> {
        Ok(graph.check(self.registry).map_err(|faults| with_files(faults, graph, self.registry, self.path))?)
    }
}

impl Plan {
    /// Checks all there is to check: no setting is evaluated while another is wrong. More settings than `most` are refused.
    pub(crate) fn new(sweep: &Description, overrides: &Overrides, size: Option<(u32, u32)>, most: usize) -> Result<Self, Failure> {
        let registry = pelage_nodes::registry();
        let setter = Setter { registry: &registry, path: &sweep.graph, directory: &sweep.directory };
        let values = combinations(sweep, most)?;
        let mut graph = overrides.read(&sweep.graph, &registry)?;
        setter.check(&graph)?;
        let output = output_of(sweep, &graph, &registry)?;
        let (picture, against) = (node_of(&output).to_owned(), sweep.against.clone().unwrap_or_else(|| output.clone()));
        if let Some((width, height)) = size {
            for node in [&*picture, node_of(&against)] {
                setter.set(&mut graph, &format!("{node}.size"), &format!("({width}, {height})"))?;
            }
        }
        // What the command line sets goes before what the file sets.
        for (target, value) in &sweep.set {
            setter.set(&mut graph, target, value)?;
        }
        let mut graph = overrides.apply(graph, &sweep.graph, &registry)?;
        setter.set(&mut graph, &format!("{picture}.repeat"), "0")?;
        let varied: Vec<String> = sweep.vary.keys().cloned().collect();
        let checked = |graph: &Graph, values| {
            let finest = if sweep.each { Some(finest(&setter, sweep, graph.clone())?) } else { None };
            let checked = setter.check(graph)?;
            let fur = fur_of(graph, &registry, &picture)
                .ok_or_else(|| Failure::Input(format!("{}: {picture} draws no fur", sweep.graph.display())))?;
            Ok::<_, Failure>(Setting { values, graph: checked, fur, finest })
        };
        let start = checked(&graph, Vec::new())?;
        let mut settings = Vec::new();
        for values in values {
            let mut graph = graph.clone();
            for (target, value) in varied.iter().zip(&values) {
                setter.set(&mut graph, target, value).map_err(in_vary)?;
            }
            settings.push(checked(&graph, values)?);
        }
        let finest = if sweep.each { None } else { Some(finest_of_all(&setter, sweep, graph)?) };
        let plan = Self { picture, output, against, varied, start, settings, finest };
        plan.check_against(sweep)?;
        Ok(plan)
    }

    /// That there is a picture to measure against.
    fn check_against(&self, sweep: &Description) -> Result<(), Failure> {
        let finest = self.finest.iter().chain(self.settings.iter().filter_map(|setting| setting.finest.as_ref())).next();
        let pictures: Vec<String> =
            finest.map(|graph| graph.outputs().filter(|(_, kind)| *kind == "Picture").map(|(port, _)| port).collect()).unwrap_or_default();
        if pictures.contains(&self.against) {
            return Ok(());
        }
        let (graph, against) = (sweep.graph.display(), &self.against);
        Err(Failure::Input(format!("{graph}: {against} is no picture to measure against; its pictures are {}", pictures.join(", "))))
    }
}

fn in_vary(failure: Failure) -> Failure {
    match failure {
        Failure::Input(message) => Failure::Input(format!("--vary {message}")),
        other => other,
    }
}

/// The setting with what only the one measured against has set.
fn finest(setter: &Setter<'_>, sweep: &Description, mut graph: Graph) -> Result<CheckedGraph, Failure> {
    for (target, value) in &sweep.finest {
        setter.set(&mut graph, target, value)?;
    }
    setter.check(&graph)
}

/// The last value of each input that varies, and what only the one measured against has set.
fn finest_of_all(setter: &Setter<'_>, sweep: &Description, mut graph: Graph) -> Result<CheckedGraph, Failure> {
    for (target, values) in &sweep.vary {
        if let Some(value) = values.last() {
            setter.set(&mut graph, target, value).map_err(in_vary)?;
        }
    }
    finest(setter, sweep, graph)
}

/// Every combination of values, the last input's changing first.
fn combinations(sweep: &Description, most: usize) -> Result<Vec<Vec<String>>, Failure> {
    if sweep.vary.is_empty() {
        return Err(Failure::Usage("nothing varies; give --vary NODE.INPUT=a,b,c".into()));
    }
    let count = sweep.vary.values().try_fold(1usize, |count, values| count.checked_mul(values.len())).unwrap_or(usize::MAX);
    if count > most {
        return Err(Failure::Usage(format!(
            "{count} combinations are more than {most}; vary fewer inputs at a time, or give them fewer values"
        )));
    }
    if let Some((target, _)) = sweep.vary.iter().find(|(_, values)| values.is_empty()) {
        return Err(Failure::Usage(format!("{target} has no values; give NODE.INPUT=a,b,c")));
    }
    let mut all = vec![Vec::new()];
    for values in sweep.vary.values() {
        let with =
            |before: &Vec<String>| values.iter().map(|value| [&before[..], std::slice::from_ref(value)].concat()).collect::<Vec<_>>();
        all = all.iter().flat_map(with).collect();
    }
    Ok(all)
}

/// What is asked for, or the graph's own main output: one that is drawn.
pub(crate) fn output_of(sweep: &Description, graph: &Graph, registry: &Registry) -> Result<String, Failure> {
    let about = sweep.graph.display();
    let output = sweep.output.clone().or_else(|| graph.output.clone());
    let Some(output) = output else {
        return Err(Failure::Input(format!("{about}: the graph names no output; give --output NODE.PORT of a RenderImage node")));
    };
    if !makes_pictures(registry, graph, &output) {
        return Err(Failure::Input(format!("{about}: {output} is not drawn; give --output NODE.PORT of a RenderImage node")));
    }
    Ok(output)
}
