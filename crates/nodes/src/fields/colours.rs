//! Colours by numbers, numbers by colours, and the colours that a model comes with.

use std::sync::Arc;

use pelage_field::{ColourField, ScalarField};
use pelage_graph::{Colour, Context, Evaluate, Node, NodeError, Param};
use pelage_mesh::Mesh;

use crate::shading::linear;

/// Two colours, or two fields of them, mixed by numbers in linear light (L18).
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(colours: ColourField, "A colour for each vertex.")]
pub struct MixColours {
    /// How much of the second there is, 0 to 1; what is beyond comes to the nearer end.
    #[input]
    pub amounts: Arc<ScalarField>,
    /// The colours where the amount is 0; without them one colour everywhere.
    #[input]
    pub first: Option<Arc<ColourField>>,
    /// The colours where the amount is 1; without them one colour everywhere.
    #[input]
    pub second: Option<Arc<ColourField>>,
    /// The colour where the amount is 0 and no colours are linked.
    #[param(default = Colour([1.0, 1.0, 1.0]))]
    pub first_colour: Colour,
    /// The colour where the amount is 1 and no colours are linked.
    #[param(default = Colour([0.15, 0.12, 0.1]))]
    pub second_colour: Colour,
}

impl Evaluate for MixColours {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let count = self.amounts.values().len();
        let field = |linked: &Option<Arc<ColourField>>, colour| match linked {
            Some(linked) => Ok(Arc::clone(linked)),
            None => ColourField::new(vec![linear(colour); count]).map(Arc::new),
        };
        let (first, second) = (field(&self.first, self.first_colour)?, field(&self.second, self.second_colour)?);
        Ok(first.mixed(&second, &self.amounts)?.into())
    }
}

/// What of a colour is measured.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum ColourMeasure {
    /// How bright it is to the eye: its luminance.
    Luminance,
    /// Its red.
    Red,
    /// Its green.
    Green,
    /// Its blue.
    Blue,
}

/// A number of each colour in linear light, so that an image can say length or where a mask is.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex, 0 to 1.")]
pub struct ColourAmount {
    /// The colours.
    #[input]
    pub colours: Arc<ColourField>,
    /// What is measured.
    #[param(default = ColourMeasure::Luminance)]
    pub measure: ColourMeasure,
}

impl Evaluate for ColourAmount {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let values = self.colours.measured(|colour| match self.measure {
            // The weights of Rec. 709.
            ColourMeasure::Luminance => colour.dot(glam::Vec3::new(0.2126, 0.7152, 0.0722)),
            ColourMeasure::Red => colour.x,
            ColourMeasure::Green => colour.y,
            ColourMeasure::Blue => colour.z,
        })?;
        Ok(values.into())
    }
}

/// The colours that a model has at its vertices (L18), and their alpha as length (N5).
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(colours: ColourField, "A colour for each vertex.")]
#[output(lengths: ScalarField, "The alpha of each vertex: 1 is full length, 0 is bare.")]
pub struct VertexColours {
    /// The surface; its model must have colours.
    #[input]
    pub mesh: Arc<Mesh>,
}

impl Evaluate for VertexColours {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let (colours, lengths) = ColourField::of_vertices(&self.mesh)?;
        Ok(VertexColoursOutputs { colours: Some(Arc::new(colours)), lengths: Some(Arc::new(lengths)) })
    }
}
