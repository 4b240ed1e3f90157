//! Time to tile tori of 1,000 to 1,000,000 faces and a bunny, beside a floor of the same run; and to measure the tiling.
//!
//! The floor is what no method that grows patches nearest first and lays them out by least squares goes without: every face passes a heap once, and every
//! patch of the finished tiling is factorised and solved once.
#![allow(
    missing_docs,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "divan makes a public item of each benchmark, which prints; these settings are good"
)]

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use divan::Bencher;
use divan::counter::ItemsCount;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use glam::DVec3;
use pelage_field::DirectionField;
use pelage_mesh::{FaceId, Mesh, read_obj, torus};
use pelage_patch::{Patch, PatchTiling, Settings, grow};

const SIZES: [u32; 4] = [1_000, 10_000, 100_000, 1_000_000];

fn main() {
    println!("tiling at the default tile beside its floor: one pass through a heap, one Cholesky a patch (least of several, ns a face)");
    for (kind, combed) in [("isotropic", false), ("along a field", true)] {
        let mut last: Option<[f64; 3]> = None;
        for faces in SIZES {
            let here = print_ratio(&format!("torus, {kind}"), &torus_of(faces), combed);
            if let Some(last) = last {
                let power = |k: usize| (here[k] / last[k]).ln() / (here[0] / last[0]).ln();
                println!("{:>60}", format!("time grows as faces to the power {:.2}, the floor's {:.2}", power(1), power(2)));
            }
            last = Some(here);
        }
        print_ratio(&format!("bunny, {kind}"), &bunny(), combed);
    }
    println!();
    divan::main();
}

/// A torus of about so many faces, its segments about as long around the axis as around the tube.
fn torus_of(faces: u32) -> Mesh {
    let around_tube = (f64::from(faces) / 6.0).sqrt().round() as u32;
    torus(1.0, 1.0 / 3.0, 3 * around_tube, around_tube).unwrap()
}

/// The one of the saved graphs; where `PELAGE_MODELS` names a folder, the stand-in of 5,000 faces for that of the paper's Table 1.
fn bunny() -> Mesh {
    let ours = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/models/bunny.obj");
    let path = std::env::var_os("PELAGE_MODELS").map_or(ours, |folder| Path::new(&folder).join("real/t1_bunny_5000.obj"));
    read_obj(&path).unwrap().mesh
}

/// Prints a line; returns the faces, the least time and the floor, in seconds.
fn print_ratio(name: &str, mesh: &Mesh, combed: bool) -> [f64; 3] {
    let field = combed.then(|| DirectionField::toward(mesh, DVec3::new(0.0, -0.3, -1.0)).unwrap());
    let settings = Settings::for_mesh(mesh);
    let systems = systems(&grow(mesh, field.as_ref(), &settings).unwrap());
    let faces = mesh.topology().face_count() as f64;
    let rounds = (1_000_000 / mesh.topology().face_count()).clamp(3, 30);
    let (mut ours, mut floor) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..rounds {
        ours = ours.min(time(|| grow(mesh, field.as_ref(), &settings)));
        floor = floor.min(time(|| (heap_pass(mesh), solve_once(&systems))));
    }
    let ns = |seconds: f64| seconds * 1e9 / faces;
    println!(
        "  {faces:>9} faces, {name:<22}: {:7.0}, floor {:6.0}, ratio {:5.1}, in all {:8.1} ms",
        ns(ours),
        ns(floor),
        ours / floor,
        ours * 1e3
    );
    [faces, ours, floor]
}

fn time<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_secs_f64()
}

/// Every face once, in the order of its distance from the first of its piece.
fn heap_pass(mesh: &Mesh) -> usize {
    let mut taken = vec![false; mesh.topology().face_count()];
    let mut count = 0;
    for start in mesh.faces() {
        let origin = start.centre();
        let mut heap = BinaryHeap::from([Reverse((0_u64, start.id().0))]);
        while let Some(Reverse((_, face))) = heap.pop() {
            if std::mem::replace(&mut taken[face as usize], true) {
                continue;
            }
            count += 1;
            for neighbour in mesh.face(FaceId(face)).neighbours().filter(|n| !taken[n.index()]) {
                heap.push(Reverse((neighbour.centre().distance_squared(origin).to_bits(), neighbour.id().0)));
            }
        }
    }
    count
}

/// A patch's Laplacian, unweighted, its first vertex held; and two right-hand sides.
type System = (SparseColMat<usize, f64>, Mat<f64>);

fn systems(tiling: &PatchTiling) -> Vec<System> {
    let system = |patch: &Patch| {
        let (first, unknowns) = (patch.vertices().start as u32, patch.vertices().len() - 1);
        let mut entries = BTreeMap::new();
        for corners in &tiling.faces()[patch.faces()] {
            for k in 0..3 {
                let (a, b) = (corners[k] - first, corners[(k + 1) % 3] - first);
                let (low, high) = (a.min(b), a.max(b));
                for vertex in [low, high].into_iter().filter(|&v| v > 0) {
                    *entries.entry((vertex - 1, vertex - 1)).or_insert(0.0) += 1.0;
                }
                if low > 0 {
                    *entries.entry((high - 1, low - 1)).or_insert(0.0) -= 1.0;
                }
            }
        }
        let triplets: Vec<_> =
            entries.into_iter().map(|((row, column), value)| Triplet::new(row as usize, column as usize, value)).collect();
        let matrix = SparseColMat::try_new_from_triplets(unknowns, unknowns, &triplets).unwrap();
        (matrix, Mat::from_fn(unknowns, 2, |row, column| (row + column) as f64))
    };
    tiling.patches().iter().map(system).collect()
}

/// Each factorised and solved once.
fn solve_once(systems: &[System]) -> f64 {
    systems.iter().map(|(matrix, right)| matrix.sp_cholesky(Side::Lower).unwrap().solve(right)[(0, 0)]).sum()
}

/// Tiles of the default size: the finer the mesh, the larger the patches in faces.
#[divan::bench(args = SIZES, sample_count = 3)]
fn default_tile(bencher: Bencher<'_, '_>, faces: u32) {
    let mesh = torus_of(faces);
    let settings = Settings::for_mesh(&mesh);
    bencher.counter(ItemsCount::new(mesh.topology().face_count())).bench(|| grow(&mesh, None, &settings));
}

/// Tiles as fine as the mesh: about thirty faces a patch, whatever their number.
#[divan::bench(args = [1_000, 10_000, 100_000], sample_count = 10)]
fn fine_tile(bencher: Bencher<'_, '_>, faces: u32) {
    let mesh = torus_of(faces);
    let settings = Settings::with_tile_side(5.0 * mesh.mean_edge_length());
    bencher.counter(ItemsCount::new(mesh.topology().face_count())).bench(|| grow(&mesh, None, &settings));
}

/// Patches that repeat the tile many times (feature L4).
#[divan::bench(args = [1_000, 10_000, 100_000], sample_count = 10)]
fn large_patches(bencher: Bencher<'_, '_>, faces: u32) {
    let mesh = torus_of(faces);
    let settings = Settings { patch_extent: 6.0, ..Settings::for_mesh(&mesh) };
    bencher.counter(ItemsCount::new(mesh.topology().face_count())).bench(|| grow(&mesh, None, &settings));
}

#[divan::bench(args = [1_000, 10_000, 100_000], sample_count = 10)]
fn quality(bencher: Bencher<'_, '_>, faces: u32) {
    let mesh = torus_of(faces);
    let tiling = grow(&mesh, None, &Settings::for_mesh(&mesh)).unwrap();
    bencher.counter(ItemsCount::new(mesh.topology().face_count())).bench(|| tiling.quality(&mesh, None));
}
