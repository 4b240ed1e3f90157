//! Laying fur on a surface.

mod dress;
mod edges;

use std::sync::Arc;

use pelage_coat::{Coat, FinTexture, ShellTexture};
use pelage_field::{ColourField, DirectionField, ScalarField};
use pelage_graph::{Colour, Context, Evaluate, Node, NodeError};
use pelage_mesh::Mesh;
use pelage_patch::PatchTiling;
use pelage_strand::StrandTile;

use crate::shading::linear;
use dress::{Dressing, dress};

/// Lays the hair tile on a tiled surface: how long the fur is, how it stands, what colour it has.
#[derive(Node)]
#[node(category = "Coat", version = 1)]
#[output(fur: Coat, "The coat, ready to draw.")]
pub struct LayFur {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// How the tile lies on it.
    #[input]
    pub patches: Arc<PatchTiling>,
    /// The hair of the tile: its direction is lit.
    #[input]
    pub strands: Arc<StrandTile>,
    /// The hair as shell layers.
    #[input]
    pub shells: Arc<ShellTexture>,
    /// The hair as a fin; without one no fins are drawn.
    #[input]
    pub fin: Option<Arc<FinTexture>>,
    /// Which way the fur lies; without it the fur stands straight up.
    #[input]
    pub directions: Option<Arc<DirectionField>>,
    /// Factors of the length; 0 is bare (L19, N5).
    #[input]
    pub lengths: Option<Arc<ScalarField>>,
    /// Colours that multiply the hair's own (L18).
    #[input]
    pub colours: Option<Arc<ColourField>>,
    /// Length of the fur, from the skin to the outermost shell.
    #[param(default = 0.016, range = 0.0..=10.0, unit = "model diameters", effect = "longer: more fragments, and gaps between too few layers")]
    pub length: f64,
    /// How far the fur is combed down along the directions; its length is kept.
    #[param(default = 0.0, range = -80.0..=80.0, unit = "degrees", effect = "past 45 layers no longer hide each other's gaps")]
    pub slant: f64,
    /// Multiplies every colour.
    #[param(default = Colour([1.0, 1.0, 1.0]))]
    pub tint: Colour,
    /// Where the fins' random places come from.
    #[param(default = 1, unit = "seed", effect = "other hairs on the fins")]
    pub seed: u64,
}

/// Fields and tiling belong to another mesh.
#[derive(Debug, thiserror::Error)]
#[error("{what} has {found} entries, but the mesh has {expected} {unit}; link both to the same mesh")]
struct OtherMesh {
    what: &'static str,
    found: usize,
    expected: usize,
    unit: &'static str,
}

impl Evaluate for LayFur {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        self.check_sizes()?;
        let coat = dress(&Dressing {
            mesh: &self.mesh,
            tiling: &self.patches,
            directions: self.directions.as_deref(),
            lengths: self.lengths.as_deref(),
            colours: self.colours.as_deref(),
            shells: Arc::clone(&self.shells),
            fin: self.fin.clone(),
            strands: &self.strands,
            length: self.length,
            slant: self.slant.to_radians(),
            tint: linear(self.tint),
            seed: self.seed,
        });
        coat.check()?;
        Ok(coat.into())
    }
}

impl LayFur {
    fn check_sizes(&self) -> Result<(), OtherMesh> {
        let topology = self.mesh.topology();
        let vertices = topology.vertex_count();
        let fields = [
            ("the direction field", self.directions.as_ref().map(|f| f.vectors().len())),
            ("the length field", self.lengths.as_ref().map(|f| f.values().len())),
            ("the colour field", self.colours.as_ref().map(|f| f.values().len())),
        ];
        for (what, found) in fields {
            if let Some(found) = found.filter(|&found| found != vertices) {
                return Err(OtherMesh { what, found, expected: vertices, unit: "vertices" });
            }
        }
        let (found, expected) = (self.patches.patch_of_face().len(), topology.face_count());
        if found == expected { Ok(()) } else { Err(OtherMesh { what: "the tiling", found, expected, unit: "faces" }) }
    }
}
