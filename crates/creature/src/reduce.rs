//! Fewer faces: the edge that is most too short goes first.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::body::Body;
use crate::skin::{Facet, Skin, Worst};

/// An edge in the queue, out of date once one of its ends has changed.
struct Candidate {
    cost: f64,
    half_edge: u32,
    ages: [u32; 2],
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.cost.total_cmp(&other.cost).then(self.half_edge.cmp(&other.half_edge))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}

/// Takes edges out of a skin until it has at most `faces`, or none can go any more.
pub(crate) fn reduce(skin: &mut Skin, body: &Body, thickness: &mut [f64], faces: usize) {
    let mut reduction = Reduction { ages: vec![0; skin.vertex_count()], queue: BinaryHeap::new(), skin, body, thickness };
    reduction.fill();
    reduction.run(faces);
}

struct Reduction<'a> {
    skin: &'a mut Skin,
    body: &'a Body,
    /// Half the width of the body at each vertex.
    thickness: &'a mut [f64],
    ages: Vec<u32>,
    queue: BinaryHeap<Reverse<Candidate>>,
}

impl Reduction<'_> {
    fn fill(&mut self) {
        let edges = (0..self.skin.half_edge_count()).filter(|&h| self.skin.is_alive(h) && h < self.skin.twin(h));
        self.queue = edges.map(|h| Reverse(self.candidate(h))).collect();
    }

    fn run(&mut self, faces: usize) {
        while self.skin.face_count() > faces
            && let Some(Reverse(candidate)) = self.queue.pop()
        {
            let h = candidate.half_edge;
            if self.skin.is_alive(h) && self.ends_ages(h) == candidate.ages && self.skin.can_collapse(h) {
                self.try_collapse(h);
            }
        }
    }

    fn ends_ages(&self, half_edge: u32) -> [u32; 2] {
        [self.skin.origin(half_edge), self.skin.tip(half_edge)].map(|v| self.ages[v as usize])
    }

    /// An edge costs its length; more where it is long for the limb it lies on, so that a leg keeps sides while there are faces at all.
    fn candidate(&self, half_edge: u32) -> Candidate {
        let [u, v] = [self.skin.origin(half_edge), self.skin.tip(half_edge)];
        let length = self.skin.at(u).distance(self.skin.at(v));
        let thickness = self.thickness[u as usize].min(self.thickness[v as usize]);
        let wide = length / (1.5 * thickness);
        Candidate { cost: length * (1.0 + wide * wide), half_edge, ages: self.ends_ages(half_edge) }
    }

    /// To the surface under the middle of the edge; where that would spoil a face, to one of its ends. Marching cubes leaves knots of vertices far closer
    /// than a cell: there any new place makes some needle a little worse, and only an end leaves those of the other vertices as they are.
    fn try_collapse(&mut self, half_edge: u32) {
        let (u, v) = (self.skin.origin(half_edge), self.skin.tip(half_edge));
        let (a, b) = (self.skin.at(u), self.skin.at(v));
        let before = Worst::of([u, v].into_iter().flat_map(|end| self.skin.facets(end)));
        let fits = |&(to, normal): &(DVec3, DVec3)| {
            Worst::of(self.moved(u, v, to, normal).chain(self.moved(v, u, to, normal))).may_replace(before)
        };
        let middle = self.body.project(a.midpoint(b), a.distance(b), 2);
        let middle = (middle, self.body.value_and_gradient(middle).1.normalize_or_zero());
        let ends = [v, u].map(|end| (self.skin.at(end), self.skin.normals[end as usize]));
        let Some((to, normal)) = [middle, ends[0], ends[1]].into_iter().find(fits) else { return };
        self.thickness[v as usize] = 0.5 * (self.thickness[u as usize] + self.thickness[v as usize]);
        self.skin.collapse(half_edge, to, normal);
        self.ages[v as usize] += 1;
        let again: Vec<_> = self.skin.ring(v).map(|h| Reverse(self.candidate(h))).collect();
        self.queue.extend(again);
    }

    /// The faces of a vertex, but for those that go with another, once it is moved.
    fn moved(&self, vertex: u32, gone: u32, to: DVec3, normal: DVec3) -> impl Iterator<Item = Facet> + '_ {
        self.skin.ring(vertex).filter(move |&h| !self.skin.corners(h).contains(&gone)).map(move |h| {
            let mut facet = self.skin.facet(h);
            (facet.corners[0], facet.normals[0]) = (to, normal);
            facet
        })
    }
}

/// Flips edges until each is that of a Delaunay triangulation as far as the surface is flat (the angles across it add up to at most π), which makes
/// the least angles as large as they can be; at most some rounds.
pub(crate) fn flip_to_delaunay(skin: &mut Skin, rounds: u32) {
    for _ in 0..rounds {
        let mut flips = 0;
        for h in 0..skin.half_edge_count() {
            if skin.is_alive(h) && h < skin.twin(h) && wants_flip(skin, h) && skin.can_flip(h) {
                skin.flip(h);
                flips += 1;
            }
        }
        if flips == 0 {
            break;
        }
    }
}

fn wants_flip(skin: &Skin, h: u32) -> bool {
    let (left, right) = (skin.facet(h), skin.facet(skin.twin(h)));
    let ([a, b, c], [_, _, d]) = (left.corners, right.corners);
    let cotangent = |apex: DVec3| (a - apex).dot(b - apex) / (a - apex).cross(b - apex).length().max(1e-300);
    if cotangent(c) + cotangent(d) > -1e-9 {
        return false;
    }
    let ([na, nb, nc], [_, _, nd]) = (left.normals, right.normals);
    let cut = [Facet { corners: [c, d, b], normals: [nc, nd, nb] }, Facet { corners: [d, c, a], normals: [nd, nc, na] }];
    Worst::of(cut.into_iter()).may_replace(Worst::of([left, right].into_iter()))
}
