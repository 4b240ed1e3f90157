//! The hierarchy: which faces may lie along a ray or near a point.

use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::{Boundable, BvhBuildParams};

use super::crossing::{Crossing, Shear};
use crate::{Face, FaceId, Mesh, VertexId};

/// Boxes are this much larger than their faces, in halves of the mesh's extent: more than the rounding of `f32` near 1 and of a ray that starts within a million extents.
const PADDING: f32 = 1e-6;

/// A ray's places are off by at most this part of how far it starts from the mesh.
const RAY_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A box's distance may be off by this part.
const BOX_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Points further off than this many extents are searched for from here, as all faces are equally far then.
const FARTHEST: f64 = 1e100;

/// A hierarchy over the faces in a frame of their own: centred, the longest side of their box from −1 to 1.
#[derive(Clone)]
pub(super) struct Boxes {
    centre: DVec3,
    scale: f64,
    places: Vec<DVec3>,
    tree: Bvh2,
}

struct PaddedFace(Aabb);

impl Boundable for PaddedFace {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

/// Whether the padded box of a face is further from a point than `limit`.
#[inline]
pub(super) fn is_beyond(point: DVec3, [a, b, c]: [DVec3; 3], limit: f64) -> bool {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let outside = ((low - point).max(point - high) - f64::from(PADDING)).max(DVec3::ZERO);
    outside.length_squared() > limit * limit
}

impl Boxes {
    pub(super) fn around(mesh: &Mesh) -> Self {
        let mut boxes = Self { tree: Bvh2::default(), ..Self::framed(mesh) };
        let faces: Vec<PaddedFace> = mesh.faces().map(|face| PaddedFace(boxes.padded(face))).collect();
        if !faces.is_empty() {
            boxes.tree = build_bvh2(&faces, BvhBuildParams::medium_build(), &mut Duration::default());
        }
        boxes
    }

    fn framed(mesh: &Mesh) -> Self {
        let (low, high) = mesh.bounds().unwrap_or_default();
        let scale = (0.5 * high - 0.5 * low).max_element();
        let mut boxes = Self {
            centre: 0.5 * low + 0.5 * high,
            scale: if scale > 0.0 { scale } else { 1.0 },
            places: Vec::new(),
            tree: Bvh2::default(),
        };
        boxes.places = mesh.positions().iter().map(|&p| boxes.to_frame(p)).collect();
        boxes
    }

    /// The same hierarchy over moved faces.
    pub(super) fn refit(self, mesh: &Mesh) -> Self {
        let mut boxes = Self { tree: self.tree, ..Self::framed(mesh) };
        for node in 0..boxes.tree.nodes.len() {
            let (first, count) = (boxes.tree.nodes[node].first_index as usize, boxes.tree.nodes[node].prim_count as usize);
            if boxes.tree.nodes[node].is_leaf() {
                let faces = &boxes.tree.primitive_indices[first..first + count];
                let around = faces.iter().map(|&face| boxes.padded(mesh.face(FaceId(face))));
                let around = around.reduce(|a, b| a.union(&b)).unwrap_or_default();
                boxes.tree.nodes[node].set_aabb(around);
            }
        }
        boxes.tree.refit_all();
        boxes
    }

    fn padded(&self, face: Face<'_, Mesh>) -> Aabb {
        let [a, b, c] = face.vertices().map(|v| self.place(v.id()));
        let (low, high) = (a.min(b).min(c).as_vec3a(), a.max(b).max(c).as_vec3a());
        Aabb::new(low - Vec3A::splat(PADDING), high + Vec3A::splat(PADDING))
    }

    /// Model units in a unit of the frame.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// A place in model units, in the frame.
    pub(super) fn to_frame(&self, point: DVec3) -> DVec3 {
        (point - self.centre) / self.scale
    }

    /// Where a vertex is in the frame.
    #[inline]
    pub(super) fn place(&self, vertex: VertexId) -> DVec3 {
        self.places[vertex.index()]
    }

    /// Where a ray crosses a face.
    #[inline]
    pub(super) fn crossing(&self, shear: &Shear, mesh: &Mesh, face: FaceId) -> Option<Crossing> {
        shear.crossing(face, mesh.face(face).vertices().map(|v| self.place(v.id())))
    }

    /// Calls `visit` with every face that a ray may hit within `limit`; it answers with a new limit, or that it wants no more.
    pub(super) fn along(&self, shear: &Shear, limit: f64, mut visit: impl FnMut(FaceId) -> Option<f64>) {
        let slack = RAY_ROUNDING * shear.origin().abs().max_element();
        let entry = |node: u32| {
            let around = self.tree.nodes[node as usize].aabb();
            shear.entry(around.min.as_dvec3() - slack, around.max.as_dvec3() + slack)
        };
        self.nearest_first(limit, entry, &mut visit);
    }

    /// Calls `visit` with every face that may be within `limit` of a point of the frame; it answers with a new limit.
    pub(super) fn near(&self, point: DVec3, limit: f64, mut visit: impl FnMut(FaceId) -> f64) {
        let point =
            if point.is_finite() { point.clamp_length_max(FARTHEST) } else { point.clamp(DVec3::splat(-FARTHEST), DVec3::splat(FARTHEST)) };
        let distance = |node: u32| {
            let around = self.tree.nodes[node as usize].aabb();
            let outside = (around.min.as_dvec3() - point).max(point - around.max.as_dvec3()).max(DVec3::ZERO);
            outside.length() * (1.0 - BOX_ROUNDING)
        };
        self.nearest_first(limit, distance, |face| Some(visit(face)));
    }

    /// Visits the leaves whose distance is within a limit that falls, the nearer of two children first.
    fn nearest_first(&self, mut limit: f64, distance: impl Fn(u32) -> f64, mut visit: impl FnMut(FaceId) -> Option<f64>) {
        if self.tree.nodes.is_empty() {
            return;
        }
        let mut open = vec![(distance(0), 0)];
        while let Some((nearest, node)) = open.pop() {
            if nearest > limit || nearest == f64::INFINITY {
                continue;
            }
            let node = &self.tree.nodes[node as usize];
            let first = node.first_index;
            if node.is_leaf() {
                for &face in &self.tree.primitive_indices[first as usize..(first + node.prim_count) as usize] {
                    match visit(FaceId(face)) {
                        Some(wanted) => limit = limit.min(wanted),
                        None => return,
                    }
                }
            } else {
                let [a, b] = [first, first + 1].map(|child| (distance(child), child));
                open.extend(if a.0 <= b.0 { [b, a] } else { [a, b] });
            }
        }
    }
}
