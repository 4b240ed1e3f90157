//! Every setting as a graph that has been checked, before anything is evaluated.

use std::path::Path;

use indexmap::IndexMap;
use pelage_accuracy::Group;
use pelage_graph::{CheckedGraph, Graph, Registry, Request};
use pelage_nodes::{Quality, fur_of};

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
    /// The axes of cases, and the inputs that vary.
    pub(crate) varied: Vec<String>,
    /// Those of them that tell the settings apart which do not compete.
    pub(crate) grouped_by: Vec<String>,
    /// The graph as it is, with none of them set.
    pub(crate) start: Setting,
    /// Each combination of values, the last input's changing first.
    pub(crate) settings: Vec<Setting>,
    /// What makes the pictures that are measured against.
    pub(crate) references: Vec<CheckedGraph>,
}

/// One combination.
pub(crate) struct Setting {
    /// A case for each axis, and a value for each input that varies.
    pub(crate) values: Vec<String>,
    pub(crate) graph: CheckedGraph,
    /// The output of the coat that is drawn.
    pub(crate) fur: String,
    /// Which of the references it is measured against.
    pub(crate) reference: usize,
}

impl Setting {
    fn new(
        setter: &Setter<'_>,
        sweep: &Description,
        graph: &Graph,
        picture: &str,
        values: Vec<String>,
        reference: usize,
    ) -> Result<Self, Failure> {
        let fur = fur_of(graph, setter.registry, picture)
            .ok_or_else(|| Failure::Input(format!("{}: {picture} draws no fur", sweep.graph.display())))?;
        Ok(Self { values, graph: setter.check(graph)?, fur, reference })
    }
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
        let axes = || sweep.cases.keys().cloned();
        let varied: Vec<String> = axes().chain(sweep.vary.keys().cloned()).collect();
        let grouped_by: Vec<String> = axes().chain(sweep.groups.iter().cloned()).collect();
        if let Some(unknown) = sweep.groups.iter().find(|name| !sweep.vary.contains_key(*name)) {
            return Err(Failure::Input(format!("{unknown} groups settings and does not vary; give --vary {unknown}=a,b,c, too")));
        }
        refuse_what_a_budget_decides(&graph, &picture, sweep)?;
        let start = Setting::new(&setter, sweep, &graph, &picture, Vec::new(), 0)?;
        let mut plan = Self { picture, output, against, varied, grouped_by, start, settings: Vec::new(), references: Vec::new() };
        for case in cases(sweep) {
            let mut graph = graph.clone();
            for (target, value) in case.sets {
                let about = || format!("{}: ", case.names.join(", "));
                setter.set(&mut graph, target, value).map_err(|failure| prefixed(&about(), failure))?;
            }
            plan.add(&setter, sweep, &graph, &case.names, &values)?;
        }
        plan.check_against(sweep)?;
        Ok(plan)
    }

    /// Adds every setting of a case, and what it is measured against.
    fn add(
        &mut self,
        setter: &Setter<'_>,
        sweep: &Description,
        graph: &Graph,
        case: &[String],
        values: &[Vec<String>],
    ) -> Result<(), Failure> {
        if !sweep.each {
            self.references.push(finest_of_all(setter, sweep, graph.clone())?);
        }
        for values in values {
            let mut graph = graph.clone();
            for (target, value) in sweep.vary.keys().zip(values) {
                setter.set(&mut graph, target, value).map_err(in_vary)?;
            }
            if sweep.each {
                self.references.push(finest(setter, sweep, graph.clone())?);
            }
            let values = case.iter().chain(values).cloned().collect();
            self.settings.push(Setting::new(setter, sweep, &graph, &self.picture, values, self.references.len() - 1)?);
        }
        Ok(())
    }

    /// The settings that compete, group by group.
    pub(crate) fn groups(&self) -> Vec<Group> {
        let picks: Vec<usize> = self.grouped_by.iter().filter_map(|name| self.varied.iter().position(|varied| varied == name)).collect();
        let name = |setting: &Setting| picks.iter().map(|&pick| setting.values[pick].as_str()).collect::<Vec<_>>().join(", ");
        Group::of(self.settings.iter().map(name))
    }

    /// What all settings, and what they are measured against, depend on, as one hash: where it is another, figures that were measured before are out of date. It knows versions of nodes, values
    /// and the content of files, and neither ids nor adapter.
    pub(crate) fn fingerprint(&self) -> Result<String, Failure> {
        let mut hasher = blake3::Hasher::new();
        for setting in &self.settings {
            for text in self.varied.iter().chain(&setting.values) {
                hasher.update(text.as_bytes()).update(&[0]);
            }
            let reference = &self.references[setting.reference];
            for (graph, output) in [(&setting.graph, &self.output), (reference, &self.against)] {
                for key in graph.keys_of(&Request::output(output))? {
                    hasher.update(key.to_string().as_bytes());
                }
            }
        }
        Ok(hasher.finalize().to_hex()[..16].to_owned())
    }

    /// That there is a picture to measure against.
    fn check_against(&self, sweep: &Description) -> Result<(), Failure> {
        let pictures: Vec<String> = self
            .references
            .first()
            .map(|graph| graph.outputs().filter(|(_, kind)| *kind == "Picture").map(|(port, _)| port).collect())
            .unwrap_or_default();
        if pictures.contains(&self.against) {
            return Ok(());
        }
        let (graph, against) = (sweep.graph.display(), &self.against);
        Err(Failure::Input(format!("{graph}: {against} is no picture to measure against; its pictures are {}", pictures.join(", "))))
    }
}

/// What a budget decides is not for a sweep to vary: every setting would be the same picture.
fn refuse_what_a_budget_decides(graph: &Graph, picture: &str, sweep: &Description) -> Result<(), Failure> {
    let has_budget = graph.nodes.iter().any(|(id, node)| id.as_str() == picture && node.fields.contains_key("budget"));
    let decided = |target: &&String| target.split_once('.').is_some_and(|(node, input)| node == picture && Quality::decides(input));
    match sweep.vary.keys().find(decided).filter(|_| has_budget) {
        Some(target) => Err(Failure::Input(format!(
            "{target} does not count, as the budget of {picture} decides it; vary it on a RenderImage without a budget"
        ))),
        None => Ok(()),
    }
}

fn in_vary(failure: Failure) -> Failure {
    prefixed("--vary ", failure)
}

/// The failure, saying what of.
pub(crate) fn prefixed(what: &str, failure: Failure) -> Failure {
    match failure {
        Failure::Input(message) => Failure::Input(format!("{what}{message}")),
        other => other,
    }
}

/// One case of each axis.
struct Case<'a> {
    names: Vec<String>,
    sets: Vec<(&'a String, &'a String)>,
}

/// Every combination of one case of each axis, the last axis changing first; one that sets nothing if there are no axes.
fn cases(sweep: &Description) -> Vec<Case<'_>> {
    let mut all = vec![Case { names: Vec::new(), sets: Vec::new() }];
    for axis in sweep.cases.values() {
        let mut joined = Vec::new();
        for before in &all {
            joined.extend(axis.iter().map(|(name, sets)| Case {
                names: before.names.iter().chain([name]).cloned().collect(),
                sets: before.sets.iter().copied().chain(sets).collect(),
            }));
        }
        all = joined;
    }
    all
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
    if sweep.vary.is_empty() && sweep.cases.is_empty() {
        return Err(Failure::Usage("nothing varies; give --vary NODE.INPUT=a,b,c".into()));
    }
    let axes = sweep.vary.values().map(Vec::len).chain(sweep.cases.values().map(IndexMap::len));
    let count = axes.into_iter().try_fold(1usize, usize::checked_mul).unwrap_or(usize::MAX);
    if count > most {
        return Err(Failure::Usage(format!(
            "{count} combinations are more than {most}; vary fewer inputs at a time, or give them fewer values"
        )));
    }
    if let Some((axis, _)) = sweep.cases.iter().find(|(_, cases)| cases.is_empty()) {
        return Err(Failure::Usage(format!("{axis} has no cases; give {{ \"name\": {{ \"node.input\": value … }} … }}")));
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
