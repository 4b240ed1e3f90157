//! A model of about 5,000 faces, as a file.

use std::fmt::Write;
use std::path::Path;

use pelage_tests::Error;

/// A file, and the folder it lives in if it was made for this run.
pub struct Model {
    path: String,
    _folder: Option<tempfile::TempDir>,
}

impl Model {
    /// Where it is.
    pub fn path(&self) -> &str {
        &self.path
    }
}

/// The paper's bunny where the models are at hand, else a ball.
pub fn five_thousand_faces() -> Result<Model, Error> {
    if let Some(folder) = std::env::var_os("PELAGE_MODELS") {
        let path = Path::new(&folder).join("real/t1_bunny_5000.obj");
        return Ok(Model { path: path.to_str().ok_or("a path that is no text")?.into(), _folder: None });
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
    Ok(Model { path: path.to_str().ok_or("a path that is no text")?.into(), _folder: Some(folder) })
}
