//! A part of an edge through which a source is seen straight.

use glam::DVec2;

use super::layout::{Frame, Layout};
use crate::HalfEdgeId;

/// Rays that miss a corner by no more than this part of both lengths see it: else one through a vertex might slip between two windows.
const GRAZING: f64 = 1e-11;

/// A window that could be shorter by less than this fraction is not shorter.
const LEAST_GAIN: f64 = 1e-12;

/// An interval of the edge over which a face is entered, and the source that is seen through it, in the frame of the half-edge of that face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// The half-edge, with the entered face on its left.
    pub(super) half_edge: HalfEdgeId,
    /// Where the interval starts and ends, from the half-edge's origin.
    pub(super) from: f64,
    pub(super) to: f64,
    /// The source, unfolded; on or below the x axis.
    pub(super) source: DVec2,
    /// How far the source itself is from where distance is measured from.
    pub(super) offset: f64,
}

impl Window {
    /// The distance of the nearest of its points.
    pub(super) fn nearest(&self) -> f64 {
        let x = self.source.x.clamp(self.from, self.to);
        self.offset + self.source.distance(DVec2::new(x, 0.0))
    }

    /// The distance of a point that is seen through it.
    pub(super) fn distance_to(&self, point: DVec2) -> f64 {
        self.offset + self.source.distance(point)
    }

    fn ends(&self) -> [DVec2; 2] {
        [DVec2::new(self.from, 0.0), DVec2::new(self.to, 0.0)]
    }

    /// Whether a point above lies to the left of all rays, to the right of all, or between.
    pub(super) fn sees(&self, point: DVec2) -> Sight {
        let arm = point - self.source;
        let [left, right] = self.ends().map(|end| end - self.source);
        let grazing = GRAZING * arm.length();
        if left.perp_dot(arm) > grazing * left.length() {
            Sight::Left
        } else if right.perp_dot(arm) < -grazing * right.length() {
            Sight::Right
        } else {
            Sight::Between
        }
    }

    /// Where the ray to a point crosses the edge.
    pub(super) fn crossing(&self, point: DVec2) -> f64 {
        let rise = point.y - self.source.y;
        let part = if rise > 0.0 { -self.source.y / rise } else { 0.0 };
        (self.source.x + part * (point.x - self.source.x)).clamp(self.from, self.to)
    }

    /// The window on a far side of the face, between the rays through both ends, as far as `wanted` of the side; none if nothing is left.
    pub(super) fn beyond(
        &self,
        frame: &Frame,
        behind: HalfEdgeId,
        length: f64,
        starts_at_corner: bool,
        ends_at_corner: bool,
    ) -> Option<Self> {
        if length <= 0.0 {
            return None;
        }
        let source = frame.see(self.source);
        let hit = |end: DVec2, missing: f64| {
            let through = frame.see(end);
            let rise = through.y - source.y;
            if rise > 0.0 { (source.x - source.y / rise * (through.x - source.x)).clamp(0.0, length) } else { missing }
        };
        let [left, right] = self.ends();
        let from = if starts_at_corner { 0.0 } else { hit(left, 0.0) };
        let to = if ends_at_corner { length } else { hit(right, length) };
        let source = DVec2::new(source.x, source.y.min(0.0));
        (to > from).then_some(Self { half_edge: behind, from, to, source, offset: self.offset })
    }

    /// Whether no shortest path comes through it: one by way of a corner of the face that it leaves is as short (Xin and Wang 2009, theorem 3.2).
    pub(super) fn is_useless(&self, layout: &Layout<'_>, distances: &[f64]) -> bool {
        let half_edge = layout.mesh.half_edge(self.half_edge);
        let known = |vertex: crate::Vertex<'_, crate::Mesh>| distances[vertex.index()];
        let length = layout.length(self.half_edge);
        let [left, right] = self.ends();
        let [by_left, by_right] = [left, right].map(|end| self.distance_to(end));
        let beats = |other: f64, ours: f64| other < ours * (1.0 - LEAST_GAIN);
        if beats(known(half_edge.origin()) + self.to, by_right) || beats(known(half_edge.tip()) + (length - self.from), by_left) {
            return true;
        }
        let Some(behind) = half_edge.twin() else { return false };
        let apex = layout.apex(behind.id());
        let corner = DVec2::new(length - apex.x, -apex.y);
        // The rays leave that corner on one side; a path from there to the far end of the window crosses all of them.
        let to_corner = corner - self.source;
        if (left - self.source).perp_dot(to_corner) >= 0.0 {
            beats(known(behind.apex()) + corner.distance(right), by_right)
        } else if (right - self.source).perp_dot(to_corner) <= 0.0 {
            beats(known(behind.apex()) + corner.distance(left), by_left)
        } else {
            false
        }
    }
}

/// Where a point lies for the rays of a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sight {
    Left,
    Between,
    Right,
}
