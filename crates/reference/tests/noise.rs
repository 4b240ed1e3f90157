//! Noise falls with samples, and no thread changes a byte.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use glam::Vec3;
use pelage_coat::{Camera, Irradiance, Light, Lights};
use pelage_lighting::Shading;
use pelage_reference::{Image, Laying, Scene, Settings, Shadows, View, quiet};
use pelage_strand::{GrowSettings, StrandTile, Undercoat, grow};
use rayon::ThreadPoolBuilder;
use support::{rmse, square};

fn fur() -> StrandTile {
    grow(&GrowSettings { count: 120, undercoat: Undercoat { count: 100, ..Undercoat::default() }, ..GrowSettings::default() }).unwrap()
}

fn view() -> View {
    let camera = Camera { eye: Vec3::new(0.5, -1.5, 1.2), target: Vec3::ZERO, up: Vec3::Z, field_of_view: 0.5, near: 0.01 };
    let sun = Light { direction: Vec3::new(0.6, 0.0, 0.8), colour: Vec3::ONE };
    let lights = Lights { directional: vec![sun], ambient: Irradiance::hemisphere(Vec3::splat(0.4), Vec3::splat(0.2)) };
    View { camera, lights, shading: Shading::default() }
}

#[test]
fn noise_falls_at_least_with_the_root_of_the_samples() {
    let (coat, tile) = (square(3, 3.0), fur());
    let scene = Scene::new(&coat, &tile, &Laying::default()).unwrap();
    for shadows in [Shadows::Formula, Shadows::Rays] {
        let image = |samples, seed| scene.render(&view(), &Settings { size: (24, 24), samples, seed, shadows }, &quiet).unwrap();
        let truth = image(2048, 99);
        let errors: Vec<f64> = [1, 4, 16, 64].map(|samples| rmse(&image(samples, 7), &truth)).into();
        println!("{shadows:?}: {errors:?}");
        for pair in errors.windows(2) {
            // Four times the samples halve it; a tenth is for the noise of the noise.
            assert!(pair[1] <= 0.5 * pair[0], "{errors:?}");
        }
        // And the means agree: no sample is favoured.
        let mean = |image: &Image| image.pixels.iter().map(|p| f64::from(p[0])).sum::<f64>() / image.pixels.len() as f64;
        assert!((mean(&image(16, 3)) - mean(&truth)).abs() < 2e-3);
    }
}

#[test]
fn threads_change_no_byte() {
    let (mut coat, tile) = (square(6, 2.3), fur());
    // Some of the fur so short that chance decides.
    for (v, offset) in coat.surface.offsets.iter_mut().enumerate() {
        *offset *= if v % 3 == 0 { 0.004 } else { 1.0 };
    }
    let made_by = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let scene = Scene::new(&coat, &tile, &Laying::default()).unwrap();
            let settings = Settings { size: (70, 45), samples: 4, shadows: Shadows::Rays, ..Settings::default() };
            (scene.counts(), scene.curves().unwrap(), scene.render(&view(), &settings, &quiet).unwrap())
        })
    };
    let one = made_by(1);
    assert!(one.2.shadow_rays > 1000);
    for threads in [2, 3, 8] {
        let other = made_by(threads);
        assert_eq!(one.0, other.0);
        assert!(one.1 == other.1 && one.2 == other.2, "{threads} threads");
    }
    // Another seed is another picture.
    let scene = Scene::new(&coat, &tile, &Laying::default()).unwrap();
    let settings = Settings { size: (70, 45), samples: 4, shadows: Shadows::Rays, seed: 2 };
    assert!(scene.render(&view(), &settings, &quiet).unwrap() != one.2);
}
