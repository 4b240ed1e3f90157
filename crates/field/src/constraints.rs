//! A few directions, blended over the surface.

use glam::DVec3;
use pelage_mesh::{Mesh, Vertex, VertexId, unit};

use crate::FieldError;
use crate::distance::Network;

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

/// The mean of the constraints' directions at each vertex, weighted by Gaussians over shortest paths; at most 1 long.
///
/// Where constraints contradict each other some of `tie_break` is added, so that between opposite ones the field turns by one side
/// throughout: else rounding would choose the side anew at each edge, and leave a row of singularities.
pub(crate) fn blend(
    mesh: &Mesh,
    constraints: &[Constraint],
    directions: &[DVec3],
    radius: f64,
    tie_break: DVec3,
) -> Result<Vec<DVec3>, FieldError> {
    if mesh.topology().face_count() == 0 {
        return Err(FieldError::NoSurface);
    }
    let network = Network::new(mesh);
    let mut blends = vec![Blend::default(); mesh.positions().len()];
    for (constraint, &direction) in constraints.iter().zip(directions) {
        let Some(source) = nearest_vertex(mesh, constraint.at) else { continue };
        network.walk([source], |vertex, distance| {
            blends[vertex.index()].add(0.5 * (distance / radius).powi(2), direction);
        });
    }
    let sum: DVec3 = directions.iter().sum();
    let overall = if sum.length() > 1e-9 { unit(sum) } else { directions[0] };
    let wanted = |blend: Blend| {
        let mean = blend.mean().unwrap_or(overall);
        mean + TIE_BREAK * (1.0 - mean.length()).max(0.0) * tie_break
    };
    Ok(blends.into_iter().map(wanted).collect())
}

/// The constraints' directions as unit vectors.
pub(crate) fn checked_directions(constraints: &[Constraint], radius: f64) -> Result<Vec<DVec3>, FieldError> {
    if constraints.is_empty() {
        return Err(FieldError::NoConstraints);
    }
    if !(1e-3..=100.0).contains(&radius) {
        return Err(FieldError::Radius(radius));
    }
    let direction = |(constraint, &Constraint { at, along }): (usize, &Constraint)| {
        if !at.is_finite() {
            return Err(FieldError::ConstraintPlace { constraint, at });
        }
        let direction = unit(along);
        if direction == DVec3::ZERO { Err(FieldError::ConstraintDirection { constraint, along }) } else { Ok(direction) }
    };
    constraints.iter().enumerate().map(direction).collect()
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
    fn add(&mut self, exponent: f64, direction: DVec3) {
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
        let terms = [(900.0, DVec3::X), (2.0, DVec3::Y), (1.5, DVec3::Z), (2000.0, DVec3::ONE)];
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
