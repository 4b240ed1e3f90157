//! The true picture of a coat.

use std::ops::ControlFlow;
use std::sync::Arc;

use pelage_coat::{Background, Coat, Lights};
use pelage_graph::{Colour, Context, Evaluate, Needs, Node, NodeError, Param, Params, Wanted};
use pelage_lighting::Shading;
use pelage_reference::{Counts, Image, Laying, Placement, Scene, Settings, Shadows, SkinColours, View};
use pelage_render::{FrameStats, Picture};
use pelage_strand::StrandTile;

use super::HairPlacement;
use crate::Framing;
use crate::parts::LOOKS;
use crate::shading::linear;

/// Where shadows within the coat come from.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum ShadowsBy {
    /// Depth, as in the renderer.
    Formula,
    /// Rays to each light.
    Rays,
}

impl From<&ShadowsBy> for Shadows {
    fn from(shadows: &ShadowsBy) -> Self {
        match shadows {
            ShadowsBy::Formula => Self::Formula,
            ShadowsBy::Rays => Self::Rays,
        }
    }
}

/// What a true picture took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayReport {
    /// What there was to meet.
    pub counts: Counts,
    /// Rays from the eye.
    pub camera_rays: u64,
    /// Rays towards lights.
    pub shadow_rays: u64,
}

/// The true picture: the real strands laid on the surface and ray cast, by which all drawing is judged. No shells, no fins, no textures; minutes, not
/// milliseconds.
#[derive(Node)]
#[node(category = "Picture", version = 2)]
#[output(image: Picture, "The picture.")]
#[output(rays: RayReport, "How much hair there was, and how many rays.")]
pub struct ReferenceImage {
    /// The coat.
    #[input]
    pub fur: Arc<Coat>,
    /// The hair that its textures were sampled from.
    #[input]
    pub strands: Arc<StrandTile>,
    /// From where.
    #[input]
    pub camera: Arc<Framing>,
    /// In what light.
    #[input]
    pub light: Arc<Lights>,
    /// How hair answers it.
    #[input]
    pub shading: Arc<Shading>,
    /// Width and height.
    #[param(default = (960, 720), range = 1..=16384, unit = "pixels", effect = "rays go with the area")]
    pub size: (u32, u32),
    /// Rays from the eye for each pixel.
    #[param(default = 16, range = 1..=65536, unit = "rays a pixel", effect = "more: less noise, by more than the root; time is linear in it")]
    pub samples: u32,
    /// Of where in the pixels they go.
    #[param(default = 1, unit = "seed", effect = "other noise")]
    pub seed: u64,
    /// Which hair there is.
    #[param(default = HairPlacement::Shell)]
    pub placement: HairPlacement,
    /// Where shadows within the coat come from.
    #[param(default = ShadowsBy::Formula)]
    pub shadows: ShadowsBy,
    /// How far a hair may be from its true curve.
    #[param(default = 0.1, range = 0.0001..=1.0, unit = "radii of the hair", effect = "smaller: more segments, one over its root")]
    pub tolerance: f64,
    /// Multiplies the length of all fur.
    #[param(default = 1.0, range = 0.0..=100.0, unit = "ratio", effect = "0 is bald")]
    pub length_scale: f64,
    /// Colour of the skin under the hair; as `SampleShells` has it.
    #[param(default = Colour([0.366, 0.304, 0.26]))]
    pub skin_colour: Colour,
    /// The background at the top.
    #[param(default = Colour([0.82, 0.84, 0.86]))]
    pub background_top: Colour,
    /// The background at the bottom.
    #[param(default = Colour([0.62, 0.62, 0.63]))]
    pub background_bottom: Colour,
}

impl Evaluate for ReferenceImage {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let scene = Scene::new(&self.fur, &self.strands, &self.laying())?;
        let settings = Settings { size: self.size, samples: self.samples, seed: self.seed, shadows: Shadows::from(&self.shadows) };
        let told = |fraction: f64| {
            cx.progress(fraction);
            if cx.cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let image = scene.render(&self.view(), &settings, &told);
        // The engine has its own word for it.
        cx.stop_if_cancelled()?;
        let image = image?;
        let rays = RayReport { counts: scene.counts(), camera_rays: image.camera_rays, shadow_rays: image.shadow_rays };
        Ok(ReferenceImageOutputs { image: Some(Arc::new(self.picture(&image, &rays))), rays: Some(Arc::new(rays)) })
    }

    fn needs(_: &Wanted<'_>, _: &Params<'_>) -> Needs {
        // No textures: the hair is there itself. So settings of the textures are no part of the truth's key.
        Needs::all().parts("fur", [LOOKS])
    }
}

impl ReferenceImage {
    fn laying(&self) -> Laying {
        let under_fur = linear(self.skin_colour).as_dvec3();
        Laying {
            placement: Placement::from(&self.placement),
            length_scale: self.length_scale,
            tolerance: self.tolerance,
            skin: SkinColours::of(&self.strands, under_fur),
        }
    }

    fn view(&self) -> View {
        let aspect = self.size.0 as f32 / self.size.1.max(1) as f32;
        View { camera: self.camera.camera(self.fur.bounds(), aspect), lights: Lights::clone(&self.light), shading: *self.shading }
    }

    fn picture(&self, image: &Image, rays: &RayReport) -> Picture {
        let background = Background { top: linear(self.background_top), bottom: linear(self.background_bottom) };
        Picture {
            width: image.width,
            height: image.height,
            rgba: image.over(&background),
            coverage: image.coverage(),
            frame: FrameStats { triangles: rays.counts.triangles as u64, ..FrameStats::default() },
        }
    }
}
