//! From where, in what light, and which parts of the coat.

use glam::{Mat4, Vec2, Vec3};
use pelage_coat::{Camera, Lights};
use pelage_lighting::{Shading, TableLayout};

/// Everything about a frame that is not the coat.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// From where.
    pub camera: Camera,
    /// In what light.
    pub lights: Lights,
    /// How hair takes it.
    pub shading: Shading,
    /// Which parts are drawn, and how.
    pub options: Options,
}

impl View {
    /// A view with default shading and options.
    pub fn new(camera: Camera, lights: Lights) -> Self {
        Self { camera, lights, shading: Shading::default(), options: Options::default() }
    }
}

/// The camera as the graphics processor needs it: for callers who have a projection of their own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// From coat coordinates to clip space, model matrix included.
    pub clip_from_coat: Mat4,
    /// The eye in coat coordinates; highlights are seen from here.
    pub eye: Vec3,
    /// The unit direction to the viewer at infinity, in coat coordinates; fins are faded by it (L11).
    pub toward_eye: Vec3,
    /// Width and height of what is drawn into, in pixels.
    pub pixels: Vec2,
}

impl Viewpoint {
    /// A camera's, for a picture of `width` × `height` pixels.
    pub fn of(camera: &Camera, (width, height): (u32, u32)) -> Self {
        let pixels = Vec2::new(width as f32, height as f32);
        Self { clip_from_coat: camera.view_projection(pixels.x / pixels.y), eye: camera.eye, toward_eye: camera.toward_eye(), pixels }
    }
}

/// Where the hair lighting is evaluated; the formula is the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightingMode {
    /// At the shells' vertices, interpolated over faces: cheapest; highlights smear over large faces.
    #[default]
    PerVertex,
    /// At every pixel, computed.
    Formula,
    /// At every pixel, the two factors from a table (the paper's way).
    Table(TableLayout),
}

/// What shells do to the depth buffer (N8).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShellDepth {
    /// Depth written where there is hair, as in the paper.
    Written {
        /// Opacity under which a pixel counts as empty and is left out; 0 to 1.
        threshold: f32,
    },
    /// Depth only tested, as in NVIDIA's sample: fur of a part behind may show through the fur of a part before it.
    Tested,
}

impl Default for ShellDepth {
    fn default() -> Self {
        Self::Written { threshold: 0.02 }
    }
}

/// Which layers are drawn as shells; the heights of the rest do not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShellRange {
    /// The innermost; 0 counts as 1, since the surface pass shows layer 0.
    pub first: u32,
    /// One beyond the outermost; past the last layer it means all.
    pub end: u32,
    /// A layer in between to leave out.
    pub left_out: Option<u32>,
}

impl Default for ShellRange {
    fn default() -> Self {
        Self { first: 1, end: u32::MAX, left_out: None }
    }
}

impl ShellRange {
    /// The layers of a stack of `layers` that are drawn, as at most two runs.
    pub fn runs(&self, layers: u32) -> [std::ops::Range<u32>; 2] {
        let (first, end) = (self.first.max(1), self.end.min(layers));
        let end = end.max(first);
        match self.left_out {
            Some(gap) if (first..end).contains(&gap) => [first..gap, gap + 1..end],
            _ => [first..end, end..end],
        }
    }
}

/// Which parts of a coat are drawn, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The skin, and with it the innermost layer.
    pub surface: bool,
    /// The fins.
    pub fins: bool,
    /// The shells.
    pub shells: bool,
    /// Which of the shells.
    pub layers: ShellRange,
    /// Multiplies the length of all fur; 0 and up, 0 is bald.
    pub length_scale: f32,
    /// What shells do to the depth buffer.
    pub shell_depth: ShellDepth,
    /// The most levels of detail by which shells are blurred where a strand's places in one layer and the next lie more than a pixel apart on the
    /// screen, so that it does not fall into dots at a grazing angle; 0 (off) to 16. Costs nothing to speak of; too much washes hair out.
    pub step_blur: f32,
    /// Where lighting is evaluated.
    pub lighting: LightingMode,
    /// How many times finer than its short side a slanted footprint is filtered; 1 (off) to 16. Costs up to as many fetches;
    /// with 4, lavapipe took 3.4 times as long for a frame of one sample a pixel, and with four samples 70 times.
    pub anisotropy: u16,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            surface: true,
            fins: true,
            shells: true,
            layers: ShellRange::default(),
            length_scale: 1.0,
            shell_depth: ShellDepth::default(),
            step_blur: 1.5,
            lighting: LightingMode::default(),
            anisotropy: 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_leave_out_the_skin_and_the_gap() {
        let all = ShellRange::default();
        assert_eq!(all.runs(16), [1..16, 16..16]);
        assert_eq!(ShellRange { left_out: Some(5), ..all }.runs(16), [1..5, 6..16]);
        assert_eq!(ShellRange { first: 0, end: 4, left_out: Some(9) }.runs(16), [1..4, 4..4]);
        assert_eq!(ShellRange { first: 9, ..all }.runs(4), [9..9, 9..9]);
        assert_eq!(all.runs(1), [1..1, 1..1]);
        assert_eq!(all.runs(0), [1..1, 1..1]);
    }
}
