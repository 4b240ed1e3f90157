//! `pelage gallery`: every saved graph's picture, and a contact sheet of them all.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use image::RgbImage;
use pelage_graph::{CheckedGraph, Registry, Request};
use pelage_nodes::Picture;

use crate::contact::{in_rows_of, png, within};
use crate::failure::Failure;
use crate::graph::{Overrides, with_files};
use crate::measure::errors::rgb;
use crate::output::{check_folder, write_files};
use crate::render::{encode_png, makes_pictures, size};
use crate::running::Running;

/// The node whose picture, where a graph has one, is shown besides: the same from near.
const CLOSE_UP: &str = "close";

/// Pictures in a row of the sheet.
const ACROSS: u32 = 6;

#[derive(Args)]
pub(crate) struct Gallery {
    /// Graphs, and folders of them.
    #[arg(value_name = "GRAPH.ron|FOLDER", required = true)]
    graphs: Vec<PathBuf>,
    /// The largest that a picture is on the sheet.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "240x180")]
    size: (u32, u32),
    /// How many there are in a row.
    #[arg(long, value_name = "N", default_value_t = ACROSS, value_parser = clap::value_parser!(u32).range(1..=100))]
    across: u32,
    /// The folder to write the pictures, sheet.png and index.md to.
    #[arg(short, long = "out", value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    running: Running,
}

/// A picture to be made.
struct Wanted {
    /// What its file is called, without the ending.
    name: String,
    /// What stands below it.
    caption: String,
    graph: Arc<CheckedGraph>,
    output: String,
}

impl Gallery {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        check_folder(&self.out)?;
        let registry = pelage_nodes::registry();
        let mut wanted = Vec::new();
        for path in self.files()? {
            wanted.extend(pictures_of(&path, &registry)?);
        }
        if let Some(twice) = wanted.iter().enumerate().find(|(at, one)| wanted[..*at].iter().any(|other| other.name == one.name)) {
            return Err(Failure::Input(format!("two pictures would be {}.png; name graphs apart, or make two galleries", twice.1.name)));
        }
        let pictures = wanted.iter().map(|one| self.draw(one)).collect::<Result<Vec<_>, _>>()?;
        let mut files = Vec::new();
        let mut small: Vec<Vec<RgbImage>> = Vec::new();
        for (one, picture) in wanted.iter().zip(&pictures) {
            let dimensions = (picture.width, picture.height);
            files.push((format!("{}.png", one.name), encode_png(&picture.rgba, dimensions, image::ExtendedColorType::Rgba8)?));
            small.push(vec![within(self.size, dimensions, rgb(picture))?]);
        }
        files.push(("sheet.png".into(), png(&in_rows_of(self.across, &small))?));
        files.push(("index.md".into(), index(&wanted).into_bytes()));
        write_files(&self.out, &files)
    }

    /// The graphs that are named, and those of the folders that are, by name.
    fn files(&self) -> Result<Vec<PathBuf>, Failure> {
        let mut files = Vec::new();
        for path in &self.graphs {
            if !path.is_dir() {
                files.push(path.clone());
                continue;
            }
            let failed = |error: std::io::Error| Failure::input(path.display(), &error);
            let mut inside = Vec::new();
            for entry in std::fs::read_dir(path).map_err(failed)? {
                let file = entry.map_err(failed)?.path();
                if file.is_file() && file.extension().is_some_and(|extension| extension == "ron") {
                    inside.push(file);
                }
            }
            inside.sort();
            files.extend(inside);
        }
        if files.is_empty() { Err(Failure::Input("there is no graph in the folder: name one that has some".into())) } else { Ok(files) }
    }

    /// Each with an engine of its own: no graph's results are kept for the next.
    fn draw(&self, wanted: &Wanted) -> Result<Arc<Picture>, Failure> {
        let progress = self.running.progress();
        progress.title(&wanted.name);
        let evaluation = self.running.evaluator().run(&wanted.graph, &Request::output(&wanted.output).with_observer(progress.clone()));
        progress.clear();
        let evaluation = evaluation?;
        progress.finish(&evaluation);
        Ok(evaluation.get(&wanted.output)?)
    }
}

/// The picture of a graph, and the one from near if it has one.
fn pictures_of(path: &Path, registry: &Registry) -> Result<Vec<Wanted>, Failure> {
    let graph = Overrides::default().read(path, registry)?;
    let checked = Arc::new(graph.check(registry).map_err(|faults| with_files(faults, &graph, registry, path))?);
    let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let main = graph
        .output
        .clone()
        .ok_or_else(|| Failure::Input(format!("{}: the graph names no output; add `output: \"NODE.PORT\"` to it", path.display())))?;
    let title = graph.title.clone().unwrap_or_else(|| name.clone());
    let close = format!("{CLOSE_UP}.image");
    let from_near = makes_pictures(registry, &graph, &close).then(|| Wanted {
        name: format!("{name}-{CLOSE_UP}"),
        caption: format!("{title}, from near"),
        graph: checked.clone(),
        output: close,
    });
    Ok([Wanted { name, caption: title, graph: checked, output: main }].into_iter().chain(from_near).collect())
}

/// What each picture shows, in the order of the sheet.
fn index(wanted: &[Wanted]) -> String {
    let mut text = "# Gallery\n\n![All of them](sheet.png)\n\n| picture | what it shows |\n|---|---|\n".to_owned();
    for one in wanted {
        let _ = writeln!(text, "| [{name}]({name}.png) | {} |", one.caption.replace('|', "\\|"), name = one.name);
    }
    text
}
