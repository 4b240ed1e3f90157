//! What a frame costs with distance, by level of detail.

use std::fmt::Write;

use pelage_coat::{Camera, Coat};
use pelage_render::{Detail, Options, View};
use pelage_tests::{Contender, Finish, Fur};

use super::Bench;
use super::floor::Floor;

/// A frame from so far.
pub struct Far {
    model: String,
    /// Times the distance from which the model fills the picture.
    times: f32,
    /// The least pixels between two shells, or what is drawn instead.
    pixels: &'static str,
    shells: u32,
    level: f32,
    /// Its time over that of all shells from once the distance, the median of the rounds.
    ratio: f64,
    /// The least time, in milliseconds.
    least: f64,
    fragments: u64,
    triangles: u64,
    /// Milliseconds of the compute pass alone, the median.
    compute: f64,
}

impl Far {
    /// What a race found out.
    fn of(model: &str, times: f32, pixels: &'static str, finish: &Finish) -> Self {
        Self {
            model: model.to_owned(),
            times,
            pixels,
            shells: 0,
            level: 0.0,
            ratio: finish.ratios[0],
            least: finish.least,
            fragments: finish.fragments.unwrap_or(0),
            triangles: finish.triangles.unwrap_or(0),
            compute: 0.0,
        }
    }
}

/// A table, with the time of all shells over that of the same draw.
fn print(model: &str, measured: &[Far]) {
    println!("\n{model}, far away, by the least pixels between shells; times over the first, and over the same draw as with all shells");
    println!(
        "{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>10} {:>10} {:>14}",
        "times", "pixels", "shells", "level", "of first", "of floor", "least ms", "fragments", "triangles", "compute alone"
    );
    for Far { times, pixels, shells, level, ratio, least, fragments, triangles, compute, .. } in measured {
        let floor = measured.iter().find(|far| far.pixels == FLOOR && far.times == *times).map_or(f64::NAN, |far| ratio / far.ratio);
        println!(
            "{times:8.2} {pixels:>8} {shells:8} {level:8.2} {ratio:8.3} {floor:8.2} {least:8.1} {fragments:10} {triangles:10} {compute:14.1}"
        );
    }
}

/// A line for each, under a heading.
pub fn csv(measured: &[Far]) -> String {
    let mut text = "model,times,pixels,shells,level,of_nearest,least_ms,fragments,triangles,compute_ms\n".to_owned();
    for Far { model, times, pixels, shells, level, ratio, least, fragments, triangles, compute } in measured {
        let _ =
            writeln!(text, "{model},{times:.3},{pixels},{shells},{level:.2},{ratio:.4},{least:.2},{fragments},{triangles},{compute:.2}");
    }
    text
}

/// The least pixels between two shells, and with all of them.
const SETTINGS: [(&str, Detail); 3] = [("all", Detail::Level(0.0)), ("0.25", Detail::Spacing(0.25)), ("1", Detail::Spacing(1.0))];

/// What the same draw as with all shells is called.
const FLOOR: &str = "floor";

impl Bench<'_> {
    /// With distance, at two settings of the level of detail and with all shells, and the same draw as that: all in turn, so that a machine's other work is
    /// unfair to none. `finest` is the same coat without levels.
    pub fn far(&self, coat: &Coat, finest: &Coat, model: &str) -> Vec<Far> {
        let stage = self.stage(1);
        // Half octaves: what lies between two levels shows, too.
        let distances: Vec<f32> = (0..=8).map(|half| 2.0_f32.powf(0.5 * half as f32)).collect();
        let views: Vec<(f32, &'static str, View)> =
            distances.iter().flat_map(|&times| SETTINGS.map(|(pixels, detail)| (times, pixels, self.view_from(times, detail)))).collect();
        let fur = |view| Fur::new(self.headless, stage, coat, view).expect("a whole coat");
        let furs: Vec<Fur> = views.iter().map(|(.., view)| fur(view)).collect();
        let floors: Vec<Floor> =
            furs.iter().zip(&views).step_by(SETTINGS.len()).map(|(fur, (.., view))| self.floor(stage, finest, view, fur)).collect();
        let ours = |fur, name: &str| Contender::ours(self.headless, stage, fur, name, false).expect("the device answers");
        let same_draw = |(floor, fur)| {
            let (floor, fur): (&Floor, &Fur) = (floor, fur);
            let triangles = Some(fur.triangles(self.headless).expect("the device answers"));
            Contender::plain(self.headless, stage, FLOOR, triangles, move |pass| floor.draw(pass)).expect("the device answers")
        };
        let mut contenders: Vec<Contender<'_>> = furs.iter().zip(&views).map(|(fur, (_, pixels, _))| ours(fur, pixels)).collect();
        contenders.extend(floors.iter().zip(furs.iter().step_by(SETTINGS.len())).map(same_draw));
        let mut finishes = self.race(stage, contenders, [0, 0]);
        let floors = finishes.split_off(furs.len());
        let drawn = |((finish, fur), (times, pixels, view)): ((Finish, &Fur), &(f32, &'static str, View))| Far {
            shells: fur.view.shell_count(),
            level: fur.view.level(),
            compute: self.passes(coat, view, 1).compute.unwrap_or_default(),
            ..Far::of(model, *times, pixels, &finish)
        };
        let mut measured: Vec<Far> = finishes.into_iter().zip(&furs).zip(&views).map(drawn).collect();
        measured.extend(
            floors
                .iter()
                .zip(&distances)
                .map(|(finish, &times)| Far { shells: coat.shells.layers() - 1, ..Far::of(model, times, FLOOR, finish) }),
        );
        print(model, &measured);
        measured
    }

    fn view_from(&self, times: f32, detail: Detail) -> View {
        View { camera: further(&self.view.camera, times), options: Options { detail, ..self.view.options }, ..self.view.clone() }
    }
}

/// The camera so many times as far from what it looks at.
fn further(camera: &Camera, times: f32) -> Camera {
    Camera { eye: camera.target + times * (camera.eye - camera.target), near: times * camera.near, ..*camera }
}
