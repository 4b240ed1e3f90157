//! Faces without area.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::faces::Faces;
use super::scale::Scale;

/// A face is flat where its height over its longest side is less than this part of the side: its normal is but rounding.
const FLATNESS: f64 = 1e-12;

/// What decides whether a face is flat.
pub(super) struct Places<'a> {
    pub(super) positions: &'a [DVec3],
    pub(super) scale: &'a Scale,
}

impl Places<'_> {
    /// Whether the corners lie on a line, as far as rounding lets one tell.
    #[inline]
    pub(super) fn is_flat(&self, corners: [u32; 3]) -> bool {
        let [a, b, c] = corners.map(|v| self.positions[v as usize]);
        let (ab, ac, bc) = (self.scale.between(a, b), self.scale.between(a, c), self.scale.between(b, c));
        let longest = ab.length_squared().max(ac.length_squared()).max(bc.length_squared());
        let height = (FLATNESS * FLATNESS * longest).max(self.scale.noise * self.scale.noise);
        // Twice the area is the longest side times the height.
        ab.cross(ac).length_squared() <= longest * height
    }

    pub(super) fn flat_faces(&self, faces: &Faces) -> Vec<u32> {
        (0..faces.len() as u32).filter(|&face| self.is_flat(faces.corners[face as usize])).collect()
    }

    /// Which corner of a flat face lies between the two others, and at which part of the way from the one after it to the one before.
    fn middle(&self, corners: [u32; 3]) -> (usize, f64) {
        let at = corners.map(|v| self.positions[v as usize]);
        let side = |k: usize| self.scale.between(at[(k + 1) % 3], at[(k + 2) % 3]);
        let middle = (0..3).max_by(|&j, &k| side(j).length_squared().total_cmp(&side(k).length_squared()).then(k.cmp(&j))).unwrap_or(0);
        let along = side(middle);
        let part = self.scale.between(at[(middle + 1) % 3], at[middle]).dot(along) / along.length_squared();
        (middle, part)
    }
}

/// What was done about faces without area.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Flattened {
    /// Filled a T-junction: the face along the long side is split.
    pub(super) split: usize,
    /// Dropped.
    pub(super) dropped: usize,
}

/// Takes faces without area out of the surface.
///
/// Such a face usually fills a T-junction: two faces along its short sides, one along its long side. Dropped, it would leave a slit. So the face
/// along the long side is cut in two at the middle corner, and the flat one becomes one of the halves: an edge flip. Only where
/// there is no such face, or several, or it would not do, the flat face is dropped.
pub(super) fn resolve_flat(faces: &mut Faces, texture_coordinates: &mut Vec<DVec2>, places: &Places<'_>, flat: &[u32]) -> Flattened {
    let mut owners = Owners::of_long_sides(faces, places, flat);
    let mut split = 0;
    let mut open: Vec<u32> = flat.iter().rev().copied().collect();
    while let Some(face) = open.pop() {
        let corners = faces.corners[face as usize];
        if !places.is_flat(corners) {
            continue;
        }
        let (middle, part) = places.middle(corners);
        let (from, to) = (corners[(middle + 1) % 3], corners[(middle + 2) % 3]);
        let Some(across) = owners.other(from, to, face) else { continue };
        let Some(halves) = Halves::of(faces, across, corners[middle], (from, to), part) else { continue };
        if places.is_flat(halves.first) || places.is_flat(halves.second) {
            continue;
        }
        halves.put(faces, texture_coordinates, across, face);
        owners.follow(&halves, across, face);
        split += 1;
        // A flat face whose long side lies along one of these waits for just this.
        open.extend(owners.around(&halves).filter(|&waiting| places.is_flat(faces.corners[waiting as usize])));
    }
    let dropped = faces.retain_unflat(places);
    Flattened { split, dropped }
}

impl Faces {
    fn retain_unflat(&mut self, places: &Places<'_>) -> usize {
        let flat: Vec<bool> = self.corners.iter().map(|&corners| places.is_flat(corners)).collect();
        self.retain(|face| !flat[face])
    }
}

/// A face cut in two from a place on one side to the corner across from it.
struct Halves {
    first: [u32; 3],
    second: [u32; 3],
    /// Which corner of the face the side starts at.
    start: usize,
    /// Where along the side the place is.
    part: f64,
}

impl Halves {
    /// Cuts `face` along its side between `ends` at `middle`; nothing if it has no such side.
    fn of(faces: &Faces, face: u32, middle: u32, (from, to): (u32, u32), part: f64) -> Option<Self> {
        let corners = faces.corners[face as usize];
        let runs = |k: &usize| matches!((corners[*k], corners[(*k + 1) % 3]), ends if ends == (from, to) || ends == (to, from));
        let start = (0..3).find(runs)?;
        let (p, q, apex) = (corners[start], corners[(start + 1) % 3], corners[(start + 2) % 3]);
        let part = if p == from { part } else { 1.0 - part };
        Some(Self { first: [p, middle, apex], second: [middle, q, apex], start, part })
    }

    /// The halves take the places of the face and of the flat one; the middle's texture coordinates are those of the side there.
    fn put(&self, faces: &mut Faces, texture_coordinates: &mut Vec<DVec2>, face: u32, flat: u32) {
        let (face, flat) = (face as usize, flat as usize);
        (faces.corners[face], faces.corners[flat]) = (self.first, self.second);
        faces.polygons[flat] = faces.polygons[face];
        if let Some(&coordinates) = faces.coordinates.get(face) {
            let [p, q, apex] = [0, 1, 2].map(|k| coordinates[(self.start + k) % 3]);
            let middle = texture_coordinates.len() as u32;
            texture_coordinates.push(texture_coordinates[p as usize].lerp(texture_coordinates[q as usize], self.part));
            (faces.coordinates[face], faces.coordinates[flat]) = ([p, middle, apex], [middle, q, apex]);
        }
    }

    fn ends(&self) -> (u32, u32) {
        (self.first[0], self.second[1])
    }
}

/// The faces along each edge that is the long side of a flat face.
struct Owners(HashMap<(u32, u32), Vec<u32>>);

fn key(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

impl Owners {
    fn of_long_sides(faces: &Faces, places: &Places<'_>, flat: &[u32]) -> Self {
        let long_side = |&face: &u32| {
            let corners = faces.corners[face as usize];
            let (middle, _) = places.middle(corners);
            (key(corners[(middle + 1) % 3], corners[(middle + 2) % 3]), Vec::new())
        };
        let mut owners = Self(flat.iter().map(long_side).collect());
        for (face, &[a, b, c]) in (0..).zip(&faces.corners) {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                owners.add(from, to, face);
            }
        }
        owners
    }

    /// The one other face along the edge, if there is just one.
    fn other(&self, a: u32, b: u32, face: u32) -> Option<u32> {
        match *self.0.get(&key(a, b))?.as_slice() {
            [x, y] if x == face => Some(y),
            [x, y] if y == face => Some(x),
            _ => None,
        }
    }

    fn add(&mut self, a: u32, b: u32, face: u32) {
        if let Some(along) = self.0.get_mut(&key(a, b)) {
            along.push(face);
        }
    }

    fn remove(&mut self, a: u32, b: u32, face: u32) {
        if let Some(along) = self.0.get_mut(&key(a, b)) {
            along.retain(|&owner| owner != face);
        }
    }

    /// Notes that `face` has become the first half and `flat` the second.
    fn follow(&mut self, halves: &Halves, face: u32, flat: u32) {
        let ([from, middle, apex], (_, to)) = (halves.first, halves.ends());
        for (a, b) in [(from, to), (from, middle), (middle, to)] {
            self.remove(a, b, flat);
        }
        for (a, b) in [(from, to), (to, apex), (apex, from)] {
            self.remove(a, b, face);
        }
        for (half, owner) in [(halves.first, face), (halves.second, flat)] {
            for k in 0..3 {
                self.add(half[k], half[(k + 1) % 3], owner);
            }
        }
    }

    /// The faces along the sides of both halves.
    fn around<'a>(&'a self, halves: &Halves) -> impl Iterator<Item = u32> + use<'a> {
        let ([from, middle, apex], (_, to)) = (halves.first, halves.ends());
        let sides = [(from, middle), (middle, to), (to, apex), (apex, from), (middle, apex)];
        sides.into_iter().filter_map(|(a, b)| self.0.get(&key(a, b))).flatten().copied()
    }
}
