//! Lays strands, textures and fields on a tiled surface: the place where the types of the crates to the left become a [`Coat`].

use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Coat, FinEdges, FinTexture, Frame, PatchMesh, ShellTexture, Surface};
use pelage_field::{ColourField, DirectionField, MOST_SLANT, ScalarField};
use pelage_mesh::{Mesh, VertexId};
use pelage_patch::{LappedPatches, PatchTiling};
use pelage_strand::StrandTile;

use super::curve::Curve;
use super::edges::fin_edges;
use super::lean::Lean;

/// What a coat is made from.
pub(crate) struct Dressing<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) tiling: &'a PatchTiling,
    /// Patches that overlap, to be drawn in place of those of the tiling.
    pub(crate) lapped: Option<&'a LappedPatches>,
    pub(crate) directions: Option<&'a DirectionField>,
    pub(crate) lengths: Option<&'a ScalarField>,
    pub(crate) colours: Option<&'a ColourField>,
    /// Which of the coats in a row stands where.
    pub(crate) coats: Option<&'a ScalarField>,
    pub(crate) shells: Arc<ShellTexture>,
    pub(crate) fin: Option<Arc<FinTexture>>,
    /// None of hair that is a pattern.
    pub(crate) strands: Option<&'a StrandTile>,
    /// In model diameters.
    pub(crate) length: f64,
    /// How far it is combed down, in radians; where `slants` are not, which are in degrees.
    pub(crate) slant: f64,
    pub(crate) slants: Option<&'a ScalarField>,
    /// How much of that comes from bending.
    pub(crate) bend: f64,
    /// Whether combing shears it instead.
    pub(crate) sheared: bool,
    /// Whether `lengths` say where the hair is cut off, and not how long it is.
    pub(crate) cut: bool,
    /// Multiplies every colour; linear.
    pub(crate) tint: Vec3,
    /// Whether it is to be looked at: has colours and directions to be lit by.
    pub(crate) looks: bool,
    pub(crate) seed: u64,
}

/// Makes the coat. Fields must have one value a vertex of the mesh; the nodes check that.
pub(crate) fn dress(dressing: &Dressing) -> Coat {
    let mesh = dressing.mesh;
    let (low, high) = mesh.bounds().unwrap_or_default();
    let diameter = if mesh.diameter() > 0.0 { mesh.diameter() } else { 1.0 };
    let frame = Frame { centre: 0.5 * (low + high), diameter };
    let mut surface = surface(dressing, &frame);
    let edges = if dressing.fin.is_some() { fin_edges(dressing, &surface, &frame) } else { FinEdges::default() };
    let patches = match dressing.lapped {
        Some(lapped) => lapped_mesh(mesh, lapped, &mut surface),
        None => patch_mesh(dressing.tiling),
    };
    Coat { frame, surface, patches, edges, shells: Arc::clone(&dressing.shells), fin: dressing.fin.clone() }
}

/// The vertex arrays: skin, offset *c_v* (section 3 of Lengyel et al. 2001), its bend and end, hair direction *T*, colour.
fn surface(dressing: &Dressing, frame: &Frame) -> Surface {
    let mesh = dressing.mesh;
    let normals = mesh.vertex_normals();
    let tile_side = dressing.tiling.tile_side() / frame.diameter;
    let leans = dressing.looks.then(|| Leans::of(dressing, tile_side));
    let last_coat = f64::from(dressing.strands.map_or(0, |strands| strands.coats() - 1));
    let mut surface = Surface::default();
    for vertex in mesh.vertices() {
        let normal = normals[vertex.index()];
        let along = dressing.directions.map_or(DVec3::ZERO, |field| field.at_vertex(vertex.id()));
        let local = dressing.lengths.map_or(1.0, |field| f64::from(field.values()[vertex.index()]).max(0.0));
        let (scale, end) = if dressing.cut { cut(local) } else { (local, 1.0) };
        let curve = dressing.curve(vertex.index());
        let (length, hair) = (dressing.length * scale * dressing.stretch(vertex.index(), along), curve.lay(normal, along));
        surface.positions.push(frame.place(vertex.position()));
        surface.normals.push(normal.as_vec3());
        surface.offsets.push((length * hair.0).as_vec3());
        surface.bends.push((length * hair.1).as_vec3());
        surface.ends.push(end as f32);
        let coat = dressing.coats.map_or(0.0, |field| f64::from(field.values()[vertex.index()])).clamp(0.0, last_coat);
        surface.mixes.push(if last_coat > 0.0 { (coat / last_coat) as f32 } else { 0.0 });
        let lean = leans.as_ref().map(|leans| leans.at(if along == DVec3::ZERO { 0.0 } else { dressing.slant_at(vertex.index()) }));
        surface.directions.push(lean.map_or(Vec3::ZERO, |lean| lean.direction((coat, end), (normal, along), hair).as_vec3()));
        let colour = dressing.colours.map_or(Vec3::ONE, |field| field.values()[vertex.index()]);
        surface.colours.push(colour * dressing.tint);
    }
    surface
}

impl Dressing<'_> {
    /// How far the fur of a vertex is combed down, in radians.
    fn slant_at(&self, vertex: usize) -> f64 {
        self.slants.map_or(self.slant, |field| f64::from(field.values()[vertex]).to_radians()).clamp(-MOST_SLANT, MOST_SLANT)
    }

    /// How the hair of a vertex stands.
    fn curve(&self, vertex: usize) -> Curve {
        Curve::new(self.slant_at(vertex), if self.sheared { 0.0 } else { self.bend })
    }

    /// How much longer it becomes where combing shears it.
    fn stretch(&self, vertex: usize, along: DVec3) -> f64 {
        if self.sheared && along != DVec3::ZERO { 1.0 / self.slant_at(vertex).cos() } else { 1.0 }
    }
}

/// The mean direction of the hair by how far it is combed down: where hair bends, of slants a few degrees apart.
struct Leans(Vec<Lean>);

/// Slants that are told apart.
const SLANTS: usize = 9;

impl Leans {
    fn of(dressing: &Dressing, tile_side: f64) -> Self {
        let lean = |slant: f64| Lean::of(dressing.strands, tile_side, dressing.length, &Curve::new(slant, dressing.bend));
        let bends = dressing.bend > 0.0 && !dressing.sheared;
        Self(match (bends, dressing.slants) {
            // However far straight hair is turned, it lies in its own frame as it did.
            (false, _) => vec![Lean::of(dressing.strands, tile_side, dressing.length, &Curve::new(0.0, 0.0))],
            // Where there is no way to lie the hair is straight, however it bends elsewhere.
            (true, None) => vec![lean(0.0), lean(dressing.slant)],
            (true, Some(_)) => (0..SLANTS).map(|k| lean(k as f64 / (SLANTS - 1) as f64 * MOST_SLANT)).collect(),
        })
    }

    fn at(&self, slant: f64) -> &Lean {
        let last = self.0.len() - 1;
        let place = if last == 1 { f64::from(u8::from(slant != 0.0)) } else { slant.abs() / MOST_SLANT * last as f64 };
        &self.0[(place.round() as usize).min(last)]
    }
}

/// Length and end of hair cut off at a part of its length; where nothing is left the skin is bare.
fn cut(part: f64) -> (f64, f64) {
    if part > 0.0 { (1.0, part.min(1.0)) } else { (0.0, 0.0) }
}

fn patch_mesh(tiling: &PatchTiling) -> PatchMesh {
    PatchMesh {
        vertices: tiling.vertices().iter().map(|v: &VertexId| v.0).collect(),
        coordinates: tiling.coordinates().iter().map(|c| c.as_vec2()).collect(),
        faces: tiling.faces().to_vec(),
        patch_ends: tiling.patches().iter().map(|patch| patch.faces().end as u32).collect(),
        opacities: Vec::new(),
    }
}

/// Patches that overlap: where they have a vertex between those of the mesh, the surface gets one that is what its face's corners are, mixed.
fn lapped_mesh(mesh: &Mesh, lapped: &LappedPatches, surface: &mut Surface) -> PatchMesh {
    let vertices = lapped.points().iter().map(|point| {
        let corners = mesh.face(point.face).vertices().map(|vertex| vertex.id().0);
        let parts = point.barycentrics.to_array();
        match parts.iter().position(|&part| part == 1.0) {
            Some(corner) => corners[corner],
            None => push_between(surface, corners.map(|corner| corner as usize), parts.map(|part| part as f32)),
        }
    });
    PatchMesh {
        vertices: vertices.collect(),
        coordinates: lapped.coordinates().iter().map(|c| c.as_vec2()).collect(),
        faces: lapped.faces().to_vec(),
        patch_ends: lapped.patch_ends().to_vec(),
        opacities: lapped.opacities().to_vec(),
    }
}

/// Adds a vertex between three others.
fn push_between(surface: &mut Surface, corners: [usize; 3], parts: [f32; 3]) -> u32 {
    let vector = |of: &[Vec3]| corners.iter().zip(parts).map(|(&corner, part)| part * of[corner]).sum::<Vec3>();
    let number = |of: &[f32]| corners.iter().zip(parts).map(|(&corner, part)| part * of[corner]).sum::<f32>();
    let (position, normal, offset) = (vector(&surface.positions), vector(&surface.normals), vector(&surface.offsets));
    let (bend, direction, colour) = (vector(&surface.bends), vector(&surface.directions), vector(&surface.colours));
    let (end, mix) = (number(&surface.ends), number(&surface.mixes));
    surface.positions.push(position);
    surface.normals.push(normal.normalize_or_zero());
    surface.offsets.push(offset);
    surface.bends.push(bend);
    surface.ends.push(end.min(1.0));
    surface.mixes.push(mix);
    surface.directions.push(direction);
    surface.colours.push(colour);
    (surface.positions.len() - 1) as u32
}
