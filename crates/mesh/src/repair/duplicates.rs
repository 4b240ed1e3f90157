//! Faces given more than once.

use super::faces::Faces;

/// Drops every face that has the corners of an earlier one, whichever way it is wound; says how many.
///
/// A sheet given once for each of its sides becomes one sheet: with both, each of its edges would have four faces.
pub(super) fn drop_duplicates(faces: &mut Faces) -> usize {
    let mut named: Vec<u128> = faces.corners.iter().zip(0..).map(|(&corners, face)| name(corners, face)).collect();
    named.sort_unstable();
    let mut again = vec![false; faces.len()];
    for pair in named.windows(2) {
        again[pair[1] as u32 as usize] = pair[0] >> 32 == pair[1] >> 32;
    }
    faces.retain(|face| !again[face])
}

/// The corners in rising order, and the number of the face in the lowest 32 bits.
fn name(mut corners: [u32; 3], face: u32) -> u128 {
    corners.sort_unstable();
    let [a, b, c] = corners.map(u128::from);
    a << 96 | b << 64 | c << 32 | u128::from(face)
}
