//! The lines of an OBJ file that say something about its surface.

use std::io::{self, BufRead, Read};

use super::{ObjError, ObjFault};

/// The content of an OBJ file with all but `v`, `vt` and `f` lines emptied, so that their numbers stay, counted, and with a line put before it.
pub(super) struct Statements<'a> {
    lines: Vec<&'a [u8]>,
    text: Vec<u8>,
    vertices: usize,
    coordinates: usize,
    faces: usize,
    every_corner_has_coordinates: bool,
}

/// What a line is about.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Keyword {
    Vertex,
    Coordinates,
    Face,
    Other,
}

impl Keyword {
    fn of(line: &[u8]) -> Self {
        match fields(line).next() {
            Some(b"v") => Self::Vertex,
            Some(b"vt") => Self::Coordinates,
            Some(b"f") => Self::Face,
            _ => Self::Other,
        }
    }
}

fn fields(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|field| !field.is_empty())
}

impl<'a> Statements<'a> {
    /// Goes through the lines once.
    pub(super) fn scan(bytes: &'a [u8]) -> Result<Self, ObjError> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut statements = Self {
            lines: bytes.split(|&byte| byte == b'\n').collect(),
            text: Vec::new(),
            vertices: 0,
            coordinates: 0,
            faces: 0,
            every_corner_has_coordinates: true,
        };
        let mut text = Vec::with_capacity(bytes.len());
        for number in 0..statements.lines.len() {
            let line = statements.lines[number];
            match Keyword::of(line) {
                Keyword::Vertex => {
                    statements.vertices += 1;
                    text.extend_from_slice(without_colours(line));
                }
                Keyword::Coordinates => {
                    statements.coordinates += 1;
                    text.extend_from_slice(line);
                }
                Keyword::Face => {
                    statements.faces += 1;
                    statements.look_at_face(line).map_err(|fault| ObjError::at(number + 1, fault))?;
                    text.extend_from_slice(line);
                }
                Keyword::Other => {}
            }
            text.push(b'\n');
        }
        statements.every_corner_has_coordinates &= statements.coordinates > 0;
        statements.text = statements.all_vertices_in_order();
        statements.text.append(&mut text);
        Ok(statements)
    }

    /// Finds corners without texture coordinates, which `tobj` makes up, and relative indices to before the file, on which it overflows.
    fn look_at_face(&mut self, line: &[u8]) -> Result<(), ObjFault> {
        // Nothing that `tobj` would split where `fields` does not.
        if !line.iter().all(|byte| byte.is_ascii_whitespace() || b"f/+-0123456789".contains(byte)) {
            return Err(ObjFault::BadFace);
        }
        for corner in fields(line).skip(1) {
            let mut indices = corner.split(|&byte| byte == b'/');
            if indices.next().and_then(number).is_none() {
                return Err(ObjFault::BadFace);
            }
            let index = indices.next().unwrap_or_default();
            match number(index) {
                None if index.is_empty() => self.every_corner_has_coordinates = false,
                None | Some(0) => return Err(ObjFault::BadFace),
                Some(back) if back < 0 && self.coordinates as i64 + back < 0 => {
                    return Err(ObjFault::CoordinatesOutOfRange { index: back.to_string(), count: self.coordinates });
                }
                Some(_) => {}
            }
        }
        Ok(())
    }

    fn all_vertices_in_order(&self) -> Vec<u8> {
        let mut polygon = String::from("f");
        for vertex in 1..=self.vertices {
            polygon.push(' ');
            polygon.push_str(&vertex.to_string());
        }
        polygon.push('\n');
        polygon.into_bytes()
    }

    /// What `tobj` is to read: a polygon through all vertices, then the statements, each one line further down than in the file.
    pub(super) fn text(&self) -> &[u8] {
        &self.text
    }

    /// How many faces the file has.
    pub(super) fn faces(&self) -> usize {
        self.faces
    }

    pub(super) fn every_corner_has_coordinates(&self) -> bool {
        self.every_corner_has_coordinates
    }

    /// The line of the face with this number, counted from 0.
    pub(super) fn face_line(&self, face: usize) -> usize {
        self.line_of(Keyword::Face, face)
    }

    /// The line of the vertex with this number, counted from 0.
    pub(super) fn vertex_line(&self, vertex: usize) -> usize {
        self.line_of(Keyword::Vertex, vertex)
    }

    fn line_of(&self, keyword: Keyword, count: usize) -> usize {
        let mut found = self.lines.iter().enumerate().filter(|(_, line)| Keyword::of(line) == keyword);
        found.nth(count).map_or(0, |(number, _)| number + 1)
    }

    /// What `tobj` complained of after it had read so many lines, with its place.
    pub(super) fn fault(&self, error: tobj::LoadError, lines_read: usize) -> ObjError {
        let fault = match error {
            tobj::LoadError::FaceVertexOutOfBounds | tobj::LoadError::FaceTexCoordOutOfBounds => return self.index_out_of_range(),
            tobj::LoadError::PositionParseError => ObjFault::BadVertex,
            tobj::LoadError::TexcoordParseError => ObjFault::BadTextureCoordinates,
            tobj::LoadError::FaceParseError => ObjFault::BadFace,
            _ => ObjFault::NotText,
        };
        ObjError::at(lines_read.saturating_sub(1), fault)
    }

    /// Finds the index that `tobj` found out of range; it does not say where.
    fn index_out_of_range(&self) -> ObjError {
        let (mut vertices, mut coordinates) = (0, 0);
        for (line_number, line) in self.lines.iter().enumerate() {
            match Keyword::of(line) {
                Keyword::Vertex => vertices += 1,
                Keyword::Coordinates => coordinates += 1,
                Keyword::Face => {
                    if let Some(fault) = self.face_out_of_range(line, vertices, coordinates) {
                        return ObjError::at(line_number + 1, fault);
                    }
                }
                Keyword::Other => {}
            }
        }
        ObjError::whole(ObjFault::BadFace)
    }

    fn face_out_of_range(&self, line: &[u8], vertices: usize, coordinates: usize) -> Option<ObjFault> {
        for corner in fields(line).skip(1) {
            let mut indices = corner.split(|&byte| byte == b'/').map(number);
            if let Some(index) = indices.next().flatten().filter(|&index| !is_inside(index, self.vertices, vertices)) {
                return Some(ObjFault::VertexOutOfRange { index: index.to_string(), count: self.vertices });
            }
            if let Some(index) = indices.next().flatten().filter(|&index| !is_inside(index, self.coordinates, coordinates)) {
                return Some(ObjFault::CoordinatesOutOfRange { index: index.to_string(), count: self.coordinates });
            }
        }
        None
    }
}

/// An index: counted from 1 among all, or backwards from the last one so far.
fn is_inside(index: i64, all: usize, so_far: usize) -> bool {
    if index < 0 { index.unsigned_abs() <= so_far as u64 } else { index > 0 && index as u64 <= all as u64 }
}

fn number(field: &[u8]) -> Option<i64> {
    std::str::from_utf8(field).ok()?.parse().ok()
}

/// A `v` line up to its third number: weights and colours after it are of no use here, and `tobj` wants them on all lines or none.
fn without_colours(line: &[u8]) -> &[u8] {
    let Some(last) = fields(line).nth(3) else { return line };
    let end = last.as_ptr().addr() - line.as_ptr().addr() + last.len();
    &line[..end]
}

/// A reader that knows how many lines were taken from it.
pub(super) struct CountingReader<'a> {
    rest: &'a [u8],
    lines: usize,
}

impl<'a> CountingReader<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text, lines: 0 }
    }

    /// The number of the last line taken, from 1.
    pub(super) fn line(&self) -> usize {
        self.lines
    }
}

impl Read for CountingReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&self.rest[..count]);
        self.consume(count);
        Ok(count)
    }
}

impl BufRead for CountingReader<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        Ok(self.rest)
    }

    fn consume(&mut self, count: usize) {
        let (taken, rest) = self.rest.split_at(count.min(self.rest.len()));
        // `lines` takes one line at a time, its end included.
        self.lines += usize::from(taken.last() == Some(&b'\n'));
        self.rest = rest;
    }
}
