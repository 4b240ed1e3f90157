//! Surfaces of any genus and of many components, made for tests.

use std::collections::BTreeMap;

use glam::DVec3;
use pelage_mesh::Mesh;

/// The surface of a slab of unit cubes with `columns` × `rows` square holes through it, each side of a cube cut into `cuts` × `cuts`
/// squares of two faces: closed, of genus `columns` × `rows`.
pub(crate) fn perforated(columns: i32, rows: i32, cuts: i32) -> Mesh {
    let solid = |[x, y, z]: [i32; 3]| {
        let inside = (0..2 * columns + 1).contains(&x) && y == 0 && (0..2 * rows + 1).contains(&z);
        inside && !(x % 2 == 1 && z % 2 == 1)
    };
    let mut surface = Surface::default();
    for x in 0..2 * columns + 1 {
        for z in 0..2 * rows + 1 {
            for axis in 0..3 {
                for side in [-1, 1] {
                    let mut beside = [x, 0, z];
                    beside[axis] += side;
                    if solid([x, 0, z]) && !solid(beside) {
                        surface.square([x, 0, z], axis, side, cuts);
                    }
                }
            }
        }
    }
    Mesh::from_triangles(surface.positions, &surface.triangles).unwrap()
}

/// Copies of a mesh in a row, `count` of them, `step` apart.
pub(crate) fn copies(mesh: &Mesh, count: u32, step: DVec3) -> Mesh {
    let vertices = mesh.positions().len() as u32;
    let positions = (0..count).flat_map(|k| mesh.positions().iter().map(move |&p| p + f64::from(k) * step)).collect();
    let triangles: Vec<[u32; 3]> = (0..count).flat_map(|k| mesh.topology().triangles().map(move |t| t.map(|v| v + k * vertices))).collect();
    Mesh::from_triangles(positions, &triangles).unwrap()
}

#[derive(Default)]
struct Surface {
    numbers: BTreeMap<[i32; 3], u32>,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// One side of a cube, wound anticlockwise seen from outside.
    fn square(&mut self, cube: [i32; 3], axis: usize, side: i32, cuts: i32) {
        for i in 0..cuts {
            for j in 0..cuts {
                let corner = |di: i32, dj: i32| {
                    let mut place = cube.map(|c| c * cuts);
                    place[axis] += if side > 0 { cuts } else { 0 };
                    place[(axis + 1) % 3] += i + di;
                    place[(axis + 2) % 3] += j + dj;
                    place
                };
                let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)].map(|place| self.vertex(place, cuts));
                let faces = if side > 0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
                self.triangles.extend(faces);
            }
        }
    }

    fn vertex(&mut self, place: [i32; 3], cuts: i32) -> u32 {
        let next = self.positions.len() as u32;
        let number = *self.numbers.entry(place).or_insert(next);
        if number == next {
            self.positions.push(DVec3::from(place.map(f64::from)) / f64::from(cuts));
        }
        number
    }
}
