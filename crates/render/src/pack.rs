//! Vertex arrays as the shaders read them; mirrors common.wgsl.
//!
//! Per surface vertex 48 bytes, shared by surface, shells and fins: what never moves (position, normal), what combing and motion rewrite
//! (offset, hair direction) and how it looks (colour, end, bend, mix), each an array of its own. Per patch vertex 24: which surface vertex, where on the
//! tile, how the tile lies, and the middle of its patch.

use glam::{Vec2, Vec3};
use pelage_coat::{FinEdges, PatchMesh, Surface};

use crate::tile_frame::TileFrames;

/// A patch vertex.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct TileVertex {
    /// The surface vertex under it.
    pub(crate) index: u32,
    /// Tile coordinates.
    pub(crate) tile: [f32; 2],
    /// The direction of the tile's *s* on the surface.
    pub(crate) tangent: u32,
    /// How much of the surface, in diameters, a tile takes there.
    pub(crate) tile_side: f32,
    /// The surface vertex in the middle of its patch.
    pub(crate) patch_vertex: u32,
}

/// Positions and normals.
pub(crate) fn skin(surface: &Surface) -> Vec<[u32; 4]> {
    surface.positions.iter().zip(&surface.normals).map(|(&position, &normal)| with_bits(position, octahedral(normal))).collect()
}

/// Offsets and hair directions.
pub(crate) fn fur(surface: &Surface) -> Vec<[u32; 4]> {
    surface.offsets.iter().zip(&surface.directions).map(|(&offset, &direction)| with_bits(offset, mean_direction(direction))).collect()
}

/// Colours, ends, bends and mixes as half floats, which keep the darks and take colours above 1.
pub(crate) fn looks(surface: &Surface) -> Vec<[u32; 4]> {
    let pair = |a: f32, b: f32| u32::from(half(a)) | u32::from(half(b)) << 16;
    let shapes = surface.bends.iter().zip(surface.ends.iter().zip(&surface.mixes));
    surface
        .colours
        .iter()
        .zip(shapes)
        .map(|(c, (b, (&end, &mix)))| [pair(c.x, c.y), pair(c.z, end), pair(b.x, b.y), pair(b.z, mix)])
        .collect()
}

/// Patch vertices.
pub(crate) fn tiles(surface: &Surface, patches: &PatchMesh) -> Vec<TileVertex> {
    let frames = TileFrames::of(surface, patches);
    let vertices = patches.vertices.iter().zip(&patches.coordinates).zip(frames.axes.iter().zip(&frames.middles));
    vertices
        .map(|((&index, tile), (axis, &patch_vertex))| TileVertex {
            index,
            tile: tile.to_array(),
            tangent: octahedral(*axis),
            tile_side: axis.length(),
            patch_vertex,
        })
        .collect()
}

/// Edges: ends and interval; first normal and curvature; second normal.
pub(crate) fn edges(edges: &FinEdges) -> Vec<[[u32; 4]; 3]> {
    (0..edges.vertices.len())
        .map(|e| {
            let ([a, b], [from, to], [n, m]) = (edges.vertices[e], edges.intervals[e], edges.face_normals[e]);
            [[a, b, from.to_bits(), to.to_bits()], with_bits(n, edges.curvatures[e].to_bits()), with_bits(m, 0)]
        })
        .collect()
}

fn with_bits(v: Vec3, bits: u32) -> [u32; 4] {
    [v.x.to_bits(), v.y.to_bits(), v.z.to_bits(), bits]
}

/// A direction as two signed 16-bit coordinates on an unfolded octahedron (Meyer et al. 2010); off by less than 1e-4. Zero becomes +z.
fn octahedral(direction: Vec3) -> u32 {
    let snorm = |x: f32| u32::from((x * 32767.0).round() as i16 as u16);
    let e = unfolded(direction);
    snorm(e.x) | snorm(e.y) << 16
}

/// A mean of directions, at most 1 long: 12 bits for each coordinate on the octahedron, 8 for the length. Off by less than 2e-3 in all.
fn mean_direction(direction: Vec3) -> u32 {
    let snorm = |x: f32| (x * 2047.0).round() as i32 as u32 & 0xfff;
    let length = direction.length();
    let length = if length.is_finite() { length.min(1.0) } else { 0.0 };
    let e = unfolded(direction);
    snorm(e.x) | snorm(e.y) << 12 | ((length * 255.0).round() as u32) << 24
}

/// A direction on the octahedron |x| + |y| + |z| = 1, its lower half unfolded to the square [−1, 1]².
fn unfolded(direction: Vec3) -> Vec2 {
    let size = direction.abs().element_sum();
    if !(size > 0.0 && size.is_finite()) {
        return Vec2::ZERO;
    }
    let d = direction / size;
    let upper = Vec2::new(d.x, d.y);
    let sign = |x: f32| if x >= 0.0 { 1.0 } else { -1.0 };
    let e = if d.z >= 0.0 { upper } else { Vec2::new((1.0 - d.y.abs()) * sign(d.x), (1.0 - d.x.abs()) * sign(d.y)) };
    e.clamp(Vec2::NEG_ONE, Vec2::ONE)
}

/// The nearest half float, ties to even; too large becomes the largest there is, NaN becomes 0.
pub(crate) fn half(value: f32) -> u16 {
    if value.is_nan() {
        return 0;
    }
    let sign = if value.is_sign_negative() { 0x8000 } else { 0 };
    let magnitude = value.abs().min(65504.0);
    // One unit in the last place of a half: 2^(exponent − 10), and 2^−24 below its normal range.
    let exponent = (((magnitude.to_bits() >> 23) as i32) - 127).max(-14);
    let steps = (magnitude * (2.0_f32).powi(10 - exponent)).round_ties_even() as u16;
    // A normal number has its leading step, 2^10, in the exponent field, where it adds one; so does rounding up to the next power.
    let bits = ((exponent + 14) as u16) << 10;
    sign | (bits + steps)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "a test says what it measured")]

    use super::*;

    fn unpack_half(bits: u16) -> f32 {
        let (sign, exponent, fraction) = (if bits >> 15 == 1 { -1.0 } else { 1.0 }, i32::from(bits >> 10 & 31), f32::from(bits & 1023));
        sign * if exponent == 0 { fraction * 2.0_f32.powi(-24) } else { (1.0 + fraction / 1024.0) * 2.0_f32.powi(exponent - 15) }
    }

    /// What folded of common.wgsl does.
    fn folded(e: Vec2) -> Vec3 {
        let z = 1.0 - e.x.abs() - e.y.abs();
        let fold = (-z).max(0.0);
        let shift = |x: f32| if x >= 0.0 { x - fold } else { x + fold };
        Vec3::new(shift(e.x), shift(e.y), z).normalize()
    }

    /// What unpack_direction does.
    fn unpack_direction(packed: u32) -> Vec3 {
        let snorm = |bits: u32| (f32::from(bits as u16 as i16) / 32767.0).max(-1.0);
        folded(Vec2::new(snorm(packed & 0xffff), snorm(packed >> 16)))
    }

    /// What unpack_mean_direction does.
    fn unpack_mean_direction(packed: u32) -> Vec3 {
        let snorm = |left: u32| (((packed << left) as i32 >> 20) as f32 / 2047.0).max(-1.0);
        folded(Vec2::new(snorm(20), snorm(8))) * ((packed >> 24) as f32 / 255.0)
    }

    #[test]
    fn every_half_comes_back() {
        for bits in (0..0x7c00).chain(0x8000..0xfc00) {
            assert_eq!(half(unpack_half(bits)), bits, "{bits:#x} {}", unpack_half(bits));
        }
    }

    #[test]
    fn halves_round_to_nearest_even_and_stay_finite() {
        assert_eq!(half(1.0 + 1.0 / 2048.0), half(1.0));
        assert_eq!(half(1.0 + 3.0 / 2048.0), half(1.0 + 2.0 / 1024.0));
        assert_eq!(half(0.1 * 2.0_f32.powi(-24)), 0);
        assert_eq!(half(f32::INFINITY), 0x7bff);
        assert_eq!(half(-1e30), 0xfbff);
        assert_eq!(half(f32::NAN), 0);
    }

    #[test]
    fn directions_come_back() {
        let axes = [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
        let spiral = (0..10_000).map(|i| {
            let (z, turn) = (1.0 - (i as f32 + 0.5) / 5000.0, i as f32 * 2.399_963);
            let ring = (1.0 - z * z).sqrt();
            Vec3::new(ring * turn.cos(), ring * turn.sin(), z)
        });
        let (mut most, mut most_mean) = (0.0_f32, 0.0_f32);
        for direction in axes.into_iter().chain(spiral) {
            let back = unpack_direction(octahedral(direction));
            assert!((back - direction).length() < 1e-4, "{direction} {back}");
            most = most.max((back - direction).length());
            for length in [0.0, 0.3, 0.77, 1.0] {
                let back = unpack_mean_direction(mean_direction(length * direction));
                assert!((back - length * direction).length() < 3e-3, "{length} {direction} {back}");
                most_mean = most_mean.max((back - length * direction).length());
            }
        }
        println!("reached: directions within {most:.0e}, mean directions of hair within {most_mean:.0e}");
        assert_eq!(unpack_mean_direction(mean_direction(Vec3::ZERO)), Vec3::ZERO);
        assert_eq!(unpack_mean_direction(mean_direction(Vec3::splat(f32::NAN))), Vec3::ZERO);
        assert_eq!(unpack_direction(octahedral(Vec3::ZERO)), Vec3::Z);
    }
}
