//! A few directions, blended over the surface.

use glam::DVec3;
use pelage_mesh::{Geodesics, Mesh, Vertex, VertexId, unit};

use crate::FieldError;
use crate::point::{self, PointConstraint, Spread};

/// A direction wanted at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// Where, in model coordinates: the vertex nearest to it is meant.
    pub at: DVec3,
    /// Which way, in model coordinates, of any length other than 0.
    pub along: DVec3,
}

/// How much of the tie break is added where constraints cancel: a twentieth of a degree.
const TIE_BREAK: f64 = 1e-3;

/// What is wanted at a few places, checked.
pub(crate) struct Constraints<'a> {
    pub(crate) vectors: &'a [Constraint],
    /// The vectors' directions, of unit length.
    pub(crate) directions: &'a [DVec3],
    pub(crate) points: &'a [PointConstraint],
    /// Standard deviation of the Gaussians, in diameters.
    pub(crate) radius: f64,
}

impl Constraints<'_> {
    /// The mean of the constraints' directions at each vertex, weighted by Gaussians of the distance along the surface; at most 1 long.
    ///
    /// Where constraints contradict each other some of `tie_break` is added, so that between opposite ones the field turns by one side
    /// throughout: else rounding would choose the side anew at each edge, and leave a row of singularities.
    pub(crate) fn blend(&self, mesh: &Mesh, normals: &[DVec3], tie_break: DVec3) -> Vec<DVec3> {
        let diameter = mesh.diameter();
        let mut geodesics = Geodesics::on(mesh);
        let points: Vec<Spread> = self.points.iter().filter_map(|point| Spread::of(point, mesh, normals, &mut geodesics)).collect();
        let gaps: Vec<Gaps> = mesh.vertices().map(|vertex| self.gaps(&points, vertex.id())).collect();
        let mut blends = vec![Blend::default(); mesh.positions().len()];
        for (constraint, &direction) in self.vectors.iter().zip(self.directions) {
            let Some(source) = nearest_vertex(mesh, constraint.at) else { continue };
            // The source is a vertex of the mesh, so that there is a distance.
            let Ok(distances) = geodesics.distances(&[source.into()], f64::INFINITY) else { continue };
            for &(vertex, distance) in distances.nearest_first() {
                // All in one place: everything is near everything.
                let exponent = self.exponent(if diameter > 0.0 { distance / diameter } else { 0.0 });
                blends[vertex.index()].add(exponent + gaps[vertex.index()].all(), direction);
            }
        }
        for (k, blend) in blends.iter_mut().enumerate() {
            for point in &points {
                let exponent = self.exponent(point.distances[k]);
                blend.add(exponent + gaps[k].but(gap(exponent)), point.directions[k]);
            }
        }
        let sum: DVec3 = self.directions.iter().sum();
        let overall = if sum.length() > 1e-9 { unit(sum) } else { self.directions.first().copied().unwrap_or_default() };
        let wanted = |blend: Blend| {
            let mean = blend.mean().unwrap_or(overall);
            mean + TIE_BREAK * (1.0 - mean.length()).max(0.0) * tie_break
        };
        blends.into_iter().map(wanted).collect()
    }

    /// A Gaussian's weight is e^(−this).
    fn exponent(&self, distance: f64) -> f64 {
        0.5 * (distance / self.radius).powi(2)
    }

    fn gaps(&self, points: &[Spread], vertex: VertexId) -> Gaps {
        let mut gaps = Gaps::default();
        for point in points {
            match gap(self.exponent(point.distances[vertex.index()])) {
                f64::INFINITY => gaps.infinite += 1,
                finite => gaps.finite += finite,
            }
        }
        gaps
    }
}

/// The exponent of the gap that a point leaves in the weights of all others: e^(−gap) = 1 − e^(−exponent).
fn gap(exponent: f64) -> f64 {
    -libm::log(-libm::expm1(-exponent))
}

/// The exponents of all points' gaps at one vertex.
#[derive(Clone, Copy, Default)]
struct Gaps {
    finite: f64,
    infinite: u32,
}

impl Gaps {
    fn all(self) -> f64 {
        if self.infinite == 0 { self.finite } else { f64::INFINITY }
    }

    /// Without one of them.
    fn but(self, own: f64) -> f64 {
        let others =
            if own.is_infinite() { Self { infinite: self.infinite - 1, ..self } } else { Self { finite: self.finite - own, ..self } };
        others.all()
    }
}

/// The vectors' directions at unit length, if all constraints are good.
pub(crate) fn checked_directions(vectors: &[Constraint], points: &[PointConstraint], radius: f64) -> Result<Vec<DVec3>, FieldError> {
    if vectors.is_empty() && points.is_empty() {
        return Err(FieldError::NoConstraints);
    }
    if !(1e-3..=100.0).contains(&radius) {
        return Err(FieldError::Radius(radius));
    }
    for (index, constraint) in points.iter().enumerate() {
        point::check(index, constraint)?;
    }
    let direction = |(constraint, &Constraint { at, along }): (usize, &Constraint)| {
        if !at.is_finite() {
            return Err(FieldError::ConstraintPlace { constraint, at });
        }
        let direction = unit(along);
        if direction == DVec3::ZERO { Err(FieldError::ConstraintDirection { constraint, along }) } else { Ok(direction) }
    };
    vectors.iter().enumerate().map(direction).collect()
}

/// The referenced vertex nearest to a place; of equally near ones the first.
fn nearest_vertex(mesh: &Mesh, at: DVec3) -> Option<VertexId> {
    // Squares of model units may leave the range of f64, squares of diameters do not.
    let diameter = mesh.diameter().max(f64::MIN_POSITIVE);
    let distance = |vertex: &Vertex<'_, Mesh>| ((vertex.position() - at) / diameter).length();
    let referenced = mesh.vertices().filter(|vertex| vertex.is_referenced());
    referenced.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(Vertex::id)
}

/// A running weighted mean with weights e^(−exponent), kept relative to the greatest weight so far, so that none underflows.
#[derive(Clone, Copy)]
struct Blend {
    least: f64,
    sum: DVec3,
    weight: f64,
}

impl Default for Blend {
    fn default() -> Self {
        Self { least: f64::INFINITY, sum: DVec3::ZERO, weight: 0.0 }
    }
}

impl Blend {
    /// Nothing at an infinite exponent.
    fn add(&mut self, exponent: f64, direction: DVec3) {
        if exponent == f64::INFINITY {
            return;
        }
        if exponent < self.least {
            let shrink = libm::exp(exponent - self.least);
            (self.sum, self.weight, self.least) = (self.sum * shrink, self.weight * shrink, exponent);
        }
        let weight = libm::exp(self.least - exponent);
        self.sum += weight * direction;
        self.weight += weight;
    }

    fn mean(self) -> Option<DVec3> {
        (self.weight > 0.0).then(|| self.sum / self.weight)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_gaussians_in_any_order() {
        let terms = [(f64::INFINITY, DVec3::ONE), (900.0, DVec3::X), (2.0, DVec3::Y), (1.5, DVec3::Z), (2000.0, DVec3::ONE)];
        let expected = {
            let (y, z) = ((-0.5_f64).exp(), 1.0);
            DVec3::new(0.0, y, z) / (y + z)
        };
        for turn in 0..terms.len() {
            let mut blend = Blend::default();
            let mut order = terms;
            order.rotate_left(turn);
            order.into_iter().for_each(|(exponent, direction)| blend.add(exponent, direction));
            assert!(blend.mean().unwrap().distance(expected) < 1e-12);
        }
        assert_eq!(Blend::default().mean(), None);
    }
}
