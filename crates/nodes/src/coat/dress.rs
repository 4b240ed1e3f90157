//! Lays strands, textures and fields on a tiled surface: the place where the types of the crates to the left become a [`Coat`].

use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Coat, FinTexture, Frame, PatchMesh, ShellTexture, Surface};
use pelage_field::{ColourField, DirectionField, ScalarField};
use pelage_mesh::{Mesh, VertexId};
use pelage_patch::PatchTiling;
use pelage_strand::StrandTile;

use super::edges::fin_edges;

/// What a coat is made from.
pub(crate) struct Dressing<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) tiling: &'a PatchTiling,
    pub(crate) directions: Option<&'a DirectionField>,
    pub(crate) lengths: Option<&'a ScalarField>,
    pub(crate) colours: Option<&'a ColourField>,
    pub(crate) shells: Arc<ShellTexture>,
    pub(crate) fin: Option<Arc<FinTexture>>,
    pub(crate) strands: &'a StrandTile,
    /// In model diameters.
    pub(crate) length: f64,
    /// From the normal towards the direction field, in radians.
    pub(crate) slant: f64,
    /// Multiplies every colour; linear.
    pub(crate) tint: Vec3,
    pub(crate) seed: u64,
}

/// How the strands of a tile lie on the whole: what the per-vertex hair direction *T* is made from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HairLean(DVec3);

impl HairLean {
    /// The mean of the hair's unit directions along its whole length, in the frame of *s*, *t* and the offset, once the tile is laid with a
    /// side of `tile_side` and its height stretched to `length`, both in diameters.
    ///
    /// The mean of directions that differ is shorter than 1, and is kept so: lit by it, hair that stands every which way has no dark spot where it would
    /// point at the light if it all stood one way.
    pub(crate) fn of(strands: &StrandTile, tile_side: f64, length: f64) -> Self {
        let stretch = DVec3::new(tile_side, tile_side, length / strands.height().max(f64::MIN_POSITIVE));
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        for strand in strands.strands() {
            for step in strand.points.windows(2) {
                let run = (Vec3::from(step[1]) - Vec3::from(step[0])).as_dvec3();
                // Weighted by its length in the tile, which no stretch makes zero.
                let weight = run.length();
                sum += weight * (run * stretch).normalize_or(DVec3::Z);
                total += weight;
            }
        }
        Self(if total > 0.0 { sum / total } else { DVec3::Z })
    }
}

/// Makes the coat. Fields must have one value a vertex of the mesh; the nodes check that.
pub(crate) fn dress(dressing: &Dressing) -> Coat {
    let mesh = dressing.mesh;
    let (low, high) = mesh.bounds().unwrap_or_default();
    let diameter = if mesh.diameter() > 0.0 { mesh.diameter() } else { 1.0 };
    let frame = Frame { centre: 0.5 * (low + high), diameter };
    let surface = surface(dressing, &frame);
    let edges = fin_edges(dressing, &surface, &frame);
    Coat { frame, surface, patches: patch_mesh(dressing.tiling), edges, shells: Arc::clone(&dressing.shells), fin: dressing.fin.clone() }
}

/// The vertex arrays: skin, offset *c_v* (section 3 of Lengyel et al. 2001), hair direction *T*, colour.
fn surface(dressing: &Dressing, frame: &Frame) -> Surface {
    let mesh = dressing.mesh;
    let normals = mesh.vertex_normals();
    let lean = HairLean::of(dressing.strands, dressing.tiling.tile_side() / frame.diameter, dressing.length);
    let mut surface = Surface::default();
    for vertex in mesh.vertices() {
        let normal = normals[vertex.index()];
        let along = dressing.directions.map_or(DVec3::ZERO, |field| field.at_vertex(vertex.id()));
        let local = dressing.lengths.map_or(1.0, |field| f64::from(field.values()[vertex.index()]).max(0.0));
        let up = stand(normal, along, dressing.slant);
        surface.positions.push(frame.place(vertex.position()));
        surface.normals.push(normal.as_vec3());
        surface.offsets.push((dressing.length * local * up).as_vec3());
        surface.bends.push(Vec3::ZERO);
        surface.ends.push(1.0);
        surface.directions.push(hair_direction(lean, normal, along, up).as_vec3());
        let colour = dressing.colours.map_or(Vec3::ONE, |field| field.values()[vertex.index()]);
        surface.colours.push(colour * dressing.tint);
    }
    surface
}

/// The unit direction of the offset: the normal, turned by `slant` towards the field. Turned and not sheared, so that the hair keeps its length.
fn stand(normal: DVec3, along: DVec3, slant: f64) -> DVec3 {
    if along == DVec3::ZERO { normal } else { normal * slant.cos() + along * slant.sin() }
}

/// *T*: the hair's mean direction, carried to the surface by the tile's axes: *s* and *t* in the tangent plane, height along the offset (L14).
///
/// Without a field the tile lies in another direction on each patch, and only the height counts.
fn hair_direction(lean: HairLean, normal: DVec3, along: DVec3, up: DVec3) -> DVec3 {
    let across = along.cross(normal);
    across * lean.0.x + along * lean.0.y + up * lean.0.z
}

fn patch_mesh(tiling: &PatchTiling) -> PatchMesh {
    PatchMesh {
        vertices: tiling.vertices().iter().map(|v: &VertexId| v.0).collect(),
        coordinates: tiling.coordinates().iter().map(|c| c.as_vec2()).collect(),
        faces: tiling.faces().to_vec(),
        patch_ends: tiling.patches().iter().map(|patch| patch.faces().end as u32).collect(),
    }
}
