//! A target, a frame on it, and how many fragments that took.

use pelage_render::{Headless, Target};
use wgpu::{
    BufferDescriptor, BufferUsages, Color, CommandEncoder, CommandEncoderDescriptor, Device, Extent3d, LoadOp, MapMode, Operations,
    PollType, QuerySet, QuerySetDescriptor, QueryType, RenderPass, RenderPassColorAttachment, RenderPassDepthStencilAttachment,
    RenderPassDescriptor, StoreOp, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
};

pub const SIZE: (u32, u32) = (640, 480);

pub struct Stage {
    colour: TextureView,
    resolved: Option<TextureView>,
    depth: TextureView,
    occlusion: QuerySet,
}

impl Stage {
    pub fn new(device: &Device, target: Target) -> Self {
        let view = |format: TextureFormat, sample_count| {
            let texture = device.create_texture(&TextureDescriptor {
                label: None,
                size: Extent3d { width: SIZE.0, height: SIZE.1, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: TextureDimension::D2,
                format,
                usage: TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            });
            texture.create_view(&TextureViewDescriptor::default())
        };
        Self {
            colour: view(target.colour, target.samples),
            resolved: (target.samples > 1).then(|| view(target.colour, 1)),
            depth: view(target.depth, target.samples),
            occlusion: device.create_query_set(&QuerySetDescriptor { label: None, ty: QueryType::Occlusion, count: 1 }),
        }
    }

    fn pass<'e>(&self, encoder: &'e mut CommandEncoder, occlusion: Option<&QuerySet>) -> RenderPass<'e> {
        encoder.begin_render_pass(&RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(RenderPassColorAttachment {
                view: &self.colour,
                depth_slice: None,
                resolve_target: self.resolved.as_ref(),
                ops: Operations {
                    load: LoadOp::Clear(Color { r: 0.1, g: 0.1, b: 0.1, a: 0.0 }),
                    store: if self.resolved.is_some() { StoreOp::Discard } else { StoreOp::Store },
                },
            })],
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(Operations { load: LoadOp::Clear(0.0), store: StoreOp::Discard }),
                stencil_ops: None,
            }),
            occlusion_query_set: occlusion,
            ..RenderPassDescriptor::default()
        })
    }

    /// Draws a frame to its end.
    pub fn frame(&self, headless: &Headless, compute: &dyn Fn(&mut CommandEncoder), draw: &dyn Fn(&mut RenderPass<'_>)) {
        let mut encoder = headless.device().create_command_encoder(&CommandEncoderDescriptor::default());
        compute(&mut encoder);
        draw(&mut self.pass(&mut encoder, None));
        headless.queue().submit([encoder.finish()]);
        headless.device().poll(PollType::wait_indefinitely()).expect("the device answers");
    }

    /// How many samples pass the tests.
    pub fn fragments(&self, headless: &Headless, compute: &dyn Fn(&mut CommandEncoder), draw: &dyn Fn(&mut RenderPass<'_>)) -> u64 {
        let device = headless.device();
        let buffer = |usage| device.create_buffer(&BufferDescriptor { label: None, size: 8, usage, mapped_at_creation: false });
        let resolved = buffer(BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC);
        let readable = buffer(BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
        compute(&mut encoder);
        {
            let mut pass = self.pass(&mut encoder, Some(&self.occlusion));
            pass.begin_occlusion_query(0);
            draw(&mut pass);
            pass.end_occlusion_query();
        }
        encoder.resolve_query_set(&self.occlusion, 0..1, &resolved, 0);
        encoder.copy_buffer_to_buffer(&resolved, 0, &readable, 0, 8);
        headless.queue().submit([encoder.finish()]);
        readable.slice(..).map_async(MapMode::Read, |_| ());
        device.poll(PollType::wait_indefinitely()).expect("the device answers");
        let view = readable.slice(..).get_mapped_range().expect("mapped");
        bytemuck::pod_read_unaligned(&view)
    }
}
