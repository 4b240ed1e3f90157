//! Makes tangent vectors from wanted ones, smoothly completed where little is known.

use std::collections::VecDeque;

use glam::DVec3;
use pelage_mesh::{Mesh, Topology, Vertex, VertexId, unit};

use crate::transport::{tangent_part, transport};

/// A direction is taken as it projects where that leaves at least this much of it: the sine of about 6° between normal and direction.
/// Below, what little is left is mostly the noise of the normals, and the field is completed from its surroundings.
pub const LEAST_PROJECTION: f64 = 0.1;

/// Sweeps of successive over-relaxation: at most this many, and about as many as the unknown region is vertices across.
const MOST_SWEEPS: usize = 120;

/// Over-relaxation: between 1 and 2; near the optimum for regions some tens of vertices across.
const RELAXATION: f64 = 1.7;

/// Vectors being found: what is wanted at each vertex, how much that is trusted, and the result so far.
pub(crate) struct Completion<'a> {
    topology: &'a Topology,
    normals: &'a [DVec3],
    /// Unit tangents along what is wanted.
    wanted: Vec<DVec3>,
    /// 1: the wanted vector as it is; 0: nothing is known. It changes without a jump, so that rounding makes no difference.
    trust: Vec<f64>,
    /// What decides where nothing else does, so weak that it shows nowhere else.
    tie_break: DVec3,
    vectors: Vec<DVec3>,
}

impl<'a> Completion<'a> {
    /// Wanted vectors are at most 1 long; `tie_break` is a unit vector across most of them.
    pub(crate) fn new(mesh: &'a Mesh, normals: &'a [DVec3], wanted: &[DVec3], tie_break: DVec3) -> Self {
        let count = wanted.len();
        let mut completion = Self {
            topology: mesh.topology(),
            normals,
            wanted: vec![DVec3::ZERO; count],
            trust: vec![0.0; count],
            tie_break,
            vectors: vec![DVec3::ZERO; count],
        };
        for (vertex, &wanted) in mesh.topology().vertices().zip(wanted) {
            completion.want(vertex.id(), wanted);
        }
        completion
    }

    /// Sets what is wanted at a vertex.
    fn want(&mut self, vertex: VertexId, wanted: DVec3) {
        let (k, normal) = (vertex.index(), self.normals[vertex.index()]);
        if normal == DVec3::ZERO || !self.topology.vertex(vertex).is_referenced() {
            return;
        }
        let tangent = tangent_part(wanted, normal);
        self.trust[k] = (2.0 * tangent.length() / LEAST_PROJECTION - 1.0).clamp(0.0, 1.0);
        if self.trust[k] > 0.0 {
            // Once more, as scaling up a short remainder scales up its rounding too.
            self.wanted[k] = unit(tangent_part(unit(tangent), normal));
            self.vectors[k] = self.wanted[k];
        }
    }

    /// The unit tangents: those wanted, and between them those of least difference between neighbours, transport between tangent planes taken
    /// out: the harmonic completion with a discrete connection (Knöppel et al. 2013, with equal weights). A piece of surface about which nothing is known at all follows an axis.
    pub(crate) fn finish(mut self, mesh: &Mesh) -> Vec<DVec3> {
        let reached = self.fill();
        if self.vertices_in_need().any(|vertex| !reached[vertex.index()]) {
            self.follow_axes(mesh, &reached);
            self.fill();
        }
        self.relax();
        for vertex in self.vertices_in_need().collect::<Vec<_>>() {
            let (k, normal) = (vertex.index(), self.normals[vertex.index()]);
            // At a singularity the harmonic vector vanishes, and what rounding left of it says nothing.
            let direction = if self.vectors[k].length() > 1e-12 { self.vectors[k] } else { any_tangent(normal) };
            self.vectors[k] = unit(tangent_part(unit(tangent_part(direction, normal)), normal));
        }
        self.vectors
    }

    fn vertices_in_need(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.topology
            .vertices()
            .filter(|v| self.trust[v.index()] < 1.0 && self.normals[v.index()] != DVec3::ZERO && v.is_referenced())
            .map(Vertex::id)
    }

    /// A first guess for what is unknown, ring by ring from what is known; which vertices were reached.
    fn fill(&mut self) -> Vec<bool> {
        let mut reached: Vec<bool> = self.trust.iter().map(|&trust| trust > 0.0).collect();
        // What is known starts the walk where it touches what is not: in order, whatever it was found from.
        let unknown = self.vertices_in_need().filter(|v| !reached[v.index()]);
        let touched = unknown.flat_map(|v| self.topology.vertex(v).neighbours()).filter(|v| reached[v.index()]);
        let mut rim: Vec<VertexId> = touched.map(Vertex::id).collect();
        rim.sort_unstable();
        rim.dedup();
        let mut queue = VecDeque::from(rim);
        while let Some(vertex) = queue.pop_front() {
            if self.trust[vertex.index()] == 0.0 {
                // Only what is filled already speaks; where it cancels nothing is made up.
                let filled = self.topology.vertex(vertex).neighbours().filter(|w| self.vectors[w.index()] != DVec3::ZERO).count();
                self.vectors[vertex.index()] = self.neighbour_sum(vertex).0 / filled.max(1) as f64;
            }
            for neighbour in self.topology.vertex(vertex).neighbours() {
                if !std::mem::replace(&mut reached[neighbour.index()], true) {
                    queue.push_back(neighbour.id());
                }
            }
        }
        reached
    }

    /// Sweeps to and fro over the vertices in need.
    fn relax(&mut self) {
        let order: Vec<VertexId> = self.vertices_in_need().collect();
        if order.is_empty() {
            return;
        }
        // Summed over the region it stays far from 1, and far above rounding.
        let tie_break = self.tie_break * (1e-3 / order.len() as f64);
        let sweeps = (2 * order.len().isqrt()).clamp(8, MOST_SWEEPS);
        for sweep in 0..sweeps {
            for place in 0..order.len() {
                let vertex = order[if sweep % 2 == 0 { place } else { order.len() - 1 - place }];
                let (sum, count) = self.neighbour_sum(vertex);
                let (k, trust) = (vertex.index(), self.trust[vertex.index()]);
                let completed = sum / f64::from(count.max(1)) + tangent_part(tie_break, self.normals[k]);
                let target = trust * self.wanted[k] + (1.0 - trust) * completed;
                let here = self.vectors[k];
                self.vectors[k] = here + RELAXATION * (target - here);
            }
        }
    }

    fn neighbour_sum(&self, vertex: VertexId) -> (DVec3, u32) {
        neighbour_sum(self.topology, self.normals, &self.vectors, vertex)
    }

    /// Has the vertices of each piece that nothing reached follow the coordinate axis of which most lies in the piece.
    fn follow_axes(&mut self, mesh: &Mesh, reached: &[bool]) {
        let pieces = mesh.components();
        let lost: Vec<(VertexId, usize)> = self
            .vertices_in_need()
            .filter(|v| !reached[v.index()])
            .filter_map(|v| mesh.vertex(v).faces().next().map(|face| (v, pieces.index_of(face.id()))))
            .collect();
        let mut across = vec![DVec3::ZERO; pieces.count()];
        for &(vertex, piece) in &lost {
            across[piece] += self.normals[vertex.index()] * self.normals[vertex.index()];
        }
        for (vertex, piece) in lost {
            let least = across[piece].min_element();
            // Up to rounding: equal axes are taken in order.
            let axis = DVec3::AXES.into_iter().find(|axis| axis.dot(across[piece]) <= least * (1.0 + 1e-9) + 1e-9);
            self.want(vertex, axis.unwrap_or(DVec3::X));
        }
    }
}

/// The unit tangent along the first coordinate axis that is far enough from the normal.
pub(crate) fn any_tangent(normal: DVec3) -> DVec3 {
    // One of three squares that add up to 1 is at most a third.
    let axis = DVec3::AXES.into_iter().find(|axis| axis.dot(normal).powi(2) < 0.4).unwrap_or(DVec3::X);
    unit(tangent_part(axis, normal))
}

/// The sum of a vertex's neighbours' vectors, brought to its tangent plane, and how many neighbours there are.
#[inline]
pub(crate) fn neighbour_sum(topology: &Topology, normals: &[DVec3], vectors: &[DVec3], vertex: VertexId) -> (DVec3, u32) {
    let here = normals[vertex.index()];
    topology
        .vertex(vertex)
        .neighbours()
        .fold((DVec3::ZERO, 0), |(sum, count), other| (sum + transport(vectors[other.index()], normals[other.index()], here), count + 1))
}

/// One round of smoothing: each vector joined by the mean of its neighbours', all at once, so that the order does not matter.
pub(crate) fn smooth_once(topology: &Topology, normals: &[DVec3], vectors: &[DVec3]) -> Vec<DVec3> {
    let smoothed = |vertex: VertexId| {
        let (here, normal) = (vectors[vertex.index()], normals[vertex.index()]);
        let (sum, count) = neighbour_sum(topology, normals, vectors, vertex);
        if count == 0 || here == DVec3::ZERO {
            return here;
        }
        let tangent = tangent_part(here + sum / f64::from(count), normal);
        if tangent.length() > 1e-6 { unit(tangent) } else { here }
    };
    topology.vertices().map(Vertex::id).map(smoothed).collect()
}
