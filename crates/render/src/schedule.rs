//! Which shells are drawn, at which level of detail.

use bytemuck::{Pod, Zeroable};
use pelage_coat::ShellLayer;

use crate::{Detail, Options, Viewpoint};

/// Most shells of a coat: what fits into the uniform buffer.
pub(crate) const MOST_SHELLS: usize = 256;

/// The part of the way from one level to the next over which they blend; before it, a level is drawn as it is.
const BLEND_BAND: f32 = 0.5;

/// A shell as the shaders see it; mirrors `struct Shell` of common.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub(crate) struct Shell {
    pub(crate) height: f32,
    pub(crate) light_height: f32,
    pub(crate) image: u32,
    pub(crate) direction: u32,
    pub(crate) opacity: f32,
    pub(crate) layers: f32,
    pub(crate) step: f32,
    pub(crate) unused: f32,
}

/// Two levels that blend, image by image; mirrors `struct Slot` of blend.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub(crate) struct Slot {
    fine: u32,
    coarse: u32,
    fine_opacity: f32,
    fine_layers: f32,
    coarse_opacity: f32,
    coarse_layers: f32,
    blend: f32,
    unused: f32,
}

/// No coarser image: the shell fades out.
const NONE: u32 = u32::MAX;

/// What a frame draws of a coat's shells.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Schedule {
    /// All shells of the level, innermost first.
    pub(crate) shells: Vec<Shell>,
    /// Those of them that are drawn as shells, innermost first; never the first, which the surface shows.
    pub(crate) drawn: Vec<u32>,
    /// What is blended into the images that the shells show; empty where a level is drawn as it is.
    pub(crate) slots: Vec<Slot>,
    /// How far the blend has come: 0 to 1.
    pub(crate) blend: f32,
    /// The level, with the part of the way to the next.
    pub(crate) level: f32,
    /// What is left of the fins: with the last shell they go.
    pub(crate) fins: f32,
}

impl Schedule {
    /// The schedule for levels as [`pelage_coat::ShellTexture`] has them, for fur that is `length` long, in diameters.
    pub(crate) fn new(levels: &[Vec<ShellLayer>], options: &Options, viewpoint: &Viewpoint, length: f32) -> Self {
        let coarsest = levels.len().saturating_sub(1) as f32;
        let level = level(levels, options.detail, viewpoint, length);
        let (base, part) = (level.floor(), level.fract());
        let blend = smooth(((part - (1.0 - BLEND_BAND)) / BLEND_BAND).max(0.0));
        let Some(fine) = levels.get(base as usize) else { return Self::default() };
        let coarse = levels.get(base as usize + 1).map(Vec::as_slice).filter(|_| blend > 0.0);
        let stride = 1_u32 << (base as u32).min(16);
        let mut schedule = match coarse {
            Some(coarse) => Self::blended(fine, coarse, blend),
            None => Self { shells: fine.iter().map(|&layer| shell(layer)).collect(), ..Self::default() },
        };
        schedule.level = level;
        schedule.blend = blend;
        schedule.fins = if coarsest > 0.0 { (coarsest - level).min(1.0) } else { 1.0 };
        schedule.set_steps();
        if !schedule.slots.is_empty() {
            schedule.blend_steps(blend);
        }
        schedule.set_drawn(options, stride);
        schedule
    }

    fn blended(fine: &[ShellLayer], coarse: &[ShellLayer], blend: f32) -> Self {
        let mut schedule = Self::default();
        for (k, layer) in fine.iter().enumerate() {
            let into = if k % 2 == 0 { coarse.get(k / 2) } else { None };
            schedule.slots.push(Slot {
                fine: layer.image,
                coarse: into.map_or(NONE, |into| into.image),
                fine_opacity: layer.opacity,
                fine_layers: layer.layers,
                coarse_opacity: into.map_or(0.0, |into| into.opacity),
                coarse_layers: into.map_or(0.0, |into| into.layers),
                blend,
                unused: 0.0,
            });
            let light_height =
                layer.light_height + blend * (into.map_or(layer.light_height, |into| into.light_height) - layer.light_height);
            schedule.shells.push(Shell {
                image: k as u32,
                opacity: 1.0,
                layers: 1.0,
                light_height,
                direction: layer.image,
                ..shell(*layer)
            });
        }
        schedule
    }

    fn set_steps(&mut self) {
        for k in 0..self.shells.len() {
            let step = match (self.shells.get(k + 1), k.checked_sub(1)) {
                (Some(next), _) => next.height - self.shells[k].height,
                (None, Some(before)) => self.shells[k].height - self.shells[before].height,
                (None, None) => 0.0,
            };
            self.shells[k].step = step;
        }
    }

    /// Where two levels blend, the shells that stay come to look ahead as far as the next that stays: what follows from the step must not jump where the others
    /// are gone.
    fn blend_steps(&mut self, blend: f32) {
        let apart = |shells: &[Shell], k: usize| Some(shells.get(k + 2)?.height - shells[k].height);
        for k in (0..self.shells.len()).step_by(2) {
            let coarse = apart(&self.shells, k).or_else(|| apart(&self.shells, k.checked_sub(2)?));
            let step = self.shells[k].step;
            self.shells[k].step = step + blend * (coarse.unwrap_or(0.0) - step);
        }
    }

    /// Which are drawn: those asked for, and of those that march through several, the outermost of each.
    fn set_drawn(&mut self, options: &Options, stride: u32) {
        let count = self.shells.len() as u32;
        let marched = options.march.layers.max(1);
        let asked = |k: &u32| options.layers.contains(k * stride);
        self.drawn = (1..count).filter(asked).filter(|k| (count - 1 - k).is_multiple_of(marched)).collect();
    }

    /// How many shells there are for a unit of height.
    pub(crate) fn layers_per_height(&self) -> f32 {
        let top = self.shells.last().map_or(0.0, |shell| shell.height);
        if top > 0.0 { (self.shells.len() - 1) as f32 / top } else { 1.0 }
    }

    /// Whether a shell is more or less than its image.
    pub(crate) fn is_shared(&self) -> bool {
        self.shells.iter().any(|shell| shell.opacity != 1.0 || shell.layers != 1.0)
    }
}

fn shell(layer: ShellLayer) -> Shell {
    Shell {
        height: layer.height,
        light_height: layer.light_height,
        image: layer.image,
        direction: layer.image,
        opacity: layer.opacity,
        layers: layer.layers,
        step: 0.0,
        unused: 0.0,
    }
}

/// The level that is wanted for fur that is `length` long, of those that there are.
pub(crate) fn level(levels: &[Vec<ShellLayer>], detail: Detail, viewpoint: &Viewpoint, length: f32) -> f32 {
    let shells = levels.first().map_or(0, Vec::len);
    let wanted = match detail {
        Detail::Level(level) => level,
        Detail::Spacing(pixels) => level_for(shells, pixels, viewpoint.pixels_of(length)),
        Detail::Whole(pixels) => level_for(shells, pixels, viewpoint.pixels_of(length)).round(),
    };
    // NaN is no wish at all.
    wanted.max(0.0).min(levels.len().saturating_sub(1) as f32)
}

/// The level at which `shells` shells, spread over `length` pixels, are `spacing` pixels apart; below 0 if they are further already.
fn level_for(shells: usize, spacing: f32, length: f32) -> f32 {
    let steps = shells.saturating_sub(1) as f32;
    // Length 0 wants the coarsest; spacing 0 the finest.
    (spacing * steps / length.max(1e-6)).max(1e-6).log2()
}

/// From 0 to 1 with a slope of 0 at both ends.
fn smooth(t: f32) -> f32 {
    t * t * (3.0 - 2.0 * t)
}
