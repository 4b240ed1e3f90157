//! Polygons as a file or a modeller gives them.

use glam::{DVec2, DVec3, Vec4};

use super::RepairError;

/// Polygons with nothing promised about how they hang together: what [`repair`](crate::repair) makes a [`Mesh`](crate::Mesh) of.
///
/// Polygon *k* has the corners from the end of polygon *k* − 1 up to `ends[k]`, anticlockwise seen from outside as far as anybody knows.
///
/// ```
/// use glam::DVec3;
/// use pelage_mesh::Soup;
///
/// let positions = vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
/// let square = Soup { positions: positions.clone(), corners: vec![0, 1, 2, 3], ends: vec![4], ..Soup::default() };
/// let same = Soup::from_polygons(positions, [[0, 1, 2, 3]]);
/// assert_eq!(square, same);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Soup {
    /// Where the vertices are, in model units.
    pub positions: Vec<DVec3>,
    /// A colour for each of `positions`, in linear light with alpha; empty if there are none.
    pub colours: Vec<Vec4>,
    /// Texture coordinates, in any order, u to the right and v up; empty if there are none.
    pub texture_coordinates: Vec<DVec2>,
    /// The vertex of each corner, polygon after polygon.
    pub corners: Vec<u32>,
    /// Which of the texture coordinates each corner has; as many as `corners`, or none.
    pub corner_coordinates: Vec<u32>,
    /// Where each polygon ends among the corners.
    pub ends: Vec<u32>,
}

impl Soup {
    /// Polygons without texture coordinates.
    pub fn from_polygons<P: AsRef<[u32]>>(positions: Vec<DVec3>, polygons: impl IntoIterator<Item = P>) -> Self {
        let mut soup = Self { positions, ..Self::default() };
        for polygon in polygons {
            soup.corners.extend_from_slice(polygon.as_ref());
            soup.ends.push(soup.corners.len() as u32);
        }
        soup
    }

    /// Where each polygon's corners are among all; the arrays must have passed `check`.
    pub(super) fn ranges(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let starts = std::iter::once(0).chain(self.ends.iter().map(|&end| end as usize));
        starts.zip(&self.ends).map(|(start, &end)| start..end as usize)
    }

    /// Says what is wrong with the arrays.
    pub(super) fn check(&self) -> Result<(), RepairError> {
        if self.ends.is_empty() {
            return Err(RepairError::NoFaces);
        }
        let (corners, coordinates) = (self.corners.len(), self.corner_coordinates.len());
        let end = self.ends.last().map_or(0, |&end| end as usize);
        if !self.ends.is_sorted() || end != corners || (coordinates != 0 && coordinates != corners) {
            return Err(RepairError::Arrays { corners, coordinates, end });
        }
        if let Some(vertex) = self.positions.iter().position(|p| !p.is_finite()) {
            return Err(RepairError::NotFinite { vertex: vertex as u32 });
        }
        let count = self.positions.len();
        if !self.colours.is_empty() && self.colours.len() != count {
            return Err(RepairError::ColourCount { colours: self.colours.len(), vertices: count });
        }
        if let Some(vertex) = self.colours.iter().position(|colour| !colour.is_finite()) {
            return Err(RepairError::ColourNotFinite { vertex: vertex as u32 });
        }
        if let Some(corner) = self.corners.iter().position(|&vertex| vertex as usize >= count) {
            return Err(RepairError::VertexOutOfRange { polygon: self.polygon_of(corner), vertex: self.corners[corner], count });
        }
        self.check_coordinates()
    }

    fn check_coordinates(&self) -> Result<(), RepairError> {
        for (corner, &index) in self.corner_coordinates.iter().enumerate() {
            match self.texture_coordinates.get(index as usize) {
                Some(coordinates) if coordinates.is_finite() => {}
                Some(_) => return Err(RepairError::CoordinateNotFinite { polygon: self.polygon_of(corner) }),
                None => {
                    let count = self.texture_coordinates.len();
                    return Err(RepairError::CoordinateOutOfRange { polygon: self.polygon_of(corner), index, count });
                }
            }
        }
        Ok(())
    }

    fn polygon_of(&self, corner: usize) -> usize {
        self.ends.partition_point(|&end| end as usize <= corner)
    }
}
