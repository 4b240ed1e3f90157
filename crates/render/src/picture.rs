//! What comes back.

use crate::{Fragments, PassTimes};

/// A finished picture and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// `4 * width * height` bytes: sRGB-encoded red, green, blue and an alpha of 255, row by row from the top.
    pub rgba: Vec<u8>,
    /// `width * height` bytes: how much of each pixel skin or fur covers, 0 to 255, linear.
    pub coverage: Vec<u8>,
    /// What was drawn.
    pub frame: FrameStats,
}

/// What a frame consisted of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameStats {
    /// Layers drawn as shells; the skin, layer 0, is not counted.
    pub shells_drawn: u32,
    /// Faces of which the shells are drawn, of the furred ones.
    pub faces_drawn: u32,
    /// Faces with fur.
    pub faces_furred: u32,
    /// Patches with a face among those drawn.
    pub patches_drawn: u32,
    /// All patches.
    pub patches: u32,
    /// The level of detail; 0 is the finest, each has half the shells of the one before, a fraction blends.
    pub level: f32,
    /// Fins with any opacity.
    pub fins_drawn: u32,
    /// Edges looked at for fins.
    pub fins_considered: u32,
    /// Triangles of skin, drawn fins and shells.
    pub triangles: u64,
    /// Samples that passed the tests, where they were counted.
    pub fragments: Option<Fragments>,
    /// Time on the graphics device, where it has timestamps.
    pub passes: Option<PassTimes>,
}
