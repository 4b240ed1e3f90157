//! Textures as plain bytes, and which shells show them.

/// How an image's bytes are to be read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Four bytes a texel: red, green, blue, alpha.
    #[default]
    Rgba8,
    /// Blocks of 4 × 4 texels in 16 bytes each (BC3, also called DXT5), row by row; the last of a row or column may reach past the image.
    Bc3,
}

/// One level of detail of an image stack: `layers` images of `width` × `height` texels, row by row from the top, image after image.
///
/// Red, green and blue are sRGB-encoded and premultiplied by alpha *before* encoding, so that linear filtering of the decoded values
/// mixes hair and nothing as it should; alpha is linear coverage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MipImage {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// [`Encoding::bytes`] of one image, times the images.
    pub texels: Vec<u8>,
}

/// A shell: where it stands and what it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShellLayer {
    /// Where along *c_v* it stands: 0 at the skin, 1 at the tips.
    pub height: f32,
    /// Where along *c_v* the hair that it shows is on average, as lighting has it: its own height, unless it shows several layers at once.
    pub light_height: f32,
    /// Which image of the stack it shows, counted in those of one mixture.
    pub image: u32,
    /// Multiplies the image's alpha; 0 to 1. Straight hair is one image that its shells show ever fainter (L22).
    pub opacity: f32,
    /// How many layers of the image's opacity it stands for: α becomes 1 − (1 − α)^layers. 1, unless several shells share one image (K5).
    pub layers: f32,
}

impl ShellLayer {
    /// A shell that shows an image as it is.
    pub fn plain(height: f32, image: u32) -> Self {
        Self { height, light_height: height, image, opacity: 1.0, layers: 1.0 }
    }
}

/// The hair as shells: a stack of square toroidal images, and which shells show which of them at each level of detail.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellTexture {
    /// How the images' bytes are to be read.
    pub encoding: Encoding,
    /// How many images, of all mixtures.
    pub images: u32,
    /// How many mixtures of hair there are, one after the other, each with as many images: where a coat becomes another, the hair at evenly spaced places from the first coat, at 0 of
    /// [`Surface::mixes`](crate::Surface::mixes), to the last, at 1 (L24). 1: hair of one coat.
    pub mixtures: u32,
    /// The images; the finest first, each half as wide as the one before.
    pub mips: Vec<MipImage>,
    /// The shells, innermost first, at each level of detail, the finest first (L16). The innermost is the opaque skin, at height 0. Shell *j* of a level
    /// stands where shell 2*j* of the finer level does.
    pub levels: Vec<Vec<ShellLayer>>,
    /// The mean unit direction of the hair that each image shows, for lighting by pixel (L15): [`Encoding::Rgba8`] of the same sizes, neither
    /// encoded nor premultiplied; a coordinate *x* of −1 to 1 is stored as 127.5 (1 + *x*), red along the tile's *s*, green along *t*, blue along *c_v*; at most
    /// 1 long, the shorter, the more the hair differs. Alpha is unused.
    pub directions: Option<Vec<MipImage>>,
}

/// The fin: a slab of the hair seen from its side (L9). Toroidal across, the skin at the bottom row and the tips at the top.
#[derive(Clone, Debug, PartialEq)]
pub struct FinTexture {
    /// How many tiles of hair the whole width shows.
    pub tiles_across: f32,
    /// How many mixtures of hair there are, each an image: as [`ShellTexture::mixtures`], or 1, which serves all.
    pub mixtures: u32,
    /// The finest level first, each half as wide and high as the one before, no side under one texel.
    pub mips: Vec<MipImage>,
}

impl Encoding {
    /// Bytes of one image.
    pub fn bytes(self, width: u32, height: u32) -> usize {
        let (width, height) = (width as usize, height as usize);
        match self {
            Self::Rgba8 => width.saturating_mul(height).saturating_mul(4),
            Self::Bc3 => width.div_ceil(4).saturating_mul(height.div_ceil(4)).saturating_mul(16),
        }
    }
}

impl ShellTexture {
    /// One level of `layers` evenly spaced shells, each with an image of its own.
    pub fn stack(layers: u32, mips: Vec<MipImage>) -> Self {
        let step = 1.0 / layers.saturating_sub(1).max(1) as f32;
        let shells = (0..layers).map(|k| ShellLayer::plain(k as f32 * step, k)).collect();
        Self { encoding: Encoding::Rgba8, images: layers, mixtures: 1, mips, levels: vec![shells], directions: None }
    }

    /// No hair: a skin of one white texel, so that the surface's own colours are all there is to it. What a coat has where nobody looks at its textures.
    pub fn bare() -> Self {
        Self::stack(1, vec![MipImage { width: 1, height: 1, texels: vec![255; 4] }])
    }

    /// How many shells the finest level has, the skin included.
    pub fn layers(&self) -> u32 {
        self.levels.first().map_or(0, Vec::len) as u32
    }

    /// Texels along a side of the finest images.
    pub fn resolution(&self) -> u32 {
        self.mips.first().map_or(0, |mip| mip.width)
    }

    /// Bytes of all images.
    pub fn byte_size(&self) -> usize {
        self.mips.iter().map(|mip| mip.texels.len()).sum()
    }

    /// Bytes of the direction map.
    pub fn direction_bytes(&self) -> usize {
        self.directions.iter().flatten().map(|mip| mip.texels.len()).sum()
    }
}

impl FinTexture {
    /// Bytes of all levels.
    pub fn byte_size(&self) -> usize {
        self.mips.iter().map(|mip| mip.texels.len()).sum()
    }
}
