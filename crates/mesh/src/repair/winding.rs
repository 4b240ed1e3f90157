//! Windings that agree.

use std::collections::VecDeque;

use super::faces::Faces;
use super::mates::{Mates, NONE, ends};

/// What making windings agree took.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Agreed {
    /// Faces wound the other way.
    pub(super) turned: usize,
    /// Edges opened, as no way of winding would do.
    pub(super) cut: usize,
}

/// Turns faces until mates run opposite ways, the fewer of each piece; where the surface has one side only, it is cut.
///
/// Agreement spreads from the lowest face of each piece, in all directions at the same pace. On a surface with one side the fronts meet in disagreement, along
/// a line of edges halfway around: there it is opened. All faces stay in one piece, since no edge that agreement came over is opened.
pub(super) fn agree(faces: &mut Faces, mates: &mut Mates) -> Agreed {
    let mut agreed = Agreed::default();
    let mut turned: Vec<Option<bool>> = vec![None; faces.len()];
    let mut front = VecDeque::new();
    let mut piece = Vec::new();
    for seed in 0..faces.len() as u32 {
        if turned[seed as usize].is_some() {
            continue;
        }
        turned[seed as usize] = Some(false);
        front.push_back(seed);
        piece.clear();
        while let Some(face) = front.pop_front() {
            piece.push(face);
            agreed.cut += spread(face, &faces.corners, mates, &mut turned, &mut front);
        }
        // The majority stays as it is; of equal halves the lowest face's.
        let against = piece.iter().filter(|&&face| turned[face as usize] == Some(true)).count();
        if 2 * against > piece.len() {
            piece.iter().for_each(|&face| turned[face as usize] = turned[face as usize].map(|turned| !turned));
        }
    }
    let turned: Vec<bool> = turned.into_iter().map(|turned| turned == Some(true)).collect();
    for face in (0..faces.len()).filter(|&face| turned[face]) {
        faces.turn(face);
        agreed.turned += 1;
    }
    mates.follow(&turned);
    agreed
}

/// Gives the neighbours of a face the winding that agrees with it; opens the edges where that is impossible, and counts them.
fn spread(face: u32, corners: &[[u32; 3]], mates: &mut Mates, turned: &mut [Option<bool>], front: &mut VecDeque<u32>) -> usize {
    let mut cut = 0;
    for half_edge in 3 * face..3 * face + 3 {
        let mate = mates.across[half_edge as usize];
        if mate == NONE {
            continue;
        }
        let same_way = ends(corners, half_edge) == ends(corners, mate);
        let wanted = turned[face as usize].map(|turned| turned != same_way);
        let neighbour = &mut turned[mate as usize / 3];
        if neighbour.is_none() {
            *neighbour = wanted;
            front.push_back(mate / 3);
        } else if *neighbour != wanted {
            let (from, to) = ends(corners, half_edge);
            (mates.torn[from as usize], mates.torn[to as usize]) = (true, true);
            mates.part(half_edge);
            cut += 1;
        }
    }
    cut
}
