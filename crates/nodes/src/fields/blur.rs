//! Blurring along the surface.

use std::sync::Arc;

use pelage_field::{ColourField, ScalarField};
use pelage_graph::{Context, Evaluate, Node, NodeError};
use pelage_mesh::Mesh;

/// Numbers blurred along the surface, as heat spreads: their sum over the area stays, and none leaves the range there was.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex.")]
pub struct BlurField {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// The numbers.
    #[input]
    pub values: Arc<ScalarField>,
    /// The deviation of the Gaussian that it is blurred by.
    #[param(default = 0.02, range = 0.0..=10.0, unit = "model diameters", effect = "wider; 0 changes nothing; the cost hardly depends on it")]
    pub radius: f64,
}

impl Evaluate for BlurField {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(self.values.blurred(&self.mesh, self.radius)?.into())
    }
}

/// Colours blurred along the surface, in linear light.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(colours: ColourField, "A colour for each vertex.")]
pub struct BlurColours {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// The colours.
    #[input]
    pub colours: Arc<ColourField>,
    /// The deviation of the Gaussian that they are blurred by.
    #[param(default = 0.02, range = 0.0..=10.0, unit = "model diameters", effect = "wider; 0 changes nothing; the cost hardly depends on it")]
    pub radius: f64,
}

impl Evaluate for BlurColours {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(self.colours.blurred(&self.mesh, self.radius)?.into())
    }
}
