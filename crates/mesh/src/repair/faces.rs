//! Triangles on their way to a surface, with what belongs to each.

/// Triangles, and what stays with each through all repairs.
#[derive(Debug, Default)]
pub(super) struct Faces {
    /// The vertices at the corners.
    pub(super) corners: Vec<[u32; 3]>,
    /// Which texture coordinates the corners have; one for each face, or empty.
    pub(super) coordinates: Vec<[u32; 3]>,
    /// The polygon each is cut from.
    pub(super) polygons: Vec<u32>,
}

impl Faces {
    pub(super) fn len(&self) -> usize {
        self.corners.len()
    }

    /// Keeps the faces of which `keep` says so; says how many went.
    pub(super) fn retain(&mut self, mut keep: impl FnMut(usize) -> bool) -> usize {
        let mut kept = 0;
        for face in 0..self.len() {
            if !keep(face) {
                continue;
            }
            self.corners[kept] = self.corners[face];
            self.polygons[kept] = self.polygons[face];
            if !self.coordinates.is_empty() {
                self.coordinates[kept] = self.coordinates[face];
            }
            kept += 1;
        }
        let gone = self.len() - kept;
        self.corners.truncate(kept);
        self.polygons.truncate(kept);
        self.coordinates.truncate(kept);
        gone
    }

    /// Winds a face the other way; its first corner stays the first.
    pub(super) fn turn(&mut self, face: usize) {
        self.corners[face].swap(1, 2);
        if let Some(coordinates) = self.coordinates.get_mut(face) {
            coordinates.swap(1, 2);
        }
    }
}
