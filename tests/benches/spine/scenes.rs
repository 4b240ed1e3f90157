//! The bunny's graph on a model, with other textures than its own where asked for.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use pelage_coat::Coat;
use pelage_graph::{Evaluator, Graph, Request};
use pelage_tests::{Error, Scene, repository};

use pelage_tests::SIZE;

/// An OBJ file, and the folder it lives in if it was made for this run.
pub struct Model {
    pub name: String,
    path: String,
    _folder: Option<tempfile::TempDir>,
}

/// The bunny as shipped, and 5,000 faces: the paper's bunny where the models are at hand, else a ball.
pub fn models() -> Result<[Model; 2], Error> {
    let shipped = Model { name: "bunny as shipped".into(), path: "graphs/models/bunny.obj".into(), _folder: None };
    Ok([shipped, five_thousand_faces()?])
}

fn five_thousand_faces() -> Result<Model, Error> {
    if let Some(folder) = std::env::var_os("PELAGE_MODELS") {
        let path = Path::new(&folder).join("real/t1_bunny_5000.obj");
        return Ok(Model { name: "t1_bunny_5000".into(), path: path.to_str().ok_or("a path that is no text")?.into(), _folder: None });
    }
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("ball.obj");
    let ball = pelage_mesh::sphere(1.0, 16)?;
    let mut text = String::new();
    for p in ball.positions() {
        writeln!(text, "v {} {} {}", p.x, p.y, p.z)?;
    }
    for face in ball.faces() {
        let [a, b, c] = face.vertices().map(|v| v.id().0 + 1);
        writeln!(text, "f {a} {b} {c}")?;
    }
    std::fs::write(&path, text)?;
    Ok(Model { name: "a ball of 5,120 faces".into(), path: path.to_str().ok_or("a path that is no text")?.into(), _folder: Some(folder) })
}

/// A graph's inputs that differ from the saved ones, and the nodes that its shells pass through on their way to the coat.
#[derive(Clone, Copy, Default)]
pub struct Textures<'a> {
    pub set: &'a [(&'a str, &'a str)],
    pub through: &'a [&'a str],
    /// Inputs of those nodes, which are called "economy0" and so on.
    pub with: &'a [(&'a str, &'a str)],
}

/// An engine that remembers what coats of one model have in common.
pub struct Scenes<'a> {
    evaluator: Evaluator,
    model: &'a Model,
}

impl<'a> Scenes<'a> {
    pub fn new(model: &'a Model) -> Self {
        Self { evaluator: pelage_nodes::evaluator(1 << 30), model }
    }

    /// The bunny's graph as saved, but for 16 layers and the benchmark's size.
    pub fn whole(&mut self) -> Result<Scene, Error> {
        let size = format!("({}, {})", SIZE.0, SIZE.1);
        let overrides = [("bunny.path", self.model.path.as_str()), ("shells.layers", "16"), ("picture.size", &size)];
        Scene::evaluate_with(&mut self.evaluator, "bunny", &overrides)
    }

    /// The coat with other textures.
    pub fn coat(&mut self, textures: Textures<'_>) -> Result<Arc<Coat>, Error> {
        let registry = pelage_nodes::registry();
        let mut graph = Graph::read(&repository().join("graphs/bunny.ron"))?;
        let mut from = "shells.shells".to_owned();
        for (i, kind) in textures.through.iter().enumerate() {
            let id = format!("economy{i}");
            graph.add(&id, kind)?;
            graph.connect(&registry, &from, &id, "shells")?;
            from = format!("{id}.shells");
        }
        graph.connect(&registry, &from, "coat", "shells")?;
        let own = [("bunny.path", self.model.path.as_str()), ("shells.layers", "16")];
        for (input, value) in own.iter().chain(textures.set).chain(textures.with) {
            graph.set(&registry, input, value, repository())?;
        }
        let evaluation = self.evaluator.run(&graph.check(&registry)?, &Request::output("coat.fur"))?;
        Ok(evaluation.get::<Coat>("coat.fur")?)
    }
}
