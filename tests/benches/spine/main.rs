//! From OBJ to picture, stage by stage, everything cold; then frames at 640 × 480 with 16 shells and fins beside what they are judged by, all in one run and in turn.
//!
//! - The *same draw*: the triangles that ours draws (skin, fins, the shells of the faces that ours picks), blending, depth, sampler, one filtered array fetch a
//!   fragment, no lighting, everything computed ahead. The floor that ours is judged by.
//! - The *full screen*: as many fragments as full-screen rectangles, textured and blended, as context.
//! - The *plain renderer*: every face for every shell, whichever way it faces, and every edge as a fin, lit as ours: what there is to win.
//! - The *exact visible set* of triangles (`exact.rs`), and the fragments that it makes.
//!
//! `cargo bench -p pelage-tests --bench spine`; `-- ROUNDS` for another number of rounds than 20, `-- SECTION …` for some of `stages`,
//! `floors`, `exact`, `fewer`, `far`, `options`. Models: the bunny as shipped, and `t1_bunny_5000` of
//! `$PELAGE_MODELS` where that is set, else a ball of 5,120 faces.
#![allow(clippy::print_stdout, clippy::expect_used, reason = "a benchmark prints and may panic")]
#![allow(unreachable_pub, reason = "modules of a program")]

mod exact;
mod floor;
mod options;
mod plain;
mod race;
mod scenes;
mod stage;

use std::time::Instant;

use pelage_coat::{Background, Camera, Coat};
use pelage_render::{Detail, Headless, Offscreen, Options, PassTimes, Target, View};
use wgpu::TextureFormat;

use floor::{Floor, FullScreen};
use pelage_tests::Scene;
use plain::Plain;
use race::{Contender, Finish, Fur, print, race};
use scenes::{Scenes, Textures};
use stage::{SIZE, Stage};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let rounds = arguments.iter().find_map(|a| a.parse().ok()).unwrap_or(20);
    let named = SECTIONS.iter().any(|section| arguments.iter().any(|a| a == section));
    let wanted = |section: &str| !named || arguments.iter().any(|a| a == section);
    let headless = pelage_tests::gpu().expect("an adapter").headless();
    println!("{} at {} × {}, {rounds} rounds", headless.summary().name, SIZE.0, SIZE.1);
    let stages = [1, 4].map(|samples| Stage::new(headless, Target::new(TextureFormat::Rgba8UnormSrgb, samples)));
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
            bench.far(&levels, &model.name);
        }
        if wanted("options") {
            bench.options(&coat, &mut scenes, &model.name);
        }
    }
    headless.check().expect("no validation error");
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

    fn floor(&self, stage: &Stage, coat: &Coat, faces: &[[u32; 3]]) -> Floor {
        Floor::new(self.headless.device(), self.headless.queue(), stage.target, coat, &self.view, faces)
    }

    /// Ours beside the floors and the plain renderer.
    fn beside_floors(&self, coat: &Coat, samples: u32, title: &str) {
        let stage = self.stage(samples);
        let (device, queue) = (self.headless.device(), self.headless.queue());
        let fur = Fur::new(self.headless, stage, coat, &self.view);
        let floor = self.floor(stage, coat, &fur.faces(self.headless, stage));
        let plain = Plain::new(device, queue, stage.target, coat, &self.view);
        let ours = Contender::ours(self.headless, stage, &fur, "ours (default)", false);
        let count = (ours.fragments.unwrap_or(0) as f64 / f64::from(SIZE.0 * SIZE.1 * samples)).round().max(1.0) as u32;
        let full = FullScreen::new(device, queue, stage.target, coat, count);
        let drawn = ours.triangles;
        let contenders = vec![
            ours,
            Contender::plain(self.headless, stage, "floor: same draw", drawn, |pass| floor.draw(pass)),
            Contender::plain(self.headless, stage, "plain renderer", Some(plain.triangles()), |pass| plain.draw(pass)),
            Contender::plain(self.headless, stage, &format!("{count} full screens"), Some(u64::from(count)), |pass| full.draw(pass)),
        ];
        println!("\n{title}, {samples} samples a pixel");
        print(&race(self.headless, stage, contenders, self.rounds, [1, 2]), ["of same draw", "of plain"]);
        let PassTimes { compute, surface, fins, shells } = self.passes(coat, &self.view, samples);
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
        let mut fur = Fur::new(self.headless, stage, coat, &self.view);
        let picked = fur.faces(self.headless, stage);
        let unhidden = fur.unhidden_faces(self.headless, stage);
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

    /// With distance, at two settings of the level of detail and with all shells.
    fn far(&self, coat: &Coat, name: &str) {
        let stage = self.stage(1);
        println!("\n{name}, far away, by the least pixels between shells");
        println!(
            "{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>10} {:>10} {:>10} {:>14}",
            "times", "pixels", "shells", "level", "least ms", "median", "of all", "fragments", "triangles", "compute alone"
        );
        for times in [1.0, 2.0, 4.0, 8.0, 16.0] {
            let view = View { camera: further(&self.view.camera, times), ..self.view.clone() };
            let settings = [("all", Detail::Level(0.0)), ("0.25", Detail::Spacing(0.25)), ("1", Detail::Spacing(1.0))];
            let views = settings.map(|(pixels, detail)| (pixels, View { options: Options { detail, ..view.options }, ..view.clone() }));
            let furs = views.each_ref().map(|(pixels, view)| (*pixels, Fur::new(self.headless, stage, coat, view)));
            let contenders = furs.iter().map(|(pixels, fur)| Contender::ours(self.headless, stage, fur, pixels, false)).collect();
            let finishes = race(self.headless, stage, contenders, self.rounds, [0, 0]);
            for ((finish, (_, fur)), (_, view)) in finishes.iter().zip(&furs).zip(&views) {
                let Finish { name, least, median, ratios, fragments, triangles } = finish;
                let (shells, level) = (fur.view.shell_count(), fur.view.level());
                let [fragments, triangles] = [fragments, triangles].map(|count| count.unwrap_or(0));
                let compute = self.passes(coat, view, 1).compute;
                println!(
                    "{times:8} {name:>8} {shells:8} {level:8.2} {least:8.1} {median:8.1} {:10.2} {fragments:10} {triangles:10} {compute:14.1}",
                    ratios[0]
                );
            }
        }
    }
}

/// The camera so many times as far from what it looks at.
fn further(camera: &Camera, times: f32) -> Camera {
    Camera { eye: camera.target + times * (camera.eye - camera.target), near: times * camera.near, ..*camera }
}
