//! Faces given more than once.

use super::faces::Faces;

/// Drops every face that has the corners of an earlier one, whichever way it is wound; says how many.
///
/// A sheet given once for each of its sides becomes one sheet: with both, each of its edges would have four faces.
pub(super) fn drop_duplicates(faces: &mut Faces) -> usize {
    let mut named: Vec<([u32; 3], u32)> = faces.corners.iter().zip(0..).map(|(&corners, face)| (sorted(corners), face)).collect();
    named.sort_unstable();
    let mut again = vec![false; faces.len()];
    for pair in named.windows(2) {
        again[pair[1].1 as usize] = pair[0].0 == pair[1].0;
    }
    faces.retain(|face| !again[face])
}

fn sorted(mut corners: [u32; 3]) -> [u32; 3] {
    corners.sort_unstable();
    corners
}
