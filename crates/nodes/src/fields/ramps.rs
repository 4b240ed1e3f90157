//! Fields that run from one end of the model to the other: height, say.

use std::sync::Arc;

use glam::DVec3;
use pelage_field::{ColourField, ScalarField};
use pelage_graph::{Colour, Context, Evaluate, Node, NodeError};
use pelage_mesh::Mesh;

use crate::shading::linear;

/// A number that grows from one end of the model to the other.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex.")]
pub struct ScalarRamp {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// From which end to which.
    #[param(default = [0.0, 1.0, 0.0], unit = "direction")]
    pub along: [f64; 3],
    /// The value at the near end.
    #[param(default = 0.0, range = -1000.0..=1000.0, unit = "value", effect = "as a length factor: shorter or longer fur at the near end")]
    pub from: f64,
    /// The value at the far end.
    #[param(default = 1.0, range = -1000.0..=1000.0, unit = "value", effect = "as a length factor: shorter or longer fur at the far end")]
    pub to: f64,
}

impl Evaluate for ScalarRamp {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(ScalarField::ramp(&self.mesh, DVec3::from(self.along), self.from as f32, self.to as f32)?.into())
    }
}

/// A colour that changes from one end of the model to the other (L18).
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(colours: ColourField, "A colour for each vertex.")]
pub struct ColourRamp {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// From which end to which.
    #[param(default = [0.0, 1.0, 0.0], unit = "direction")]
    pub along: [f64; 3],
    /// The colour at the near end.
    #[param(default = Colour([0.4, 0.4, 0.4]))]
    pub from: Colour,
    /// The colour at the far end.
    #[param(default = Colour([1.0, 1.0, 1.0]))]
    pub to: Colour,
}

impl Evaluate for ColourRamp {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(ColourField::ramp(&self.mesh, DVec3::from(self.along), linear(self.from), linear(self.to))?.into())
    }
}
