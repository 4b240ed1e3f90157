//! The frame as the shaders see it; mirrors `struct Frame` of common.wgsl.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};
use pelage_coat::Lights;
use pelage_lighting::{Axis, DIFFUSIVITY};

use crate::schedule::Schedule;
use crate::shadow::{LightView, shells_each};
use crate::textures::Mixtures;
use crate::{FinRule, LightingMode, RenderError, ShellDepth, View, Viewpoint};

/// Fur comes in over this length, in diameters: one spacing of the paper's layers. Below it, opacity and shadow fade, so that bare skin and fur
/// meet without a step.
pub(crate) const GROWTH_LENGTH: f32 = 1e-3;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct FrameUniform {
    clip_from_coat: [[f32; 4]; 4],
    eye: [f32; 4],
    toward_eye: [f32; 4],
    /// Direction and colour.
    lights: [[[f32; 4]; 2]; Lights::MOST],
    irradiance: [[f32; 4]; 9],
    ambient: [f32; 4],
    diffuse: [f32; 4],
    specular: [f32; 4],
    shadow: [f32; 4],
    facing: [f32; 4],
    fur: [f32; 4],
    screen: [f32; 4],
    table: [f32; 4],
    fins: [f32; 4],
    light_from_coat: [[f32; 4]; 4],
    mixes: [f32; 4],
    casting: [f32; 4],
}

impl FrameUniform {
    /// Packs a view; the schedule says which shells there are.
    pub(crate) fn new(
        view: &View,
        viewpoint: &Viewpoint,
        schedule: &Schedule,
        light: &LightView,
        mixtures: Mixtures,
    ) -> Result<Self, RenderError> {
        let (hair, shadow, facing) = (&view.shading.hair, &view.shading.self_shadow, &view.shading.facing);
        let (options, lights) = (&view.options, &view.lights.directional);
        if lights.len() > Lights::MOST {
            return Err(RenderError::Lights { found: lights.len(), limit: Lights::MOST });
        }
        let density = (shadow.density.max(0.0) as f32).min(1e30);
        let uniform = Self {
            clip_from_coat: viewpoint.clip_from_coat.to_cols_array_2d(),
            eye: four(viewpoint.eye, 0.0),
            toward_eye: four(viewpoint.toward_eye, schedule.blend),
            lights: std::array::from_fn(|i| lights.get(i).map_or([[0.0; 4]; 2], |l| [four(l.direction, 0.0), four(l.colour, 0.0)])),
            irradiance: view.lights.ambient.0.map(|term| four(term, 0.0)),
            ambient: four(hair.ambient.as_vec3(), 0.0),
            diffuse: colour(hair.diffuse, hair.diffuse_power),
            specular: colour(hair.specular, hair.specular_power),
            shadow: [density, shadow.minimum.clamp(0.0, 1.0) as f32, shadow.grazing.clamp(1e-6, 1.0) as f32, density * DIFFUSIVITY as f32],
            facing: [
                facing.strength.clamp(0.0, 1.0) as f32,
                facing.dark_below as f32,
                (1.0 / (facing.full_above - facing.dark_below).max(1e-9)) as f32,
                options.hair_shadow.clamp(0.0, 1.0),
            ],
            fur: [not_negative(options.length_scale), schedule.layers_per_height, threshold(options.shell_depth), 1.0 / GROWTH_LENGTH],
            screen: [
                0.5 * viewpoint.pixels.x,
                0.5 * viewpoint.pixels.y,
                options.step_blur.clamp(0.0, 16.0),
                options.march.steps.max(1) as f32,
            ],
            table: table(options.lighting),
            fins: fins(view, schedule.fins),
            light_from_coat: light.light_from_coat.to_cols_array_2d(),
            mixes: [mixtures.images as f32, mixtures.count.saturating_sub(1) as f32, 0.0, 0.0],
            casting: [light.length, shells_each(schedule), light.bias, schedule.marched as f32],
        };
        uniform.check()?;
        Ok(uniform)
    }

    fn check(&self) -> Result<(), RenderError> {
        let finite = |values: &[[f32; 4]]| values.iter().flatten().all(|v| v.is_finite());
        let parts: [(&'static str, bool); 5] = [
            ("the camera", finite(&self.clip_from_coat) && finite(&[self.eye, self.toward_eye])),
            ("the light", finite(self.lights.as_flattened()) && finite(&self.irradiance)),
            ("the shading", finite(&[self.ambient, self.diffuse, self.specular, self.shadow, self.facing])),
            ("the length scale, the alpha threshold or the step blur", finite(&[self.fur, self.screen])),
            ("the fins' threshold", finite(&[self.fins])),
        ];
        parts.iter().find(|(_, fine)| !fine).map_or(Ok(()), |&(what, _)| Err(RenderError::View { what }))
    }
}

/// Opacity under which a pixel is left out.
fn threshold(depth: ShellDepth) -> f32 {
    match depth {
        // Zero would divide by itself where opacity becomes coverage.
        ShellDepth::Coverage { threshold } => {
            if threshold < 1e-4 {
                1e-4
            } else {
                threshold
            }
        }
        ShellDepth::Written { threshold } => threshold,
        ShellDepth::Tested => 0.0,
    }
}

/// Rule, threshold, segments, opacity.
fn fins(view: &View, opacity: f32) -> [f32; 4] {
    let (rule, threshold) = match view.options.fin_rule {
        FinRule::Faded => (0.0, 0.0),
        FinRule::Silhouette { threshold } => (1.0, threshold),
        FinRule::All => (2.0, 0.0),
    };
    [rule, threshold, view.options.fin_segments.clamp(1, MOST_SEGMENTS) as f32, opacity]
}

/// Most quads of a fin.
pub(crate) const MOST_SEGMENTS: u32 = 16;

/// Unlike `max`, NaN stays NaN and is refused.
fn not_negative(x: f32) -> f32 {
    if x < 0.0 { 0.0 } else { x }
}

fn four(v: Vec3, w: f32) -> [f32; 4] {
    v.extend(w).to_array()
}

/// A colour and half of its power; f64 powers beyond f32 are as good as 1e30.
fn colour(c: DVec3, power: f64) -> [f32; 4] {
    four(c.as_vec3(), (0.5 * power.clamp(0.0, 1e30)) as f32)
}

fn table(lighting: LightingMode) -> [f32; 4] {
    let LightingMode::Table(layout) = lighting else { return [0.0; 4] };
    let size = layout.size as f32;
    let by_angle = |axis| if axis == Axis::Angle { 1.0 } else { 0.0 };
    // The first and the last texel's centres are at the ends.
    [(size - 1.0) / size, 0.5 / size, by_angle(layout.u), by_angle(layout.v)]
}
