//! Where a ray crosses a triangle of the skin.

use glam::DVec3;

use crate::ray::Ray;

/// How far away, and the barycentric coordinates there.
pub(crate) type Crossing = (f64, DVec3);

/// The crossing from either side; a ray through an edge that two triangles share crosses at least one of them, as both work out the same number for it but for its
/// sign.
pub(crate) fn crossing(ray: &Ray, corners: [DVec3; 3]) -> Option<Crossing> {
    let [a, b, c] = corners.map(|corner| corner - ray.origin);
    let volume = |from: DVec3, to: DVec3| ray.direction.dot(from.cross(to));
    let volumes = DVec3::new(volume(b, c), volume(c, a), volume(a, b));
    let all = volumes.element_sum();
    let inside = volumes.cmpge(DVec3::ZERO).all() || volumes.cmple(DVec3::ZERO).all();
    if !inside || all == 0.0 {
        return None;
    }
    let beta = volumes / all;
    let distance = (a * beta.x + b * beta.y + c * beta.z).dot(ray.direction);
    distance.is_finite().then_some((distance, beta))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_through_shared_edges_and_vertices_are_stopped() {
        // A fan around a vertex that no axis favours.
        let middle = DVec3::new(0.123, 0.456, 0.0789);
        let rim: Vec<DVec3> =
            (0..7).map(|k| middle + DVec3::new((0.9 * f64::from(k)).cos(), (0.9 * f64::from(k)).sin(), 0.1 * f64::from(k % 2))).collect();
        let faces: Vec<[DVec3; 3]> = (0..6).map(|k| [middle, rim[k], rim[k + 1]]).collect();
        for (k, &end) in rim.iter().enumerate().take(6).skip(1) {
            for step in 0..200 {
                let target = middle.lerp(end, f64::from(step) / 199.0 * 0.99);
                let origin = DVec3::new(0.3 - 0.01 * f64::from(step), 0.7, 3.0 + 0.1 * k as f64);
                let ray = Ray { origin, direction: (target - origin).normalize(), from: 0.0, to: f64::INFINITY };
                let hits: Vec<Crossing> = faces.iter().filter_map(|&face| crossing(&ray, face)).collect();
                assert!(!hits.is_empty(), "slipped through edge {k} at {step}");
                assert!(hits.iter().all(|(distance, _)| (distance - (target - origin).length()).abs() < 1e-9));
            }
        }
    }
}
