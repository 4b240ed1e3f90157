//! Pictures without a window.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use pelage_coat::{Background, Coat};
use wgpu::{CommandEncoder, CommandEncoderDescriptor, RenderPass, TextureFormat};

use crate::attachments::{Attachments, PassMeasures, Place};
use crate::background::BackgroundPass;
use crate::counts::Counts;
use crate::fragments::{FragmentCounter, Part, counted};
use crate::timing::{PassTimer, Stamps, Timed};
use crate::{
    DepthBuffer, FrameStats, FrameTimes, GpuCoat, Headless, PassTimes, Picture, PreparedView, RenderError, Renderer, Target, View,
    Viewpoint, limits, readback,
};

/// Frames before the clock runs: the first compiles shaders, the next fill caches.
const WARM_UP: u32 = 3;

/// A renderer with a target of its own, for any number of frames of one size.
#[derive(Debug)]
pub struct Offscreen {
    headless: Headless,
    renderer: Renderer,
    background: BackgroundPass,
    size: (u32, u32),
    /// None for a picture without pixels.
    attachments: Option<Attachments>,
    timer: Option<PassTimer>,
    counter: FragmentCounter,
    /// Whoever draws holds it: target, background and timer are one frame's at a time.
    drawing: Mutex<()>,
}

/// Draws one picture: uploads, draws, reads back. For several of one coat or size use [`Offscreen`].
///
/// # Errors
/// Those of [`Offscreen::new`], [`Offscreen::upload`] and [`Offscreen::render`].
pub fn render_picture(
    headless: &Headless,
    coat: &Coat,
    view: &View,
    size: (u32, u32),
    samples: u32,
    background: &Background,
) -> Result<Picture, RenderError> {
    let offscreen = Offscreen::new(headless, size, samples)?;
    offscreen.render(&offscreen.upload(coat)?, view, background)
}

impl Offscreen {
    /// A target of `size`, width and height in pixels (zero is fine), with 1 or 4 `samples` a pixel.
    ///
    /// # Errors
    /// A size beyond the device's limits, another number of samples, a validation error.
    pub fn new(headless: &Headless, size: (u32, u32), samples: u32) -> Result<Self, RenderError> {
        let target = Target::new(TextureFormat::Rgba8UnormSrgb, samples);
        let supported = |format| headless.adapter().get_texture_format_features(format).flags.sample_count_supported(samples);
        if !(matches!(samples, 1 | 4) && supported(target.colour) && supported(target.depth)) {
            return Err(RenderError::Samples { samples });
        }
        let device = headless.device();
        limits::check_picture(&device.limits(), size)?;
        let offscreen = Self {
            headless: headless.clone(),
            renderer: Renderer::new(device, headless.queue(), target),
            background: BackgroundPass::new(device, target),
            size,
            attachments: (size.0 > 0 && size.1 > 0).then(|| Attachments::new(device, target, size)),
            timer: PassTimer::new(device),
            counter: FragmentCounter::new(device),
            drawing: Mutex::default(),
        };
        headless.check()?;
        Ok(offscreen)
    }

    /// The renderer, to upload or prepare with.
    pub fn renderer(&self) -> &Renderer {
        &self.renderer
    }

    /// As [`Renderer::upload`].
    ///
    /// # Errors
    /// As there.
    pub fn upload(&self, coat: &Coat) -> Result<GpuCoat, RenderError> {
        self.renderer.upload(self.headless.device(), self.headless.queue(), coat)
    }

    /// Draws a frame and reads it back. Of several threads that ask at once, one draws after the other.
    ///
    /// # Errors
    /// Those of [`Renderer::prepare`]; a validation error; a lost device.
    pub fn render(&self, coat: &GpuCoat, view: &View, background: &Background) -> Result<Picture, RenderError> {
        let (width, height) = self.size;
        let Some(attachments) = &self.attachments else {
            return Ok(Picture { width, height, rgba: Vec::new(), coverage: Vec::new(), frame: FrameStats::default() });
        };
        let _one_at_a_time = self.lock();
        let mut prepared = self.prepare(coat, view, background)?;
        let device = self.headless.device();
        let stride = readback::row_stride(width);
        let buffer = readback::readable(device, u64::from(stride) * u64::from(height));
        let mut encoder = self.encoder();
        let plan = FramePlan { attachments, hidden: view.options.hidden && view.options.culling };
        let stamps = self.encode(&mut encoder, &plan, &mut prepared, Measures { timer: self.timer.as_ref(), counter: Some(&self.counter) });
        let counts = Counts::record(device, &mut encoder, &prepared);
        readback::copy_pixels(&mut encoder, &attachments.pixels, &buffer);
        self.headless.queue().submit([encoder.finish()]);
        // A refused frame leaves nothing to read.
        self.headless.check()?;
        let pixels = readback::read(device, &buffer, <[u8]>::to_vec)?;
        let passes = self.timer.as_ref().map(|timer| timer.read(device, self.headless.queue(), &stamps)).transpose()?;
        self.headless.check()?;
        let fragments = Some(self.counter.read(device)?);
        let frame = FrameStats { passes, fragments, ..counts.read(device, &prepared)? };
        let rows = pixels.chunks(stride as usize).flat_map(|row| &row[..4 * width as usize]);
        let mut rgba: Vec<u8> = rows.copied().collect();
        let coverage = rgba.chunks_exact(4).map(|pixel| pixel[3]).collect();
        rgba.chunks_exact_mut(4).for_each(|pixel| pixel[3] = 255);
        Ok(Picture { width, height, rgba, coverage, frame })
    }

    /// Draws a frame `frames` times after a warm-up, each to its end, and says how long that took.
    ///
    /// # Errors
    /// Those of [`Offscreen::render`].
    pub fn time(&self, coat: &GpuCoat, view: &View, background: &Background, frames: u32) -> Result<FrameTimes, RenderError> {
        if self.attachments.is_none() {
            return Ok(FrameTimes::default());
        }
        let mut timed = self.timed_frame(coat, view, background)?;
        let times = (0..frames).map(|_| timed.draw()).collect::<Result<Vec<f64>, _>>()?;
        let passes = self
            .timer
            .as_ref()
            .map_or(Ok(Vec::new()), |timer| (0..frames).map(|_| timed.draw_passes(timer)).collect::<Result<Vec<_>, _>>())?;
        self.headless.check()?;
        Ok(FrameTimes::of(times, &passes))
    }

    /// A frame made ready and warmed up, to be timed in turn with others.
    ///
    /// # Errors
    /// Those of [`Offscreen::render`].
    pub fn timed_frame(&self, coat: &GpuCoat, view: &View, background: &Background) -> Result<TimedFrame<'_>, RenderError> {
        let prepared = {
            let _one_at_a_time = self.lock();
            self.prepare(coat, view, background)?
        };
        let mut timed =
            TimedFrame { offscreen: self, prepared, background: *background, hidden: view.options.hidden && view.options.culling };
        (0..WARM_UP).try_for_each(|_| timed.draw().map(|_| ()))?;
        self.headless.check()?;
        Ok(timed)
    }

    /// A panic elsewhere leaves nothing half drawn: the next frame begins anew.
    fn lock(&self) -> MutexGuard<'_, ()> {
        self.drawing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn encoder(&self) -> CommandEncoder {
        self.headless.device().create_command_encoder(&CommandEncoderDescriptor { label: Some("picture") })
    }

    fn prepare(&self, coat: &GpuCoat, view: &View, background: &Background) -> Result<PreparedView, RenderError> {
        self.background.set(self.headless.queue(), background)?;
        let viewpoint = Viewpoint::of(&view.camera, self.size);
        self.renderer.prepare(self.headless.device(), self.headless.queue(), coat, view, &viewpoint)
    }

    /// What is computed ahead, then one drawing pass, or one for each part of the picture if they are timed or what is hidden is left out.
    fn encode(&self, encoder: &mut CommandEncoder, plan: &FramePlan<'_>, view: &mut PreparedView, measures: Measures<'_>) -> Stamps {
        let Measures { timer, counter } = measures;
        let mut stamps = Stamps::default();
        let computed = timer.filter(|_| view.picks()).map(|timer| timer.compute_writes(&mut stamps));
        self.renderer.compute_timed(encoder, view, computed);
        let parts: Vec<Part> = view.parts().collect();
        let hidden = plan.hidden && parts.contains(&Part::Shells);
        let passes: Vec<&[Part]> = if timer.is_some() || hidden { parts.chunks(1).collect() } else { vec![&parts] };
        for (number, drawn) in passes.iter().enumerate() {
            let place = Place { first: number == 0, last: number + 1 == passes.len() };
            let times = timer.zip(drawn.first()).map(|(timer, &part)| timer.writes(&mut stamps, timed(part)));
            let measured = PassMeasures { times, fragments: counter.map(FragmentCounter::queries) };
            {
                let mut pass = plan.attachments.pass(encoder, "frame", place, measured);
                if place.first {
                    self.background.draw(&mut pass);
                }
                drawn.iter().for_each(|&part| counted(counter, part, &mut pass, |pass| self.draw(part, pass, view)));
                // What is not drawn counts nothing; a device may wait for an answer that is not given.
                let absent = Part::ALL.into_iter().filter(|part| place.last && !parts.contains(part));
                absent.for_each(|part| counted(counter, part, &mut pass, |_| ()));
            }
            if hidden && place.first {
                let (device, queue) = (self.headless.device(), self.headless.queue());
                self.renderer.find_hidden(device, queue, encoder, view, DepthBuffer { view: &plan.attachments.depth, size: self.size });
            }
        }
        if let Some(timer) = timer {
            timer.resolve(encoder, &stamps);
        }
        if let Some(counter) = counter {
            counter.resolve(encoder);
        }
        stamps
    }

    fn draw(&self, part: Part, pass: &mut RenderPass<'_>, view: &PreparedView) {
        match part {
            Part::Surface => self.renderer.draw_surface(pass, view),
            Part::Fins => self.renderer.draw_fins(pass, view),
            Part::Shells => self.renderer.draw_shells(pass, view),
        }
    }
}

fn timed(part: Part) -> Timed {
    match part {
        Part::Surface => Timed::Surface,
        Part::Fins => Timed::Fins,
        Part::Shells => Timed::Shells,
    }
}

/// A frame made ready, to be drawn again and again: see [`Offscreen::timed_frame`].
#[derive(Debug)]
pub struct TimedFrame<'a> {
    offscreen: &'a Offscreen,
    prepared: PreparedView,
    background: Background,
    hidden: bool,
}

impl TimedFrame<'_> {
    /// Draws the frame to its end, as if something had moved, and says how many milliseconds that took. Nothing is drawn where there are no pixels.
    ///
    /// # Errors
    /// A lost device.
    pub fn draw(&mut self) -> Result<f64, RenderError> {
        Ok(self.draw_measured(None)?.0)
    }

    fn draw_passes(&mut self, timer: &PassTimer) -> Result<PassTimes, RenderError> {
        let (_, stamps) = self.draw_measured(Some(timer))?;
        timer.read(self.offscreen.headless.device(), self.offscreen.headless.queue(), &stamps)
    }

    fn draw_measured(&mut self, timer: Option<&PassTimer>) -> Result<(f64, Stamps), RenderError> {
        let offscreen = self.offscreen;
        let Some(attachments) = &offscreen.attachments else { return Ok((0.0, Stamps::default())) };
        let _one_at_a_time = offscreen.lock();
        let (device, queue) = (offscreen.headless.device(), offscreen.headless.queue());
        offscreen.background.set(queue, &self.background)?;
        let start = Instant::now();
        let mut encoder = offscreen.encoder();
        self.prepared.redraw_shadows();
        let plan = FramePlan { attachments, hidden: self.hidden };
        let stamps = offscreen.encode(&mut encoder, &plan, &mut self.prepared, Measures { timer, counter: None });
        queue.submit([encoder.finish()]);
        readback::wait(device)?;
        Ok((start.elapsed().as_secs_f64() * 1e3, stamps))
    }
}

/// What is found out about a frame while it is drawn.
#[derive(Clone, Copy)]
struct Measures<'a> {
    timer: Option<&'a PassTimer>,
    counter: Option<&'a FragmentCounter>,
}

/// What a frame is drawn from, and into.
struct FramePlan<'a> {
    attachments: &'a Attachments,
    hidden: bool,
}
