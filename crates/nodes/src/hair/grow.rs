//! Growing hair.

use pelage_graph::{Colour, Context, Evaluate, Node, NodeError, Param};
use pelage_strand::{GrowSettings, StrandTile, Style, Undercoat};

use crate::shading::linear;

/// The shape that every hair follows around the way it grows.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum HairStyle {
    /// No shape of its own.
    Straight,
    /// A sine to one side and back.
    Wavy {
        /// How far to either side.
        #[param(default = 0.008, range = 0.0..=1.0, unit = "tile sides", effect = "wider waves")]
        amplitude: f64,
        /// Periods from root to tip.
        #[param(default = 1.2, range = 0.0..=64.0, unit = "periods", effect = "finer waves; give at least 8 steps to each")]
        waves: f64,
    },
    /// A helix.
    Curly {
        /// Its radius.
        #[param(default = 0.02, range = 0.0..=1.0, unit = "tile sides", effect = "wider curls")]
        radius: f64,
        /// From root to tip.
        #[param(default = 2.0, range = 0.0..=64.0, unit = "turns", effect = "finer curls; give at least 8 steps to each")]
        turns: f64,
    },
    /// A triangle wave.
    Zigzag {
        /// How far to either side.
        #[param(default = 0.015, range = 0.0..=1.0, unit = "tile sides", effect = "wider bends")]
        amplitude: f64,
        /// Periods from root to tip.
        #[param(default = 3.0, range = 0.0..=64.0, unit = "periods", effect = "finer bends; give at least 8 steps to each")]
        waves: f64,
    },
}

impl From<&HairStyle> for Style {
    fn from(style: &HairStyle) -> Self {
        match *style {
            HairStyle::Straight => Self::Straight,
            HairStyle::Wavy { amplitude, waves } => Self::Wavy { amplitude, waves },
            HairStyle::Curly { radius, turns } => Self::Curly { radius, turns },
            HairStyle::Zigzag { amplitude, waves } => Self::Zigzag { amplitude, waves },
        }
    }
}

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
#[node(category = "Hair", version = 1)]
#[output(strands: StrandTile, "The hair of one tile.")]
pub struct GrowStrands {
    /// Shape around the way of growth.
    #[param(default = HairStyle::Wavy { amplitude: 0.008, waves: 1.2 })]
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
    /// Radius at the tip.
    #[param(default = 0.15, range = 0.0..=1.0, unit = "radii at the root", effect = "blunter tips")]
    pub tip_thickness: f64,
    /// How late the hair tapers.
    #[param(default = 2.0, range = 0.1..=10.0, unit = "exponent", effect = "1 is a cone, larger keeps its thickness longer")]
    pub taper: f64,
    /// From upright towards the way the fur lies.
    #[param(default = 22.0, range = 0.0..=75.0, unit = "degrees", effect = "hair leans within its tile, so layers differ more")]
    pub lean: f64,
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
    /// Colour at the root.
    #[param(default = Colour([0.437, 0.374, 0.313]))]
    pub root_colour: Colour,
    /// Colour at the tip.
    #[param(default = Colour([0.735, 0.672, 0.602]))]
    pub tip_colour: Colour,
    /// How much the brightness differs from hair to hair.
    #[param(default = 0.3, range = 0.0..=1.0, unit = "fraction", effect = "larger: single hairs show more")]
    pub colour_variation: f64,
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
            tip_thickness: self.tip_thickness,
            taper: self.taper,
            style: Style::from(&self.style),
            lean: self.lean,
            splay: self.splay,
            stiffness: self.stiffness,
            gravity: self.gravity,
            wander: self.wander,
            separation: self.separation,
            clump: self.clump,
            clump_size: self.clump_size,
            root_colour: linear(self.root_colour).to_array(),
            tip_colour: linear(self.tip_colour).to_array(),
            colour_variation: self.colour_variation,
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
