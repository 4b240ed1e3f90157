//! A graph that draws one model after the other.

use std::path::Path;
use std::sync::Arc;

use pelage_graph::{CheckedGraph, Evaluator, Graph, Registry, Request};
use pelage_nodes::{FrameReport, Stats};

use crate::failure::Failure;
use crate::progress::Progress;
use crate::render::{makes_pictures, node_of};
use crate::running::CACHE_BYTES;

/// The graph, and which of its inputs are set for each picture.
pub(crate) struct Pipeline {
    graph: Graph,
    registry: Registry,
    evaluator: Evaluator,
    picture: String,
    model: String,
    shells: String,
}

/// A model drawn once and timed.
pub(crate) struct Drawn {
    /// Shell layers in the texture.
    pub(crate) layers: u64,
    /// The figures of the run, as `--stats` has them.
    pub(crate) stats: Stats,
    /// How the picture came about.
    pub(crate) report: FrameReport,
}

impl Pipeline {
    /// Finds what is to be varied. Messages call the graph `path`.
    pub(crate) fn new(mut graph: Graph, registry: Registry, path: &Path, size: Option<(u32, u32)>, frames: u32) -> Result<Self, Failure> {
        let output = graph.output.clone().filter(|output| makes_pictures(&registry, &graph, output));
        let Some(output) = output else {
            let message = "the graph's output is no picture; add `output: \"NODE.PORT\"` of a RenderImage node to it";
            return Err(Failure::Input(format!("{}: {message}", path.display())));
        };
        let picture = node_of(&output).to_owned();
        let size = size.map(|(width, height)| ("size", format!("({width}, {height})")));
        for (input, value) in size.into_iter().chain([("repeat", frames.to_string())]) {
            let option = if input == "repeat" { "frames" } else { input };
            let set = graph.set(&registry, &format!("{picture}.{input}"), &value, ".".as_ref());
            set.map_err(|error| Failure::Input(format!("--{option}: {error}")))?;
        }
        let checked = graph.check(&registry).map_err(|faults| faults.with_path(path))?;
        let only = |kind: &str| {
            the_only(&checked, &output, kind).map_err(|count| {
                Failure::Input(format!("{}: {output} draws on {count} {kind} nodes; a survey needs exactly one", path.display()))
            })
        };
        let (model, shells) = (only("ObjFile")?, only("SampleShells")?);
        Ok(Self { graph, registry, evaluator: pelage_nodes::evaluator(CACHE_BYTES), picture, model, shells })
    }

    /// Draws a model with so many layers, or with as many as the graph says. What models have in common, as their hair, is made once.
    pub(crate) fn draw(&mut self, model: &Path, layers: Option<u64>) -> Result<Drawn, Failure> {
        let mut graph = self.graph.clone();
        let here = std::env::current_dir().map_err(|error| Failure::input("the working directory", &error))?;
        let layers = layers.map(|layers| (format!("{}.layers", self.shells), layers.to_string()));
        let path = (format!("{}.path", self.model), format!("{:?}", model.to_string_lossy()));
        for (target, value) in layers.into_iter().chain([path]) {
            graph.set(&self.registry, &target, &value, &here).map_err(|error| Failure::Input(error.to_string()))?;
        }
        let checked = graph.check(&self.registry)?;
        let (image, frame) = (format!("{}.image", self.picture), format!("{}.frame", self.picture));
        let progress = Arc::new(Progress::new(false, false));
        let request = Request::output(&image).and_output(&frame).with_all_values().with_observer(progress.clone());
        let evaluation = self.evaluator.run(&checked, &request);
        progress.clear();
        let evaluation = evaluation?;
        let report = FrameReport::clone(&*evaluation.get::<FrameReport>(&frame)?);
        let mut stats = Stats::of(&evaluation);
        stats.insert_frame(&report);
        let layers = stats.figure("/textures/layers").and_then(serde_json::Value::as_u64).unwrap_or_default();
        Ok(Drawn { layers, stats, report })
    }
}

/// The one node of a kind that an output draws on, or how many there are.
fn the_only(graph: &CheckedGraph, output: &str, kind: &str) -> Result<String, usize> {
    let of_kind: Vec<String> =
        graph.behind(output).filter(|id| graph.nodes().any(|(node, of)| node == *id && of == kind)).map(ToString::to_string).collect();
    if of_kind.len() == 1 { Ok(of_kind.into_iter().next().unwrap_or_default()) } else { Err(of_kind.len()) }
}
