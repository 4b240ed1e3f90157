//! How much memory import takes at its peak, against the size of the file.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use std::fmt::Write;
use std::path::PathBuf;

use peak_alloc::PeakAlloc;
use pelage_mesh::{parse_obj, torus};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// What numerics ask for: so many bytes for each byte of the file.
const MOST: f64 = 50.0;

/// What an import of nothing may take.
const LEAST: usize = 16 << 10;

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

/// What importing takes at its peak, in bytes, and the number of faces; none where the file is refused.
fn peak(bytes: &[u8]) -> (usize, Option<usize>) {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let import = parse_obj(bytes);
    (ALLOCATOR.peak_usage() - before, import.ok().map(|import| import.mesh.topology().face_count()))
}

/// The models of the folder `PELAGE_MODELS`, real and nasty, by name.
fn models() -> Vec<(String, Vec<u8>)> {
    let Some(folder) = std::env::var_os("PELAGE_MODELS").map(PathBuf::from) else {
        println!("PELAGE_MODELS is not set: the models are not looked at");
        return Vec::new();
    };
    let files = ["real", "nasty"].into_iter().flat_map(|part| std::fs::read_dir(folder.join(part)).unwrap());
    let paths = files.map(|file| file.unwrap().path()).filter(|path| path.extension().is_some_and(|extension| extension == "obj"));
    let models: Vec<_> = paths.map(|path| (path.display().to_string(), std::fs::read(&path).unwrap())).collect();
    assert!(models.len() >= 56, "only {} models", models.len());
    models
}

/// One test only, as the allocator counts for the whole process.
#[test]
fn import_takes_at_most_fifty_times_the_file() {
    let mut most = 0.0_f64;
    for (name, text) in files() {
        let (bytes, faces) = peak(text.as_bytes());
        let factor = bytes as f64 / text.len() as f64;
        println!("{name}: {} faces, {} bytes, at the peak {factor:.1} times as much", faces.unwrap(), text.len());
        assert!(factor <= MOST, "{name}: {factor:.1}");
        assert!(factor > 1.0, "{name}: nothing was counted");
        most = most.max(factor);
    }
    let mut most_of_models = 0.0_f64;
    for (name, bytes) in models() {
        // Where there is next to nothing to read, what any import takes is more than that.
        let taken = peak(&bytes).0.saturating_sub(LEAST);
        let factor = taken as f64 / bytes.len() as f64;
        assert!(factor <= MOST, "{name}: {factor:.1} times its {} bytes", bytes.len());
        most_of_models = most_of_models.max(factor);
    }
    println!("reached: {most:.1} times of 80,000 triangles, {most_of_models:.1} times of the models");
}
