//! Hair sampled into textures.

use std::sync::Arc;

use pelage_coat::{FinTexture, ShellTexture};
use pelage_graph::{Colour, Context, Evaluate, Needs, Node, NodeError, Param, Params, Wanted};
use pelage_strand::StrandTile;
use pelage_volume::{FinAcross, FinSettings, ShellSettings, Spacing};

use super::convert::{fin_texture, shell_texture};
use super::row::{joined, mixtures};
use crate::parts::{DIRECTIONS, LAYERS};
use crate::shading::linear;

/// How the heights of shells follow from their numbers, from 0 at the skin to 1 at the tips (K4).
#[derive(Clone, Debug, PartialEq, Param)]
pub enum ShellSpacing {
    /// All as far apart.
    Even,
    /// 1 - (1 - x)^p: outer shells closer together above 1, inner ones below.
    Power {
        /// The exponent.
        #[param(default = 1.5, range = 0.1..=4.0, unit = "exponent", effect = "larger: outer shells closer together; none on cost")]
        power: f64,
    },
    /// (1 - e^(-r x)) / (1 - e^(-r)): outer shells closer together above 0, inner ones below.
    Exponential {
        /// The rate.
        #[param(default = 1.0, range = -8.0..=8.0, unit = "rate", effect = "larger: outer shells closer together; none on cost")]
        rate: f64,
    },
}

impl From<&ShellSpacing> for Spacing {
    fn from(spacing: &ShellSpacing) -> Self {
        match *spacing {
            ShellSpacing::Even => Self::Even,
            ShellSpacing::Power { power } => Self::Power(power),
            ShellSpacing::Exponential { rate } => Self::Exponential(rate),
        }
    }
}

/// Whether textures are fine enough for the curls of their hair.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurlReport {
    /// What part of all hairs goes round, or forth and back, at least once.
    pub share: f64,
    /// How wide the median curl is, in texels; under 1 no texture can show it. 0 without curls.
    pub texels: f64,
    /// How many layers a curl climbs through in one turn; under 2 its layers are as if drawn at random. 0 without curls.
    pub layers: f64,
}

impl CurlReport {
    fn of(strands: &StrandTile, layers: u32, resolution: u32) -> Self {
        let Some(curls) = strands.curls() else { return Self::default() };
        let gap = strands.height() / f64::from(layers.saturating_sub(1).max(1));
        Self { share: curls.share, texels: curls.width * f64::from(resolution), layers: curls.rise / gap }
    }

    /// What is wrong and how to mend it, if a tenth of the hair or more curls too finely.
    pub fn warning(&self) -> Option<String> {
        if self.share < 0.1 {
            return None;
        }
        if self.texels < 1.0 {
            return Some(format!("curls are {:.2} texels wide and are not seen: raise the resolution, or make curls wider", self.texels));
        }
        (self.layers < 2.0)
            .then(|| format!("curls climb {:.1} layers in a turn and look broken: use more layers, or fewer turns", self.layers))
    }
}

/// Shell layers by a tall Gaussian filter against the strands (L8).
#[derive(Node)]
#[node(category = "Hair", version = 4)]
#[output(shells: ShellTexture, "The layers, innermost first.", parts = [LAYERS, DIRECTIONS])]
#[output(report: CurlReport, "Whether they are fine enough for the hair's curls.")]
pub struct SampleShells {
    /// The hair.
    #[input]
    pub strands: Arc<StrandTile>,
    /// Shells from the skin to the tips, both included.
    #[param(default = 16, range = 1..=256, unit = "layers", effect = "more: smoother fur at a slant; fragments and memory are linear in it")]
    pub layers: u32,
    /// Where the shells stand; hair is sampled at those heights, each shell reaching half way to its neighbours.
    #[param(default = ShellSpacing::Even)]
    pub spacing: ShellSpacing,
    /// Texels along the tile's side; a power of two.
    #[param(default = 128, range = 1..=2048, unit = "texels", effect = "more: finer hair close up; memory goes with its square")]
    pub resolution: u32,
    /// Deviation of the filter across the hair, beside the texel's own box.
    #[param(default = 0.35, range = 0.0..=1024.0, unit = "texels", effect = "larger: softer; under 0.5 aliases a little")]
    pub softness: f64,
    /// Colour of the skin under the hair.
    #[param(default = Colour([0.366, 0.304, 0.26]))]
    pub skin_colour: Colour,
    /// Whether the hair's mean direction is kept for every texel, for lighting by pixel (L15). It takes as much memory as the layers.
    #[param(default = false)]
    pub directions: bool,
    /// What heights are scaled by before directions are taken: the fur's length on the surface over the height of the hair's box laid on it.
    #[param(default = 1.0, range = 0.001..=1000.0, unit = "ratio", effect = "larger: hair stands more upright to the light; none on cost")]
    pub stretch: f64,
    /// Of coats in a row: into how many steps the way from one to the next is cut, at each of which its hair is sampled.
    #[param(default = 4, range = 1..=32, unit = "mixtures from a coat to the next", effect = "more: between two of them less hair is seen faintly; memory is linear in it; none for hair of one coat")]
    pub mixtures: u32,
}

impl Evaluate for SampleShells {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let settings = ShellSettings {
            layers: self.layers,
            spacing: Spacing::from(&self.spacing),
            resolution: self.resolution,
            lateral_sigma: self.softness,
            skin_colour: linear(self.skin_colour).to_array(),
            directions: (self.directions && cx.wants_part("shells", DIRECTIONS)).then_some(self.stretch),
            ..ShellSettings::default()
        };
        let sample = if cx.wants_part("shells", LAYERS) { pelage_volume::sample_shells } else { pelage_volume::sample_skin };
        let stacks = mixtures(&self.strands, self.mixtures, |strands| Ok(shell_texture(sample(strands, &settings)?)))?;
        let shells = joined(stacks, ShellTexture::joined)?;
        let report = cx.wants("report").then(|| Arc::new(CurlReport::of(&self.strands, self.layers, self.resolution)));
        Ok(SampleShellsOutputs { shells: Some(Arc::new(shells)), report })
    }

    fn needs(_: &Wanted<'_>, params: &Params<'_>) -> Needs {
        if params.get::<bool>("directions").unwrap_or(true) { Needs::all() } else { Needs::all().absent(DIRECTIONS) }
    }
}

/// From which side a fin sees the hair.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum FinDirection {
    /// Against the way the fur lies: leaning hair leans neither left nor right.
    Front,
    /// Across the way the fur lies: leaning hair is seen in profile.
    Side,
}

/// A fin: a slab of the hair, composited as it is seen from its side (L9).
#[derive(Node)]
#[node(category = "Hair", version = 3)]
#[output(fin: FinTexture, "The fin.")]
pub struct SampleFin {
    /// The hair; it may be other hair than the shells'.
    #[input]
    pub strands: Arc<StrandTile>,
    /// Texels along and up the fin; powers of two.
    #[param(default = (512, 64), range = 1..=8192, unit = "texels", effect = "more: finer hair at the silhouette")]
    pub size: (u32, u32),
    /// Depth of the slab.
    #[param(default = 0.12, range = 0.001..=1.0, unit = "tile sides", effect = "deeper: denser fins")]
    pub slab_width: f64,
    /// Tiles that the fin shows side by side.
    #[param(default = 3, range = 1..=64, unit = "tiles", effect = "more: fins repeat less, with fewer texels a hair")]
    pub tiles_across: u32,
    /// From which side the hair is seen.
    #[param(default = FinDirection::Front)]
    pub seen_from: FinDirection,
    /// Of coats in a row: as many as those of the shells.
    #[param(default = 4, range = 1..=32, unit = "mixtures from a coat to the next", effect = "as those of the shells")]
    pub mixtures: u32,
}

impl Evaluate for SampleFin {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let settings = FinSettings {
            width: self.size.0,
            height: self.size.1,
            slab_width: self.slab_width,
            tiles_across: self.tiles_across,
            across: match self.seen_from {
                FinDirection::Front => FinAcross::S,
                FinDirection::Side => FinAcross::T,
            },
            ..FinSettings::default()
        };
        let fins = mixtures(&self.strands, self.mixtures, |strands| Ok(fin_texture(pelage_volume::sample_fin(strands, &settings)?)))?;
        Ok(joined(fins, FinTexture::joined)?.into())
    }
}
