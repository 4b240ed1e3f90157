//! The hierarchy over hair and skin: what a ray meets first.

use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::ray::safe_inverse;
use obvhs::{Boundable, BvhBuildParams};

use crate::cone::{self, Span};
use crate::ray::Ray;
use crate::segment::Segment;
use crate::triangle;

/// Boxes are larger than what they hold by this part of the largest coordinate: more than the rounding of boxes, of a ray's origin and of the places where it
/// enters, all in `f32`.
const PADDING: f32 = 2e-6;

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Met {
    /// Which segment, and how far along its axis, 0 to 1.
    Hair { segment: usize, part: f64 },
    /// Which face of the patches, and the barycentric coordinates.
    Skin { face: usize, beta: DVec3 },
}

/// What is met first, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    pub(crate) distance: f64,
    pub(crate) met: Met,
}

/// Round cones and triangles in boxes, as `obvhs` groups them.
pub(crate) struct Tree {
    pub(crate) segments: Vec<Segment>,
    pub(crate) triangles: Vec<[DVec3; 3]>,
    bvh: Bvh2,
    low: DVec3,
    high: DVec3,
}

struct Boxed(Aabb);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

/// A ray as boxes see it.
struct Slabs {
    origin: Vec3A,
    inverse: Vec3A,
}

impl Slabs {
    /// Where it enters a box; infinite where it does not before `to`.
    fn enters(&self, around: &Aabb, to: f32) -> f32 {
        let (a, b) = ((around.min - self.origin) * self.inverse, (around.max - self.origin) * self.inverse);
        let enter = a.min(b).max_element().max(0.0);
        let leave = a.max(b).min_element().min(to);
        if enter <= leave { enter } else { f32::INFINITY }
    }
}

/// Boxes yet to be opened: where the ray enters them, and their number. One for each thread, so that no ray allocates.
pub(crate) type Stack = Vec<(f32, u32)>;

impl Tree {
    pub(crate) fn new(segments: Vec<Segment>, triangles: Vec<[DVec3; 3]>) -> Self {
        let hair = segments.iter().map(|segment| {
            let [a, b] = segment.ends.map(Vec3A::from);
            let [ra, rb] = segment.radii.map(Vec3A::splat);
            Aabb::new((a - ra).min(b - rb), (a + ra).max(b + rb))
        });
        let skin = triangles.iter().map(|corners| Aabb::from_points(&corners.map(DVec3::as_vec3a)));
        let mut boxes: Vec<Boxed> = hair.chain(skin).map(Boxed).collect();
        let all = boxes.iter().fold(Aabb::INVALID, |all, one| all.union(&one.0));
        let pad = Vec3A::splat(PADDING * all.min.abs().max(all.max.abs()).max_element());
        for one in &mut boxes {
            one.0 = Aabb::new(one.0.min - pad, one.0.max + pad);
        }
        let bvh =
            if boxes.is_empty() { Bvh2::default() } else { build_bvh2(&boxes, BvhBuildParams::fast_build(), &mut Duration::default()) };
        Self { segments, triangles, bvh, low: (all.min - pad).as_dvec3(), high: (all.max + pad).as_dvec3() }
    }

    /// Bytes of primitives and boxes.
    pub(crate) fn byte_size(&self) -> usize {
        size_of_val(&self.segments[..])
            + size_of_val(&self.triangles[..])
            + size_of_val(&self.bvh.nodes[..])
            + size_of_val(&self.bvh.primitive_indices[..])
    }

    /// What the ray meets first; of two at one distance that with the lower number, so that it does not depend on the order of boxes. `shown` says what of the way
    /// through a segment is to be met.
    pub(crate) fn first(&self, ray: &Ray, stack: &mut Stack, shown: impl Fn(usize, Span) -> Option<Span>) -> Option<Hit> {
        let mut best: Option<(Hit, usize)> = None;
        self.along(ray, stack, |primitive, limit| {
            let hit = self.hit(primitive, ray, limit, &shown);
            let hit = hit.filter(|hit| best.is_none_or(|(best, number)| (hit.distance, primitive) < (best.distance, number)));
            if let Some(hit) = hit {
                best = Some((hit, primitive));
                return hit.distance;
            }
            limit
        });
        best.map(|(hit, _)| hit)
    }

    /// Whether anything is on the ray.
    pub(crate) fn is_blocked(&self, ray: &Ray, stack: &mut Stack, shown: impl Fn(usize, Span) -> Option<Span>) -> bool {
        let mut blocked = false;
        self.along(ray, stack, |primitive, limit| {
            blocked = blocked || self.hit(primitive, ray, limit, &shown).is_some();
            if blocked { f64::NEG_INFINITY } else { limit }
        });
        blocked
    }

    /// Where the ray meets a primitive, no further than `limit`. One that starts inside of a hair meets it there.
    fn hit(&self, primitive: usize, ray: &Ray, limit: f64, shown: &impl Fn(usize, Span) -> Option<Span>) -> Option<Hit> {
        if let Some(segment) = self.segments.get(primitive) {
            let (ends, radii) = (segment.axis(), segment.radii.map(f64::from));
            let reached = |span: &Span| span.leave >= ray.from && span.enter <= limit;
            let span = cone::span(ray, ends, radii).filter(reached)?;
            let span = shown(primitive, span).filter(reached)?;
            let distance = span.enter.max(ray.from);
            let part = cone::part_at(ray.at(distance), ends, radii);
            return Some(Hit { distance, met: Met::Hair { segment: primitive, part } });
        }
        let face = primitive - self.segments.len();
        let (distance, beta) = triangle::crossing(ray, self.triangles[face])?;
        (distance >= ray.from && distance <= limit).then_some(Hit { distance, met: Met::Skin { face, beta } })
    }

    /// Calls `visit` with every primitive whose box the ray passes, the nearer boxes first, and how far it wants others; it answers with a new limit.
    fn along(&self, ray: &Ray, stack: &mut Stack, mut visit: impl FnMut(usize, f64) -> f64) {
        // Boxes are tested from where the ray comes to the scene, in f32.
        let Some(shift) = self.comes_in(ray) else { return };
        let slabs = Slabs { origin: ray.at(shift).as_vec3a(), inverse: inverse(ray.direction) };
        let mut limit = ray.to;
        let bound = |limit: f64| ((limit - shift) * (1.0 + 1e-6)) as f32;
        stack.clear();
        stack.push((slabs.enters(self.bvh.nodes[0].aabb(), bound(limit)), 0));
        while let Some((enter, node)) = stack.pop() {
            if enter > bound(limit) || enter == f32::INFINITY {
                continue;
            }
            let node = &self.bvh.nodes[node as usize];
            let first = node.first_index;
            if node.is_leaf() {
                for &primitive in &self.bvh.primitive_indices[first as usize..(first + node.prim_count) as usize] {
                    limit = visit(primitive as usize, limit);
                }
            } else {
                let [a, b] = [first, first + 1].map(|child| (slabs.enters(self.bvh.nodes[child as usize].aabb(), bound(limit)), child));
                let (near, far) = if a.0 <= b.0 { (a, b) } else { (b, a) };
                stack.extend([far, near].into_iter().filter(|child| child.0 < f32::INFINITY));
            }
        }
    }

    /// How far along the ray the scene's box begins; none where it misses.
    fn comes_in(&self, ray: &Ray) -> Option<f64> {
        if self.bvh.nodes.is_empty() {
            return None;
        }
        let (mut enter, mut leave) = (ray.from, ray.to);
        for axis in 0..3 {
            let (start, step) = (ray.origin[axis], ray.direction[axis]);
            if step == 0.0 {
                if start < self.low[axis] || start > self.high[axis] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((self.low[axis] - start) / step, (self.high[axis] - start) / step);
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        }
        (enter <= leave).then_some(enter)
    }
}

fn inverse(direction: DVec3) -> Vec3A {
    let [x, y, z] = direction.as_vec3a().to_array().map(safe_inverse);
    Vec3A::new(x, y, z)
}
