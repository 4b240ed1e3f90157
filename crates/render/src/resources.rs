//! What a view's bindings are made of, kept until the view needs other things.

use pelage_lighting::{HairLighting, LightingTable, TableLayout};
use wgpu::{Buffer, Device, Queue};

use crate::blend::BlendedStack;
use crate::frame_groups::{FrameBuffers, FrameGroups, GroupParts};
use crate::renderer::Shared;
use crate::schedule::Schedule;
use crate::shadow::{Casters, ShadowMap};
use crate::textures::upload_table;
use crate::{GpuCoat, LightingMode, RenderError, View, Viewpoint};

/// What the bindings of a view depend on, beside its coat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Needs {
    table: Option<(HairLighting, TableLayout)>,
    anisotropy: u16,
    shadow_side: Option<u32>,
    /// The finest mip of blended levels.
    blended: Option<u32>,
}

impl Needs {
    pub(crate) fn new(
        device: &Device,
        coat: &GpuCoat,
        view: &View,
        viewpoint: &Viewpoint,
        schedule: &Schedule,
    ) -> Result<Self, RenderError> {
        Ok(Self {
            table: table_of(view),
            anisotropy: view.options.anisotropy.clamp(1, 16),
            shadow_side: shadow_side(device, view)?,
            blended: (!schedule.slots.is_empty()).then(|| finest_mip(coat, view, viewpoint)),
        })
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
    pub(crate) blended: Option<BlendedStack>,
    pub(crate) shadows: Option<(ShadowMap, Casters)>,
}

impl Resources {
    pub(crate) fn new(maker: &Maker<'_>, needs: Needs) -> Result<Self, RenderError> {
        let shadows = shadows(maker, needs);
        let blended = blended(maker, needs);
        Ok(Self { groups: groups(maker, needs, blended.as_ref(), shadows.as_ref())?, needs, blended, shadows })
    }

    /// Makes what a view needs now and did not before; what blended levels took stays. Says whether the shadow map is a new one.
    pub(crate) fn meet(&mut self, maker: &Maker<'_>, needs: Needs) -> Result<bool, RenderError> {
        let needs = Needs { blended: needs.blended.or(self.needs.blended), ..needs };
        if self.needs == needs {
            return Ok(false);
        }
        let other_map = self.needs.shadow_side != needs.shadow_side;
        let new_map = if other_map { shadows(maker, needs) } else { None };
        let new_stack = if self.blended.is_none() { blended(maker, needs) } else { None };
        let kept_map = self.shadows.as_ref().filter(|_| !other_map);
        let groups = groups(maker, needs, new_stack.as_ref().or(self.blended.as_ref()), new_map.as_ref().or(kept_map))?;
        // From here on nothing fails.
        if other_map {
            self.shadows = new_map;
        }
        if let Some(blended) = self.blended.as_mut().filter(|_| self.needs.blended != needs.blended) {
            blended.remake();
        }
        self.blended = new_stack.or_else(|| self.blended.take());
        (self.groups, self.needs) = (groups, needs);
        Ok(other_map)
    }

    /// The finest mip of blended levels that is made.
    pub(crate) fn finest_blended(&self) -> u32 {
        self.needs.blended.unwrap_or(0)
    }
}

fn shadows(maker: &Maker<'_>, needs: Needs) -> Option<(ShadowMap, Casters)> {
    let casters = |side| {
        let casters = maker.shared.casters.get(maker.device, &maker.shared.pipelines, maker.coat.traits);
        (ShadowMap::new(maker.device, side), casters)
    };
    needs.shadow_side.map(casters)
}

fn blended(maker: &Maker<'_>, needs: Needs) -> Option<BlendedStack> {
    needs.blended.map(|_| BlendedStack::new(maker.device, &maker.shared.blender, &maker.coat.textures))
}

fn groups(
    maker: &Maker<'_>,
    needs: Needs,
    blended: Option<&BlendedStack>,
    shadows: Option<&(ShadowMap, Casters)>,
) -> Result<FrameGroups, RenderError> {
    let factors = match &needs.table {
        Some((hair, layout)) => upload_table(maker.device, maker.queue, &LightingTable::new(hair, *layout)?),
        None => maker.shared.no_table.clone(),
    };
    let images = blended.map(|blended| blended.view(needs.blended.unwrap_or(0)));
    let parts = GroupParts {
        factors: &factors,
        anisotropy: needs.anisotropy,
        blended: images.as_ref(),
        shadows: shadows.map(|(map, _)| &map.targets),
    };
    Ok(FrameGroups::new(maker.device, maker.shared, maker.coat, maker.buffers, maker.second, &parts))
}

fn table_of(view: &View) -> Option<(HairLighting, TableLayout)> {
    match view.options.lighting {
        LightingMode::Table(layout) => Some((view.shading.hair, layout)),
        LightingMode::PerPatch | LightingMode::PerVertex | LightingMode::Formula => None,
    }
}

/// The finest mip that a view shows of a coat, with two and a half levels to spare: what the tiles take on the screen at the coat's centre says which that
/// is, and from afar all of the coat is about there.
fn finest_mip(coat: &GpuCoat, view: &View, viewpoint: &Viewpoint) -> u32 {
    let reach = coat.ball.1 + coat.length * view.options.length_scale.max(0.0);
    let distance = viewpoint.eye.distance(coat.ball.0);
    if distance < 4.0 * reach {
        return 0;
    }
    let texels = coat.textures.shells.width() as f32 / viewpoint.pixels_of(coat.tile_side).max(1e-6);
    ((texels.log2() - 2.5).max(0.0) as u32).min(coat.textures.shells.mip_level_count() - 1)
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
