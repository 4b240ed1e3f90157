//! Stacks in blocks (L22).

use rayon::prelude::*;
use texpresso::{Format, Params};

use crate::image::{Image, ShellStack, Work};
use crate::ramp_block::{decode_alpha, encode_alpha, moved};
use crate::shell::Shell;
use crate::srgb::srgb_to_linear;

/// Bytes of a block of 4 × 4 texels: eight of alpha, eight of colour.
const BLOCK_BYTES: usize = 16;
/// Most corrections of alpha for one image.
const ROUNDS: usize = 12;
/// How far apart blocks are that are corrected one after the other.
const SCATTER: usize = 37;
/// How far mean coverage may be from the image's own, relative to it.
const COVERAGE_TOLERANCE: f64 = 0.001;

/// One mip level of images in BC3 blocks (DXT5): row by row of blocks, image after image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockImage {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// How many images.
    pub layers: u32,
    /// 16 bytes for each 4 × 4 texels; an image smaller than that is one block.
    pub blocks: Vec<u8>,
}

/// A stack whose images are compressed to a quarter of their bytes (mips under 4 texels take a whole block).
///
/// What is compressed are the bytes as they are stored, sRGB-encoded and premultiplied; a graphics card decodes a block to them and only then to linear light. The
/// direction map is not compressed: it goes on as it was.
#[derive(Clone, Debug, PartialEq)]
pub struct CompressedStack {
    /// How far the outermost shell is from the skin, in tile sides.
    pub height: f64,
    /// The images; the finest level first.
    pub mips: Vec<BlockImage>,
    /// As [`ShellStack::levels`].
    pub levels: Vec<Vec<Shell>>,
    /// As [`ShellStack::directions`].
    pub directions: Option<Vec<Image>>,
}

/// What compression changed, over all images of a mip level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompressionError {
    /// Root mean square of alpha's error, 0 to 1.
    pub alpha_rms: f64,
    /// Root mean square of premultiplied linear colour's error, over its three channels.
    pub colour_rms: f64,
    /// The largest relative error of an image's mean coverage, of those images that cover anything.
    pub coverage: f64,
}

impl ShellStack {
    /// Compresses all images and mips.
    ///
    /// The paper found that compressed hair looks thicker: alpha's endpoints and steps do not keep the mean. Here each image's alpha is scaled before it is compressed until its
    /// mean, decoded, is near the image's own, and then single texels are moved by a step until it is within 0.1 % of it, or no step is small enough. Blocks that reach past the image hold the texels that follow on the torus, so that what is beside the
    /// edge is as near as what is inside.
    pub fn compressed(&self) -> CompressedStack {
        CompressedStack {
            height: self.height,
            mips: self.mips.iter().map(compressed).collect(),
            levels: self.levels.clone(),
            directions: self.directions.clone(),
        }
    }
}

impl CompressedStack {
    /// Bytes of each mip level, all images together.
    pub fn level_bytes(&self) -> Vec<usize> {
        self.mips.iter().map(|mip| mip.blocks.len()).collect()
    }

    /// Bytes of all mip levels and images.
    pub fn byte_size(&self) -> usize {
        self.level_bytes().iter().sum()
    }

    /// The stack with its texels back, as a graphics card sees them: for those that know no blocks.
    pub fn decoded(&self) -> ShellStack {
        ShellStack {
            height: self.height,
            mips: self.mips.iter().map(BlockImage::decoded).collect(),
            levels: self.levels.clone(),
            directions: self.directions.clone(),
            work: Work::default(),
        }
    }

    /// What compression changed, mip level by mip level.
    pub fn errors(&self, original: &ShellStack) -> Vec<CompressionError> {
        self.mips.iter().zip(&original.mips).map(|(mip, original)| error(&mip.decoded(), original)).collect()
    }
}

impl BlockImage {
    /// Its texels; what blocks hold past the edge is left out. Blocks that are missing decode to nothing.
    pub fn decoded(&self) -> Image {
        let (width, height) = (self.width as usize, self.height as usize);
        let (across, down) = (width.div_ceil(4), height.div_ceil(4));
        let mut texels = vec![0u8; 4 * width * height * self.layers as usize];
        let mut owed = 0.0;
        for (number, block) in self.blocks.as_chunks::<BLOCK_BYTES>().0.iter().enumerate() {
            let each = (across * down).max(1);
            let (layer, within) = (number / each, number % each);
            let colours = Format::Bc3.decompress_block(block);
            let alphas = decode_alpha([0, 1, 2, 3, 4, 5, 6, 7].map(|i| block[i]));
            for (index, (colour, alpha)) in colours.iter().zip(alphas).enumerate() {
                let (x, y) = (within % across.max(1) * 4 + index % 4, within / across.max(1) * 4 + index / 4);
                let begin = 4 * ((layer * height + y) * width + x);
                if x >= width || y >= height {
                    continue;
                }
                // Steps of a ramp are no bytes; what one texel is rounded by goes to the next, so that the mean is kept.
                let alpha_byte = if alpha.fract() == 0.0 { alpha as u8 } else { (alpha + owed + 0.5).clamp(0.0, 255.0) as u8 };
                owed += alpha - f64::from(alpha_byte);
                if let Some(texel) = texels.get_mut(begin..begin + 4) {
                    texel.copy_from_slice(&[colour[0], colour[1], colour[2], alpha_byte]);
                }
            }
        }
        Image { width: self.width, height: self.height, layers: self.layers, texels }
    }
}

fn compressed(mip: &Image) -> BlockImage {
    let size = 4 * mip.width as usize * mip.height as usize;
    let images: Vec<Vec<u8>> = mip.texels.par_chunks(size.max(4)).map(|texels| compressed_image(mip, texels)).collect();
    BlockImage { width: mip.width, height: mip.height, layers: mip.layers, blocks: images.concat() }
}

/// The 16 texels of each block, wrapped.
fn blocks<'a>(mip: &Image, texels: &'a [u8]) -> impl Iterator<Item = [[u8; 4]; 16]> + use<'a> {
    let (width, height) = (mip.width as usize, mip.height as usize);
    let places = (0..height.div_ceil(4)).flat_map(move |row| (0..width.div_ceil(4)).map(move |column| (column, row)));
    let texels = texels.as_chunks::<4>().0;
    places.map(move |(column, row)| {
        let texel = |i: usize| texels.get((4 * row + i / 4) % height * width + (4 * column + i % 4) % width);
        std::array::from_fn(|i| texel(i).copied().unwrap_or_default())
    })
}

fn compressed_image(mip: &Image, texels: &[u8]) -> Vec<u8> {
    let source: Vec<[[u8; 4]; 16]> = blocks(mip, texels).collect();
    let alphas = corrected_alphas(mip, &source);
    let mut bytes = vec![0u8; source.len() * BLOCK_BYTES];
    for ((block, alpha), bytes) in source.iter().zip(alphas).zip(bytes.as_chunks_mut::<BLOCK_BYTES>().0) {
        Format::Bc3.compress_block_masked(*block, 0xFFFF, Params::default(), bytes);
        bytes[..8].copy_from_slice(&alpha);
    }
    bytes
}

/// Every block's alpha, such that the mean over the image is kept.
fn corrected_alphas(mip: &Image, source: &[[[u8; 4]; 16]]) -> Vec<[u8; 8]> {
    let own: Vec<[f64; 16]> = source.iter().map(|block| block.map(|texel| f64::from(texel[3]))).collect();
    let sum = |number: usize, values: &[f64; 16]| (0..16).filter(|&i| is_inside(mip, number, i)).map(|i| values[i]).sum::<f64>();
    let wanted: f64 = own.iter().enumerate().map(|(number, values)| sum(number, values)).sum();
    let tolerance = (COVERAGE_TOLERANCE * wanted).max(0.5);
    let mut scale = 1.0;
    let mut best = (f64::INFINITY, Vec::new());
    for _ in 0..ROUNDS {
        // Without hair nothing is scaled, and what is opaque stays so.
        let scaled = |alpha: f64| if alpha < 255.0 { (alpha * scale).min(255.0) } else { alpha };
        let encoded: Vec<[u8; 8]> = own.iter().map(|values| encode_alpha(values.map(scaled))).collect();
        let got: f64 = encoded.iter().enumerate().map(|(number, &block)| sum(number, &decode_alpha(block))).sum();
        let lacks = wanted - got;
        if lacks.abs() < f64::abs(best.0) {
            best = (lacks, encoded);
        }
        if lacks.abs() <= tolerance || got <= 0.0 {
            break;
        }
        scale *= wanted / got;
    }
    let (lacks, mut alphas) = best;
    make_up(mip, &own, &mut alphas, lacks, tolerance);
    alphas
}

/// Whether a block's texel is of the image, and not past its edge.
fn is_inside(mip: &Image, block: usize, index: usize) -> bool {
    let (width, height) = (mip.width as usize, mip.height as usize);
    let across = width.div_ceil(4);
    block % across * 4 + index % 4 < width && block / across * 4 + index / 4 < height
}

/// Moves single texels, scattered over the image, by a step of their block's ramp until the sum no longer lacks more than the tolerance, or no step is small enough.
fn make_up(mip: &Image, own: &[[f64; 16]], alphas: &mut [[u8; 8]], mut lacks: f64, tolerance: f64) {
    let count = alphas.len();
    for turn in 0..16 * count {
        if lacks.abs() <= tolerance {
            return;
        }
        // Odd beside a power of two, so that every block has its turn.
        let (number, index) = (turn * SCATTER % count, turn / count);
        let partial = own[number][index] > 0.0 && own[number][index] < 255.0;
        if !(partial && is_inside(mip, number, index)) {
            continue;
        }
        match moved(alphas[number], index, lacks > 0.0) {
            Some((block, by)) if (lacks - by).abs() < lacks.abs() => {
                alphas[number] = block;
                lacks -= by;
            }
            _ => {}
        }
    }
}

fn error(decoded: &Image, original: &Image) -> CompressionError {
    let size = 4 * original.width as usize * original.height as usize;
    let (mut alpha, mut colour, mut coverage) = (0.0f64, 0.0f64, 0.0f64);
    for (image, own) in decoded.texels.chunks(size.max(4)).zip(original.texels.chunks(size.max(4))) {
        let (mut got, mut wanted) = (0.0, 0.0);
        for (a, b) in image.as_chunks::<4>().0.iter().zip(own.as_chunks::<4>().0) {
            alpha += ((f64::from(a[3]) - f64::from(b[3])) / 255.0).powi(2);
            colour += (0..3).map(|c| f64::from(srgb_to_linear(a[c]) - srgb_to_linear(b[c])).powi(2)).sum::<f64>();
            got += f64::from(a[3]);
            wanted += f64::from(b[3]);
        }
        if wanted > 0.0 {
            coverage = coverage.max((got / wanted - 1.0).abs());
        }
    }
    let texels = (original.texels.len() / 4).max(1) as f64;
    CompressionError { alpha_rms: (alpha / texels).sqrt(), colour_rms: (colour / (3.0 * texels)).sqrt(), coverage }
}
