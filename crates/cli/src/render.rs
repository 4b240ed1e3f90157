//! `pelage render`.

use std::io::Cursor;
use std::path::PathBuf;

use clap::Args;
use pelage_graph::{CheckedGraph, Evaluation, Graph, NodeId, Registry, Request};
use pelage_nodes::{FrameReport, Picture, Stats};
use serde_json::json;

use crate::failure::Failure;
use crate::graph::{Overrides, with_files};
use crate::output::write_file;
use crate::running::Running;

#[derive(Args)]
pub(crate) struct Render {
    /// The graph.
    #[arg(value_name = "GRAPH.ron")]
    graph: PathBuf,
    /// Where to write the picture.
    #[arg(short, long = "out", value_name = "OUT.png")]
    out: PathBuf,
    /// Which output to render, when there are several.
    #[arg(long, value_name = "NODE.PORT")]
    output: Option<String>,
    /// Pixels of the picture, instead of the graph's.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Write the figures of the run.
    #[arg(long, value_name = "FILE.json")]
    stats: Option<PathBuf>,
    /// Draw the frame N more times after a warm-up, for the figures.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    repeat: Option<u32>,
    #[command(flatten)]
    running: Running,
    #[command(flatten)]
    overrides: Overrides,
}

impl Render {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        self.check_files()?;
        let mut evaluator = self.running.evaluator();
        let registry = pelage_nodes::registry();
        let mut graph = self.overrides.read(&self.graph, &registry)?;
        // What is wrong with the file goes before what is asked of it.
        graph.check(&registry).map_err(|faults| with_files(faults, &graph, &registry, &self.graph))?;
        let output = self.output_of(&graph)?;
        self.apply_options(&mut graph, &registry, &output)?;
        let checked = graph.check(&registry).map_err(|faults| faults.with_path(&self.graph))?;
        let progress = self.running.progress();
        // A picture that is put together of others has no frame of its own to report on.
        let frame = Some(format!("{}.frame", node_of(&output))).filter(|_| makes_pictures(&registry, &graph, &output));
        let mut request = Request::output(&output).with_observer(progress.clone());
        if self.stats.is_some() {
            request = frame.iter().fold(request, |request, frame| request.and_output(frame)).with_all_values();
        }
        if self.stats.is_some() || self.running.verbose {
            for report in reports_behind(&checked, &output) {
                request = request.and_output(&report);
            }
        }
        let evaluation = evaluator.run(&checked, &request)?;
        progress.finish(&evaluation);
        let picture = evaluation.get::<Picture>(&output)?;
        write_file(&self.out, &png(&picture)?)?;
        match &self.stats {
            Some(path) => {
                let report = frame.map(|frame| evaluation.get::<FrameReport>(&frame)).transpose()?;
                write_file(path, self.figures(&evaluation, &picture, report.as_deref()).to_json().as_bytes())
            }
            None => Ok(()),
        }
    }

    /// Files that can't be what they are asked to be.
    fn check_files(&self) -> Result<(), Failure> {
        let extension = self.out.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        if extension.as_deref().is_some_and(|extension| extension != "png") {
            return Err(Failure::Usage(format!("-o {}: pictures are PNG; name it so", self.out.display())));
        }
        if self.stats.as_ref() == Some(&self.out) {
            return Err(Failure::Usage(format!("-o and --stats are both {}; give each a file of its own", self.out.display())));
        }
        Ok(())
    }

    /// What is asked for: `--output`, or the graph's own main output.
    fn output_of(&self, graph: &Graph) -> Result<String, Failure> {
        self.output.clone().or_else(|| graph.output.clone()).ok_or_else(|| {
            Failure::Input(format!(
                "{}: the graph names no output; add `output: \"NODE.PORT\"` to it, or give --output NODE.PORT",
                self.graph.display()
            ))
        })
    }

    /// `--size` and `--repeat` are inputs of the node that makes the picture.
    fn apply_options(&self, graph: &mut Graph, registry: &Registry, output: &str) -> Result<(), Failure> {
        let node = node_of(output);
        let size = self.size.map(|(width, height)| ("size", format!("({width}, {height})")));
        let repeat = self.repeat.map(|frames| ("repeat", frames.to_string()));
        for (input, value) in size.into_iter().chain(repeat) {
            let target = format!("{node}.{input}");
            graph.set(registry, &target, &value, ".".as_ref()).map_err(|error| Failure::Input(format!("--{input}: {error}")))?;
        }
        Ok(())
    }

    fn figures(&self, evaluation: &Evaluation, picture: &Picture, report: Option<&FrameReport>) -> Stats {
        let mut stats = Stats::of(evaluation);
        stats.insert("graph", json!(self.graph.display().to_string()));
        if let Some(report) = report {
            stats.insert_frame(report);
        }
        stats.insert("image_hash", json!(blake3::hash(&picture.rgba).to_hex().as_str()));
        stats
    }
}

/// Whether the node of an output draws, so that there is a frame to report on.
pub(crate) fn makes_pictures(registry: &Registry, graph: &Graph, output: &str) -> bool {
    let kind = graph.nodes.iter().find(|(id, _)| id.as_str() == node_of(output)).map(|(_, node)| node.kind.as_str());
    let specification = kind.and_then(|kind| registry.specification(kind));
    specification.is_some_and(|specification| specification.outputs.iter().any(|port| port.name == "frame"))
}

/// The outputs among those an output draws on that say what was mended in a model, and whether curls are too fine.
fn reports_behind(graph: &CheckedGraph, output: &str) -> Vec<String> {
    let nodes: Vec<&str> = graph.behind(output).map(NodeId::as_str).collect();
    let reports = graph.outputs().filter(|(port, kind)| ["RepairReport", "CurlReport"].contains(kind) && nodes.contains(&node_of(port)));
    reports.map(|(port, _)| port).collect()
}

/// The node of a `NODE.PORT`.
pub(crate) fn node_of(output: &str) -> &str {
    output.split_once('.').map_or(output, |(node, _)| node)
}

fn png(picture: &Picture) -> Result<Vec<u8>, Failure> {
    encode_png(&picture.rgba, (picture.width, picture.height), image::ExtendedColorType::Rgba8)
}

/// Pixels as a PNG file.
pub(crate) fn encode_png(pixels: &[u8], (width, height): (u32, u32), colour: image::ExtendedColorType) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    image::write_buffer_with_format(&mut Cursor::new(&mut bytes), pixels, width, height, colour, image::ImageFormat::Png)
        .map_err(|error| Failure::input("the picture", &error))?;
    Ok(bytes)
}

/// `WIDTHxHEIGHT`.
pub(crate) fn size(text: &str) -> Result<(u32, u32), String> {
    let numbers = text.split_once('x').map(|(width, height)| (width.parse(), height.parse()));
    match numbers {
        Some((Ok(width), Ok(height))) => Ok((width, height)),
        _ => Err("expected WIDTHxHEIGHT, as in 960x720".into()),
    }
}
