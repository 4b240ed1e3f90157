//! A set of faces that stays a topological disc as it grows.

use glam::DVec2;
use pelage_mesh::{FaceId, Topology, Vertex, VertexId};

/// How a face touches a disc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Contact {
    /// Along one side only, from corner `side` of the face to the next; the corner opposite is no vertex of the disc.
    Side {
        /// 0 to 2.
        side: usize,
    },
    /// Along two sides.
    Wedge,
    /// In a way that would leave no disc: not along a side, along a side and at the opposite corner, or all around.
    Barred,
}

/// A growing disc and the places of its vertices in the tile. The arrays over the whole mesh are kept from patch to patch and never
/// cleared: an entry counts only if it bears the current stamp.
///
/// Adding face *f* to a disc *D* leaves a disc exactly when *f* ∩ *D* is an arc of *f*'s outline. As every union of closed faces is taken
/// with its vertices, *D*'s outline is one simple loop, and only three arcs are possible. One side, if the opposite corner is not in *D*.
/// Two sides: they are the two sides of the loop at their common vertex, since the loop passes there once, so the fan at that vertex
/// closes and the third side takes their place. All three sides make a sphere, not a disc. No hole can ever be left to be filled.
pub(crate) struct Disc {
    stamp: u32,
    face_stamps: Vec<u32>,
    vertex_stamps: Vec<u32>,
    /// The number within the disc of each of its vertices.
    slots: Vec<u32>,
    /// In the order in which they came.
    pub(crate) faces: Vec<FaceId>,
    /// Corners of `faces`, as numbers within the disc.
    pub(crate) corners: Vec<[u32; 3]>,
    /// The surface vertex of each number.
    pub(crate) vertices: Vec<VertexId>,
    /// Where each vertex lies, in tiles from the seed's centre.
    pub(crate) places: Vec<DVec2>,
}

impl Disc {
    pub(crate) fn new(topology: &Topology) -> Self {
        Self {
            stamp: 0,
            face_stamps: vec![0; topology.face_count()],
            vertex_stamps: vec![0; topology.vertex_count()],
            slots: vec![0; topology.vertex_count()],
            faces: Vec::new(),
            corners: Vec::new(),
            vertices: Vec::new(),
            places: Vec::new(),
        }
    }

    /// Forgets every face.
    pub(crate) fn clear(&mut self) {
        if self.stamp == u32::MAX {
            self.face_stamps.fill(0);
            self.vertex_stamps.fill(0);
            self.stamp = 0;
        }
        self.stamp += 1;
        self.faces.clear();
        self.corners.clear();
        self.vertices.clear();
        self.places.clear();
    }

    pub(crate) fn contains(&self, face: FaceId) -> bool {
        self.face_stamps[face.index()] == self.stamp
    }

    fn slot(&self, vertex: VertexId) -> Option<u32> {
        (self.vertex_stamps[vertex.index()] == self.stamp).then(|| self.slots[vertex.index()])
    }

    /// Where a vertex lies, if it is one of the disc's.
    pub(crate) fn place(&self, vertex: VertexId) -> Option<DVec2> {
        self.slot(vertex).map(|slot| self.places[slot as usize])
    }

    /// Where the corners of one of the disc's faces lie.
    pub(crate) fn face_places(&self, index: usize) -> [DVec2; 3] {
        self.corners[index].map(|slot| self.places[slot as usize])
    }

    /// How a face touches the disc.
    pub(crate) fn contact(&self, topology: &Topology, face: FaceId) -> Contact {
        let shared = topology.face(face).across().map(|n| n.is_some_and(|n| self.contains(n.id())));
        match shared {
            [true, true, false] | [true, false, true] | [false, true, true] => Contact::Wedge,
            [false, false, false] | [true, true, true] => Contact::Barred,
            _ => {
                let side = shared.iter().position(|&s| s).unwrap_or(0);
                let opposite = topology.face(face).vertices()[(side + 2) % 3].id();
                if self.slot(opposite).is_none() { Contact::Side { side } } else { Contact::Barred }
            }
        }
    }

    /// Adds a face; its corners that are not yet in the disc are placed where `places` says.
    pub(crate) fn push(&mut self, topology: &Topology, face: FaceId, places: [DVec2; 3]) {
        self.face_stamps[face.index()] = self.stamp;
        self.faces.push(face);
        let vertices = topology.face(face).vertices().map(Vertex::id);
        let corners = [0, 1, 2].map(|k| self.slot_or_new(vertices[k], places[k]));
        self.corners.push(corners);
    }

    fn slot_or_new(&mut self, vertex: VertexId, place: DVec2) -> u32 {
        if let Some(slot) = self.slot(vertex) {
            return slot;
        }
        let slot = self.vertices.len() as u32;
        self.vertex_stamps[vertex.index()] = self.stamp;
        self.slots[vertex.index()] = slot;
        self.vertices.push(vertex);
        self.places.push(place);
        slot
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOWHERE: [DVec2; 3] = [DVec2::ZERO; 3];

    fn faces(triangles: &[[u32; 3]]) -> Topology {
        let vertices = triangles.iter().flatten().max().map_or(0, |&most| most as usize + 1);
        Topology::from_triangles(vertices, triangles).unwrap()
    }

    /// Three faces of a tetrahedron are a disc; the fourth would close it.
    #[test]
    fn the_last_face_of_a_sphere_is_barred() {
        let tetrahedron = faces(&[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);
        let mut disc = Disc::new(&tetrahedron);
        disc.clear();
        disc.push(&tetrahedron, FaceId(0), NOWHERE);
        assert_eq!(disc.contact(&tetrahedron, FaceId(1)), Contact::Side { side: 2 });
        disc.push(&tetrahedron, FaceId(1), NOWHERE);
        assert_eq!(disc.contact(&tetrahedron, FaceId(2)), Contact::Wedge);
        disc.push(&tetrahedron, FaceId(2), NOWHERE);
        assert_eq!(disc.contact(&tetrahedron, FaceId(3)), Contact::Barred);
    }

    /// A ring of six faces: the last two touch both ends of what is there.
    #[test]
    fn a_ring_does_not_close() {
        let ring = faces(&[[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4], [2, 0, 5], [0, 3, 5]]);
        let mut disc = Disc::new(&ring);
        disc.clear();
        for face in 0..4 {
            assert!(face == 0 || disc.contact(&ring, FaceId(face)) != Contact::Barred);
            disc.push(&ring, FaceId(face), NOWHERE);
        }
        assert_eq!(disc.contact(&ring, FaceId(4)), Contact::Barred, "along 2–5, with 0 at the far end");
        assert_eq!(disc.contact(&ring, FaceId(5)), Contact::Barred, "along 0–3, with 5 at the far end");
        disc.clear();
        assert!(disc.faces.is_empty() && !disc.contains(FaceId(0)), "a cleared disc holds nothing");
    }
}
