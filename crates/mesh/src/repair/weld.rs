//! Vertices at the same place become one.

use std::cmp::Ordering;
use std::collections::VecDeque;

use glam::DVec3;

use super::scale::Scale;

/// A unit vector along which no model has many vertices at the same height: its components are in no simple ratio.
const SWEEP: DVec3 = DVec3::new(0.614_210_973_251_438_2, 0.374_736_197_503_108_6, 0.694_497_253_147_612_7);

/// A vertex whose followers are welded to it.
struct Leader {
    height: f64,
    position: DVec3,
    /// The lowest number among it and its followers.
    lowest: u32,
    place: usize,
}

/// For each vertex, the one it is from now on: the first of those within `tolerance` diameters of a common leader.
///
/// Vertices are visited in their order along a slanted line. Each follows the leader in reach if there is one, else it leads: so
/// nothing moves by more than twice the tolerance, however long a chain of near vertices may be, and the order of the vertices
/// does not matter. Only those in use count.
pub(super) fn weld(positions: &[DVec3], in_use: &[bool], scale: &Scale, tolerance: f64) -> Vec<u32> {
    let mut visits: Vec<(f64, u32)> =
        (0..positions.len() as u32).filter(|&v| in_use[v as usize]).map(|v| (scale.place(positions[v as usize]).dot(SWEEP), v)).collect();
    sort_by_height(&mut visits, positions);
    let mut followed: Vec<u32> = vec![0; visits.len()];
    let mut lowest: Vec<u32> = Vec::with_capacity(visits.len());
    let mut near: VecDeque<Leader> = VecDeque::new();
    // Heights are rounded.
    let reach = tolerance + 1e-15;
    for (&(height, vertex), followed) in visits.iter().zip(&mut followed) {
        while near.front().is_some_and(|leader| leader.height < height - reach) {
            near.pop_front();
        }
        let position = positions[vertex as usize];
        let in_reach = |leader: &&mut Leader| scale.between(leader.position, position).length_squared() <= tolerance * tolerance;
        if let Some(leader) = near.iter_mut().rev().find(in_reach) {
            leader.lowest = leader.lowest.min(vertex);
            lowest[leader.place] = leader.lowest;
            *followed = leader.place as u32;
        } else {
            *followed = lowest.len() as u32;
            near.push_back(Leader { height, position, lowest: vertex, place: lowest.len() });
            lowest.push(vertex);
        }
    }
    let mut names: Vec<u32> = (0..positions.len() as u32).collect();
    for (&(_, vertex), &leader) in visits.iter().zip(&followed) {
        names[vertex as usize] = lowest[leader as usize];
    }
    names
}

/// Sorts by height, then by place, so that the order in which vertices are given decides among those at one place only.
fn sort_by_height(visits: &mut [(f64, u32)], positions: &[DVec3]) {
    // Zero of either sign is one height, and one place.
    visits.sort_unstable_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(Ordering::Equal).then(a.1.cmp(&b.1)));
    for level in visits.chunk_by_mut(|a, b| a.0 == b.0) {
        let place = |visit: &(f64, u32)| positions[visit.1 as usize].to_array();
        if level.iter().any(|visit| place(visit) != place(&level[0])) {
            level.sort_by(|a, b| place(a).partial_cmp(&place(b)).unwrap_or(Ordering::Equal));
        }
    }
}
