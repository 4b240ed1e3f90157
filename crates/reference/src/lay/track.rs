//! The way of a straight piece of hair over one face, cut where it bends.

use glam::DVec3;

use super::{Laid, MOST_CUTS, first_two, lerp};
use crate::error::FARTHEST;
use crate::face::{FaceMap, Margins, Sheet};
use crate::hair::Piece;
use crate::segment::{Origin, Segment};

/// A piece of hair on a face: barycentric coordinates, heights, and all else, run evenly from one end to the other.
pub(super) struct Track<'a> {
    pub(super) map: &'a FaceMap,
    /// What maps places to the surface: the face's own, or that with one curve.
    pub(super) sheet: &'a Sheet,
    pub(super) piece: &'a Piece,
    /// At both ends of the piece.
    pub(super) beta: [DVec3; 2],
    /// The place whose colour and light the hair has; where it is itself without.
    pub(super) rooted: Option<DVec3>,
    /// How far inside hair must be to be whole; `None` where all of it is shown.
    pub(super) inside: Option<Margins>,
    pub(super) face: u32,
    pub(super) copy: u32,
}

impl Track<'_> {
    fn beta_at(&self, part: f64) -> DVec3 {
        self.beta[0].lerp(self.beta[1], part)
    }

    /// Lays the part of the way from one to the other, as many straight segments as keep within `tolerance` radii.
    pub(super) fn lay(&self, part: [f64; 2], tolerance: f64, laid: &mut Laid) {
        if part[1] <= part[0] {
            return;
        }
        let cuts = self.cuts(part, tolerance);
        let mut from = self.knot(part[0]);
        for cut in 1..=cuts {
            let to = self.knot(lerp(part, f64::from(cut) / f64::from(cuts)));
            self.push(&from, &to, laid);
            from = to;
        }
    }

    /// A chord is off a curve by an eighth of its second derivative at most; that is linear on the way, so largest at an end.
    fn cuts(&self, part: [f64; 2], tolerance: f64) -> u32 {
        let length = part[1] - part[0];
        let (turn, rise) = ((self.beta[1] - self.beta[0]) * length, (self.piece.heights[1] - self.piece.heights[0]) * length);
        let bending = part.map(|at| {
            let height = lerp(self.piece.heights, at);
            self.sheet.second_derivative(self.beta_at(at), height, turn, rise).length()
        });
        let radii = part.map(|at| self.radius(at));
        let allowed = tolerance * radii[0].max(radii[1]);
        let most = bending[0].max(bending[1]);
        if most == 0.0 || allowed <= 0.0 { 1 } else { (most / (8.0 * allowed)).sqrt().ceil().clamp(1.0, MOST_CUTS) as u32 }
    }

    /// The strand's, times the side of a tile there.
    fn radius(&self, part: f64) -> f64 {
        lerp(self.piece.radii, part) * self.map.side(lerp(self.piece.heights, part))
    }

    fn knot(&self, part: f64) -> Knot {
        let (beta, height) = (self.beta_at(part), lerp(self.piece.heights, part));
        Knot {
            place: self.sheet.place(beta, height),
            radius: self.radius(part),
            beta: self.rooted.unwrap_or(beta),
            height,
            along: lerp(self.piece.along, part),
        }
    }

    /// Whether hair at a knot may reach out of the face's part of shell space.
    fn is_near_bounds(&self, knot: &Knot) -> bool {
        let Some(margins) = self.inside else { return false };
        let top = knot.beta.dot(self.map.ends.into()).min(1.0) - knot.height;
        (knot.beta - margins.beta).min_element() < 0.0 || top < margins.height
    }

    fn push(&self, from: &Knot, to: &Knot, laid: &mut Laid) {
        let far = |knot: &Knot| !knot.place.is_finite() || knot.place.abs().max_element() + knot.radius >= FARTHEST;
        if far(from) || far(to) {
            laid.dropped += 1;
            return;
        }
        // Hair without width is not seen.
        if from.radius == 0.0 && to.radius == 0.0 {
            return;
        }
        laid.segments.push(Segment {
            ends: [from, to].map(|knot| knot.place.as_vec3().to_array()),
            radii: [from, to].map(|knot| knot.radius as f32),
        });
        laid.origins.push(Origin {
            face: self.face,
            strand: self.piece.strand,
            copy: self.copy,
            is_clipped: self.is_near_bounds(from) || self.is_near_bounds(to),
            beta: [from, to].map(|knot| first_two(knot.beta)),
            heights: [from, to].map(|knot| knot.height as f32),
            along: [from, to].map(|knot| knot.along as f32),
        });
    }
}

/// Where two segments meet.
struct Knot {
    place: DVec3,
    radius: f64,
    beta: DVec3,
    height: f64,
    along: f64,
}
