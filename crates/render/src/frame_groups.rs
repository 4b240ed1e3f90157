//! What the shaders of a frame are given.

use wgpu::{BindGroup, BindingResource, Buffer, BufferUsages, Device, Sampler, TextureView};

use crate::GpuCoat;
use crate::bindings::bind;
use crate::buffers::room;
use crate::schedule::{MOST_SHELLS, Shell};
use crate::shadow::ShadowTargets;
use crate::shared::Shared;
use crate::uniforms::FrameUniform;

/// The buffers that a view writes anew for each frame.
#[derive(Debug)]
pub(crate) struct FrameBuffers {
    pub(crate) frame: Buffer,
    pub(crate) shells: Buffer,
    /// Which shells are drawn, as vertices.
    pub(crate) drawn: Buffer,
}

impl FrameBuffers {
    pub(crate) fn new(device: &Device) -> Self {
        Self {
            frame: room(device, "frame", BufferUsages::UNIFORM, size_of::<FrameUniform>() as u64),
            shells: room(device, "shells", BufferUsages::UNIFORM, (MOST_SHELLS * size_of::<Shell>()) as u64),
            drawn: room(device, "drawn shells", BufferUsages::VERTEX, (MOST_SHELLS * size_of::<u32>()) as u64),
        }
    }
}

/// What differs from view to view.
pub(crate) struct GroupParts<'a> {
    pub(crate) factors: &'a TextureView,
    pub(crate) anisotropy: u16,
    pub(crate) shadows: Option<&'a ShadowTargets>,
}

/// The bindings of a frame.
#[derive(Debug)]
pub(crate) struct FrameGroups {
    drawing: BindGroup,
    /// For the shadow map's own passes, which cannot read what they write: without any of it, and with the first hairs.
    casting: Option<[BindGroup; 2]>,
}

impl FrameGroups {
    pub(crate) fn new(
        device: &Device,
        shared: &Shared,
        coat: &GpuCoat,
        buffers: &FrameBuffers,
        second: &Buffer,
        parts: &GroupParts<'_>,
    ) -> Self {
        let samplers = shared.hair_samplers(device, parts.anisotropy);
        let maker = Maker { device, shared, coat, buffers, second, factors: parts.factors, samplers };
        let none = &shared.no_shadow;
        let all = parts.shadows.unwrap_or(none);
        Self {
            drawing: maker.group([&all.skin, &all.fronts, &all.slices]),
            casting: parts.shadows.map(|map| {
                [[&none.skin, &none.fronts, &none.slices], [&none.skin, &map.fronts, &none.slices]].map(|textures| maker.group(textures))
            }),
        }
    }

    /// For the passes that draw.
    pub(crate) fn drawing(&self) -> &BindGroup {
        &self.drawing
    }

    /// For the passes of the shadow map.
    pub(crate) fn casting(&self) -> [&BindGroup; 2] {
        self.casting.as_ref().map_or([&self.drawing; 2], |[first, second]| [first, second])
    }
}

struct Maker<'a> {
    device: &'a Device,
    shared: &'a Shared,
    coat: &'a GpuCoat,
    buffers: &'a FrameBuffers,
    second: &'a Buffer,
    factors: &'a TextureView,
    samplers: [Sampler; 2],
}

impl Maker<'_> {
    fn group(&self, shadows: [&TextureView; 3]) -> BindGroup {
        let resources = [
            self.buffers.frame.as_entire_binding(),
            self.buffers.shells.as_entire_binding(),
            self.second.as_entire_binding(),
            BindingResource::TextureView(self.factors),
            BindingResource::Sampler(&self.shared.table_sampler),
            BindingResource::Sampler(&self.samplers[0]),
            BindingResource::Sampler(&self.samplers[1]),
            BindingResource::TextureView(&self.coat.textures.shell_view),
            BindingResource::TextureView(&self.coat.textures.directions),
            BindingResource::TextureView(shadows[0]),
            BindingResource::TextureView(shadows[1]),
            BindingResource::TextureView(shadows[2]),
            BindingResource::Sampler(&self.shared.shadow_sampler),
            BindingResource::TextureView(&self.coat.textures.skin),
        ];
        bind(self.device, "frame", &self.shared.pipelines.frame_layout, resources)
    }
}
