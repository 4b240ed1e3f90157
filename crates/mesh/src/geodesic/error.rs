//! What keeps distances from being measured.

use glam::DVec3;

use super::Source;
use crate::Mesh;

/// Why there are no distances.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GeodesicError {
    /// A source names a vertex that does not exist.
    #[error("source {source_index} is vertex {vertex}, but there are {vertices}; name one of them")]
    NoSuchVertex {
        /// Which source.
        source_index: usize,
        /// The vertex it names.
        vertex: u32,
        /// How many there are.
        vertices: usize,
    },
    /// A source names a face that does not exist.
    #[error("source {source_index} is on face {face}, but there are {faces}; name one of them")]
    NoSuchFace {
        /// Which source.
        source_index: usize,
        /// The face it names.
        face: u32,
        /// How many there are.
        faces: usize,
    },
    /// The coordinates of a source are not those of a point on its face.
    #[error("source {source_index} has barycentric coordinates {barycentrics}; give three that are not negative and add up to 1")]
    NotOnFace {
        /// Which source.
        source_index: usize,
        /// Its coordinates.
        barycentrics: DVec3,
    },
    /// How far to go is negative or NaN.
    #[error("the reach is {reach}; give a distance from 0 to infinity")]
    Reach {
        /// The reach.
        reach: f64,
    },
}

/// Barycentric coordinates add up to 1 within this.
const SUM_TOLERANCE: f64 = 1e-6;

pub(super) fn check(mesh: &Mesh, sources: &[Source], reach: f64) -> Result<(), GeodesicError> {
    if reach.is_nan() || reach < 0.0 {
        return Err(GeodesicError::Reach { reach });
    }
    let (vertices, faces) = (mesh.positions().len(), mesh.topology().face_count());
    for (source_index, source) in sources.iter().enumerate() {
        match source {
            Source::Vertex(vertex) if vertex.index() >= vertices => {
                return Err(GeodesicError::NoSuchVertex { source_index, vertex: vertex.0, vertices });
            }
            Source::Point(point) if point.face.index() >= faces => {
                return Err(GeodesicError::NoSuchFace { source_index, face: point.face.0, faces });
            }
            Source::Point(point) => {
                let b = point.barycentrics;
                let sum_is_one = (b.element_sum() - 1.0).abs() <= SUM_TOLERANCE;
                if !sum_is_one || b.min_element() < -SUM_TOLERANCE {
                    return Err(GeodesicError::NotOnFace { source_index, barycentrics: b });
                }
            }
            Source::Vertex(_) => {}
        }
    }
    Ok(())
}
