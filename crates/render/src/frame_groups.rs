//! What the shaders of a frame are given.

use wgpu::{BindGroup, BindingResource, Buffer, BufferUsages, Device, Sampler, TextureView};

use crate::GpuCoat;
use crate::bindings::bind;
use crate::buffers::room;
use crate::renderer::Shared;
use crate::schedule::{MOST_SHELLS, Shell};
use crate::shadow::ShadowTargets;
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
    /// The images of blended levels, where there are any.
    pub(crate) blended: Option<&'a TextureView>,
    pub(crate) shadows: Option<&'a ShadowTargets>,
}

/// The bindings of a frame.
#[derive(Debug)]
pub(crate) struct FrameGroups {
    /// With the coat's own images.
    plain: Sets,
    /// With blended ones.
    blended: Option<Sets>,
}

#[derive(Debug)]
struct Sets {
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
        fins: &Buffer,
        parts: &GroupParts<'_>,
    ) -> Self {
        let samplers = shared.hair_samplers(device, parts.anisotropy);
        let maker = Maker { device, shared, coat, buffers, fins, factors: parts.factors, samplers };
        Self {
            plain: maker.sets(&coat.textures.shell_view, parts.shadows),
            blended: parts.blended.map(|images| maker.sets(images, parts.shadows)),
        }
    }

    /// For the passes that draw.
    pub(crate) fn drawing(&self, blended: bool) -> &BindGroup {
        &self.sets(blended).drawing
    }

    /// For the passes of the shadow map.
    pub(crate) fn casting(&self, blended: bool) -> [&BindGroup; 2] {
        let sets = self.sets(blended);
        sets.casting.as_ref().map_or([&sets.drawing; 2], |[first, second]| [first, second])
    }

    fn sets(&self, blended: bool) -> &Sets {
        self.blended.as_ref().filter(|_| blended).unwrap_or(&self.plain)
    }
}

struct Maker<'a> {
    device: &'a Device,
    shared: &'a Shared,
    coat: &'a GpuCoat,
    buffers: &'a FrameBuffers,
    fins: &'a Buffer,
    factors: &'a TextureView,
    samplers: [Sampler; 2],
}

impl Maker<'_> {
    fn sets(&self, images: &TextureView, shadows: Option<&ShadowTargets>) -> Sets {
        let none = &self.shared.no_shadow;
        let all = shadows.unwrap_or(none);
        Sets {
            drawing: self.group(images, [&all.skin, &all.fronts, &all.slices]),
            casting: shadows.map(|map| {
                [[&none.skin, &none.fronts, &none.slices], [&none.skin, &map.fronts, &none.slices]]
                    .map(|textures| self.group(images, textures))
            }),
        }
    }

    fn group(&self, images: &TextureView, shadows: [&TextureView; 3]) -> BindGroup {
        let resources = [
            self.buffers.frame.as_entire_binding(),
            self.buffers.shells.as_entire_binding(),
            self.fins.as_entire_binding(),
            BindingResource::TextureView(self.factors),
            BindingResource::Sampler(&self.shared.table_sampler),
            BindingResource::Sampler(&self.samplers[0]),
            BindingResource::Sampler(&self.samplers[1]),
            BindingResource::TextureView(images),
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
