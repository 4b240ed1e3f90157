//! The raw mesh: marching cubes by `transvoxel`, over the blocks that the surface passes.

use std::collections::HashMap;

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use transvoxel::extraction::extract;
use transvoxel::structs::block::Block;
use transvoxel::structs::block_star_view::BlockStarView;
use transvoxel::structs::grid_point::GridPoint;
use transvoxel::structs::vertex_index::VertexIndex;
use transvoxel::structs::voxel_index::VoxelIndex;
use transvoxel::traits::mesh_builder::MeshBuilder;
use transvoxel::traits::voxel_block::VoxelBlock;

use crate::body::Body;

/// Cells along a block's side.
const BLOCK: usize = 8;

/// Samples along it.
const SAMPLES: usize = BLOCK + 1;

/// Vertices near the surface and triangles that wind anticlockwise seen from outside.
pub(crate) struct RawMesh {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// A lattice of cubes.
struct Lattice {
    low: DVec3,
    cell: f64,
}

impl Lattice {
    fn point(&self, place: DVec3) -> DVec3 {
        self.low + self.cell * place
    }
}

impl RawMesh {
    /// Of cells with sides of `cell`. Sparse: a cube of space is halved until it is a block or the field says that no surface is in it, so that the
    /// time is that of the surface's area in cells.
    ///
    /// The table of cases is Lengyel's ("Voxel-based terrain for real-time virtual simulations", 2010): two cells always agree on how the face between them is cut, so
    /// that the mesh is closed and a manifold whatever the samples.
    pub(crate) fn extract(body: &Body, cell: f64) -> Self {
        let (low, high) = body.bounds();
        // No lattice plane is one of symmetry, where samples would be zero to rounding.
        let lattice = Lattice { low: low - cell * DVec3::new(0.37, 0.41, 0.43), cell };
        let cells = ((high - lattice.low).max_element() / cell).ceil() as usize + 1;
        let side = (BLOCK * cells.div_ceil(BLOCK)).next_power_of_two() as u32;
        let blocks = passed(body, &lattice, [0; 3], side);
        let pieces: Vec<Piece> = blocks.into_par_iter().map(|at| piece(body, &lattice, at)).collect();
        weld(&lattice, &pieces)
    }
}

/// The blocks that the surface may pass, in one order whatever the threads.
fn passed(body: &Body, lattice: &Lattice, at: [u32; 3], side: u32) -> Vec<[u32; 3]> {
    let half = 0.5 * f64::from(side);
    let centre = lattice.point(DVec3::from(at.map(f64::from)) + half);
    if body.value(centre).abs() > lattice.cell * half * 3.0_f64.sqrt() * 1.001 {
        return Vec::new();
    }
    if side as usize == BLOCK {
        return vec![at];
    }
    let half = side / 2;
    let octants = (0..8_u32).into_par_iter().map(|k| [0, 1, 2].map(|axis| at[axis] + half * (k >> axis & 1)));
    octants.flat_map_iter(|at| passed(body, lattice, at, half)).collect()
}

/// The field at the samples of a block, with the sign that the library takes: positive inside.
struct Sampled {
    block: Block<f32>,
    densities: Vec<f32>,
}

impl VoxelBlock<f32, f32> for Sampled {
    fn block(&self) -> &Block<f32> {
        &self.block
    }

    /// Outside the block the nearest sample: the library asks for those only for normals, which the field itself gives us.
    fn get(&self, index: VoxelIndex) -> f32 {
        let [x, y, z] = [index.x, index.y, index.z].map(|k| k.clamp(0, BLOCK as isize) as usize);
        self.densities[x + SAMPLES * (y + SAMPLES * z)]
    }
}

/// An edge of the lattice: where it begins and along which axis it runs.
type Edge = ([u32; 3], u8);

/// What the library makes of a block: for each vertex the edge that it lies on and its place in the lattice, and triangles.
#[derive(Default)]
struct Piece {
    vertices: Vec<(Edge, Vec3)>,
    triangles: Vec<[usize; 3]>,
}

impl MeshBuilder<f32, f32> for Piece {
    fn add_vertex_between(&mut self, a: GridPoint<f32, f32>, b: GridPoint<f32, f32>, towards_b: f32) -> VertexIndex {
        let [a, b] = [a.position, b.position].map(|p| Vec3::new(p.x, p.y, p.z));
        let run = (b - a).abs();
        let axis = u8::from(run.y > 0.5) + 2 * u8::from(run.z > 0.5);
        self.vertices.push(((a.min(b).to_array().map(|k| k as u32), axis), a.lerp(b, towards_b)));
        VertexIndex(self.vertices.len() - 1)
    }

    fn add_triangle(&mut self, a: VertexIndex, b: VertexIndex, c: VertexIndex) {
        self.triangles.push([a.0, b.0, c.0]);
    }
}

fn piece(body: &Body, lattice: &Lattice, at: [u32; 3]) -> Piece {
    let place = |k: usize| DVec3::new((k % SAMPLES) as f64, (k / SAMPLES % SAMPLES) as f64, (k / (SAMPLES * SAMPLES)) as f64);
    let density = |k| -body.value(lattice.point(DVec3::from(at.map(f64::from)) + place(k))) as f32;
    let densities: Vec<f32> = (0..SAMPLES * SAMPLES * SAMPLES).map(density).collect();
    // In lattice units, which are whole numbers.
    let sampled = Sampled { block: Block::new(at.map(|k| k as f32), BLOCK as f32, BLOCK), densities };
    extract(&BlockStarView::<_, _, Sampled, Sampled>::new_simple(sampled), 0.0, Piece::default())
}

/// Joins the blocks: an edge of the lattice has one vertex, whichever blocks share it.
fn weld(lattice: &Lattice, pieces: &[Piece]) -> RawMesh {
    let mut raw = RawMesh { positions: Vec::new(), triangles: Vec::new() };
    let mut known: HashMap<Edge, u32> = HashMap::new();
    let mut names = Vec::new();
    for piece in pieces {
        names.clear();
        names.extend(piece.vertices.iter().map(|&(edge, place)| {
            *known.entry(edge).or_insert_with(|| {
                raw.positions.push(lattice.point(place.as_dvec3()));
                raw.positions.len() as u32 - 1
            })
        }));
        raw.triangles.extend(piece.triangles.iter().map(|corners| corners.map(|k| names[k])));
    }
    raw
}
