//! `pelage survey`: Table 1 of Lengyel et al. 2001 for the models of a folder (L23).

mod paper;
mod pipeline;
mod row;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::Args;
use pelage_graph::Graph;
use pelage_nodes::FrameReport;
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::graph::Overrides;
use crate::output::{print, write_file};
use crate::render::size;
use pipeline::Pipeline;
use row::Row;

/// The graph of the book's bunny, for who gives none; its model is replaced.
const BUNNY: &str = include_str!("../../../../graphs/bunny.ron");

#[derive(Args)]
pub(crate) struct Survey {
    /// The folder; its OBJ models are taken in order of name.
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// The graph that draws them, with one ObjFile and one SampleShells node; the book's bunny without.
    #[arg(long, value_name = "GRAPH.ron")]
    graph: Option<PathBuf>,
    /// Pixels of the picture, instead of the graph's.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Frames that are timed after a warm-up.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: u32,
    /// Write the figures.
    #[arg(long, value_name = "FILE.json")]
    json: Option<PathBuf>,
    #[command(flatten)]
    overrides: Overrides,
}

impl Survey {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let models = models(&self.folder)?;
        let mut pipeline = self.pipeline()?;
        let (mut figures, mut failed, mut drawn_on) = (Vec::new(), Vec::new(), None);
        print(&row::head())?;
        for model in &models {
            let name = model.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
            match self.measure(&mut pipeline, model) {
                Ok((row, report)) => {
                    print(&row.to_line(&name))?;
                    figures.push(row.to_json(&name));
                    drawn_on = Some(report);
                }
                Err(Failure::NoAdapter(message)) => return Err(Failure::NoAdapter(message)),
                Err(failure) => {
                    let message = failure.message().replace('\n', "; ");
                    print(&format!("{name:<28}error: {message}\n"))?;
                    figures.push(json!({ "model": name, "error": message }));
                    failed.push(name);
                }
            }
        }
        print(&self.foot(drawn_on.as_ref()))?;
        print(&paper::table())?;
        if let Some(path) = &self.json {
            write_file(path, format!("{:#}\n", self.to_json(&figures, drawn_on.as_ref())).as_bytes())?;
        }
        if failed.is_empty() {
            return Ok(());
        }
        Err(Failure::Input(format!("{} of {} models failed: {}", failed.len(), models.len(), failed.join(", "))))
    }

    /// The graph with what is asked of it, ready to take one model after the other.
    fn pipeline(&self) -> Result<Pipeline, Failure> {
        let registry = pelage_nodes::registry();
        let (graph, path) = match &self.graph {
            Some(path) => (self.overrides.read(path, &registry)?, path.as_path()),
            None => {
                let path = Path::new("the bunny's graph");
                (self.overrides.apply(Graph::parse(BUNNY)?, path, &registry)?, path)
            }
        };
        Pipeline::new(graph, registry, path, self.size, self.frames)
    }

    /// A row: drawn with all layers, then with half as many.
    fn measure(&self, pipeline: &mut Pipeline, model: &Path) -> Result<(Row, FrameReport), Failure> {
        let all = pipeline.draw(model, None)?;
        let half = pipeline.draw(model, Some(all.layers.div_ceil(2)))?;
        let report = all.report.clone();
        Ok((Row::new(&all, &half), report))
    }

    fn foot(&self, drawn_on: Option<&FrameReport>) -> String {
        let Some(report) = drawn_on else { return String::new() };
        let (name, (width, height)) = (&report.adapter.name, report.size);
        format!("on {name}, {width} × {height} pixels, medians of {} frames, layers sampled anew for half as many\n", self.frames)
    }

    fn to_json(&self, figures: &[Value], drawn_on: Option<&FrameReport>) -> Value {
        let mut survey = json!({
            "pelage": env!("CARGO_PKG_VERSION"), "frames": self.frames, "models": figures, "paper": paper::to_json(),
            "graph": self.graph.as_ref().map_or_else(|| "bunny, built in".to_owned(), |path| path.display().to_string()),
        });
        if let Some(report) = drawn_on {
            let adapter = &report.adapter;
            survey["adapter"] = json!({ "name": adapter.name, "backend": adapter.backend, "software": adapter.software });
            (survey["width"], survey["height"]) = (report.size.0.into(), report.size.1.into());
        }
        survey
    }
}

/// The OBJ files of a folder, in order of name.
fn models(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let read = || -> std::io::Result<Vec<PathBuf>> { std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect() };
    let mut paths = read().map_err(|error| Failure::input(folder.display(), &error))?;
    paths.retain(|path| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(OsStr::new("obj"))));
    paths.sort();
    if paths.is_empty() {
        return Err(Failure::Input(format!("{}: there is no model in it; give a folder with OBJ files", folder.display())));
    }
    Ok(paths)
}
