//! The textures of a picture.

use wgpu::{
    Color, CommandEncoder, Device, Extent3d, LoadOp, Operations, QuerySet, RenderPass, RenderPassColorAttachment,
    RenderPassDepthStencilAttachment, RenderPassDescriptor, RenderPassTimestampWrites, StoreOp, Texture, TextureDescriptor,
    TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
};

use crate::Target;

/// Colour, depth and, with several samples, what they are resolved into.
#[derive(Debug)]
pub(crate) struct Attachments {
    clear_depth: f32,
    colour: TextureView,
    pub(crate) depth: TextureView,
    resolved: Option<TextureView>,
    /// The one to read.
    pub(crate) pixels: Texture,
}

/// Where in the frame a pass is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    /// It clears.
    pub(crate) first: bool,
    /// It resolves the samples.
    pub(crate) last: bool,
}

/// What is found out about a pass.
#[derive(Default)]
pub(crate) struct PassMeasures<'a> {
    pub(crate) times: Option<RenderPassTimestampWrites<'a>>,
    pub(crate) fragments: Option<&'a QuerySet>,
}

impl Attachments {
    pub(crate) fn new(device: &Device, target: Target, (width, height): (u32, u32)) -> Self {
        let texture = |label, format: TextureFormat, sample_count, usage| {
            device.create_texture(&TextureDescriptor {
                label: Some(label),
                size: Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let view = |texture: &Texture| texture.create_view(&TextureViewDescriptor::default());
        let drawn = TextureUsages::RENDER_ATTACHMENT;
        let depth = view(&texture("depth", target.depth, target.samples, drawn | TextureUsages::TEXTURE_BINDING));
        let pixels = texture("pixels", target.colour, 1, drawn | TextureUsages::COPY_SRC);
        let clear_depth = target.clear_depth();
        if target.samples == 1 {
            return Self { clear_depth, colour: view(&pixels), depth, resolved: None, pixels };
        }
        let samples = texture("samples", target.colour, target.samples, drawn);
        Self { clear_depth, colour: view(&samples), depth, resolved: Some(view(&pixels)), pixels }
    }

    /// Begins a pass on them. What is not cleared is kept from the pass before.
    pub(crate) fn pass<'e>(
        &self,
        encoder: &'e mut CommandEncoder,
        label: &str,
        place: Place,
        measured: PassMeasures<'_>,
    ) -> RenderPass<'e> {
        let load = if place.first { LoadOp::Clear(Color::TRANSPARENT) } else { LoadOp::Load };
        let load_depth = if place.first { LoadOp::Clear(self.clear_depth) } else { LoadOp::Load };
        let store_samples = if place.last && self.resolved.is_some() { StoreOp::Discard } else { StoreOp::Store };
        encoder.begin_render_pass(&RenderPassDescriptor {
            label: Some(label),
            color_attachments: &[Some(RenderPassColorAttachment {
                view: &self.colour,
                depth_slice: None,
                resolve_target: self.resolved.as_ref().filter(|_| place.last),
                ops: Operations { load, store: store_samples },
            })],
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(Operations { load: load_depth, store: if place.last { StoreOp::Discard } else { StoreOp::Store } }),
                stencil_ops: None,
            }),
            timestamp_writes: measured.times,
            occlusion_query_set: measured.fragments,
            ..RenderPassDescriptor::default()
        })
    }
}
