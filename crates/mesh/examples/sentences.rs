//! Reads a surface in sentences: `cargo run -p pelage-mesh --example sentences`
#![allow(clippy::print_stdout, reason = "the example's output")]

use std::error::Error;

use glam::DVec3;
use pelage_mesh::{Edge, Mesh, Vertex, VertexId, rounded_die, torus};

fn main() -> Result<(), Box<dyn Error>> {
    let die = rounded_die(2.0, 0.25, 8)?;
    let vertex = die.vertex(VertexId(0));
    println!("vertex {:?} at {:.2} has {} neighbours and normal {:.2}", vertex.id(), vertex.position(), vertex.valence(), vertex.normal());
    for (distance, ring) in vertex.rings().take(3).enumerate() {
        println!("  ring {}: {} vertices", distance + 1, ring.len());
    }
    let steepest = vertex.edges().max_by(|a, b| a.dihedral_angle().unwrap_or(0.0).total_cmp(&b.dihedral_angle().unwrap_or(0.0)));
    if let Some(edge) = steepest {
        println!("  its sharpest edge turns by {:.1}°", edge.dihedral_angle().unwrap_or(0.0).to_degrees());
    }
    let ridges = die.edges().filter(|edge| edge.dihedral_angle().is_some_and(|angle| angle > 0.1)).map(Edge::length).sum::<f64>();
    println!("edges that turn by more than 0.1 are {ridges:.2} long together");

    let open = half_of(&torus(1.0, 0.4, 32, 16)?)?;
    for piece in open.components().iter() {
        println!("piece {}: {} faces, χ {}, genus {}", piece.index(), piece.faces().len(), piece.euler_characteristic(), piece.genus());
        for walk in piece.boundary_loops() {
            println!("  a boundary of {} edges, {:.3} long, that turns by {:.3}", walk.edge_count(), walk.length(), walk.turning());
        }
        let curvature: f64 = piece.vertices().map(Vertex::angle_defect).sum();
        println!("  angles miss {:.3} = 2π · {} (Gauss and Bonnet)", curvature, piece.euler_characteristic());
    }
    Ok(())
}

/// The faces whose middle is at positive x.
fn half_of(mesh: &Mesh) -> Result<Mesh, Box<dyn Error>> {
    let kept = mesh.faces().filter(|face| face.centre().dot(DVec3::X) > 0.0);
    let triangles: Vec<[u32; 3]> = kept.map(|face| face.vertices().map(|vertex| vertex.id().0)).collect();
    Ok(Mesh::from_triangles(mesh.positions().to_vec(), &triangles)?)
}
