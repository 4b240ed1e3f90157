//! How to draw for an error or a time, by distance, from a trade-off table that was measured before.

mod quality;
mod table;

use std::sync::Arc;

use pelage_graph::{Context, Evaluate, FilePath, Node, NodeError, Param};

pub use quality::{OtherCoatError, Quality, TableRow};
pub use table::TableError;
use table::{Row, Rows};

use crate::Framing;

/// What is to be little.
#[derive(Clone, Copy, Debug, PartialEq, Param)]
pub enum FrameCost {
    /// Time, of the table's column `ms_min`. It compares the settings as the adapter they were measured on does.
    Ms,
    /// Samples that pass the tests, of the table's column `fragments`: on any adapter about the same.
    Fragments,
}

/// What a picture may cost, or how far it may err.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum FrameLimit {
    /// The cheapest setting within an error; if none is, the one that errs least.
    MaxError {
        /// The largest mean FLIP error, of the table's column `flip_mean`.
        #[param(default = 0.15, range = 0.0..=1.0, unit = "FLIP", effect = "larger: cheaper pictures")]
        flip: f64,
        /// What is to be little.
        #[param(default = FrameCost::Ms)]
        cost: FrameCost,
    },
    /// The setting that errs least within a time; if none is, the quickest.
    MaxMs {
        /// The longest time of a frame.
        #[param(default = 10.0, range = 0.0..=1e6, unit = "milliseconds", effect = "larger: better pictures")]
        ms: f64,
    },
    /// The setting that errs least within so many fragments; if none is, the one with the fewest.
    MaxFragments {
        /// The most samples that pass the tests.
        #[param(default = 1e6, range = 0.0..=1e15, unit = "samples", effect = "larger: better pictures")]
        fragments: f64,
    },
}

/// Picks how to draw from a table that `pelage measure` wrote, by how far the camera is and what a picture may cost.
///
/// Of the distances in the table the one counts that is nearest to the camera's and not beyond it, or the nearest of all where the camera is closer than any: what errs little from there
/// errs less from further away. Among equals the first row is taken.
#[derive(Node)]
#[node(category = "Picture", version = 3)]
#[output(quality: Quality, "How to draw, for a RenderImage.")]
pub struct Budget {
    /// From where: its margin is the distance.
    #[input]
    pub camera: Arc<Framing>,
    /// The table, CSV, of a sweep of this very coat that varies the `margin` of a Camera and inputs of a RenderImage: `detail`, `fins`, `lighting`, `direction_map`, `march`, `march_steps`, `hair_shadow`, `anisotropy`.
    #[param]
    pub table: FilePath,
    /// What a picture may cost, or how far it may err.
    #[param(default = FrameLimit::MaxError { flip: 0.15, cost: FrameCost::Ms })]
    pub limit: FrameLimit,
}

impl Evaluate for Budget {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let rows = Rows::read(self.table.as_path(), self.limit.column())?;
        Ok(self.limit.pick(&rows, self.camera.margin).quality.clone().into())
    }
}

impl FrameLimit {
    /// The column of costs that it looks at.
    fn column(&self) -> &'static str {
        match self {
            Self::MaxError { cost: FrameCost::Ms, .. } | Self::MaxMs { .. } => "ms_min",
            Self::MaxError { cost: FrameCost::Fragments, .. } | Self::MaxFragments { .. } => "fragments",
        }
    }

    /// The row to draw by, of those at the distance that counts.
    fn pick<'r>(&self, rows: &'r Rows, margin: f32) -> &'r Row {
        let near = rows
            .iter()
            .map(|row| row.figures.margin)
            .filter(|&at| at <= margin)
            .fold(None, |far: Option<f32>, at| Some(far.map_or(at, |far| far.max(at))));
        let closest = || rows.iter().map(|row| row.figures.margin).fold(f32::INFINITY, f32::min);
        let at = near.unwrap_or_else(closest);
        let here = || rows.iter().filter(|row| row.figures.margin == at);
        let by_cost = |a: &&Row, b: &&Row| a.figures.cost.total_cmp(&b.figures.cost).then(a.figures.error.total_cmp(&b.figures.error));
        let by_error = |a: &&Row, b: &&Row| a.figures.error.total_cmp(&b.figures.error).then(a.figures.cost.total_cmp(&b.figures.cost));
        let picked = match *self {
            Self::MaxError { flip, .. } => {
                here().filter(|row| row.figures.error <= flip).min_by(by_cost).or_else(|| here().min_by(by_error))
            }
            Self::MaxMs { ms: most } | Self::MaxFragments { fragments: most } => {
                here().filter(|row| row.figures.cost <= most).min_by(by_error).or_else(|| here().min_by(by_cost))
            }
        };
        picked.unwrap_or(rows.first())
    }
}
