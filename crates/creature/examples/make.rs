//! Makes a creature and writes it as a Wavefront OBJ file.
//!
//! `cargo run -p pelage-creature --example make -- cat 5000 cat.obj [seed [variation]]`
#![allow(clippy::print_stdout, reason = "a program for a person at a terminal")]

use std::error::Error;
use std::io::Write as _;

use pelage_creature::{Creature, Species};
use pelage_mesh::{Mesh, Summary};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, faces, path, rest @ ..] = arguments.as_slice() else {
        return Err("usage: make SPECIES FACES OUT.obj [SEED [VARIATION]]".into());
    };
    let known = Species::ALL.map(Species::name).join(", ");
    let species = Species::ALL.into_iter().find(|species| species.name() == name).ok_or(format!("no {name}; there are {known}"))?;
    let seed = rest.first().map_or(Ok(0), |seed| seed.parse())?;
    let variation = rest.get(1).map_or(Ok(if rest.is_empty() { 0.0 } else { 0.1 }), |variation| variation.parse())?;
    let creature = Creature::new(&species.plan().individual(seed, variation)?, faces.parse()?)?;
    write_obj(creature.mesh(), std::fs::File::create(path)?)?;
    println!("{path}: {:#?}", Summary::of(creature.mesh()));
    Ok(())
}

fn write_obj(mesh: &Mesh, file: std::fs::File) -> std::io::Result<()> {
    let mut out = std::io::BufWriter::new(file);
    for p in mesh.positions() {
        writeln!(out, "v {} {} {}", p.x, p.y, p.z)?;
    }
    for [a, b, c] in mesh.topology().triangles() {
        writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1)?;
    }
    out.flush()
}
