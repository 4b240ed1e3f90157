//! Why windings clash: what the error says, worked out only once there is one.

use super::build::Clash;
use super::{NONE, TopologyError};
use crate::{HalfEdgeId, VertexId};

/// A clash of windings that no turning of faces could mend is that of a surface with one side; else the faces themselves are named.
pub(super) fn explain(vertex_count: usize, origins: &[VertexId], clash: Clash) -> TopologyError {
    let as_given = TopologyError::EdgeUsedTwice { first: clash.first / 3, second: clash.second / 3, from: clash.from, to: clash.to };
    let neighbours = pair_edges(vertex_count, origins);
    match neighbours.and_then(|neighbours| first_contradiction(origins, &neighbours)) {
        Some((h, g)) => {
            let (from, to) = ends(origins, h);
            TopologyError::NotOrientable { first: h / 3, second: g / 3, from, to }
        }
        None => as_given,
    }
}

fn ends(origins: &[VertexId], half_edge: u32) -> (u32, u32) {
    (origins[half_edge as usize].0, origins[HalfEdgeId(half_edge).next().index()].0)
}

/// The half-edge across each edge whichever way it runs; nothing if an edge has more than two.
fn pair_edges(vertex_count: usize, origins: &[VertexId]) -> Option<Vec<u32>> {
    debug_assert!(origins.iter().all(|v| v.index() < vertex_count));
    let mut keyed: Vec<(u32, u32, u32)> = (0..origins.len() as u32)
        .map(|h| {
            let (from, to) = ends(origins, h);
            (from.min(to), from.max(to), h)
        })
        .collect();
    keyed.sort_unstable();
    let same_edge = |a: &(u32, u32, u32), b: &(u32, u32, u32)| (a.0, a.1) == (b.0, b.1);
    let mut across = vec![NONE; origins.len()];
    for edge in keyed.chunk_by(same_edge) {
        match edge {
            [_] => {}
            [a, b] => {
                across[a.2 as usize] = b.2;
                across[b.2 as usize] = a.2;
            }
            _ => return None,
        }
    }
    Some(across)
}

/// Turns faces outwards from a first one of each piece until two neighbours cannot agree: those are returned.
fn first_contradiction(origins: &[VertexId], across: &[u32]) -> Option<(u32, u32)> {
    let mut turned: Vec<Option<bool>> = vec![None; origins.len() / 3];
    let mut open = Vec::new();
    for seed in 0..turned.len() {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        open.push(seed as u32);
        while let Some(face) = open.pop() {
            for h in 3 * face..3 * face + 3 {
                let g = across[h as usize];
                if g == NONE {
                    continue;
                }
                let same_way = ends(origins, h) == ends(origins, g);
                let wanted = turned[face as usize].map(|turned| turned != same_way);
                let neighbour = (g / 3) as usize;
                if turned[neighbour].is_none() {
                    turned[neighbour] = wanted;
                    open.push(g / 3);
                } else if turned[neighbour] != wanted {
                    return Some((h, g));
                }
            }
        }
    }
    None
}
