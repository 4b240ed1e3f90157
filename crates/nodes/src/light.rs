//! Where light comes from.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Irradiance, Light, Lights};
use pelage_graph::{Colour, Context, Evaluate, FilePath, Node, NodeError};
use pelage_lighting::Environment;

use crate::shading::linear;

/// The light from above where none is asked for.
const SKY: Colour = Colour([0.62, 0.68, 0.78]);
/// The light from below where none is asked for.
const GROUND: Colour = Colour([0.45, 0.4, 0.36]);

/// A light at infinity and the light from all around; alone, or added to others.
#[derive(Node)]
#[node(category = "Picture", version = 1, name = "Light")]
#[output(light: Lights, "The lights so far: those it is added to, then this one. The first of all is the key light, at most 4 are drawn.")]
pub struct LightNode {
    /// Lights that this one is added to. They go first: the light at the start of a chain stays its key light.
    #[input]
    pub with: Option<Arc<Lights>>,
    /// Where it comes from, around the vertical axis, anticlockwise seen from above; 0 is the side a camera of azimuth 0 stands on.
    #[param(default = 40.0, range = -360.0..=360.0, unit = "degrees", effect = "none on cost")]
    pub azimuth: f64,
    /// Above the horizon.
    #[param(default = 45.0, range = -90.0..=90.0, unit = "degrees", effect = "none on cost")]
    pub elevation: f64,
    /// Its colour.
    #[param(default = Colour([1.0, 0.96, 0.9]))]
    pub colour: Colour,
    /// How bright it is.
    #[param(default = 2.2, range = 0.0..=100.0, unit = "times white", effect = "brighter; past white it clips")]
    pub strength: f64,
    /// The light from above. Without it, (0.62, 0.68, 0.78) where the light is alone, and none where it is added to others, which bring theirs.
    #[param]
    pub sky: Option<Colour>,
    /// The light from below. Without it, (0.45, 0.4, 0.36) where the light is alone, and none where it is added to others, which bring theirs.
    #[param]
    pub ground: Option<Colour>,
}

impl Evaluate for LightNode {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let (azimuth, elevation) = (self.azimuth.to_radians(), self.elevation.to_radians());
        let direction = DVec3::new(elevation.cos() * azimuth.sin(), elevation.sin(), elevation.cos() * azimuth.cos());
        let light = Light { direction: direction.as_vec3().normalize_or(Vec3::Y), colour: linear(self.colour) * self.strength as f32 };
        let ambient = Irradiance::hemisphere(self.around(self.sky, SKY), self.around(self.ground, GROUND));
        let lights = joined(self.with.as_deref(), &Lights { directional: vec![light], ambient });
        if lights.directional.len() > Lights::MOST {
            return Err(TooManyLights { count: lights.directional.len() }.into());
        }
        Ok(lights.into())
    }
}

impl LightNode {
    /// A colour of the light from all around: added to others it is none unless asked for, or each would bring the sky once more.
    fn around(&self, asked: Option<Colour>, alone: Colour) -> Vec3 {
        match (asked, &self.with) {
            (Some(colour), _) => linear(colour),
            (None, None) => linear(alone),
            (None, Some(_)) => Vec3::ZERO,
        }
    }
}

/// A chain of lights too long to draw.
#[derive(Debug, thiserror::Error)]
#[error(
    "this is light {count} of its chain, and at most {} are drawn; leave one out, or put it into the picture of an Environment",
    Lights::MOST
)]
struct TooManyLights {
    count: usize,
}

/// Light from all around, as a picture shows it; alone, or added to others.
///
/// To order 2 of the spherical harmonics (Ramamoorthi and Hanrahan 2001): it lights as a large soft source does, however small what shines in the picture,
/// and casts no shadow. The sun is better given as a Light.
#[derive(Node)]
#[node(category = "Picture", version = 1, name = "Environment")]
#[output(light: Lights, "The lights that it is added to, and the light from all around.")]
pub struct EnvironmentNode {
    /// Lights that it is added to.
    #[input]
    pub with: Option<Arc<Lights>>,
    /// A PNG or JPEG file, equirectangular: straight above at the top, and from left to right what one sees who turns clockwise on the spot. The middle is
    /// azimuth 0, a quarter from the left is azimuth 90.
    #[param]
    pub path: FilePath,
    /// How bright white of the picture is.
    #[param(default = 1.0, range = 0.0..=100.0, unit = "times white", effect = "brighter; past white it clips")]
    pub strength: f64,
    /// The picture turned about the vertical axis, anticlockwise seen from above: its middle comes to this azimuth.
    #[param(default = 0.0, range = -360.0..=360.0, unit = "degrees", effect = "none on cost")]
    pub turn: f64,
}

impl Evaluate for EnvironmentNode {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let path = self.path.as_path();
        let picture = image::open(path).map_err(|error| format!("{}: {error}", path.display()))?.into_rgb8();
        let light = environment(&picture)?.irradiance().turned(self.turn / 360.0 * TAU) * self.strength;
        let ambient = Irradiance(light.0.map(DVec3::as_vec3));
        Ok(joined(self.with.as_deref(), &Lights { directional: Vec::new(), ambient }).into())
    }
}

/// What an sRGB picture shows, as radiance.
fn environment(picture: &image::RgbImage) -> Result<Environment, NodeError> {
    let decoded: Vec<f32> = (0..=255).map(|byte| Colour([f64::from(byte) / 255.0; 3]).to_linear()[0] as f32).collect();
    let radiance = picture.pixels().map(|pixel| pixel.0.map(|byte| decoded[usize::from(byte)])).collect();
    Ok(Environment::new(picture.width() as usize, picture.height() as usize, radiance)?)
}

/// The lights of both, those before first.
fn joined(before: Option<&Lights>, lights: &Lights) -> Lights {
    let Some(before) = before else { return lights.clone() };
    let terms = std::array::from_fn(|k| before.ambient.0[k] + lights.ambient.0[k]);
    Lights { directional: [&before.directional[..], &lights.directional[..]].concat(), ambient: Irradiance(terms) }
}
