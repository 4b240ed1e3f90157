//! Patches that overlap: every one has the outline of its splotch and fades out towards it (L6).
//!
//! Praun, Finkelstein and Hoppe 2000 paste such patches over each other; Lengyel et al. 2001 compare them with the tiling that they draw (figure 4f): they need no seams, but more triangles, and
//! hair is twice as dense where two overlap.

mod clip;

use glam::{DVec2, DVec3};
use pelage_field::DirectionField;
use pelage_mesh::{Face, FaceId, Mesh, SurfacePoint};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::cover::check_grow;
use crate::distortion::Bounds;
use crate::frame::face_rotations;
use crate::growth::{Draft, Grower};
use crate::shape::{FaceShape, face_shapes};
use crate::solve::Wish;
use crate::splotch::{Splotch, random_rotation};
use crate::{PatchError, Settings};
use clip::Clipped;

/// From the middle of a splotch to its outline, where a patch begins to fade.
pub(crate) const WHOLE: f64 = 0.7;

/// A chart reaches so far beyond its splotch, so that the outline lies within it and not within what it lacks.
const REACH: f64 = 1.5;

/// Places at which it is looked whether a face is covered are no further apart than this part of a splotch's diameter.
const APART: f64 = 0.2;

/// At least so many such places along a side of a face, and at most.
const ALONG: (f64, f64) = (2.0, 512.0);

/// More patches than these are not made.
const MOST_PATCHES: f64 = 1e6;

/// A surface covered by patches that overlap, each laid out in the plane of a hair tile that repeats. The later lie over the earlier.
#[derive(Clone, Debug, PartialEq)]
pub struct LappedPatches {
    points: Vec<SurfacePoint>,
    coordinates: Vec<DVec2>,
    opacities: Vec<f32>,
    faces: Vec<[u32; 3]>,
    patch_ends: Vec<u32>,
    tile_side: f64,
}

impl LappedPatches {
    /// Where on the mesh each patch vertex is.
    pub fn points(&self) -> &[SurfacePoint] {
        &self.points
    }

    /// Where each lies, (s, t), in tiles: 1 is one repeat.
    pub fn coordinates(&self) -> &[DVec2] {
        &self.coordinates
    }

    /// How opaque the patch is at each: 1 in its middle, 0 at its outline.
    pub fn opacities(&self) -> &[f32] {
        &self.opacities
    }

    /// The corners of each triangle as patch vertices, in winding order; those of a patch are contiguous.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// Where the triangles of each patch end.
    pub fn patch_ends(&self) -> &[u32] {
        &self.patch_ends
    }

    /// The side of the tile on the surface, in model units.
    pub fn tile_side(&self) -> f64 {
        self.tile_side
    }

    /// How many bytes it holds, for a cache to count.
    pub fn byte_size(&self) -> usize {
        size_of_val(&*self.points)
            + size_of_val(&*self.coordinates)
            + size_of_val(&*self.opacities)
            + size_of_val(&*self.faces)
            + size_of_val(&*self.patch_ends)
    }

    fn push(&mut self, clipped: Clipped) {
        let first = self.points.len() as u32;
        self.points.extend(clipped.points);
        self.coordinates.extend(clipped.places);
        self.opacities.extend(clipped.opacities);
        self.faces.extend(clipped.triangles.into_iter().map(|triangle| triangle.map(|corner| first + corner)));
        self.patch_ends.push(self.faces.len() as u32);
    }
}

/// Covers a mesh with patches that overlap, each with the outline of its splotch cut into its chart. Settings are those of [`grow`](crate::grow); a patch is placed wherever the surface is not
/// yet covered by one that is whole there, as far as places a fifth of a patch apart tell. The result depends on the arguments alone.
///
/// # Errors
/// Those of [`grow`](crate::grow), and patches so small that a million would not cover the mesh.
pub fn lap(mesh: &Mesh, directions: Option<&DirectionField>, settings: &Settings) -> Result<LappedPatches, PatchError> {
    check_grow(mesh, directions, settings)?;
    let shapes = face_shapes(mesh, settings.tile_side);
    let rotations = directions.map(|field| face_rotations(mesh, field, &shapes, settings.tile_side));
    let wish = Wish { rotations: rotations.as_deref(), alignment: settings.alignment };
    // No face is ever owned, so that every patch may lie over all others.
    let mut grower = Grower::new(mesh.topology(), &shapes, wish, Bounds::new(settings.max_stretch, settings.max_turning));
    let mut random = Pcg64Mcg::seed_from_u64(settings.seed);
    let mut order: Vec<FaceId> = mesh.topology().faces().map(Face::id).collect();
    order.shuffle(&mut random);
    let mut covered = Covered::none(&shapes, settings)?;
    let mut lapped = LappedPatches {
        points: Vec::new(),
        coordinates: Vec::new(),
        opacities: Vec::new(),
        faces: Vec::new(),
        patch_ends: Vec::new(),
        tile_side: settings.tile_side,
    };
    for seed in order {
        for number in 0..covered.samples(seed).len() {
            if covered.samples(seed)[number] {
                continue;
            }
            let splotch = Splotch::random(settings.patch_extent, &mut random);
            let mut single = grower.single(seed, splotch, random_rotation(&mut random));
            let parts = covered.place(seed, number);
            centre(&mut single, [0, 1, 2], parts);
            let mut draft = grower.grow(&single, REACH);
            // Solving has moved it about the middle of its first face.
            let corners = clip::corners(&draft, mesh);
            centre(&mut draft, corners[0], parts);
            covered.cover(&draft, &corners);
            let shift = DVec2::new(random.random(), random.random());
            lapped.push(clip::clipped(&draft, &corners, shift));
        }
    }
    Ok(lapped)
}

/// Moves a draft so that a place in its first face is at the origin, about which its splotch lies.
fn centre(draft: &mut Draft, corners: [u32; 3], parts: DVec3) {
    let middle: DVec2 = corners.iter().zip(parts.to_array()).map(|(&corner, part)| part * draft.places[corner as usize]).sum();
    draft.places.iter_mut().for_each(|place| *place -= middle);
}

/// Which places of which faces some patch covers whole: the middles of as many equal triangles as a face is cut into, evenly along its sides.
struct Covered {
    /// Triangles along a side of each face.
    along: Vec<u32>,
    /// Where those of each face begin.
    first: Vec<usize>,
    covered: Vec<bool>,
}

impl Covered {
    fn none(shapes: &[FaceShape], settings: &Settings) -> Result<Self, PatchError> {
        let wanted = |shape: &FaceShape| {
            let sides = (0..3).map(|k| shape.corners[k].distance(shape.corners[(k + 1) % 3]));
            (sides.fold(0.0, f64::max) / (APART * settings.patch_extent)).ceil()
        };
        let area: f64 = shapes.iter().map(FaceShape::area).sum();
        if area > MOST_PATCHES * settings.patch_extent * settings.patch_extent || shapes.iter().any(|shape| wanted(shape) > ALONG.1) {
            let wanted =
                "so large, for this tile and mesh, that a million patches cover it, and that no face is a hundred times as long as one";
            return Err(PatchError::Setting { name: "patch_extent", value: settings.patch_extent, wanted });
        }
        let along: Vec<u32> = shapes.iter().map(|shape| wanted(shape).max(ALONG.0) as u32).collect();
        let mut first = vec![0];
        along.iter().for_each(|&along| first.push(first[first.len() - 1] + along as usize * along as usize));
        let covered = vec![false; first[along.len()]];
        Ok(Self { along, first, covered })
    }

    fn samples(&self, face: FaceId) -> &[bool] {
        &self.covered[self.first[face.index()]..self.first[face.index() + 1]]
    }

    /// The barycentric coordinates of a face's place.
    fn place(&self, face: FaceId, number: usize) -> DVec3 {
        let along = self.along[face.index()] as usize;
        let (row, column) = (number / along, number % along);
        // Of a square of places that lies over the diagonal, the triangle that points the other way.
        let upright = row + column < along;
        let (i, j) = if upright { (row, column) } else { (along - 1 - row, along - 1 - column) };
        let third = if upright { 1.0 / 3.0 } else { 2.0 / 3.0 };
        let (a, b) = ((i as f64 + third) / along as f64, (j as f64 + third) / along as f64);
        DVec3::new(a, b, 1.0 - a - b)
    }

    /// Marks what a patch covers whole.
    fn cover(&mut self, draft: &Draft, corners: &[[u32; 3]]) {
        for (&face, corners) in draft.faces.iter().zip(corners) {
            let places = corners.map(|corner| draft.places[corner as usize]);
            for sample in 0..self.samples(face).len() {
                let place: DVec2 = places.iter().zip(self.place(face, sample).to_array()).map(|(&corner, part)| part * corner).sum();
                if draft.splotch.contains(place, WHOLE) {
                    let at = self.first[face.index()] + sample;
                    self.covered[at] = true;
                }
            }
        }
    }
}
