//! Loops of the boundary.

use std::collections::BTreeSet;

use super::{Edge, HalfEdge, Surface, Vertex, view};

view! {
    /// A closed walk along the boundary: a hole, or the rim of an open piece. Its identity is its lowest half-edge.
    BoundaryLoop, HalfEdgeId
}

impl<'a, S: Surface> BoundaryLoop<'a, S> {
    /// The half-edge that it starts with, which is its lowest.
    #[inline]
    pub fn first(self) -> HalfEdge<'a, S> {
        HalfEdge::new(self.surface, self.id)
    }

    /// Its half-edges, in the order in which it is walked with the surface on the left.
    pub fn half_edges(self) -> impl Iterator<Item = HalfEdge<'a, S>> + use<'a, S> {
        let first = self.first();
        std::iter::successors(Some(first), move |here| next_along(*here).filter(|&next| next != first))
    }

    /// Its edges, as it is walked.
    pub fn edges(self) -> impl Iterator<Item = Edge<'a, S>> + use<'a, S> {
        self.half_edges().map(HalfEdge::edge)
    }

    /// Its vertices, as it is walked.
    pub fn vertices(self) -> impl Iterator<Item = Vertex<'a, S>> + use<'a, S> {
        self.half_edges().map(HalfEdge::origin)
    }

    /// How many edges, and as many vertices, it has.
    pub fn edge_count(self) -> usize {
        self.half_edges().count()
    }
}

/// The boundary half-edge after one, with the surface on the left: the fan of a boundary vertex starts with the one that has the boundary on its right.
fn next_along<S: Surface>(half_edge: HalfEdge<'_, S>) -> Option<HalfEdge<'_, S>> {
    half_edge.tip().first_leaving()
}

/// The loops that run along the given half-edges, which are in rising order and hold all or none of each loop.
pub(super) fn loops_among<'a, S: Surface>(half_edges: impl Iterator<Item = HalfEdge<'a, S>>) -> Vec<BoundaryLoop<'a, S>> {
    let mut seen = BTreeSet::new();
    let mut loops = Vec::new();
    for first in half_edges.filter(|half_edge| half_edge.is_boundary()) {
        if !seen.contains(&first.id()) {
            let found = BoundaryLoop::new(first.surface(), first.id());
            seen.extend(found.half_edges().map(HalfEdge::id));
            loops.push(found);
        }
    }
    loops
}
