//! A view of a coat on the device.

use std::ops::Range;

use wgpu::{CommandEncoder, ComputePass, Device, IndexFormat, Queue, RenderPass};

use crate::fragments::Part;
use crate::frame::Frame;
use crate::frame_groups::FrameBuffers;
use crate::furred_faces::last_run;
use crate::picks::Picks;
use crate::schedule::Schedule;
use crate::shadow::ShadowMap;
use crate::shared::Shared;
use crate::{DepthBuffer, GpuCoat, RenderError, View, Viewpoint};

/// A view of a coat, ready to be drawn, and to be moved to where the next frame is seen from.
#[derive(Debug)]
pub struct PreparedView {
    pub(crate) frame: Frame,
    pub(crate) picks: Picks,
    /// For each run of faces, which of the drawn shells are drawn up to it.
    pub(crate) draws: Vec<Range<u32>>,
}

impl PreparedView {
    pub(crate) fn new(
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        coat: &GpuCoat,
        view: (&View, &Viewpoint),
    ) -> Result<Self, RenderError> {
        let buffers = FrameBuffers::new(device);
        let picks = Picks::new(device, queue, shared, &buffers.frame, coat);
        let frame = Frame::new(device, queue, shared, coat, view, (buffers, &picks.fins.survivors, false))?;
        let mut prepared = Self { frame, picks, draws: Vec::new() };
        prepared.set_draws(queue);
        Ok(prepared)
    }

    /// Moves to another view. What fails leaves it as it was.
    pub(crate) fn update(&mut self, device: &Device, queue: &Queue, shared: &Shared, view: (&View, &Viewpoint)) -> Result<(), RenderError> {
        self.frame.update(device, queue, shared, view)?;
        self.set_draws(queue);
        Ok(())
    }

    fn set_draws(&mut self, queue: &Queue) {
        self.draws = draws(&self.frame.schedule, &self.frame.coat);
        self.picks.set(queue, self.frame.shown.fin_segments, &self.draws);
    }

    /// Whether there is anything to compute ahead of the drawing.
    pub(crate) fn picks(&self) -> bool {
        let shown = self.frame.shown;
        shown.fins || shown.shells && shown.culling
    }

    /// Records what is computed ahead of the drawing.
    pub(crate) fn record(&self, pass: &mut ComputePass<'_>, shared: &Shared) {
        let shown = self.frame.shown;
        self.picks.record(pass, shared, shown.fins, shown.shells && shown.culling);
    }

    /// What is drawn, in its order; the surface always, since where there is no skin there is the background.
    pub(crate) fn parts(&self) -> impl Iterator<Item = Part> {
        let shown = self.frame.shown;
        Part::ALL.into_iter().filter(move |part| match part {
            Part::Surface => true,
            Part::Fins => shown.fins,
            Part::Shells => shown.shells,
        })
    }

    /// Records the picking of faces anew, by what hides them.
    pub(crate) fn record_hidden(
        &mut self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        shared: &Shared,
        depth: DepthBuffer<'_>,
    ) {
        let (shown, (width, height)) = (self.frame.shown, depth.size);
        if shown.shells && shown.culling && width > 0 && height > 0 {
            let scene = (&self.frame.buffers.frame, &self.frame.coat);
            self.picks.record_unhidden((device, queue), encoder, shared, scene, depth);
        }
    }

    /// Whether the next frame draws the shadow map anew: the light, the fur's length or the shells have changed, or it was asked for.
    pub fn shadows_are_stale(&self) -> bool {
        self.frame.resources.shadows.as_ref().is_some_and(ShadowMap::is_stale)
    }

    /// Has the shadow map drawn anew with the next frame: where a coat's arrays or textures have changed on the device, where the commands that
    /// [`crate::Renderer::compute`] recorded were never submitted, or to measure what it costs.
    pub fn redraw_shadows(&self) {
        if let Some(shadows) = &self.frame.resources.shadows {
            shadows.redraw();
        }
    }

    pub(crate) fn draw_surface(&self, pass: &mut RenderPass<'_>) {
        self.frame.draw_surface(pass, None, 0..1);
    }

    pub(crate) fn draw_fins(&self, pass: &mut RenderPass<'_>) {
        let Some(pipeline) = &self.frame.pipelines.fins else { return };
        self.frame.begin(pass, pipeline);
        pass.draw_indirect(&self.picks.fins.draws, 0);
    }

    pub(crate) fn draw_shells(&self, pass: &mut RenderPass<'_>) {
        let (frame, coat) = (&self.frame, &self.frame.coat);
        let Some(pipeline) = &frame.pipelines.shells else { return };
        frame.begin_tiles(pass, pipeline);
        let culling = frame.shown.culling;
        let faces = if culling { &self.picks.faces.survivors } else { &coat.furred_faces };
        pass.set_index_buffer(faces.slice(..), IndexFormat::Uint32);
        // The later the run, the lower its hair is cut: innermost shells first.
        for (run, range) in self.draws.iter().enumerate().rev().filter(|(_, range)| range.start < range.end) {
            pass.set_vertex_buffer(1, frame.buffers.drawn.slice(4 * u64::from(range.start)..));
            if culling {
                pass.draw_indexed_indirect(&self.picks.faces.draws, 20 * run as u64);
            } else {
                pass.draw_indexed(0..3 * coat.runs[run].faces, 0, 0..range.end - range.start);
            }
        }
    }

    /// How many layers are drawn as shells; the skin is not among them.
    pub fn shell_count(&self) -> u32 {
        if self.frame.shown.shells { self.frame.schedule.drawn.len() as u32 } else { 0 }
    }

    /// The level of detail: 0 is the finest, each has half the shells of the one before; a fraction blends.
    pub fn level(&self) -> f32 {
        self.frame.schedule.level
    }

    /// How many edges are looked at for fins.
    pub fn fins_considered(&self) -> u32 {
        if self.frame.shown.fins { self.frame.coat.edge_count } else { 0 }
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
