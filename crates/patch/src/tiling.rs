//! The finished tiling, in flat arrays.

use std::ops::Range;

use glam::DVec2;
use pelage_mesh::{FaceId, Mesh, Vertex, VertexId};

use crate::PatchError;
use crate::growth::Draft;

/// One patch: a run of the tiling's faces and a run of its vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    first_face: u32,
    face_count: u32,
    first_vertex: u32,
    vertex_count: u32,
}

impl Patch {
    /// Its faces, as places in [`PatchTiling::faces`] and [`PatchTiling::surface_faces`]. The first is the one it grew from.
    pub fn faces(&self) -> Range<usize> {
        self.first_face as usize..(self.first_face + self.face_count) as usize
    }

    /// Its vertices, as places in [`PatchTiling::vertices`] and [`PatchTiling::coordinates`].
    pub fn vertices(&self) -> Range<usize> {
        self.first_vertex as usize..(self.first_vertex + self.vertex_count) as usize
    }
}

/// A surface cut into patches, each laid out in the plane of a hair tile that repeats.
///
/// A surface vertex has one *patch vertex* in every patch that touches it. Coordinates (s, t) are in tiles: the tile repeats every 1.
/// Hair lies along +t, and a face that winds anticlockwise seen from outside does so in the (s, t) plane unless it is flipped.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchTiling {
    patches: Vec<Patch>,
    patch_of_face: Vec<u32>,
    vertices: Vec<VertexId>,
    coordinates: Vec<DVec2>,
    faces: Vec<[u32; 3]>,
    surface_faces: Vec<FaceId>,
    let_off: Vec<FaceId>,
    tile_side: f64,
}

impl PatchTiling {
    pub(crate) fn from_drafts(mesh: &Mesh, tile_side: f64, drafts: Vec<Draft>, let_off: Vec<FaceId>) -> Self {
        let mut slots = vec![0; mesh.topology().vertex_count()];
        let mut tiling = Self { let_off, ..Self::empty(mesh, tile_side) };
        for draft in drafts {
            tiling.push(mesh, &draft.faces, &draft.vertices, draft.places, &mut slots);
        }
        tiling
    }

    /// A tiling from elsewhere, such as a model's own texture charts: the patch of each face, numbered without gaps, and where each patch
    /// puts each of its vertices, in tiles. `place` is asked once for each vertex of each patch.
    ///
    /// Nothing is promised of it but that every face lies in one patch; [`PatchTiling::quality`] says what it is worth.
    ///
    /// # Errors
    /// Where there is not one patch number for each face, a number is skipped, `tile_side` is out of range, or a place is not finite.
    pub fn from_places(
        mesh: &Mesh,
        tile_side: f64,
        patch_of_face: &[u32],
        mut place: impl FnMut(u32, VertexId) -> DVec2,
    ) -> Result<Self, PatchError> {
        if !(tile_side.is_finite() && tile_side > 0.0) {
            return Err(PatchError::Setting { name: "tile_side", value: tile_side, wanted: "finite and above 0" });
        }
        let faces_of_patches = group_faces(mesh.topology().face_count(), patch_of_face)?;
        let mut slots = vec![0; mesh.topology().vertex_count()];
        let mut seen = vec![u32::MAX; mesh.topology().vertex_count()];
        let mut tiling = Self::empty(mesh, tile_side);
        for (patch, faces) in faces_of_patches.iter().enumerate() {
            let patch = patch as u32;
            let mut vertices = Vec::new();
            for vertex in faces.iter().flat_map(|&f| mesh.face(f).vertices()).map(Vertex::id) {
                if std::mem::replace(&mut seen[vertex.index()], patch) != patch {
                    vertices.push(vertex);
                }
            }
            let places: Vec<DVec2> = vertices.iter().map(|&v| place(patch, v)).collect();
            if let Some(k) = places.iter().position(|p| !p.is_finite()) {
                return Err(PatchError::NoPlace { patch, vertex: vertices[k].0, place: places[k] });
            }
            tiling.push(mesh, faces, &vertices, places, &mut slots);
        }
        Ok(tiling)
    }

    fn empty(mesh: &Mesh, tile_side: f64) -> Self {
        let faces = mesh.topology().face_count();
        Self {
            patches: Vec::new(),
            patch_of_face: vec![0; faces],
            vertices: Vec::new(),
            coordinates: Vec::new(),
            faces: Vec::with_capacity(faces),
            surface_faces: Vec::with_capacity(faces),
            let_off: Vec::new(),
            tile_side,
        }
    }

    /// `slots` is room for one number a surface vertex.
    fn push(&mut self, mesh: &Mesh, faces: &[FaceId], vertices: &[VertexId], places: Vec<DVec2>, slots: &mut [u32]) {
        let (first_face, first_vertex) = (self.faces.len() as u32, self.vertices.len() as u32);
        for (k, vertex) in vertices.iter().enumerate() {
            slots[vertex.index()] = first_vertex + k as u32;
        }
        for &face in faces {
            self.patch_of_face[face.index()] = self.patches.len() as u32;
            self.faces.push(mesh.face(face).vertices().map(|v| slots[v.index()]));
        }
        self.surface_faces.extend_from_slice(faces);
        self.vertices.extend_from_slice(vertices);
        self.coordinates.extend(places);
        self.patches.push(Patch { first_face, face_count: faces.len() as u32, first_vertex, vertex_count: vertices.len() as u32 });
    }

    /// The patches.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// The patch of each surface face, as a place in [`PatchTiling::patches`].
    pub fn patch_of_face(&self) -> &[u32] {
        &self.patch_of_face
    }

    /// The surface vertex under each patch vertex; those of a patch are contiguous.
    pub fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    /// Where each patch vertex lies, (s, t), in tiles: 1 is one repeat.
    pub fn coordinates(&self) -> &[DVec2] {
        &self.coordinates
    }

    /// The corners of each face as patch vertices, in winding order; the faces of a patch are contiguous.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The surface face of each of [`PatchTiling::faces`]. Corner *k* of the one is corner *k* of the other.
    pub fn surface_faces(&self) -> &[FaceId] {
        &self.surface_faces
    }

    /// Faces that were let off [`Settings::max_turning`](crate::Settings::max_turning), ascending: following the field they would have been patches of
    /// three faces or fewer and under a fifth of the splotch. They still keep the bound on stretch.
    pub fn let_off(&self) -> &[FaceId] {
        &self.let_off
    }

    /// The side of the tile on the surface, in model units.
    pub fn tile_side(&self) -> f64 {
        self.tile_side
    }

    /// How many bytes it holds, for a cache to count.
    pub fn byte_size(&self) -> usize {
        size_of_val(&*self.patches)
            + size_of_val(&*self.patch_of_face)
            + size_of_val(&*self.vertices)
            + size_of_val(&*self.coordinates)
            + size_of_val(&*self.faces)
            + size_of_val(&*self.surface_faces)
            + size_of_val(&*self.let_off)
    }
}

/// The faces of each patch, ascending.
fn group_faces(face_count: usize, patch_of_face: &[u32]) -> Result<Vec<Vec<FaceId>>, PatchError> {
    if patch_of_face.len() != face_count {
        return Err(PatchError::FaceCount { given: patch_of_face.len(), faces: face_count });
    }
    let last = patch_of_face.iter().copied().max().unwrap_or(0);
    // More patches than faces leave a gap among the first `face_count` numbers, so that a wild number asks for no memory.
    let mut groups = vec![Vec::new(); face_count.min(last as usize + 1)];
    for (face, &patch) in patch_of_face.iter().enumerate() {
        if let Some(group) = groups.get_mut(patch as usize) {
            group.push(FaceId::from_index(face));
        }
    }
    match groups.iter().position(Vec::is_empty) {
        Some(patch) => Err(PatchError::EmptyPatch { patch: patch as u32, last }),
        None => Ok(groups),
    }
}
