//! Straight hair as one layer (L22).

use crate::directions::{direction_mips, weighted};
use crate::error::VolumeError;
use crate::image::{Image, ShellStack};
use crate::mips::image_mips;
use crate::plane::Plane;
use crate::shell::Shell;

/// Rounds of alternating least squares. A stack that is worth one image settles to four digits in five.
const ROUNDS: usize = 12;

/// The one image, tapered by an alpha ramp, that comes nearest to all shells of a stack above its skin: for hair that stands straight up Lengyel et al. 2001
/// (section 4) encode all shells in a single image layer.
///
/// Shell *k* is to show o_k times an image *a*. Over all texels' alphas Σ (shown_k − o_k a)² is least for the first pair of singular vectors, found by alternating: a given
/// the o_k, the o_k given a. The o_k are scaled to 1 at most. The image's colour is the least-squares one for that ramp: hair that changes its colour from root to tip
/// is left with one, and the ramp is not bent by it.
#[derive(Clone, Debug, PartialEq)]
pub struct OneLayerFit {
    /// The opacity of each shell above the skin, innermost first, 0 to 1.
    pub ramp: Vec<f64>,
    /// Root of the mean square of alpha's error, over all texels of all shells above the skin.
    pub alpha_rms: f64,
    /// Alpha's largest error.
    pub alpha_largest: f64,
    /// The same of premultiplied linear colour, over its three channels.
    pub colour_rms: f64,
    /// Colour's largest error.
    pub colour_largest: f64,
    /// Alpha's error beside alpha itself, root mean squares both: 0 is straight hair without taper, near 1 is hair of which no two shells are alike. 0 without hair.
    pub unlikeness: f64,
    image: Plane,
}

impl OneLayerFit {
    /// Fits one image to the finest level of detail.
    ///
    /// # Errors
    /// A stack with no shell above its skin.
    pub fn of(stack: &ShellStack) -> Result<Self, VolumeError> {
        let shown = shown(stack);
        if shown.is_empty() {
            return Err(VolumeError::NoHairShells);
        }
        let mut ramp = vec![1.0f64; shown.len()];
        for _ in 0..ROUNDS {
            ramp = ramp_of(&shown, &image_of(&shown, &ramp));
        }
        // The best for the ramp as it is kept; it covers no more than all of a texel.
        let mut image = image_of(&shown, &ramp);
        image.texels.iter_mut().flatten().for_each(|channel| *channel = channel.clamp(0.0, 1.0));
        Ok(measured(&shown, ramp, image))
    }

    /// The stack that shows the image: the skin's and the one of the hair, all shells at their heights. A direction map is kept: the mean of all shells', each weighted by
    /// what it shows times its opacity.
    ///
    /// Coarser levels, if they are made of it, show the same image too, with more layers; only their skins are new images.
    pub fn stack(&self, stack: &ShellStack) -> ShellStack {
        let skin = stack.levels.first().and_then(|shells| shells.first()).copied().unwrap_or(Shell::plain(0.0, 0));
        let shells = stack.levels.first().into_iter().flatten().skip(1);
        let tapered = shells.zip(&self.ramp).map(|(shell, &opacity)| Shell { image: 1, opacity: opacity as f32, layers: 1.0, ..*shell });
        let levels = vec![[Shell { image: 0, ..skin }].into_iter().chain(tapered).collect()];
        let of_skin = |mips: &[Image]| -> Vec<Image> { mips.iter().map(|mip| alone(mip, skin.image)).collect() };
        let directions =
            stack.directions.as_deref().map(|map| with_second(of_skin(map), direction_mips(vec![self.directions(stack, map)])));
        ShellStack {
            mips: with_second(of_skin(&stack.mips), image_mips(self.image.clone())),
            levels,
            directions,
            height: stack.height,
            work: stack.work,
        }
    }

    /// The mean direction, times what shows it.
    fn directions(&self, stack: &ShellStack, map: &[Image]) -> Plane {
        let mut sum = Plane::new(self.image.width, self.image.height);
        let Some(map) = map.first() else { return sum };
        let shells = stack.levels.first().into_iter().flatten().skip(1);
        for ((shell, colour), &opacity) in shells.zip(&shown(stack)).zip(&self.ramp) {
            let plane = weighted(map, shell.image, colour);
            for (sum, texel) in sum.texels.iter_mut().zip(&plane.texels) {
                *sum = [0, 1, 2, 3].map(|channel| sum[channel] + opacity as f32 * texel[channel]);
            }
        }
        sum
    }
}

/// The shells above the skin as they are drawn.
fn shown(stack: &ShellStack) -> Vec<Plane> {
    let shells = stack.levels.first().into_iter().flatten().skip(1);
    stack.mips.first().map_or_else(Vec::new, |mip| shells.map(|shell| crate::composite::shown(mip, shell)).collect())
}

/// a = Σ o_k shown_k / Σ o_k².
fn image_of(shown: &[Plane], ramp: &[f64]) -> Plane {
    let squares: f64 = ramp.iter().map(|o| o * o).sum();
    let mut image = shown.first().map_or(Plane::new(0, 0), |plane| Plane::new(plane.width, plane.height));
    for (plane, &opacity) in shown.iter().zip(ramp) {
        let share = if squares > 0.0 { (opacity / squares) as f32 } else { 0.0 };
        for (sum, texel) in image.texels.iter_mut().zip(&plane.texels) {
            *sum = [0, 1, 2, 3].map(|channel| sum[channel] + share * texel[channel]);
        }
    }
    image
}

/// o_k = Σ shown_k a / Σ a² over alphas, then scaled to 1 at most.
fn ramp_of(shown: &[Plane], image: &Plane) -> Vec<f64> {
    let dot = |plane: &Plane| -> f64 { plane.texels.iter().zip(&image.texels).map(|(a, b)| f64::from(a[3]) * f64::from(b[3])).sum() };
    let squares = dot(image);
    let ramp: Vec<f64> = shown.iter().map(|plane| if squares > 0.0 { (dot(plane) / squares).max(0.0) } else { 0.0 }).collect();
    let most = ramp.iter().fold(0.0f64, |most, &o| most.max(o));
    ramp.into_iter().map(|o| if most > 0.0 { o / most } else { 0.0 }).collect()
}

fn measured(shown: &[Plane], ramp: Vec<f64>, image: Plane) -> OneLayerFit {
    // Σ error², largest error: colour, alpha; Σ alpha².
    let (mut squares, mut largest, mut covered) = ([0.0f64; 2], [0.0f64; 2], 0.0f64);
    for (plane, &opacity) in shown.iter().zip(&ramp) {
        for (texel, one) in plane.texels.iter().zip(&image.texels) {
            for channel in 0..4 {
                let error = (f64::from(texel[channel]) - opacity * f64::from(one[channel])).abs();
                let kind = channel / 3;
                squares[kind] += error * error;
                largest[kind] = largest[kind].max(error);
            }
            covered += f64::from(texel[3]).powi(2);
        }
    }
    let count = (shown.len() * image.texels.len()).max(1) as f64;
    OneLayerFit {
        ramp,
        alpha_rms: (squares[1] / count).sqrt(),
        alpha_largest: largest[1],
        colour_rms: (squares[0] / (3.0 * count)).sqrt(),
        colour_largest: largest[0],
        unlikeness: if covered > 0.0 { (squares[1] / covered).sqrt() } else { 0.0 },
        image,
    }
}

/// One image of a mip level.
fn alone(mip: &Image, image: u32) -> Image {
    let size = 4 * mip.width as usize * mip.height as usize;
    let bytes = mip.texels.chunks_exact(size.max(1)).nth(image as usize).map_or_else(Vec::new, <[u8]>::to_vec);
    Image { layers: 1, texels: bytes, ..*mip }
}

/// Each mip level of one image followed by that of another.
fn with_second(mut mips: Vec<Image>, second: Vec<Image>) -> Vec<Image> {
    for (mip, second) in mips.iter_mut().zip(second) {
        mip.texels.extend(second.texels);
        mip.layers += second.layers;
    }
    mips
}
