//! OBJ bytes → mesh with repairs, beside `tobj` alone on the same bytes; and soups of triangles → mesh, beside one sort of their edge keys.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, and its input is its own")]

mod common;

use glam::DVec3;
use pelage_mesh::{Mesh, RepairSettings, Soup, parse_obj, repair, torus};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Segments of tori with 5,000, 100,000 and 1,000,000 faces.
const SIZES: [(u32, u32); 3] = [(50, 50), (250, 200), (1000, 500)];

fn main() {
    println!("OBJ to mesh, beside tobj alone on the same bytes (the least of several times on a core, ns a face)");
    for size in SIZES {
        let text = obj_text(&mesh(size));
        print_ratio("import", "tobj", faces(size), || parse_obj(text.as_bytes()).unwrap(), || parse_alone(text.as_bytes()));
    }
    println!("polygons to mesh, beside one sort of their edge keys (the least of several times on a core, ns a face)");
    for (name, make) in [("clean", clean as fn(_) -> _), ("soup", exploded), ("torn", torn)] {
        for size in SIZES {
            let soup = make(size);
            let keys = keys(&soup);
            let sort = || {
                let mut keys = keys.clone();
                keys.sort_unstable();
                keys
            };
            print_ratio(name, "sort", faces(size), || repair(soup.clone(), &RepairSettings::default()).unwrap(), sort);
        }
    }
    println!();
    divan::main();
}

fn print_ratio<A, B>(name: &str, floor: &str, faces: usize, work: impl FnMut() -> A, beside: impl FnMut() -> B) {
    let rounds = (2_000_000 / faces).clamp(5, 101);
    let [ours, theirs] = common::least(rounds, faces, work, beside);
    println!("  {faces:>9} faces, {name:<6}: {ours:6.1}, {floor} {theirs:6.1}, ratio {:.2}", ours / theirs);
}

fn faces((major, minor): (u32, u32)) -> usize {
    2 * (major * minor) as usize
}

fn mesh((major, minor): (u32, u32)) -> Mesh {
    torus(1.0, 0.4, major, minor).unwrap()
}

fn obj_text(mesh: &Mesh) -> String {
    let positions = mesh.positions().iter().map(|p| format!("v {:.6} {:.6} {:.6}\n", p.x, p.y, p.z));
    let faces = mesh.topology().triangles().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    positions.chain(faces).collect()
}

fn parse_alone(mut bytes: &[u8]) -> Vec<tobj::Model> {
    tobj::load_obj_buf(&mut bytes, &tobj::LoadOptions::default(), |_| Ok(Default::default())).unwrap().0
}

fn keys(soup: &Soup) -> Vec<u64> {
    let edges = soup.corners.as_chunks::<3>().0.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    edges.map(|(a, b)| u64::from(a.min(b)) << 32 | u64::from(a.max(b))).collect()
}

/// Nothing to mend.
fn clean(size: (u32, u32)) -> Soup {
    let mesh = mesh(size);
    Soup::from_polygons(mesh.positions().to_vec(), mesh.topology().triangles())
}

/// Every triangle with vertices of its own.
fn exploded(size: (u32, u32)) -> Soup {
    let soup = clean(size);
    let positions: Vec<DVec3> = soup.corners.iter().map(|&vertex| soup.positions[vertex as usize]).collect();
    Soup { corners: (0..positions.len() as u32).collect(), positions, ..soup }
}

/// That in random order, one face in ten turned, one in a hundred given twice, one in a thousand without area.
fn torn(size: (u32, u32)) -> Soup {
    let soup = exploded(size);
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut triangles: Vec<[u32; 3]> = soup.corners.as_chunks::<3>().0.to_vec();
    triangles.shuffle(&mut random);
    for face in 0..triangles.len() {
        match random.random_range(0..1000) {
            0 => triangles.push([triangles[face][0], triangles[face][1], triangles[face][1]]),
            1..11 => triangles.push(triangles[face]),
            11..111 => triangles[face].reverse(),
            _ => {}
        }
    }
    Soup::from_polygons(soup.positions, triangles)
}

#[divan::bench(args = SIZES, sample_count = 5)]
fn import(bencher: divan::Bencher<'_, '_>, size: (u32, u32)) {
    let text = obj_text(&mesh(size));
    bencher.counter(divan::counter::ItemsCount::new(faces(size))).bench(|| parse_obj(text.as_bytes()).unwrap());
}
