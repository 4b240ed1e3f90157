//! Hair bent along guides, and two kinds of hair in one tile.

use std::sync::Arc;

use pelage_graph::{Context, Evaluate, Node, NodeError, Param};
use pelage_strand::{Guide, StrandTile};

/// A hair that others follow.
#[derive(Clone, Debug, PartialEq, Param)]
pub struct GuideHair {
    /// Where it stands in the tile; whole tiles make no difference.
    #[param(default = (0.5, 0.5), unit = "tile sides")]
    pub root: (f64, f64),
    /// Where it goes from its root, up to its tip: across the way the fur lies, along it, and up. At most 64 points, with a smooth curve through them.
    #[param(default = vec![(0.0, 0.0, 1.0)], range = -8.0..=8.0, unit = "heights", effect = "the shape of all hair nearby")]
    pub points: Vec<(f64, f64, f64)>,
}

/// Bends all hair of a tile along a few guides: hair that stands upright follows the curve between its natural neighbours among them, and curls wind about it.
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(strands: StrandTile, "The same hair, bent; the box as high as it is now.")]
pub struct GuideStrands {
    /// The hair, best grown without lean.
    #[input]
    pub strands: Arc<StrandTile>,
    /// The guides, at most 1024, no two in one place; none leave the hair as it is.
    #[param(default = Vec::new())]
    pub guides: Vec<GuideHair>,
}

impl Evaluate for GuideStrands {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        if self.guides.is_empty() {
            return Ok(Arc::clone(&self.strands).into());
        }
        let guide = |guide: &GuideHair| Guide {
            root: [guide.root.0, guide.root.1],
            points: guide.points.iter().map(|&(x, y, z)| [x, y, z]).collect(),
        };
        let guides: Vec<Guide> = self.guides.iter().map(guide).collect();
        Ok(pelage_strand::guided(&self.strands, &guides)?.into())
    }
}

/// Two kinds of hair in one tile: down under guard hairs as two coats, or two types side by side.
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(strands: StrandTile, "The hair of both, in a box as high as the higher.")]
pub struct MixStrands {
    /// One kind.
    #[input]
    pub first: Arc<StrandTile>,
    /// The other, grown by another seed, or its roots are in the same places.
    #[input]
    pub second: Arc<StrandTile>,
    /// How much of the first is kept, evenly over the tile.
    #[param(default = 1.0, range = 0.0..=1.0, unit = "fraction of its hairs", effect = "denser")]
    pub first_share: f64,
    /// How much of the second is kept, evenly over the tile.
    #[param(default = 1.0, range = 0.0..=1.0, unit = "fraction of its hairs", effect = "denser")]
    pub second_share: f64,
}

impl Evaluate for MixStrands {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(pelage_strand::mix([&self.first, &self.second], [self.first_share, self.second_share])?.into())
    }
}
