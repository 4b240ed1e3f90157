//! Buffers with something in them.

use bytemuck::Pod;
use wgpu::{Buffer, BufferDescriptor, BufferUsages, Device, Queue};

/// A buffer with these items.
pub(crate) fn array<T: Pod>(device: &Device, queue: &Queue, label: &str, usage: BufferUsages, items: &[T]) -> Buffer {
    let bytes: &[u8] = bytemuck::cast_slice(items);
    let buffer = room(device, label, usage, bytes.len() as u64);
    if !bytes.is_empty() {
        queue.write_buffer(&buffer, 0, bytes);
    }
    buffer
}

/// A buffer for so many bytes, to be filled later; nothing gets a few, as nothing cannot be bound.
pub(crate) fn room(device: &Device, label: &str, usage: BufferUsages, bytes: u64) -> Buffer {
    let size = bytes.next_multiple_of(4).max(16);
    device.create_buffer(&BufferDescriptor { label: Some(label), size, usage: usage | BufferUsages::COPY_DST, mapped_at_creation: false })
}
