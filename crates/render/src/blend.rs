//! Two levels of detail blended on the tile (L16), before the shells are drawn from it.

use std::sync::atomic::{AtomicBool, Ordering};

use wgpu::{
    BindGroup, BindGroupLayout, BindGroupLayoutDescriptor, BindingResource, BindingType, Buffer, BufferUsages, ComputePass,
    ComputePipeline, Device, Extent3d, Queue, ShaderStages, StorageTextureAccess, Texture, TextureDescriptor, TextureDimension,
    TextureFormat, TextureUsages, TextureView, TextureViewDescriptor, TextureViewDimension,
};

use crate::GpuTextures;
use crate::bindings::bind;
use crate::buffers::room;
use crate::compute::compute_pipeline;
use crate::pipelines::{entry, texture, uniform};
use crate::schedule::{MOST_SHELLS, Slot};
use crate::shader::assemble;

/// Texels along a side of what one group of the shader blends.
const GROUP: u32 = 8;

/// The compute pipeline.
#[derive(Debug)]
pub(crate) struct Blender {
    layout: BindGroupLayout,
    pipeline: ComputePipeline,
}

/// The stack that a view's blended levels are put into.
#[derive(Debug)]
pub(crate) struct BlendedStack {
    stack: Texture,
    slots: Buffer,
    /// What is blended.
    blend: Vec<Slot>,
    /// Whether that, or what is blended, has changed since it was made.
    stale: AtomicBool,
    /// For each mip, what it is made of and its side.
    mips: Vec<(BindGroup, u32)>,
}

impl Blender {
    pub(crate) fn new(device: &Device) -> Self {
        let compute = ShaderStages::COMPUTE;
        let written = BindingType::StorageTexture {
            access: StorageTextureAccess::WriteOnly,
            format: TextureFormat::Rgba8Unorm,
            view_dimension: TextureViewDimension::D2Array,
        };
        let entries = [entry(0, compute, texture(TextureViewDimension::D2Array)), entry(1, compute, written), entry(2, compute, uniform())];
        let layout = device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: Some("blend"), entries: &entries });
        let source = assemble(&[include_str!("shaders/opacity.wgsl"), include_str!("shaders/blend.wgsl")], &[]);
        let pipeline = compute_pipeline(device, source, "blend", &[&layout]);
        Self { layout, pipeline }
    }
}

impl BlendedStack {
    /// Room for the finest level's images.
    pub(crate) fn new(device: &Device, blender: &Blender, textures: &GpuTextures) -> Self {
        let layers = textures.levels.first().map_or(1, Vec::len) as u32;
        let source = &textures.shells;
        // Written as it is, read as sRGB: storage has no such encoding.
        let stack = device.create_texture(&TextureDescriptor {
            label: Some("blended levels"),
            size: Extent3d { width: source.width(), height: source.height(), depth_or_array_layers: layers },
            mip_level_count: source.mip_level_count(),
            sample_count: 1,
            dimension: TextureDimension::D2,
            format: TextureFormat::Rgba8Unorm,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::STORAGE_BINDING,
            view_formats: &[TextureFormat::Rgba8UnormSrgb],
        });
        let slots = room(device, "blend", BufferUsages::UNIFORM, (MOST_SHELLS * size_of::<Slot>()) as u64);
        let mips = (0..source.mip_level_count()).map(|mip| {
            let of = |texture: &Texture, usage| {
                texture.create_view(&TextureViewDescriptor {
                    dimension: Some(TextureViewDimension::D2Array),
                    base_mip_level: mip,
                    mip_level_count: Some(1),
                    usage: Some(usage),
                    ..TextureViewDescriptor::default()
                })
            };
            let views = [of(source, TextureUsages::TEXTURE_BINDING), of(&stack, TextureUsages::STORAGE_BINDING)];
            let mut resources = views.iter().map(BindingResource::TextureView).collect::<Vec<_>>();
            resources.push(slots.as_entire_binding());
            let group = bind(device, "blend", &blender.layout, resources);
            (group, (source.width() >> mip).max(1))
        });
        Self { mips: mips.collect(), stack, slots, blend: Vec::new(), stale: AtomicBool::new(true) }
    }

    /// The images from a mip on, to be read.
    pub(crate) fn view(&self, finest: u32) -> TextureView {
        self.stack.create_view(&TextureViewDescriptor {
            format: Some(TextureFormat::Rgba8UnormSrgb),
            dimension: Some(TextureViewDimension::D2Array),
            usage: Some(TextureUsages::TEXTURE_BINDING),
            base_mip_level: finest,
            ..TextureViewDescriptor::default()
        })
    }

    /// Says what is blended from now on; nothing where a level is drawn as it is.
    pub(crate) fn set(&mut self, queue: &Queue, slots: &[Slot]) {
        if slots.is_empty() || self.blend == slots {
            return;
        }
        queue.write_buffer(&self.slots, 0, bytemuck::cast_slice(slots));
        self.blend = slots.to_vec();
        self.remake();
    }

    /// Has the images made anew with the next frame.
    pub(crate) fn remake(&self) {
        self.stale.store(true, Ordering::Relaxed);
    }

    /// Records the blending from a mip on, finer ones are not seen, if anything has changed.
    pub(crate) fn record(&self, pass: &mut ComputePass<'_>, blender: &Blender, finest: u32) {
        if !self.stale.swap(false, Ordering::Relaxed) {
            return;
        }
        pass.set_pipeline(&blender.pipeline);
        for (group, side) in self.mips.iter().skip(finest as usize) {
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(side.div_ceil(GROUP), side.div_ceil(GROUP), self.blend.len() as u32);
        }
    }
}
