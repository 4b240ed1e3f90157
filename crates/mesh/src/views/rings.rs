//! Vertices by the number of edges to them.

use super::{Surface, Vertex};

/// The rings around a vertex, nearest first; see [`Vertex::rings`]. A ring is in the order of its vertices' numbers.
#[derive(Clone, Debug)]
pub struct Rings<'a, S: Surface> {
    surface: &'a S,
    /// The last two rings, sorted: what is one edge from the last is in one of them or in the next.
    before: Vec<crate::VertexId>,
    last: Vec<crate::VertexId>,
}

impl<'a, S: Surface> Rings<'a, S> {
    pub(super) fn around(vertex: Vertex<'a, S>) -> Self {
        Self { surface: vertex.surface(), before: Vec::new(), last: vec![vertex.id()] }
    }
}

impl<'a, S: Surface> Iterator for Rings<'a, S> {
    type Item = Vec<Vertex<'a, S>>;

    fn next(&mut self) -> Option<Self::Item> {
        let of_last = self.last.iter().flat_map(|&id| Vertex::new(self.surface, id).neighbours().map(Vertex::id));
        let known = |id: &crate::VertexId| self.before.binary_search(id).is_ok() || self.last.binary_search(id).is_ok();
        let mut ring: Vec<_> = of_last.filter(|id| !known(id)).collect();
        ring.sort_unstable();
        ring.dedup();
        self.before = std::mem::replace(&mut self.last, ring);
        let views = self.last.iter().map(|&id| Vertex::new(self.surface, id)).collect();
        (!self.last.is_empty()).then_some(views)
    }
}
