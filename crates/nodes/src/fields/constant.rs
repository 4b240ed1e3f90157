//! The same everywhere.

use std::sync::Arc;

use pelage_field::ScalarField;
use pelage_graph::{Context, Evaluate, Node, NodeError};
use pelage_mesh::Mesh;

/// The same number everywhere.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex.")]
pub struct ConstantField {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// The number.
    #[param(default = 1.0, range = -1000.0..=1000.0, unit = "value", effect = "as a length factor: shorter or longer fur")]
    pub value: f64,
}

impl Evaluate for ConstantField {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(ScalarField::constant(&self.mesh, self.value as f32)?.into())
    }
}
