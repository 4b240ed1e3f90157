//! What a view's bindings are made of, kept until the view needs other things.

use pelage_lighting::{HairLighting, LightingTable, TableLayout};
use wgpu::{Buffer, Device, Queue};

use crate::frame_groups::{FrameBuffers, FrameGroups, GroupParts};
use crate::shadow::ShadowMap;
use crate::shared::Shared;
use crate::textures::upload_table;
use crate::{GpuCoat, LightingMode, RenderError, View};

/// What the bindings of a view depend on, beside its coat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Needs {
    table: Option<(HairLighting, TableLayout)>,
    anisotropy: u16,
    shadow_side: Option<u32>,
}

impl Needs {
    pub(crate) fn new(device: &Device, view: &View) -> Result<Self, RenderError> {
        let (table, shadow_side) = (table_of(view), shadow_side(device, view)?);
        Ok(Self { table, anisotropy: view.options.anisotropy.clamp(1, 16), shadow_side })
    }
}

/// What it takes to make them.
pub(crate) struct Maker<'a> {
    pub(crate) device: &'a Device,
    pub(crate) queue: &'a Queue,
    pub(crate) shared: &'a Shared,
    pub(crate) coat: &'a GpuCoat,
    pub(crate) buffers: &'a FrameBuffers,
    /// Fins that were picked, or the places of a crowd.
    pub(crate) second: &'a Buffer,
}

/// The bindings, and what they bind.
#[derive(Debug)]
pub(crate) struct Resources {
    needs: Needs,
    pub(crate) groups: FrameGroups,
    pub(crate) shadows: Option<ShadowMap>,
}

impl Resources {
    pub(crate) fn new(maker: &Maker<'_>, needs: Needs) -> Result<Self, RenderError> {
        let shadows = shadows(maker, needs);
        Ok(Self { groups: groups(maker, needs, shadows.as_ref())?, needs, shadows })
    }

    /// Makes what a view needs now and did not before. Says whether the shadow map is a new one.
    pub(crate) fn meet(&mut self, maker: &Maker<'_>, needs: Needs) -> Result<bool, RenderError> {
        if self.needs == needs {
            return Ok(false);
        }
        let other_map = self.needs.shadow_side != needs.shadow_side;
        let new_map = if other_map { shadows(maker, needs) } else { None };
        let kept_map = self.shadows.as_ref().filter(|_| !other_map);
        let groups = groups(maker, needs, new_map.as_ref().or(kept_map))?;
        // From here on nothing fails.
        if other_map {
            self.shadows = new_map;
        }
        (self.groups, self.needs) = (groups, needs);
        Ok(other_map)
    }
}

fn shadows(maker: &Maker<'_>, needs: Needs) -> Option<ShadowMap> {
    needs.shadow_side.map(|side| ShadowMap::new(maker.device, side))
}

fn groups(maker: &Maker<'_>, needs: Needs, shadows: Option<&ShadowMap>) -> Result<FrameGroups, RenderError> {
    let factors = match &needs.table {
        Some((hair, layout)) => upload_table(maker.device, maker.queue, &LightingTable::new(hair, *layout)?),
        None => maker.shared.no_table.clone(),
    };
    let parts = GroupParts { factors: &factors, anisotropy: needs.anisotropy, shadows: shadows.map(|map| &map.targets) };
    Ok(FrameGroups::new(maker.device, maker.shared, maker.coat, maker.buffers, maker.second, &parts))
}

fn table_of(view: &View) -> Option<(HairLighting, TableLayout)> {
    match view.options.lighting {
        LightingMode::Table(layout) => Some((view.shading.hair, layout)),
        LightingMode::PerPatch | LightingMode::PerVertex | LightingMode::Formula => None,
    }
}

fn shadow_side(device: &Device, view: &View) -> Result<Option<u32>, RenderError> {
    let (most, side) = (device.limits().max_texture_dimension_2d, view.options.shadows.map(|shadows| shadows.side.max(16)));
    match side.filter(|&side| side > most) {
        Some(side) => Err(RenderError::Limit {
            what: "texels along a side of the shadow map, so ask for a smaller one",
            needed: side.into(),
            limit: most.into(),
        }),
        None => Ok(side),
    }
}
