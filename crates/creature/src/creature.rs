//! From a plan to a mesh of a number of faces.

use glam::DVec3;
use pelage_mesh::{Mesh, Summary};
use rayon::prelude::*;

use crate::body::Body;
use crate::error::check;
use crate::raw::RawMesh;
use crate::reduce::{flip_to_delaunay, reduce};
use crate::relax::{relax, settle};
use crate::skin::Skin;
use crate::{CreatureError, Part, Plan, anatomy};

/// The least faces that may be asked for.
pub const FEWEST_FACES: u32 = 300;

/// The most faces that may be asked for.
pub const MOST_FACES: u32 = 4_000_000;

/// The raw mesh has at least this many times the faces asked for, so that its short edges can go.
const SPARE: f64 = 1.5;

/// How often the lattice is refined where the raw mesh is not of one piece without handles.
const TRIES: u32 = 3;

/// Sides of the first lattice's cells, in body lengths; between them half the width of the thinnest limb.
const FINEST_CELL: f64 = 0.008;
const COARSEST_CELL: f64 = 0.04;

/// A creature: its skin, and what is known of each place on it.
pub struct Creature {
    mesh: Mesh,
    body: Body,
}

impl Creature {
    /// Makes the creature of a plan with so many faces, [`FEWEST_FACES`] to [`MOST_FACES`]; an odd number is met by one less.
    ///
    /// The mesh is closed, of one piece and without handles, and wound outwards. Every vertex lies on the implicit surface. Time is near linear in
    /// the faces, from a fixed cost of some ten thousand on; the result is the same bits for any number of threads.
    ///
    /// # Errors
    /// Where a number is out of range, parts touch that should not ([`CreatureError::Fused`]), or the faces are too few for the parts
    /// ([`CreatureError::TooCoarse`]).
    pub fn new(plan: &Plan, faces: u32) -> Result<Self, CreatureError> {
        plan.check()?;
        check("faces", f64::from(faces), f64::from(FEWEST_FACES)..=f64::from(MOST_FACES))?;
        let body = Body::new(anatomy::limbs(plan));
        let mesh = mesh_of(&body, faces)?;
        Ok(Self { mesh, body })
    }

    /// The skin.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The same, given away.
    pub fn into_mesh(self) -> Mesh {
        self.mesh
    }

    /// How far a place is outside the skin, in body lengths, or less; negative inside. It grows at most as fast as the distance.
    pub fn field(&self, place: DVec3) -> f64 {
        self.body.value(place)
    }

    /// The gradient of [`Creature::field`], at most 1 long: outwards.
    pub fn gradient(&self, place: DVec3) -> DVec3 {
        self.body.value_and_gradient(place).1
    }

    /// How much each vertex belongs to a part, 0 to 1; all the parts' weights add up to 1. `softness`, 0.001 to 1 body lengths, is how wide the passage
    /// from part to part is.
    ///
    /// # Errors
    /// Where the softness is out of range.
    pub fn weights(&self, part: Part, softness: f64) -> Result<Vec<f64>, CreatureError> {
        check("softness", softness, 0.001..=1.0)?;
        let weight = |&p: &DVec3| {
            let all = self.closeness(p, softness);
            let of_part: f64 = all.iter().filter(|(limb, _)| *limb == part).map(|(_, weight)| weight).sum();
            of_part / all.iter().map(|(_, weight)| weight).sum::<f64>()
        };
        Ok(self.mesh.positions().par_iter().map(weight).collect())
    }

    /// The way fur lies by nature at each vertex: from the nose to the tail's tip, from the shoulders to the toes, up the ears. At most 1 long; not tangent
    /// to the skin, and short where limbs disagree.
    pub fn lie(&self) -> Vec<DVec3> {
        self.mesh.positions().par_iter().map(|&p| self.lie_at(p)).collect()
    }

    fn lie_at(&self, p: DVec3) -> DVec3 {
        let values = self.body.limbs().iter().map(|limb| (limb.cone.axis(), limb.cone.value(p)));
        let nearest = values.clone().map(|(_, value)| value).fold(f64::INFINITY, f64::min);
        let (sum, total) = values.fold((DVec3::ZERO, 0.0), |(sum, total), (axis, value)| {
            let weight = closeness(value - nearest, 0.12);
            (sum + weight * axis, total + weight)
        });
        sum / total
    }

    /// The parts at a place, each once, by how near they are beside the nearest.
    fn closeness(&self, p: DVec3, softness: f64) -> Vec<(Part, f64)> {
        let mut nearest: Vec<(Part, f64)> = Vec::new();
        for limb in self.body.limbs() {
            let value = limb.cone.value(p);
            match nearest.iter_mut().find(|(part, _)| *part == limb.part) {
                Some((_, least)) => *least = least.min(value),
                None => nearest.push((limb.part, value)),
            }
        }
        let least = nearest.iter().map(|(_, value)| *value).fold(f64::INFINITY, f64::min);
        nearest.iter_mut().for_each(|(_, value)| *value = closeness(*value - least, softness));
        nearest
    }
}

/// 1 for what is nearest, falling smoothly to 0 at `softness` behind it.
fn closeness(behind: f64, softness: f64) -> f64 {
    let left = (1.0 - behind / softness).max(0.0);
    left * left
}

/// The mesh of a body with so many faces: raw, thinned to the number, evened out.
fn mesh_of(body: &Body, faces: u32) -> Result<Mesh, CreatureError> {
    let raw = whole(body, faces)?;
    let mut skin = Skin::new(&raw);
    let reach = raw.mean_edge_length();
    settle(&mut skin, body, reach);
    let mut thickness: Vec<f64> = skin.positions.par_iter().map(|&p| body.thickness(p)).collect();
    let wanted = faces as usize & !1;
    even_out(&mut skin, body, 2);
    // In steps of half the faces, evened out between, so that the queue always chooses among good ones.
    while skin.face_count() > wanted {
        let before = skin.face_count();
        reduce(&mut skin, body, &mut thickness, wanted.max(before / 2));
        even_out(&mut skin, body, 2);
        if skin.face_count() == before {
            return Err(CreatureError::TooCoarse { asked: faces, reached: before as u32 });
        }
    }
    even_out(&mut skin, body, 3);
    settle(&mut skin, body, reach);
    Ok(skin.to_mesh()?)
}

fn even_out(skin: &mut Skin, body: &Body, rounds: u32) {
    for _ in 0..rounds {
        flip_to_delaunay(skin, 3);
        relax(skin, body);
    }
    flip_to_delaunay(skin, 3);
}

/// A raw mesh of one piece without handles and with enough faces, on a lattice that resolves the thinnest part.
fn whole(body: &Body, faces: u32) -> Result<Mesh, CreatureError> {
    let (mut cell, mut raw) = resolved(body)?;
    let wanted = f64::from(faces) * SPARE;
    while (raw.topology().face_count() as f64) < wanted {
        // There are as many faces as there are squares of cells.
        cell *= (raw.topology().face_count() as f64 / (1.03 * wanted)).sqrt();
        raw = one_piece(RawMesh::extract(body, cell))?;
    }
    Ok(raw)
}

/// The coarsest lattice that shows the body as one piece without handles, and its mesh. Where two sheets of surface pass one cell, a gap may be bridged:
/// finer cells part them.
fn resolved(body: &Body) -> Result<(f64, Mesh), CreatureError> {
    let mut cell = body.least_thickness().clamp(FINEST_CELL, COARSEST_CELL);
    let mut raw = one_piece(RawMesh::extract(body, cell));
    for _ in 0..TRIES {
        if raw.is_ok() {
            break;
        }
        cell *= 0.7;
        raw = one_piece(RawMesh::extract(body, cell));
    }
    Ok((cell, raw?))
}

fn one_piece(raw: RawMesh) -> Result<Mesh, CreatureError> {
    let mesh = Mesh::from_triangles(raw.positions, &raw.triangles)?;
    let summary = Summary::of(&mesh);
    let whole = summary.components == 1 && summary.genus == 0 && summary.is_closed();
    if whole { Ok(mesh) } else { Err(CreatureError::Fused { handles: summary.genus, pieces: summary.components }) }
}
