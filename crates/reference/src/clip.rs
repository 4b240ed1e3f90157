//! What of a hair is inside of the part of shell space that a face shows.

use crate::cone::{self, Span};
use crate::face::Skin;
use crate::ray::Ray;
use crate::segment::{Origin, Segment};

/// Faces overlap by so much, in barycentric coordinates and heights, that a ray in the very plane between two is inside of one of them whatever the rounding.
const OVERLAP: f64 = 1e-9;

/// The part of a ray's way through a hair that is over its face, under the hair's end and the outermost shell; none where there is none.
///
/// Both ends of the way are looked for in shell space, and what bounds the face's part of it taken for linear in between, as it is across so short a way but for
/// the square of the hair's width over the face's. Where a hair is cut the ray meets the cut.
pub(crate) fn inside(skin: &Skin<'_>, ray: &Ray, segment: &Segment, origin: &Origin, span: Span) -> Option<Span> {
    let map = skin.map(origin.face as usize)?;
    let (ends, radii) = (segment.axis(), segment.radii.map(f64::from));
    let room = |distance: f64| {
        let place = ray.at(distance);
        let part = cone::part_at(place, ends, radii);
        map.inside(place, (origin.beta_at(part), origin.height_at(part)))
    };
    let (first, last) = (room(span.enter)?, room(span.leave)?);
    let mut part = [0.0f64, 1.0f64];
    for (a, b) in first.into_iter().zip(last).map(|(a, b)| (a + OVERLAP, b + OVERLAP)) {
        match (a >= 0.0, b >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (true, false) => part[1] = part[1].min(a / (a - b)),
            (false, true) => part[0] = part[0].max(a / (a - b)),
        }
    }
    let at = |part: f64| span.enter + (span.leave - span.enter) * part;
    (part[0] <= part[1]).then(|| Span { enter: at(part[0]), leave: at(part[1]) })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::fixture::square;

    #[test]
    fn a_ray_along_a_hair_meets_the_cut_and_leaves_at_it() {
        // The lower face of a square from −½ to ½; a level hair that sticks out of it at x = ½.
        let coat = square(1, 1.0);
        let skin = Skin { coat: &coat, length_scale: 1.0 };
        let segment = Segment { ends: [[0.3, -0.3, 0.05], [0.7, -0.3, 0.05]], radii: [0.02; 2] };
        let map = skin.map(0).unwrap();
        let beta = segment.axis().map(|end| map.barycentric((end + 0.5).truncate()));
        let beta = beta.map(|beta| [beta.x as f32, beta.y as f32]);
        let origin = Origin { face: 0, strand: 0, copy: 0, is_clipped: true, beta, heights: [0.5; 2], along: [0.0, 1.0] };
        let seen = |start: DVec3, direction: DVec3| {
            let ray = Ray { origin: start, direction, from: 0.0, to: f64::INFINITY };
            let span = cone::span(&ray, segment.axis(), segment.radii.map(f64::from)).unwrap();
            inside(&skin, &ray, &segment, &origin, span).map(|span| [span.enter, span.leave])
        };
        let near =
            |found: Option<[f64; 2]>, wanted: [f64; 2]| found.is_some_and(|found| (0..2).all(|k| (found[k] - wanted[k]).abs() < 1e-6));
        let from_outside = seen(DVec3::new(2.0, -0.3, 0.05), DVec3::NEG_X);
        assert!(near(from_outside, [1.5, 1.72]), "{from_outside:?}");
        let from_inside = seen(DVec3::new(-1.0, -0.3, 0.05), DVec3::X);
        assert!(near(from_inside, [1.28, 1.5]), "{from_inside:?}");
        let across = seen(DVec3::new(0.4, -0.3, 2.0), DVec3::NEG_Z);
        assert!(near(across, [1.93, 1.97]), "whole where it is inside: {across:?}");
        assert_eq!(seen(DVec3::new(0.6, -0.3, 2.0), DVec3::NEG_Z), None, "not there outside");
    }
}
