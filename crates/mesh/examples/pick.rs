//! Picks points of a surface with rays and closest points, and draws what the rays see: `cargo run -p pelage-mesh --example pick`
#![allow(clippy::print_stdout, reason = "the example's output")]

use std::error::Error;

use glam::DVec3;
use pelage_mesh::{Ray, SpatialIndex, torus};

fn main() -> Result<(), Box<dyn Error>> {
    let ring = torus(1.0, 0.4, 64, 32)?;
    let index = SpatialIndex::of(&ring);
    let eye = DVec3::new(0.0, 3.0, 2.0);
    let (right, up) = (DVec3::X, DVec3::new(0.0, 2.0, -3.0).normalize());
    for row in 0..24 {
        let mut line = String::new();
        for column in 0..72 {
            let (x, y) = (f64::from(column) / 36.0 - 1.0, 1.0 - f64::from(row) / 12.0);
            let ray = Ray::new(eye, 1.6 * x * right + 1.1 * y * up - eye)?;
            let shade =
                index.first_hit(&ray).map_or(0.0, |hit| ring.face(hit.point.face).normal().dot(DVec3::new(0.6, 0.7, 0.4)).max(0.05));
            line.push([' ', '.', ':', '-', '=', '+', '*', '#', '@'][(shade * 8.0).ceil().min(8.0) as usize]);
        }
        println!("{line}");
    }
    let click = Ray::new(eye, DVec3::new(1.0, 0.4, 0.0) - eye)?;
    for hit in index.hits(&click) {
        println!("the ray meets face {} from its {:?} side after {:.4}", hit.point.face.0, hit.side, hit.distance);
    }
    for radius in [0.5, 0.62, 1.2] {
        println!("{} faces are within {radius} of the ring's middle", index.within(DVec3::ZERO, radius).len());
    }
    let nearest = index.closest_point(DVec3::new(2.0, 1.0, 0.0)).ok_or("no faces")?;
    println!("closest to (2, 1, 0) is {:.4}, {:.4} away", nearest.position, nearest.distance);
    Ok(())
}
