//! A view of a coat on the device.

use std::ops::Range;

use pelage_lighting::{HairLighting, LightingTable, TableLayout};
use wgpu::{
    BindGroup, Buffer, CommandEncoder, ComputePass, ComputePassDescriptor, Device, IndexFormat, Queue, RenderPass, RenderPipeline,
    TextureView,
};

use crate::blend::BlendedStack;
use crate::frame_groups::{FrameBuffers, FrameGroups, GroupParts};
use crate::furred_faces::last_run;
use crate::pipelines::{PassPipelines, Variant};
use crate::pyramid::Pyramid;
use crate::renderer::Shared;
use crate::schedule::Schedule;
use crate::selection::{Kind, Selection};
use crate::shadow::{Casters, LightView, ShadowMap};
use crate::textures::upload_table;
use crate::uniforms::{FrameUniform, GROWTH_LENGTH, MOST_SEGMENTS};
use crate::{DepthBuffer, GpuCoat, LightingMode, RenderError, View, Viewpoint};

/// A view of a coat, ready to be drawn, and to be moved to where the next frame is seen from.
#[derive(Debug)]
pub struct PreparedView {
    buffers: FrameBuffers,
    groups: FrameGroups,
    /// What the bindings were made for.
    made_for: Resources,
    blended: Option<BlendedStack>,
    /// Where a crowd stands.
    places: Option<Buffer>,
    shadows: Option<ShadowMap>,
    light: LightView,
    pub(crate) fins: Selection,
    pub(crate) faces: Selection,
    hidden: Option<Hidden>,
    pipelines: PassPipelines,
    casters: Option<Casters>,
    pub(crate) schedule: Schedule,
    /// For each run of faces, which of the drawn shells are drawn up to it.
    pub(crate) draws: Vec<Range<u32>>,
    pub(crate) shown: Shown,
}

/// What hides faces: the squares of the last depth buffer that was asked about.
#[derive(Debug)]
struct Hidden {
    depth: TextureView,
    size: (u32, u32),
    pyramid: Pyramid,
    scene: BindGroup,
}

/// What the bindings of a view depend on, beside its coat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Resources {
    table: Option<(HairLighting, TableLayout)>,
    anisotropy: u16,
    shadow_side: Option<u32>,
    /// The finest mip of blended levels; once there, they stay.
    blended: Option<u32>,
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

impl PreparedView {
    pub(crate) fn new(
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        coat: &GpuCoat,
        view: &View,
        viewpoint: &Viewpoint,
        places: Option<&Buffer>,
    ) -> Result<Self, RenderError> {
        let buffers = FrameBuffers::new(device);
        let fins = Selection::new(device, queue, &shared.selectors, Kind::Fins, &buffers.frame, coat);
        let parts = GroupParts { factors: &shared.no_table, anisotropy: 1, blended: None, shadows: None };
        let mut prepared = Self {
            groups: FrameGroups::new(device, shared, coat, &buffers, places.unwrap_or(&fins.survivors), &parts),
            made_for: Resources { anisotropy: 1, ..Resources::default() },
            blended: None,
            places: places.cloned(),
            shadows: None,
            light: LightView::new(coat, view),
            faces: Selection::new(device, queue, &shared.selectors, Kind::Faces, &buffers.frame, coat),
            pipelines: shared.pipelines.get(device, variant(coat, view, false, places.is_some())),
            casters: None,
            hidden: None,
            schedule: Schedule::default(),
            draws: Vec::new(),
            shown: Shown::default(),
            buffers,
            fins,
        };
        prepared.update(device, queue, shared, coat, view, viewpoint)?;
        Ok(prepared)
    }

    /// Moves to another view.
    pub(crate) fn update(
        &mut self,
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        coat: &GpuCoat,
        view: &View,
        viewpoint: &Viewpoint,
    ) -> Result<(), RenderError> {
        let schedule = Schedule::new(&coat.textures.levels, &view.options, viewpoint, coat.length * view.options.length_scale);
        let light = LightView::new(coat, view);
        let uniform = FrameUniform::new(view, viewpoint, &schedule, &light)?;
        let resources = Resources {
            table: table_of(view),
            anisotropy: view.options.anisotropy.clamp(1, 16),
            shadow_side: shadow_side(device, view)?,
            blended: if schedule.slots.is_empty() { self.made_for.blended } else { Some(finest_mip(coat, view, viewpoint)) },
        };
        let same_shadows =
            self.made_for.shadow_side == resources.shadow_side && self.light == light && self.schedule.shells == schedule.shells;
        if self.made_for != resources {
            self.make(device, queue, shared, coat, view, resources)?;
        }
        self.pipelines = shared.pipelines.get(device, variant(coat, view, schedule.is_shared(), self.places.is_some()));
        (self.schedule, self.light) = (schedule, light);
        self.write(queue, coat, view, &uniform);
        if let Some(shadows) = self.shadows.as_mut().filter(|_| !same_shadows) {
            shadows.set(queue, &self.schedule);
        }
        Ok(())
    }

    /// Makes what the view needs and has not got.
    fn make(
        &mut self,
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        coat: &GpuCoat,
        view: &View,
        resources: Resources,
    ) -> Result<(), RenderError> {
        let factors = match view.options.lighting {
            LightingMode::Table(layout) => upload_table(device, queue, &LightingTable::new(&view.shading.hair, layout)?),
            LightingMode::PerPatch | LightingMode::PerVertex | LightingMode::Formula => shared.no_table.clone(),
        };
        if self.made_for.shadow_side != resources.shadow_side {
            self.shadows = resources.shadow_side.map(|side| ShadowMap::new(device, side));
            self.casters = self.shadows.as_ref().map(|_| shared.casters.get(device, &shared.pipelines, coat.traits));
        }
        if resources.blended.is_some() && self.blended.is_none() {
            self.blended = Some(BlendedStack::new(device, &shared.blender, &coat.textures));
        }
        let blended_view = self.blended.as_ref().map(|blended| blended.view(resources.blended.unwrap_or(0)));
        let parts = GroupParts {
            factors: &factors,
            anisotropy: resources.anisotropy,
            blended: blended_view.as_ref(),
            shadows: self.shadows.as_ref().map(|shadows| &shadows.targets),
        };
        let second = self.places.as_ref().unwrap_or(&self.fins.survivors);
        self.groups = FrameGroups::new(device, shared, coat, &self.buffers, second, &parts);
        self.made_for = resources;
        Ok(())
    }

    /// Writes what the schedule and the options say to where the device reads it.
    fn write(&mut self, queue: &Queue, coat: &GpuCoat, view: &View, uniform: &FrameUniform) {
        let options = &view.options;
        // Without length there is no fur to draw: the bald picture, exactly.
        let furry = options.length_scale > 0.0 && coat.furred_face_count() > 0;
        self.shown = Shown {
            surface: options.surface && coat.corner_count > 0,
            fins: options.fins && furry && coat.edge_count > 0 && self.schedule.fins > 0.0,
            shells: options.shells && furry && !self.schedule.drawn.is_empty(),
            culling: options.culling,
            fin_segments: options.fin_segments.clamp(1, MOST_SEGMENTS),
        };
        queue.write_buffer(&self.buffers.frame, 0, bytemuck::bytes_of(uniform));
        queue.write_buffer(&self.buffers.shells, 0, bytemuck::cast_slice(&self.schedule.shells));
        queue.write_buffer(&self.buffers.drawn, 0, bytemuck::cast_slice(&self.schedule.drawn));
        if let Some(blended) = self.blended.as_ref().filter(|_| self.is_blended()) {
            blended.set(queue, &self.schedule.slots);
        }
        queue.write_buffer(&self.fins.draws, 0, bytemuck::cast_slice(&[2 * (self.shown.fin_segments + 1), 0, 0, 0]));
        self.draws = draws(&self.schedule, coat);
        let arguments: Vec<[u32; 5]> = self.draws.iter().map(|range| [0, range.end - range.start, 0, 0, 0]).collect();
        queue.write_buffer(&self.faces.draws, 0, bytemuck::cast_slice(&arguments));
    }

    /// Records what is computed ahead of the drawing.
    pub(crate) fn record(&self, pass: &mut ComputePass<'_>, shared: &Shared) {
        if self.shown.fins {
            self.fins.record(pass, &shared.selectors);
        }
        if self.shown.shells && self.shown.culling {
            self.faces.record(pass, &shared.selectors);
        }
        if let Some(blended) = self.blended.as_ref().filter(|_| self.is_blended()) {
            blended.record(pass, &shared.blender, self.made_for.blended.unwrap_or(0), self.schedule.slots.len() as u32);
        }
    }

    /// Records the picking of faces anew, by what hides them.
    pub(crate) fn record_hidden(
        &mut self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        shared: &Shared,
        coat: &GpuCoat,
        depth: DepthBuffer<'_>,
    ) {
        let DepthBuffer { view, size } = depth;
        if !(self.shown.shells && self.shown.culling) || size.0 == 0 || size.1 == 0 {
            return;
        }
        if self.hidden.as_ref().is_none_or(|hidden| (&hidden.depth, hidden.size) != (view, size)) {
            let pyramid = Pyramid::new(device, queue, &shared.pyramids, view, size);
            let scene = Selection::scene_before(device, &shared.selectors, &self.buffers.frame, coat, &pyramid.furthest);
            self.hidden = Some(Hidden { depth: view.clone(), size, pyramid, scene });
        }
        if let Some(hidden) = &self.hidden {
            let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor { label: Some("hidden faces"), timestamp_writes: None });
            hidden.pyramid.record(&mut pass, &shared.pyramids);
            self.faces.record_unhidden(&mut pass, &shared.selectors, &hidden.scene);
        }
    }

    /// Records the shadow map, where it is stale.
    pub(crate) fn record_shadows(&self, encoder: &mut CommandEncoder, coat: &GpuCoat) {
        let (Some(shadows), Some(casters)) = (&self.shadows, &self.casters) else { return };
        // Fur without length casts nothing.
        let furry = coat.furred_face_count() > 0 && self.light.length > 0.0;
        shadows.record(encoder, casters, self.groups.casting(self.is_blended()), coat, furry);
    }

    /// Whether the next frame draws the shadow map anew: the light, the fur's length or the shells have changed, or it was asked for.
    pub fn shadows_are_stale(&self) -> bool {
        self.shadows.as_ref().is_some_and(ShadowMap::is_stale)
    }

    /// Has the shadow map drawn anew with the next frame: for a coat whose arrays have changed on the device, or to measure what it costs.
    pub fn redraw_shadows(&self) {
        if let Some(shadows) = &self.shadows {
            shadows.redraw();
        }
    }

    pub(crate) fn draw_surface(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat) {
        if !self.shown.surface {
            return;
        }
        self.begin(pass, coat, &self.pipelines.surface);
        pass.set_vertex_buffer(0, coat.tiles.slice(..));
        pass.set_index_buffer(coat.faces.slice(..), IndexFormat::Uint32);
        pass.draw_indexed(0..coat.corner_count, 0, 0..1);
    }

    pub(crate) fn draw_fins(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat) {
        let Some(pipeline) = self.pipelines.fins.as_ref().filter(|_| self.shown.fins) else { return };
        self.begin(pass, coat, pipeline);
        pass.draw_indirect(&self.fins.draws, 0);
    }

    pub(crate) fn draw_shells(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat) {
        if !self.shown.shells {
            return;
        }
        self.begin(pass, coat, &self.pipelines.shells);
        pass.set_vertex_buffer(0, coat.tiles.slice(..));
        let faces = if self.shown.culling { &self.faces.survivors } else { &coat.furred_faces };
        pass.set_index_buffer(faces.slice(..), IndexFormat::Uint32);
        // The later the run, the lower its hair is cut: innermost shells first.
        for (run, range) in self.draws.iter().enumerate().rev().filter(|(_, range)| range.start < range.end) {
            pass.set_vertex_buffer(1, self.buffers.drawn.slice(4 * u64::from(range.start)..));
            if self.shown.culling {
                pass.draw_indexed_indirect(&self.faces.draws, 20 * run as u64);
            } else {
                pass.draw_indexed(0..3 * coat.runs[run].faces, 0, 0..range.end - range.start);
            }
        }
    }

    /// The skin at the places of a crowd that `words` name.
    pub(crate) fn draw_crowd_surface(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat, words: &Buffer, range: Range<u32>) {
        self.begin(pass, coat, &self.pipelines.surface);
        pass.set_vertex_buffer(0, coat.tiles.slice(..));
        pass.set_vertex_buffer(1, words.slice(..));
        pass.set_index_buffer(coat.faces.slice(..), IndexFormat::Uint32);
        pass.draw_indexed(0..coat.corner_count, 0, range);
    }

    /// The shells that `words` name, place by place.
    pub(crate) fn draw_crowd_shells(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat, words: &Buffer, range: Range<u32>) {
        self.begin(pass, coat, &self.pipelines.shells);
        pass.set_vertex_buffer(0, coat.tiles.slice(..));
        pass.set_vertex_buffer(1, words.slice(..));
        pass.set_index_buffer(coat.furred_faces.slice(..), IndexFormat::Uint32);
        pass.draw_indexed(0..3 * coat.furred_face_count(), 0, range);
    }

    fn begin(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat, pipeline: &RenderPipeline) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, self.groups.drawing(self.is_blended()), &[]);
        pass.set_bind_group(1, &coat.bind_group, &[]);
    }

    /// Whether the shells show images that are blended for this view.
    fn is_blended(&self) -> bool {
        !self.schedule.slots.is_empty()
    }

    /// How many layers are drawn as shells; the skin is not among them.
    pub fn shell_count(&self) -> u32 {
        if self.shown.shells { self.schedule.drawn.len() as u32 } else { 0 }
    }

    /// The level of detail: 0 is the finest, each has half the shells of the one before; a fraction blends.
    pub fn level(&self) -> f32 {
        self.schedule.level
    }

    /// How many edges are looked at for fins.
    pub fn fins_considered(&self, coat: &GpuCoat) -> u32 {
        if self.shown.fins { coat.edge_count } else { 0 }
    }
}

/// For each run of faces, the drawn shells that show hair up to its end, as a range of the schedule's list.
fn draws(schedule: &Schedule, coat: &GpuCoat) -> Vec<Range<u32>> {
    let spacing = 1.0 / schedule.layers_per_height;
    let mut draws = vec![0..0; coat.runs.len()];
    for (place, &shell) in (0..).zip(&schedule.drawn) {
        let Some(run) = last_run(&coat.runs, schedule.lowest_shown(shell), spacing) else { continue };
        let range = &mut draws[run];
        *range = if range.end == 0 { place..place + 1 } else { range.start..place + 1 };
    }
    draws
}

/// What the shaders are compiled for.
fn variant(coat: &GpuCoat, view: &View, shared: bool, crowd: bool) -> Variant {
    let grown = coat.shortest * view.options.length_scale >= GROWTH_LENGTH;
    let variant = Variant::new(view, coat.traits, shared, grown);
    if crowd { variant.instanced() } else { variant }
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
