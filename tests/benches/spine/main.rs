//! From OBJ to picture, stage by stage, on a model of about 5,000 faces, everything cold; then the frame time at 640 × 480 with 16 shells and fins beside
//! the floors it is judged by, all in one run and in turn.
//!
//! The *same draw*: identical geometry, blending, depth, sampler, one filtered array fetch a fragment, no lighting, everything computed ahead.
//! The *full screen*: as many fragments as full-screen rectangles, textured and blended, as context.
//!
//! `cargo bench -p pelage-tests --bench spine`; `-- ROUNDS` for another number of rounds than 20. The model is `t1_bunny_5000` of `$PELAGE_MODELS` where that is set, else
//! a ball of 5,120 faces written as an OBJ first.
#![allow(clippy::print_stdout, clippy::expect_used, reason = "a benchmark prints and may panic")]
#![allow(unreachable_pub, reason = "modules of a program")]

mod floor;
mod model;
mod stage;

use std::time::Instant;

use pelage_coat::{Background, Coat};
use pelage_lighting::TableLayout;
use pelage_render::{
    FinRule, GpuCoat, Headless, LightingMode, Offscreen, Options, PreparedView, Renderer, ShellDepth, Target, View, Viewpoint,
};
use pelage_tests::Scene;
use wgpu::{CommandEncoder, RenderPass, TextureFormat};

use floor::{Floor, FullScreen};
use stage::{SIZE, Stage};

fn main() {
    let rounds = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(20);
    let model = model::five_thousand_faces().expect("a model");
    let size = format!("({}, {})", SIZE.0, SIZE.1);
    let overrides = [("bunny.path", model.path()), ("shells.layers", "16"), ("picture.size", &size)];
    let start = Instant::now();
    let scene = Scene::evaluate("bunny", &overrides).expect("a picture");
    let total = start.elapsed().as_secs_f64() * 1e3;
    println!("{}: from OBJ to picture, cold", model.path());
    for entry in scene.trace() {
        println!("{:12} {:16} {:9.1} ms", entry.node.to_string(), entry.kind, entry.ms);
    }
    println!("{:29} {total:9.1} ms", "everything included");

    let headless = pelage_tests::gpu().expect("an adapter").headless();
    println!("\n{} at {} × {}", headless.summary().name, SIZE.0, SIZE.1);
    let coat = scene.coat().expect("a coat");
    let (view, background) = scene.view(&coat).expect("a view");
    println!("{} faces, {} edges, {} layers", coat.patches.faces.len(), coat.edges.vertices.len(), coat.shells.layers());
    for samples in [1, 4] {
        bench(headless, &coat, &view, &background, samples, rounds);
    }
    headless.check().expect("no validation error");
}

/// One way of drawing, its name and its times.
struct Contender<'a> {
    name: String,
    compute: Box<dyn Fn(&mut CommandEncoder) + 'a>,
    draw: Box<dyn Fn(&mut RenderPass<'_>) + 'a>,
    times: Vec<f64>,
    fragments: u64,
}

fn bench(headless: &Headless, coat: &Coat, view: &View, background: &Background, samples: u32, rounds: usize) {
    let (device, queue) = (headless.device(), headless.queue());
    let target = Target::new(TextureFormat::Rgba8UnormSrgb, samples);
    let renderer = Renderer::new(device, queue, target);
    let gpu_coat = renderer.upload(device, queue, coat).expect("a whole coat");
    let defaults = Options::default();
    let variants = [
        ("lit at vertices (default)", defaults),
        ("lit at pixels, formula", Options { lighting: LightingMode::Formula, ..defaults }),
        ("lit at pixels, 64² table", Options { lighting: LightingMode::Table(TableLayout::default()), ..defaults }),
        ("lit at pixels, 32² cosine table", Options { lighting: LightingMode::Table(TableLayout::PAPER), ..defaults }),
        ("depth only tested", Options { shell_depth: ShellDepth::Tested, ..defaults }),
        ("without fins", Options { fins: false, ..defaults }),
        ("everything submitted", Options { culling: false, ..defaults }),
        ("everything, and all fins", Options { culling: false, fin_rule: FinRule::All, ..defaults }),
        ("without step blur", Options { step_blur: 0.0, ..defaults }),
        ("anisotropy 4", Options { anisotropy: 4, ..defaults }),
    ];
    let prepare = |options| prepare(headless, &renderer, &gpu_coat, &View { options, ..view.clone() });
    // A software adapter takes seconds for anisotropic filtering with four samples.
    let variants = variants.iter().filter(|(_, options)| samples == 1 || options.anisotropy == 1);
    let prepared: Vec<(&str, PreparedView)> = variants.map(|&(name, options)| (name, prepare(options))).collect();
    let stage = Stage::new(device, target);
    let floors = [(true, "floor: same draw"), (false, "floor: same draw, depth only tested")]
        .map(|(written, name)| (name, Floor::new(device, queue, target, coat, view, written)));

    // As many rectangles as the default draws fragments.
    let default_view = &prepared[0].1;
    let fragments = stage.fragments(headless, &|encoder| renderer.compute(encoder, &gpu_coat, default_view), &|pass| {
        renderer.draw(pass, &gpu_coat, default_view)
    });
    let count = (fragments as f64 / f64::from(SIZE.0 * SIZE.1 * samples)).round().max(1.0) as u32;
    let full = FullScreen::new(device, queue, target, coat, count);
    let mut contenders: Vec<Contender<'_>> = Vec::new();
    for (name, view) in &prepared {
        let compute = |encoder: &mut CommandEncoder| renderer.compute(encoder, &gpu_coat, view);
        contenders.push(contender(name, compute, |pass| renderer.draw(pass, &gpu_coat, view)));
    }
    for (name, floor) in &floors {
        contenders.push(contender(name, |_| (), |pass| floor.draw(pass)));
    }
    contenders.push(contender(&format!("floor: {count} full screens"), |_| (), |pass| full.draw(pass)));
    for contender in &mut contenders {
        contender.fragments = stage.fragments(headless, &contender.compute, &contender.draw);
    }

    // In turn, so that a busy machine is unfair to all alike.
    for round in 0..rounds + 2 {
        for contender in &mut contenders {
            let start = Instant::now();
            stage.frame(headless, &contender.compute, &contender.draw);
            if round >= 2 {
                contender.times.push(start.elapsed().as_secs_f64() * 1e3);
            }
        }
    }
    let offscreen = Offscreen::new(headless, SIZE, samples).expect("a target");
    let drawn = offscreen.render(&gpu_coat, view, background).expect("a picture").frame;
    println!(
        "\n{samples} samples, {rounds} rounds, {} fins of {} edges, {} of {} furred faces in {} of {} patches, {} triangles",
        drawn.fins_drawn, drawn.fins_considered, drawn.faces_drawn, drawn.faces_furred, drawn.patches_drawn, drawn.patches, drawn.triangles
    );
    println!("{:36} {:>9} {:>9} {:>11} {:>9} {:>14}", "", "min ms", "median", "fragments", "ns each", "of same draw");
    let same = contenders.iter().position(|c| c.name == floors[0].0).expect("the floor");
    let floor_times = contenders[same].times.clone();
    for contender in &mut contenders {
        // The ratio round by round, then its median: what both had to share cancels.
        let ratio = median(&mut contender.times.iter().zip(&floor_times).map(|(ours, floor)| ours / floor).collect::<Vec<_>>());
        let median = median(&mut contender.times);
        let each = median * 1e6 / contender.fragments as f64;
        println!("{:36} {:9.1} {median:9.1} {:11} {each:9.2} {ratio:14.2}", contender.name, contender.times[0], contender.fragments);
    }
}

fn prepare(headless: &Headless, renderer: &Renderer, coat: &GpuCoat, view: &View) -> PreparedView {
    let viewpoint = Viewpoint::of(&view.camera, SIZE);
    renderer.prepare(headless.device(), headless.queue(), coat, view, &viewpoint).expect("a finite view")
}

fn contender<'a>(name: &str, compute: impl Fn(&mut CommandEncoder) + 'a, draw: impl Fn(&mut RenderPass<'_>) + 'a) -> Contender<'a> {
    Contender { name: name.to_owned(), compute: Box::new(compute), draw: Box::new(draw), times: Vec::new(), fragments: 0 }
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
