//! What is laid, and how it is looked at.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use glam::{DVec3, Vec3};
use pelage_coat::{Camera, Lights};
use pelage_lighting::Shading;
use pelage_strand::StrandTile;

use crate::ReferenceError;
use crate::error::within;

/// Which hair there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Placement {
    /// What infinitely many shells of infinite resolution would draw: of every copy of the tile's hair what is over a patch, cut at its outline.
    #[default]
    Shell,
    /// Each hair whole whose root is on a patch, also beyond the patch's outline. What differs from [`Placement::Shell`] is what seams cost.
    Free,
}

/// Where shadows within the coat come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// From depth, by [`pelage_lighting::SelfShadow`], as in the renderer.
    #[default]
    Formula,
    /// From rays to each light at infinity: it is there or not, whatever the depth. No hair shades itself. Light from all around goes by the formula still, and so
    /// does [`pelage_lighting::Facing`], which is part of how a coat answers light.
    Rays,
}

/// Skin, in linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinColours {
    /// Between the hairs.
    pub under_fur: DVec3,
    /// Where there is no fur.
    pub bare: DVec3,
}

impl SkinColours {
    /// Skin of a colour between the hairs, which is what layers are sampled over. Where it is bare the renderer shows the mean of the innermost layer, roots and
    /// skin; so does this, of the innermost of infinitely many layers: roots cover their cross-sections, those of different hairs independently.
    pub fn of(tile: &StrandTile, under_fur: DVec3) -> Self {
        let (mut open, mut area, mut colour) = (1.0, 0.0, DVec3::ZERO);
        for strand in tile.strands().filter(|strand| strand.stands_at(0.0)) {
            let radius = f64::from(strand.radii.first().copied().unwrap_or_default());
            let root = (PI * radius * radius).clamp(0.0, 1.0) * f64::from(strand.opacity_at(0.0));
            open *= 1.0 - root;
            area += root;
            colour += Vec3::from(strand.colour_at(0.0)).as_dvec3() * root;
        }
        let roots = if area > 0.0 { colour / area } else { under_fur };
        Self { under_fur, bare: roots.lerp(under_fur, open) }
    }
}

impl Default for SkinColours {
    /// What hair is sampled over by default, everywhere.
    fn default() -> Self {
        let skin = DVec3::new(0.11, 0.075, 0.055);
        Self { under_fur: skin, bare: skin }
    }
}

/// How hair is laid on a coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laying {
    /// Which hair there is.
    pub placement: Placement,
    /// Multiplies the length of all fur: 0 to 1000; 0 is bald.
    pub length_scale: f64,
    /// How far a hair may be from its true curve, in its radii: 1e-4 to 1, first in the tile and once more on the surface. Segments go with one over its root.
    pub tolerance: f64,
    /// The skin's colours.
    pub skin: SkinColours,
}

impl Default for Laying {
    fn default() -> Self {
        Self { placement: Placement::default(), length_scale: 1.0, tolerance: 0.1, skin: SkinColours::default() }
    }
}

/// From where, and in what light.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// From where.
    pub camera: Camera,
    /// In what light.
    pub lights: Lights,
    /// How hair answers it.
    pub shading: Shading,
}

/// How finely to look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Width and height in pixels, each up to 16384. A picture without pixels is one.
    pub size: (u32, u32),
    /// Rays from the eye for each pixel: 1 to 65536. Time is linear in it; noise falls at least with its root, and evenly where it is a power of two.
    pub samples: u32,
    /// Of where in the pixels they go.
    pub seed: u64,
    /// Where shadows come from.
    pub shadows: Shadows,
}

impl Default for Settings {
    fn default() -> Self {
        Self { size: (640, 480), samples: 16, seed: 1, shadows: Shadows::default() }
    }
}

impl Settings {
    pub(crate) fn validate(&self) -> Result<(), ReferenceError> {
        within("size.0", f64::from(self.size.0), 0.0, 16384.0, "pixels")?;
        within("size.1", f64::from(self.size.1), 0.0, 16384.0, "pixels")?;
        within("samples", f64::from(self.samples), 1.0, 65536.0, "rays a pixel")
    }
}

/// Is told how far a picture has got, from 0 to 1, and says whether to go on; from any thread, and after any block, so that fractions may come out of order.
pub type Progress<'a> = &'a (dyn Fn(f64) -> ControlFlow<()> + Sync);

/// Goes on, and tells nobody.
pub fn quiet(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage_strand::StrandSource;

    #[test]
    fn bare_skin_shows_roots_for_their_cross_section() {
        let hair = |radius: f64, root_colour: [f32; 3]| StrandSource {
            radii: vec![radius, 0.0],
            points: vec![[0.5, 0.5, 0.0], [0.9, 0.5, 1.0]],
            root_colour,
            tip_colour: [0.0; 3],
        };
        // A tenth, and a fifth of the tile.
        let of = |share: f64| (share / PI).sqrt();
        let tile = StrandTile::from_strands(1.0, &[hair(of(0.1), [1.0, 0.0, 0.0]), hair(of(0.2), [0.0, 1.0, 0.0])]).unwrap();
        let colours = SkinColours::of(&tile, DVec3::splat(0.5));
        assert_eq!(colours.under_fur, DVec3::splat(0.5));
        // 0.9 · 0.8 is left open; the roots' mean is a third and two thirds.
        let expected = 0.72 * DVec3::splat(0.5) + 0.28 * DVec3::new(1.0 / 3.0, 2.0 / 3.0, 0.0);
        assert!(colours.bare.abs_diff_eq(expected, 1e-6), "{}", colours.bare);
    }
}
