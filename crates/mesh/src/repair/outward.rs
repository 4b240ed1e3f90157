//! Closed pieces wound inwards.

use glam::DVec3;

use super::faces::Faces;
use super::scale::Scale;
use crate::{Component, Topology};

/// A volume smaller than this part of its box's longest side cubed is rounding: a sheet given as a closed piece.
const LEAST_VOLUME: f64 = 1e-12;

/// A closed piece of the surface.
struct Piece<'a> {
    low: DVec3,
    high: DVec3,
    inwards: bool,
    component: Component<'a, Topology>,
}

/// Turns the closed pieces that are wound inwards and lie in no other closed piece's box; says how many.
///
/// Fur on such a piece would grow inside. One within another's box may be the wall of a cavity, which rightly faces away from the matter around
/// it; it stays.
pub(super) fn turn_outwards(faces: &mut Faces, topology: &Topology, positions: &[DVec3], scale: &Scale) -> usize {
    let components = topology.components();
    let closed = components.iter().filter(|component| component.is_closed());
    let mut pieces: Vec<Piece<'_>> = closed.map(|component| Piece::of(component, positions, scale)).collect();
    pieces.sort_by(|a, b| a.low.x.total_cmp(&b.low.x).then(a.component.index().cmp(&b.component.index())));
    let farthest: Vec<f64> = pieces
        .iter()
        .scan(f64::NEG_INFINITY, |farthest, piece| {
            *farthest = farthest.max(piece.high.x);
            Some(*farthest)
        })
        .collect();
    let mut count = 0;
    for (place, piece) in pieces.iter().enumerate().filter(|(_, piece)| piece.inwards) {
        // Only pieces that start no later along x, up to where none of them reaches far enough.
        let level = pieces[place + 1..].iter().take_while(|other| other.low.x == piece.low.x);
        let earlier = (0..place).rev().take_while(|&k| farthest[k] >= piece.high.x).map(|k| &pieces[k]);
        if level.chain(earlier).any(|other| piece.is_within(other)) {
            continue;
        }
        count += 1;
        piece.component.faces().for_each(|face| faces.turn(face.index()));
    }
    count
}

impl<'a> Piece<'a> {
    fn of(component: Component<'a, Topology>, positions: &[DVec3], scale: &Scale) -> Self {
        let corners = || component.faces().map(|face| face.vertices().map(|v| scale.place(positions[v.index()])));
        let nowhere = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = corners().flatten().fold(nowhere, |(low, high), p| (low.min(p), high.max(p)));
        // In the piece's own size, as its volume is the cube of it.
        let (centre, size) = (0.5 * (low + high), (high - low).max_element());
        let tetrahedron = |corners: [DVec3; 3]| {
            let [a, b, c] = corners.map(|p| (p - centre) / size);
            a.dot(b.cross(c)) / 6.0
        };
        let volume: f64 = corners().map(tetrahedron).sum();
        Self { low, high, inwards: volume < -LEAST_VOLUME, component }
    }

    fn is_within(&self, other: &Self) -> bool {
        self.low.cmpge(other.low).all() && self.high.cmple(other.high).all()
    }
}
