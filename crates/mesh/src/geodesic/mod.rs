//! Distance along the surface: fast, and exact.

mod error;
mod exact;
mod front;
mod layout;
mod queue;
mod window;

pub use error::GeodesicError;

use crate::{Mesh, SurfacePoint, VertexId};
use layout::Layout;

/// Where distance is measured from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A vertex.
    Vertex(VertexId),
    /// A point on a face.
    Point(SurfacePoint),
}

impl From<VertexId> for Source {
    fn from(vertex: VertexId) -> Self {
        Self::Vertex(vertex)
    }
}

impl From<SurfacePoint> for Source {
    fn from(point: SurfacePoint) -> Self {
        Self::Point(point)
    }
}

/// Measures distances along the surface of one mesh, from as many sources as wanted and as often as wanted.
///
/// [`Geodesics::distances`] is a front that passes over each vertex about once, for brushes and fields; [`Geodesics::exact_distances`] is the exact answer,
/// some fifty to a hundred and fifty times slower, to judge the first by. Both measure to the nearest of the sources, at the vertices, and touch only what they reach.
///
/// ```
/// use pelage_mesh::{Geodesics, VertexId, plane};
///
/// let sheet = plane(4.0, 3.0, 40, 30)?;
/// let mut geodesics = Geodesics::on(&sheet);
/// let corner = VertexId(0);
/// let all = geodesics.distances(&[corner.into()], f64::INFINITY)?.to_vec(sheet.positions().len());
/// assert!(all.iter().zip(sheet.positions()).all(|(d, p)| (d - p.distance(sheet.positions()[0])).abs() < 1e-9));
/// let near = geodesics.distances(&[corner.into()], 0.25)?;
/// assert!(near.nearest_first().len() < 10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Geodesics<'a> {
    layout: Layout<'a>,
    /// In units of the layout; infinite but while a call measures.
    distances: Vec<f64>,
}

/// Distances at the vertices that were reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Distances {
    nearest_first: Vec<(VertexId, f64)>,
}

impl Distances {
    /// The vertices reached, in order of their distance (and of their number where that is equal), in model units.
    pub fn nearest_first(&self) -> &[(VertexId, f64)] {
        &self.nearest_first
    }

    /// A distance for each vertex; infinite where it was not reached: out of reach, in another piece, or without a face.
    pub fn to_vec(&self, vertex_count: usize) -> Vec<f64> {
        let mut all = vec![f64::INFINITY; vertex_count];
        for &(vertex, distance) in &self.nearest_first {
            if let Some(slot) = all.get_mut(vertex.index()) {
                *slot = distance;
            }
        }
        all
    }
}

impl<'a> Geodesics<'a> {
    /// Lays every face out flat; linear time, 72 bytes a face and 8 a vertex.
    pub fn on(mesh: &'a Mesh) -> Self {
        Self { layout: Layout::new(mesh), distances: vec![f64::INFINITY; mesh.positions().len()] }
    }

    /// The distance to the nearest source, up to `reach` model units (infinity for all).
    ///
    /// A front of vertices, nearest first, as in fast marching (Kimmel and Sethian 1998); a vertex is reached through the edge opposite as if the
    /// surface were unfolded around a source that lies where the distances of the edge's two ends say (Novotni and Klein 2002), so that flat regions are measured exactly.
    /// A vertex is settled anew where it is reached by a shorter way later, as behind obtuse corners. O(n log n) in the *n* vertices reached; the book's page says how far it is from exact.
    ///
    /// # Errors
    /// Where a source is not on the mesh, or `reach` is negative or no number.
    pub fn distances(&mut self, sources: &[Source], reach: f64) -> Result<Distances, GeodesicError> {
        self.measure(sources, reach, front::march)
    }

    /// The exact distance to the nearest source along the polyhedron, up to `reach` model units (infinity for all).
    ///
    /// Windows on edges through which a source, or a vertex that shortest paths bend around, is seen straight (Mitchell, Mount and Papadimitriou 1987), the
    /// nearest first, with one split at each corner (Chen and Han 1990) and those left out that cannot be shortest (Xin and Wang 2009). O(n² log n) at worst;
    /// 3 to 40 µs a vertex on models of some thousand vertices.
    ///
    /// # Errors
    /// Where a source is not on the mesh, or `reach` is negative or no number.
    pub fn exact_distances(&mut self, sources: &[Source], reach: f64) -> Result<Distances, GeodesicError> {
        self.measure(sources, reach, exact::propagate)
    }

    fn measure(
        &mut self,
        sources: &[Source],
        reach: f64,
        method: impl FnOnce(&Layout<'_>, &[Source], f64, &mut [f64]) -> Vec<VertexId>,
    ) -> Result<Distances, GeodesicError> {
        error::check(self.layout.mesh, sources, reach)?;
        let unit = self.layout.unit;
        // A little further, so that rounding cuts off nothing that is just within reach in model units.
        let touched = method(&self.layout, sources, reach / unit * (1.0 + 1e-12), &mut self.distances);
        let mut nearest_first: Vec<(VertexId, f64)> = Vec::with_capacity(touched.len());
        for vertex in touched {
            let distance = std::mem::replace(&mut self.distances[vertex.index()], f64::INFINITY) * unit;
            if distance <= reach && distance < f64::INFINITY {
                nearest_first.push((vertex, distance));
            }
        }
        nearest_first.sort_unstable_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        Ok(Distances { nearest_first })
    }
}
