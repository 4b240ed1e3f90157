//! What light leaves a place of hair or skin.

use glam::{DVec3, Vec3};
use pelage_coat::Lights;
use pelage_lighting::{DirectionalLight, HairPoint, Illumination, Irradiance, SelfShadow, Shading};

use crate::{ReferenceError, Shadows};

/// The lights of a picture in `f64`, each also alone, so that a shadow takes it away.
#[derive(Clone, Debug)]
pub(crate) struct Lamps {
    shading: Shading,
    /// The same without self-shadow by depth.
    unshadowed: Shading,
    all: Illumination,
    ambient: Illumination,
    alone: Vec<Illumination>,
    shadows: Shadows,
}

/// A place that is lit.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lit {
    /// Of a hair, or skin under fur, where the mean hair has its direction.
    Hair(HairPoint),
    /// Of bare skin with this normal.
    Bare(DVec3),
}

impl Lamps {
    pub(crate) fn new(lights: &Lights, shading: &Shading, shadows: Shadows) -> Result<Self, ReferenceError> {
        let mut directional = Vec::with_capacity(lights.directional.len());
        for (number, light) in lights.directional.iter().enumerate() {
            let direction = light.direction.as_dvec3().try_normalize().filter(|_| light.colour.is_finite());
            let direction = direction.ok_or(ReferenceError::Light { light: number })?;
            directional.push(DirectionalLight { direction, colour: light.colour.as_dvec3() });
        }
        let ambient = Irradiance(lights.ambient.0.map(Vec3::as_dvec3));
        let alone = directional.iter().map(|&light| Illumination { lights: vec![light], ambient: Irradiance::default() }).collect();
        Ok(Self {
            shading: *shading,
            unshadowed: Shading { self_shadow: SelfShadow { density: 0.0, ..shading.self_shadow }, ..*shading },
            all: Illumination { lights: directional, ambient },
            ambient: Illumination { lights: Vec::new(), ambient },
            alone,
            shadows,
        })
    }

    /// The light of albedo 1 towards `view`. `is_blocked` says whether something stands between the place and a light; it is asked only where shadows are rays.
    pub(crate) fn light(&self, lit: &Lit, view: DVec3, mut is_blocked: impl FnMut(DVec3) -> bool) -> DVec3 {
        if self.shadows == Shadows::Formula {
            return answer(&self.shading, &self.all, view, lit);
        }
        let ambient = answer(&self.shading, &self.ambient, view, lit);
        self.all.lights.iter().zip(&self.alone).fold(ambient, |sum, (light, alone)| {
            let direct = answer(&self.unshadowed, alone, view, lit);
            // Nobody need look where no light comes back.
            if direct == DVec3::ZERO || is_blocked(light.direction) { sum } else { sum + direct }
        })
    }
}

fn answer(shading: &Shading, illumination: &Illumination, view: DVec3, lit: &Lit) -> DVec3 {
    match lit {
        Lit::Hair(point) => shading.shade(illumination, view, point),
        Lit::Bare(normal) => shading.skin(illumination, *normal),
    }
}
