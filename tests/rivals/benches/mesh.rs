//! Half-edges from an index list, and a walk around every vertex, beside the crates that people would use instead; each as a ratio to a sort of the same keys.
//!
//! All are measured in turn, round by round, and the best round of each is printed, since machines drift and are busy.

use std::hint::black_box;
use std::time::{Duration, Instant};

use baby_shark::exports::nalgebra::Vector3;
use baby_shark::mesh::corner_table::CornerTable;
use pelage_mesh::{Topology, torus};
use smesh::prelude::SMesh;
use three_d_asset::{Indices, Positions, TriMesh};

/// Segments of tori with 5,000, 100,000 and 1,000,000 faces.
const SIZES: [(u32, u32); 3] = [(50, 50), (250, 200), (1000, 500)];

struct Input {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// A crate: how it builds and walks.
struct Rival {
    name: &'static str,
    /// The time to build, and that to sum the neighbours' numbers of every vertex.
    measure: fn(&Input) -> (Duration, Option<Duration>),
}

const RIVALS: [Rival; 5] = [
    Rival { name: "sort of the keys", measure: sort },
    Rival { name: "pelage-mesh", measure: pelage },
    Rival { name: "tri-mesh 0.6", measure: tri_mesh },
    Rival { name: "baby_shark 0.3", measure: baby_shark },
    Rival { name: "smesh 0.2.0", measure: smesh },
];

fn main() {
    for size in SIZES {
        let mesh = torus(1.0, 0.4, size.0, size.1).expect("a torus");
        let input = Input { positions: mesh.positions().iter().map(|p| p.to_array()).collect(), triangles: mesh.topology().triangles().collect() };
        let faces = input.triangles.len();
        let rounds = (300_000 / faces).clamp(3, 30);
        let mut best = [(Duration::MAX, Duration::MAX); RIVALS.len()];
        for _ in 0..rounds {
            for (best, rival) in best.iter_mut().zip(&RIVALS) {
                let (build, walk) = (rival.measure)(&input);
                *best = (best.0.min(build), best.1.min(walk.unwrap_or(Duration::MAX)));
            }
        }
        println!("{faces} faces, best of {rounds} rounds: build in ns a face (ratio to the sort); walk around every vertex in ns a vertex");
        for (rival, (build, walk)) in RIVALS.iter().zip(best) {
            let [ns, ratio] = [build.as_secs_f64() * 1e9 / faces as f64, build.as_secs_f64() / best[0].0.as_secs_f64()];
            let walk = if walk < Duration::MAX { format!("{:8.1}", walk.as_secs_f64() * 1e9 / input.positions.len() as f64) } else { String::new() };
            println!("  {:<18} {ns:8.1} ({ratio:6.2}) {walk}", rival.name);
        }
    }
}

fn time<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let start = Instant::now();
    let result = black_box(work());
    (start.elapsed(), result)
}

fn sort(input: &Input) -> (Duration, Option<Duration>) {
    let edges = input.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut keys: Vec<u64> = edges.map(|(a, b)| u64::from(a.min(b)) << 32 | u64::from(a.max(b))).collect();
    (time(|| keys.sort_unstable()).0, None)
}

fn pelage(input: &Input) -> (Duration, Option<Duration>) {
    let (build, topology) = time(|| Topology::from_triangles(input.positions.len(), &input.triangles).expect("a surface"));
    let walk = time(|| topology.vertices().flat_map(|vertex| vertex.neighbours()).map(|other| other.index()).sum::<usize>());
    (build, Some(walk.0))
}

fn tri_mesh(input: &Input) -> (Duration, Option<Duration>) {
    let positions = input.positions.iter().map(|&[x, y, z]| tri_mesh::vec3(x, y, z)).collect();
    let asset = TriMesh { positions: Positions::F64(positions), indices: Indices::U32(input.triangles.as_flattened().to_vec()), ..TriMesh::default() };
    let (build, mesh) = time(|| tri_mesh::Mesh::new(&asset));
    let around = |vertex| mesh.vertex_halfedge_iter(vertex).filter_map(|h| mesh.walker_from_halfedge(h).vertex_id()).map(|v| *v as usize).sum::<usize>();
    let walk = time(|| mesh.vertex_iter().map(around).sum::<usize>());
    (build, Some(walk.0))
}

fn baby_shark(input: &Input) -> (Duration, Option<Duration>) {
    let positions: Vec<Vector3<f64>> = input.positions.iter().map(|&p| Vector3::from(p)).collect();
    let indices: Vec<usize> = input.triangles.as_flattened().iter().map(|&v| v as usize).collect();
    let (build, table) = time(|| CornerTable::<f64>::from_vertex_and_face_slices(&positions, &indices));
    let walk = time(|| {
        let mut count = 0;
        table.vertices().for_each(|vertex| table.vertices_around_vertex(vertex, |other| count += usize::from(black_box(other) != vertex)));
        count
    });
    (build, Some(walk.0))
}

fn smesh(input: &Input) -> (Duration, Option<Duration>) {
    let (build, _) = time(|| {
        let mut mesh = SMesh::new();
        let vertices: Vec<_> = input.positions.iter().map(|p| mesh.add_vertex(glam::Vec3::from(p.map(|x| x as f32)))).collect();
        for &[a, b, c] in &input.triangles {
            mesh.add_triangle(vertices[a as usize], vertices[b as usize], vertices[c as usize]).expect("a face");
        }
        mesh
    });
    (build, None)
}
