//! Where surfaces come from.

use std::sync::Arc;

use pelage_graph::{Context, Evaluate, FilePath, Node, NodeError};
use pelage_mesh::{Mesh, RepairReport};

/// A model read from a Wavefront OBJ file (L1).
#[derive(Node)]
#[node(category = "Models", version = 2)]
#[output(mesh: Mesh, "The surface: an oriented manifold of triangles, whatever the file holds.")]
#[output(repairs: RepairReport, "What it took to make it one, counted.")]
pub struct ObjFile {
    /// The file; polygons are cut into triangles, and what is no surface is mended.
    #[param]
    pub path: FilePath,
}

impl Evaluate for ObjFile {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let import = pelage_mesh::read_obj(self.path.as_path())?;
        Ok(ObjFileOutputs { mesh: Some(Arc::new(import.mesh)), repairs: Some(Arc::new(import.repairs)) })
    }
}

/// A flat rectangle that faces up (Z4).
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface, with texture coordinates.")]
pub struct Plane {
    /// Across and from front to back.
    #[param(default = [1.0, 1.0], range = 1e-6..=1e6, unit = "model units", effect = "only its proportions show: a coat is scaled to its model")]
    pub size: [f64; 2],
    /// Cells along each side, two triangles each.
    #[param(default = (16, 16), range = 1..=2048, unit = "cells", effect = "more: more triangles, finer combing")]
    pub cells: (u32, u32),
}

impl Evaluate for Plane {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(pelage_mesh::plane(self.size[0], self.size[1], self.cells.0, self.cells.1)?.into())
    }
}

/// A ball of nearly equal triangles.
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface.")]
pub struct Sphere {
    /// Into how many parts each edge of an icosahedron is cut.
    #[param(default = 16, range = 1..=600, unit = "parts", effect = "20 n² triangles")]
    pub subdivisions: u32,
}

impl Evaluate for Sphere {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(pelage_mesh::sphere(1.0, self.subdivisions)?.into())
    }
}

/// A ring, lying flat.
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface, with texture coordinates.")]
pub struct Torus {
    /// The thickness of the ring, from its middle to its skin.
    #[param(default = 0.35, range = 0.01..=0.95, unit = "radii of the ring", effect = "thicker or thinner")]
    pub tube: f64,
    /// Cells around the ring and around the tube, two triangles each.
    #[param(default = (64, 28), range = 3..=2048, unit = "cells", effect = "more: more triangles")]
    pub cells: (u32, u32),
}

impl Evaluate for Torus {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(pelage_mesh::torus(1.0, self.tube, self.cells.0, self.cells.1)?.into())
    }
}

/// A die: a cube with rounded edges and corners.
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface.")]
pub struct RoundedDie {
    /// How round: 0 is a cube, 1 is a ball.
    #[param(default = 0.3, range = 0.0..=1.0, unit = "half sides", effect = "rounder edges")]
    pub rounding: f64,
    /// Cells along each side, two triangles each.
    #[param(default = 16, range = 3..=1024, unit = "cells", effect = "more: more triangles")]
    pub cells: u32,
}

impl Evaluate for RoundedDie {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(pelage_mesh::rounded_die(1.0, self.rounding, self.cells)?.into())
    }
}
