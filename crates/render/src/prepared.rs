//! A view of a coat on the device.

use std::ops::Range;

use pelage_lighting::{HairLighting, LightingTable, TableLayout};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindingResource, Buffer, BufferUsages, Device, Queue, RenderPass, Sampler, TextureView,
};

use crate::blend::BlendedStack;
use crate::buffers::room;
use crate::furred_faces::last_run;
use crate::pipelines::{PassPipelines, Variant};
use crate::renderer::Shared;
use crate::schedule::{MOST_SHELLS, Schedule, Shell};
use crate::selection::{Kind, Selection};
use crate::textures::upload_table;
use crate::uniforms::{FrameUniform, MOST_SEGMENTS};
use crate::{GpuCoat, LightingMode, RenderError, View, Viewpoint};

/// A view of a coat, ready to be drawn, and to be moved to where the next frame is seen from.
#[derive(Debug)]
pub struct PreparedView {
    buffers: Buffers,
    /// With the coat's own images, and with blended ones.
    bind_groups: [BindGroup; 2],
    blended: BlendedStack,
    pub(crate) fins: Selection,
    pub(crate) faces: Selection,
    table: Option<(HairLighting, TableLayout)>,
    anisotropy: u16,
    pipelines: PassPipelines,
    pub(crate) schedule: Schedule,
    /// For each run of faces, which of the drawn shells are drawn up to it.
    pub(crate) draws: Vec<Range<u32>>,
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

#[derive(Debug)]
struct Buffers {
    frame: Buffer,
    shells: Buffer,
    drawn: Buffer,
}

impl PreparedView {
    pub(crate) fn new(
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        coat: &GpuCoat,
        view: &View,
        viewpoint: &Viewpoint,
    ) -> Result<Self, RenderError> {
        let schedule = Schedule::new(&coat.textures.levels, &view.options, viewpoint, coat.length * view.options.length_scale);
        let uniform = FrameUniform::new(view, viewpoint, &schedule)?;
        let buffers = Buffers {
            frame: room(device, "frame", BufferUsages::UNIFORM, size_of_val(&uniform) as u64),
            shells: room(device, "shells", BufferUsages::UNIFORM, (MOST_SHELLS * size_of::<Shell>()) as u64),
            drawn: room(device, "drawn shells", BufferUsages::VERTEX, (MOST_SHELLS * size_of::<u32>()) as u64),
        };
        let fins = Selection::new(device, queue, &shared.selectors, Kind::Fins, &buffers.frame, coat);
        let faces = Selection::new(device, queue, &shared.selectors, Kind::Faces, &buffers.frame, coat);
        let blended = BlendedStack::new(device, &shared.blender, &coat.textures);
        let factors = factor_table(device, queue, shared, view)?;
        let anisotropy = view.options.anisotropy.clamp(1, 16);
        let group = |images: &TextureView| frame_group(device, shared, &buffers, &fins, &factors, anisotropy, images, coat);
        let mut prepared = Self {
            bind_groups: [group(&coat.textures.shell_view), group(&blended.view)],
            table: table_of(view),
            anisotropy,
            pipelines: shared.pipelines.get(device, Variant::new(&view.options, coat.traits, schedule.is_shared())),
            draws: Vec::new(),
            shown: Shown::default(),
            buffers,
            blended,
            fins,
            faces,
            schedule,
        };
        prepared.write(queue, coat, view, &uniform);
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
        let uniform = FrameUniform::new(view, viewpoint, &schedule)?;
        let anisotropy = view.options.anisotropy.clamp(1, 16);
        if (self.table, self.anisotropy) != (table_of(view), anisotropy) {
            let factors = factor_table(device, queue, shared, view)?;
            let group = |images: &TextureView| frame_group(device, shared, &self.buffers, &self.fins, &factors, anisotropy, images, coat);
            self.bind_groups = [group(&coat.textures.shell_view), group(&self.blended.view)];
            (self.table, self.anisotropy) = (table_of(view), anisotropy);
        }
        self.pipelines = shared.pipelines.get(device, Variant::new(&view.options, coat.traits, schedule.is_shared()));
        self.schedule = schedule;
        self.write(queue, coat, view, &uniform);
        Ok(())
    }

    /// Writes what the schedule and the options say to where the device reads it.
    fn write(&mut self, queue: &Queue, coat: &GpuCoat, view: &View, uniform: &FrameUniform) {
        let options = &view.options;
        // Without length there is no fur to draw: the bald picture, exactly.
        let furry = options.length_scale > 0.0 && coat.furred_face_count() > 0;
        self.shown = Shown {
            surface: options.surface && coat.corner_count > 0,
            fins: options.fins && furry && coat.edge_count > 0,
            shells: options.shells && furry && !self.schedule.drawn.is_empty(),
            culling: options.culling,
            fin_segments: options.fin_segments.clamp(1, MOST_SEGMENTS),
        };
        queue.write_buffer(&self.buffers.frame, 0, bytemuck::bytes_of(uniform));
        queue.write_buffer(&self.buffers.shells, 0, bytemuck::cast_slice(&self.schedule.shells));
        queue.write_buffer(&self.buffers.drawn, 0, bytemuck::cast_slice(&self.schedule.drawn));
        if !self.schedule.slots.is_empty() {
            self.blended.set(queue, &self.schedule.slots);
        }
        queue.write_buffer(&self.fins.draws, 0, bytemuck::cast_slice(&[2 * (self.shown.fin_segments + 1), 0, 0, 0]));
        self.draws = draws(&self.schedule, coat);
        let arguments: Vec<[u32; 5]> = self.draws.iter().map(|range| [0, range.end - range.start, 0, 0, 0]).collect();
        queue.write_buffer(&self.faces.draws, 0, bytemuck::cast_slice(&arguments));
    }

    /// Records what is computed ahead of the drawing.
    pub(crate) fn record(&self, pass: &mut wgpu::ComputePass<'_>, shared: &Shared) {
        if self.shown.fins {
            self.fins.record(pass, &shared.selectors);
        }
        if self.shown.shells && self.shown.culling {
            self.faces.record(pass, &shared.selectors);
        }
        if self.is_blended() {
            self.blended.record(pass, &shared.blender, self.schedule.slots.len() as u32);
        }
    }

    pub(crate) fn draw_surface(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat) {
        if !self.shown.surface {
            return;
        }
        self.begin(pass, coat, &self.pipelines.surface);
        pass.set_vertex_buffer(0, coat.tiles.slice(..));
        pass.set_index_buffer(coat.faces.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..coat.corner_count, 0, 0..1);
    }

    pub(crate) fn draw_fins(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat) {
        if !self.shown.fins {
            return;
        }
        self.begin(pass, coat, &self.pipelines.fins);
        pass.draw_indirect(&self.fins.draws, 0);
    }

    pub(crate) fn draw_shells(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat) {
        if !self.shown.shells {
            return;
        }
        self.begin(pass, coat, &self.pipelines.shells);
        pass.set_vertex_buffer(0, coat.tiles.slice(..));
        let faces = if self.shown.culling { &self.faces.survivors } else { &coat.furred_faces };
        pass.set_index_buffer(faces.slice(..), wgpu::IndexFormat::Uint32);
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

    fn begin(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat, pipeline: &wgpu::RenderPipeline) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.bind_groups[usize::from(self.is_blended())], &[]);
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

/// For each run of faces, the drawn shells up to its end, as a range of the schedule's list.
fn draws(schedule: &Schedule, coat: &GpuCoat) -> Vec<Range<u32>> {
    let spacing = 1.0 / schedule.layers_per_height();
    let mut draws = vec![0..0; coat.runs.len()];
    for (place, &shell) in (0..).zip(&schedule.drawn) {
        let Some(run) = last_run(&coat.runs, schedule.shells[shell as usize].height, spacing) else { continue };
        let range = &mut draws[run];
        *range = if range.end == 0 { place..place + 1 } else { range.start..place + 1 };
    }
    draws
}

fn table_of(view: &View) -> Option<(HairLighting, TableLayout)> {
    match view.options.lighting {
        LightingMode::Table(layout) => Some((view.shading.hair, layout)),
        LightingMode::PerPatch | LightingMode::PerVertex | LightingMode::Formula => None,
    }
}

fn factor_table(device: &Device, queue: &Queue, shared: &Shared, view: &View) -> Result<TextureView, RenderError> {
    Ok(match table_of(view) {
        Some((hair, layout)) => upload_table(device, queue, &LightingTable::new(&hair, layout)?),
        None => shared.no_table.clone(),
    })
}

#[expect(clippy::too_many_arguments, reason = "everything that a frame is drawn from comes together here")]
fn frame_group(
    device: &Device,
    shared: &Shared,
    buffers: &Buffers,
    fins: &Selection,
    factors: &TextureView,
    anisotropy: u16,
    images: &TextureView,
    coat: &GpuCoat,
) -> BindGroup {
    let [tile, fin]: [Sampler; 2] = shared.hair_samplers(device, anisotropy);
    let resources = [
        buffers.frame.as_entire_binding(),
        buffers.shells.as_entire_binding(),
        fins.survivors.as_entire_binding(),
        BindingResource::TextureView(factors),
        BindingResource::Sampler(&shared.table_sampler),
        BindingResource::Sampler(&tile),
        BindingResource::Sampler(&fin),
        BindingResource::TextureView(images),
        BindingResource::TextureView(&coat.textures.directions),
    ];
    let entries = resources.into_iter().zip(0..).map(|(resource, binding)| BindGroupEntry { binding, resource }).collect::<Vec<_>>();
    device.create_bind_group(&BindGroupDescriptor { label: Some("frame"), layout: &shared.pipelines.frame_layout, entries: &entries })
}
