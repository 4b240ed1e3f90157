//! From where, in what light, and which parts of the coat.

use glam::{Mat4, Vec2, Vec3, Vec4};
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
        // Of no pixels nothing is drawn, and no number comes of dividing by them.
        let pixels = Vec2::new(width.max(1) as f32, height.max(1) as f32);
        Self { clip_from_coat: camera.view_projection(pixels.x / pixels.y), eye: camera.eye, toward_eye: camera.toward_eye(), pixels }
    }

    /// A coat placed in a world of the caller's: `clip_from_world` is their projection and view, `eye` is where they look from, `world_from_coat` the
    /// model matrix. Viewer at infinity is who looks from there at the coat's origin. Lights are the caller's to carry over. A model matrix that mirrors turns fronts
    /// into backs: mirror the mesh instead.
    pub fn placed(clip_from_world: Mat4, eye: Vec3, world_from_coat: Mat4, (width, height): (u32, u32)) -> Self {
        let eye = world_from_coat.inverse().transform_point3(eye);
        // Of no pixels nothing is drawn, and no number comes of dividing by them.
        let pixels = Vec2::new(width.max(1) as f32, height.max(1) as f32);
        Self { clip_from_coat: clip_from_world * world_from_coat, eye, toward_eye: eye.normalize_or_zero(), pixels }
    }

    /// How many pixels high a length, in diameters, is at the coat's centre, seen squarely.
    pub fn pixels_of(&self, length: f32) -> f32 {
        let centre = self.clip_from_coat * Vec4::W;
        let rows = [self.clip_from_coat.row(0).truncate(), self.clip_from_coat.row(1).truncate()];
        let scale = (rows[0].length() * self.pixels.x).max(rows[1].length() * self.pixels.y);
        // At the eye or behind it everything is as near as can be.
        0.5 * length * scale / centre.w.max(1e-6)
    }
}

/// Where the hair lighting is evaluated for the first light; the formula is the same. Further lights are evaluated at vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightingMode {
    /// Once for each patch and shell, at the vertex in its middle: the patches show.
    PerPatch,
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
    /// No blending: opacity is the share of a pixel's samples that are drawn (alpha to coverage), with depth, so that no order matters. Which samples is random,
    /// but the same each time: grainy, the more so the fewer samples there are.
    Coverage {
        /// Opacity under which a pixel counts as empty and is left out; 0 to 1.
        threshold: f32,
    },
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
    /// Whether a layer of the finest level is drawn. The skin never is: the surface pass shows it.
    pub fn contains(&self, layer: u32) -> bool {
        layer >= self.first.max(1) && layer < self.end && self.left_out != Some(layer)
    }
}

/// At which level of detail shells are drawn (L16).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Detail {
    /// As coarse as leaves shells this many pixels apart, seen from the side; 0: the finest always.
    Spacing(f32),
    /// Likewise, but the nearest whole level: levels change at once. What a crowd does, of which a draw shows one level.
    Whole(f32),
    /// This level: 0 the finest, each the half of the one before; a fraction blends.
    Level(f32),
}

impl Default for Detail {
    fn default() -> Self {
        Self::Spacing(0.25)
    }
}

/// How far a shell's pixel looks into the fur (L26, N9).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct March {
    /// How many layers each drawn shell shows, where the ray of sight meets them; 1: its own, as the paper has it. A coat with levels of detail rounds it up to
    /// a power of two, and halves it from level to level.
    pub layers: u32,
    /// Samples of the volume for each layer; 1: the layers themselves, 2 and more: what lies between them, too. It marches through whole levels of detail: of
    /// [`Detail::Spacing`] the finest.
    pub steps: u32,
}

impl Default for March {
    fn default() -> Self {
        Self { layers: 1, steps: 1 }
    }
}

/// Shadows that skin and fur cast in the first light, on themselves and each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadowOptions {
    /// Texels along a side of the map; 16 to what the device has. Memory goes with its square: 14 bytes a texel.
    pub side: u32,
}

impl Default for ShadowOptions {
    fn default() -> Self {
        Self { side: 1024 }
    }
}

/// Which edges carry a fin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum FinRule {
    /// Those near the silhouette, faded in (the paper's).
    #[default]
    Faded,
    /// Silhouettes' edges, and those of which the eye direction is nearly along a face (NVIDIA's): whole or not at all.
    Silhouette {
        /// The cosine between eye direction and a face's normal below which an edge counts; 0 to 1.
        threshold: f32,
    },
    /// All, whole: what the paper shows to motivate its own (figure 4e).
    All,
}

/// Which parts of a coat are drawn, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The skin, and with it the innermost layer.
    pub surface: bool,
    /// The fins.
    pub fins: bool,
    /// Which of the fins.
    pub fin_rule: FinRule,
    /// Into how many quads a fin is cut on its way up, so that it bends with the hair (K11); 1 to 16. Vertices are linear in it.
    pub fin_segments: u32,
    /// The shells. Those that are not drawn cast their shadows all the same.
    pub shells: bool,
    /// Which of the shells.
    pub layers: ShellRange,
    /// At which level of detail.
    pub detail: Detail,
    /// How far a shell's pixel looks into the fur.
    pub march: March,
    /// Whether faces that cannot be seen are left out (K18). No picture changes by it.
    pub culling: bool,
    /// Whether [`crate::Offscreen`] also leaves out the shells of faces that the skin hides, which splits its pass in three: surface, fins, shells. In passes
    /// of your own two are enough: call [`crate::Renderer::find_hidden`] after the one that draws the surface.
    pub hidden: bool,
    /// Multiplies the length of all fur; 0 and up, 0 is bald.
    pub length_scale: f32,
    /// What shells do to the depth buffer.
    pub shell_depth: ShellDepth,
    /// The most levels of detail by which shells are blurred where a strand's places in one layer and the next lie more than a pixel apart on the
    /// screen, so that it does not fall into dots at a grazing angle; 0 (off) to 16. Costs nothing to speak of; too much washes hair out.
    pub step_blur: f32,
    /// Where lighting is evaluated.
    pub lighting: LightingMode,
    /// Whether lighting at pixels takes the hair's direction from the direction map, where the coat has one (L15); else it is interpolated.
    pub direction_map: bool,
    /// How strongly a hair shades the hair under it on the way to the first light (K10), 0 (off) to 1. Costs a second fetch.
    pub hair_shadow: f32,
    /// Shadows cast in the first light, by a map; without it only the self-shadow darkens fur, towards the skin.
    pub shadows: Option<ShadowOptions>,
    /// How many times finer than its short side a slanted footprint is filtered; 1 (off) to 16. Costs up to as many fetches, and by far the most of all
    /// options in software: the book's page of speed says how much.
    pub anisotropy: u16,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            surface: true,
            fins: true,
            fin_rule: FinRule::default(),
            fin_segments: 1,
            shells: true,
            layers: ShellRange::default(),
            detail: Detail::default(),
            march: March::default(),
            culling: true,
            hidden: false,
            length_scale: 1.0,
            shell_depth: ShellDepth::default(),
            step_blur: 1.5,
            lighting: LightingMode::default(),
            direction_map: true,
            hair_shadow: 0.0,
            shadows: None,
            anisotropy: 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_leave_out_the_skin_and_the_gap() {
        let drawn = |range: ShellRange, layers: u32| (0..layers).filter(|&k| range.contains(k)).collect::<Vec<u32>>();
        let all = ShellRange::default();
        assert_eq!(drawn(all, 5), [1, 2, 3, 4]);
        assert_eq!(drawn(ShellRange { left_out: Some(2), ..all }, 5), [1, 3, 4]);
        assert_eq!(drawn(ShellRange { first: 0, end: 3, left_out: Some(9) }, 5), [1, 2]);
        assert_eq!(drawn(ShellRange { first: 9, ..all }, 4), []);
        assert_eq!(drawn(all, 1), []);
    }

    #[test]
    fn a_placed_coat_is_seen_as_if_the_eye_had_moved() {
        let camera = Camera { eye: Vec3::new(0.5, 0.4, 2.0), target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.7, near: 0.01 };
        let own = Viewpoint::of(&camera, (64, 48));
        let placed = Mat4::from_translation(Vec3::new(3.0, -1.0, 2.0)) * Mat4::from_rotation_y(0.8) * Mat4::from_scale(Vec3::splat(2.5));
        let there = Viewpoint::placed(own.clip_from_coat * placed.inverse(), placed.transform_point3(camera.eye), placed, (64, 48));
        assert!(there.eye.abs_diff_eq(own.eye, 1e-5) && there.toward_eye.abs_diff_eq(own.toward_eye, 1e-5));
        assert!(there.clip_from_coat.abs_diff_eq(own.clip_from_coat, 1e-4) && there.pixels == own.pixels);
    }

    #[test]
    fn lengths_in_pixels_shrink_with_distance() {
        let seen = |distance: f32| {
            let eye = distance * Vec3::Z;
            let camera = Camera { eye, target: eye - Vec3::Z, up: Vec3::Y, field_of_view: 1.0, near: 0.01 };
            Viewpoint::of(&camera, (640, 480)).pixels_of(0.1)
        };
        assert!((seen(2.0) - 240.0 * 0.1 / (2.0 * 0.5_f32.tan())).abs() < 1e-3);
        assert!((seen(4.0) - 0.5 * seen(2.0)).abs() < 1e-3);
        assert!(seen(0.0).is_finite());
    }
}
