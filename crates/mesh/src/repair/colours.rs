//! Colours of vertices that become one.

use glam::Vec4;

/// Gives every vertex that others are welded to the mean of their colours and its own; `names` says of each vertex which one it is.
///
/// What stays by itself keeps its colour bit for bit. Only vertices in use count.
pub(super) fn blend_welded(colours: &mut [Vec4], names: &[u32], in_use: &[bool]) {
    if colours.is_empty() {
        return;
    }
    let mut welded: Vec<(u32, u32)> =
        (0..).zip(names).filter(|&(vertex, &name)| vertex != name).map(|(vertex, &name)| (name, vertex)).collect();
    welded.retain(|&(_, vertex)| in_use[vertex as usize]);
    welded.sort_unstable();
    for group in welded.chunk_by(|a, b| a.0 == b.0) {
        let kept = group[0].0 as usize;
        let sum: Vec4 = group.iter().map(|&(_, vertex)| colours[vertex as usize]).sum();
        colours[kept] = (colours[kept] + sum) / (group.len() + 1) as f32;
    }
}
