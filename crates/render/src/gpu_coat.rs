//! A coat on the device.

use bytemuck::Pod;
use pelage_coat::Coat;
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindingResource, Buffer, BufferDescriptor, BufferUsages, Device, Queue,
};

use crate::{FinEdge, GpuTextures, fin_edges, pack};

/// A coat's arrays and textures on the device, made by [`crate::Renderer::upload`].
#[derive(Debug)]
pub struct GpuCoat {
    pub(crate) bind_group: BindGroup,
    pub(crate) tiles: Buffer,
    /// Every face, and those with fur alone.
    pub(crate) faces: Buffer,
    pub(crate) furred_faces: Buffer,
    pub(crate) corner_count: u32,
    pub(crate) furred_corner_count: u32,
    pub(crate) edge_count: u32,
    /// To count by.
    pub(crate) fin_edges: Vec<FinEdge>,
    textures: GpuTextures,
}

impl GpuCoat {
    /// Uploads a coat that has passed its own check and the device's limits.
    pub(crate) fn new(device: &Device, queue: &Queue, layout: &BindGroupLayout, coat: &Coat, textures: GpuTextures) -> Self {
        let storage = |label, bytes: &[u8]| buffer(device, queue, label, BufferUsages::STORAGE, bytes);
        let skin = storage("skin", bytemuck::cast_slice(&pack::skin(&coat.surface)));
        let fur = storage("fur", bytemuck::cast_slice(&pack::fur(&coat.surface)));
        let colours = storage("colours", bytemuck::cast_slice(&pack::colours(&coat.surface)));
        let edges = storage("edges", bytemuck::cast_slice(&pack::edges(&coat.edges)));
        let buffers = [&skin, &fur, &colours, &edges].map(Buffer::as_entire_binding);
        let views = [&textures.shells, &textures.fin].map(BindingResource::TextureView);
        let entries: Vec<BindGroupEntry<'_>> =
            buffers.into_iter().chain(views).zip(0..).map(|(resource, binding)| BindGroupEntry { binding, resource }).collect();
        let bind_group = device.create_bind_group(&BindGroupDescriptor { label: Some("coat"), layout, entries: &entries });
        let furred = pack::furred_faces(coat);
        Self {
            bind_group,
            tiles: array(device, queue, "patch vertices", BufferUsages::VERTEX, &pack::tiles(&coat.patches)),
            faces: array(device, queue, "faces", BufferUsages::INDEX, &coat.patches.faces),
            furred_faces: array(device, queue, "furred faces", BufferUsages::INDEX, &furred),
            corner_count: 3 * coat.patches.faces.len() as u32,
            furred_corner_count: 3 * furred.len() as u32,
            edge_count: if textures.has_fin { coat.edges.vertices.len() as u32 } else { 0 },
            fin_edges: if textures.has_fin { fin_edges(coat) } else { Vec::new() },
            textures,
        }
    }

    /// Its textures, to share with other coats.
    pub fn textures(&self) -> &GpuTextures {
        &self.textures
    }

    /// How many layers its stack has, the skin included.
    pub fn layers(&self) -> u32 {
        self.textures.layers
    }
}

fn array<T: Pod>(device: &Device, queue: &Queue, label: &str, usage: BufferUsages, items: &[T]) -> Buffer {
    buffer(device, queue, label, usage, bytemuck::cast_slice(items))
}

/// A buffer with these bytes; empty ones get a few, as nothing cannot be bound.
fn buffer(device: &Device, queue: &Queue, label: &str, usage: BufferUsages, bytes: &[u8]) -> Buffer {
    let size = (bytes.len() as u64).next_multiple_of(4).max(16);
    let buffer = device.create_buffer(&BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    if !bytes.is_empty() {
        queue.write_buffer(&buffer, 0, bytes);
    }
    buffer
}
