//! Which fins are drawn, and how strongly: the formula of fins.wgsl on the processor, to count and to test by.

use glam::Vec3;
use pelage_coat::Coat;

/// What decides about a fin: its quad and the two faces it stands between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinEdge {
    /// The ends of the edge.
    pub ends: [Vec3; 2],
    /// The mean of the two ends' offsets *c_v*, unscaled.
    pub offset: Vec3,
    /// The unit normals of the two faces; at a boundary the second is zero.
    pub face_normals: [Vec3; 2],
    /// How fast the surface turns across the edge, in radians per diameter.
    pub curvature: f32,
}

/// The edges of a coat that has passed [`Coat::check`], in their order; those that do not exist are left out.
pub fn fin_edges(coat: &Coat) -> Vec<FinEdge> {
    let surface = &coat.surface;
    let edges = coat.edges.vertices.iter().zip(&coat.edges.face_normals).zip(&coat.edges.curvatures);
    edges
        .filter_map(|((&[a, b], &face_normals), &curvature)| {
            let at = |array: &[Vec3], index: u32| array.get(index as usize).copied();
            Some(FinEdge {
                ends: [at(&surface.positions, a)?, at(&surface.positions, b)?],
                offset: 0.5 * (at(&surface.offsets, a)? + at(&surface.offsets, b)?),
                face_normals,
                curvature,
            })
        })
        .collect()
}

/// The factor on a fin's opacity, 0 (not drawn) to 1, for a viewer at infinity in the direction `toward_eye`, fur `length_scale` times as long.
///
/// max(0, 2|p| − 1) with p = n · e and n the unit normal of the quad spanned by the edge and the mean offset (Lengyel et al. 2001,
/// section 2.3), so that it fades in from 60° to the line of sight and is whole at the silhouette. Left out are quads without area, and
/// edges of which both faces look away if they lie further beyond the horizon than the fur is long: N·e ≤ −curvature · length, where N is
/// the mean face normal, as the distance from the horizon over the radius of curvature is the angle from it.
pub fn fin_opacity(edge: &FinEdge, toward_eye: Vec3, length_scale: f32) -> f32 {
    let offset = edge.offset * length_scale;
    let along = edge.ends[1] - edge.ends[0];
    let area = along.cross(offset);
    // Written so that NaN counts as no area. The bound is on the squared sine of the quad's angle.
    let has_area = area.length_squared() > 1e-10 * along.length_squared() * offset.length_squared();
    if !has_area {
        return 0.0;
    }
    let [n, m] = edge.face_normals;
    let between = n + m;
    let over_horizon = between.dot(toward_eye) / between.length().max(1e-20);
    let faces = n.dot(toward_eye).max(m.dot(toward_eye)) > 0.0;
    if !(faces || over_horizon > -edge.curvature * offset.length()) {
        return 0.0;
    }
    (2.0 * (area / area.length()).dot(toward_eye).abs() - 1.0).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An edge along z with fur along y, between two faces that look up.
    fn edge() -> FinEdge {
        FinEdge { ends: [Vec3::ZERO, 0.1 * Vec3::Z], offset: 0.02 * Vec3::Y, face_normals: [Vec3::Y; 2], curvature: 5.0 }
    }

    fn from_angle(degrees: f32) -> Vec3 {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        Vec3::new(cosine, sine, 0.0)
    }

    #[test]
    fn whole_at_the_silhouette_and_gone_from_sixty_degrees() {
        assert!((fin_opacity(&edge(), from_angle(0.0), 1.0) - 1.0).abs() < 1e-6);
        assert!((fin_opacity(&edge(), from_angle(30.0), 1.0) - (3.0_f32.sqrt() - 1.0)).abs() < 1e-6);
        assert_eq!(fin_opacity(&edge(), from_angle(60.1), 1.0), 0.0);
        assert!(fin_opacity(&edge(), from_angle(59.9), 1.0) > 0.0);
    }

    #[test]
    fn just_over_the_horizon_is_drawn_and_further_is_not() {
        // Curvature · length = 0.1: the sine of 5.739°.
        assert!(fin_opacity(&edge(), from_angle(-5.7), 1.0) > 0.0);
        assert_eq!(fin_opacity(&edge(), from_angle(-5.8), 1.0), 0.0);
        assert!(fin_opacity(&edge(), from_angle(-5.8), 2.0) > 0.0, "longer fur is seen from further beyond");
    }

    #[test]
    fn one_face_that_looks_is_enough() {
        let fold = FinEdge { face_normals: [Vec3::X, -Vec3::X], curvature: 0.0, ..edge() };
        assert!(fin_opacity(&fold, from_angle(-20.0), 1.0) > 0.0);
        let away = FinEdge { face_normals: [-Vec3::X, -Vec3::X], ..fold };
        assert_eq!(fin_opacity(&away, from_angle(-20.0), 1.0), 0.0);
    }

    #[test]
    fn quads_without_area_are_left_out() {
        for flat in [
            FinEdge { offset: Vec3::ZERO, ..edge() },
            FinEdge { offset: 0.02 * Vec3::Z, ..edge() },
            FinEdge { ends: [Vec3::ONE; 2], ..edge() },
            FinEdge { offset: Vec3::NAN, ..edge() },
        ] {
            assert_eq!(fin_opacity(&flat, Vec3::X, 1.0), 0.0);
        }
        assert_eq!(fin_opacity(&edge(), Vec3::X, 0.0), 0.0);
        // Small is not flat.
        let small = FinEdge { ends: [Vec3::ZERO, 1e-7 * Vec3::Z], offset: 1e-7 * Vec3::Y, ..edge() };
        assert!(fin_opacity(&small, Vec3::X, 1.0) > 0.99);
    }
}
