//! Bytes from the device back to the processor.

use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoder, Device, Extent3d, MapMode, PollType, TexelCopyBufferInfo,
    TexelCopyBufferLayout, Texture,
};

use crate::RenderError;

/// A buffer that the processor can read.
pub(crate) fn readable(device: &Device, size: u64) -> Buffer {
    device.create_buffer(&BufferDescriptor {
        label: Some("read back"),
        size,
        usage: BufferUsages::MAP_READ | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Bytes from one row of a copied RGBA8 texture to the next.
pub(crate) fn row_stride(width: u32) -> u32 {
    (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

/// Records the copy of an RGBA8 texture into a buffer.
pub(crate) fn copy_pixels(encoder: &mut CommandEncoder, texture: &Texture, buffer: &Buffer) {
    let layout = TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row_stride(texture.width())), rows_per_image: None };
    let size = Extent3d { width: texture.width(), height: texture.height(), depth_or_array_layers: 1 };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), TexelCopyBufferInfo { buffer, layout }, size);
}

/// Waits for the device and gives the buffer's bytes to `read`.
pub(crate) fn read<T>(device: &Device, buffer: &Buffer, read: impl FnOnce(&[u8]) -> T) -> Result<T, RenderError> {
    // The answer arrives through poll, which says itself when the device is gone.
    buffer.slice(..).map_async(MapMode::Read, |_| ());
    wait(device)?;
    let view = buffer.slice(..).get_mapped_range().map_err(|error| RenderError::Lost(error.to_string()))?;
    let result = read(&view);
    drop(view);
    buffer.unmap();
    Ok(result)
}

/// Waits until the device has done everything.
pub(crate) fn wait(device: &Device) -> Result<(), RenderError> {
    device.poll(PollType::wait_indefinitely()).map(|_| ()).map_err(|error| RenderError::Lost(error.to_string()))
}
