//! A brush on a surface: what of it a stroke touches, and how strongly.

use glam::DVec3;
use pelage_mesh::{Geodesics, Mesh, Source, SpatialIndex, SurfacePoint, VertexId};

use super::stroke::MOST_PLACES;
use super::tools::{Touch, touch};
use super::{BrushStroke, Comb};
use crate::FieldError;

/// A stroke's places are no further apart than this part of its radius.
const SPACING: f64 = 0.25;

/// What strokes on one mesh share; making it is linear in the mesh, a stroke in what it touches.
pub struct Brush<'a> {
    mesh: &'a Mesh,
    /// Of the mesh: to work it out looks at every vertex.
    diameter: f64,
    index: SpatialIndex<'a>,
    geodesics: Geodesics<'a>,
    normals: Vec<DVec3>,
}

impl<'a> Brush<'a> {
    /// For strokes on this mesh.
    pub fn on(mesh: &'a Mesh) -> Self {
        Self {
            mesh,
            diameter: mesh.diameter(),
            index: SpatialIndex::of(mesh),
            geodesics: Geodesics::on(mesh),
            normals: mesh.vertex_normals(),
        }
    }

    /// Applies a stroke, and gives the vertices that it touched, the nearest to its path first. Nothing else is looked at.
    ///
    /// # Errors
    /// A stroke out of range or off the surface, a comb of another mesh; the comb is then as it was.
    pub fn apply(&mut self, stroke: &BrushStroke, comb: &mut Comb) -> Result<Vec<VertexId>, FieldError> {
        let vertices = self.mesh.positions().len();
        if comb.leans.len() != vertices {
            return Err(FieldError::Length { values: comb.leans.len(), expected: vertices });
        }
        let places = self.places(stroke)?;
        let radius = stroke.radius * self.diameter;
        let sources: Vec<Source> = places.iter().map(|place| Source::Point(place.1)).collect();
        // Places on the surface and a radius that was checked: there is nothing left to refuse.
        let near =
            self.geodesics.distances(&sources, radius).map_err(|_| FieldError::Stroke { what: "its places are not on the surface" })?;
        let path: Vec<DVec3> = places.iter().map(|place| place.0).collect();
        let touches: Vec<Touch> = near
            .nearest_first()
            .iter()
            .filter(|(vertex, _)| self.normals[vertex.index()] != DVec3::ZERO)
            .map(|&(vertex, distance)| Touch {
                vertex,
                weight: stroke.strength * falloff(distance / radius),
                normal: self.normals[vertex.index()],
            })
            .collect();
        touch(self.mesh, &self.normals, stroke.tool, &path, &touches, comb);
        Ok(touches.iter().map(|touch| touch.vertex).collect())
    }

    /// The stroke's places on the surface, with others between those that are far apart.
    fn places(&self, stroke: &BrushStroke) -> Result<Vec<(DVec3, SurfacePoint)>, FieldError> {
        stroke.check()?;
        let radius = stroke.radius * self.diameter;
        let mut places = Vec::new();
        for (number, &place) in stroke.path.iter().enumerate() {
            let before = number.checked_sub(1).map_or(place, |before| stroke.path[before]);
            let steps = ((place - before).length() / (SPACING * radius)).ceil().max(1.0);
            if places.len() as f64 + steps > MOST_PLACES as f64 {
                return Err(FieldError::Stroke { what: "its path is longer than 1000 of its radii: part it, or widen it" });
            }
            for step in 1..=steps as usize {
                let at = before.lerp(place, step as f64 / steps);
                let nearest = self.index.closest_point(at).ok_or(FieldError::NoSurface)?;
                if nearest.distance > radius {
                    return Err(FieldError::StrokeOff { place: number, at, distance: nearest.distance, radius });
                }
                places.push((nearest.position, nearest.point));
            }
        }
        Ok(places)
    }
}

/// From 1 at the middle to 0 at the rim, smoothly at both.
fn falloff(part: f64) -> f64 {
    let left = (1.0 - part * part).max(0.0);
    left * left
}
