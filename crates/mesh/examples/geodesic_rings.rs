//! Draws rings of equal distance along a torus, unrolled: around the ring from left to right, around the tube from top to bottom.
//!
//! `cargo run -p pelage-mesh --example geodesic_rings`
#![allow(clippy::print_stdout, reason = "the example's output")]

use std::error::Error;

use pelage_mesh::{Geodesics, VertexId, torus};

const AROUND: u32 = 96;
const TUBE: u32 = 24;

fn main() -> Result<(), Box<dyn Error>> {
    let ring = torus(1.0, 0.4, AROUND, TUBE)?;
    let mut geodesics = Geodesics::on(&ring);
    let source = VertexId(AROUND * TUBE / 2 + AROUND / 2);
    let fast = geodesics.distances(&[source.into()], f64::INFINITY)?.to_vec(ring.positions().len());
    let exact = geodesics.exact_distances(&[source.into()], f64::INFINITY)?.to_vec(ring.positions().len());
    for row in 0..TUBE {
        let letter = |column: u32| {
            let distance = fast[(row * AROUND + column) as usize];
            if distance == 0.0 { 'O' } else { [' ', '.', 'o', '#'][(distance / 0.3) as usize % 4] }
        };
        println!("{}", (0..AROUND).map(letter).collect::<String>());
    }
    let farthest = exact.iter().copied().fold(0.0, f64::max);
    let error = fast.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("farthest {farthest:.4}; the fast distance is off by at most {:.2} % of it", 100.0 * error / farthest);
    let brush = geodesics.distances(&[source.into()], 0.2)?;
    println!("a brush of radius 0.2 reaches {} of {} vertices", brush.nearest_first().len(), ring.positions().len());
    Ok(())
}
