//! How much memory import takes at its peak, against the size of the file.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use std::fmt::Write;

use peak_alloc::PeakAlloc;
use pelage_mesh::{parse_obj, torus};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// What numerics ask for: so many bytes for each byte of the file.
const MOST: f64 = 50.0;

/// A ring of 80,000 triangles: as they are; with texture coordinates; each with vertices of its own and every tenth turned; in as few digits as possible.
fn files() -> [(&'static str, String); 4] {
    let ring = torus(1.0, 0.4, 200, 200).unwrap();
    let triangles: Vec<[u32; 3]> = ring.topology().triangles().map(|face| face.map(|v| v + 1)).collect();
    let vertices = ring.positions().iter().fold(String::new(), |mut text, p| {
        writeln!(text, "v {:.6} {:.6} {:.6}", p.x, p.y, p.z).unwrap();
        text
    });
    let (mut plain, mut textured, mut torn, mut short) = (vertices.clone(), vertices, String::new(), String::new());
    for p in ring.positions() {
        writeln!(textured, "vt {:.4} {:.4}", p.x, p.y).unwrap();
    }
    for (face, [a, b, c]) in triangles.iter().enumerate() {
        writeln!(plain, "f {a} {b} {c}").unwrap();
        writeln!(textured, "f {a}/{a} {b}/{b} {c}/{c}").unwrap();
        for v in [a, b, c] {
            let p = ring.positions()[*v as usize - 1];
            writeln!(torn, "v {:.6} {:.6} {:.6}", p.x, p.y, p.z).unwrap();
        }
        torn += if face % 10 == 0 { "f -1 -2 -3\n" } else { "f -3 -2 -1\n" };
        // A fan of fans: the shortest a file of faces can be.
        writeln!(short, "v {} {} 1\nv {} {} 1\nv 0 0 0\nf -1 -2 -3", face % 300, face / 300, face % 300 + 1, face / 300).unwrap();
    }
    [("plain", plain), ("textured", textured), ("torn", torn), ("short", short)]
}

/// One test only, as the allocator counts for the whole process.
#[test]
fn import_takes_at_most_fifty_times_the_file() {
    for (name, text) in files() {
        let before = ALLOCATOR.current_usage();
        ALLOCATOR.reset_peak_usage();
        let import = parse_obj(text.as_bytes()).unwrap();
        let factor = (ALLOCATOR.peak_usage() - before) as f64 / text.len() as f64;
        let faces = import.mesh.topology().face_count();
        println!("{name}: {faces} faces, {} bytes, at the peak {factor:.1} times as much", text.len());
        assert!(factor <= MOST, "{name}: {factor:.1}");
        assert!(factor > 1.0, "{name}: nothing was counted");
    }
}
