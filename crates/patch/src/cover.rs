//! Covering a whole mesh with patches.

use glam::DVec2;
use pelage_field::DirectionField;
use pelage_mesh::{Face, FaceId, Mesh, Topology};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::distortion::Bounds;
use crate::frame::face_rotations;
use crate::growth::{Draft, Grower, UNCOVERED};
use crate::shape::{FaceShape, face_shapes};
use crate::solve::Wish;
use crate::splotch::{Splotch, random_rotation};
use crate::{PatchError, PatchTiling, Settings};

/// Patches first grow within this part of the bounds, which leaves the rest to those that cover what is left between them.
const FIRST_BOUNDS: f64 = 0.75;
/// Patches that are too small are dissolved, and the others may swell over them.
const ROUNDS: [Round; 5] = [
    Round { part: 0.3, faces: 0, swelling: 1.5, let_off: false },
    Round { part: 0.1, faces: 4, swelling: 2.5, let_off: false },
    Round { part: 0.1, faces: 4, swelling: 2.5, let_off: false },
    Round { part: 0.2, faces: 4, swelling: 2.5, let_off: true },
    Round { part: 0.2, faces: 4, swelling: 2.5, let_off: true },
];

/// One time of dissolving and swelling.
struct Round {
    /// The part of its splotch that a patch must cover.
    part: f64,
    /// The faces that it must have.
    faces: usize,
    /// How far beyond their splotches the others may swell.
    swelling: f64,
    /// Whether only patches that fail in both are dissolved, and their faces let off following the field: about a singularity its direction means little,
    /// and a seam is seen sooner than turned hair.
    let_off: bool,
}

/// Covers a mesh with lapped patches that do not overlap: every face lies in exactly one, and every patch is a topological disc.
///
/// With `directions` the tile's t axis follows the field; without, the tiling is isotropic: each patch is turned at random. No face is
/// flipped, and every face with area keeps the bounds on stretch and (with a field) turning; but the few that could keep the latter only in a tiny
/// patch, mostly about the field's singularities, are let off it ([`PatchTiling::let_off`]). A mesh without faces gives a tiling without
/// patches. The result depends on the arguments alone, to the last bit; it takes about 3 µs a face on one thread.
///
/// # Errors
/// Where a setting is out of range, the field is not of this mesh, or the model's diameter is beyond 1e±100 tiles.
pub fn grow(mesh: &Mesh, directions: Option<&DirectionField>, settings: &Settings) -> Result<PatchTiling, PatchError> {
    check_grow(mesh, directions, settings)?;
    let shapes = face_shapes(mesh, settings.tile_side);
    let rotations = directions.map(|field| face_rotations(mesh, field, &shapes, settings.tile_side));
    let wish = Wish { rotations: rotations.as_deref(), alignment: settings.alignment };
    let mut cover = Cover::new(mesh.topology(), &shapes, wish, settings);
    let mut order: Vec<FaceId> = mesh.topology().faces().map(Face::id).collect();
    order.shuffle(&mut cover.random);
    cover.fill(&order);
    cover.grower.bounds = Bounds::new(settings.max_stretch, settings.max_turning);
    for round in ROUNDS.iter().filter(|round| rotations.is_some() || !round.let_off) {
        cover.dissolve(round);
        cover.swell(round.swelling);
        cover.fill(&order);
    }
    let let_off = mesh.topology().faces().map(Face::id).filter(|face| cover.grower.let_off[face.index()]).collect();
    Ok(PatchTiling::from_drafts(mesh, settings.tile_side, cover.finished(), let_off))
}

/// That settings and field are of use for the mesh.
pub(crate) fn check_grow(mesh: &Mesh, directions: Option<&DirectionField>, settings: &Settings) -> Result<(), PatchError> {
    settings.validate()?;
    check_scale(mesh, settings.tile_side)?;
    let (given, vertices) = (directions.map(|field| field.vectors().len()), mesh.topology().vertex_count());
    match given.filter(|&given| given != vertices) {
        Some(directions) => Err(PatchError::DirectionCount { directions, vertices }),
        None => Ok(()),
    }
}

fn check_scale(mesh: &Mesh, tile_side: f64) -> Result<(), PatchError> {
    let diameter = mesh.diameter();
    let ratio = diameter / tile_side;
    if diameter == 0.0 || (1e-100..=1e100).contains(&ratio) { Ok(()) } else { Err(PatchError::Scale { diameter, tile_side }) }
}

struct Cover<'a> {
    grower: Grower<'a>,
    shapes: &'a [FaceShape],
    /// Dissolved ones are left empty.
    drafts: Vec<Draft>,
    extent: f64,
    random: Pcg64Mcg,
}

impl<'a> Cover<'a> {
    /// Nothing covered, and the bounds those of the first patches.
    fn new(topology: &'a Topology, shapes: &'a [FaceShape], wish: Wish<'a>, settings: &Settings) -> Self {
        let bounds = Bounds::new(libm::pow(settings.max_stretch, FIRST_BOUNDS), FIRST_BOUNDS * settings.max_turning);
        Self {
            grower: Grower::new(topology, shapes, wish, bounds),
            shapes,
            drafts: Vec::new(),
            extent: settings.patch_extent,
            random: Pcg64Mcg::seed_from_u64(settings.seed),
        }
    }

    /// Grows a patch from each face that is still uncovered when its turn comes.
    fn fill(&mut self, order: &[FaceId]) {
        for &seed in order {
            if self.grower.owners[seed.index()] == UNCOVERED {
                let splotch = Splotch::random(self.extent, &mut self.random);
                let single = self.grower.single(seed, splotch, random_rotation(&mut self.random));
                let draft = self.grower.grow(&single, 1.0);
                self.own(&draft, self.drafts.len() as u32);
                self.drafts.push(draft);
            }
        }
    }

    fn own(&mut self, draft: &Draft, owner: u32) {
        for face in &draft.faces {
            self.grower.owners[face.index()] = owner;
        }
    }

    /// Uncovers the faces of patches that are too small.
    fn dissolve(&mut self, round: &Round) {
        for index in 0..self.drafts.len() {
            let draft = &self.drafts[index];
            let area: f64 = draft.faces.iter().map(|f| self.shapes[f.index()].area()).sum();
            let (small, few) = (area < round.part * draft.splotch.area(), draft.faces.len() < round.faces);
            if if round.let_off { small && few } else { small || few } {
                let draft = Draft { faces: Vec::new(), vertices: Vec::new(), places: Vec::new(), splotch: draft.splotch };
                let dissolved = std::mem::replace(&mut self.drafts[index], draft);
                self.own(&dissolved, UNCOVERED);
                dissolved.faces.iter().for_each(|face| self.grower.let_off[face.index()] |= round.let_off);
            }
        }
    }

    /// Lets each patch grow over uncovered faces beyond its splotch.
    fn swell(&mut self, swelling: f64) {
        for index in 0..self.drafts.len() {
            if !self.drafts[index].faces.is_empty() {
                let draft = self.grower.grow(&self.drafts[index], swelling);
                self.own(&draft, index as u32);
                self.drafts[index] = draft;
            }
        }
    }

    /// The patches that are left, each moved to a random part of the tile: else all would show the same hairs in their middle.
    fn finished(mut self) -> Vec<Draft> {
        self.drafts.retain(|draft| !draft.faces.is_empty());
        for draft in &mut self.drafts {
            let shift = DVec2::new(self.random.random(), self.random.random());
            draft.places.iter_mut().for_each(|place| *place += shift);
        }
        self.drafts
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "a test says what it measured")]

    use std::f64::consts::TAU;

    use glam::DVec3;

    use super::*;

    /// A ring, a ball, one face, a fan of 5,000, a thousand balls of 20 faces, and a sheet with slivers and faces without area.
    fn meshes() -> Vec<Mesh> {
        let (torus, ball) = (pelage_mesh::torus(1.0, 0.4, 30, 12).unwrap(), pelage_mesh::sphere(1.0, 1).unwrap());
        let triangle = Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]]).unwrap();
        let rim = (0..5000).map(|k| DVec3::new((TAU * f64::from(k) / 5000.0).cos(), 0.0, -(TAU * f64::from(k) / 5000.0).sin()));
        let needles: Vec<[u32; 3]> = (0..5000).map(|k| [0, 1 + k, 1 + (k + 1) % 5000]).collect();
        let fan = Mesh::from_triangles(std::iter::once(DVec3::ZERO).chain(rim).collect(), &needles).unwrap();
        let count = ball.positions().len() as u32;
        let copies = (0..1000).flat_map(|k| ball.positions().iter().map(move |&p| p + 3.0 * f64::from(k) * DVec3::X)).collect();
        let faces: Vec<[u32; 3]> = (0..1000).flat_map(|k| ball.topology().triangles().map(move |t| t.map(|v| v + k * count))).collect();
        let balls = Mesh::from_triangles(copies, &faces).unwrap();
        let plane = pelage_mesh::plane(10.0, 10.0, 10, 10).unwrap();
        let squeezed = |p: DVec3| DVec3::new(if p.x > 1.5 { p.x - 1.0 + 1e-8 } else { p.x.min(0.0) }, p.y, p.z);
        let sheet = plane.with_positions(plane.positions().iter().map(|&p| squeezed(p)).collect()).unwrap();
        vec![torus, ball, triangle, fan, balls, sheet]
    }

    /// However small the splotches: as many patches as there are faces to cover at most, each with a face that was not covered, and then nothing is left.
    #[test]
    fn covering_takes_a_step_a_face_at_most() {
        let mut most = 0.0_f64;
        for mesh in meshes() {
            let faces: Vec<FaceId> = mesh.topology().faces().map(Face::id).collect();
            for patch_extent in [1e-6, 0.9, 100.0] {
                let settings = Settings { patch_extent, ..Settings::for_mesh(&mesh) };
                let shapes = face_shapes(&mesh, settings.tile_side);
                let mut cover = Cover::new(mesh.topology(), &shapes, Wish { rotations: None, alignment: 0.0 }, &settings);
                let mut uncovered = faces.len();
                for round in &ROUNDS {
                    let before = cover.drafts.len();
                    cover.fill(&faces);
                    let steps = cover.drafts.len() - before;
                    assert!(steps <= uncovered, "{steps} patches for {uncovered} faces");
                    most = most.max(steps as f64 / faces.len() as f64);
                    assert!(cover.grower.owners.iter().all(|&owner| owner != UNCOVERED));
                    let new = &cover.drafts[before..];
                    assert!(
                        new.iter().all(|draft| !draft.faces.is_empty())
                            && new.iter().map(|draft| draft.faces.len()).sum::<usize>() == uncovered
                    );
                    cover.dissolve(round);
                    cover.swell(round.swelling);
                    uncovered = cover.grower.owners.iter().filter(|&&owner| owner == UNCOVERED).count();
                }
            }
        }
        println!("reached: {most:.2} F steps in a round at most");
    }
}
