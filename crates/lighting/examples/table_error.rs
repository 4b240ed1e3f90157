//! Prints how far each kind of lighting table is from the exact hair lighting.
#![allow(clippy::print_stdout, reason = "an example prints")]

use pelage_lighting::{Axis, HairLighting, LightingTable, TableError, TableLayout};

fn main() -> Result<(), TableError> {
    println!("{:>5} {:>8} {:>8} {:>4} {:>4} {:>12} {:>12}", "size", "u by", "v by", "Pd", "Ps", "diffuse", "specular");
    for (diffuse_power, specular_power) in [(1.0, 64.0), (4.8, 24.0)] {
        let lighting = HairLighting { diffuse_power, specular_power, ..HairLighting::default() };
        for size in [32, 64, 256] {
            for (u, v) in
                [(Axis::Cosine, Axis::Cosine), (Axis::Cosine, Axis::Angle), (Axis::Angle, Axis::Cosine), (Axis::Angle, Axis::Angle)]
            {
                let error = LightingTable::new(&lighting, TableLayout { size, u, v })?.factor_error(&lighting);
                let (u, v) = (format!("{u:?}"), format!("{v:?}"));
                println!("{size:>5} {u:>8} {v:>8} {diffuse_power:>4} {specular_power:>4} {:>12.6} {:>12.6}", error.diffuse, error.specular);
            }
        }
    }
    Ok(())
}
