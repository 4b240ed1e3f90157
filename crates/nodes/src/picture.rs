//! Drawing: the one node that needs a graphics device.

use std::sync::Arc;

use pelage_coat::{Background, Coat, Lights};
use pelage_graph::{Colour, Context, Evaluate, Needs, Node, NodeError, Param, Params, Wanted};
use pelage_lighting::{Axis, Shading, TableLayout};
use pelage_render::{
    AdapterSummary, Detail, FinRule, FrameStats, FrameTimes, Headless, LightingMode, March, Offscreen, Options, Picture, ShadowOptions,
    ShellDepth, ShellRange, View,
};

use crate::reads::drawn_parts;
use crate::shading::linear;
use crate::{Framing, Quality};

/// The graphics device that all pictures of a run are drawn on.
#[derive(Debug)]
pub struct Gpu(Headless);

impl Gpu {
    /// The best adapter there is.
    ///
    /// # Errors
    /// `RenderError::NoAdapter`, which says what to install, or an adapter that gives no device.
    pub fn new() -> Result<Self, NodeError> {
        Ok(Self(Headless::new()?))
    }

    /// The device.
    pub fn headless(&self) -> &Headless {
        &self.0
    }

    /// Name and backend, as part of the key of what was drawn.
    pub fn description(&self) -> String {
        let adapter = self.0.summary();
        format!("{} ({})", adapter.name, adapter.backend)
    }
}

/// How a picture came about.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameReport {
    /// Which adapter drew it.
    pub adapter: AdapterSummary,
    /// Width and height, in pixels.
    pub size: (u32, u32),
    /// Samples a pixel.
    pub samples: u32,
    /// From where, in what light, which parts of the coat and how.
    pub view: View,
    /// Over what.
    pub background: Background,
    /// What was drawn.
    pub stats: FrameStats,
    /// How long a frame takes, if it was to be measured.
    pub times: Option<FrameTimes>,
}

/// What shells do to the depth buffer (N8).
#[derive(Clone, Debug, PartialEq, Param)]
pub enum DepthMode {
    /// Written where there is hair, as in the paper.
    Written,
    /// Only tested, as in NVIDIA's sample.
    Tested,
    /// Written, without blending: opacity is the share of a pixel's samples (alpha to coverage), so that no order matters. Grainy; wants 4 samples.
    Coverage,
}

/// Which edges carry a fin (L11, N1).
#[derive(Clone, Debug, PartialEq, Param)]
pub enum FinsOn {
    /// Those near the silhouette, faded in, as in the paper.
    Faded,
    /// Silhouettes' edges and those nearly so, whole, as in NVIDIA's sample.
    Silhouettes {
        /// The cosine between the direction to the eye and a face's normal below which an edge counts.
        #[param(default = 0.2, range = 0.0..=1.0, unit = "cosine", effect = "more fins, further inside the silhouette")]
        threshold: f64,
    },
    /// All edges, whole.
    All,
}

impl From<&FinsOn> for FinRule {
    fn from(fins: &FinsOn) -> Self {
        match *fins {
            FinsOn::Faded => Self::Faded,
            FinsOn::Silhouettes { threshold } => Self::Silhouette { threshold: threshold as f32 },
            FinsOn::All => Self::All,
        }
    }
}

/// At which level of detail shells are drawn (L16).
#[derive(Clone, Debug, PartialEq, Param)]
pub enum ShellDetail {
    /// As coarse as leaves shells this far apart on the screen, seen from the side.
    Spacing {
        /// Between two shells.
        #[param(default = 0.25, range = 0.0..=64.0, unit = "pixels", effect = "larger: fewer shells in the distance; 0: all of them always")]
        pixels: f64,
    },
    /// Always the same.
    Level {
        /// 0 is the finest, each has half the shells of the one before, a fraction blends.
        #[param(default = 0.0, range = 0.0..=8.0, unit = "levels", effect = "each level halves the shells, and the fragments with them")]
        level: f64,
    },
}

impl From<&ShellDetail> for Detail {
    fn from(detail: &ShellDetail) -> Self {
        match *detail {
            ShellDetail::Spacing { pixels } => Self::Spacing(pixels as f32),
            ShellDetail::Level { level } => Self::Level(level as f32),
        }
    }
}

/// Where hair lighting is evaluated.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum LightingAt {
    /// Once for each patch and shell: the patches show.
    Patches,
    /// At the shells' vertices: cheapest, and highlights smear over large faces.
    Vertices,
    /// At every pixel, by the formula.
    Pixels,
    /// At every pixel, from a table (L13).
    Table {
        /// Entries along a side.
        #[param(default = 64, range = 2..=1024, unit = "entries", effect = "more: a truer highlight; at 64 it errs by 0.008 of the light at an exponent of 64")]
        size: u32,
        /// How the angle between hair and light runs along it.
        #[param(default = TableAxis::Angle)]
        diffuse_by: TableAxis,
        /// How the angle between hair and the half vector runs along it. The paper's table is 32 entries by the cosine both ways, and errs by 0.091.
        #[param(default = TableAxis::Cosine)]
        specular_by: TableAxis,
    },
}

impl From<&LightingAt> for LightingMode {
    fn from(lighting: &LightingAt) -> Self {
        match lighting {
            LightingAt::Patches => Self::PerPatch,
            LightingAt::Vertices => Self::PerVertex,
            LightingAt::Pixels => Self::Formula,
            LightingAt::Table { size, diffuse_by, specular_by } => {
                Self::Table(TableLayout { size: *size as usize, u: diffuse_by.into(), v: specular_by.into() })
            }
        }
    }
}

/// What runs evenly along an axis of the lighting table.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum TableAxis {
    /// The angle's cosine.
    Cosine,
    /// The angle itself.
    Angle,
}

impl From<&TableAxis> for Axis {
    fn from(axis: &TableAxis) -> Self {
        match axis {
            TableAxis::Cosine => Self::Cosine,
            TableAxis::Angle => Self::Angle,
        }
    }
}

/// Draws a coat: surface, fins and shells (L10, L11, L12).
#[derive(Node)]
#[node(category = "Picture", version = 1, context("adapter"))]
#[output(image: Picture, "The picture.")]
#[output(frame: FrameReport, "What was drawn, on what, and how long it took.")]
pub struct RenderImage {
    /// The coat.
    #[input]
    pub fur: Arc<Coat>,
    /// From where.
    #[input]
    pub camera: Arc<Framing>,
    /// In what light.
    #[input]
    pub light: Arc<Lights>,
    /// How hair answers it.
    #[input]
    pub shading: Arc<Shading>,
    /// How to draw, before what the parameters here say of it.
    #[input]
    pub budget: Option<Arc<Quality>>,
    /// Width and height.
    #[param(default = (960, 720), range = 1..=16384, unit = "pixels", effect = "fragments go with the area")]
    pub size: (u32, u32),
    /// Whether the skin is drawn.
    #[param(default = true)]
    pub surface: bool,
    /// Whether shells are drawn.
    #[param(default = true)]
    pub shells: bool,
    /// Whether fins are drawn.
    #[param(default = true)]
    pub fins: bool,
    /// Which edges carry a fin.
    #[param(default = FinsOn::Faded)]
    pub fins_on: FinsOn,
    /// Into how many quads a fin is cut, so that it bends with the hair (K11).
    #[param(default = 1, range = 1..=16, unit = "quads", effect = "more: rounder fins where the coat bends; vertices are linear in it")]
    pub fin_segments: u32,
    /// How many of the shells to draw, from the skin.
    #[param(default = 256, range = 1..=256, unit = "shells", effect = "fewer than there are cuts the tips off")]
    pub shell_count: u32,
    /// At which level of detail, where the shells have several.
    #[param(default = ShellDetail::Spacing { pixels: 0.25 })]
    pub detail: ShellDetail,
    /// Layers that each drawn shell shows, where the ray of sight meets them (L26, N9).
    #[param(default = 1, range = 1..=256, unit = "layers", effect = "more: fewer shells to blend, with as many fetches; silhouettes suffer. With levels of detail rounded up to a power of two")]
    pub march: u32,
    /// Samples of the volume for each layer, where shells show several or this is over 1.
    #[param(default = 1, range = 1..=16, unit = "samples", effect = "more: smoother at a slant; fetches go with twice that")]
    pub march_steps: u32,
    /// Whether faces that cannot be seen are left out (K18).
    #[param(default = true)]
    pub culling: bool,
    /// Whether faces that the skin hides are left out, too.
    #[param(default = false)]
    pub hidden: bool,
    /// Multiplies the length of all fur.
    #[param(default = 1.0, range = 0.0..=100.0, unit = "ratio", effect = "0 is bald")]
    pub length_scale: f64,
    /// What shells do to the depth buffer.
    #[param(default = DepthMode::Written)]
    pub depth: DepthMode,
    /// Where lighting is evaluated.
    #[param(default = LightingAt::Vertices)]
    pub lighting: LightingAt,
    /// Whether lighting at pixels takes the hair's direction from the direction map, where the shells have one (L15).
    #[param(default = true)]
    pub direction_map: bool,
    /// How strongly a hair shades the hair under it on the way to the first light (K10).
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "larger: hairs stand out from each other; over 0 costs a second fetch")]
    pub hair_shadow: f64,
    /// Whether skin and fur cast shadows in the first light, by a map.
    #[param(default = false)]
    pub shadows: bool,
    /// Texels along a side of the shadow map.
    #[param(default = 1024, range = 16..=16384, unit = "texels", effect = "more: finer shadows; memory and fragments go with its square")]
    pub shadow_size: u32,
    /// Samples a pixel: 1, or 4 for smooth edges; no others are the same on every adapter, and 2 and 3 are refused.
    #[param(default = 4, range = 1..=4, unit = "samples", effect = "4: smooth edges; on an adapter in software a frame takes about twice the time")]
    pub samples: u32,
    /// How much finer than its short side a slanted footprint of the texture is filtered.
    #[param(default = 1, range = 1..=16, unit = "ratio", effect = "more: crisper at a slant, up to as many fetches")]
    pub anisotropy: u32,
    /// The most by which shells are blurred where a strand would fall into dots between one layer and the next.
    #[param(default = 1.5, range = 0.0..=16.0, unit = "levels of detail", effect = "0: crisp, with stripes at a slant; large: washed out")]
    pub step_blur: f64,
    /// The background at the top.
    #[param(default = Colour([0.82, 0.84, 0.86]))]
    pub background_top: Colour,
    /// The background at the bottom.
    #[param(default = Colour([0.62, 0.62, 0.63]))]
    pub background_bottom: Colour,
    /// Draw the frame this many more times, to measure it.
    #[param(default = 0, range = 0..=100000, unit = "frames", effect = "no other picture; time is linear in it")]
    pub repeat: u32,
}

impl Evaluate for RenderImage {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let gpu = cx.resource::<Gpu>()?;
        let background = Background { top: linear(self.background_top), bottom: linear(self.background_bottom) };
        let offscreen = Offscreen::new(gpu.headless(), self.size, self.samples)?;
        let (coat, mut view) = (offscreen.upload(&self.fur)?, self.view());
        if let Some(budget) = &self.budget {
            budget.apply(&mut view.options);
        }
        let picture = offscreen.render(&coat, &view, &background)?;
        if let Some(budget) = self.budget.as_ref().filter(|_| self.shells) {
            budget.check(picture.frame.shells_drawn)?;
        }
        let measured = cx.wants("frame") && self.repeat > 0;
        let times = if measured { Some(offscreen.time(&coat, &view, &background, self.repeat)?) } else { None };
        let adapter = gpu.headless().summary().clone();
        let frame = FrameReport { adapter, size: self.size, samples: self.samples, view, background, stats: picture.frame, times };
        Ok(RenderImageOutputs { image: Some(Arc::new(picture)), frame: Some(Arc::new(frame)) })
    }

    fn needs(_: &Wanted<'_>, params: &Params<'_>) -> Needs {
        Needs::all().parts("fur", drawn_parts(params))
    }
}

impl RenderImage {
    fn view(&self) -> View {
        let aspect = self.size.0 as f32 / self.size.1.max(1) as f32;
        View {
            camera: self.camera.camera(self.fur.bounds(), aspect),
            lights: Lights::clone(&self.light),
            shading: *self.shading,
            options: Options {
                surface: self.surface,
                fins: self.fins,
                shells: self.shells,
                layers: ShellRange { end: self.shell_count, ..ShellRange::default() },
                length_scale: self.length_scale as f32,
                shell_depth: match self.depth {
                    DepthMode::Written => ShellDepth::default(),
                    DepthMode::Tested => ShellDepth::Tested,
                    DepthMode::Coverage => ShellDepth::Coverage { threshold: 0.02 },
                },
                lighting: LightingMode::from(&self.lighting),
                anisotropy: self.anisotropy as u16,
                step_blur: self.step_blur as f32,
                fin_rule: FinRule::from(&self.fins_on),
                fin_segments: self.fin_segments,
                detail: Detail::from(&self.detail),
                march: March { layers: self.march, steps: self.march_steps },
                culling: self.culling,
                hidden: self.hidden,
                direction_map: self.direction_map,
                hair_shadow: self.hair_shadow as f32,
                shadows: self.shadows.then_some(ShadowOptions { side: self.shadow_size }),
            },
        }
    }
}
