//! Combs a model, an OBJ file or a torus, from head to tail and against it, and lists where the field cannot be continuous:
//! `cargo run -p pelage-field --example comb -- model.obj`
#![allow(clippy::print_stdout, reason = "the example's output")]

use std::error::Error;
use std::path::Path;

use glam::DVec3;
use pelage_field::{Constraint, DirectionField, Flow, PointConstraint, singularities};
use pelage_mesh::{Mesh, read_obj, torus};

fn main() -> Result<(), Box<dyn Error>> {
    let mesh = match std::env::args_os().nth(1) {
        Some(path) => read_obj(Path::new(&path))?.mesh,
        None => torus(1.0, 0.4, 80, 48)?,
    };
    let toward = DirectionField::toward(&mesh, DVec3::X)?;
    report("toward +x", &mesh, &toward)?;
    report("the same, smoothed 20 rounds", &mesh, &toward.smoothed(&mesh, 20)?)?;

    let (low, high) = mesh.bounds().ok_or("the model has no faces")?;
    let constraints = [Constraint { at: low, along: DVec3::X }, Constraint { at: high, along: DVec3::NEG_Y }];
    report("two constraints", &mesh, &DirectionField::from_constraints(&mesh, &constraints, &[], 0.2)?)?;
    let crown = PointConstraint { at: DVec3::new(0.0, high.y, 0.0), flow: Flow::Turned(-1.0) };
    report("and a crown", &mesh, &DirectionField::from_constraints(&mesh, &constraints, &[crown], 0.2)?)
}

fn report(name: &str, mesh: &Mesh, field: &DirectionField) -> Result<(), Box<dyn Error>> {
    let found = singularities(mesh, field)?;
    let sum: i32 = found.iter().map(|s| s.index).sum();
    println!("{name}: {} singularities, their indices add up to {sum} (χ = {})", found.len(), mesh.topology().euler_characteristic());
    for singularity in found.iter().take(8) {
        println!("  index {:+} at {:.3}", singularity.index, mesh.face(singularity.face).centre());
    }
    Ok(())
}
