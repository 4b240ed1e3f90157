//! Loop subdivision.

use glam::{DVec2, DVec3, Vec4};

use crate::{Edge, Mesh, MeshError, Vertex};

/// A mesh is not subdivided to more faces than this: about a gigabyte.
pub const MOST_SUBDIVIDED_FACES: u64 = 8_000_000;

/// Why a mesh cannot be subdivided.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SubdivideError {
    /// More faces than [`MOST_SUBDIVIDED_FACES`].
    #[error("{faces} faces cut {levels} times are over {MOST_SUBDIVIDED_FACES}; cut fewer times, or simplify first")]
    TooManyFaces {
        /// Faces of the mesh.
        faces: usize,
        /// How often it was to be cut.
        levels: u32,
    },
    /// The parts do not make a mesh: a fault of this crate.
    #[error("what is subdivided is no mesh: {0}; please report this")]
    Mesh(#[from] MeshError),
}

/// Cuts each face into four, `levels` times, and smooths: the scheme of C. Loop (Smooth Subdivision Surfaces Based on Triangles, 1987), whose limit has
/// continuous curvature but at vertices of a valence other than six.
///
/// A boundary becomes the cubic B-spline curve of its vertices alone, so that surfaces that share it still meet (Hoppe et al. 1994). Texture coordinates and
/// colours are interpolated along edges, and not smoothed. Old vertices keep their numbers, and face *f* becomes the faces 4*f* to 4*f* + 3; the last is the
/// middle one. Linear time in what comes out.
///
/// # Errors
/// Where there would be more than [`MOST_SUBDIVIDED_FACES`].
///
/// ```
/// let die = pelage_mesh::rounded_die(1.0, 0.0, 3)?;
/// let smooth = pelage_mesh::subdivide(&die, 2)?;
/// assert_eq!(smooth.topology().face_count(), 16 * die.topology().face_count());
/// assert!(smooth.area() < die.area());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn subdivide(mesh: &Mesh, levels: u32) -> Result<Mesh, SubdivideError> {
    let faces = mesh.topology().face_count();
    let finest = 4_u64.checked_pow(levels).and_then(|times| times.checked_mul(faces as u64));
    if finest.is_none_or(|count| count > MOST_SUBDIVIDED_FACES) && faces > 0 {
        return Err(SubdivideError::TooManyFaces { faces, levels });
    }
    let mut subdivided = mesh.clone();
    // Nothing is to be cut in a mesh without faces, however often.
    for _ in 0..if faces > 0 { levels } else { 0 } {
        subdivided = once(&subdivided)?;
    }
    Ok(subdivided)
}

fn once(mesh: &Mesh) -> Result<Mesh, MeshError> {
    let mut positions: Vec<DVec3> = mesh.vertices().map(moved).collect();
    let mut colours: Option<Vec<Vec4>> = mesh.colours().map(<[Vec4]>::to_vec);
    // The vertex in the middle of each half-edge.
    let mut middles = vec![0_u32; mesh.topology().half_edge_count()];
    for edge in mesh.edges() {
        let middle = positions.len() as u32;
        let side = edge.half_edge();
        middles[side.index()] = middle;
        if let Some(twin) = side.twin() {
            middles[twin.index()] = middle;
        }
        positions.push(inserted(edge));
        if let Some(colours) = &mut colours {
            let [a, b] = edge.vertices().map(|end| colours[end.index()]);
            colours.push(0.5 * (a + b));
        }
    }
    let triangles: Vec<[u32; 3]> = (0..)
        .zip(mesh.topology().triangles())
        .flat_map(|(face, corners): (usize, [u32; 3])| quarters(corners, [0, 1, 2].map(|k| middles[3 * face + k])))
        .collect();
    let mut finer = Mesh::from_triangles(positions, &triangles)?;
    if let Some(coordinates) = mesh.texture_coordinates() {
        let of_face = |&[a, b, c]: &[DVec2; 3]| quarters([a, b, c], [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)]);
        finer = finer.with_texture_coordinates(coordinates.as_chunks::<3>().0.iter().flat_map(of_face).flatten().collect())?;
    }
    match colours {
        Some(colours) => finer.with_colours(colours),
        None => Ok(finer),
    }
}

/// The four parts of a face: one at each corner, and the middle. Side *k* runs from corner *k* to the next.
fn quarters<T: Copy>([a, b, c]: [T; 3], [ab, bc, ca]: [T; 3]) -> [[T; 3]; 4] {
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// Where an old vertex goes.
fn moved(vertex: Vertex<'_, Mesh>) -> DVec3 {
    let here = vertex.position();
    if vertex.is_boundary() {
        let mut along = vertex.edges().filter(|edge| edge.is_boundary()).map(|edge| {
            let [a, b] = edge.vertices();
            if a == vertex { b } else { a }
        });
        return match (along.next(), along.next()) {
            (Some(one), Some(other)) => 0.75 * here + 0.125 * one.position() + 0.125 * other.position(),
            _ => here,
        };
    }
    let valence = vertex.valence();
    if valence == 0 {
        return here;
    }
    let count = valence as f64;
    let cosine = libm::cos(std::f64::consts::TAU / count);
    let root = 0.375 + 0.25 * cosine;
    let all = 0.625 - root * root;
    let mean: DVec3 = vertex.neighbours().map(|neighbour| neighbour.position() / count).sum();
    (1.0 - all) * here + all * mean
}

/// Where the vertex of an edge comes.
fn inserted(edge: Edge<'_, Mesh>) -> DVec3 {
    let side = edge.half_edge();
    side.twin().map_or(edge.centre(), |twin| 0.75 * edge.centre() + 0.125 * side.apex().position() + 0.125 * twin.apex().position())
}
