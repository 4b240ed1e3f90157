//! What each setting does to the tilings of the models named: least and greatest over the models, along a field.
//!
//! `cargo run --release -p pelage-patch --example settings -- MODEL.obj…`
#![allow(clippy::print_stdout, reason = "printing is what this example does")]

use std::error::Error;

use glam::DVec3;
use pelage_field::DirectionField;
use pelage_mesh::Mesh;
use pelage_patch::{Quality, Settings, grow};

/// A change to the defaults, with its name.
type Change = (&'static str, fn(&mut Settings));

const CHANGES: &[Change] = &[
    ("defaults", |_| {}),
    ("alignment 1e6", |settings| settings.alignment = 1e6),
    ("patch_extent 1.4", |settings| settings.patch_extent = 1.4),
    ("patch_extent 3", |settings| settings.patch_extent = 3.0),
    ("max_stretch 1.5", |settings| settings.max_stretch = 1.5),
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut meshes = Vec::new();
    for path in std::env::args().skip(1) {
        meshes.push(pelage_mesh::read_obj(path.as_ref())?.mesh);
    }
    if meshes.is_empty() {
        meshes.push(pelage_mesh::rounded_die(2.0, 0.3, 11)?);
    }
    println!("{:18} {:>11} {:>16} {:>14} {:>15}", "", "patches", "of three or less", "mean angle, °", "median stretch");
    for (name, change) in CHANGES {
        let qualities = meshes.iter().map(|mesh| quality(mesh, *change)).collect::<Result<Vec<_>, _>>()?;
        let span = |of: fn(&Quality) -> f64| {
            let ends = |(low, high): (f64, f64), q: &Quality| (low.min(of(q)), high.max(of(q)));
            qualities.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends)
        };
        let (patches, tiny) = (span(|q| q.patch_count as f64), span(|q| q.tiny_patch_count as f64));
        let (angle, stretch) = (span(|q| q.misalignment_deg_mean.unwrap_or(0.0)), span(|q| q.stretch_p50));
        println!(
            "{name:18} {:>5} {:>5} {:>9} {:>6} {:>7.1} {:>6.1} {:>8.3} {:>6.3}",
            patches.0, patches.1, tiny.0, tiny.1, angle.0, angle.1, stretch.0, stretch.1
        );
    }
    Ok(())
}

fn quality(mesh: &Mesh, change: fn(&mut Settings)) -> Result<Quality, Box<dyn Error>> {
    let combed = DirectionField::toward(mesh, DVec3::new(0.0, -0.3, -1.0))?;
    let mut settings = Settings::for_mesh(mesh);
    change(&mut settings);
    Ok(grow(mesh, Some(&combed), &settings)?.quality(mesh, Some(&combed)))
}
