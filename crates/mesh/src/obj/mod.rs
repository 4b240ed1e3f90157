//! Wavefront OBJ files.

mod error;
mod statements;

use std::path::Path;

use glam::{DVec2, DVec3};

use crate::{Mesh, MeshError, Topology, TopologyError};

pub use error::{ObjError, ObjFault};

use statements::{CountingReader, Statements};

/// Reads an OBJ file.
///
/// Vertex *k* of the mesh is the file's *k*th `v` (from 0), used or not. Objects and groups are joined: all share the one list of
/// vertices. Polygons are cut into fans, from their first corner. Texture coordinates are kept for each corner, and only if every corner
/// has them; faces on either side of a texture seam share their vertices all the same. Normals, materials, colours, lines and points are
/// passed over, no other file is opened.
///
/// # Errors
/// Where the file cannot be read or is no oriented manifold, with path and line.
///
/// ```
/// # fn main() -> Result<(), pelage_mesh::ObjError> {
/// # let path = std::env::temp_dir().join(format!("pelage-mesh-doc-{}.obj", std::process::id()));
/// # std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
/// let mesh = pelage_mesh::read_obj(&path)?;
/// assert_eq!(mesh.topology().face_count(), 1);
/// # std::fs::remove_file(&path).unwrap();
/// # Ok(())
/// # }
/// ```
pub fn read_obj(path: &Path) -> Result<Mesh, ObjError> {
    let bytes = std::fs::read(path).map_err(|error| ObjError::whole(ObjFault::Unreadable(error)).in_file(path))?;
    parse_obj(&bytes).map_err(|error| error.in_file(path))
}

/// Reads the content of an OBJ file; see [`read_obj`].
///
/// # Errors
/// Where it is no oriented manifold, with the line.
pub fn parse_obj(bytes: &[u8]) -> Result<Mesh, ObjError> {
    let statements = Statements::scan(bytes)?;
    if statements.faces() == 0 {
        return Err(ObjError::whole(ObjFault::NoFaces));
    }
    let parsed = parse_statements(&statements)?;
    let polygons = Polygons::after_the_first(&parsed, &statements)?;
    let triangles = polygons.triangles(&parsed.indices);
    let positions: Vec<DVec3> = parsed.positions.chunks_exact(3).map(DVec3::from_slice).collect();
    let locate = |error| locate(error, &statements, &polygons);
    let topology = Topology::from_triangles(positions.len(), &triangles).map_err(|error| locate(error.into()))?;
    let mesh = Mesh::new(topology.into(), positions).map_err(locate)?;
    if !statements.every_corner_has_coordinates() {
        return Ok(mesh);
    }
    let coordinates: Vec<DVec2> = parsed.texcoords.chunks_exact(2).map(DVec2::from_slice).collect();
    let corners = polygons.triangles(&parsed.texcoord_indices);
    let per_corner = corners.as_flattened().iter().filter_map(|&index| coordinates.get(index as usize).copied()).collect();
    mesh.with_texture_coordinates(per_corner).map_err(locate)
}

/// Lets `tobj` parse the numbers.
///
/// `tobj` numbers the vertices anew for each object, in the order in which faces use them, and drops the others. [`Statements`] hands it
/// one object only, in which a first polygon goes through all vertices in order: so numbered, they keep their places.
fn parse_statements(statements: &Statements<'_>) -> Result<tobj::Mesh, ObjError> {
    let mut reader = CountingReader::new(statements.text());
    let options = tobj::LoadOptions::default();
    let result = tobj::load_obj_buf(&mut reader, &options, |_| Ok(Default::default()));
    match result {
        Ok((models, _)) => models.into_iter().next().map(|model| model.mesh).ok_or_else(|| ObjError::whole(ObjFault::NoFaces)),
        Err(error) => Err(statements.fault(error, reader.line())),
    }
}

/// Where each polygon's corners start and end among all corners.
struct Polygons {
    ends: Vec<usize>,
}

impl Polygons {
    /// All but the first, which only numbers the vertices.
    fn after_the_first(parsed: &tobj::Mesh, statements: &Statements<'_>) -> Result<Self, ObjError> {
        let count = statements.faces() + 1;
        // `tobj` leaves the arities out where all are three.
        let arity = |polygon: usize| parsed.face_arities.get(polygon).map_or(3, |&arity| arity as usize);
        let mut end = 0;
        let mut ends = Vec::with_capacity(count);
        for polygon in 0..count {
            let corners = arity(polygon);
            if polygon > 0 && corners < 3 {
                return Err(ObjError::at(statements.face_line(polygon - 1), ObjFault::TooFewCorners { corners }));
            }
            end += corners;
            ends.push(end);
        }
        Ok(Self { ends })
    }

    /// The corners of the polygons in `indices`, as fans of triangles.
    fn triangles(&self, indices: &[u32]) -> Vec<[u32; 3]> {
        let fans = self.ends.windows(2).filter_map(|ends| indices.get(ends[0]..ends[1]));
        fans.flat_map(|polygon| (2..polygon.len()).map(|k| [polygon[0], polygon[k - 1], polygon[k]])).collect()
    }

    /// The polygon that a triangle is cut from.
    fn of_triangle(&self, triangle: u32) -> usize {
        let mut first = 0;
        self.ends
            .windows(2)
            .position(|ends| {
                first += (ends[1] - ends[0] - 2) as u64;
                first > u64::from(triangle)
            })
            .unwrap_or(0)
    }
}

/// Says of a fault of the mesh in which line it is.
fn locate(error: MeshError, statements: &Statements<'_>, polygons: &Polygons) -> ObjError {
    let line = |face| statements.face_line(polygons.of_triangle(face));
    match error {
        MeshError::Topology(TopologyError::DegenerateFace { face, vertex }) => {
            ObjError::at(line(face), ObjFault::RepeatedVertex { vertex: vertex + 1 })
        }
        MeshError::Topology(TopologyError::EdgeUsedTwice { first, second, from, to }) => {
            let fault = ObjFault::EdgeUsedTwice { other_line: line(first), from: from + 1, to: to + 1 };
            ObjError::at(line(second), fault)
        }
        MeshError::Topology(TopologyError::NotOrientable { first, second, from, to }) => {
            let fault = ObjFault::NotOrientable { other_line: line(first), from: from + 1, to: to + 1 };
            ObjError::at(line(second), fault)
        }
        MeshError::Topology(TopologyError::NonManifoldVertex { vertex }) => {
            ObjError::at(statements.vertex_line(vertex as usize), ObjFault::NonManifoldVertex { vertex: vertex + 1 })
        }
        MeshError::NotFinite { vertex, .. } => {
            ObjError::at(statements.vertex_line(vertex as usize), ObjFault::NotFinite { vertex: vertex + 1 })
        }
        MeshError::CoordinateNotFinite { face, .. } => ObjError::at(line(face), ObjFault::CoordinateNotFinite),
        other => ObjError::whole(ObjFault::Mesh(other)),
    }
}

#[cfg(test)]
mod tests;
