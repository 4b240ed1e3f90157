//! A saved graph, evaluated up to its coat and drawn from there.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use pelage_coat::{Background, Coat, Lights};
use pelage_graph::{Colour, Evaluation, Evaluator, Graph, Request, TraceEntry};
use pelage_lighting::Shading;
use pelage_mesh::Mesh;
use pelage_nodes::{Framing, Gpu, Picture};
use pelage_patch::PatchTiling;
use pelage_render::{Options, View};

use crate::Error;

/// The repository's root.
pub fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The names of the graphs in `graphs/`, in order.
///
/// # Errors
/// Where the folder cannot be read.
pub fn graph_names() -> Result<Vec<String>, Error> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(repository().join("graphs"))? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "ron") {
            names.push(path.file_stem().unwrap_or_default().to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}

/// The graphics device of this process; tests share it.
///
/// # Errors
/// Where there is none; the message says what to install.
pub fn gpu() -> Result<&'static Gpu, Error> {
    static DEVICE: OnceLock<Result<Gpu, String>> = OnceLock::new();
    DEVICE.get_or_init(|| Gpu::new().map_err(|error| error.to_string())).as_ref().map_err(|message| message.clone().into())
}

/// A graph with its overrides, evaluated.
pub struct Scene {
    evaluation: Evaluation,
    output: String,
}

impl Scene {
    /// Evaluates the main output of `graphs/<name>.ron` with overrides `("node.input", "value")`, paths relative to the repository's root.
    ///
    /// # Errors
    /// Faults of the graph, or failures of its nodes.
    pub fn evaluate(name: &str, overrides: &[(&str, &str)]) -> Result<Self, Error> {
        Self::evaluate_with(&mut pelage_nodes::evaluator(1 << 30), name, overrides)
    }

    /// The same with an engine whose cache has what earlier scenes made.
    ///
    /// # Errors
    /// Faults of the graph, or failures of its nodes.
    pub fn evaluate_with(evaluator: &mut Evaluator, name: &str, overrides: &[(&str, &str)]) -> Result<Self, Error> {
        Self::run(evaluator, name, overrides, |_| Request::main())
    }

    /// The same with the report of the node that drew the picture, whose `repeat` says how often the frame is measured.
    ///
    /// # Errors
    /// Faults of the graph, or failures of its nodes; a main output that no drawing node makes.
    pub fn evaluate_measured(evaluator: &mut Evaluator, name: &str, overrides: &[(&str, &str)]) -> Result<Self, Error> {
        Self::run(evaluator, name, overrides, |output| {
            let node = output.split_once('.').map_or(output, |(node, _)| node);
            Request::output(output).and_output(&format!("{node}.frame"))
        })
    }

    fn run(evaluator: &mut Evaluator, name: &str, overrides: &[(&str, &str)], request: impl Fn(&str) -> Request) -> Result<Self, Error> {
        let registry = pelage_nodes::registry();
        let mut graph = Graph::read(&repository().join(format!("graphs/{name}.ron")))?;
        for (input, value) in overrides {
            graph.set(&registry, input, value, repository())?;
        }
        let output = graph.output.clone().ok_or("the graph has no main output")?;
        let checked = graph.check(&registry)?;
        let evaluation = evaluator.run(&checked, &request(&output).with_all_values())?;
        Ok(Self { evaluation, output })
    }

    /// The picture that the graph makes.
    ///
    /// # Errors
    /// Where its main output is no picture.
    pub fn picture(&self) -> Result<Arc<Picture>, Error> {
        Ok(self.evaluation.get::<Picture>(&self.output)?)
    }

    /// What each node did, in order.
    pub fn trace(&self) -> &[TraceEntry] {
        self.evaluation.trace()
    }

    /// The one value of a type that the graph made on its way.
    ///
    /// # Errors
    /// Where it made none.
    pub fn only<T: Send + Sync + 'static>(&self, what: &str) -> Result<Arc<T>, Error> {
        let mut found = self.evaluation.values().filter_map(|(_, _, value)| value.downcast::<T>());
        found.next().ok_or_else(|| format!("the graph makes no {what}").into())
    }

    /// Its coat.
    ///
    /// # Errors
    /// Where it makes none.
    pub fn coat(&self) -> Result<Arc<Coat>, Error> {
        self.only("coat")
    }

    /// What its camera frames.
    ///
    /// # Errors
    /// Where it makes none.
    pub fn framing(&self) -> Result<Arc<Framing>, Error> {
        self.only("camera")
    }

    /// What the bunny's picture was drawn with: all defaults but for the step blur. A test that leans on this first shows that the parts
    /// make the graph's own picture.
    ///
    /// # Errors
    /// Where it makes no picture.
    pub fn view(&self, coat: &Coat) -> Result<(View, Background), Error> {
        let picture = self.picture()?;
        let aspect = picture.width as f32 / picture.height as f32;
        let view = View {
            camera: self.framing()?.camera(coat.bounds(), aspect),
            lights: Lights::clone(&*self.only::<Lights>("light")?),
            shading: *self.only::<Shading>("shading")?,
            options: Options { step_blur: 0.8, ..Options::default() },
        };
        let grey = |top: [f64; 3]| glam::DVec3::from(Colour(top).to_linear()).as_vec3();
        Ok((view, Background { top: grey([0.82, 0.84, 0.86]), bottom: grey([0.62, 0.62, 0.63]) }))
    }

    /// Its tiling.
    ///
    /// # Errors
    /// Where it makes none.
    pub fn tiling(&self) -> Result<Arc<PatchTiling>, Error> {
        self.only("tiling")
    }

    /// Its mesh.
    ///
    /// # Errors
    /// Where it makes none.
    pub fn mesh(&self) -> Result<Arc<Mesh>, Error> {
        self.only("mesh")
    }
}
