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
/// A surface with one side is cut along the edges at which its faces clash however they are turned. All its faces stay in one piece, since
/// no edge that agreement came over is opened.
pub(super) fn agree(faces: &mut Faces, mates: &mut Mates) -> Agreed {
    let turned = turns(&faces.corners, mates);
    let mut agreed = Agreed { turned: 0, cut: cut_clashes(&faces.corners, mates, &turned) };
    for face in (0..faces.len()).filter(|&face| turned[face]) {
        faces.turn(face);
        agreed.turned += 1;
    }
    mates.follow(&turned);
    agreed
}

/// Whether each face is to be turned.
///
/// Agreement spreads from the lowest face of each piece, over edges at which faces agree already as far as it gets, and only then over one at
/// which they clash. So the faces that agree as given are turned together or not at all, and a surface with one side that was
/// wound with care has its clashes where whoever made it has put them.
fn turns(corners: &[[u32; 3]], mates: &Mates) -> Vec<bool> {
    let mut turned: Vec<Option<bool>> = vec![None; corners.len()];
    let (mut open, mut clashing) = (VecDeque::new(), VecDeque::new());
    let mut piece = Vec::new();
    for seed in 0..corners.len() as u32 {
        if turned[seed as usize].is_some() {
            continue;
        }
        turned[seed as usize] = Some(false);
        open.push_back(seed);
        piece.clear();
        loop {
            while let Some(face) = open.pop_front() {
                piece.push(face);
                for half_edge in 3 * face..3 * face + 3 {
                    let mate = mates.across[half_edge as usize];
                    if mate == NONE || turned[mate as usize / 3].is_some() {
                        continue;
                    }
                    if ends(corners, half_edge) == ends(corners, mate) {
                        clashing.push_back(half_edge);
                    } else {
                        turned[mate as usize / 3] = turned[face as usize];
                        open.push_back(mate / 3);
                    }
                }
            }
            let Some(half_edge) = clashing.pop_front() else { break };
            let neighbour = mates.across[half_edge as usize] / 3;
            if turned[neighbour as usize].is_none() {
                turned[neighbour as usize] = turned[half_edge as usize / 3].map(|turned| !turned);
                open.push_back(neighbour);
            }
        }
        // The majority stays as it is; of equal halves the lowest face's.
        let against = piece.iter().filter(|&&face| turned[face as usize] == Some(true)).count();
        if 2 * against > piece.len() {
            piece.iter().for_each(|&face| turned[face as usize] = turned[face as usize].map(|turned| !turned));
        }
    }
    turned.into_iter().map(|turned| turned == Some(true)).collect()
}

/// Opens the edges at which faces clash even once they are turned; says how many.
fn cut_clashes(corners: &[[u32; 3]], mates: &mut Mates, turned: &[bool]) -> usize {
    let mut cut = 0;
    for half_edge in 0..3 * corners.len() as u32 {
        let mate = mates.across[half_edge as usize];
        if mate == NONE {
            continue;
        }
        let same_way = ends(corners, half_edge) == ends(corners, mate);
        if (turned[half_edge as usize / 3] != turned[mate as usize / 3]) != same_way {
            let (from, to) = ends(corners, half_edge);
            (mates.torn[from as usize], mates.torn[to as usize]) = (true, true);
            mates.part(half_edge);
            cut += 1;
        }
    }
    cut
}
