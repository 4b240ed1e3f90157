//! Somebody else's renderer, for the examples that draw fur into it: their device, attachments and opaque objects.
#![allow(dead_code, unreachable_pub, reason = "shared by several programs, each of which uses a part")]

mod opaque;

use std::error::Error;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use wgpu::{
    Color, CommandEncoder, CommandEncoderDescriptor, Device, DeviceDescriptor, Extent3d, Features, Instance, InstanceDescriptor, Limits,
    LoadOp, MapMode, Operations, PollType, Queue, RenderPass, RenderPassColorAttachment, RenderPassDepthStencilAttachment,
    RenderPassDescriptor, RequestAdapterOptions, StoreOp, TexelCopyBufferInfo, TexelCopyBufferLayout, Texture, TextureDescriptor,
    TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
};

#[allow(unused_imports, reason = "not every program draws them")]
pub use opaque::{Block, Opaque};

/// What most engines use: depth 0 at the near plane.
pub const DEPTH: TextureFormat = TextureFormat::Depth24Plus;
pub const COLOUR: TextureFormat = TextureFormat::Rgba8UnormSrgb;

/// A device with wgpu's default limits and no features, and a canvas to draw on.
pub struct Host {
    pub device: Device,
    pub queue: Queue,
    pub size: (u32, u32),
    pub samples: u32,
    pub depth: TextureView,
    colour: TextureView,
    resolved: Texture,
    errors: Arc<Mutex<Vec<String>>>,
}

impl Host {
    pub fn new(size: (u32, u32), samples: u32) -> Result<Self, Box<dyn Error>> {
        let instance = Instance::new(InstanceDescriptor::new_without_display_handle_from_env());
        let adapter = pollster::block_on(instance.request_adapter(&RequestAdapterOptions::default()))?;
        let descriptor =
            DeviceDescriptor { required_features: Features::empty(), required_limits: Limits::default(), ..DeviceDescriptor::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))?;
        let errors = Arc::new(Mutex::new(Vec::new()));
        let report = Arc::clone(&errors);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            report.lock().unwrap_or_else(PoisonError::into_inner).push(error.to_string());
        }));
        let texture = |format, sample_count, usage| {
            device.create_texture(&TextureDescriptor {
                label: Some("host"),
                size: Extent3d { width: size.0, height: size.1, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: TextureDimension::D2,
                format,
                usage: TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let view = |texture: &Texture| texture.create_view(&TextureViewDescriptor::default());
        let resolved = texture(COLOUR, 1, TextureUsages::COPY_SRC);
        let colour = if samples > 1 { view(&texture(COLOUR, samples, TextureUsages::empty())) } else { view(&resolved) };
        let depth = view(&texture(DEPTH, samples, TextureUsages::TEXTURE_BINDING));
        Ok(Self { size, samples, depth, colour, resolved, errors, device, queue })
    }

    pub fn encoder(&self) -> CommandEncoder {
        self.device.create_command_encoder(&CommandEncoderDescriptor::default())
    }

    /// A pass on the canvas: the first clears, the last resolves.
    pub fn pass<'e>(&self, encoder: &'e mut CommandEncoder, first: bool, last: bool) -> RenderPass<'e> {
        let sky = Color { r: 0.30, g: 0.38, b: 0.48, a: 1.0 };
        encoder.begin_render_pass(&RenderPassDescriptor {
            label: Some("host"),
            color_attachments: &[Some(RenderPassColorAttachment {
                view: &self.colour,
                depth_slice: None,
                resolve_target: (last && self.samples > 1).then(|| self.resolved.create_view(&TextureViewDescriptor::default())).as_ref(),
                ops: Operations { load: if first { LoadOp::Clear(sky) } else { LoadOp::Load }, store: StoreOp::Store },
            })],
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(Operations { load: if first { LoadOp::Clear(1.0) } else { LoadOp::Load }, store: StoreOp::Store }),
                stencil_ops: None,
            }),
            ..RenderPassDescriptor::default()
        })
    }

    /// Submits, and waits until the frame is done.
    pub fn finish(&self, encoder: CommandEncoder) -> Result<(), Box<dyn Error>> {
        self.queue.submit([encoder.finish()]);
        self.device.poll(PollType::wait_indefinitely())?;
        match self.errors.lock().unwrap_or_else(PoisonError::into_inner).first() {
            Some(error) => Err(error.clone().into()),
            None => Ok(()),
        }
    }

    /// The canvas, four bytes a pixel; its width must be a multiple of 64.
    pub fn pixels(&self) -> Result<Vec<u8>, Box<dyn Error>> {
        let (width, height) = self.size;
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("pixels"),
            size: u64::from(4 * width * height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.encoder();
        let layout = TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        let size = Extent3d { width, height, depth_or_array_layers: 1 };
        encoder.copy_texture_to_buffer(self.resolved.as_image_copy(), TexelCopyBufferInfo { buffer: &buffer, layout }, size);
        self.finish(encoder)?;
        buffer.slice(..).map_async(MapMode::Read, |_| ());
        self.device.poll(PollType::wait_indefinitely())?;
        let pixels = buffer.slice(..).get_mapped_range()?;
        Ok(pixels.to_vec())
    }

    /// Writes the canvas as a PNG.
    pub fn save(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        Ok(image::save_buffer(path, &self.pixels()?, self.size.0, self.size.1, image::ExtendedColorType::Rgba8)?)
    }
}
