//! Grows a few kinds of hair and prints what came of it.
//!
//! `cargo run --release -p pelage-strand --example statistics`

#![allow(clippy::print_stdout, reason = "an example that prints a table")]

use pelage_strand::{GrowSettings, Style, grow};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{:>10} {:>8} {:>8} {:>8} {:>12} {:>10}", "style", "strands", "points", "height", "mean length", "bytes");
    let styles = [
        ("straight", Style::Straight),
        ("wavy", Style::Wavy { amplitude: 0.02857, waves: 2.0 }),
        ("curly", Style::Curly { radius: 0.05714, turns: 2.0 }),
        ("zigzag", Style::Zigzag { amplitude: 0.02857, waves: 3.0 }),
        ("woolly", Style::Woolly { radius: 0.08571, turns: 3.0, irregularity: 0.7 }),
    ];
    for (name, style) in styles {
        let hair = grow(&GrowSettings { style, ..GrowSettings::default() })?;
        let mean = hair.strands().map(|strand| strand.arc_length()).sum::<f64>() / hair.strand_count() as f64;
        println!(
            "{name:>10} {:>8} {:>8} {:>8.4} {mean:>12.4} {:>10}",
            hair.strand_count(),
            hair.point_count(),
            hair.height(),
            hair.byte_size()
        );
    }
    Ok(())
}
