//! Meshes from meshes.

use std::sync::Arc;

use glam::DVec3;
use pelage_graph::{Context, Evaluate, Node, NodeError};
use pelage_mesh::{Mesh, SimplifySettings};

/// A finer, smoother surface: each triangle cut into four by Loop's scheme, with its texture coordinates and colours.
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface. A boundary becomes a smooth curve of its own.")]
pub struct Subdivide {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// How often each triangle is cut.
    #[param(default = 1, range = 0..=8, unit = "times", effect = "4 times as many triangles each time, at most 8,000,000")]
    pub times: u32,
}

impl Evaluate for Subdivide {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(pelage_mesh::subdivide(&self.mesh, self.times)?.into())
    }
}

/// A coarser surface: faces are taken away where they are missed least, down to a share of them or as far as an error allows, whichever comes first.
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface. Its vertices are some of those there were, with their colours and texture coordinates.")]
pub struct Simplify {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// How many of the faces are to be left.
    #[param(default = 0.25, range = 0.0..=1.0, unit = "fraction of the faces", effect = "smaller: coarser, cheaper")]
    pub share: f64,
    /// How far the surface may leave its place.
    #[param(default = 1.0, range = 0.0..=1.0, unit = "model diameters", effect = "smaller: truer, more faces")]
    pub error: f64,
    /// Whether a boundary stays where it is.
    #[param(default = false)]
    pub keep_boundary: bool,
}

impl Evaluate for Simplify {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let settings = SimplifySettings { share: self.share, error: self.error, keep_boundary: self.keep_boundary };
        Ok(pelage_mesh::simplify(&self.mesh, &settings)?.mesh.into())
    }
}

/// A surface of another size, turned and moved; what a negative scale mirrors is wound so that outside stays outside.
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface.")]
pub struct Transform {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// How many times as large along x, y and z; negative mirrors, 0 is refused.
    #[param(default = [1.0, 1.0, 1.0], range = -1000.0..=1000.0, unit = "times", effect = "larger; only proportions show, as a coat is scaled to its model")]
    pub scale: [f64; 3],
    /// How far it is turned after that, about x, then y, then z.
    #[param(default = [0.0, 0.0, 0.0], range = -360.0..=360.0, unit = "degrees", effect = "turned anticlockwise, seen from the axis's tip")]
    pub turn: [f64; 3],
    /// How far it is moved after that.
    #[param(default = [0.0, 0.0, 0.0], range = -1e6..=1e6, unit = "model units", effect = "elsewhere")]
    pub shift: [f64; 3],
}

impl Evaluate for Transform {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let turn = DVec3::from(self.turn.map(f64::to_radians));
        let by = pelage_mesh::Transform { scale: DVec3::from(self.scale), turn, shift: DVec3::from(self.shift) };
        Ok(pelage_mesh::transform(&self.mesh, &by)?.into())
    }
}

/// Two surfaces as one model, each in its place; nothing is welded.
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface: the first's vertices and faces, then the second's. Texture coordinates only if both have them.")]
pub struct Join {
    /// One surface.
    #[input]
    pub first: Arc<Mesh>,
    /// The other.
    #[input]
    pub second: Arc<Mesh>,
}

impl Evaluate for Join {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(pelage_mesh::join(&self.first, &self.second)?.into())
    }
}
