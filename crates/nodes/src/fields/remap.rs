//! Numbers brought to another range, and masks.

use std::sync::Arc;

use pelage_field::{Course, ScalarField};
use pelage_graph::{Context, Evaluate, Node, NodeError, Param};

/// How numbers go from the start of a range to its end.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum RemapCourse {
    /// Straight.
    Straight,
    /// Slowly at both ends.
    Smooth,
    /// Along a curve through points, without hills but at points.
    Curve {
        /// Where between the ends of the first range, 0 to 1 and rising, and where between those of the second, 0 to 1 as a rule; at least two.
        #[param(default = vec![[0.0, 0.0], [1.0, 1.0]], unit = "fractions")]
        points: Vec<[f64; 2]>,
    },
    /// Forth and back: stripes.
    Waves {
        /// How often.
        #[param(default = 4.0, range = 0.0..=1000.0, unit = "waves", effect = "more, narrower stripes")]
        count: f64,
    },
}

/// Numbers of one range brought to another; what lies beyond an end comes to that end.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex.")]
pub struct RemapField {
    /// The numbers.
    #[input]
    pub values: Arc<ScalarField>,
    /// The range that they have: its start and its end, which may be the lesser.
    #[param(default = [0.0, 1.0], range = -1000.0..=1000.0, unit = "values", effect = "narrower: steeper")]
    pub from: [f64; 2],
    /// What its start and its end become.
    #[param(default = [0.0, 1.0], range = -1000.0..=1000.0, unit = "values", effect = "as a length factor: shorter or longer fur")]
    pub to: [f64; 2],
    /// How it goes between them.
    #[param(default = RemapCourse::Straight)]
    pub course: RemapCourse,
}

impl Evaluate for RemapField {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let course = match &self.course {
            RemapCourse::Straight => Course::Straight,
            RemapCourse::Smooth => Course::Smooth,
            RemapCourse::Curve { points } => Course::Curve(points.iter().map(|&[x, y]| (x, y)).collect()),
            RemapCourse::Waves { count } => Course::Waves(*count),
        };
        Ok(self.values.remapped(self.from.into(), self.to.into(), &course)?.into())
    }
}

/// 1 where numbers are over a threshold, 0 where they are under it, with a soft edge.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex, 0 to 1.")]
pub struct MaskField {
    /// The numbers.
    #[input]
    pub values: Arc<ScalarField>,
    /// What they have to be over.
    #[param(default = 0.5, range = -1000.0..=1000.0, unit = "value", effect = "higher: less of the surface")]
    pub threshold: f64,
    /// Over how much of the numbers the edge goes, half of it on either side.
    #[param(default = 0.1, range = 0.0..=1000.0, unit = "value", effect = "0: a hard edge, which shows the triangles")]
    pub softness: f64,
    /// 1 under the threshold instead.
    #[param(default = false)]
    pub invert: bool,
}

impl Evaluate for MaskField {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let mask = self.values.mask(self.threshold, self.softness)?;
        Ok(if self.invert { mask.map(|value| 1.0 - value)? } else { mask }.into())
    }
}
