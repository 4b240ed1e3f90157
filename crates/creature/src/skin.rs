//! A closed triangle mesh whose edges can be collapsed and flipped, and nothing of which ever becomes less than a closed surface.

use glam::DVec3;
use pelage_mesh::{Mesh, MeshError};

const NONE: u32 = u32::MAX;

/// Half-edges in flat arrays: those of face *f* are 3*f*, 3*f* + 1 and 3*f* + 2, as in `pelage-mesh`. A dead face's origins are `NONE`.
pub(crate) struct Skin {
    origins: Vec<u32>,
    twins: Vec<u32>,
    leaving: Vec<u32>,
    pub(crate) positions: Vec<DVec3>,
    /// Of the surface at each vertex, outwards.
    pub(crate) normals: Vec<DVec3>,
    faces: usize,
}

pub(crate) fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

pub(crate) fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

impl Skin {
    /// Of a closed mesh.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let topology = mesh.topology();
        Self {
            origins: topology.half_edges().map(|h| h.origin().id().0).collect(),
            twins: topology.half_edges().map(|h| h.twin().map_or(NONE, |twin| twin.id().0)).collect(),
            leaving: topology.vertices().map(|v| v.first_leaving().map_or(NONE, |h| h.id().0)).collect(),
            positions: mesh.positions().to_vec(),
            normals: mesh.vertex_normals(),
            faces: topology.face_count(),
        }
    }

    /// The mesh, without what is dead.
    pub(crate) fn to_mesh(&self) -> Result<Mesh, MeshError> {
        let mut names = vec![NONE; self.positions.len()];
        let mut positions = Vec::new();
        for (vertex, name) in names.iter_mut().enumerate().filter(|&(vertex, _)| self.leaving[vertex] != NONE) {
            *name = positions.len() as u32;
            positions.push(self.positions[vertex]);
        }
        let living = self.origins.chunks_exact(3).filter(|corners| corners[0] != NONE);
        let triangles: Vec<[u32; 3]> = living.map(|c| [c[0], c[1], c[2]].map(|v| names[v as usize])).collect();
        Mesh::from_triangles(positions, &triangles)
    }

    pub(crate) fn face_count(&self) -> usize {
        self.faces
    }

    pub(crate) fn half_edge_count(&self) -> u32 {
        self.origins.len() as u32
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.leaving.len()
    }

    pub(crate) fn is_alive(&self, half_edge: u32) -> bool {
        self.origins[half_edge as usize] != NONE
    }

    #[inline]
    pub(crate) fn origin(&self, half_edge: u32) -> u32 {
        self.origins[half_edge as usize]
    }

    #[inline]
    pub(crate) fn twin(&self, half_edge: u32) -> u32 {
        self.twins[half_edge as usize]
    }

    #[inline]
    pub(crate) fn tip(&self, half_edge: u32) -> u32 {
        self.origin(next(half_edge))
    }

    #[inline]
    pub(crate) fn at(&self, vertex: u32) -> DVec3 {
        self.positions[vertex as usize]
    }

    /// The half-edges that leave a vertex, anticlockwise; none of a dead one.
    pub(crate) fn ring(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.leaving[vertex as usize];
        std::iter::successors((first != NONE).then_some(first), move |&h| Some(self.twin(previous(h))).filter(|&h| h != first))
    }

    /// Where the corners of a half-edge's face are, and the normals there.
    pub(crate) fn facet(&self, half_edge: u32) -> Facet {
        let corners = self.corners(half_edge).map(|v| v as usize);
        Facet { corners: corners.map(|v| self.positions[v]), normals: corners.map(|v| self.normals[v]) }
    }

    /// Those of every face of a vertex.
    pub(crate) fn facets(&self, vertex: u32) -> impl Iterator<Item = Facet> + '_ {
        self.ring(vertex).map(|h| self.facet(h))
    }

    /// The corners of a half-edge's face, beginning where it starts.
    pub(crate) fn corners(&self, half_edge: u32) -> [u32; 3] {
        [half_edge, next(half_edge), previous(half_edge)].map(|h| self.origin(h))
    }

    /// Whether the edge can go and leave a closed surface of the same kind (Dey, Edelsbrunner, Guha and Nekhayev 1999, the link condition: the two
    /// vertices across it are the only neighbours that its ends share), with at least three faces at each vertex and at most eleven.
    pub(crate) fn can_collapse(&self, half_edge: u32) -> bool {
        let twin = self.twin(half_edge);
        let (u, v) = (self.origin(half_edge), self.origin(twin));
        let across = [self.origin(previous(half_edge)), self.origin(previous(twin))];
        let shared = self.ring(u).filter(|&h| self.ring(v).any(|other| self.tip(other) == self.tip(h))).count();
        let merged = self.valence(u) + self.valence(v) - 4;
        shared == 2 && (3..=11).contains(&merged) && across.iter().all(|&vertex| self.valence(vertex) > 3)
    }

    pub(crate) fn valence(&self, vertex: u32) -> usize {
        self.ring(vertex).count()
    }

    /// Takes out an edge that [`Skin::can_collapse`], with its two faces and the vertex where it starts; the other is moved to `to`.
    pub(crate) fn collapse(&mut self, half_edge: u32, to: DVec3, normal: DVec3) {
        let twin = self.twin(half_edge);
        let (u, v) = (self.origin(half_edge), self.origin(twin));
        let across = [self.origin(previous(half_edge)), self.origin(previous(twin))];
        let moved: Vec<u32> = self.ring(u).collect();
        for h in moved {
            self.origins[h as usize] = v;
        }
        // The two sides that stay of each face that goes are one edge now.
        let [far, back] = [next(half_edge), previous(half_edge)].map(|h| self.twin(h));
        let [near, ahead] = [next(twin), previous(twin)].map(|h| self.twin(h));
        self.join(far, back);
        self.join(near, ahead);
        self.leaving[across[0] as usize] = far;
        self.leaving[across[1] as usize] = near;
        self.leaving[v as usize] = back;
        self.leaving[u as usize] = NONE;
        for h in [half_edge, twin].into_iter().flat_map(|h| [h, next(h), previous(h)]) {
            self.origins[h as usize] = NONE;
        }
        self.positions[v as usize] = to;
        self.normals[v as usize] = normal;
        self.faces -= 2;
    }

    /// Whether the two faces of an edge can be cut along their other diagonal.
    pub(crate) fn can_flip(&self, half_edge: u32) -> bool {
        let twin = self.twin(half_edge);
        let [left, right] = [half_edge, twin].map(|h| self.origin(previous(h)));
        let joined = self.ring(left).any(|h| self.tip(h) == right);
        !joined && left != right && [half_edge, twin].iter().all(|&h| self.valence(self.origin(h)) > 3)
    }

    /// Cuts them so.
    pub(crate) fn flip(&mut self, half_edge: u32) {
        let (h, t) = (half_edge, self.twin(half_edge));
        let (hn, hp, tn, tp) = (next(h), previous(h), next(t), previous(t));
        let [a, b, c, d] = [h, t, hp, tp].map(|h| self.origin(h));
        let [bc, ca, ad, db] = [hn, hp, tn, tp].map(|h| self.twin(h));
        for (slot, origin) in [(h, c), (hn, d), (hp, b), (t, d), (tn, c), (tp, a)] {
            self.origins[slot as usize] = origin;
            self.leaving[origin as usize] = slot;
        }
        for (slot, outer) in [(hn, db), (hp, bc), (tn, ca), (tp, ad)] {
            self.join(slot, outer);
        }
        debug_assert!([a, b, c, d].iter().all(|&vertex| self.origin(self.leaving[vertex as usize]) == vertex));
    }

    fn join(&mut self, a: u32, b: u32) {
        self.twins[a as usize] = b;
        self.twins[b as usize] = a;
    }
}

/// A triangle and the normals of the surface at its corners.
#[derive(Clone, Copy)]
pub(crate) struct Facet {
    pub(crate) corners: [DVec3; 3],
    pub(crate) normals: [DVec3; 3],
}

impl Facet {
    /// Twice the area, along the normal.
    pub(crate) fn area_vector(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// How near it is to equilateral: 4 √3 times its area over the sum of its squared sides, 0 to 1.
    pub(crate) fn quality(&self) -> f64 {
        let [a, b, c] = self.corners;
        let sides = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
        if sides > 0.0 { 2.0 * 3.0_f64.sqrt() * self.area_vector().length() / sides } else { 0.0 }
    }

    /// How far it faces where the surface does: the cosine between its normal and the mean of those at its corners.
    pub(crate) fn agreement(&self) -> f64 {
        let mean: DVec3 = self.normals.iter().sum();
        self.area_vector().normalize_or_zero().dot(mean.normalize_or_zero())
    }
}

/// The worst of some facets: what a step of ours must not make worse, but where it is good all the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Worst {
    quality: f64,
    agreement: f64,
}

impl Worst {
    /// A quality that is good: a least angle of about 25°.
    const GOOD_QUALITY: f64 = 0.6;
    /// An agreement that is good: 66° at most.
    const GOOD_AGREEMENT: f64 = 0.4;

    pub(crate) fn of(facets: impl Iterator<Item = Facet>) -> Self {
        let perfect = Self { quality: 1.0, agreement: 1.0 };
        facets.fold(perfect, |worst, facet| Self {
            quality: worst.quality.min(facet.quality()),
            agreement: worst.agreement.min(facet.agreement()),
        })
    }

    /// Whether facets whose worst this is may take the place of others.
    pub(crate) fn may_replace(self, before: Self) -> bool {
        self.quality >= before.quality.min(Self::GOOD_QUALITY) && self.agreement >= before.agreement.min(Self::GOOD_AGREEMENT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage_mesh::Summary;

    fn ball() -> Skin {
        Skin::new(&pelage_mesh::sphere(1.0, 4).unwrap())
    }

    #[test]
    fn collapses_and_flips_keep_a_closed_surface_of_its_genus() {
        let mut torus = Skin::new(&pelage_mesh::torus(1.0, 0.4, 14, 9).unwrap());
        for step in 0.. {
            let begin = step * 37 % torus.half_edge_count();
            let places = (0..torus.half_edge_count()).map(|k| (begin + k) % torus.half_edge_count());
            let living: Vec<u32> = places.filter(|&h| torus.is_alive(h)).collect();
            if let Some(&flippable) = living.iter().find(|&&h| torus.can_flip(h)) {
                torus.flip(flippable);
            }
            let Some(&edge) = living.iter().find(|&&h| torus.can_collapse(h)) else { break };
            let middle = torus.at(torus.origin(edge)).midpoint(torus.at(torus.tip(edge)));
            torus.collapse(edge, middle, DVec3::Y);
            let summary = Summary::of(&torus.to_mesh().unwrap());
            assert_eq!((summary.faces, summary.genus, summary.components), (torus.face_count(), 1, 1));
            assert!(summary.is_closed());
        }
        assert!(torus.face_count() < 40, "{}", torus.face_count());
    }

    #[test]
    fn flipping_back_and_forth_leaves_all_as_it_was() {
        let mut skin = ball();
        let before: Vec<[u32; 3]> = skin.to_mesh().unwrap().topology().triangles().collect();
        let edge = (0..skin.half_edge_count()).find(|&h| skin.can_flip(h)).unwrap();
        for _ in 0..4 {
            skin.flip(edge);
        }
        assert_eq!(skin.to_mesh().unwrap().topology().triangles().collect::<Vec<_>>().len(), before.len());
        let sorted = |mut triangles: Vec<[u32; 3]>| {
            triangles.iter_mut().for_each(|t| {
                let least = (0..3).min_by_key(|&k| t[k]).unwrap();
                t.rotate_left(least);
            });
            triangles.sort_unstable();
            triangles
        };
        let after = skin.to_mesh().unwrap().topology().triangles().collect();
        assert_eq!(sorted(after), sorted(before));
    }

    #[test]
    fn quality_is_one_for_equal_sides_and_falls_to_nothing() {
        let facet = |h: f64| Facet { corners: [DVec3::ZERO, DVec3::X, DVec3::new(0.5, h, 0.0)], normals: [DVec3::Z; 3] };
        let high = |h: f64| facet(h).quality();
        assert!((high(0.75_f64.sqrt()) - 1.0).abs() < 1e-12);
        assert!(high(1e-3) < 0.01 && high(0.0) == 0.0);
    }
}
