//! Lays strands, textures and fields on a tiled surface: the place where the types of the crates to the left become a [`Coat`].

use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Coat, FinTexture, Frame, PatchMesh, ShellTexture, Surface};
use pelage_field::{ColourField, DirectionField, ScalarField};
use pelage_mesh::{Mesh, VertexId};
use pelage_patch::PatchTiling;
use pelage_strand::{Strand, StrandTile};

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
    /// The strands' mean direction in tile space and the height of their box, both in tile sides.
    pub(crate) lean: HairLean,
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
pub(crate) struct HairLean {
    /// The mean direction from root to tip, in tile sides.
    pub(crate) direction: DVec3,
    /// The height of the tile's box, in tile sides.
    pub(crate) height: f64,
}

impl HairLean {
    /// From root to tip, all strands together.
    pub(crate) fn of(strands: &StrandTile) -> Self {
        let run = |strand: Strand<'_>| -> Option<DVec3> {
            let (root, tip) = (Vec3::from(*strand.points.first()?), Vec3::from(*strand.points.last()?));
            Some((tip - root).as_dvec3())
        };
        let sum: DVec3 = strands.strands().filter_map(run).sum();
        Self { direction: sum.normalize_or(DVec3::Z), height: strands.height() }
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
    let mut surface = Surface::default();
    for vertex in mesh.topology().vertices() {
        let normal = normals[vertex.index()];
        let along = dressing.directions.map_or(DVec3::ZERO, |field| field.at_vertex(vertex));
        let local = dressing.lengths.map_or(1.0, |field| f64::from(field.values()[vertex.index()]).max(0.0));
        let up = stand(normal, along, dressing.slant);
        surface.positions.push(frame.place(mesh.position(vertex)));
        surface.normals.push(normal.as_vec3());
        surface.offsets.push((dressing.length * local * up).as_vec3());
        surface.directions.push(hair_direction(dressing, frame, normal, along, up).as_vec3());
        let colour = dressing.colours.map_or(Vec3::ONE, |field| field.values()[vertex.index()]);
        surface.colours.push(colour * dressing.tint);
    }
    surface
}

/// The unit direction of the offset: the normal, turned by `slant` towards the field. Turned and not sheared, so that the hair keeps its length.
fn stand(normal: DVec3, along: DVec3, slant: f64) -> DVec3 {
    if along == DVec3::ZERO { normal } else { normal * slant.cos() + along * slant.sin() }
}

/// *T*: the tile's mean hair direction, carried to the surface by the tile's axes: *s* and *t* in the tangent plane, height along the offset (L14).
fn hair_direction(dressing: &Dressing, frame: &Frame, normal: DVec3, along: DVec3, up: DVec3) -> DVec3 {
    let lean = dressing.lean;
    let tile_side = dressing.tiling.tile_side() / frame.diameter;
    let across = along.cross(normal);
    let rise = up * (lean.direction.z * dressing.length / lean.height.max(f64::MIN_POSITIVE));
    let direction = rise + (across * lean.direction.x + along * lean.direction.y) * tile_side;
    // Finite for any length: a hair of no length still points somewhere.
    direction.try_normalize().unwrap_or(up)
}

fn patch_mesh(tiling: &PatchTiling) -> PatchMesh {
    PatchMesh {
        vertices: tiling.vertices().iter().map(|v: &VertexId| v.0).collect(),
        coordinates: tiling.coordinates().iter().map(|c| c.as_vec2()).collect(),
        faces: tiling.faces().to_vec(),
        patch_ends: tiling.patches().iter().map(|patch| patch.faces().end as u32).collect(),
    }
}
