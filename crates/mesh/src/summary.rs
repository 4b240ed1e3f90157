//! A mesh in figures.

use crate::Mesh;

/// What a mesh amounts to: counts, kind of surface and size.
///
/// ```
/// let torus = pelage_mesh::torus(1.0, 0.25, 48, 16)?;
/// let summary = pelage_mesh::Summary::of(&torus);
/// assert_eq!((summary.genus, summary.euler_characteristic), (1, 0));
/// assert!(summary.is_closed() && summary.signed_volume > 0.0);
/// # Ok::<(), pelage_mesh::PrimitiveError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Vertices that a face uses.
    pub vertices: usize,
    /// Vertices that no face uses.
    pub unreferenced_vertices: usize,
    /// Edges, those of the boundary among them.
    pub edges: usize,
    /// Edges with a face on one side only.
    pub boundary_edges: usize,
    /// Triangles.
    pub faces: usize,
    /// Closed loops of boundary edges: holes, and the rim of an open piece.
    pub boundary_loops: usize,
    /// Connected pieces.
    pub components: usize,
    /// χ = V − E + F, of all pieces together.
    pub euler_characteristic: i64,
    /// Handles of all pieces together: 2C − 2g − B = χ with C pieces and B boundary loops.
    pub genus: usize,
    /// Surface area, in square model units.
    pub area: f64,
    /// Enclosed volume, in cubic model units: positive where a closed surface is wound outwards. Of no meaning with a boundary.
    pub signed_volume: f64,
    /// Diagonal of the bounding box of the referenced vertices, in model units.
    pub diameter: f64,
    /// Mean length of the edges, in model units.
    pub mean_edge_length: f64,
    /// Faces without area as far as `f64` can tell.
    pub faces_without_area: usize,
}

impl Summary {
    /// The figures of a mesh; linear time.
    pub fn of(mesh: &Mesh) -> Self {
        let topology = mesh.topology();
        let vertices = topology.referenced_vertex_count();
        Self {
            vertices,
            unreferenced_vertices: topology.vertex_count() - vertices,
            edges: topology.edge_count(),
            boundary_edges: topology.boundary_edge_count(),
            faces: topology.face_count(),
            boundary_loops: topology.boundary_loops().len(),
            components: topology.components().count(),
            euler_characteristic: topology.euler_characteristic(),
            genus: topology.genus(),
            area: mesh.area(),
            signed_volume: mesh.signed_volume(),
            diameter: mesh.diameter(),
            mean_edge_length: mesh.mean_edge_length(),
            faces_without_area: mesh.faces().filter(|face| face.normal() == glam::DVec3::ZERO).count(),
        }
    }

    /// Whether there is a surface and it has no boundary.
    pub fn is_closed(&self) -> bool {
        self.faces > 0 && self.boundary_edges == 0
    }
}
