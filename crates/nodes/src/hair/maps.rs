//! Shells and fins of hair that is a pattern, and not strands.

use std::sync::Arc;

use pelage_coat::{FinTexture, ShellTexture};
use pelage_graph::{Colour, Context, Evaluate, FilePath, Needs, Node, NodeError, Param, Params, Wanted};
use pelage_volume::{FinSettings, FurMap, MapLook, MipRule, Pixels, Spacing, StackSettings};

use super::convert::{fin_texture, shell_stack, shell_texture};
use super::row::each_mixture;
use super::sample::ShellSpacing;
use crate::images::Pixels as ImageFile;
use crate::parts::{DIRECTIONS, LAYERS, LEVELS};
use crate::shading::linear;

/// Noise that repeats with the tile.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum TileNoise {
    /// Clouds, on a cubic grid.
    Perlin,
    /// Clouds without the grid's axes to be seen.
    Simplex,
    /// Round tufts at random places, one to a cell (Worley).
    Dots,
}

/// What the pattern of a fur map is.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum PatternLook {
    /// Cells of a square grid at random, each a hair or nothing: Zima's fur map.
    Grains,
    /// Where there is most of a noise.
    Noise {
        /// Which.
        #[param(default = TileNoise::Perlin)]
        kind: TileNoise,
        /// How many layers of noise are added, each half as large as the one before.
        #[param(default = 1, range = 1..=8, unit = "layers", effect = "more: frayed; cost is linear in it")]
        octaves: u32,
        /// How far the noise changes from the skin to the tips.
        #[param(default = 0.0, range = 0.0..=16.0, unit = "cells", effect = "0: hair stands straight; larger: it wanders and parts")]
        drift: f64,
    },
}

impl PatternLook {
    /// The look, its octaves and its drift.
    fn parts(&self) -> (MapLook, u32, f64) {
        match *self {
            Self::Grains => (MapLook::Grains, 1, 0.0),
            Self::Noise { ref kind, octaves, drift } => {
                let look = match kind {
                    TileNoise::Perlin => MapLook::Perlin,
                    TileNoise::Simplex => MapLook::Simplex,
                    TileNoise::Dots => MapLook::Dots,
                };
                (look, octaves, drift)
            }
        }
    }
}

/// Shells of a pattern made by chance, without strands (K2, Z1, Z2): quick to make, upright, lit as the fur stands.
///
/// A seed makes the same hair at any resolution, and more density adds hair to what there is.
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(shells: ShellTexture, "The layers, innermost first.", parts = [LAYERS])]
pub struct PatternShells {
    /// What the pattern is.
    #[param(default = PatternLook::Grains)]
    pub look: PatternLook,
    /// Cells along the tile's side: up to 1024 grains, 256 of noise.
    #[param(default = 128, range = 1..=1024, unit = "cells", effect = "more: finer hair")]
    pub cells: u32,
    /// What part of the skin hair covers.
    #[param(default = 0.2, range = 0.0..=1.0, unit = "fraction", effect = "larger: denser; 0 is bare")]
    pub density: f64,
    /// How density falls towards the tips: what is covered at height h goes with (1 − h) to this power (K3).
    #[param(default = 0.0, range = 0.0..=16.0, unit = "exponent", effect = "0: all hair is as long as the fur; larger: more short hair under less long hair")]
    pub thinning: f64,
    /// Of layers that are animated (K19): where in the loop they are, which 1 closes.
    #[param(default = 0.0, range = -1000000.0..=1000000.0, unit = "loops", effect = "another picture of the loop")]
    pub phase: f64,
    /// How much they move in a loop: grains get shorter by so much and longer again, each at its own time; noise moves by so many cells.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "0: at rest")]
    pub swing: f64,
    /// Colour at the skin.
    #[param(default = Colour([0.35, 0.28, 0.22]))]
    pub root_colour: Colour,
    /// Colour at the tips.
    #[param(default = Colour([0.8, 0.7, 0.58]))]
    pub tip_colour: Colour,
    /// By how much hairs differ in brightness, each the same from root to tip (K9).
    #[param(default = 0.1, range = 0.0..=1.0, unit = "fraction", effect = "larger: hairs stand out from each other")]
    pub brightness: f64,
    /// Which of all patterns of the kind.
    #[param(default = 1, unit = "seed", effect = "other hair of the same kind")]
    pub seed: u64,
    /// Shells from the skin to the tips, both included.
    #[param(default = 16, range = 1..=256, unit = "layers", effect = "more: smoother fur at a slant; fragments and memory are linear in it")]
    pub layers: u32,
    /// Where the shells stand.
    #[param(default = ShellSpacing::Even)]
    pub spacing: ShellSpacing,
    /// Texels along the tile's side; a power of two.
    #[param(default = 128, range = 1..=2048, unit = "texels", effect = "more: sharper hair close up; memory goes with its square")]
    pub resolution: u32,
    /// Colour of the skin under the hair.
    #[param(default = Colour([0.366, 0.304, 0.26]))]
    pub skin_colour: Colour,
}

impl Evaluate for PatternShells {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let (look, octaves, drift) = self.look.parts();
        let map = FurMap {
            look,
            cells: self.cells,
            density: self.density,
            thinning: self.thinning,
            octaves,
            drift,
            phase: self.phase,
            swing: self.swing,
            root_colour: linear(self.root_colour).to_array(),
            tip_colour: linear(self.tip_colour).to_array(),
            brightness: self.brightness,
            seed: self.seed,
        };
        // Who draws no shells wants their skin, which is the first of them.
        let layers = if cx.wants_part("shells", LAYERS) { self.layers } else { 1 };
        let settings = stack(layers, &self.spacing, self.resolution, self.skin_colour);
        Ok(shell_texture(pelage_volume::map_shells(&map, &settings)?).into())
    }
}

/// Shells from an artist's pictures of the tile (K2), which repeats both ways.
///
/// Of one picture alpha says how high the hair stands, 0 none and opaque to the tips, and its colour is that of the hair. Several are a stack, the skin first and the tips last, each a layer
/// as it is.
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(shells: ShellTexture, "The layers, innermost first.", parts = [LAYERS])]
pub struct ImageShells {
    /// PNG or JPEG files: one, or a layer each, the skin first.
    #[param]
    pub paths: Vec<FilePath>,
    /// Shells that one picture makes, from the skin to the tips; of several pictures each is one, and this does not count.
    #[param(default = 16, range = 1..=256, unit = "layers", effect = "more: smoother fur at a slant; fragments and memory are linear in it")]
    pub layers: u32,
    /// Where the shells stand.
    #[param(default = ShellSpacing::Even)]
    pub spacing: ShellSpacing,
    /// Texels along the tile's side; a power of two.
    #[param(default = 128, range = 1..=2048, unit = "texels", effect = "more: sharper hair close up; memory goes with its square")]
    pub resolution: u32,
    /// Colour of the skin under the hair.
    #[param(default = Colour([0.366, 0.304, 0.26]))]
    pub skin_colour: Colour,
}

impl Evaluate for ImageShells {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let files =
            self.paths.iter().map(|path| Ok(ImageFile::read(path.as_path())?.into_rgba8())).collect::<Result<Vec<_>, NodeError>>()?;
        let pictures: Vec<Pixels<'_>> =
            files.iter().map(|file| Pixels { rgba: file.as_raw(), width: file.width(), height: file.height() }).collect();
        let settings = stack(self.layers, &self.spacing, self.resolution, self.skin_colour);
        Ok(shell_texture(pelage_volume::shells_from_pixels(&pictures, &settings)?).into())
    }
}

fn stack(layers: u32, spacing: &ShellSpacing, resolution: u32, skin_colour: Colour) -> StackSettings {
    let (spacing, skin_colour) = (Spacing::from(spacing), linear(skin_colour).to_array());
    StackSettings { layers, spacing, resolution, skin_colour, ..StackSettings::default() }
}

/// Multiplies the colours of shells by a picture of the tile: a separate colour texture (Z3), a decal on hair of one colour (K9). Where the picture is transparent it dyes less.
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(shells: ShellTexture, "The same layers, dyed.", parts = [LAYERS, LEVELS, DIRECTIONS])]
pub struct TintShells {
    /// The shells.
    #[input]
    pub shells: Arc<ShellTexture>,
    /// A PNG or JPEG file of the tile, which repeats both ways.
    #[param]
    pub path: FilePath,
}

impl Evaluate for TintShells {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let file = ImageFile::read(self.path.as_path())?.into_rgba8();
        let picture = Pixels { rgba: file.as_raw(), width: file.width(), height: file.height() };
        let tinted = |shells: &ShellTexture| Ok(shell_texture(shell_stack(shells)?.tinted(&picture, MipRule::default())?));
        Ok(each_mixture(&self.shells, tinted)?.into())
    }

    fn needs(wanted: &Wanted<'_>, _: &Params<'_>) -> Needs {
        Needs::all().parts("shells", wanted.parts())
    }
}

/// A fin of the shells themselves: a slab of their texels, seen from its side. For hair without strands; where there are some, SampleFin is finer.
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(fin: FinTexture, "The fin.")]
pub struct FinOfShells {
    /// The shells.
    #[input]
    pub shells: Arc<ShellTexture>,
    /// Texels along and up the fin; powers of two.
    #[param(default = (512, 64), range = 1..=8192, unit = "texels", effect = "more: finer hair at the silhouette")]
    pub size: (u32, u32),
    /// Depth of the slab.
    #[param(default = 0.12, range = 0.001..=1.0, unit = "tile sides", effect = "deeper: denser fins")]
    pub slab_width: f64,
    /// Tiles that the fin shows side by side.
    #[param(default = 3, range = 1..=64, unit = "tiles", effect = "more: fins repeat less, with fewer texels a hair")]
    pub tiles_across: u32,
}

impl Evaluate for FinOfShells {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        if self.shells.mixtures > 1 {
            return Err("the shells are of coats in a row; take SampleFin, which knows their hair".into());
        }
        let settings = FinSettings {
            width: self.size.0,
            height: self.size.1,
            slab_width: self.slab_width,
            tiles_across: self.tiles_across,
            ..FinSettings::default()
        };
        Ok(fin_texture(shell_stack(&self.shells)?.fin(&settings)?).into())
    }
}
