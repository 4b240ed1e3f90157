//! Time to tile tori of 1,000 to 1,000,000 faces, and to measure the tiling; items are faces.
#![allow(missing_docs, clippy::unwrap_used, reason = "divan makes a public item of each benchmark; these settings are good")]

use divan::Bencher;
use divan::counter::ItemsCount;
use pelage_mesh::{Mesh, torus};
use pelage_patch::{Settings, grow};

fn main() {
    divan::main();
}

/// A torus of about so many faces, its segments about as long around the axis as around the tube.
fn torus_of(faces: u32) -> Mesh {
    let around_tube = (f64::from(faces) / 6.0).sqrt().round() as u32;
    torus(1.0, 1.0 / 3.0, 3 * around_tube, around_tube).unwrap()
}

/// Tiles of the default size: the finer the mesh, the larger the patches in faces.
#[divan::bench(args = [1_000, 10_000, 100_000, 1_000_000], sample_count = 5)]
fn default_tile(bencher: Bencher<'_, '_>, faces: u32) {
    let mesh = torus_of(faces);
    let settings = Settings::for_mesh(&mesh);
    bencher.counter(ItemsCount::new(mesh.topology().face_count())).bench(|| grow(&mesh, None, &settings));
}

/// Tiles as fine as the mesh: about thirty faces a patch, whatever their number.
#[divan::bench(args = [1_000, 10_000, 100_000])]
fn fine_tile(bencher: Bencher<'_, '_>, faces: u32) {
    let mesh = torus_of(faces);
    let settings = Settings::with_tile_side(5.0 * mesh.mean_edge_length());
    bencher.counter(ItemsCount::new(mesh.topology().face_count())).bench(|| grow(&mesh, None, &settings));
}

/// Patches that repeat the tile many times (feature L4).
#[divan::bench(args = [1_000, 10_000, 100_000])]
fn large_patches(bencher: Bencher<'_, '_>, faces: u32) {
    let mesh = torus_of(faces);
    let settings = Settings { patch_extent: 6.0, ..Settings::for_mesh(&mesh) };
    bencher.counter(ItemsCount::new(mesh.topology().face_count())).bench(|| grow(&mesh, None, &settings));
}

#[divan::bench(args = [1_000, 10_000, 100_000])]
fn quality(bencher: Bencher<'_, '_>, faces: u32) {
    let mesh = torus_of(faces);
    let tiling = grow(&mesh, None, &Settings::for_mesh(&mesh)).unwrap();
    bencher.counter(ItemsCount::new(mesh.topology().face_count())).bench(|| tiling.quality(&mesh, None));
}
