//! Hair textures on the device.

use std::sync::Arc;

use pelage_coat::{Encoding, FinTexture, MipImage, ShellLayer, ShellTexture};
use pelage_lighting::LightingTable;
use wgpu::{
    Device, Extent3d, Origin3d, Queue, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureAspect, TextureDescriptor,
    TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor, TextureViewDimension,
};

use crate::pack::half;

/// The shell stack and the fin on the device; any number of coats may share them.
#[derive(Clone, Debug)]
pub struct GpuTextures {
    pub(crate) shell_view: TextureView,
    /// The image of the finest level's innermost shell: bare skin, where coarser ones have hair on it.
    pub(crate) skin: TextureView,
    pub(crate) directions: TextureView,
    pub(crate) fin: TextureView,
    pub(crate) levels: Arc<[Vec<ShellLayer>]>,
    pub(crate) has_fin: bool,
    pub(crate) has_directions: bool,
    pub(crate) mixtures: Mixtures,
}

/// The mixtures of hair that there are where coats become each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Mixtures {
    pub(crate) count: u32,
    /// Images of shells that each has.
    pub(crate) images: u32,
}

impl GpuTextures {
    /// Uploads textures that have passed [`pelage_coat::Coat::check`] and the device's limits.
    pub(crate) fn new(device: &Device, queue: &Queue, shells: &ShellTexture, fin: Option<&FinTexture>) -> Self {
        // Where there is no fin or no map, its place in the bind group is filled by a texel that nothing reads.
        let none = [MipImage { width: 1, height: 1, texels: vec![0; 4] }];
        let format = match shells.encoding {
            Encoding::Rgba8 => TextureFormat::Rgba8UnormSrgb,
            Encoding::Bc3 => TextureFormat::Bc3RgbaUnormSrgb,
        };
        let stack = |label, format, layers, mips: &[MipImage]| upload(device, queue, label, format, layers, mips);
        let texture = stack("shells", format, shells.images, &shells.mips);
        let (count, map) = shells.directions.as_ref().map_or((1, &none[..]), |map| (shells.images, map));
        let directions = stack("directions", TextureFormat::Rgba8Unorm, count, map);
        let fin_texture =
            stack("fin", TextureFormat::Rgba8UnormSrgb, fin.map_or(1, |fin| fin.mixtures), fin.map_or(&none[..], |fin| &fin.mips));
        Self {
            skin: texture.create_view(&TextureViewDescriptor {
                dimension: Some(TextureViewDimension::D2),
                base_array_layer: shells.levels.first().and_then(|level| level.first()).map_or(0, |skin| skin.image),
                array_layer_count: Some(1),
                ..TextureViewDescriptor::default()
            }),
            shell_view: view(&texture, TextureViewDimension::D2Array),
            directions: view(&directions, TextureViewDimension::D2Array),
            fin: view(&fin_texture, TextureViewDimension::D2Array),
            levels: shells.levels.clone().into(),
            has_fin: fin.is_some(),
            has_directions: shells.directions.is_some(),
            mixtures: Mixtures {
                count: shells.mixtures.max(fin.map_or(1, |fin| fin.mixtures)),
                images: shells.images / shells.mixtures.max(1),
            },
        }
    }
}

fn upload(device: &Device, queue: &Queue, label: &str, format: TextureFormat, layers: u32, mips: &[MipImage]) -> Texture {
    let size = Extent3d { width: mips[0].width, height: mips[0].height, depth_or_array_layers: layers };
    let texture = create(device, label, size, mips.len() as u32, format);
    for (level, mip) in mips.iter().enumerate() {
        let size = Extent3d { width: mip.width, height: mip.height, depth_or_array_layers: layers };
        write(queue, &texture, level as u32, size, &mip.texels);
    }
    texture
}

fn view(texture: &Texture, dimension: TextureViewDimension) -> TextureView {
    texture.create_view(&TextureViewDescriptor { dimension: Some(dimension), ..TextureViewDescriptor::default() })
}

/// The two factors of a lighting table as half floats: at most 2.5e-4 off the table itself.
pub(crate) fn upload_table(device: &Device, queue: &Queue, table: &LightingTable) -> TextureView {
    let texels: Vec<[u16; 2]> = table.texels().iter().map(|&[diffuse, specular]| [half(diffuse), half(specular)]).collect();
    upload_factors(device, queue, table.layout().size as u32, &texels)
}

/// What is bound where no table is asked for.
pub(crate) fn no_table(device: &Device, queue: &Queue) -> TextureView {
    upload_factors(device, queue, 1, &[[0; 2]])
}

fn upload_factors(device: &Device, queue: &Queue, side: u32, texels: &[[u16; 2]]) -> TextureView {
    let size = Extent3d { width: side, height: side, depth_or_array_layers: 1 };
    let texture = create(device, "lighting table", size, 1, TextureFormat::Rg16Float);
    write(queue, &texture, 0, size, bytemuck::cast_slice(texels));
    texture.create_view(&TextureViewDescriptor::default())
}

fn create(device: &Device, label: &str, size: Extent3d, levels: u32, format: TextureFormat) -> Texture {
    device.create_texture(&TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: levels,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// Writes a whole level. Of compressed formats the copy goes in whole blocks, past the image's edge if need be.
fn write(queue: &Queue, texture: &Texture, mip_level: u32, size: Extent3d, bytes: &[u8]) {
    let (block_width, block_height) = texture.format().block_dimensions();
    let block_bytes = texture.format().block_copy_size(None).unwrap_or(4);
    let (across, down) = (size.width.div_ceil(block_width), size.height.div_ceil(block_height));
    queue.write_texture(
        TexelCopyTextureInfo { texture, mip_level, origin: Origin3d::ZERO, aspect: TextureAspect::All },
        bytes,
        TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(block_bytes * across), rows_per_image: Some(down) },
        Extent3d { width: across * block_width, height: down * block_height, ..size },
    );
}
