//! Two meshes as one.

use glam::Vec4;

use crate::{Mesh, MeshError};

/// Why two meshes cannot be one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum JoinError {
    /// Together they have more vertices or faces than there are handles for.
    #[error("together they are too large: {0}")]
    Mesh(#[from] MeshError),
}

/// Puts a mesh beside another: first all that the first has, then all that the second has, each in its order. Nothing is welded, so that what touched is
/// still two pieces.
///
/// Texture coordinates are kept if both have them. Where one has colours and the other has none, the other's are white and opaque.
///
/// # Errors
/// Where together they have more vertices or faces than there are handles for.
///
/// ```
/// use pelage_mesh::{join, plane, sphere};
///
/// let both = join(&sphere(1.0, 2)?, &plane(4.0, 4.0, 1, 1)?)?;
/// assert_eq!((both.topology().face_count(), both.components().iter().count()), (82, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn join(first: &Mesh, second: &Mesh) -> Result<Mesh, JoinError> {
    let offset = first.positions().len() as u32;
    let moved = second.topology().triangles().map(|corners| corners.map(|vertex| vertex.saturating_add(offset)));
    let triangles: Vec<[u32; 3]> = first.topology().triangles().chain(moved).collect();
    let mut joined = Mesh::from_triangles([first.positions(), second.positions()].concat(), &triangles)?;
    if let (Some(one), Some(other)) = (first.texture_coordinates(), second.texture_coordinates()) {
        joined = joined.with_texture_coordinates([one, other].concat())?;
    }
    if first.colours().is_some() || second.colours().is_some() {
        joined = joined.with_colours([first, second].into_iter().flat_map(colours).collect())?;
    }
    Ok(joined)
}

fn colours(mesh: &Mesh) -> Vec<Vec4> {
    mesh.colours().map_or_else(|| vec![Vec4::ONE; mesh.positions().len()], <[Vec4]>::to_vec)
}
