//! What surfaces look like, as far as fur has use for it.

use glam::Vec4;
use gltf::Document;

use super::beside::Buffers;
use super::error::GltfFault;

/// The base colour of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct GltfMaterial {
    /// Red, green and blue in linear light, and alpha: what the image and the vertices' colours are multiplied by.
    pub base_colour: Vec4,
    /// Which of the import's images it has, if any; it is laid by the mesh's texture coordinates.
    pub image: Option<usize>,
}

/// An image file, undecoded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GltfImage {
    /// Its path beside the model, or its number where it is embedded.
    pub name: String,
    /// The whole file.
    pub bytes: Vec<u8>,
}

/// The materials in use and their images, each image once.
pub(super) fn read(
    document: &Document,
    in_use: &[Option<usize>],
    buffers: &mut Buffers<'_, '_>,
) -> Result<(Vec<GltfMaterial>, Vec<GltfImage>), GltfFault> {
    let (mut materials, mut images, mut sources) = (Vec::new(), Vec::new(), Vec::<usize>::new());
    for &index in in_use {
        let material = index.and_then(|index| document.materials().nth(index));
        let Some(base) = material.map(|material| material.pbr_metallic_roughness()) else {
            materials.push(GltfMaterial { base_colour: super::WHITE, image: None });
            continue;
        };
        let image = match base.base_color_texture().map(|texture| texture.texture().source().index()) {
            None => None,
            Some(source) => Some(match sources.iter().position(|&known| known == source) {
                Some(known) => known,
                None => {
                    let (bytes, name) = buffers.image(source)?;
                    images.push(GltfImage { name, bytes });
                    sources.push(source);
                    sources.len() - 1
                }
            }),
        };
        materials.push(GltfMaterial { base_colour: Vec4::from(base.base_color_factor()).clamp(Vec4::ZERO, Vec4::ONE), image });
    }
    Ok((materials, images))
}
