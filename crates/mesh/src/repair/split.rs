//! A vertex of its own for each fan of faces.

use super::faces::Faces;
use super::mates::{Entry, Mates, NONE, by_edge, edges, ends};
use super::sets::Sets;

/// What giving each fan its own vertex took.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Split {
    /// Vertices that had several fans though none of their edges was taken apart or cut.
    pub(super) vertices: usize,
    /// For each vertex added, the one it is a copy of.
    pub(super) copies: Vec<u32>,
}

/// Renames the corners of the faces so that corners share a vertex exactly if their faces hang together through mates around it.
///
/// This is the cutting of A. Guéziec, G. Taubin, F. Lazarus, B. Horn: Cutting and Stitching, IEEE TVCG 7(2), 2001. The first fan of a vertex
/// keeps it, the others get copies, numbered after all vertices. Windings must agree.
///
/// Two pairs of faces taken apart at an edge may still share both its ends, where a fan comes by the edge twice. Then all its faces are parted, which
/// opens the fan; and faces that clash even so are set loose altogether.
pub(super) fn split_vertices(faces: &mut Faces, mates: &mut Mates, vertex_count: usize) -> Split {
    let (mut corners, mut split) = fans(faces, mates, vertex_count);
    // Where no edge was taken apart or cut, every edge has the faces of one pair.
    let may_clash = mates.torn.contains(&true);
    for set_loose in [false, true].into_iter().filter(|_| may_clash) {
        let clashing = clashes(&corners);
        if clashing.is_empty() {
            break;
        }
        for half_edge in clashing {
            let (from, to) = ends(&faces.corners, half_edge);
            (mates.torn[from as usize], mates.torn[to as usize]) = (true, true);
            mates.part(half_edge);
            if set_loose {
                let first = half_edge - half_edge % 3;
                (first..first + 3).for_each(|side| mates.part(side));
            }
        }
        (corners, split) = fans(faces, mates, vertex_count);
    }
    faces.corners = corners;
    split
}

/// The corners of all faces with a vertex for each fan.
fn fans(faces: &Faces, mates: &Mates, vertex_count: usize) -> (Vec<[u32; 3]>, Split) {
    let mut sets = Sets::new(3 * faces.len());
    // A corner is named by the half-edge that starts there. Mates run opposite ways, so each starts where the one after the other does.
    for (half_edge, &mate) in (0..).zip(&mates.across) {
        if mate != NONE {
            sets.join(half_edge, mate - mate % 3 + (mate + 1) % 3);
        }
    }
    let mut split = Split::default();
    let mut owner = vec![NONE; vertex_count];
    let mut counted = vec![false; vertex_count];
    let mut names = vec![NONE; 3 * faces.len()];
    for (corner, &vertex) in (0..).zip(faces.corners.as_flattened()) {
        let fan = sets.lowest(corner);
        if fan == corner {
            names[corner as usize] = if owner[vertex as usize] == NONE {
                owner[vertex as usize] = corner;
                vertex
            } else {
                split.vertices += usize::from(!mates.torn[vertex as usize] && !counted[vertex as usize]);
                counted[vertex as usize] = true;
                split.copies.push(vertex);
                (vertex_count + split.copies.len() - 1) as u32
            };
        } else {
            names[corner as usize] = names[fan as usize];
        }
    }
    (names.as_chunks::<3>().0.to_vec(), split)
}

/// The half-edges along edges with more than two, or with two that run the same way.
fn clashes(corners: &[[u32; 3]]) -> Vec<u32> {
    let entries = by_edge(corners);
    let clash = |edge: &&[Entry]| match edge {
        [_] => false,
        [a, b] => ends(corners, a.half_edge) == ends(corners, b.half_edge),
        _ => true,
    };
    edges(&entries).filter(clash).flatten().map(|entry| entry.half_edge).collect()
}
