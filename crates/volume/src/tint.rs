//! Hair dyed by a picture of the tile.

use rayon::prelude::*;

use crate::error::VolumeError;
use crate::image::ShellStack;
use crate::mips::{MipRule, shell_mips};
use crate::pixels::{Pixels, resized};
use crate::plane::Plane;

impl ShellStack {
    /// The stack with its colours multiplied by those of a picture of the tile, in linear light: Zima's separate colour texture (Z3), and a decal on hair of one colour (K9). Where the picture
    /// lets through it dyes by so much less. What covers stays as it was; the direction map too.
    ///
    /// # Errors
    /// A picture without pixels, or whose bytes do not fit its size.
    pub fn tinted(&self, picture: &Pixels<'_>, mip_rule: MipRule) -> Result<Self, VolumeError> {
        let side = self.resolution();
        let dye = resized(&picture.plane()?, side.max(1), side.max(1));
        let dyed = |layer: u32| {
            let mut plane = self.mips.first().map_or_else(|| Plane::new(0, 0), |mip| Plane::decoded(mip, layer));
            for (texel, dye) in plane.texels.iter_mut().zip(&dye.texels) {
                for channel in 0..3 {
                    texel[channel] *= dye[channel] + 1.0 - dye[3];
                }
            }
            plane
        };
        let planes: Vec<Plane> = (0..self.images()).into_par_iter().map(dyed).collect();
        Ok(Self { mips: shell_mips(planes, mip_rule), ..self.clone() })
    }
}
