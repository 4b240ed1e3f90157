//! Polygons cut into triangles.

use earcut::{Earcut, Refiner};
use glam::DVec3;

use super::RepairReport;
use super::faces::Faces;
use super::scale::Scale;
use super::soup::Soup;

/// A part of a quad smaller than this share of it counts as nothing.
const LEAST_SHARE: f64 = 1e-12;

/// More corners than any polygon has that is meant as one; it is cut into a fan.
const MOST_CORNERS: usize = 1 << 24;

/// Cuts all polygons of a soup. `names` says of each vertex which one it is.
pub(super) fn cut_polygons(soup: &Soup, names: &[u32], scale: &Scale, report: &mut RepairReport) -> Faces {
    let has_coordinates = !soup.corner_coordinates.is_empty();
    let mut cutter =
        Cutter { scale, positions: &soup.positions, places: Vec::new(), ears: Earcut::new(), refiner: Refiner::new(), cut: Vec::new() };
    let mut faces = Faces::default();
    faces.corners.reserve(soup.ends.len());
    faces.polygons.reserve(soup.ends.len());
    let (mut ring, mut places): (Vec<u32>, Vec<usize>) = (Vec::new(), Vec::new());
    for (polygon, range) in (0..).zip(soup.ranges()) {
        ring.clear();
        places.clear();
        let given = range.len();
        for corner in range {
            let vertex = names[soup.corners[corner] as usize];
            if ring.last() != Some(&vertex) {
                ring.push(vertex);
                places.push(corner);
            }
        }
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        match (given, ring.len()) {
            (..3, _) => {
                report.faces_with_few_corners += 1;
                continue;
            }
            (_, ..3) => {
                report.faces_collapsed += 1;
                continue;
            }
            (_, left) => report.corners_repeated += given - left,
        }
        report.polygons_tangled += usize::from(!cutter.cut(&ring));
        for &triangle in &cutter.cut {
            let corners = triangle.map(|k| ring[k as usize]);
            if corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0] {
                report.faces_collapsed += 1;
                continue;
            }
            faces.corners.push(corners);
            faces.polygons.push(polygon);
            if has_coordinates {
                faces.coordinates.push(triangle.map(|k| soup.corner_coordinates[places[k as usize]]));
            }
        }
    }
    faces
}

/// Cuts one polygon after another.
struct Cutter<'a> {
    scale: &'a Scale,
    positions: &'a [DVec3],
    places: Vec<[f64; 2]>,
    ears: Earcut<f64>,
    refiner: Refiner,
    /// The triangles of the last polygon, as places in its ring, in its own winding.
    cut: Vec<[u32; 3]>,
}

impl Cutter<'_> {
    /// Cuts a ring of three or more corners; says whether it has an inside.
    fn cut(&mut self, ring: &[u32]) -> bool {
        self.cut.clear();
        if let [_, _, _] = ring {
            self.cut.push([0, 1, 2]);
            return true;
        }
        let at = |k: usize| self.scale.between(self.positions[ring[0] as usize], self.positions[ring[k] as usize]);
        // Newell's normal: twice the area of the polygon's shadow along it, also where it is not flat.
        let normal: DVec3 = (1..ring.len() - 1).map(|k| at(k).cross(at(k + 1))).sum();
        // Scaled before it is squared, as a small polygon's area is a square already.
        let normal = crate::unit(normal);
        let has_inside = normal != DVec3::ZERO;
        match ring {
            [_, _, _, _] if has_inside => return self.cut_quad([DVec3::ZERO, at(1), at(2), at(3)], normal),
            _ if has_inside && is_convex(ring.len(), at, normal) => self.halve(ring.len()),
            _ if has_inside && ring.len() <= MOST_CORNERS && self.clip_ears(ring, normal) => {}
            _ => {
                let last = ring.len() as u32 - 1;
                self.cut.clear();
                self.cut.extend((1..last).map(|k| [0, k, k + 1]));
                return false;
            }
        }
        true
    }

    /// Halves a convex polygon, and the halves again: no corner gets more than twice log₂ n edges, where a fan would give one of them all.
    fn halve(&mut self, corners: usize) {
        let mut open = vec![(0, corners as u32 - 1)];
        while let Some((first, last)) = open.pop() {
            if last - first < 2 {
                continue;
            }
            let middle = first + (last - first) / 2;
            self.cut.push([first, middle, last]);
            open.extend([(middle, last), (first, middle)]);
        }
    }

    /// Cuts along the diagonal from the first corner, unless that leaves the quad or makes a triangle without area; says
    /// whether one of the diagonals lies inside.
    fn cut_quad(&mut self, at: [DVec3; 4], normal: DVec3) -> bool {
        let area = |a: usize, b: usize, c: usize| (at[b] - at[a]).cross(at[c] - at[a]).dot(normal);
        let (first, second) = (area(0, 1, 2).min(area(0, 2, 3)), area(0, 1, 3).min(area(1, 2, 3)));
        let whole = area(0, 1, 2) + area(0, 2, 3);
        let stays = first > LEAST_SHARE * whole || first >= second;
        self.cut.extend(if stays { [[0, 1, 2], [0, 2, 3]] } else { [[0, 1, 3], [1, 2, 3]] });
        first.max(second) >= -LEAST_SHARE * whole
    }

    /// Clips ears of the polygon's shadow along its normal, then flips diagonals until they are Delaunay's; says whether all corners are used.
    fn clip_ears(&mut self, ring: &[u32], normal: DVec3) -> bool {
        let (across, up) = normal.any_orthonormal_pair();
        let first = self.positions[ring[0] as usize];
        let offsets = ring.iter().map(|&v| self.scale.between(first, self.positions[v as usize]));
        self.places.clear();
        self.places.extend(offsets.map(|p| [p.dot(across), p.dot(up)]));
        let mut corners: Vec<u32> = Vec::new();
        self.ears.earcut_slice(&self.places, &[], &mut corners);
        self.refiner.refine(&mut corners, &self.places);
        let triangles = corners.as_chunks::<3>().0;
        // Inside a ring, three of its corners in the order of the ring wind as it does.
        self.cut.extend(triangles.iter().map(|&(mut triangle)| {
            triangle.sort_unstable();
            triangle
        }));
        self.cut.len() == ring.len() - 2
    }
}

/// Whether a polygon turns left at every corner, and goes around once.
fn is_convex(corners: usize, at: impl Fn(usize) -> DVec3, normal: DVec3) -> bool {
    let turns_left = |a: DVec3, b: DVec3, c: DVec3| crate::unit(b - a).cross(crate::unit(c - b)).dot(normal) > LEAST_SHARE;
    let at_every_corner = (0..corners).all(|k| turns_left(at(k), at((k + 1) % corners), at((k + 2) % corners)));
    // A star of five points turns left at every corner too, but not as seen from one of them.
    at_every_corner && (1..corners - 1).all(|k| at(k).cross(at(k + 1)).dot(normal) > 0.0)
}
