//! Hair textures on the device.

use pelage_coat::{FinTexture, MipImage, ShellTexture};
use pelage_lighting::LightingTable;
use wgpu::{
    Device, Extent3d, Origin3d, Queue, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureAspect, TextureDescriptor,
    TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor, TextureViewDimension,
};

use crate::pack::half;

/// The shell stack and the fin on the device; any number of coats may share them.
#[derive(Clone, Debug)]
pub struct GpuTextures {
    pub(crate) shells: TextureView,
    pub(crate) fin: TextureView,
    pub(crate) layers: u32,
    pub(crate) has_fin: bool,
}

impl GpuTextures {
    /// Uploads textures that have passed [`pelage_coat::Coat::check`] and the device's limits.
    pub(crate) fn new(device: &Device, queue: &Queue, shells: &ShellTexture, fin: Option<&FinTexture>) -> Self {
        // Where there is no fin its place in the bind group is filled by a texel that nothing reads.
        let none = [MipImage { width: 1, height: 1, texels: vec![0; 4] }];
        let fin_mips = fin.map_or(&none[..], |fin| &fin.mips);
        Self {
            shells: upload(device, queue, "shells", shells.layers(), &shells.mips, TextureViewDimension::D2Array),
            fin: upload(device, queue, "fin", 1, fin_mips, TextureViewDimension::D2),
            layers: shells.layers(),
            has_fin: fin.is_some(),
        }
    }
}

fn upload(device: &Device, queue: &Queue, label: &str, layers: u32, mips: &[MipImage], dimension: TextureViewDimension) -> TextureView {
    let size = Extent3d { width: mips[0].width, height: mips[0].height, depth_or_array_layers: layers };
    let texture = create(device, label, size, mips.len() as u32, TextureFormat::Rgba8UnormSrgb);
    for (level, mip) in mips.iter().enumerate() {
        let size = Extent3d { width: mip.width, height: mip.height, depth_or_array_layers: layers };
        write(queue, &texture, level as u32, size, 4, &mip.texels);
    }
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
    write(queue, &texture, 0, size, 4, bytemuck::cast_slice(texels));
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

fn write(queue: &Queue, texture: &Texture, mip_level: u32, size: Extent3d, texel_bytes: u32, bytes: &[u8]) {
    queue.write_texture(
        TexelCopyTextureInfo { texture, mip_level, origin: Origin3d::ZERO, aspect: TextureAspect::All },
        bytes,
        TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(texel_bytes * size.width), rows_per_image: Some(size.height) },
        size,
    );
}
