//! Textures as plain bytes, ready for the graphics card.

use crate::shell::Shell;

/// One level of detail: `layers` images of `width` × `height` RGBA8 texels, row by row from the top, layer after layer.
///
/// Red, green and blue are premultiplied by alpha in linear light and then sRGB-encoded; alpha is linear coverage. Row 0 is y = 0 of the tile in a shell
/// layer, and the tips in a fin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// How many images.
    pub layers: u32,
    /// `4 * width * height * layers` bytes.
    pub texels: Vec<u8>,
}

/// Shells and the images they show (L8), innermost first, with mips down to one texel.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellStack {
    /// How far the outermost shell is from the skin, in tile sides.
    pub height: f64,
    /// The images; the finest level first, each half as wide as the one before.
    pub mips: Vec<Image>,
    /// The shells at each level of detail, the finest first (L16); of each level the innermost is the opaque skin. Shell *j* of a level stands where shell 2*j*
    /// of the finer one does.
    pub levels: Vec<Vec<Shell>>,
    /// The mean direction of the hair that each image shows (L15): images of the same sizes, −1 to 1 stored as 127.5 (1 + *x*), red along s, green along t, blue
    /// up from the skin; at most 1 long. Alpha is 255 and means nothing.
    pub directions: Option<Vec<Image>>,
    /// What sampling took.
    pub work: Work,
}

/// A fin (L9): a slab of hair seen from its side, toroidal across, with mips down to one texel.
#[derive(Clone, Debug, PartialEq)]
pub struct FinTexture {
    /// How many tiles of hair the whole width shows.
    pub tiles_across: u32,
    /// How far the top row is from the skin, in tile sides.
    pub height: f64,
    /// The finest level first, each half as wide and high as the one before, no side under one texel.
    pub mips: Vec<Image>,
    /// What sampling took.
    pub work: Work,
}

/// Counted work, the same on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Strands that at least one layer felt, counted once for each such layer.
    pub cuts: u64,
    /// Pairs of a hair's piece and a texel evaluated: what the cost is linear in.
    pub pairs: u64,
}

impl Work {
    pub(crate) fn plus(self, other: Self) -> Self {
        Self { cuts: self.cuts + other.cuts, pairs: self.pairs + other.pairs }
    }
}

impl Image {
    /// The four bytes of a texel; `None` outside.
    pub fn texel(&self, layer: u32, x: u32, y: u32) -> Option<[u8; 4]> {
        if x >= self.width || y >= self.height || layer >= self.layers {
            return None;
        }
        let index = 4 * ((layer as usize * self.height as usize + y as usize) * self.width as usize + x as usize);
        self.texels.get(index..index + 4).and_then(|bytes| bytes.try_into().ok())
    }

    /// Mean alpha of one layer, 0 to 1.
    pub fn mean_coverage(&self, layer: u32) -> f64 {
        let size = self.width as usize * self.height as usize;
        let bytes = self.texels.chunks_exact(4).skip(layer as usize * size).take(size);
        bytes.map(|texel| f64::from(texel[3])).sum::<f64>() / (255.0 * size.max(1) as f64)
    }
}

/// The bytes of a texture, level by level, finest first (L22).
fn itemised(mips: &[Image]) -> Vec<usize> {
    mips.iter().map(|mip| mip.texels.len()).collect()
}

impl ShellStack {
    /// How many shells the finest level of detail has, the skin included.
    pub fn layers(&self) -> u32 {
        self.levels.first().map_or(0, Vec::len) as u32
    }

    /// How many images there are.
    pub fn images(&self) -> u32 {
        self.mips.first().map_or(0, |mip| mip.layers)
    }

    /// Texels along a side of the finest level.
    pub fn resolution(&self) -> u32 {
        self.mips.first().map_or(0, |mip| mip.width)
    }

    /// Bytes of the direction map.
    pub fn direction_bytes(&self) -> usize {
        self.directions.as_deref().map_or(0, |mips| itemised(mips).iter().sum())
    }

    /// Bytes of each mip level, all images together.
    pub fn level_bytes(&self) -> Vec<usize> {
        itemised(&self.mips)
    }

    /// Bytes of all mip levels and images, the direction map not counted.
    pub fn byte_size(&self) -> usize {
        self.level_bytes().iter().sum()
    }
}

impl FinTexture {
    /// Bytes of each level.
    pub fn level_bytes(&self) -> Vec<usize> {
        itemised(&self.mips)
    }

    /// Bytes of all levels.
    pub fn byte_size(&self) -> usize {
        self.level_bytes().iter().sum()
    }
}
