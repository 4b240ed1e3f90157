//! Painted strokes, kept in the graph.

use std::sync::Arc;

use glam::DVec3;
use pelage_field::{ScalarField, Stroke};
use pelage_graph::{Context, Evaluate, Node, NodeError, Param};
use pelage_mesh::Mesh;

/// A line painted on the surface with a round brush.
#[derive(Clone, Debug, PartialEq, Param)]
pub struct PaintedStroke {
    /// The places that it goes through, in model units: on the surface, or off it by less than the radius. One is a dab.
    #[param(default = Vec::new(), unit = "model units")]
    pub points: Vec<[f64; 3]>,
    /// How far it reaches, along the surface.
    #[param(default = 0.05, range = 0.0001..=10.0, unit = "model diameters", effect = "wider; the cost is that of the faces it reaches")]
    pub radius: f64,
    /// Which part of the radius the edge takes.
    #[param(default = 0.5, range = 0.0..=1.0, unit = "fraction of the radius", effect = "0 is hard, 1 soft from the middle on")]
    pub softness: f64,
    /// What it paints.
    #[param(default = 1.0, range = -1000.0..=1000.0, unit = "value", effect = "as a length factor: 0 shaves")]
    pub value: f64,
}

/// Numbers painted on the surface, stroke over stroke; and how far the strokes are.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex: the strokes' values over the background.")]
#[output(distances: ScalarField, "How far each vertex is from the nearest stroke's line, along the surface, in model diameters; 10 where that is farther.")]
pub struct StrokeField {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// The strokes, each over those before.
    #[param(default = Vec::new())]
    pub strokes: Vec<PaintedStroke>,
    /// What is there without a stroke.
    #[param(default = 0.0, range = -1000.0..=1000.0, unit = "value", effect = "as a length factor: shorter or longer fur")]
    pub background: f64,
}

impl Evaluate for StrokeField {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let strokes: Vec<Stroke> = self.strokes.iter().map(PaintedStroke::stroke).collect();
        let values = cx.wants("values").then(|| ScalarField::strokes(&self.mesh, &strokes, self.background as f32)).transpose()?;
        let distances = cx.wants("distances").then(|| ScalarField::distance_to_strokes(&self.mesh, &strokes)).transpose()?;
        Ok(StrokeFieldOutputs { values: values.map(Arc::new), distances: distances.map(Arc::new) })
    }
}

impl PaintedStroke {
    fn stroke(&self) -> Stroke {
        let points = self.points.iter().map(|&at| DVec3::from(at)).collect();
        Stroke { points, radius: self.radius, softness: self.softness, value: self.value as f32 }
    }
}
