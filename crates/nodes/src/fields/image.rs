//! Images laid on the surface.

use std::sync::Arc;

use pelage_field::{ColourField, ScalarField};
use pelage_graph::{Context, Evaluate, FilePath, Node, NodeError};
use pelage_mesh::Mesh;

use crate::images::Pixels;

/// An image laid on the surface through the model's own texture coordinates: colour (L18), and length in its alpha (N5).
#[derive(Node)]
#[node(category = "Fields", version = 2)]
#[output(colours: ColourField, "The image's colour at each vertex.")]
#[output(lengths: ScalarField, "The image's alpha at each vertex: 1 is full length, 0 is bare.")]
pub struct ImageField {
    /// The surface; it must have texture coordinates.
    #[input]
    pub mesh: Arc<Mesh>,
    /// A PNG or JPEG file of up to 16,384 pixels a side; colour or grey, of 8 or 16 bits.
    #[param]
    pub path: FilePath,
}

impl Evaluate for ImageField {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let pixels = Pixels::read(self.path.as_path())?;
        let (colours, lengths) = ColourField::from_image(&self.mesh, &pixels.image()?)?;
        Ok(ImageFieldOutputs { colours: Some(Arc::new(colours)), lengths: Some(Arc::new(lengths)) })
    }
}
