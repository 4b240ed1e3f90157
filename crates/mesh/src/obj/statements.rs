//! The statements of an OBJ file that say something about its surface, checked and tidied for `tobj`.

use std::io::Write;

use super::lines::{Statement, statements};
use super::{Note, ObjError, ObjFault};

/// Statements that are known and say nothing about the surface.
const PASSED_OVER: [&[u8]; 10] = [b"vn", b"o", b"g", b"s", b"usemtl", b"mtllib", b"l", b"p", b"mg", b"usemap"];

/// What the file holds, gone through once.
pub(super) struct Statements<'a> {
    kept: Vec<(Keyword, Statement<'a>)>,
    bytes: usize,
    vertices: usize,
    /// Vertices with three numbers after their place.
    coloured_vertices: usize,
    coordinates: usize,
    faces: usize,
    corners_without_coordinates: usize,
    corners_with_coordinates: usize,
    /// The greatest indices that faces name, and whether one counts back to before the file.
    greatest: [i64; 2],
    before_the_file: bool,
    unknown: Option<Note>,
}

/// What a kept statement is about.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Keyword {
    Vertex,
    Coordinates,
    Face,
}

impl<'a> Statements<'a> {
    pub(super) fn scan(bytes: &'a [u8]) -> Result<Self, ObjError> {
        let mut found = Self {
            kept: Vec::new(),
            bytes: bytes.len(),
            vertices: 0,
            coloured_vertices: 0,
            coordinates: 0,
            faces: 0,
            corners_without_coordinates: 0,
            corners_with_coordinates: 0,
            greatest: [0; 2],
            before_the_file: false,
            unknown: None,
        };
        for statement in statements(bytes)? {
            let mut words = statement.words();
            let keyword = match words.next() {
                Some(b"v") => Keyword::Vertex,
                Some(b"vt") => Keyword::Coordinates,
                Some(b"f") => Keyword::Face,
                Some(other) => {
                    found.pass_over(other, statement.line);
                    continue;
                }
                None => continue,
            };
            found.kept.push((keyword, statement));
            found.look_at(keyword, words).map_err(|fault| ObjError::at(statement.line, fault))?;
        }
        if found.faces == 0 {
            let fault = if bytes.contains(&0) { ObjFault::Binary } else { ObjFault::NoFaces };
            return Err(ObjError::whole(fault));
        }
        found.index_out_of_range().map_or(Ok(found), Err)
    }

    fn look_at<'w>(&mut self, keyword: Keyword, mut words: impl Iterator<Item = &'w [u8]>) -> Result<(), ObjFault> {
        match keyword {
            Keyword::Vertex => {
                self.vertices += 1;
                check_numbers(words.by_ref(), 3).then_some(()).ok_or(ObjFault::BadVertex)?;
                self.coloured_vertices += usize::from(words.take(3).filter(|word| is_number(word)).count() == 3);
                Ok(())
            }
            Keyword::Coordinates => {
                self.coordinates += 1;
                check_numbers(words, 2).then_some(()).ok_or(ObjFault::BadTextureCoordinates)
            }
            Keyword::Face => {
                self.faces += 1;
                for word in words {
                    self.look_at_corner(&Corner::parse(word)?);
                }
                Ok(())
            }
        }
    }

    fn look_at_corner(&mut self, corner: &Corner) {
        let coordinates = corner.coordinates.unwrap_or(1);
        self.corners_without_coordinates += usize::from(corner.coordinates.is_none());
        self.corners_with_coordinates += usize::from(corner.coordinates.is_some());
        self.greatest = [self.greatest[0].max(corner.vertex), self.greatest[1].max(corner.coordinates.unwrap_or(0))];
        let is_before = |index: i64, so_far: usize| index == 0 || (index < 0 && !is_inside(index, 0, so_far));
        self.before_the_file |= is_before(corner.vertex, self.vertices) || is_before(coordinates, self.coordinates);
    }

    fn pass_over(&mut self, keyword: &[u8], line: usize) {
        if PASSED_OVER.contains(&keyword) {
            return;
        }
        match &mut self.unknown {
            Some(Note::UnknownStatements { count, .. }) => *count += 1,
            _ => self.unknown = Some(Note::UnknownStatements { count: 1, line, first: legible(keyword) }),
        }
    }

    /// Whether every corner has texture coordinates.
    pub(super) fn have_coordinates(&self) -> bool {
        self.coordinates > 0 && self.corners_without_coordinates == 0
    }

    /// Whether every vertex has a colour.
    pub(super) fn have_colours(&self) -> bool {
        self.coloured_vertices > 0 && self.coloured_vertices == self.vertices
    }

    /// What was left out.
    pub(super) fn notes(&self) -> Vec<Note> {
        let corners = self.corners_without_coordinates;
        let left_out = match (self.coordinates, self.corners_with_coordinates) {
            (0, 1..) => Some(Note::NoTextureCoordinates),
            (1.., _) if corners > 0 => Some(Note::CornersWithoutTextureCoordinates { corners }),
            _ => None,
        };
        let without = self.vertices - self.coloured_vertices;
        let colours = (self.coloured_vertices > 0 && without > 0).then_some(Note::VerticesWithoutColour { vertices: without });
        left_out.into_iter().chain(colours).chain(self.unknown.clone()).collect()
    }

    /// How many faces the file has.
    pub(super) fn faces(&self) -> usize {
        self.faces
    }

    /// What `tobj` is to read: a polygon through all vertices, so that it numbers them in their order, then every line with what it is to know
    /// of it: each one line further down than in the file.
    pub(super) fn text(&self) -> std::io::Result<Vec<u8>> {
        let have_coordinates = self.have_coordinates();
        let vertex_words = if self.have_colours() { 7 } else { 4 };
        let mut text = Vec::with_capacity(self.bytes);
        text.push(b'f');
        for vertex in 1..=self.vertices {
            write!(text, " {vertex}")?;
        }
        text.push(b'\n');
        let mut line = 1;
        for &(keyword, statement) in &self.kept {
            text.extend(std::iter::repeat_n(b'\n', statement.line - line));
            line = statement.line + 1;
            match keyword {
                Keyword::Vertex => put_words(&mut text, statement, vertex_words),
                Keyword::Coordinates if have_coordinates => put_words(&mut text, statement, 3),
                Keyword::Coordinates => {}
                Keyword::Face => put_face(&mut text, statement, have_coordinates),
            }
            text.push(b'\n');
        }
        Ok(text)
    }

    /// The line of every face.
    pub(super) fn face_lines(&self) -> Vec<u32> {
        self.of(Keyword::Face).map(|face| face.line as u32).collect()
    }

    /// The line of the vertex with this number, counted from 0.
    pub(super) fn vertex_line(&self, vertex: usize) -> Option<usize> {
        self.of(Keyword::Vertex).nth(vertex).map(|vertex| vertex.line)
    }

    fn of(&self, keyword: Keyword) -> impl Iterator<Item = Statement<'a>> + '_ {
        self.kept.iter().filter(move |(its, _)| *its == keyword).map(|(_, statement)| *statement)
    }

    /// What `tobj` complained of after it had read so many lines, with its place.
    pub(super) fn fault(error: tobj::LoadError, lines_read: usize) -> ObjError {
        let fault = match error {
            tobj::LoadError::PositionParseError => ObjFault::BadVertex,
            tobj::LoadError::TexcoordParseError => ObjFault::BadTextureCoordinates,
            _ => ObjFault::BadFace,
        };
        ObjError::at(lines_read.saturating_sub(1), fault)
    }

    /// The first index that leads nowhere. `tobj` takes some for none, and does not say where the others are.
    fn index_out_of_range(&self) -> Option<ObjError> {
        let [vertex, coordinates] = self.greatest;
        if !self.before_the_file && vertex <= self.vertices as i64 && coordinates <= self.coordinates as i64 {
            return None;
        }
        let (mut vertices, mut coordinates) = (0, 0);
        self.kept.iter().find_map(|&(keyword, statement)| {
            match keyword {
                Keyword::Vertex => vertices += 1,
                Keyword::Coordinates => coordinates += 1,
                Keyword::Face => {
                    return self.face_out_of_range(statement, vertices, coordinates).map(|fault| ObjError::at(statement.line, fault));
                }
            }
            None
        })
    }

    fn face_out_of_range(&self, face: Statement<'_>, vertices: usize, coordinates: usize) -> Option<ObjFault> {
        corners(face).find_map(|corner| {
            if !is_inside(corner.vertex, self.vertices, vertices) {
                return Some(ObjFault::VertexOutOfRange { index: corner.vertex, count: self.vertices });
            }
            // Without any, they are left out as a whole.
            let index = corner.coordinates.filter(|&index| self.coordinates > 0 && !is_inside(index, self.coordinates, coordinates))?;
            Some(ObjFault::CoordinatesOutOfRange { index, count: self.coordinates })
        })
    }
}

/// A corner of a face: `1`, `1/2`, `1//3` or `1/2/3`, and more slashes as some programs write them.
struct Corner {
    vertex: i64,
    coordinates: Option<i64>,
}

impl Corner {
    fn parse(word: &[u8]) -> Result<Self, ObjFault> {
        let mut indices = word.split(|&byte| byte == b'/');
        let vertex = index(indices.next().unwrap_or_default())?.ok_or(ObjFault::BadFace)?;
        let coordinates = indices.next().map_or(Ok(None), index)?;
        // Normals are not read, but what stands in their place has to be one.
        indices.try_for_each(|word| index(word).map(|_| ()))?;
        Ok(Self { vertex, coordinates })
    }
}

/// The corners of a face that was looked at.
fn corners(face: Statement<'_>) -> impl Iterator<Item = Corner> {
    face.words().skip(1).filter_map(|word| Corner::parse(word).ok())
}

/// A whole number, or nothing if the word is empty.
fn index(word: &[u8]) -> Result<Option<i64>, ObjFault> {
    if word.is_empty() {
        return Ok(None);
    }
    let digits = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(ObjFault::BadFace);
    }
    let number = std::str::from_utf8(word).ok().and_then(|word| word.parse::<i32>().ok());
    number.map(|number| Some(number.into())).ok_or(ObjFault::IndexTooLarge { digits: digits.len() })
}

/// An index: counted from 1 among all, or backwards from the last one so far.
fn is_inside(index: i64, all: usize, so_far: usize) -> bool {
    if index < 0 { index.unsigned_abs() <= so_far as u64 } else { index > 0 && index as u64 <= all as u64 }
}

/// Whether the first words look like numbers, so that `tobj` takes them for the words that they are here.
fn check_numbers<'w>(words: impl Iterator<Item = &'w [u8]>, count: usize) -> bool {
    words.take(count).filter(|word| word.iter().all(u8::is_ascii_graphic)).count() == count
}

/// Whether a word is a number to `tobj` too; what else stands after a place is passed over.
fn is_number(word: &[u8]) -> bool {
    std::str::from_utf8(word).is_ok_and(|word| word.parse::<f64>().is_ok())
}

/// The keyword and the numbers that count: a weight after them is of no use here, and `tobj` wants colours on all lines or none.
fn put_words(text: &mut Vec<u8>, statement: Statement<'_>, count: usize) {
    for word in statement.words().take(count) {
        text.extend_from_slice(word);
        text.push(b' ');
    }
}

/// The corners of a face, as far as they are to be known.
fn put_face(text: &mut Vec<u8>, face: Statement<'_>, have_coordinates: bool) {
    text.push(b'f');
    for corner in face.words().skip(1) {
        let mut indices = corner.split(|&byte| byte == b'/');
        text.push(b' ');
        text.extend_from_slice(indices.next().unwrap_or_default());
        if let Some(coordinates) = indices.next().filter(|_| have_coordinates) {
            text.push(b'/');
            text.extend_from_slice(coordinates);
        }
    }
}

/// A word of the file that may be shown: short, and without anything that a terminal might obey.
fn legible(word: &[u8]) -> String {
    word.iter().take(16).map(|&byte| if byte.is_ascii_graphic() { char::from(byte) } else { '?' }).collect()
}
