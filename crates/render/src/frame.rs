//! What a coat is drawn with at one viewpoint.

use std::ops::Range;

use wgpu::{Buffer, CommandEncoder, Device, IndexFormat, Queue, RenderPass, RenderPipeline};

use crate::frame_groups::FrameBuffers;
use crate::pipelines::{PassPipelines, Variant};
use crate::resources::{Maker, Needs, Resources};
use crate::schedule::Schedule;
use crate::shadow::{Casters, Casting, LightView};
use crate::shared::Shared;
use crate::uniforms::{FrameUniform, GROWTH_LENGTH, MOST_SEGMENTS};
use crate::{GpuCoat, RenderError, View, Viewpoint};

/// What a coat is drawn with at one viewpoint, and then at others.
#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) coat: GpuCoat,
    pub(crate) buffers: FrameBuffers,
    pub(crate) resources: Resources,
    pub(crate) pipelines: PassPipelines,
    /// Those of the shadow map, where there is one.
    casters: Option<Casters>,
    /// What the shaders read beside the coat: the fins that were picked, or the places of a crowd.
    second: Buffer,
    crowd: bool,
    light: LightView,
    pub(crate) schedule: Schedule,
    pub(crate) shown: Shown,
}

/// Which passes there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Shown {
    pub(crate) surface: bool,
    pub(crate) fins: bool,
    pub(crate) shells: bool,
    pub(crate) culling: bool,
    pub(crate) fin_segments: u32,
}

impl Shown {
    fn new(coat: &GpuCoat, view: &View, schedule: &Schedule) -> Self {
        let options = &view.options;
        // Without length there is no fur to draw: the bald picture, exactly.
        let furry = options.length_scale > 0.0 && coat.furred_face_count() > 0;
        Self {
            surface: options.surface && coat.corner_count > 0,
            fins: options.fins && furry && coat.edge_count > 0 && schedule.fins > 0.0,
            shells: options.shells && furry && !schedule.drawn.is_empty(),
            culling: options.culling,
            fin_segments: options.fin_segments.clamp(1, MOST_SEGMENTS),
        }
    }
}

/// What a view comes to at a viewpoint, before anything is made or written.
struct Moment {
    schedule: Schedule,
    light: LightView,
    uniform: FrameUniform,
    needs: Needs,
    shown: Shown,
}

impl Moment {
    fn new(device: &Device, coat: &GpuCoat, view: &View, viewpoint: &Viewpoint) -> Result<Self, RenderError> {
        let schedule = Schedule::new(&coat.textures.levels, &view.options, viewpoint, coat.length * view.options.length_scale);
        let light = LightView::new(coat, view);
        Ok(Self {
            uniform: FrameUniform::new(view, viewpoint, &schedule, &light, coat.textures.mixtures)?,
            needs: Needs::new(device, view)?,
            shown: Shown::new(coat, view, &schedule),
            schedule,
            light,
        })
    }
}

impl Frame {
    pub(crate) fn new(
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        coat: &GpuCoat,
        (view, viewpoint): (&View, &Viewpoint),
        (buffers, second, crowd): (FrameBuffers, &Buffer, bool),
    ) -> Result<Self, RenderError> {
        let moment = Moment::new(device, coat, view, viewpoint)?;
        let maker = Maker { device, queue, shared, coat, buffers: &buffers, second };
        let mut frame = Self {
            resources: Resources::new(&maker, moment.needs)?,
            pipelines: shared.pipelines.get(device, variant(coat, view, &moment.schedule, crowd), moment.shown),
            casters: casters(device, shared, coat, view, &moment.schedule),
            coat: coat.clone(),
            second: second.clone(),
            crowd,
            light: moment.light,
            schedule: Schedule::default(),
            shown: Shown::default(),
            buffers,
        };
        frame.write(queue, moment, true);
        Ok(frame)
    }

    /// Moves to another view. What fails leaves it as it was.
    pub(crate) fn update(
        &mut self,
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        (view, viewpoint): (&View, &Viewpoint),
    ) -> Result<(), RenderError> {
        let moment = Moment::new(device, &self.coat, view, viewpoint)?;
        let maker = Maker { device, queue, shared, coat: &self.coat, buffers: &self.buffers, second: &self.second };
        let new_map = self.resources.meet(&maker, moment.needs)?;
        self.pipelines = shared.pipelines.get(device, variant(&self.coat, view, &moment.schedule, self.crowd), moment.shown);
        self.casters = casters(device, shared, &self.coat, view, &moment.schedule);
        self.write(queue, moment, new_map);
        Ok(())
    }

    /// Takes over what a moment says, and writes it to where the device reads it.
    fn write(&mut self, queue: &Queue, moment: Moment, new_map: bool) {
        let casts_alike =
            (&self.light, self.schedule.blend, &self.schedule.shells) == (&moment.light, moment.schedule.blend, &moment.schedule.shells);
        (self.schedule, self.light, self.shown) = (moment.schedule, moment.light, moment.shown);
        queue.write_buffer(&self.buffers.frame, 0, bytemuck::bytes_of(&moment.uniform));
        queue.write_buffer(&self.buffers.shells, 0, bytemuck::cast_slice(&self.schedule.shells));
        queue.write_buffer(&self.buffers.drawn, 0, bytemuck::cast_slice(&self.schedule.drawn));
        if let Some(shadows) = self.resources.shadows.as_mut().filter(|_| new_map || !casts_alike) {
            shadows.set(queue, &self.schedule);
        }
    }

    /// Records the shadow map, where it is stale.
    pub(crate) fn record_shadows(&self, encoder: &mut CommandEncoder) {
        let (Some(shadows), Some(casters)) = (&self.resources.shadows, &self.casters) else { return };
        // Fur without length casts nothing.
        let furry = self.coat.furred_face_count() > 0 && self.light.length > 0.0;
        shadows.record(encoder, casters, self.resources.groups.casting(), &self.coat, furry);
    }

    /// Begins the drawing of shells, or of the skin, whose vertices are patch vertices too.
    pub(crate) fn begin_tiles(&self, pass: &mut RenderPass<'_>, pipeline: &RenderPipeline) {
        self.begin(pass, pipeline);
        pass.set_vertex_buffer(0, self.coat.tiles.slice(..));
        if let Some(opacities) = &self.coat.opacities {
            pass.set_vertex_buffer(2, opacities.slice(..));
        }
    }

    pub(crate) fn begin(&self, pass: &mut RenderPass<'_>, pipeline: &RenderPipeline) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, self.resources.groups.drawing(), &[]);
        pass.set_bind_group(1, &self.coat.bind_group, &[]);
    }

    /// The skin, so many times, if it is shown; of a crowd after its words are set.
    pub(crate) fn draw_surface(&self, pass: &mut RenderPass<'_>, words: Option<&Buffer>, instances: Range<u32>) {
        let Some(pipeline) = &self.pipelines.surface else { return };
        self.begin_tiles(pass, pipeline);
        if let Some(words) = words {
            pass.set_vertex_buffer(1, words.slice(..));
        }
        pass.set_index_buffer(self.coat.faces.slice(..), IndexFormat::Uint32);
        pass.draw_indexed(0..self.coat.corner_count, 0, instances);
    }
}

/// What the shaders are compiled for.
fn variant(coat: &GpuCoat, view: &View, schedule: &Schedule, crowd: bool) -> Variant {
    let grown = coat.shortest * view.options.length_scale >= GROWTH_LENGTH;
    let variant = Variant::new(view, coat.traits, [schedule.is_thickened(), schedule.blend > 0.0, grown]);
    if crowd { variant.instanced() } else { variant }
}

fn casters(device: &Device, shared: &Shared, coat: &GpuCoat, view: &View, schedule: &Schedule) -> Option<Casters> {
    let traits = Casting {
        bent: coat.traits.bent,
        cut: coat.traits.cut,
        mixed: coat.traits.mixed,
        thickened: schedule.is_thickened(),
        levels: schedule.blend > 0.0,
    };
    view.options.shadows.map(|_| shared.casters.get(device, &shared.pipelines, traits))
}
