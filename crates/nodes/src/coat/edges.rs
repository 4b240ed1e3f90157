//! Where fins can stand.

use glam::DVec2;
use pelage_coat::{FinEdges, Frame, Surface};
use pelage_mesh::{Edge, HalfEdge, Mesh};
use pelage_patch::PatchTiling;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::dress::Dressing;

/// Every edge with fur at one end at least, each with a random interval of the fin texture whose length is the edge's in tile coordinates (L9).
pub(crate) fn fin_edges(dressing: &Dressing, surface: &Surface, frame: &Frame) -> FinEdges {
    let mesh = dressing.mesh;
    let tiles_across = dressing.fin.as_ref().map_or(1.0, |fin| f64::from(fin.tiles_across));
    let places = face_places(dressing.tiling, mesh.topology().face_count());
    let mut edges = FinEdges::default();
    for edge in mesh.edges() {
        let ends = edge.vertices();
        if ends.iter().all(|v| surface.offsets[v.index()] == glam::Vec3::ZERO) {
            continue;
        }
        let span = tile_length(dressing.tiling, &places, edge) / tiles_across;
        // Seeded by the edge itself, so that a change elsewhere leaves this fin as it is.
        let start: f64 = Pcg64Mcg::seed_from_u64(dressing.seed ^ (u64::from(ends[0].id().0) << 32 | u64::from(ends[1].id().0))).random();
        let near = edge.half_edge();
        // At a boundary there is no second face, and no normal.
        let beyond = near.twin().map_or(glam::Vec3::ZERO, |twin| twin.face().normal().as_vec3());
        edges.vertices.push(ends.map(|v| v.id().0));
        edges.intervals.push([start as f32, (start + span) as f32]);
        edges.face_normals.push([near.face().normal().as_vec3(), beyond]);
        edges.curvatures.push((curvature(edge) * frame.diameter) as f32);
    }
    edges
}

/// Where each surface face stands in the tiling's face list.
fn face_places(tiling: &PatchTiling, face_count: usize) -> Vec<u32> {
    let mut places = vec![0; face_count];
    for (place, face) in tiling.surface_faces().iter().enumerate() {
        places[face.index()] = place as u32;
    }
    places
}

/// The edge's length in tiles: the mean of what the patches on its two sides say, which differ where the edge is a seam.
fn tile_length(tiling: &PatchTiling, places: &[u32], edge: Edge<'_, Mesh>) -> f64 {
    let on_side = |h: HalfEdge<'_, Mesh>| {
        let corners = tiling.faces()[places[h.face().index()] as usize];
        let k = h.index() % 3;
        let place = |corner: u32| -> DVec2 { tiling.coordinates()[corner as usize] };
        place(corners[k]).distance(place(corners[(k + 1) % 3]))
    };
    let near = on_side(edge.half_edge());
    edge.half_edge().twin().map_or(near, |twin| 0.5 * (near + on_side(twin)))
}

/// The angle between the normals of the two faces over the distance between their centres, in radians a model unit; 0 at a boundary.
fn curvature(edge: Edge<'_, Mesh>) -> f64 {
    let Some(twin) = edge.half_edge().twin() else { return 0.0 };
    let (a, b) = (edge.half_edge().face(), twin.face());
    let (normal_a, normal_b) = (a.normal(), b.normal());
    let distance = a.centre().distance(b.centre());
    let angle = normal_a.cross(normal_b).length().atan2(normal_a.dot(normal_b));
    if distance > 0.0 { angle / distance } else { 0.0 }
}
