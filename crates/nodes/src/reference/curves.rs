//! The hair on the surface as curves.

use std::sync::Arc;

use pelage_coat::Coat;
use pelage_graph::{Context, Evaluate, Needs, Node, NodeError, Param, Params, Wanted};
use pelage_reference::{Curves, Laying, Placement, Scene};
use pelage_strand::StrandTile;

/// Which hair there is.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum HairPlacement {
    /// What infinitely many shells would draw: cut at the outlines of patches.
    Shell,
    /// Each hair whole whose root is on a patch. The difference is what seams cost.
    Free,
}

impl From<&HairPlacement> for Placement {
    fn from(placement: &HairPlacement) -> Self {
        match placement {
            HairPlacement::Shell => Self::Shell,
            HairPlacement::Free => Self::Free,
        }
    }
}

/// The real strands on the surface as curves, for other ray tracers; `pelage curves` writes them to a file.
#[derive(Node)]
#[node(category = "Picture", version = 1)]
#[output(curves: Curves, "Places and radii of every hair from root to tip, in diameters of the model about the centre of its bounding box.")]
pub struct StrandCurves {
    /// The coat.
    #[input]
    pub fur: Arc<Coat>,
    /// The hair of its tile.
    #[input]
    pub strands: Arc<StrandTile>,
    /// Which hair there is.
    #[param(default = HairPlacement::Free)]
    pub placement: HairPlacement,
    /// How far a hair may be from its true curve.
    #[param(default = 0.1, range = 0.0001..=1.0, unit = "radii of the hair", effect = "smaller: more segments, one over its root")]
    pub tolerance: f64,
}

impl Evaluate for StrandCurves {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let laying = Laying { placement: Placement::from(&self.placement), tolerance: self.tolerance, ..Laying::default() };
        Ok(Scene::new(&self.fur, &self.strands, &laying)?.curves()?.into())
    }

    fn needs(_: &Wanted<'_>, _: &Params<'_>) -> Needs {
        // How the surface lies and how long its fur is.
        Needs::all().parts("fur", [])
    }
}
