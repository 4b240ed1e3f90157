//! Describes an OBJ file, or a torus if none is given:
//! `cargo run -p pelage-mesh --example describe -- model.obj`
#![allow(clippy::print_stdout, reason = "the example's output")]

use std::error::Error;
use std::path::Path;

use pelage_mesh::{Summary, read_obj, torus};

fn main() -> Result<(), Box<dyn Error>> {
    let mesh = match std::env::args_os().nth(1) {
        Some(path) => {
            let import = read_obj(Path::new(&path))?;
            println!("repairs: {}", import.repairs);
            import.notes.iter().for_each(|note| println!("note: {note}"));
            import.mesh
        }
        None => torus(1.0, 0.4, 48, 24)?,
    };
    let summary = Summary::of(&mesh);
    println!("{summary:#?}");
    println!("closed: {}; texture coordinates: {}", summary.is_closed(), mesh.texture_coordinates().is_some());
    for (number, walk) in mesh.boundary_loops().into_iter().enumerate() {
        println!("boundary loop {number}: {} edges, {:.4} long", walk.edge_count(), walk.length());
    }
    Ok(())
}
