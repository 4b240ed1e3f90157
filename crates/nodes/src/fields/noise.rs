//! Noise in space.

use std::sync::Arc;

use pelage_field::{Noise, NoiseKind, ScalarField};
use pelage_graph::{Context, Evaluate, Node, NodeError, Param};
use pelage_mesh::Mesh;

/// What noise looks like.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum NoiseLook {
    /// Clouds, on a cubic grid.
    Perlin,
    /// Clouds without the grid's axes to be seen.
    Simplex,
    /// Low at random places, one to a cell, and rising around them: spots.
    Dots,
    /// One number for all that is nearest to the same place: a giraffe's patches.
    Patches,
}

/// Noise in the space that the model stands in: the same at the same place, however the surface is cut into triangles.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex, 0 to 1.")]
pub struct NoiseField {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// What it looks like.
    #[param(default = NoiseLook::Perlin)]
    pub look: NoiseLook,
    /// Side of a cell. What is finer than the triangles is not seen; the pattern repeats after 256 cells.
    #[param(default = 0.15, range = 0.005..=100.0, unit = "model diameters", effect = "larger: fewer, larger spots")]
    pub size: f64,
    /// How many layers are added, each half as large as the one before.
    #[param(default = 3, range = 1..=12, unit = "layers", effect = "more: finer detail; cost is linear in it")]
    pub octaves: u32,
    /// How strong each layer is beside the one before.
    #[param(default = 0.5, range = 0.0..=1.0, unit = "fraction", effect = "larger: rougher")]
    pub roughness: f64,
    /// Which noise.
    #[param(default = 1, unit = "seed", effect = "another pattern of the same kind")]
    pub seed: u64,
}

impl Evaluate for NoiseField {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let kind = match self.look {
            NoiseLook::Perlin => NoiseKind::Perlin,
            NoiseLook::Simplex => NoiseKind::Simplex,
            NoiseLook::Dots => NoiseKind::Dots,
            NoiseLook::Patches => NoiseKind::Patches,
        };
        // The library's seeds have half as many bits.
        let seed = (self.seed ^ self.seed >> 32) as u32;
        let noise = Noise { kind, size: self.size, octaves: self.octaves, roughness: self.roughness, seed };
        Ok(ScalarField::noise(&self.mesh, &noise)?.into())
    }
}
