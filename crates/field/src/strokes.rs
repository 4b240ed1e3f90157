//! Painted strokes.

use glam::DVec3;
use pelage_mesh::{Distances, Geodesics, Mesh, Nearest, Source, SpatialIndex};

use crate::remap::smooth;
use crate::{FieldError, ScalarField};

/// A line painted on the surface with a round brush.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The places that it goes through, in model coordinates: on the surface, or off it by less than the radius. One place is a dab. Between two it runs straight in space, brought to
    /// the nearest point of the surface all the way.
    pub points: Vec<DVec3>,
    /// How far it reaches, along the surface, in diameters of the model: 0.0001 to 10.
    pub radius: f64,
    /// Which part of the radius the edge takes, 0 to 1: 0 is hard, 1 is soft from the middle on.
    pub softness: f64,
    /// What it paints.
    pub value: f32,
}

/// The line is measured from so many points to a radius: it is a chain of beads, whose edge waves by less than a 500th of the radius.
const BEADS: f64 = 8.0;

/// A stroke has at most so many of them.
const MOST_BEADS: f64 = 100_000.0;

/// What is out of reach of [`ScalarField::distance_to_strokes`], or further, in diameters.
pub(crate) const FAR: f64 = 10.0;

impl ScalarField {
    /// `background`, and over it each stroke in turn: its value in the middle, fading into what was there over its edge. Distance is geodesic: a stroke on one leg does not reach the other.
    ///
    /// Cost: a search tree for the mesh, and for each stroke the exact geodesic distance within its radius: the fast one errs by half a side where many sources are close together.
    ///
    /// # Errors
    /// Where a number is out of range, a stroke has no point, a point is off the surface by more than the radius, the way between two is, no vertex is within reach, or the mesh has no faces.
    pub fn strokes(mesh: &Mesh, strokes: &[Stroke], background: f32) -> Result<Self, FieldError> {
        let mut painter = Painter::on(mesh)?;
        let mut values = vec![background; mesh.positions().len()];
        for (index, stroke) in strokes.iter().enumerate() {
            let beads = painter.beads(index, stroke)?;
            let reached = painter.distances(&beads, stroke.radius);
            if reached.is_empty() {
                let radius = stroke.radius;
                return Err(FieldError::StrokeBetweenVertices { stroke: index, radius, side: painter.longest_side(&beads[0]) });
            }
            for (vertex, distance) in reached {
                let edge = stroke.softness * stroke.radius;
                let inside = if edge > 0.0 { ((stroke.radius - distance) / edge).clamp(0.0, 1.0) } else { 1.0 };
                let weight = smooth(inside);
                let old = f64::from(values[vertex]);
                values[vertex] = ((1.0 - weight) * old + weight * f64::from(stroke.value)) as f32;
            }
        }
        Self::new(values)
    }

    /// How far each vertex is from the nearest stroke's line, along the surface, in diameters of the model; what is further than 10, or in a piece without a stroke, is 10 away.
    ///
    /// # Errors
    /// As [`ScalarField::strokes`], but that strokes between vertices are measured from as well.
    pub fn distance_to_strokes(mesh: &Mesh, strokes: &[Stroke]) -> Result<Self, FieldError> {
        let mut painter = Painter::on(mesh)?;
        let beads = strokes.iter().enumerate().map(|(index, stroke)| painter.beads(index, stroke)).collect::<Result<Vec<_>, _>>()?.concat();
        let mut values = vec![FAR as f32; mesh.positions().len()];
        for (vertex, distance) in painter.distances(&beads, FAR) {
            values[vertex] = distance as f32;
        }
        Self::new(values)
    }
}

struct Painter<'a> {
    mesh: &'a Mesh,
    index: SpatialIndex<'a>,
    geodesics: Geodesics<'a>,
    diameter: f64,
}

impl<'a> Painter<'a> {
    fn on(mesh: &'a Mesh) -> Result<Self, FieldError> {
        if mesh.topology().face_count() == 0 {
            return Err(FieldError::NoSurface);
        }
        let diameter = mesh.diameter().max(f64::MIN_POSITIVE);
        Ok(Self { mesh, index: SpatialIndex::of(mesh), geodesics: Geodesics::on(mesh), diameter })
    }

    /// Points of the surface along the stroke.
    fn beads(&self, index: usize, stroke: &Stroke) -> Result<Vec<Nearest>, FieldError> {
        check(index, stroke)?;
        let radius = stroke.radius;
        let length: f64 = stroke.points.windows(2).map(|ends| self.apart(ends[0], ends[1])).sum();
        if BEADS * length > MOST_BEADS * radius {
            return Err(FieldError::StrokeTooLong { stroke: index, radii: length / radius, most: MOST_BEADS / BEADS });
        }
        let mut beads = Vec::new();
        for (point, &at) in stroke.points.iter().enumerate() {
            let nearest = self.nearest(at)?;
            let distance = nearest.distance / self.diameter;
            if distance > radius {
                return Err(FieldError::StrokeOffSurface { stroke: index, point, at, distance, radius });
            }
            if let Some(before) = point.checked_sub(1) {
                beads.extend(self.between(index, stroke, before)?);
            }
            beads.push(nearest);
        }
        Ok(beads)
    }

    /// Those between a point and the next.
    fn between(&self, index: usize, stroke: &Stroke, before: usize) -> Result<Vec<Nearest>, FieldError> {
        let (from, to) = (stroke.points[before], stroke.points[before + 1]);
        let steps = (BEADS * self.apart(from, to) / stroke.radius).ceil().max(1.0) as usize;
        let beads = (1..steps).map(|step| self.nearest(from.lerp(to, step as f64 / steps as f64))).collect::<Result<Vec<_>, _>>()?;
        let farthest = beads.iter().map(|bead| bead.distance / self.diameter).fold(0.0, f64::max);
        if farthest > stroke.radius {
            return Err(FieldError::StrokeLeavesSurface { stroke: index, point: before, distance: farthest, radius: stroke.radius });
        }
        Ok(beads)
    }

    fn nearest(&self, at: DVec3) -> Result<Nearest, FieldError> {
        self.index.closest_point(at).ok_or(FieldError::NoSurface)
    }

    /// In diameters.
    fn apart(&self, from: DVec3, to: DVec3) -> f64 {
        ((to - from) / self.diameter).length()
    }

    /// Vertices within reach of the nearest bead with their distance, both in diameters.
    fn distances(&mut self, beads: &[Nearest], reach: f64) -> Vec<(usize, f64)> {
        let sources: Vec<Source> = beads.iter().map(|bead| bead.point.into()).collect();
        // The beads are on the mesh and the reach is a length, so that there are distances.
        let distances = self.geodesics.exact_distances(&sources, reach * self.diameter);
        let reached = distances.iter().flat_map(Distances::nearest_first);
        reached.map(|&(vertex, distance)| (vertex.index(), distance / self.diameter)).collect()
    }

    /// Of the face that a bead is on, in diameters.
    fn longest_side(&self, bead: &Nearest) -> f64 {
        let sides = self.mesh.face(bead.point.face).half_edges().map(|side| side.length() / self.diameter);
        sides.into_iter().fold(0.0, f64::max)
    }
}

fn check(stroke: usize, of: &Stroke) -> Result<(), FieldError> {
    let numbers = [
        ("radius", of.radius, 0.0001, 10.0),
        ("softness", of.softness, 0.0, 1.0),
        ("value", of.value.into(), f32::MIN.into(), f32::MAX.into()),
    ];
    for (parameter, value, least, most) in numbers {
        if !(least..=most).contains(&value) {
            return Err(FieldError::StrokeSetting { stroke, parameter, value, least, most });
        }
    }
    if of.points.is_empty() {
        return Err(FieldError::EmptyStroke { stroke });
    }
    match of.points.iter().position(|at| !at.is_finite()) {
        Some(point) => Err(FieldError::StrokePlace { stroke, point, at: of.points[point] }),
        None => Ok(()),
    }
}
