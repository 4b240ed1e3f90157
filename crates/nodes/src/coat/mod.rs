//! Laying fur on a surface.

mod curve;
mod dress;
mod edges;
mod lean;

use std::sync::Arc;

use pelage_coat::{Coat, FinTexture, ShellTexture};
use pelage_field::{ColourField, DirectionField, ScalarField};
use pelage_graph::{Colour, Context, Evaluate, Needs, Node, NodeError, Param, Params, Part, Wanted};
use pelage_mesh::Mesh;
use pelage_patch::{LappedPatches, PatchTiling};
use pelage_strand::StrandTile;

use crate::parts::{DIRECTIONS, FINS, LAYERS, LEVELS, LOOKS, SKIN};
use crate::shading::linear;
use dress::{Dressing, dress};

/// What the numbers of a length field do to the hair.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum LengthsAs {
    /// Factors of the length: hair of half the length is whole, tip and all, and as dense.
    Scale,
    /// Where along its length the hair is cut off, as by a clipper: blunt, and what is left stands as it stood. Past 1 it is whole.
    Cut,
}

/// How hair that is combed down lies.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum SlantAs {
    /// Turned down, and bent as `bend` says: as long as it was.
    Turned,
    /// Sheared along the surface, as Lengyel et al. 2001 do it (L20): straight, its tips as high as before, and longer by one over the cosine.
    Sheared,
}

/// Lays the hair tile on a tiled surface: how long the fur is, how it stands, what colour it has.
#[derive(Node)]
#[node(category = "Coat", version = 2)]
#[output(fur: Coat, "The coat, ready to draw.", parts = [SKIN, LAYERS, LEVELS, DIRECTIONS, FINS, LOOKS])]
pub struct LayFur {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// How the tile lies on it.
    #[input]
    pub patches: Arc<PatchTiling>,
    /// Patches that overlap (L6), to draw in place of those; fins still take their scale from them.
    #[input]
    pub lapped: Option<Arc<LappedPatches>>,
    /// The hair of the tile: its direction is lit. Without it the hair of the shells is taken to stand as the fur does, as hair of a pattern does.
    #[input]
    pub strands: Option<Arc<StrandTile>>,
    /// The hair as shell layers.
    #[input(required)]
    pub shells: Option<Arc<ShellTexture>>,
    /// The hair as a fin; without one no fins are drawn.
    #[input]
    pub fin: Option<Arc<FinTexture>>,
    /// Which way the fur lies; without it the fur stands straight up.
    #[input]
    pub directions: Option<Arc<DirectionField>>,
    /// For each vertex how much of the length there is; 0 is bare (L19, N5).
    #[input]
    pub lengths: Option<Arc<ScalarField>>,
    /// For each vertex how far the fur is combed down along the directions, in degrees from upright up to 80: in place of `slant`.
    #[input]
    pub slants: Option<Arc<ScalarField>>,
    /// Colours that multiply the hair's own (L18).
    #[input]
    pub colours: Option<Arc<ColourField>>,
    /// Of hair that is coats in a row, which stands where: 0 is the first, 1 the second, and between them some of either (L24, K12). Without it the first stands everywhere.
    #[input]
    pub coats: Option<Arc<ScalarField>>,
    /// Length of the fur, from the skin to the outermost shell.
    #[param(default = 0.016, range = 0.0..=10.0, unit = "model diameters", effect = "longer: more fragments, and gaps between too few layers")]
    pub length: f64,
    /// How far the fur is combed down along the directions.
    #[param(default = 0.0, range = -80.0..=80.0, unit = "degrees", effect = "past 45 layers no longer hide each other's gaps")]
    pub slant: f64,
    /// How much of the slant comes from bending: the tips lean by the slant, the roots by what is left of it. The length along the hair is kept.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction of the slant", effect = "0: straight; 1: hair leaves the skin upright; none on cost")]
    pub bend: f64,
    /// What combing does to the hair.
    #[param(default = SlantAs::Turned)]
    pub slant_as: SlantAs,
    /// What the lengths do: stretch the hair, or cut it.
    #[param(default = LengthsAs::Scale)]
    pub lengths_as: LengthsAs,
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
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        self.check_sizes()?;
        let coat = dress(&Dressing {
            mesh: &self.mesh,
            tiling: &self.patches,
            lapped: self.lapped.as_deref(),
            directions: self.directions.as_deref(),
            lengths: self.lengths.as_deref(),
            colours: self.colours.as_deref(),
            coats: self.coats.as_deref(),
            shells: self.shells.clone().unwrap_or_else(|| Arc::new(ShellTexture::bare())),
            fin: self.fin.clone(),
            strands: self.strands.as_deref(),
            length: self.length,
            slant: self.slant.to_radians(),
            slants: self.slants.as_deref(),
            bend: self.bend,
            sheared: self.slant_as == SlantAs::Sheared,
            cut: self.lengths_as == LengthsAs::Cut,
            tint: linear(self.tint),
            looks: cx.wants_part("fur", LOOKS),
            seed: self.seed,
        });
        coat.check()?;
        Ok(coat.into())
    }

    fn needs(wanted: &Wanted<'_>, params: &Params<'_>) -> Needs {
        let shells = shell_parts(wanted, params);
        let mut needs = shells.iter().fold(Needs::all().parts("shells", shells.iter().copied()), |needs, &part| needs.present(part));
        if shells.is_empty() && !wanted.part(SKIN) {
            needs = needs.without("shells");
        }
        if !wanted.part(FINS) {
            needs = needs.without("fin");
        }
        if !wanted.part(LOOKS) {
            needs = needs.without("colours");
        }
        if params.is_linked("fin") { needs } else { needs.absent(FINS) }
    }
}

/// The parts of the shells that the coat has to have.
fn shell_parts(wanted: &Wanted<'_>, params: &Params<'_>) -> Vec<Part> {
    let cut = params.is_linked("lengths") && params.get("lengths_as") != Some(LengthsAs::Scale);
    // Hair that is cut off ends over the distance between two shells, on fins too.
    let needed = |part| wanted.part(part) || part == LAYERS && cut && wanted.part(FINS) && params.is_linked("fin");
    [LAYERS, LEVELS, DIRECTIONS].into_iter().filter(|&part| needed(part)).collect()
}

impl LayFur {
    fn check_sizes(&self) -> Result<(), OtherMesh> {
        let topology = self.mesh.topology();
        let vertices = topology.vertex_count();
        let fields = [
            ("the direction field", self.directions.as_ref().map(|f| f.vectors().len())),
            ("the field of slants", self.slants.as_ref().map(|f| f.values().len())),
            ("the length field", self.lengths.as_ref().map(|f| f.values().len())),
            ("the field of coats", self.coats.as_ref().map(|f| f.values().len())),
            ("the colour field", self.colours.as_ref().map(|f| f.values().len())),
        ];
        for (what, found) in fields {
            if let Some(found) = found.filter(|&found| found != vertices) {
                return Err(OtherMesh { what, found, expected: vertices, unit: "vertices" });
            }
        }
        let last = self.lapped.as_ref().and_then(|lapped| lapped.points().iter().map(|point| point.face.index()).max());
        if let Some(found) = last.map(|last| last + 1).filter(|&found| found > topology.face_count()) {
            return Err(OtherMesh { what: "the overlapping patches", found, expected: topology.face_count(), unit: "faces" });
        }
        let (found, expected) = (self.patches.patch_of_face().len(), topology.face_count());
        if found == expected { Ok(()) } else { Err(OtherMesh { what: "the tiling", found, expected, unit: "faces" }) }
    }
}
