//! Several ways of drawing in turn, so that a busy machine is unfair to all alike.

use pelage_coat::Coat;
use pelage_render::{DepthBuffer, GpuCoat, Headless, Options, PreparedView, View, Viewpoint};
use wgpu::{CommandEncoder, RenderPass};

use super::stage::{SIZE, Stage};

/// One way of drawing.
pub struct Contender<'a> {
    pub name: String,
    record: Box<dyn FnMut(&mut CommandEncoder) + 'a>,
    pub fragments: Option<u64>,
    pub triangles: Option<u64>,
    times: Vec<f64>,
}

/// What a race found out about a contender.
pub struct Finish {
    pub name: String,
    pub least: f64,
    pub median: f64,
    /// The medians of the ratios to two others, round by round: what both had to share cancels.
    pub ratios: [f64; 2],
    pub fragments: Option<u64>,
    pub triangles: Option<u64>,
}

impl<'a> Contender<'a> {
    /// Whatever records itself into one pass.
    pub fn plain(
        headless: &Headless,
        stage: &'a Stage,
        name: &str,
        triangles: Option<u64>,
        draw: impl Fn(&mut RenderPass<'_>) + 'a,
    ) -> Self {
        let fragments = Some(stage.fragments(headless, &|_| (), &draw));
        let record = move |encoder: &mut CommandEncoder| draw(&mut stage.pass(encoder, (true, true), None));
        Self { name: name.into(), record: Box::new(record), fragments, triangles, times: Vec::new() }
    }

    /// Ours.
    pub fn ours(headless: &Headless, stage: &'a Stage, fur: &'a Fur, name: &str, redraw_shadows: bool) -> Self {
        let compute = move |encoder: &mut CommandEncoder| {
            if redraw_shadows {
                fur.view.redraw_shadows();
            }
            stage.renderer.compute(encoder, &fur.coat, &fur.view);
        };
        let draw = move |pass: &mut RenderPass<'_>| stage.renderer.draw(pass, &fur.coat, &fur.view);
        let fragments = Some(stage.fragments(headless, &compute, &draw));
        let record = move |encoder: &mut CommandEncoder| {
            compute(encoder);
            draw(&mut stage.pass(encoder, (true, true), None));
        };
        Self { name: name.into(), record: Box::new(record), fragments, triangles: Some(fur.triangles(headless)), times: Vec::new() }
    }

    /// Ours in two passes, surface and the rest, with what the skin hides left out in between.
    pub fn hidden(headless: &'a Headless, stage: &'a Stage, fur: &'a mut Fur, name: &str) -> Self {
        let record = move |encoder: &mut CommandEncoder| fur.record_hidden(headless, stage, encoder);
        Self { name: name.into(), record: Box::new(record), fragments: None, triangles: None, times: Vec::new() }
    }
}

/// A coat and a view of it on the device.
pub struct Fur {
    pub coat: GpuCoat,
    pub view: PreparedView,
}

impl Fur {
    pub fn new(headless: &Headless, stage: &Stage, coat: &Coat, view: &View) -> Self {
        let (device, queue) = (headless.device(), headless.queue());
        let renderer = &stage.renderer;
        let coat = renderer.upload(device, queue, coat).expect("a whole coat");
        let view = renderer.prepare(device, queue, &coat, view, &Viewpoint::of(&view.camera, SIZE)).expect("a finite view");
        Self { coat, view }
    }

    /// The same coat with other options.
    pub fn with(headless: &Headless, stage: &Stage, coat: &Coat, view: &View, options: Options) -> Self {
        Self::new(headless, stage, coat, &View { options, ..view.clone() })
    }

    /// The faces whose shells are drawn.
    pub fn faces(&self, headless: &Headless, stage: &Stage) -> Vec<[u32; 3]> {
        stage.time(headless, &mut |encoder| stage.renderer.compute(encoder, &self.coat, &self.view));
        self.view.shell_faces(headless.device(), headless.queue(), &self.coat).expect("the device answers")
    }

    /// The faces left where what the skin hides is left out, too.
    pub fn unhidden_faces(&mut self, headless: &Headless, stage: &Stage) -> Vec<[u32; 3]> {
        stage.time(headless, &mut |encoder| self.record_hidden(headless, stage, encoder));
        self.view.shell_faces(headless.device(), headless.queue(), &self.coat).expect("the device answers")
    }

    fn triangles(&self, headless: &Headless) -> u64 {
        self.view.frame_stats(headless.device(), headless.queue(), &self.coat).expect("the device answers").triangles
    }

    fn record_hidden(&mut self, headless: &Headless, stage: &Stage, encoder: &mut CommandEncoder) {
        let (Self { coat, view }, renderer) = (self, &stage.renderer);
        renderer.compute(encoder, coat, view);
        renderer.draw_surface(&mut stage.pass(encoder, (true, false), None), coat, view);
        let depth = DepthBuffer { view: &stage.depth, size: SIZE };
        renderer.find_hidden(headless.device(), headless.queue(), encoder, coat, view, depth);
        let mut pass = stage.pass(encoder, (false, true), None);
        renderer.draw_fins(&mut pass, coat, view);
        renderer.draw_shells(&mut pass, coat, view);
    }
}

/// Runs so many rounds after two that do not count; the ratios are to the contenders at the places `to`.
pub fn race(headless: &Headless, stage: &Stage, mut contenders: Vec<Contender<'_>>, rounds: usize, to: [usize; 2]) -> Vec<Finish> {
    for round in 0..rounds + 2 {
        for contender in &mut contenders {
            let ms = stage.time(headless, &mut contender.record);
            if round >= 2 {
                contender.times.push(ms);
            }
        }
    }
    let ratio =
        |contender: &Contender<'_>, to: usize| median(contender.times.iter().zip(&contenders[to].times).map(|(a, b)| a / b).collect());
    contenders
        .iter()
        .map(|contender| Finish {
            name: contender.name.clone(),
            least: contender.times.iter().copied().fold(f64::INFINITY, f64::min),
            median: median(contender.times.clone()),
            ratios: to.map(|to| ratio(contender, to)),
            fragments: contender.fragments,
            triangles: contender.triangles,
        })
        .collect()
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Prints them under two headings for the ratios.
pub fn print(finishes: &[Finish], ratios: [&str; 2]) {
    println!("{:44} {:>8} {:>8} {:>14} {:>14} {:>10} {:>10}", "", "least ms", "median", ratios[0], ratios[1], "fragments", "triangles");
    let count = |count: Option<u64>| count.map_or("–".into(), |count| count.to_string());
    for finish in finishes {
        let Finish { name, least, median, ratios, fragments, triangles } = finish;
        let [first, second] = ratios;
        println!("{name:44} {least:8.1} {median:8.1} {first:14.2} {second:14.2} {:>10} {:>10}", count(*fragments), count(*triangles));
    }
}
