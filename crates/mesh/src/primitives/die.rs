//! The rounded die.

use std::f64::consts::FRAC_PI_4;

use glam::DVec3;

use super::grid::Grid;
use super::{PrimitiveError, build_textured, check_faces, check_fraction, check_length, check_segments};
use crate::Mesh;

/// A cube around the origin with side `size`, in model units, whose edges and corners are rounded with the radius `rounding` × ½ `size`:
/// 0 is a cube, 1 a sphere. Each of its six sides is a grid of `segments` × `segments` cells, some of them on the rounding.
///
/// Texture coordinates: each side shows the whole picture.
///
/// # Errors
/// Where `size` is outside 1e-90 to 1e90, `rounding` outside 0 to 1, `segments` under 3, or there would be more faces than
/// [`MOST_PRIMITIVE_FACES`](crate::MOST_PRIMITIVE_FACES).
pub fn rounded_die(size: f64, rounding: f64, segments: u32) -> Result<Mesh, PrimitiveError> {
    check_length("size", size)?;
    check_fraction("rounding", rounding)?;
    check_segments("segments", segments, 3)?;
    check_faces(6, segments, segments)?;
    let lattice = Lattice { segments };
    let profile = profile(0.5 * size, 0.5 * size * rounding, segments);
    let mut positions = vec![DVec3::ZERO; lattice.vertex_count()];
    let mut grid = Grid::default();
    for side in Side::ALL {
        let place = |i: u32, j: u32| lattice.vertex(side.cell(i, j, segments));
        for j in 0..=segments {
            for i in 0..=segments {
                positions[place(i, j) as usize] = side.point(profile[i as usize], profile[j as usize]);
            }
        }
        // The shorter diagonal, so that corner cells are cut across, not along; the tolerance keeps flat cells alike.
        let rising = |i: u32, j: u32| {
            let at = |i, j| positions[place(i, j) as usize];
            at(i, j).distance(at(i + 1, j + 1)) <= at(i + 1, j).distance(at(i, j + 1)) * (1.0 + 1e-9)
        };
        grid.add(segments, segments, place, rising);
    }
    build_textured(positions, &grid.triangles, grid.coordinates)
}

/// A place along a side: how far from its middle the core below is, and by how much the surface leans there, as the tangent of the angle.
#[derive(Clone, Copy)]
struct Station {
    core: f64,
    lean: f64,
    half: f64,
    radius: f64,
}

/// Places from one edge of a side to the other, evenly spaced on the flat part and evenly on the round parts, which get cells by their length.
fn profile(half: f64, radius: f64, segments: u32) -> Vec<Station> {
    let flat = half - radius;
    let arc = radius * FRAC_PI_4;
    let most = if flat > 0.0 { (segments - 1) / 2 } else { segments / 2 };
    let wanted = (f64::from(segments) * arc / (2.0 * (arc + flat))).round() as u32;
    let round = if radius > 0.0 { wanted.clamp(1, most) } else { 0 };
    let station = |k: u32| {
        let from_end = k.min(segments - k);
        let sign = if 2 * k < segments { -1.0 } else { 1.0 };
        let (core, angle) = if flat <= 0.0 {
            (0.0, FRAC_PI_4 * (1.0 - 2.0 * f64::from(from_end) / f64::from(segments)))
        } else if from_end < round {
            (flat, FRAC_PI_4 * (1.0 - f64::from(from_end) / f64::from(round)))
        } else {
            (flat * (1.0 - 2.0 * f64::from(from_end - round) / f64::from(segments - 2 * round)), 0.0)
        };
        Station { core: sign * core, lean: sign * libm::tan(angle), half, radius }
    };
    (0..=segments).map(station).collect()
}

/// One side of the cube: its outward, rightward and upward axes, with signs.
#[derive(Clone, Copy)]
struct Side {
    axes: [usize; 3],
    signs: [bool; 3],
}

impl Side {
    /// Right × up is outward for each.
    const ALL: [Self; 6] = [
        Self { axes: [2, 0, 1], signs: [true, true, true] },
        Self { axes: [2, 0, 1], signs: [false, false, true] },
        Self { axes: [0, 2, 1], signs: [true, false, true] },
        Self { axes: [0, 2, 1], signs: [false, true, true] },
        Self { axes: [1, 0, 2], signs: [true, true, false] },
        Self { axes: [1, 0, 2], signs: [false, true, true] },
    ];

    fn point(self, right: Station, up: Station) -> DVec3 {
        let signed = |value: f64, k: usize| if self.signs[k] { value } else { -value };
        let core = [right.half - right.radius, right.core, up.core];
        let outwards = DVec3::new(1.0, right.lean, up.lean).normalize();
        let offset = [outwards.x, outwards.y, outwards.z];
        let mut place = [0.0; 3];
        for k in 0..3 {
            place[self.axes[k]] = signed(core[k] + right.radius * offset[k], k);
        }
        DVec3::from_array(place)
    }

    fn cell(self, i: u32, j: u32, segments: u32) -> [u32; 3] {
        let mut cell = [0; 3];
        for (k, along) in [segments, i, j].into_iter().enumerate() {
            cell[self.axes[k]] = if self.signs[k] { along } else { segments - along };
        }
        cell
    }
}

/// The cells of a cube's surface, numbered so that sides share the vertices along their edges: bottom, top, and the rings between.
struct Lattice {
    segments: u32,
}

impl Lattice {
    fn vertex_count(&self) -> usize {
        6 * (self.segments as usize).pow(2) + 2
    }

    fn vertex(&self, [i, j, k]: [u32; 3]) -> u32 {
        let n = self.segments;
        let layer = (n + 1) * (n + 1);
        if k == 0 || k == n {
            return if k == 0 { 0 } else { layer } + j * (n + 1) + i;
        }
        let along_ring = if j == 0 {
            i
        } else if i == n {
            n + j
        } else if j == n {
            2 * n + (n - i)
        } else {
            3 * n + (n - j)
        };
        2 * layer + (k - 1) * 4 * n + along_ring
    }
}
