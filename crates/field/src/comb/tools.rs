//! What each tool does to the fur under it.

use glam::DVec3;
use pelage_mesh::{Mesh, VertexId, unit};

use super::{Comb, MOST_SLANT, Tool, bounded};
use crate::transport::{tangent_part, transport};

/// A vertex under the brush, and how much of it it feels.
pub(super) struct Touch {
    pub(super) vertex: VertexId,
    pub(super) weight: f64,
    pub(super) normal: DVec3,
}

/// Changes the fur at the vertices touched. What a vertex becomes depends on what its neighbours were, not on what they become.
pub(super) fn touch(mesh: &Mesh, normals: &[DVec3], tool: Tool, path: &[DVec3], touches: &[Touch], comb: &mut Comb) {
    let hand = Hand { mesh, normals, path };
    let leans: Vec<DVec3> = touches.iter().map(|touch| bounded(hand.lean(tool, touch, &comb.leans))).collect();
    for (touch, lean) in touches.iter().zip(leans) {
        let vertex = touch.vertex.index();
        comb.leans[vertex] = lean;
        comb.lengths[vertex] = length(tool, touch.weight, comb.lengths[vertex]);
    }
}

/// What the fur's length becomes.
fn length(tool: Tool, weight: f64, now: f64) -> f64 {
    match tool {
        Tool::Cut { to } => now.min(1.0 + (to - 1.0) * weight),
        Tool::Puff { by } => (now * (1.0 + by * weight)).min(f64::from(f32::MAX)),
        _ => now,
    }
}

struct Hand<'a> {
    mesh: &'a Mesh,
    normals: &'a [DVec3],
    path: &'a [DVec3],
}

impl Hand<'_> {
    /// What the lean of a vertex becomes.
    fn lean(&self, tool: Tool, touch: &Touch, leans: &[DVec3]) -> DVec3 {
        let now = leans[touch.vertex.index()];
        let at_angle = |direction: DVec3, slant: f64| now.lerp(direction * slant.clamp(-MOST_SLANT, MOST_SLANT), touch.weight);
        match tool {
            Tool::Comb { toward } => now + tangent_part(toward, touch.normal) * touch.weight,
            Tool::Along { slant } => at_angle(self.along(touch), slant),
            Tool::Smooth => now.lerp(self.mean_of_neighbours(touch, leans), touch.weight),
            Tool::Part { slant } => at_angle(self.aside(touch), slant),
            Tool::Whorl { turn, slant } => {
                let away = unit(tangent_part(self.mesh.vertex(touch.vertex).position() - self.path[0], touch.normal));
                at_angle(away * libm::cos(turn) + touch.normal.cross(away) * libm::sin(turn), slant)
            }
            Tool::Lift => now * (1.0 - touch.weight),
            Tool::Flatten { slant } => at_angle(unit(now), slant),
            Tool::Cut { .. } => now,
            Tool::Puff { .. } => now * (1.0 - 0.5 * touch.weight),
        }
    }

    /// The place of the path that is nearest to a vertex.
    fn nearest(&self, touch: &Touch) -> usize {
        let at = self.mesh.vertex(touch.vertex).position();
        let distance = |place: usize| self.path[place].distance_squared(at);
        (0..self.path.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    }

    /// The unit tangent away from the path; zero on it.
    fn aside(&self, touch: &Touch) -> DVec3 {
        let place = self.nearest(touch);
        let away = self.mesh.vertex(touch.vertex).position() - self.path[place];
        let line = self.tangent(place);
        unit(tangent_part(away - line * away.dot(line), touch.normal))
    }

    /// The unit tangent along the path where it passes a vertex.
    fn along(&self, touch: &Touch) -> DVec3 {
        unit(tangent_part(self.tangent(self.nearest(touch)), touch.normal))
    }

    /// The unit direction of the path at one of its places.
    fn tangent(&self, place: usize) -> DVec3 {
        let (before, after) = (place.saturating_sub(1), (place + 1).min(self.path.len() - 1));
        unit(self.path[after] - self.path[before])
    }

    fn mean_of_neighbours(&self, touch: &Touch, leans: &[DVec3]) -> DVec3 {
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        for neighbour in self.mesh.vertex(touch.vertex).neighbours() {
            sum += transport(leans[neighbour.index()], self.normals[neighbour.index()], touch.normal);
            count += 1.0;
        }
        if count > 0.0 { sum / count } else { leans[touch.vertex.index()] }
    }
}
