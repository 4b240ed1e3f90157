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
use crate::shape::face_shapes;
use crate::solve::Wish;
use crate::splotch::{Splotch, random_rotation};
use crate::{PatchError, Settings};
use clip::Clipped;

/// From the middle of a splotch to its outline, where a patch begins to fade.
pub(crate) const WHOLE: f64 = 0.7;

/// A chart reaches so far beyond its splotch, so that the outline lies within it and not within what it lacks.
const REACH: f64 = 1.5;

/// Where in a face it is looked whether it is covered, as barycentric coordinates.
const SAMPLES: [DVec3; 7] = [
    DVec3::new(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0),
    DVec3::new(0.9, 0.05, 0.05),
    DVec3::new(0.05, 0.9, 0.05),
    DVec3::new(0.05, 0.05, 0.9),
    DVec3::new(0.05, 0.475, 0.475),
    DVec3::new(0.475, 0.05, 0.475),
    DVec3::new(0.475, 0.475, 0.05),
];

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
/// yet covered by one that is whole there. The result depends on the arguments alone.
///
/// # Errors
/// Those of [`grow`](crate::grow).
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
    let mut covered = vec![0u8; order.len()];
    let mut lapped = LappedPatches {
        points: Vec::new(),
        coordinates: Vec::new(),
        opacities: Vec::new(),
        faces: Vec::new(),
        patch_ends: Vec::new(),
        tile_side: settings.tile_side,
    };
    for seed in order {
        while let Some(sample) = (0..SAMPLES.len()).find(|sample| covered[seed.index()] >> sample & 1 == 0) {
            // Whatever comes of it, this place is done with.
            covered[seed.index()] |= 1 << sample;
            let splotch = Splotch::random(settings.patch_extent, &mut random);
            let mut single = grower.single(seed, splotch, random_rotation(&mut random));
            let middle: DVec2 = single.places.iter().zip(SAMPLES[sample].to_array()).map(|(&place, part)| part * place).sum();
            single.places.iter_mut().for_each(|place| *place -= middle);
            let draft = grower.grow(&single, REACH);
            cover(&draft, mesh, &mut covered);
            let shift = DVec2::new(random.random(), random.random());
            lapped.push(clip::clipped(&draft, mesh, shift));
        }
    }
    Ok(lapped)
}

/// Marks what a patch covers whole.
fn cover(draft: &Draft, mesh: &Mesh, covered: &mut [u8]) {
    let corners = clip::corners(draft, mesh);
    for (face, corners) in draft.faces.iter().zip(&corners) {
        for (number, sample) in SAMPLES.iter().enumerate() {
            let place = corners.iter().zip(sample.to_array()).map(|(&corner, part)| part * draft.places[corner as usize]).sum::<DVec2>();
            if draft.splotch.contains(place, WHOLE) {
                covered[face.index()] |= 1 << number;
            }
        }
    }
}
