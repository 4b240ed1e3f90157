//! Prints how far each kind of lighting table is from the exact hair lighting: each factor, and the finished light in the default colours.
//!
//! `cargo run -p pelage-lighting --example table_error`
#![allow(clippy::print_stdout, reason = "an example prints")]

use pelage_lighting::{Axis, HairLighting, LightingTable, TableError, TableLayout};

fn main() -> Result<(), TableError> {
    let head = ["diffuse", "rms", "specular", "rms", "light", "rms"].map(|name| format!("{name:>10}")).join("");
    println!("{:>5} {:>8} {:>8} {:>4} {:>4}{head}", "size", "u by", "v by", "Pd", "Ps");
    for (diffuse_power, specular_power) in [(1.0, 64.0), (4.8, 24.0)] {
        let lighting = HairLighting { diffuse_power, specular_power, ..HairLighting::default() };
        for size in [32, 64, 256] {
            for (u, v) in
                [(Axis::Cosine, Axis::Cosine), (Axis::Cosine, Axis::Angle), (Axis::Angle, Axis::Cosine), (Axis::Angle, Axis::Angle)]
            {
                let layout = TableLayout { size, u, v };
                let table = LightingTable::new(&lighting, layout)?;
                let (factors, light) = (table.factor_error(&lighting), table.colour_error(&lighting));
                let errors =
                    [factors.diffuse, factors.specular, light].map(|error| format!("{:>10.5}{:>10.6}", error.largest, error.rms)).join("");
                let name = if layout == TableLayout::PAPER {
                    " the paper's"
                } else if layout == TableLayout::default() {
                    " the default"
                } else {
                    ""
                };
                let (u, v) = (format!("{u:?}"), format!("{v:?}"));
                println!("{size:>5} {u:>8} {v:>8} {diffuse_power:>4} {specular_power:>4}{errors}{name}");
            }
        }
    }
    Ok(())
}
