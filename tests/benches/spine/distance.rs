//! What a frame costs with distance, by level of detail.

use std::fmt::Write;

use pelage_coat::{Camera, Coat};
use pelage_render::{Detail, Options, View};
use pelage_tests::{Contender, Finish, Fur};

use super::Bench;

/// A frame from so far.
pub struct Far {
    model: String,
    /// Times the distance from which the model fills the picture.
    times: f32,
    /// The least pixels between two shells.
    pixels: String,
    shells: u32,
    level: f32,
    /// The least time, in milliseconds.
    least: f64,
    fragments: u64,
    triangles: u64,
    /// Milliseconds of the compute pass alone, the median.
    compute: f64,
}

/// A line for each, under a heading.
pub fn csv(measured: &[Far]) -> String {
    let mut text = "model,times,pixels,shells,level,least_ms,fragments,triangles,compute_ms\n".to_owned();
    for Far { model, times, pixels, shells, level, least, fragments, triangles, compute } in measured {
        let _ = writeln!(text, "{model},{times:.3},{pixels},{shells},{level:.2},{least:.2},{fragments},{triangles},{compute:.2}");
    }
    text
}

impl Bench<'_> {
    /// With distance, at two settings of the level of detail and with all shells.
    pub fn far(&self, coat: &Coat, model: &str) -> Vec<Far> {
        let stage = self.stage(1);
        println!("\n{model}, far away, by the least pixels between shells");
        println!(
            "{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>10} {:>10} {:>10} {:>14}",
            "times", "pixels", "shells", "level", "least ms", "median", "of all", "fragments", "triangles", "compute alone"
        );
        let mut measured = Vec::new();
        // Half octaves: what lies between two levels shows, too.
        for times in (0..=8).map(|half| 2.0_f32.powf(0.5 * half as f32)) {
            let view = View { camera: further(&self.view.camera, times), ..self.view.clone() };
            let settings = [("all", Detail::Level(0.0)), ("0.25", Detail::Spacing(0.25)), ("1", Detail::Spacing(1.0))];
            let views = settings.map(|(pixels, detail)| (pixels, View { options: Options { detail, ..view.options }, ..view.clone() }));
            let furs = views.each_ref().map(|(pixels, view)| (*pixels, Fur::new(self.headless, stage, coat, view).expect("a whole coat")));
            let ours = |fur, name| Contender::ours(self.headless, stage, fur, name, false).expect("the device answers");
            let finishes = self.race(stage, furs.iter().map(|(pixels, fur)| ours(fur, pixels)).collect(), [0, 0]);
            for ((finish, (_, fur)), (_, view)) in finishes.iter().zip(&furs).zip(&views) {
                let Finish { name, least, median, ratios, fragments, triangles } = finish;
                let (shells, level) = (fur.view.shell_count(), fur.view.level());
                let [fragments, triangles] = [fragments, triangles].map(|count| count.unwrap_or(0));
                let compute = self.passes(coat, view, 1).compute;
                println!(
                    "{times:8.2} {name:>8} {shells:8} {level:8.2} {least:8.1} {median:8.1} {:10.2} {fragments:10} {triangles:10} {compute:14.1}",
                    ratios[0]
                );
                let (model, pixels) = (model.to_owned(), name.clone());
                measured.push(Far { model, times, pixels, shells, level, least: *least, fragments, triangles, compute });
            }
        }
        measured
    }
}

/// The camera so many times as far from what it looks at.
fn further(camera: &Camera, times: f32) -> Camera {
    Camera { eye: camera.target + times * (camera.eye - camera.target), near: times * camera.near, ..*camera }
}
