//! Several ways of drawing in turn, so that a busy machine is unfair to all alike.

use pelage_coat::Coat;
use pelage_render::{DepthBuffer, Headless, Options, PreparedView, View, Viewpoint};
use wgpu::{CommandEncoder, RenderPass};

use crate::Error;
use crate::stage::{SIZE, Stage};

/// One way of drawing.
pub struct Contender<'a> {
    /// What it is called.
    pub name: String,
    record: Box<dyn FnMut(&mut CommandEncoder) + 'a>,
    /// Samples that passed the tests, where they were counted.
    pub fragments: Option<u64>,
    /// Triangles submitted, where they were counted.
    pub triangles: Option<u64>,
    times: Vec<f64>,
}

/// What a race found out about a contender.
pub struct Finish {
    /// What it is called.
    pub name: String,
    /// The least time of a frame, in milliseconds.
    pub least: f64,
    /// The median.
    pub median: f64,
    /// The medians of the ratios to two others, round by round: what both had to share cancels.
    pub ratios: [f64; 2],
    /// Samples that passed the tests, where they were counted.
    pub fragments: Option<u64>,
    /// Triangles submitted, where they were counted.
    pub triangles: Option<u64>,
}

impl<'a> Contender<'a> {
    /// Whatever records itself into one pass.
    ///
    /// # Errors
    /// A device that does not answer.
    pub fn plain(
        headless: &Headless,
        stage: &'a Stage,
        name: &str,
        triangles: Option<u64>,
        draw: impl Fn(&mut RenderPass<'_>) + 'a,
    ) -> Result<Self, Error> {
        let fragments = Some(stage.fragments(headless, &|_| (), &draw)?);
        let record = move |encoder: &mut CommandEncoder| draw(&mut stage.pass(encoder, (true, true), None));
        Ok(Self { name: name.into(), record: Box::new(record), fragments, triangles, times: Vec::new() })
    }

    /// Ours in one pass; with the shadow map drawn anew each time, as if the light moved, or not.
    ///
    /// # Errors
    /// A device that does not answer.
    pub fn ours(headless: &Headless, stage: &'a Stage, fur: &'a Fur, name: &str, redraw_shadows: bool) -> Result<Self, Error> {
        let compute = move |encoder: &mut CommandEncoder| {
            if redraw_shadows {
                fur.view.redraw_shadows();
            }
            stage.renderer.compute(encoder, &fur.view);
        };
        let draw = move |pass: &mut RenderPass<'_>| stage.renderer.draw(pass, &fur.view);
        let fragments = Some(stage.fragments(headless, &compute, &draw)?);
        let record = move |encoder: &mut CommandEncoder| {
            compute(encoder);
            draw(&mut stage.pass(encoder, (true, true), None));
        };
        Ok(Self { name: name.into(), record: Box::new(record), fragments, triangles: Some(fur.triangles(headless)?), times: Vec::new() })
    }

    /// Ours in two passes, surface and the rest, with what the skin hides left out in between.
    pub fn hidden(headless: &'a Headless, stage: &'a Stage, fur: &'a mut Fur, name: &str) -> Self {
        let record = move |encoder: &mut CommandEncoder| fur.record_hidden(headless, stage, encoder);
        Self { name: name.into(), record: Box::new(record), fragments: None, triangles: None, times: Vec::new() }
    }
}

/// A coat and a view of it on the device.
pub struct Fur {
    /// The view.
    pub view: PreparedView,
}

impl Fur {
    /// Uploads a coat and prepares a view.
    ///
    /// # Errors
    /// Those of [`pelage_render::Renderer::upload`] and [`pelage_render::Renderer::prepare`].
    pub fn new(headless: &Headless, stage: &Stage, coat: &Coat, view: &View) -> Result<Self, Error> {
        let (device, queue) = (headless.device(), headless.queue());
        let renderer = &stage.renderer;
        let coat = renderer.upload(device, queue, coat)?;
        let view = renderer.prepare(device, queue, &coat, view, &Viewpoint::of(&view.camera, SIZE))?;
        Ok(Self { view })
    }

    /// The same with other options than the view's.
    ///
    /// # Errors
    /// As there.
    pub fn with(headless: &Headless, stage: &Stage, coat: &Coat, view: &View, options: Options) -> Result<Self, Error> {
        Self::new(headless, stage, coat, &View { options, ..view.clone() })
    }

    /// The faces whose shells are drawn, as patch vertices.
    ///
    /// # Errors
    /// A device that does not answer.
    pub fn faces(&self, headless: &Headless, stage: &Stage) -> Result<Vec<[u32; 3]>, Error> {
        stage.time(headless, &mut |encoder| stage.renderer.compute(encoder, &self.view))?;
        Ok(self.view.shell_faces(headless.device(), headless.queue())?)
    }

    /// The faces left where what the skin hides is left out, too.
    ///
    /// # Errors
    /// A device that does not answer.
    pub fn unhidden_faces(&mut self, headless: &Headless, stage: &Stage) -> Result<Vec<[u32; 3]>, Error> {
        stage.time(headless, &mut |encoder| self.record_hidden(headless, stage, encoder))?;
        Ok(self.view.shell_faces(headless.device(), headless.queue())?)
    }

    /// How many triangles are drawn, after a first frame.
    ///
    /// # Errors
    /// A device that does not answer.
    pub fn triangles(&self, headless: &Headless) -> Result<u64, Error> {
        Ok(self.view.frame_stats(headless.device(), headless.queue())?.triangles)
    }

    fn record_hidden(&mut self, headless: &Headless, stage: &Stage, encoder: &mut CommandEncoder) {
        let (view, renderer) = (&mut self.view, &stage.renderer);
        renderer.compute(encoder, view);
        renderer.draw_surface(&mut stage.pass(encoder, (true, false), None), view);
        let depth = DepthBuffer { view: &stage.depth, size: SIZE };
        renderer.find_hidden(headless.device(), headless.queue(), encoder, view, depth);
        let mut pass = stage.pass(encoder, (false, true), None);
        renderer.draw_fins(&mut pass, view);
        renderer.draw_shells(&mut pass, view);
    }
}

/// Runs so many rounds after two that do not count; the ratios are to the contenders at the places `to`.
///
/// # Errors
/// A device that does not answer, or a validation error on the way.
pub fn race(
    headless: &Headless,
    stage: &Stage,
    mut contenders: Vec<Contender<'_>>,
    rounds: usize,
    to: [usize; 2],
) -> Result<Vec<Finish>, Error> {
    for round in 0..rounds + 2 {
        for contender in &mut contenders {
            let ms = stage.time(headless, &mut contender.record)?;
            if round >= 2 {
                contender.times.push(ms);
            }
        }
    }
    headless.check()?;
    let ratio =
        |contender: &Contender<'_>, to: usize| median(contender.times.iter().zip(&contenders[to].times).map(|(a, b)| a / b).collect());
    let finish = |contender: &Contender<'_>| Finish {
        name: contender.name.clone(),
        least: contender.times.iter().copied().fold(f64::INFINITY, f64::min),
        median: median(contender.times.clone()),
        ratios: to.map(|to| ratio(contender, to)),
        fragments: contender.fragments,
        triangles: contender.triangles,
    };
    Ok(contenders.iter().map(finish).collect())
}

/// The median of some times; no number of none.
fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}
