//! Stacks of shells that no strands were sampled into: what they have in common.

use crate::error::{VolumeError, power_of_two, within};
use crate::heights::Spacing;
use crate::image::{ShellStack, Work};
use crate::mips::{MipRule, shell_mips};
use crate::plane::Plane;
use crate::shell::Shell;
use crate::shells::{MAX_TEXELS, MOST_LAYERS};

/// How many shells there are, where they stand and how fine they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StackSettings {
    /// Layers, the skin and the tips included: 1 to 256. Cost and memory are linear in it.
    pub layers: u32,
    /// Where they stand.
    pub spacing: Spacing,
    /// Texels along a tile side, a power of two from 1 to 2048. Memory goes with its square.
    pub resolution: u32,
    /// Linear RGB of the skin under the innermost layer's hair, each 0 to 1.
    pub skin_colour: [f32; 3],
    /// What mips keep.
    pub mip_rule: MipRule,
}

impl Default for StackSettings {
    fn default() -> Self {
        Self { layers: 16, spacing: Spacing::Even, resolution: 128, skin_colour: [0.11, 0.075, 0.055], mip_rule: MipRule::default() }
    }
}

impl StackSettings {
    /// Says what is wrong first, if anything is.
    ///
    /// # Errors
    /// A value outside the range that its field states, a resolution that is no power of two, too many texels.
    pub fn validate(&self) -> Result<(), VolumeError> {
        within("layers", f64::from(self.layers), 1.0, f64::from(MOST_LAYERS), "layers")?;
        self.spacing.validate()?;
        power_of_two("resolution", self.resolution, 2048)?;
        self.skin_colour.iter().try_for_each(|&c| within("skin_colour", f64::from(c), 0.0, 1.0, "(linear light)"))?;
        let asked = u64::from(self.layers) * u64::from(self.resolution) * u64::from(self.resolution);
        if asked > MAX_TEXELS { Err(VolumeError::TooManyTexels { asked, limit: MAX_TEXELS }) } else { Ok(()) }
    }

    /// The stack of `planes`, innermost first, one for each layer, all of the resolution: the innermost lies over the skin. Its height is 1, as it does not know how high it is beside a tile.
    pub(crate) fn stack(&self, mut planes: Vec<Plane>) -> ShellStack {
        if let Some(first) = planes.first_mut() {
            let [red, green, blue] = self.skin_colour;
            let mut skin = Plane::new(first.width, first.height);
            skin.texels.fill([red, green, blue, 1.0]);
            skin.cover(first);
            *first = skin;
        }
        let heights = self.spacing.heights(planes.len() as u32);
        let shells = (0u32..).zip(&heights).map(|(image, &height)| Shell::plain(height as f32, image)).collect();
        ShellStack { height: 1.0, mips: shell_mips(planes, self.mip_rule), levels: vec![shells], directions: None, work: Work::default() }
    }
}
