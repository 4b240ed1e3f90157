//! What reading a surface costs, each beside a floor or another way of the same run: walks through views beside walks over plain arrays, geodesic distance
//! beside Dijkstra's along edges, rays and closest points through the hierarchy beside all faces, and beside `obvhs` alone in `f32`.
//!
//! Ways take turns and the best round of each is printed, since machines drift and are busy.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, and its input is its own")]

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hint::black_box;
use std::time::{Duration, Instant};

use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::triangle::Triangle;
use pelage_mesh::{Geodesics, HalfEdge, Mesh, Ray, SpatialIndex, Vertex, VertexId, torus};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Segments of tori with 5,000, 100,000 and 1,000,000 faces.
const SIZES: [(u32, u32); 3] = [(50, 50), (250, 200), (1000, 500)];

fn main() {
    let meshes = SIZES.map(|(major, minor)| torus(1.0, 0.4, major, minor).unwrap());
    println!("walk around every vertex, ns a vertex (ratio to plain arrays)");
    meshes.iter().for_each(walks);
    println!("geodesic distance from one vertex to all, ns a vertex (ratio to Dijkstra's along edges)");
    meshes.iter().for_each(geodesics);
    println!("building the hierarchy, ns a face (ratio to obvhs alone); refitting it");
    meshes.iter().for_each(builds);
    println!("rays and closest points, ns each (ratio to obvhs alone in f32; to all faces)");
    meshes.iter().for_each(searches);
}

/// The best of some rounds of each piece of work, which take turns.
fn best<const N: usize>(rounds: usize, mut work: [&mut dyn FnMut(); N]) -> [f64; N] {
    let mut best = [Duration::MAX; N];
    for _ in 0..rounds {
        for (best, work) in best.iter_mut().zip(&mut work) {
            let start = Instant::now();
            work();
            *best = (*best).min(start.elapsed());
        }
    }
    best.map(|time| time.as_secs_f64() * 1e9)
}

fn rounds(mesh: &Mesh) -> usize {
    (1_000_000 / mesh.topology().face_count()).clamp(3, 50)
}

fn walks(mesh: &Mesh) {
    let topology = mesh.topology();
    // The same walk over the same three arrays, with no view in sight.
    let origins: Vec<u32> = topology.half_edges().map(|h| h.origin().id().0).collect();
    let twins: Vec<u32> = topology.half_edges().map(|h| h.twin().map_or(u32::MAX, |twin| twin.id().0)).collect();
    let leaving: Vec<u32> = topology.vertices().map(|v| v.first_leaving().map_or(u32::MAX, |h| h.id().0)).collect();
    let next = |h: u32| if h % 3 == 2 { h - 2 } else { h + 1 };
    let previous = |h: u32| if h.is_multiple_of(3) { h + 2 } else { h - 1 };
    let mut plain = || {
        let mut sum = 0_usize;
        for &first in leaving.iter().filter(|&&first| first != u32::MAX) {
            let mut here = first;
            loop {
                sum += origins[next(here) as usize] as usize;
                here = twins[previous(here) as usize];
                if here == first || here == u32::MAX {
                    break;
                }
            }
        }
        black_box(sum);
    };
    let mut views = || {
        black_box(topology.vertices().flat_map(Vertex::leaving).map(|half_edge| half_edge.tip().index()).sum::<usize>());
    };
    let mut of_mesh = || {
        black_box(mesh.vertices().flat_map(Vertex::leaving).map(|half_edge| half_edge.tip().index()).sum::<usize>());
    };
    let [plain, views, of_mesh] = best(rounds(mesh), [&mut plain, &mut views, &mut of_mesh]).map(|ns| ns / mesh.positions().len() as f64);
    let faces = topology.face_count();
    println!(
        "  {faces:>9} faces: arrays {plain:6.1}, views {views:6.1} ({:.2}), of a mesh {of_mesh:6.1} ({:.2})",
        views / plain,
        of_mesh / plain
    );
}

fn along_edges(mesh: &Mesh, lengths: &[f64]) -> Vec<f64> {
    let mut distances = vec![f64::INFINITY; mesh.positions().len()];
    // The bits of numbers that are not negative are in the order of the numbers.
    let mut queue = BinaryHeap::from([Reverse((0_u64, 0_u32))]);
    distances[0] = 0.0;
    while let Some(Reverse((bits, here))) = queue.pop() {
        let distance = f64::from_bits(bits);
        if distance > distances[here as usize] {
            continue;
        }
        for leaving in mesh.vertex(VertexId(here)).leaving() {
            let (there, through) = (leaving.tip().id(), distance + lengths[leaving.index()]);
            if through < distances[there.index()] {
                distances[there.index()] = through;
                queue.push(Reverse((through.to_bits(), there.0)));
            }
        }
    }
    distances
}

fn geodesics(mesh: &Mesh) {
    let (vertices, faces) = (mesh.positions().len(), mesh.topology().face_count());
    let lengths: Vec<f64> = mesh.half_edges().map(HalfEdge::length).collect();
    let mut geodesics = Geodesics::on(mesh);
    let source = [VertexId(0).into()];
    let mut dijkstra = || {
        black_box(along_edges(mesh, &lengths));
    };
    let mut fast = || {
        black_box(geodesics.distances(&source, f64::INFINITY).unwrap());
    };
    let [dijkstra, fast] = best(rounds(mesh).min(10), [&mut dijkstra, &mut fast]).map(|ns| ns / vertices as f64);
    let mut layout = || {
        black_box(Geodesics::on(mesh));
    };
    let [layout] = best(3, [&mut layout]).map(|ns| ns / vertices as f64);
    print!("  {faces:>9} faces: along edges {dijkstra:6.0}, fast {fast:6.0} ({:.1}), laying faces out once {layout:6.0}", fast / dijkstra);
    if faces <= 5000 {
        let mut exact = || {
            black_box(geodesics.exact_distances(&source, f64::INFINITY).unwrap());
        };
        let [exact] = best(2, [&mut exact]).map(|ns| ns / vertices as f64);
        print!(", exact {exact:6.0} ({:.0})", exact / dijkstra);
    }
    println!();
}

fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    mesh.faces().map(|face| face.positions().map(|p| Vec3A::from(p.as_vec3()))).map(|[v0, v1, v2]| Triangle { v0, v1, v2 }).collect()
}

fn builds(mesh: &Mesh) {
    let faces = mesh.topology().face_count();
    let triangles = triangles(mesh);
    let mut index = Some(SpatialIndex::of(mesh));
    let mut ours = || {
        black_box(SpatialIndex::of(mesh));
    };
    let mut alone = || {
        black_box(build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default()));
    };
    let mut refit = || {
        index = index.take().and_then(|index| index.refit(mesh).ok());
    };
    let [ours, alone, refit] = best(rounds(mesh).min(5), [&mut ours, &mut alone, &mut refit]).map(|ns| ns / faces as f64);
    println!("  {faces:>9} faces: {ours:6.0} ({:.2}), refit {refit:6.0}", ours / alone);
}

fn searches(mesh: &Mesh) {
    let (faces, mut random) = (mesh.topology().face_count(), Pcg64Mcg::seed_from_u64(1));
    let mut place = || 2.0 * DVec3::new(random.random::<f64>() - 0.5, random.random::<f64>() - 0.5, random.random::<f64>() - 0.5);
    let rays: Vec<Ray> = (0..10_000).map(|_| (2.0 * place(), place())).map(|(from, to)| Ray::new(from, to - from).unwrap()).collect();
    let triangles = triangles(mesh);
    let tree = build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
    let index = SpatialIndex::of(mesh);
    let mut ours = || {
        black_box(rays.iter().filter_map(|ray| index.first_hit(ray)).count());
    };
    let mut alone = || {
        let mut count = 0;
        for ray in &rays {
            let ray = obvhs::ray::Ray::new_inf(ray.origin().as_vec3a(), ray.direction().as_vec3a());
            let mut hit = obvhs::ray::RayHit::none();
            count += usize::from(tree.ray_traverse(ray, &mut hit, |ray, id| triangles[tree.primitive_indices[id] as usize].intersect(ray)));
        }
        black_box(count);
    };
    let mut closest = || {
        black_box(rays.iter().filter_map(|ray| index.closest_point(ray.origin())).count());
    };
    let [ours, alone, closest] = best(5, [&mut ours, &mut alone, &mut closest]).map(|ns| ns / rays.len() as f64);
    let few = &rays[..(1_000_000 / faces).clamp(2, 100)];
    let mut all_faces = || {
        let first = |ray: &Ray| {
            let ray = obvhs::ray::Ray::new_inf(ray.origin().as_vec3a(), ray.direction().as_vec3a());
            triangles.iter().map(|triangle| triangle.intersect(&ray)).fold(f32::INFINITY, f32::min)
        };
        black_box(few.iter().map(first).filter(|distance| distance.is_finite()).count());
    };
    let mut all_points = || {
        let nearest = |from: Vec3A| {
            let distances = triangles.iter().map(|t| (t.v0 + t.v1 + t.v2 - 3.0 * from).length_squared());
            distances.fold(f32::INFINITY, f32::min)
        };
        black_box(few.iter().map(|ray| nearest(ray.origin().as_vec3a())).sum::<f32>());
    };
    let [every_hit, every_point] = best(3, [&mut all_faces, &mut all_points]).map(|ns| ns / few.len() as f64);
    println!(
        "  {faces:>9} faces: first hit {ours:6.0} ({:.2}; {:.5}), {:.2} million rays a second; closest point {closest:6.0} ({:.5} of only looking at all centres)",
        ours / alone,
        ours / every_hit,
        1e3 / ours,
        closest / every_point
    );
}
