//! The bunny as saved does not pop as the camera turns about it by small steps.
#![allow(clippy::print_stdout, reason = "how even the steps are")]

use std::sync::Arc;

use pelage_nodes::Picture;
use pelage_tests::{Error, Scene};

/// The mean change of a byte from each picture to the next, of 255.
fn changes(pictures: &[Arc<Picture>]) -> Vec<f64> {
    let change = |a: &Picture, b: &Picture| {
        let sum: f64 = a.rgba.iter().zip(&b.rgba).map(|(&a, &b)| f64::from(a.abs_diff(b))).sum();
        sum / a.rgba.len() as f64
    };
    pictures.windows(2).map(|pair| change(&pair[0], &pair[1])).collect()
}

/// The largest of them, and the median.
fn largest_and_median(mut changes: Vec<f64>) -> (f64, f64) {
    changes.sort_by(f64::total_cmp);
    (changes[changes.len() - 1], changes[changes.len() / 2])
}

#[test]
fn the_bunny_does_not_pop_as_the_camera_turns() -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let mut turned = |parts: &[(&str, &str)]| {
        let at = |step: u32| {
            let azimuth = format!("{}", 30.0 + 0.25 * f64::from(step));
            let mut set = vec![("camera.azimuth", azimuth.as_str()), ("picture.size", "(320, 240)")];
            set.extend(parts);
            Scene::evaluate_with(&mut evaluator, "bunny", &set)?.picture()
        };
        Ok::<_, Error>(largest_and_median(changes(&(0..=24).map(at).collect::<Result<Vec<_>, _>>()?)))
    };
    for (what, parts) in [("all", &[][..]), ("fins alone", &[("picture.shells", "false")])] {
        let (largest, median) = turned(parts)?;
        println!("{what}: a quarter of a degree changes {median:.3} of 255, at most {:.2} times as much", largest / median);
        assert!(largest <= 2.0 * median, "{what}: {largest}, {median}");
    }
    Ok(())
}
