//! Textures as plain bytes.

/// One level of detail of an image stack: `layers` images of `width` × `height` RGBA8 texels, row by row from the top, layer after layer.
///
/// Red, green and blue are sRGB-encoded and premultiplied by alpha *before* encoding, so that linear filtering of the decoded values
/// mixes hair and nothing as it should; alpha is linear coverage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MipImage {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// `4 * width * height * layers` bytes.
    pub texels: Vec<u8>,
}

/// The shell layers: a square toroidal stack, innermost first (L8), with mips down to one texel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShellTexture {
    /// How many layers; the innermost is the opaque skin.
    pub layers: u32,
    /// The finest level first, each half as wide as the one before.
    pub mips: Vec<MipImage>,
}

/// The fin: a slab of the hair seen from its side (L9). Toroidal across, the skin at the bottom row and the tips at the top.
#[derive(Clone, Debug, PartialEq)]
pub struct FinTexture {
    /// How many tiles of hair the whole width shows.
    pub tiles_across: f32,
    /// The finest level first, each half as wide and high as the one before, no side under one texel.
    pub mips: Vec<MipImage>,
}

impl ShellTexture {
    /// Texels along a side of the finest level.
    pub fn resolution(&self) -> u32 {
        self.mips.first().map_or(0, |mip| mip.width)
    }

    /// Bytes of all levels and layers.
    pub fn byte_size(&self) -> usize {
        self.mips.iter().map(|mip| mip.texels.len()).sum()
    }
}

impl FinTexture {
    /// Bytes of all levels.
    pub fn byte_size(&self) -> usize {
        self.mips.iter().map(|mip| mip.texels.len()).sum()
    }
}
