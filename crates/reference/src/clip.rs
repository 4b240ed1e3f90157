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
