//! Wavefront OBJ files.
//!
//! What `tobj` gets wrong is dealt with before and after it: before, [`lines`] and [`statements`] go through the text, check it, and hand `tobj` the numbers
//! only; after, the polygons are [repaired](crate::repair).

mod error;
mod lines;
mod note;
mod reader;
mod statements;

use std::path::Path;

use glam::{DVec2, DVec3, Vec4};

use crate::{FaceId, Mesh, RepairError, RepairReport, RepairSettings, Soup, repair, srgb_to_linear};

pub use error::{ObjError, ObjFault};
pub use note::Note;

use reader::CountingReader;
use statements::Statements;

/// A mesh read from a file, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The surface.
    pub mesh: Mesh,
    /// What was mended.
    pub repairs: RepairReport,
    /// What was left out.
    pub notes: Vec<Note>,
    /// The line of the file that each face comes from, from 1.
    pub face_lines: Vec<u32>,
}

impl Import {
    /// The line of the file that a face comes from, from 1.
    pub fn face_line(&self, face: FaceId) -> usize {
        self.face_lines[face.index()] as usize
    }
}

/// Reads an OBJ file and [repairs](crate::repair) what it finds.
///
/// Objects and groups are joined: all share the one list of vertices. Texture coordinates are kept for each corner, and only if every corner has them;
/// faces on either side of a texture seam share their vertices all the same. So are colours of vertices, three numbers after their place, which are
/// taken for sRGB as most programs write them. Normals, materials, lines, points and free-form geometry are passed over, and no other file is opened, whatever it names.
///
/// # Errors
/// Where the file cannot be read, says something that is no OBJ, or has no surface; with path and line.
///
/// ```
/// # fn main() -> Result<(), pelage_mesh::ObjError> {
/// # let path = std::env::temp_dir().join(format!("pelage-mesh-doc-{}.obj", std::process::id()));
/// # std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
/// let import = pelage_mesh::read_obj(&path)?;
/// assert_eq!(import.mesh.topology().face_count(), 1);
/// assert!(import.repairs.is_none());
/// # std::fs::remove_file(&path).unwrap();
/// # Ok(())
/// # }
/// ```
pub fn read_obj(path: &Path) -> Result<Import, ObjError> {
    let bytes = std::fs::read(path).map_err(|error| ObjError::whole(ObjFault::Unreadable(error)).in_file(path))?;
    parse_obj(&bytes).map_err(|error| error.in_file(path))
}

/// Reads the content of an OBJ file; see [`read_obj`].
///
/// # Errors
/// Where it says something that is no OBJ, or has no surface; with the line.
pub fn parse_obj(bytes: &[u8]) -> Result<Import, ObjError> {
    let statements = Statements::scan(bytes)?;
    let mut soup = soup(&statements)?;
    let odd_colours = clamp_colours(&mut soup.colours);
    let lines = statements.face_lines();
    let repaired = repair(soup, &RepairSettings::default()).map_err(|error| locate(error, &statements, &lines))?;
    let face_lines = repaired.polygons.iter().map(|&polygon| lines[polygon as usize]).collect();
    let notes = statements.notes().into_iter().chain(odd_colours).chain(Note::coarse(repaired.mesh.positions())).collect();
    Ok(Import { mesh: repaired.mesh, repairs: repaired.report, notes, face_lines })
}

/// Lets `tobj` parse the numbers.
///
/// `tobj` numbers the vertices anew for each object, in the order in which faces use them, and drops the others. [`Statements`] hands it
/// one object only, in which a first polygon goes through all vertices in order: so numbered, they keep their places.
fn soup(statements: &Statements<'_>) -> Result<Soup, ObjError> {
    let text = statements.text().map_err(|error| ObjError::whole(ObjFault::Unreadable(error)))?;
    let mut reader = CountingReader::new(&text);
    let result = tobj::load_obj_buf(&mut reader, &tobj::LoadOptions::default(), |_| Ok(Default::default()));
    let lines_read = reader.line();
    let (models, _) = result.map_err(|error| Statements::fault(error, lines_read))?;
    drop(text);
    let parsed = models.into_iter().next().map(|model| model.mesh).ok_or_else(|| ObjError::whole(ObjFault::NoFaces))?;
    Ok(soup_of(parsed, statements))
}

/// All polygons but the first, which only numbers the vertices.
fn soup_of(mut parsed: tobj::Mesh, statements: &Statements<'_>) -> Soup {
    // `tobj` leaves the arities out where all are three.
    let arity = |polygon: usize| parsed.face_arities.get(polygon).copied().unwrap_or(3);
    let first = arity(0);
    let ends = (1..=statements.faces()).scan(0, |end, polygon| {
        *end += arity(polygon);
        Some(*end)
    });
    let ends = ends.collect();
    parsed.indices.drain(..(first as usize).min(parsed.indices.len()));
    let mut soup = Soup {
        positions: parsed.positions.chunks_exact(3).map(DVec3::from_slice).collect(),
        corners: parsed.indices,
        ends,
        ..Soup::default()
    };
    if statements.have_colours() {
        soup.colours = parsed.vertex_color.chunks_exact(3).map(linear).collect();
    }
    if statements.have_coordinates() {
        parsed.texcoord_indices.drain(..(first as usize).min(parsed.texcoord_indices.len()));
        soup.texture_coordinates = parsed.texcoords.chunks_exact(2).map(DVec2::from_slice).collect();
        soup.corner_coordinates = parsed.texcoord_indices;
    }
    soup
}

/// A colour as a file has it, in linear light and opaque; as it is where it is no number.
fn linear(encoded: &[f64]) -> Vec4 {
    let [red, green, blue] = [0, 1, 2].map(|k| srgb_to_linear(encoded[k]) as f32);
    Vec4::new(red, green, blue, 1.0)
}

/// Brings colours to their range, and says so; numbers that are none stay.
fn clamp_colours(colours: &mut [Vec4]) -> Option<Note> {
    let range = Vec4::ZERO..=Vec4::ONE;
    let mut vertices = 0;
    for colour in colours.iter_mut().filter(|colour| colour.is_finite()) {
        let clamped = colour.clamp(*range.start(), *range.end());
        vertices += usize::from(clamped != *colour);
        *colour = clamped;
    }
    (vertices > 0).then_some(Note::ColoursOutOfRange { vertices })
}

/// Says of what cannot be mended in which line it is.
fn locate(error: RepairError, statements: &Statements<'_>, lines: &[u32]) -> ObjError {
    match error {
        RepairError::NotFinite { vertex } => {
            ObjError { path: None, line: statements.vertex_line(vertex as usize), fault: ObjFault::NotFinite { vertex: vertex + 1 } }
        }
        RepairError::ColourNotFinite { vertex } => {
            ObjError { path: None, line: statements.vertex_line(vertex as usize), fault: ObjFault::ColourNotFinite { vertex: vertex + 1 } }
        }
        RepairError::CoordinateNotFinite { polygon } => ObjError::at(lines[polygon] as usize, ObjFault::CoordinateNotFinite),
        other => ObjError::whole(ObjFault::Repair(other)),
    }
}

#[cfg(test)]
mod tests;
