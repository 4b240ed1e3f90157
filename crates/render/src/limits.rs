//! What a device cannot hold is refused before it is asked.

use pelage_coat::{Coat, MipImage};
use wgpu::Limits;

use crate::RenderError;
use crate::schedule::MOST_SHELLS;
use crate::selection::GROUP;

/// Checks a coat against a device's limits.
pub(crate) fn check_coat(limits: &Limits, coat: &Coat) -> Result<(), RenderError> {
    let storage = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    let vertices = coat.surface.positions.len() as u64;
    at_most("bytes of vertices, so coarsen the mesh or draw it in parts", 16 * vertices, storage)?;
    at_most("bytes of edges for fins, so coarsen the mesh or draw it in parts", 48 * coat.edges.vertices.len() as u64, storage)?;
    // Compute shaders look at them in groups in a row.
    let items = u64::from(limits.max_compute_workgroups_per_dimension) * u64::from(GROUP);
    at_most("edges for fins, so coarsen the mesh or draw it in parts", coat.edges.vertices.len() as u64, items)?;
    at_most("faces, so coarsen the mesh or draw it in parts", coat.patches.faces.len() as u64, items)?;
    let patches = &coat.patches;
    let largest = (24 * patches.vertices.len() as u64).max(12 * patches.faces.len() as u64);
    at_most("bytes of patch vertices or faces, so coarsen the mesh or draw it in parts", largest, storage)?;
    // Index counts are 32 bits wide.
    at_most("corners of faces, so coarsen the mesh or draw it in parts", 3 * patches.faces.len() as u64, u64::from(u32::MAX))?;
    at_most("shells, so draw fewer", u64::from(coat.shells.layers()), MOST_SHELLS as u64)?;
    let images = u64::from(coat.shells.images);
    at_most("images of shells, so sample fewer layers, or leave levels of detail out", images, u64::from(limits.max_texture_array_layers))?;
    let fin = coat.fin.as_ref().map_or(&[][..], |fin| &fin.mips);
    coat.shells.mips.iter().chain(fin).try_for_each(|mip| check_image(limits, mip))
}

/// Checks a picture's size against a device's limits.
pub(crate) fn check_picture(limits: &Limits, (width, height): (u32, u32)) -> Result<(), RenderError> {
    let side = u64::from(limits.max_texture_dimension_2d);
    at_most("pixels along a side of the picture, so ask for a smaller one", u64::from(width.max(height)), side)?;
    let bytes = u64::from(width.next_multiple_of(64)) * 4 * u64::from(height);
    at_most("bytes of picture to read back, so ask for a smaller one", bytes, limits.max_buffer_size)
}

fn check_image(limits: &Limits, mip: &MipImage) -> Result<(), RenderError> {
    let side = u64::from(mip.width.max(mip.height));
    at_most("texels along a side of a hair texture, so sample it coarser", side, u64::from(limits.max_texture_dimension_2d))
}

fn at_most(what: &'static str, needed: u64, limit: u64) -> Result<(), RenderError> {
    if needed <= limit { Ok(()) } else { Err(RenderError::Limit { what, needed, limit }) }
}
