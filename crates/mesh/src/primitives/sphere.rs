//! The sphere.

use glam::DVec3;

use super::{PrimitiveError, build, check_faces, check_length, check_segments};
use crate::Mesh;

/// A sphere around the origin, `radius` in model units: an icosahedron with each edge cut into `subdivisions` arcs, which gives
/// 20 × `subdivisions`² nearly even triangles. It has no texture coordinates, as no map of a sphere is even.
///
/// # Errors
/// Where `radius` is outside 1e-90 to 1e90, `subdivisions` is 0, or there would be more faces than [`MOST_PRIMITIVE_FACES`](crate::MOST_PRIMITIVE_FACES).
pub fn sphere(radius: f64, subdivisions: u32) -> Result<Mesh, PrimitiveError> {
    check_length("radius", radius)?;
    check_segments("subdivisions", subdivisions, 1)?;
    check_faces(10, subdivisions, subdivisions)?;
    let lattice = Lattice { n: subdivisions };
    let corners = icosahedron();
    let mut positions = vec![DVec3::ZERO; lattice.vertex_count()];
    let mut triangles = Vec::with_capacity(20 * (subdivisions as usize).pow(2));
    for face in 0..FACES.len() {
        for j in 0..=subdivisions {
            for k in 0..=subdivisions - j {
                let direction = between(FACES[face].map(|c| corners[c as usize]), lattice.weights(j, k));
                positions[lattice.vertex(face, j, k) as usize] = radius * direction;
            }
        }
        for j in 0..subdivisions {
            for k in 0..subdivisions - j {
                triangles.push([(j, k), (j + 1, k), (j, k + 1)].map(|(j, k)| lattice.vertex(face, j, k)));
                if j + k + 2 <= subdivisions {
                    triangles.push([(j + 1, k), (j + 1, k + 1), (j, k + 1)].map(|(j, k)| lattice.vertex(face, j, k)));
                }
            }
        }
    }
    build(positions, &triangles)
}

/// The faces of the icosahedron around the pole 0: five at it, ten around the waist, five at the other pole 11.
const FACES: [[u32; 3]; 20] = [
    [0, 1, 2],
    [0, 2, 3],
    [0, 3, 4],
    [0, 4, 5],
    [0, 5, 1],
    [1, 6, 2],
    [2, 6, 7],
    [2, 7, 3],
    [3, 7, 8],
    [3, 8, 4],
    [4, 8, 9],
    [4, 9, 5],
    [5, 9, 10],
    [5, 10, 1],
    [1, 10, 6],
    [11, 7, 6],
    [11, 8, 7],
    [11, 9, 8],
    [11, 10, 9],
    [11, 6, 10],
];

/// The unit directions of its corners: the poles on the y axis, and two rings at heights ±1/√5, turned against each other by a tenth.
fn icosahedron() -> [DVec3; 12] {
    let height = 0.2_f64.sqrt();
    let ring = 2.0 * height;
    std::array::from_fn(|k| match k {
        0 => DVec3::Y,
        11 => -DVec3::Y,
        _ => {
            let upper = k <= 5;
            let tenths = if upper { 2 * (k - 1) } else { 2 * (k - 6) + 1 };
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * tenths as f64 / 10.0);
            DVec3::new(ring * cos, if upper { height } else { -height }, -ring * sin)
        }
    })
}

/// A direction between three that are atan 2 apart. Along a side it is that of spherical interpolation, so that arcs are equal;
/// inside, its weights extended, which keeps areas within a factor of 1.21 of each other (plain projection: up to 2).
fn between(corners: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    let angle = libm::atan(2.0);
    let sum: DVec3 = corners.into_iter().zip(weights).map(|(corner, weight)| corner * libm::sin(angle * weight)).sum();
    sum.normalize()
}

/// Numbers of the vertices of a subdivided icosahedron: its corners, then the inner vertices of each edge, then those of each face.
struct Lattice {
    n: u32,
}

impl Lattice {
    fn vertex_count(&self) -> usize {
        10 * (self.n as usize).pow(2) + 2
    }

    /// Barycentric weights of the vertex *j* steps towards the second corner and *k* towards the third.
    fn weights(&self, j: u32, k: u32) -> [f64; 3] {
        [self.n - j - k, j, k].map(|steps| f64::from(steps) / f64::from(self.n))
    }

    fn vertex(&self, face: usize, j: u32, k: u32) -> u32 {
        let n = self.n;
        let [a, b, c] = FACES[face];
        match (n - j - k, j, k) {
            (i, _, _) if i == n => a,
            (_, j, _) if j == n => b,
            (_, _, k) if k == n => c,
            (_, j, 0) => self.on_edge(a, b, j),
            (_, j, 0..) if j + k == n => self.on_edge(b, c, k),
            (_, 0, k) => self.on_edge(a, c, k),
            (_, j, k) => {
                // Inside, rows of n − 2, n − 3 … vertices.
                let row = (j - 1) * (n - 2) - (j - 1) * j.saturating_sub(2) / 2;
                12 + 30 * (n - 1) + face as u32 * ((n - 1) * (n - 2) / 2) + row + (k - 1)
            }
        }
    }

    /// The vertex `steps` from corner `from` along the edge to corner `to`.
    fn on_edge(&self, from: u32, to: u32, steps: u32) -> u32 {
        let (low, high) = (from.min(to), from.max(to));
        let steps = if from == low { steps } else { self.n - steps };
        12 + edge_number(low, high) * (self.n - 1) + (steps - 1)
    }
}

/// Each of the 30 edges, in the order in which the faces name them first.
fn edge_number(low: u32, high: u32) -> u32 {
    let mut number = 0;
    for face in FACES {
        for k in 0..3 {
            // Each edge is run along upwards by exactly one of its faces.
            let (from, to) = (face[k], face[(k + 1) % 3]);
            if from < to {
                if (from, to) == (low, high) {
                    return number;
                }
                number += 1;
            }
        }
    }
    number
}
