//! From OBJ to picture, stage by stage, everything cold; then frames at 640 × 480 with 16 shells and fins beside what they are judged by, all in one run and in turn.
//!
//! - The *same draw*: the triangles that ours draws (skin, fins, the shells of the faces that ours picks), blending, depth, sampler, one filtered array fetch a
//!   fragment, no lighting, everything computed ahead. The floor that ours is judged by.
//! - The *full screen*: as many fragments as full-screen rectangles, textured and blended, as context.
//! - The *plain renderer*: every face for every shell, whichever way it faces, and every edge as a fin, lit as ours: what there is to win.
//! - The *exact visible set* of triangles (`exact.rs`), and the fragments that it makes.
//!
//! `cargo bench -p pelage-tests --bench spine`; `-- ROUNDS` for another number of rounds than 20, `-- SECTION …` for some of `stages`,
//! `floors`, `exact`, `fewer`, `far`, `options`. `-- far --write FILE` also writes what `far` measures as CSV, from which `cargo book pictures` draws
//! the book's plot: `book/src/measured/distance.csv`. Models: the bunny as shipped, and `t1_bunny_5000` of
//! `$PELAGE_MODELS` where that is set, else a ball of 5,120 faces.
#![allow(clippy::print_stdout, clippy::expect_used, reason = "a benchmark prints and may panic")]
#![allow(unreachable_pub, reason = "modules of a program")]

mod distance;
mod exact;
mod floor;
mod options;
mod plain;
mod scenes;

use std::time::Instant;

use pelage_coat::{Background, Coat};
use pelage_render::{Headless, Offscreen, PassTimes, View};
use pelage_tests::{Contender, Finish, Fur, SIZE, Scene, Stage, race};

use floor::{Floor, FullScreen};
use plain::Plain;
use scenes::{Scenes, Textures};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let rounds = arguments.iter().find_map(|a| a.parse().ok()).unwrap_or(20);
    let named = SECTIONS.iter().any(|section| arguments.iter().any(|a| a == section));
    let wanted = |section: &str| !named || arguments.iter().any(|a| a == section);
    let headless = pelage_tests::gpu().expect("an adapter").headless();
    println!("{} at {} × {}, {rounds} rounds", headless.summary().name, SIZE.0, SIZE.1);
    let stages = [1, 4].map(|samples| Stage::new(headless, samples));
    let mut far = Vec::new();
    for model in scenes::models().expect("models") {
        let mut scenes = Scenes::new(&model);
        let start = Instant::now();
        let scene = scenes.whole().expect("a picture");
        if wanted("stages") {
            print_stages(&model.name, &scene, start.elapsed().as_secs_f64() * 1e3);
        }
        let coat = scene.coat().expect("a coat");
        let (view, _) = scene.view(&coat).expect("a view");
        let bench = Bench { headless, stages: &stages, view, rounds };
        if wanted("floors") {
            bench.beside_floors(&coat, 1, &format!("{}, 16 shells", model.name));
            bench.beside_floors(&coat, 4, &format!("{}, 16 shells", model.name));
        }
        if wanted("exact") {
            bench.beside_exact_set(&coat);
        }
        for layers in ["8", "4"].iter().filter(|_| wanted("fewer")) {
            let fewer = scenes.coat(Textures { set: &[("shells.layers", layers)], ..Textures::default() }).expect("a coat");
            bench.beside_floors(&fewer, 1, &format!("{}, {layers} shells", model.name));
        }
        if wanted("far") {
            let levels = scenes.coat(Textures { through: &["LevelsOfDetail"], ..Textures::default() }).expect("a coat");
            far.extend(bench.far(&levels, &coat, &model.name));
        }
        if wanted("options") {
            bench.options(&coat, &mut scenes, &model.name);
        }
    }
    headless.check().expect("no validation error");
    if let Some(file) = arguments.iter().skip_while(|a| *a != "--write").nth(1) {
        let file = pelage_tests::repository().join(file);
        std::fs::write(&file, distance::csv(&far)).expect("a file that can be written");
        println!("\n{}", file.display());
    }
}

/// What can be asked for by name; without names, all.
const SECTIONS: [&str; 6] = ["stages", "floors", "exact", "fewer", "far", "options"];

fn print_stages(name: &str, scene: &Scene, total: f64) {
    println!("\n{name}: from OBJ to picture, cold");
    for entry in scene.trace() {
        println!("{:12} {:16} {:9.1} ms", entry.node.to_string(), entry.kind, entry.ms);
    }
    println!("{:29} {total:9.1} ms", "everything included");
}

/// What all sections share.
pub struct Bench<'a> {
    headless: &'a Headless,
    stages: &'a [Stage; 2],
    view: View,
    rounds: usize,
}

impl Bench<'_> {
    /// For 1 or 4 samples a pixel.
    fn stage(&self, samples: u32) -> &Stage {
        &self.stages[usize::from(samples > 1)]
    }

    /// The same draw as a view of ours.
    fn floor(&self, stage: &Stage, coat: &Coat, view: &View, ours: &Fur) -> Floor {
        let faces = ours.faces(self.headless, stage).expect("the device answers");
        Floor::new(self.headless.device(), self.headless.queue(), stage.target, coat, view, &faces)
    }

    fn race(&self, stage: &Stage, contenders: Vec<Contender<'_>>, to: [usize; 2]) -> Vec<Finish> {
        race(self.headless, stage, contenders, self.rounds, to).expect("the device answers")
    }

    /// Ours beside the floors and the plain renderer.
    fn beside_floors(&self, coat: &Coat, samples: u32, title: &str) {
        let stage = self.stage(samples);
        let (device, queue) = (self.headless.device(), self.headless.queue());
        let fur = Fur::new(self.headless, stage, coat, &self.view).expect("a whole coat");
        let floor = self.floor(stage, coat, &self.view, &fur);
        let plain = Plain::new(device, queue, stage.target, coat, &self.view);
        let ours = Contender::ours(self.headless, stage, &fur, "ours (default)", false).expect("the device answers");
        let count = (ours.fragments.unwrap_or(0) as f64 / f64::from(SIZE.0 * SIZE.1 * samples)).round().max(1.0) as u32;
        let full = FullScreen::new(device, queue, stage.target, coat, count);
        let drawn = ours.triangles;
        let others = [
            Contender::plain(self.headless, stage, "floor: same draw", drawn, |pass| floor.draw(pass)),
            Contender::plain(self.headless, stage, "plain renderer", Some(plain.triangles()), |pass| plain.draw(pass)),
            Contender::plain(self.headless, stage, &format!("{count} full screens"), Some(u64::from(count)), |pass| full.draw(pass)),
        ];
        let contenders = std::iter::once(ours).chain(others.map(|other| other.expect("the device answers"))).collect();
        println!("\n{title}, {samples} samples a pixel");
        print(&self.race(stage, contenders, [1, 2]), ["of same draw", "of plain"]);
        let PassTimes { compute, surface, fins, shells } = self.passes(coat, &self.view, samples);
        let [compute, surface, fins, shells] = [compute, surface, fins, shells].map(Option::unwrap_or_default);
        println!("ours, passes apart: compute {compute:.1} ms, surface {surface:.1}, fins {fins:.1}, shells {shells:.1}");
    }

    /// Ours pass by pass: medians of the device's timestamps, zero where it has none.
    fn passes(&self, coat: &Coat, view: &View, samples: u32) -> PassTimes {
        let offscreen = Offscreen::new(self.headless, SIZE, samples).expect("a target");
        let uploaded = offscreen.upload(coat).expect("a whole coat");
        let background = Background { top: glam::Vec3::splat(0.1), bottom: glam::Vec3::splat(0.1) };
        offscreen.time(&uploaded, view, &background, self.rounds as u32).expect("a frame").passes.unwrap_or_default()
    }

    /// How near what is submitted is to what can be seen.
    fn beside_exact_set(&self, coat: &Coat) {
        let stage = self.stage(1);
        let mut fur = Fur::new(self.headless, stage, coat, &self.view).expect("a whole coat");
        let picked = fur.faces(self.headless, stage).expect("the device answers");
        let unhidden = fur.unhidden_faces(self.headless, stage).expect("the device answers");
        println!(
            "\n{:44} {:>10} {:>10} {:>12} {:>8}",
            "shells' fronts before the depth test", "triangles", "fragments", "of exact set", "missed"
        );
        for (name, faces) in [("every face", &coat.patches.faces), ("ours (default)", &picked), ("ours, hidden left out, too", &unhidden)] {
            let comparison = exact::compare(self.headless, coat, &self.view, faces);
            let exact::Size { triangles, fragments } = comparison.submitted;
            let ratio = fragments as f64 / comparison.exact.fragments as f64;
            println!("{name:44} {triangles:10} {fragments:10} {ratio:12.3} {:8}", comparison.missed);
        }
        let exact::Size { triangles, fragments } = exact::compare(self.headless, coat, &self.view, &[]).exact;
        println!("{:44} {triangles:10} {fragments:10} {:12.3}", "exact visible set", 1.0);
    }
}

/// Prints them under two headings for the ratios.
fn print(finishes: &[Finish], ratios: [&str; 2]) {
    println!("{:44} {:>8} {:>8} {:>14} {:>14} {:>10} {:>10}", "", "least ms", "median", ratios[0], ratios[1], "fragments", "triangles");
    let count = |count: Option<u64>| count.map_or("–".into(), |count| count.to_string());
    for finish in finishes {
        let Finish { name, least, median, ratios, fragments, triangles } = finish;
        let [first, second] = ratios;
        println!("{name:44} {least:8.1} {median:8.1} {first:14.2} {second:14.2} {:>10} {:>10}", count(*fragments), count(*triangles));
    }
}
