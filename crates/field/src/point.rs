//! Places that the fur runs away from, towards or around.

use glam::DVec3;
use pelage_mesh::{Face, Geodesics, Mesh, Vertex, unit};

use crate::FieldError;
use crate::completion::neighbour_sum;
use crate::polar::{Seen, first_axis, seen_from};

/// Where the mean of a vertex's direction and its neighbours' is this short, fronts meet there and the direction counts for nothing.
const CONTRADICTION: f64 = 0.2;
/// From here up it counts fully.
const AGREEMENT: f64 = 0.5;

/// A singularity that is wanted at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointConstraint {
    /// Where, in model coordinates: the nearest face with area holds the singularity.
    pub at: DVec3,
    /// How the fur lies about it.
    pub flow: Flow,
}

/// How fur lies about a place, by geodesic directions from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flow {
    /// Turned from straight away by an angle, in radians, anticlockwise seen from outside: 0 is a source, π a sink, ±π/2 a whirl of either
    /// sense, and what lies between a spiral. Index 1.
    Turned(f64),
    /// A saddle: the fur leaves along this direction and its opposite, and arrives from both sides. In model coordinates and of any length;
    /// its part along the surface counts. Index −1.
    Saddle(DVec3),
}

/// A point constraint's say over the whole surface.
pub(crate) struct Spread {
    /// From the face that holds the singularity, in diameters; infinite where no path leads.
    pub(crate) distances: Vec<f64>,
    /// The direction at each vertex, at most 1 long: 1 where neighbours agree, 0 where they contradict each other.
    pub(crate) directions: Vec<DVec3>,
}

impl Spread {
    /// None on a mesh without area.
    pub(crate) fn of(constraint: &PointConstraint, mesh: &Mesh, normals: &[DVec3], geodesics: &mut Geodesics<'_>) -> Option<Self> {
        let face = nearest_face(mesh, constraint.at)?;
        let law = Law::new(constraint.flow, face);
        let seen = seen_from(face, normals, geodesics);
        let mut distances: Vec<f64> = seen.iter().map(|seen| seen.map_or(f64::INFINITY, |seen| seen.distance)).collect();
        let corners = face.vertices();
        // There the point rules alone, however coarse the mesh is.
        corners.iter().for_each(|corner| distances[corner.index()] = 0.0);
        let wanted = |(seen, &normal): (&Option<Seen>, &DVec3)| seen.map_or(DVec3::ZERO, |seen| law.direction(seen, normal));
        let directions: Vec<DVec3> = seen.iter().zip(normals).map(wanted).collect();
        let mut agreed = agreed(mesh, normals, &directions);
        // The singularity itself is no contradiction.
        corners.iter().for_each(|corner| agreed[corner.index()] = directions[corner.index()]);
        Some(Self { distances, directions: agreed })
    }
}

/// How far the wanted direction is turned from straight away, anticlockwise seen from outside.
#[derive(Clone, Copy)]
enum Law {
    Always(f64),
    /// Twice the angle from the axis at this angle, the other way.
    Mirrored(f64),
}

impl Law {
    fn new(flow: Flow, face: Face<'_, Mesh>) -> Self {
        match flow {
            Flow::Turned(angle) => Self::Always(angle),
            Flow::Saddle(along) => {
                let (x, along) = (first_axis(face), unit(along));
                Self::Mirrored(libm::atan2(along.dot(face.normal().cross(x)), along.dot(x)))
            }
        }
    }

    fn direction(self, seen: Seen, normal: DVec3) -> DVec3 {
        let (sin, cos) = libm::sincos(match self {
            Self::Always(turn) => turn,
            Self::Mirrored(axis) => 2.0 * (axis - seen.angle),
        });
        cos * seen.away + sin * normal.cross(seen.away)
    }
}

/// Directions, shorter where a vertex and its neighbours contradict each other: where the fronts from either side of the model meet.
fn agreed(mesh: &Mesh, normals: &[DVec3], directions: &[DVec3]) -> Vec<DVec3> {
    let agreed = |vertex: Vertex<'_, Mesh>| {
        let (sum, count) = neighbour_sum(mesh.topology(), normals, directions, vertex.id());
        let here = directions[vertex.index()];
        let mean = (here + sum).length() / f64::from(count + 1);
        here * ((mean - CONTRADICTION) / (AGREEMENT - CONTRADICTION)).clamp(0.0, 1.0)
    };
    mesh.vertices().map(agreed).collect()
}

/// The face with area that is nearest to a place; of equally near ones the first.
fn nearest_face(mesh: &Mesh, at: DVec3) -> Option<Face<'_, Mesh>> {
    // Squares of model units may leave the range of f64, squares of diameters do not.
    let diameter = mesh.diameter().max(f64::MIN_POSITIVE);
    let distance = |face: Face<'_, Mesh>| to_triangle(face.positions().map(|corner| (corner - at) / diameter));
    let faces = mesh.faces().filter(|face| face.normal() != DVec3::ZERO).map(|face| (face, distance(face)));
    faces.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(face, _)| face)
}

/// The distance from the origin to a triangle with area.
fn to_triangle(corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners;
    let normal = unit((b - a).cross(c - a));
    let sides = [(a, b), (b, c), (c, a)];
    if sides.iter().all(|&(from, to)| (to - from).cross(-from).dot(normal) >= 0.0) {
        return a.dot(normal).abs();
    }
    let to_side = |(from, to): (DVec3, DVec3)| {
        let side = to - from;
        (from + side * (-from.dot(side) / side.length_squared()).clamp(0.0, 1.0)).length()
    };
    sides.into_iter().map(to_side).fold(f64::INFINITY, f64::min)
}

/// What is wrong with a point constraint, if anything.
pub(crate) fn check(constraint: usize, point: &PointConstraint) -> Result<(), FieldError> {
    if !point.at.is_finite() {
        return Err(FieldError::PointPlace { constraint, at: point.at });
    }
    match point.flow {
        Flow::Turned(angle) if !angle.is_finite() => Err(FieldError::PointTurn { constraint, angle }),
        Flow::Saddle(along) if unit(along) == DVec3::ZERO => Err(FieldError::PointDirection { constraint, along }),
        _ => Ok(()),
    }
}
