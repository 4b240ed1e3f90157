//! Tiles a model, or a rounded die without one, and prints what the tiling is worth.
//!
//! `cargo run --release -p pelage-patch --example tile -- MODEL.obj [TILE_FRACTION [PATCH_EXTENT [SEED]]]`
#![allow(clippy::print_stdout, reason = "printing is what this example does")]

use std::error::Error;
use std::time::Instant;

use glam::DVec3;
use pelage_field::DirectionField;
use pelage_patch::{Settings, grow};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mesh = match arguments.next() {
        Some(path) => pelage_mesh::read_obj(path.as_ref())?.mesh,
        None => pelage_mesh::rounded_die(2.0, 0.3, 11)?,
    };
    let mut settings = Settings::for_mesh(&mesh);
    if let Some(fraction) = arguments.next() {
        settings.tile_side = fraction.parse::<f64>()? * mesh.diameter();
    }
    if let Some(extent) = arguments.next() {
        settings.patch_extent = extent.parse()?;
    }
    if let Some(seed) = arguments.next() {
        settings.seed = seed.parse()?;
    }
    let combed = DirectionField::toward(&mesh, DVec3::new(0.0, -0.3, -1.0))?;
    for (kind, directions) in [("along a field", Some(&combed)), ("isotropic", None)] {
        let start = Instant::now();
        let tiling = grow(&mesh, directions, &settings)?;
        println!("{kind}: {} faces in {:.1} ms", mesh.topology().face_count(), start.elapsed().as_secs_f64() * 1e3);
        println!("{:#?}", tiling.quality(&mesh, directions));
    }
    Ok(())
}
