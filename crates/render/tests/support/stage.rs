//! A pass of our own: any device, any target, views that are moved from frame to frame.
#![allow(clippy::expect_used, reason = "a test may panic")]

use glam::{Mat4, Vec4};
use pelage_coat::Coat;
use pelage_render::{DepthBuffer, GpuCoat, PreparedView, Renderer, Target, View, Viewpoint};
use wgpu::{
    Color, CommandEncoderDescriptor, Device, Extent3d, LoadOp, MapMode, Operations, PollType, Queue, RenderPassColorAttachment,
    RenderPassDepthStencilAttachment, RenderPassDescriptor, StoreOp, TexelCopyBufferInfo, TexelCopyBufferLayout, TextureDescriptor,
    TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
};

use super::{SIZE, headless};

/// A renderer and the textures that it draws into.
pub struct Stage {
    pub device: Device,
    pub queue: Queue,
    pub renderer: Renderer,
    pub size: (u32, u32),
}

impl Stage {
    /// On the device that all tests share, into a target with reversed depth and one sample.
    pub fn plain() -> Self {
        Self::on(headless().device(), headless().queue(), Target::new(TextureFormat::Rgba8UnormSrgb, 1))
    }

    /// Likewise, into half floats, which show what bytes hide: numbers that are none, and what is less than half a step.
    pub fn floating() -> Self {
        Self::on(headless().device(), headless().queue(), Target::new(TextureFormat::Rgba16Float, 1))
    }

    pub fn on(device: &Device, queue: &Queue, target: Target) -> Self {
        Self { device: device.clone(), queue: queue.clone(), renderer: Renderer::new(device, queue, target), size: SIZE }
    }

    pub fn upload(&self, coat: &Coat) -> GpuCoat {
        self.renderer.upload(&self.device, &self.queue, coat).expect("a coat")
    }

    /// The view's own camera, for this target's depth.
    pub fn viewpoint(&self, view: &View) -> Viewpoint {
        let mut viewpoint = Viewpoint::of(&view.camera, self.size);
        if !self.renderer.target().reversed_depth {
            let turned = Mat4::from_cols(Vec4::X, Vec4::Y, -Vec4::Z, Vec4::new(0.0, 0.0, 1.0, 1.0));
            viewpoint.clip_from_coat = turned * viewpoint.clip_from_coat;
        }
        viewpoint
    }

    pub fn prepare(&self, coat: &GpuCoat, view: &View) -> PreparedView {
        self.prepare_from(coat, view, &self.viewpoint(view))
    }

    pub fn prepare_from(&self, coat: &GpuCoat, view: &View, viewpoint: &Viewpoint) -> PreparedView {
        self.renderer.prepare(&self.device, &self.queue, coat, view, viewpoint).expect("a view")
    }

    pub fn update(&self, prepared: &mut PreparedView, view: &View) {
        let viewpoint = self.viewpoint(view);
        self.renderer.update(&self.device, &self.queue, prepared, view, &viewpoint).expect("a view");
    }

    /// Draws a frame of floats over nothing and brings back its numbers: linear premultiplied colour and coverage.
    pub fn numbers(&self, view: &PreparedView) -> Vec<[f32; 4]> {
        let bytes = self.frame(view);
        let numbers: Vec<f32> = match self.renderer.target().colour {
            TextureFormat::Rgba32Float => bytes.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect(),
            _ => bytes.as_chunks::<2>().0.iter().map(|bytes| unpacked(u16::from_le_bytes(*bytes))).collect(),
        };
        numbers.as_chunks::<4>().0.to_vec()
    }

    /// Draws a frame over nothing and brings back its bytes: sRGB-encoded premultiplied colour and coverage.
    pub fn frame(&self, view: &PreparedView) -> Vec<u8> {
        self.drawn(&mut |encoder, textures| {
            self.renderer.compute(encoder, view);
            self.pass(encoder, textures, [true, true], |pass| self.renderer.draw(pass, view));
        })
    }

    /// The same in two passes, with the faces that the skin hides left out in between.
    pub fn unhidden_frame(&self, view: &mut PreparedView) -> Vec<u8> {
        self.drawn(&mut |encoder, textures| {
            self.renderer.compute(encoder, view);
            self.pass(encoder, textures, [true, false], |pass| self.renderer.draw_surface(pass, view));
            let depth = DepthBuffer { view: &textures.depth, size: self.size };
            self.renderer.find_hidden(&self.device, &self.queue, encoder, view, depth);
            self.pass(encoder, textures, [false, true], |pass| {
                self.renderer.draw_fins(pass, view);
                self.renderer.draw_shells(pass, view);
            });
        })
    }

    fn drawn(&self, record: &mut dyn FnMut(&mut wgpu::CommandEncoder, &Textures)) -> Vec<u8> {
        let target = self.renderer.target();
        let (width, height) = self.size;
        let samples = self.texture(target.colour, target.samples, TextureUsages::COPY_SRC);
        let pixels = if target.samples > 1 { self.texture(target.colour, 1, TextureUsages::COPY_SRC) } else { samples.clone() };
        let depth = self.texture(target.depth, target.samples, TextureUsages::TEXTURE_BINDING);
        let [sampled, resolved, depth] = [&samples, &pixels, &depth].map(|texture| texture.create_view(&TextureViewDescriptor::default()));
        let textures = Textures { sampled, resolved: (target.samples > 1).then_some(resolved), depth };
        let mut encoder = self.device.create_command_encoder(&CommandEncoderDescriptor::default());
        record(&mut encoder, &textures);
        let texel = target.colour.block_copy_size(None).expect("a plain format");
        let stride = (texel * width).next_multiple_of(256);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(stride * height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride), rows_per_image: None };
        let size = Extent3d { width, height, depth_or_array_layers: 1 };
        encoder.copy_texture_to_buffer(pixels.as_image_copy(), TexelCopyBufferInfo { buffer: &buffer, layout }, size);
        self.queue.submit([encoder.finish()]);
        let (answer, answered) = std::sync::mpsc::channel();
        buffer.slice(..).map_async(MapMode::Read, move |result| answer.send(result).unwrap_or_default());
        self.device.poll(PollType::wait_indefinitely()).expect("the device answers");
        answered.recv().expect("an answer").expect("mapped");
        let bytes = buffer.slice(..).get_mapped_range().expect("mapped");
        bytes.chunks_exact(stride as usize).flat_map(|row| row[..(texel * width) as usize].to_vec()).collect()
    }

    fn texture(&self, format: TextureFormat, sample_count: u32, usage: TextureUsages) -> wgpu::Texture {
        self.device.create_texture(&TextureDescriptor {
            label: None,
            size: Extent3d { width: self.size.0, height: self.size.1, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count,
            dimension: TextureDimension::D2,
            format,
            usage: if sample_count > 1 && usage == TextureUsages::COPY_SRC { TextureUsages::empty() } else { usage }
                | TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        })
    }

    fn pass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        textures: &Textures,
        [first, last]: [bool; 2],
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let clear_depth = self.renderer.target().clear_depth();
        draw(&mut encoder.begin_render_pass(&RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(RenderPassColorAttachment {
                view: &textures.sampled,
                depth_slice: None,
                resolve_target: textures.resolved.as_ref().filter(|_| last),
                ops: Operations { load: if first { LoadOp::Clear(Color::TRANSPARENT) } else { LoadOp::Load }, store: StoreOp::Store },
            })],
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &textures.depth,
                depth_ops: Some(Operations { load: if first { LoadOp::Clear(clear_depth) } else { LoadOp::Load }, store: StoreOp::Store }),
                stencil_ops: None,
            }),
            ..RenderPassDescriptor::default()
        }));
    }
}

/// A half float.
fn unpacked(bits: u16) -> f32 {
    let (sign, exponent, fraction) = (if bits >> 15 == 1 { -1.0 } else { 1.0 }, i32::from(bits >> 10 & 31), f32::from(bits & 1023));
    match exponent {
        31 if fraction == 0.0 => sign * f32::INFINITY,
        31 => f32::NAN,
        0 => sign * fraction * 2.0_f32.powi(-24),
        _ => sign * (1.0 + fraction / 1024.0) * 2.0_f32.powi(exponent - 15),
    }
}

/// What a frame is drawn into.
struct Textures {
    sampled: TextureView,
    resolved: Option<TextureView>,
    depth: TextureView,
}
