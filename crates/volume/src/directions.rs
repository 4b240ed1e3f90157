//! The mean direction of the hair that each texel shows (L15).
//!
//! While it is worked on, a direction is a plane like colour: its coordinates times what the hair covers, and that. So means over texels are weighted by
//! coverage, and hair over hair shows what colour does.

use rayon::prelude::*;

use crate::image::Image;
use crate::plane::Plane;

/// The direction map of images with mips down to one texel.
///
/// A texel without hair takes the mean of the smallest block around it that holds some. A graphics card mixes four texels without knowing which hold
/// hair; a zero among them would shorten the direction at the edge of every hair, and lighting would take it for hair that stands every which way.
pub(crate) fn direction_mips(planes: Vec<Plane>) -> Vec<Image> {
    let filled: Vec<Vec<Plane>> = planes.into_par_iter().map(filled_levels).collect();
    let levels = filled.first().map_or(0, Vec::len);
    (0..levels).map(|level| encode(filled.iter().map(|planes| &planes[level]))).collect()
}

/// All levels of one image, finest first, divided by what is covered and filled where nothing is.
fn filled_levels(plane: Plane) -> Vec<Plane> {
    let mut levels = vec![plane];
    while let Some(coarser) = levels.last().filter(|level| !level.is_one_texel()).map(Plane::halved) {
        levels.push(coarser);
    }
    for level in (0..levels.len()).rev() {
        let (finer, coarser) = levels.split_at_mut(level + 1);
        fill(&mut finer[level], coarser.first());
    }
    levels
}

/// Divides by what is covered; takes the coarser level's where nothing is, and straight up where the whole image is empty.
fn fill(plane: &mut Plane, coarser: Option<&Plane>) {
    let width = plane.width;
    for (index, texel) in plane.texels.iter_mut().enumerate() {
        let [x, y, z, covered] = *texel;
        *texel = if covered > 0.0 {
            [x / covered, y / covered, z / covered, 1.0]
        } else {
            let (column, row) = (index % width / 2, index / width / 2);
            coarser.and_then(|coarser| coarser.texels.get(row * coarser.width + column)).copied().unwrap_or([0.0, 0.0, 1.0, 1.0])
        };
    }
}

/// Directions as bytes: 127.5 (1 + x), to the nearest.
fn encode<'a>(planes: impl Iterator<Item = &'a Plane>) -> Image {
    let mut image = Image { width: 0, height: 0, layers: 0, texels: Vec::new() };
    for plane in planes {
        (image.width, image.height) = (plane.width as u32, plane.height as u32);
        image.layers += 1;
        for texel in &plane.texels {
            image.texels.extend(texel[..3].iter().map(|x| (127.5 * (1.0 + x.clamp(-1.0, 1.0))).round() as u8));
            image.texels.push(255);
        }
    }
    image
}

/// One image of a direction map, weighted by what its colour image covers.
pub(crate) fn weighted(map: &Image, layer: u32, colour: &Plane) -> Plane {
    let mut plane = Plane::new(colour.width, colour.height);
    let bytes = map.texels.chunks_exact(4).skip(layer as usize * colour.texels.len());
    for ((texel, bytes), colour) in plane.texels.iter_mut().zip(bytes).zip(&colour.texels) {
        let [x, y, z] = [0, 1, 2].map(|axis| (f32::from(bytes[axis]) / 127.5 - 1.0) * colour[3]);
        *texel = [x, y, z, colour[3]];
    }
    plane
}
