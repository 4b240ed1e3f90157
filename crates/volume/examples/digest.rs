#![allow(missing_docs, clippy::all, clippy::print_stdout, reason = "x")]
use pelage_strand::{GrowSettings, Style, grow};
use pelage_volume::*;
use std::hash::{DefaultHasher, Hash, Hasher};
fn main() {
    let d = GrowSettings::default();
    let k = SCALE;
    for (n, s) in [
        ("straight", GrowSettings { style: Style::Straight, ..d }),
        ("default", GrowSettings { style: Style::Wavy { amplitude: 0.02286 * k(d.height), waves: 1.2 }, ..d }),
        ("old default", GrowSettings { style: Style::Wavy { amplitude: OLD, waves: 1.2 }, ..d }),
        ("curly", GrowSettings { style: Style::Curly { radius: 0.07143 * k(0.42), turns: 1.6 }, height: 0.42, clump: 0.5, steps: 40, ..d }),
    ] {
        let t = grow(&s).unwrap();
        let mut h = DefaultHasher::new();
        for s in t.strands() {
            for p in s.points {
                for c in p {
                    c.to_bits().hash(&mut h);
                }
            }
            for r in s.radii {
                r.to_bits().hash(&mut h);
            }
            for c in s.root_colour.iter().chain(&s.tip_colour) {
                c.to_bits().hash(&mut h);
            }
        }
        let stack = sample_shells(&t, &ShellSettings { directions: Some(1.0), ..Default::default() }).unwrap();
        let mut g = DefaultHasher::new();
        for m in &stack.mips {
            m.texels.hash(&mut g);
        }
        for m in stack.directions.iter().flatten() {
            m.texels.hash(&mut g);
        }
        let fin = sample_fin(&t, &FinSettings::default()).unwrap();
        for m in &fin.mips {
            m.texels.hash(&mut g);
        }
        println!("{n}: strands {:016x} textures {:016x}", h.finish(), g.finish());
    }
}
const SCALE: fn(f64) -> f64 = |_| 1.0;
const OLD: f64 = 0.008 / 0.35;
