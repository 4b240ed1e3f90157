//! A target, a frame on it, and how many fragments that took: what frames are measured on.

use std::time::Instant;

use pelage_render::{Headless, Renderer, Target};
use wgpu::{
    BufferDescriptor, BufferUsages, Color, CommandEncoder, CommandEncoderDescriptor, Extent3d, LoadOp, MapMode, Operations, PollType,
    QuerySet, QuerySetDescriptor, QueryType, RenderPass, RenderPassColorAttachment, RenderPassDepthStencilAttachment, RenderPassDescriptor,
    StoreOp, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
};

use crate::Error;

/// Width and height of every frame that is measured, in pixels.
pub const SIZE: (u32, u32) = (640, 480);

/// What frames are drawn on to be measured.
pub struct Stage {
    /// Formats and samples.
    pub target: Target,
    /// One for all that is drawn of ours: what it has compiled is compiled.
    pub renderer: Renderer,
    /// Its depth buffer.
    pub depth: TextureView,
    colour: TextureView,
    resolved: Option<TextureView>,
    occlusion: QuerySet,
}

impl Stage {
    /// A stage of [`SIZE`] with one or four samples a pixel.
    pub fn new(headless: &Headless, samples: u32) -> Self {
        let target = Target::new(TextureFormat::Rgba8UnormSrgb, samples);
        let device = headless.device();
        let view = |format: TextureFormat, sample_count| {
            let texture = device.create_texture(&TextureDescriptor {
                label: None,
                size: Extent3d { width: SIZE.0, height: SIZE.1, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: TextureDimension::D2,
                format,
                // To be looked through for what hides fur, where samples are one.
                usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            texture.create_view(&TextureViewDescriptor::default())
        };
        Self {
            colour: view(target.colour, target.samples),
            resolved: (target.samples > 1).then(|| view(target.colour, 1)),
            depth: view(target.depth, target.samples),
            occlusion: device.create_query_set(&QuerySetDescriptor { label: None, ty: QueryType::Occlusion, count: 1 }),
            renderer: Renderer::new(device, headless.queue(), target),
            target,
        }
    }

    /// A pass; the first of a frame clears, the last need not keep what is resolved.
    pub fn pass<'e>(&self, encoder: &'e mut CommandEncoder, (first, last): (bool, bool), occlusion: Option<&QuerySet>) -> RenderPass<'e> {
        let clear = Color { r: 0.1, g: 0.1, b: 0.1, a: 0.0 };
        let samples_go = last && self.resolved.is_some();
        encoder.begin_render_pass(&RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(RenderPassColorAttachment {
                view: &self.colour,
                depth_slice: None,
                resolve_target: self.resolved.as_ref().filter(|_| last),
                ops: Operations {
                    load: if first { LoadOp::Clear(clear) } else { LoadOp::Load },
                    store: if samples_go { StoreOp::Discard } else { StoreOp::Store },
                },
            })],
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(Operations {
                    load: if first { LoadOp::Clear(0.0) } else { LoadOp::Load },
                    store: if last { StoreOp::Discard } else { StoreOp::Store },
                }),
                stencil_ops: None,
            }),
            occlusion_query_set: occlusion,
            ..RenderPassDescriptor::default()
        })
    }

    /// Draws a frame to its end, and says how many milliseconds that took.
    ///
    /// # Errors
    /// A device that does not answer.
    pub fn time(&self, headless: &Headless, record: &mut dyn FnMut(&mut CommandEncoder)) -> Result<f64, Error> {
        let start = Instant::now();
        let mut encoder = headless.device().create_command_encoder(&CommandEncoderDescriptor::default());
        record(&mut encoder);
        headless.queue().submit([encoder.finish()]);
        headless.device().poll(PollType::wait_indefinitely())?;
        Ok(start.elapsed().as_secs_f64() * 1e3)
    }

    /// How many samples pass the tests.
    ///
    /// # Errors
    /// A device that does not answer.
    pub fn fragments(
        &self,
        headless: &Headless,
        compute: &dyn Fn(&mut CommandEncoder),
        draw: &dyn Fn(&mut RenderPass<'_>),
    ) -> Result<u64, Error> {
        let device = headless.device();
        let buffer = |usage| device.create_buffer(&BufferDescriptor { label: None, size: 8, usage, mapped_at_creation: false });
        let resolved = buffer(BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC);
        let readable = buffer(BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
        compute(&mut encoder);
        {
            let mut pass = self.pass(&mut encoder, (true, true), Some(&self.occlusion));
            pass.begin_occlusion_query(0);
            draw(&mut pass);
            pass.end_occlusion_query();
        }
        encoder.resolve_query_set(&self.occlusion, 0..1, &resolved, 0);
        encoder.copy_buffer_to_buffer(&resolved, 0, &readable, 0, 8);
        headless.queue().submit([encoder.finish()]);
        readable.slice(..).map_async(MapMode::Read, |_| ());
        device.poll(PollType::wait_indefinitely())?;
        let view = readable.slice(..).get_mapped_range()?;
        Ok(bytemuck::pod_read_unaligned(&view))
    }
}
