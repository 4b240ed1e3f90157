//! Rays and closest points, through a hierarchy of boxes.

mod boxes;
mod closest;
mod crossing;
mod ray;

pub use closest::Nearest;
pub use ray::{Hit, Ray, RayError, Side};

use glam::DVec3;

use crate::Mesh;
use boxes::Boxes;
use crossing::Shear;

/// Finds where rays hit a mesh and which of its points are near, in about logarithmic time.
///
/// The hierarchy is that of `obvhs`, over boxes in `f32`; it only says which faces to look at. Positions are brought to the mesh's own box first and the boxes
/// are padded by more than rounding, so that no face is missed at any scale; what is said of a face is worked out in `f64`. Ties go to the lower face.
///
/// ```
/// use glam::DVec3;
/// use pelage_mesh::{Ray, Side, SpatialIndex, sphere};
///
/// let ball = sphere(2.0, 16)?;
/// let index = SpatialIndex::of(&ball);
/// let hit = index.first_hit(&Ray::new(5.0 * DVec3::Z, DVec3::NEG_Z)?).ok_or("missed")?;
/// assert!((hit.distance - 3.0).abs() < 1e-12 && hit.side == Side::Outer);
/// let nearest = index.closest_point(DVec3::new(0.0, 7.0, 0.0)).ok_or("no faces")?;
/// assert!((nearest.distance - 5.0).abs() < 1e-12);
/// assert_eq!(index.hits(&Ray::new(DVec3::ZERO, DVec3::ONE)?).len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct SpatialIndex<'a> {
    mesh: &'a Mesh,
    boxes: Boxes,
}

impl std::fmt::Debug for SpatialIndex<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SpatialIndex").field("faces", &self.mesh.topology().face_count()).finish_non_exhaustive()
    }
}

/// The mesh is not one that an index can be moved to.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the mesh has {found} faces, the index was made for {expected}; make a new index")]
pub struct IndexError {
    /// Faces of the mesh.
    pub found: usize,
    /// Faces of the index.
    pub expected: usize,
}

impl<'a> SpatialIndex<'a> {
    /// Builds the hierarchy of a mesh: O(n log n), and about 200 bytes a face. A mesh without faces has nothing to be found.
    pub fn of(mesh: &'a Mesh) -> Self {
        Self { mesh, boxes: Boxes::around(mesh) }
    }

    /// The mesh that is searched.
    pub fn mesh(&self) -> &'a Mesh {
        self.mesh
    }

    /// The index of a mesh with the same faces and other positions: linear time, far less than building. What lay together should still lie
    /// together, or boxes overlap and searches take longer; their answers are right all the same.
    ///
    /// # Errors
    /// Where the mesh has another number of faces.
    pub fn refit<'b>(self, mesh: &'b Mesh) -> Result<SpatialIndex<'b>, IndexError> {
        let (found, expected) = (mesh.topology().face_count(), self.mesh.topology().face_count());
        if found == expected { Ok(SpatialIndex { mesh, boxes: self.boxes.refit(mesh) }) } else { Err(IndexError { found, expected }) }
    }

    /// Where a ray first hits the surface, from either side.
    ///
    /// A ray through an edge or a vertex hits exactly one of the faces there if it passes through the surface, as if it were moved aside by less than can be
    /// told: it never slips through a closed mesh. On the rim of an open one it hits or misses.
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.crossings(ray, |hit| {
            if best.is_none_or(|best| (hit.distance, hit.point.face) < (best.distance, best.point.face)) {
                best = Some(hit);
            }
            Some(best.map_or(f64::INFINITY, |best| best.distance))
        });
        best
    }

    /// Whether a ray hits the surface at all.
    pub fn is_hit(&self, ray: &Ray) -> bool {
        let mut found = false;
        self.crossings(ray, |_| {
            found = true;
            None
        });
        found
    }

    /// Every hit of a ray, nearest first; those at one distance by their face. From a point inside a closed mesh there is an odd number.
    pub fn hits(&self, ray: &Ray) -> Vec<Hit> {
        let mut all = Vec::new();
        self.crossings(ray, |hit| {
            all.push(hit);
            Some(f64::INFINITY)
        });
        all.sort_unstable_by(|a, b| a.distance.total_cmp(&b.distance).then(a.point.face.cmp(&b.point.face)));
        all
    }

    /// Calls `visit` with hits in no order; it answers how far it wants others, or that it wants no more.
    fn crossings(&self, ray: &Ray, mut visit: impl FnMut(Hit) -> Option<f64>) {
        let boxes = &self.boxes;
        let shear = Shear::new(boxes.to_frame(ray.origin()), ray.direction());
        boxes.along(&shear, ray.limits().1 / boxes.scale(), |face| {
            let hit = boxes.crossing(&shear, self.mesh, face).and_then(|crossing| ray.hit(crossing, boxes.scale()));
            hit.map_or(Some(f64::INFINITY), |hit| visit(hit).map(|limit| limit / boxes.scale()))
        });
    }

    /// The point of the surface that is closest to `point`; none for a mesh without faces, or if `point` is not finite.
    pub fn closest_point(&self, point: DVec3) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        self.nearby(point, f64::INFINITY, |nearest| {
            if best.is_none_or(|best| nearest.is_before(&best)) {
                best = Some(nearest);
            }
            best.map_or(f64::INFINITY, |best| best.distance)
        });
        best
    }

    /// The faces of which some point is within `radius` of `point`, each with its closest point; nearest first, at one distance by face.
    pub fn within(&self, point: DVec3, radius: f64) -> Vec<Nearest> {
        let mut all = Vec::new();
        self.nearby(point, radius, |nearest| {
            if nearest.distance <= radius {
                all.push(nearest);
            }
            radius
        });
        all.sort_unstable_by(|a, b| a.distance.total_cmp(&b.distance).then(a.point.face.cmp(&b.point.face)));
        all
    }

    /// Calls `visit` with the closest points of faces in no order; it answers how far it wants others.
    fn nearby(&self, point: DVec3, radius: f64, mut visit: impl FnMut(Nearest) -> f64) {
        if !point.is_finite() {
            return;
        }
        let boxes = &self.boxes;
        let place = boxes.to_frame(point);
        let mut limit = radius / boxes.scale();
        boxes.near(place, limit, |face| {
            let corners = self.mesh.face(face).vertices().map(|v| boxes.place(v.id()));
            // Several faces share a box, and most of them are further off than it.
            if !boxes::is_beyond(place, corners, limit) {
                limit = limit.min(visit(Nearest::new(self.mesh, face, closest::on_triangle(place, corners), point)) / boxes.scale());
            }
            limit
        });
    }
}
