//! The frame as the shaders see it; mirrors `struct Frame` of common.wgsl.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};
use pelage_lighting::{Axis, DIFFUSIVITY};

use crate::{LightingMode, RenderError, ShellDepth, View, Viewpoint};

/// Fur comes in over this length, in diameters: one spacing of the paper's layers. Below it, opacity and shadow fade, so that bare skin and fur
/// meet without a step.
pub(crate) const GROWTH_LENGTH: f32 = 1e-3;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct FrameUniform {
    clip_from_coat: [[f32; 4]; 4],
    eye: [f32; 4],
    toward_eye: [f32; 4],
    light: [f32; 4],
    light_colour: [f32; 4],
    irradiance: [[f32; 4]; 9],
    ambient: [f32; 4],
    diffuse: [f32; 4],
    specular: [f32; 4],
    shadow: [f32; 4],
    facing: [f32; 4],
    fur: [f32; 4],
    screen: [f32; 4],
    table: [f32; 4],
}

impl FrameUniform {
    /// Packs a view of a stack of `layers`.
    pub(crate) fn new(view: &View, viewpoint: &Viewpoint, layers: u32) -> Result<Self, RenderError> {
        let (hair, shadow, facing) = (&view.shading.hair, &view.shading.self_shadow, &view.shading.facing);
        let density = (shadow.density.max(0.0) as f32).min(1e30);
        let threshold = match view.options.shell_depth {
            ShellDepth::Written { threshold } => threshold,
            ShellDepth::Tested => 0.0,
        };
        let key = view.lights.directional.first();
        let uniform = Self {
            clip_from_coat: viewpoint.clip_from_coat.to_cols_array_2d(),
            eye: four(viewpoint.eye, 0.0),
            toward_eye: four(viewpoint.toward_eye, 0.0),
            light: four(key.map_or(Vec3::Y, |light| light.direction), 0.0),
            light_colour: four(key.map_or(Vec3::ZERO, |light| light.colour), 0.0),
            irradiance: view.lights.ambient.0.map(|term| four(term, 0.0)),
            ambient: colour(hair.ambient, 0.0),
            diffuse: colour(hair.diffuse, hair.diffuse_power),
            specular: colour(hair.specular, hair.specular_power),
            shadow: [density, shadow.minimum.clamp(0.0, 1.0) as f32, shadow.grazing.clamp(1e-6, 1.0) as f32, density * DIFFUSIVITY as f32],
            facing: [
                facing.strength.clamp(0.0, 1.0) as f32,
                facing.dark_below as f32,
                (1.0 / (facing.full_above - facing.dark_below).max(1e-9)) as f32,
                0.0,
            ],
            fur: [not_negative(view.options.length_scale), 1.0 / layers.saturating_sub(1).max(1) as f32, threshold, 1.0 / GROWTH_LENGTH],
            screen: [0.5 * viewpoint.pixels.x, 0.5 * viewpoint.pixels.y, view.options.step_blur.clamp(0.0, 16.0), 0.0],
            table: table(view.options.lighting),
        };
        uniform.check()?;
        Ok(uniform)
    }

    fn check(&self) -> Result<(), RenderError> {
        let finite = |values: &[[f32; 4]]| values.iter().flatten().all(|v| v.is_finite());
        let parts: [(&'static str, bool); 4] = [
            ("the camera", finite(&self.clip_from_coat) && finite(&[self.eye, self.toward_eye])),
            ("the light", finite(&[self.light, self.light_colour]) && finite(&self.irradiance)),
            ("the shading", finite(&[self.ambient, self.diffuse, self.specular, self.shadow, self.facing])),
            ("the length scale, the alpha threshold or the step blur", finite(&[self.fur, self.screen])),
        ];
        parts.iter().find(|(_, fine)| !fine).map_or(Ok(()), |&(what, _)| Err(RenderError::View { what }))
    }
}

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
