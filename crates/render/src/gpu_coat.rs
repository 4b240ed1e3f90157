//! A coat on the device.

use std::sync::Arc;

use glam::Vec3;
use pelage_coat::Coat;
use wgpu::{BindGroup, BindGroupLayout, BindingResource, Buffer, BufferUsages, Device, Queue};

use crate::bindings::bind;
use crate::buffers::array;
use crate::furred_faces::{FurredFaces, Run};
use crate::pipelines::CoatTraits;
use crate::{GpuTextures, pack};

/// A coat's arrays and textures on the device, made by [`crate::Renderer::upload`]. A clone is the same coat: what is written to the one is written to the other.
#[derive(Clone, Debug)]
pub struct GpuCoat {
    pub(crate) bind_group: BindGroup,
    pub(crate) skin: Buffer,
    pub(crate) fur: Buffer,
    pub(crate) looks: Buffer,
    pub(crate) edges: Buffer,
    pub(crate) tiles: Buffer,
    /// How opaque each patch vertex is, where patches overlap.
    pub(crate) opacities: Option<Buffer>,
    /// Every face, and those with fur alone.
    pub(crate) faces: Buffer,
    pub(crate) furred_faces: Buffer,
    /// The run of each furred face.
    pub(crate) run_of: Buffer,
    pub(crate) runs: Arc<[Run]>,
    pub(crate) corner_count: u32,
    pub(crate) edge_count: u32,
    pub(crate) traits: CoatTraits,
    /// The longest and the shortest hair, in diameters.
    pub(crate) length: f32,
    pub(crate) shortest: f32,
    /// The ball around skin and fur: centre and radius.
    pub(crate) ball: (Vec3, f32),
    /// The patch of each patch vertex, to count by.
    pub(crate) patch_of: Arc<[u32]>,
    pub(crate) patch_count: u32,
    pub(crate) textures: GpuTextures,
}

impl GpuCoat {
    /// Uploads a coat that has passed its own check and the device's limits.
    pub(crate) fn new(device: &Device, queue: &Queue, layout: &BindGroupLayout, coat: &Coat, textures: GpuTextures) -> Self {
        let storage = BufferUsages::STORAGE;
        let skin = array(device, queue, "skin", storage, &pack::skin(&coat.surface));
        let fur = array(device, queue, "fur", storage, &pack::fur(&coat.surface));
        let looks = array(device, queue, "looks", storage, &pack::looks(&coat.surface));
        let edges = array(device, queue, "edges", storage, &pack::edges(&coat.edges));
        let mut resources = [&skin, &fur, &looks, &edges].map(Buffer::as_entire_binding).to_vec();
        resources.push(BindingResource::TextureView(&textures.fin));
        let bind_group = bind(device, "coat", layout, resources);
        let furred = FurredFaces::of(coat);
        let tiles = pack::tiles(&coat.surface, &coat.patches);
        Self {
            bind_group,
            tiles: array(device, queue, "patch vertices", BufferUsages::VERTEX | storage, &tiles),
            opacities: (!coat.patches.opacities.is_empty())
                .then(|| array(device, queue, "opacities", BufferUsages::VERTEX, &coat.patches.opacities)),
            faces: array(device, queue, "faces", BufferUsages::INDEX, &coat.patches.faces),
            furred_faces: array(device, queue, "furred faces", BufferUsages::INDEX | BufferUsages::COPY_SRC | storage, &furred.faces),
            run_of: array(device, queue, "runs", storage, &furred.run_of),
            runs: furred.runs.into(),
            corner_count: 3 * coat.patches.faces.len() as u32,
            edge_count: if textures.has_fin { coat.edges.vertices.len() as u32 } else { 0 },
            traits: CoatTraits {
                bent: coat.surface.bends.iter().any(|&bend| bend != Vec3::ZERO),
                cut: coat.surface.ends.iter().any(|&end| end < 1.0),
                direction_map: textures.has_directions,
                mixed: textures.mixtures.count > 1,
                lapped: !coat.patches.opacities.is_empty(),
            },
            length: coat.surface.offsets.iter().map(|offset| offset.length()).fold(0.0, f32::max),
            shortest: coat.surface.offsets.iter().map(|offset| offset.length()).fold(f32::INFINITY, f32::min),
            ball: ball(coat),
            patch_of: patch_of(coat).into(),
            patch_count: coat.patches.patch_ends.len() as u32,
            skin,
            fur,
            looks,
            edges,
            textures,
        }
    }

    /// Its textures, to share with other coats.
    pub fn textures(&self) -> &GpuTextures {
        &self.textures
    }

    /// How many shells its finest level of detail has, the skin included.
    pub fn layers(&self) -> u32 {
        self.textures.levels.first().map_or(0, Vec::len) as u32
    }

    /// How many faces have fur.
    pub fn furred_face_count(&self) -> u32 {
        self.runs.last().map_or(0, |run| run.faces)
    }
}

fn ball(coat: &Coat) -> (Vec3, f32) {
    let (low, high) = coat.bounds();
    (0.5 * (low + high), 0.5 * (high - low).length())
}

fn patch_of(coat: &Coat) -> Vec<u32> {
    let mut patch_of = vec![0; coat.patches.vertices.len()];
    let mut first = 0;
    for (patch, &end) in coat.patches.patch_ends.iter().enumerate() {
        for &corner in coat.patches.faces[first..end as usize].iter().flatten() {
            patch_of[corner as usize] = patch as u32;
        }
        first = end as usize;
    }
    patch_of
}
