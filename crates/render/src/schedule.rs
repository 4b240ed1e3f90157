//! Which shells are drawn, at which level of detail.

use bytemuck::{Pod, Zeroable};
use pelage_coat::ShellLayer;

use crate::{Detail, March, Options, Viewpoint};

/// Most shells of a coat: what fits into the uniform buffer.
pub(crate) const MOST_SHELLS: usize = 256;

/// The part of the way from one level to the next over which they blend; before it, a level is drawn as it is.
const BLEND_BAND: f32 = 0.5;

/// A shell as the shaders see it; mirrors `struct Shell` of common.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub(crate) struct Shell {
    pub(crate) height: f32,
    light_height: f32,
    step: f32,
    images: u32,
    above: u32,
    opacity: f32,
    layers: f32,
    later_opacity: f32,
    later_layers: f32,
    top: f32,
    top_light: f32,
    bottom: f32,
    bottom_light: f32,
    asked: f32,
    unused: [f32; 2],
}

/// Which shell shades another (K10), counted in the finest level's.
const SHADING_REACH: u32 = 2;

/// What a frame draws of a coat's shells.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Schedule {
    /// All shells of the level, innermost first.
    pub(crate) shells: Vec<Shell>,
    /// Those of them that are drawn as shells, innermost first; never the first, which the surface shows.
    pub(crate) drawn: Vec<u32>,
    /// How many layers each of them shows.
    pub(crate) marched: u32,
    /// How far the level has become the next: 0 to 1.
    pub(crate) blend: f32,
    /// Whether this is one of several levels.
    pub(crate) of_several: bool,
    /// How many shells there are for a unit of height.
    pub(crate) layers_per_height: f32,
    /// The level, with the part of the way to the next.
    pub(crate) level: f32,
    /// What is left of the fins: with the last shell they go.
    pub(crate) fins: f32,
}

impl Schedule {
    /// The schedule for levels as [`pelage_coat::ShellTexture`] has them, for fur that is `length` long, in diameters.
    pub(crate) fn new(levels: &[Vec<ShellLayer>], options: &Options, viewpoint: &Viewpoint, length: f32) -> Self {
        let coarsest = levels.len().saturating_sub(1) as f32;
        let level = level(levels, blendable(options), viewpoint, length);
        let (base, part) = (level.floor(), level.fract());
        let blend = smooth(((part - (1.0 - BLEND_BAND)) / BLEND_BAND).max(0.0));
        let Some(fine) = levels.get(base as usize) else { return Self::default() };
        let coarse = levels.get(base as usize + 1).map(Vec::as_slice).filter(|_| blend > 0.0);
        let stride = 1_u32 << (base as u32).min(16);
        let mut schedule = Self { level, blend, of_several: levels.len() > 1, ..Self::default() };
        schedule.shells = match coarse {
            Some(coarse) => blended(fine, coarse, blend),
            None => fine.iter().map(|&layer| shell(layer)).collect(),
        };
        let per_height = layers_per_height(fine);
        schedule.layers_per_height = per_height + blend * (coarse.map_or(per_height, layers_per_height) - per_height);
        schedule.fins = if coarsest > 0.0 { (coarsest - level).min(1.0) } else { 1.0 };
        schedule.set_steps();
        if blend > 0.0 {
            schedule.blend_steps(blend);
        }
        schedule.set_above(stride);
        schedule.marched = marched(options.march, levels, base as u32);
        schedule.set_drawn(options, stride);
        schedule.set_reach();
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

    /// Which shell shades which (K10): two of the finest level's shells further out, or the next where that is further; of a shell that stays while levels
    /// blend, also the one that will.
    fn set_above(&mut self, stride: u32) {
        let outermost = (self.shells.len() as u32).saturating_sub(1);
        let reach = |stride: u32| (SHADING_REACH / stride).max(1);
        let (fine, coarse) = (reach(stride), 2 * reach(2 * stride));
        for (k, shell) in (0..).zip(&mut self.shells) {
            let above = (k + fine).min(outermost);
            // Of the shells that stay, the outermost has none above.
            let later = if k + coarse <= outermost { k + coarse } else { outermost & !1 };
            shell.above = both(above, if k % 2 == 0 { later.max(k) } else { above });
        }
    }

    /// Which are drawn: those asked for, and of those that march through several, the outermost of each.
    fn set_drawn(&mut self, options: &Options, stride: u32) {
        let count = self.shells.len() as u32;
        let asked = |k: u32| options.layers.contains(k * stride);
        let carries = |k: &u32| (count - 1 - k).is_multiple_of(self.marched) && (self.lowest_of(*k)..k + 1).any(asked);
        self.drawn = (1..count).filter(carries).collect();
        // What is not asked for is there to be passed through.
        for (k, shell) in (0..).zip(&mut self.shells) {
            shell.asked = if asked(k) { 1.0 } else { 0.0 };
        }
    }

    /// The lowest layer that a drawn shell shows.
    fn lowest_of(&self, shell: u32) -> u32 {
        shell.saturating_sub(self.marched - 1).max(1)
    }

    /// Its height.
    pub(crate) fn lowest_shown(&self, shell: u32) -> f32 {
        self.shells[self.lowest_of(shell) as usize].height
    }

    /// From where down to where a drawn shell marches: its layers, and while levels blend, ever more those of them that stay, or the march would jump where
    /// the others are gone.
    fn set_reach(&mut self) {
        let blend = self.blend;
        let mixed = |a: f32, b: f32| a + blend * (b - a);
        for &outer in &self.drawn {
            let lowest = self.lowest_of(outer);
            let stays = |k: u32, towards: u32| self.shells[if k % 2 == 1 && lowest < outer { towards } else { k } as usize];
            let (top, bottom) = (self.shells[outer as usize], self.shells[lowest as usize]);
            let (last_top, last_bottom) = (stays(outer, outer - 1), stays(lowest, lowest + 1));
            let shell = &mut self.shells[outer as usize];
            shell.top = mixed(top.height, last_top.height);
            shell.top_light = mixed(top.light_height, last_top.light_height);
            shell.step = mixed(top.step, last_top.step);
            shell.bottom = mixed(bottom.height, last_bottom.height);
            shell.bottom_light = mixed(bottom.light_height, last_bottom.light_height);
        }
    }

    /// Whether a shell is more or less than its image.
    pub(crate) fn is_thickened(&self) -> bool {
        let plain = |shell: &Shell| shell.opacity == 1.0 && shell.layers == 1.0 && shell.later_layers == 1.0;
        // A shell that fades becomes nothing, which takes no thickening.
        !self.shells.iter().all(|shell| plain(shell) && (shell.later_opacity == 1.0 || shell.later_opacity == 0.0))
    }
}

/// How many layers a shell shows. From one level of detail to the next, half as many: as many shells are drawn, and stand where they stood. That takes a power of
/// two, to which a coat with levels rounds up.
fn marched(march: March, levels: &[Vec<ShellLayer>], base: u32) -> u32 {
    let layers = march.layers.clamp(1, MOST_SHELLS as u32);
    if levels.len() < 2 { layers } else { (layers.next_power_of_two() >> base.min(31)).max(1) }
}

/// How many shells there are for a unit of height.
fn layers_per_height(level: &[ShellLayer]) -> f32 {
    let top = level.last().map_or(0.0, |layer| layer.height);
    if top > 0.0 { (level.len() - 1) as f32 / top } else { 1.0 }
}

/// Two numbers in one word: of this level, and of the one it becomes.
fn both(now: u32, then: u32) -> u32 {
    now | then << 16
}

/// The shells of a level on its way to the next: every second one towards that of the other, the ones between towards nothing.
fn blended(fine: &[ShellLayer], coarse: &[ShellLayer], blend: f32) -> Vec<Shell> {
    let becoming = |(k, &layer): (usize, &ShellLayer)| match coarse.get(k / 2).filter(|_| k % 2 == 0) {
        Some(into) => {
            let light_height = layer.light_height + blend * (into.light_height - layer.light_height);
            Shell {
                images: both(layer.image, into.image),
                later_opacity: into.opacity,
                later_layers: into.layers,
                ..shell(ShellLayer { light_height, ..layer })
            }
        }
        None => Shell { later_opacity: 0.0, later_layers: 1.0, ..shell(layer) },
    };
    fine.iter().enumerate().map(becoming).collect()
}

fn shell(layer: ShellLayer) -> Shell {
    Shell {
        height: layer.height,
        light_height: layer.light_height,
        step: 0.0,
        images: both(layer.image, layer.image),
        above: 0,
        opacity: layer.opacity,
        layers: layer.layers,
        later_opacity: layer.opacity,
        later_layers: layer.layers,
        top: layer.height,
        top_light: layer.light_height,
        bottom: layer.height,
        bottom_light: layer.light_height,
        asked: 1.0,
        unused: [0.0; 2],
    }
}

/// The detail that a view can show: steps between layers know no layers that fade, so they march through whole levels, the finest where nothing else is asked.
fn blendable(options: &Options) -> Detail {
    match options.detail {
        detail if options.march.steps <= 1 => detail,
        Detail::Spacing(_) => Detail::Level(0.0),
        Detail::Level(level) => Detail::Level(level.round()),
        whole @ Detail::Whole(_) => whole,
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
