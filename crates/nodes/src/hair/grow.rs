//! Growing hair.

use pelage_graph::{Colour, Context, Evaluate, Node, NodeError, Param};
use pelage_strand::{ByNoise, ByPattern, Gather, GrowSettings, Opacity, StrandTile, Style, Taper, Undercoat};

use super::kinds::{HairBand, HairGather, HairNoise, HairOpacity, HairPattern, HairStyle, HairTaper, bands};
use crate::shading::linear;

/// The down between the guard hairs: deep layers become dense by it, upper ones stay open.
#[derive(Clone, Debug, PartialEq, Param)]
pub struct HairUndercoat {
    /// Strands in a tile; 0 leaves the undercoat out.
    #[param(default = 3200, range = 0..=1000000, unit = "strands a tile", effect = "denser; cost is linear in it")]
    pub count: u32,
    /// Height of the longest.
    #[param(default = 0.55, range = 0.05..=1.0, unit = "heights of the guard hairs", effect = "how far up the coat is solid")]
    pub length: f64,
    /// Radius at the root.
    #[param(default = 0.7, range = 0.05..=4.0, unit = "radii of the guard hairs", effect = "thicker down")]
    pub thickness: f64,
    /// Its colour.
    #[param(default = Colour([0.584, 0.532, 0.473]))]
    pub colour: Colour,
}

/// Hair grown by a particle simulation in a box that is toroidal along both skin axes (L7).
#[derive(Node)]
#[node(category = "Hair", version = 2)]
#[output(strands: StrandTile, "The hair of one tile.")]
pub struct GrowStrands {
    /// Shape around the way of growth.
    #[param(default = HairStyle::Wavy { amplitude: 0.008 / 0.35, waves: 1.2 })]
    pub style: HairStyle,
    /// Guard hairs in a tile.
    #[param(default = 1400, range = 0..=1000000, unit = "strands a tile", effect = "100 is sparse, 1000 dense; cost is linear in it")]
    pub count: u32,
    /// Height that the longest hair reaches.
    #[param(default = 0.35, range = 0.001..=8.0, unit = "tile sides", effect = "the proportions of a hair; the coat sets its length on the surface")]
    pub height: f64,
    /// How much shorter hairs may be.
    #[param(default = 0.5, range = 0.0..=0.95, unit = "fraction of the height", effect = "larger: a more ragged silhouette")]
    pub length_variation: f64,
    /// Radius at the root.
    #[param(default = 0.0095, range = 0.000001..=0.25, unit = "tile sides", effect = "thicker hair; under half a texel it turns translucent")]
    pub thickness: f64,
    /// How much thicker or thinner hairs may be, constant along each.
    #[param(default = 0.15, range = 0.0..=0.95, unit = "fraction", effect = "less even hair")]
    pub thickness_variation: f64,
    /// Radius at the tip.
    #[param(default = 0.15, range = 0.0..=1.0, unit = "radii at the root", effect = "blunter tips")]
    pub tip_thickness: f64,
    /// How much thicker or thinner tips may be.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "less even tips")]
    pub tip_variation: f64,
    /// How the radius goes from root to tip.
    #[param(default = HairTaper::Power { exponent: 2.0 })]
    pub taper: HairTaper,
    /// From upright towards the way the fur lies.
    #[param(default = 22.0, range = 0.0..=75.0, unit = "degrees", effect = "hair leans within its tile, so layers differ more")]
    pub lean: f64,
    /// How much more or less than others a hair may bend, lean and gravity.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "hairs lie in layers")]
    pub bend_variation: f64,
    /// How much each hair's heading differs.
    #[param(default = 10.0, range = 0.0..=60.0, unit = "degrees", effect = "more unruly")]
    pub splay: f64,
    /// Pull back to the heading.
    #[param(default = 3.0, range = 0.0..=100.0, unit = "per length grown", effect = "0 is free, 100 stiff")]
    pub stiffness: f64,
    /// Pull towards the skin.
    #[param(default = 0.5, range = 0.0..=20.0, unit = "per length grown", effect = "tips lie lower")]
    pub gravity: f64,
    /// Smooth random sideways push, half of it shared by neighbours.
    #[param(default = 0.4, range = 0.0..=20.0, unit = "per length grown", effect = "more irregular")]
    pub wander: f64,
    /// How strongly hairs keep clear of each other.
    #[param(default = 0.6, range = 0.0..=20.0, unit = "per length grown", effect = "more even")]
    pub separation: f64,
    /// How far tips gather into locks.
    #[param(default = 0.15, range = 0.0..=1.0, unit = "fraction", effect = "1 gathers them to points")]
    pub clump: f64,
    /// Width of a lock.
    #[param(default = 0.1, range = 0.01..=1.0, unit = "tile sides", effect = "fewer, wider locks")]
    pub clump_size: f64,
    /// How hairs lie in locks, as wide as those of the clump.
    #[param(default = HairGather::Free)]
    pub gather: HairGather,
    /// Colour at the root.
    #[param(default = Colour([0.437, 0.374, 0.313]))]
    pub root_colour: Colour,
    /// Colour at the tip.
    #[param(default = Colour([0.735, 0.672, 0.602]))]
    pub tip_colour: Colour,
    /// How much the brightness differs from hair to hair.
    #[param(default = 0.3, range = 0.0..=1.0, unit = "fraction", effect = "larger: single hairs show more")]
    pub colour_variation: f64,
    /// Colours along the guard hairs, from root to tip, in the place of those at root and tip: at most 8, as an agouti's bands. None: two colours.
    #[param(default = Vec::new())]
    pub bands: Vec<HairBand>,
    /// What part of all hairs is white.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "greyer")]
    pub white: f64,
    /// How opaque hairs are.
    #[param(default = HairOpacity::WHOLE)]
    pub opacity: HairOpacity,
    /// What smooth noise takes away from place to place.
    #[param(default = HairNoise::NONE)]
    pub by_noise: HairNoise,
    /// What a pattern takes away from place to place.
    #[param(default = HairPattern::NONE)]
    pub by_pattern: HairPattern,
    /// The down between the guard hairs.
    #[param(default = HairUndercoat { count: 3200, length: 0.55, thickness: 0.7, colour: Colour([0.584, 0.532, 0.473]) })]
    pub undercoat: HairUndercoat,
    /// Time steps of the simulation, and segments of a strand.
    #[param(default = 24, range = 1..=512, unit = "steps", effect = "smoother hair; cost is linear in it")]
    pub steps: u32,
    /// Of everything random.
    #[param(default = 25, unit = "seed", effect = "other hair of the same kind")]
    pub seed: u64,
}

impl Evaluate for GrowStrands {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let settings = GrowSettings {
            count: self.count,
            height: self.height,
            length_variation: self.length_variation,
            thickness: self.thickness,
            thickness_variation: self.thickness_variation,
            tip_thickness: self.tip_thickness,
            tip_variation: self.tip_variation,
            taper: Taper::try_from(&self.taper)?,
            style: Style::from(&self.style),
            lean: self.lean,
            bend_variation: self.bend_variation,
            splay: self.splay,
            stiffness: self.stiffness,
            gravity: self.gravity,
            wander: self.wander,
            separation: self.separation,
            clump: self.clump,
            clump_size: self.clump_size,
            gather: Gather::from(&self.gather),
            root_colour: linear(self.root_colour).to_array(),
            tip_colour: linear(self.tip_colour).to_array(),
            colour_variation: self.colour_variation,
            bands: bands(&self.bands)?,
            white: self.white,
            opacity: Opacity::from(&self.opacity),
            by_noise: ByNoise::from(&self.by_noise),
            by_pattern: ByPattern::from(&self.by_pattern),
            undercoat: Undercoat {
                count: self.undercoat.count,
                length: self.undercoat.length,
                thickness: self.undercoat.thickness,
                colour: linear(self.undercoat.colour).to_array(),
            },
            steps: self.steps,
            seed: self.seed,
        };
        Ok(pelage_strand::grow(&settings)?.into())
    }
}
