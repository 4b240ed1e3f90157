//! Tears a ball as files are torn, mends it, and says what it took: `cargo run -p pelage-mesh --example mend`
#![allow(clippy::print_stdout, reason = "the example's output")]

use std::error::Error;

use pelage_mesh::{RepairSettings, Soup, Summary, repair, sphere};

fn main() -> Result<(), Box<dyn Error>> {
    let ball = sphere(1.0, 8)?;
    // Every face has corners of its own, one in ten is wound the other way, and a quad with a repeated corner lies on one of them.
    let mut positions = Vec::new();
    let mut polygons: Vec<Vec<u32>> = Vec::new();
    for face in ball.faces() {
        let first = positions.len() as u32;
        positions.extend(face.positions());
        polygons.push(if face.index() % 10 == 0 { vec![first, first + 2, first + 1] } else { vec![first, first + 1, first + 2] });
    }
    polygons.push(vec![0, 1, 1, 2]);

    let repaired = repair(Soup::from_polygons(positions, polygons), &RepairSettings::default())?;
    println!("{}", repaired.report);
    let (before, after) = (Summary::of(&ball), Summary::of(&repaired.mesh));
    println!("{} vertices and {} faces, as before: {} and {}", after.vertices, after.faces, before.vertices, before.faces);
    Ok(())
}
