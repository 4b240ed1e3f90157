//! What all views of a renderer share: pipelines, samplers, and what stands in where something is not asked for.

use std::sync::OnceLock;

use wgpu::{AddressMode, CompareFunction, Device, FilterMode, MipmapFilterMode, Queue, Sampler, SamplerDescriptor, TextureView};

use crate::Target;
use crate::pipelines::Pipelines;
use crate::pyramid::PyramidBuilder;
use crate::selection::Selectors;
use crate::shadow::{CasterCache, ShadowTargets};
use crate::textures::no_table;

/// What all views share.
#[derive(Debug)]
pub(crate) struct Shared {
    pub(crate) pipelines: Pipelines,
    pub(crate) selectors: Selectors,
    target: Target,
    pyramids: OnceLock<PyramidBuilder>,
    pub(crate) casters: CasterCache,
    /// Bound where no shadows are asked for.
    pub(crate) no_shadow: ShadowTargets,
    pub(crate) shadow_sampler: Sampler,
    /// Bound where no table is asked for.
    pub(crate) no_table: TextureView,
    pub(crate) table_sampler: Sampler,
}

impl Shared {
    pub(crate) fn new(device: &Device, queue: &Queue, target: Target) -> Self {
        Self {
            pipelines: Pipelines::new(device, target),
            selectors: Selectors::new(device, target),
            target,
            pyramids: OnceLock::new(),
            casters: CasterCache::default(),
            no_shadow: ShadowTargets::new(device, 1),
            shadow_sampler: device.create_sampler(&SamplerDescriptor {
                label: Some("shadow"),
                mag_filter: FilterMode::Linear,
                min_filter: FilterMode::Linear,
                compare: Some(CompareFunction::LessEqual),
                ..SamplerDescriptor::default()
            }),
            no_table: no_table(device, queue),
            table_sampler: sampler(device, "table", AddressMode::ClampToEdge, AddressMode::ClampToEdge, 1),
        }
    }

    /// What makes pyramids, once somebody asks what hides faces.
    pub(crate) fn pyramids(&self, device: &Device) -> &PyramidBuilder {
        self.pyramids.get_or_init(|| PyramidBuilder::new(device, self.target))
    }

    /// For the tile and for the fin, which is toroidal along the skin, not from tips to roots.
    pub(crate) fn hair_samplers(&self, device: &Device, anisotropy: u16) -> [Sampler; 2] {
        [
            sampler(device, "tile", AddressMode::Repeat, AddressMode::Repeat, anisotropy),
            sampler(device, "fin", AddressMode::Repeat, AddressMode::ClampToEdge, anisotropy),
        ]
    }
}

fn sampler(device: &Device, label: &str, u: AddressMode, v: AddressMode, anisotropy: u16) -> Sampler {
    device.create_sampler(&SamplerDescriptor {
        label: Some(label),
        address_mode_u: u,
        address_mode_v: v,
        mag_filter: FilterMode::Linear,
        min_filter: FilterMode::Linear,
        mipmap_filter: MipmapFilterMode::Linear,
        anisotropy_clamp: anisotropy,
        ..SamplerDescriptor::default()
    })
}
