//! Levels of detail that keep what the eye sees.

use rayon::prelude::*;

use crate::image::Image;
use crate::plane::{Plane, encode};

/// What the mips of a shell stack keep; the mean colour of what covers is kept by both.
///
/// No single coverage is right from every side: along the normal hair stands over hair and the layers go together, along slanted sight lines they are as good
/// as independent. Measured on the default coat with darkened roots (`examples/coverage_error.rs` and the book's page), `Coverage` errs less over 0°, 45°
/// and 75° together, so it is the default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MipRule {
    /// The mean coverage of every layer. Right for slanted sight lines; along the normal the stack grows somewhat more solid with distance.
    #[default]
    Coverage,
    /// The mean transmittance of the whole stack along the normal, texel by texel: the coverages of a column are raised to one common power,
    /// 1 − (1 − a)^γ. Right for hair seen from above; slanted sight lines see it thinner with distance.
    Transmittance,
}

/// Coverage above this is taken for this where logarithms are needed.
const NEARLY_OPAQUE: f32 = 1.0 - 1.0 / 4096.0;
/// Transmittance that no eye tells from none.
const NEARLY_NONE: f32 = 1e-7;

/// All levels of a stack, encoded. `planes` are the layers at full resolution, innermost (opaque) first.
pub(crate) fn shell_mips(planes: Vec<Plane>, rule: MipRule) -> Vec<Image> {
    let mut levels = vec![encode(&planes)];
    let mut clear = transmittance(&planes);
    let mut means = planes;
    while !means.first().is_none_or(Plane::is_one_texel) {
        // Always from the unrounded means, so that no level inherits another's correction.
        means = means.par_iter().map(Plane::halved).collect();
        clear = clear.halved();
        levels.push(match rule {
            MipRule::Coverage => encode(&means),
            MipRule::Transmittance => encode(&corrected(&means, &clear)),
        });
    }
    levels
}

/// All levels of a single image, encoded; coverage is kept by the mean.
pub(crate) fn image_mips(plane: Plane) -> Vec<Image> {
    let mut levels = Vec::new();
    let mut level = plane;
    loop {
        levels.push(encode(std::slice::from_ref(&level)));
        if level.is_one_texel() {
            return levels;
        }
        level = level.halved();
    }
}

/// What passes all layers above the skin, along the normal, in the alpha channel.
fn transmittance(planes: &[Plane]) -> Plane {
    let (width, height) = planes.first().map_or((0, 0), |plane| (plane.width, plane.height));
    let mut clear = Plane::new(width, height);
    for (index, texel) in clear.texels.iter_mut().enumerate() {
        texel[3] = planes.iter().skip(1).map(|plane| 1.0 - plane.texels[index][3]).product();
    }
    clear
}

/// The layers with each column's coverage raised so that the column passes what `clear` says.
fn corrected(means: &[Plane], clear: &Plane) -> Vec<Plane> {
    let mut layers = means.to_vec();
    for index in 0..clear.texels.len() {
        let depth = |alpha: f32| -libm::log1pf(-alpha.clamp(0.0, NEARLY_OPAQUE));
        let summed: f32 = means.iter().skip(1).map(|plane| depth(plane.texels[index][3])).sum();
        let wanted = -libm::logf(clear.texels[index][3].clamp(NEARLY_NONE, 1.0));
        // Never thicker than the mean: rounding only.
        let power = if summed > 0.0 { (wanted / summed).min(1.0) } else { 1.0 };
        for layer in layers.iter_mut().skip(1) {
            let texel = &mut layer.texels[index];
            let alpha = -libm::expm1f(-power * depth(texel[3]));
            let share = if texel[3] > 0.0 { alpha / texel[3] } else { 0.0 };
            *texel = [texel[0] * share, texel[1] * share, texel[2] * share, alpha];
        }
    }
    layers
}
