//! What each hair is born with.

use glam::DVec3;
use libm::{cos, sin, sincos};
use std::f64::consts::TAU;

use crate::noise::TileNoise;
use crate::seed::{Purpose, mix, signed, stream, unit};
use crate::settings::GrowSettings;
use crate::tile::Root;

/// The numbers of one hair that stay the same while it grows.
#[derive(Clone, Copy)]
pub(crate) struct Traits {
    /// Length over that of the longest guard hair.
    pub(crate) length: f64,
    /// Radius at the root, tile sides.
    pub(crate) radius: f64,
    /// The way it wants to grow, unit.
    pub(crate) heading: DVec3,
    /// Sideways axis of its wave or helix at the root, unit, across the heading.
    pub(crate) side: DVec3,
    /// Where in its wave it begins, radians.
    pub(crate) phase: f64,
    /// Which way a helix turns, ±1.
    pub(crate) hand: f64,
    /// Where it reads the noise that is its own.
    pub(crate) own_noise: f64,
    pub(crate) undercoat: bool,
    pub(crate) root_colour: [f32; 3],
    pub(crate) tip_colour: [f32; 3],
}

/// Draws the traits of strand `index`, standing at `root`.
pub(crate) fn draw(settings: &GrowSettings, index: usize, root: Root) -> Traits {
    let undercoat = index >= settings.count as usize;
    // Guard hairs keep their traits when only the number of either population changes.
    let number = if undercoat { (1u64 << 32) | (index - settings.count as usize) as u64 } else { index as u64 };
    let mut random = stream(settings.seed, Purpose::Traits, number);
    let u = unit(&mut random);
    // Squared, so that most hairs come near the longest.
    let mut length = 1.0 - settings.length_variation * u * u;
    let mut radius = settings.thickness * (1.0 + 0.15 * signed(&mut random));
    let heading = heading(settings, unit(&mut random), unit(&mut random));
    let azimuth = TAU * unit(&mut random);
    let hand = if unit(&mut random) < 0.5 { -1.0 } else { 1.0 };
    // Neighbours wave nearly in step, as combed hair does.
    let together = TileNoise::new(mix(settings.seed ^ Purpose::LockNoise as u64), 3);
    let [x, y] = root.fraction.map(f64::from);
    let phase = TAU * (together.value(x, y, 0.5) + 0.4 * unit(&mut random));
    let own_noise = unit(&mut random) * 1024.0;
    let shade = (1.0 + settings.colour_variation * signed(&mut random)) as f32;
    let mut colours = [settings.root_colour, settings.tip_colour];
    if undercoat {
        length *= settings.undercoat.length;
        radius *= settings.undercoat.thickness;
        colours = undercoat_colours(settings);
    }
    let [root_colour, tip_colour] = colours.map(|colour| colour.map(|c| (c * shade).clamp(0.0, 1.0)));
    let side = any_across(heading, azimuth);
    Traits { length, radius, heading, side, phase, hand, own_noise, undercoat, root_colour, tip_colour }
}

/// The common lean, tilted by a random angle up to `splay` (uniform over the cap's small disc).
fn heading(settings: &GrowSettings, u: f64, v: f64) -> DVec3 {
    let lean = settings.lean.to_radians();
    let common = DVec3::new(0.0, sin(lean), cos(lean));
    let tilt = settings.splay.to_radians() * u.sqrt();
    let across = any_across(common, TAU * v);
    let tilted = common * cos(tilt) + across * sin(tilt);
    // Never into the skin.
    DVec3::new(tilted.x, tilted.y, tilted.z.max(0.05)).normalize_or(DVec3::Z)
}

/// A unit vector across `axis`, turned by `azimuth` radians about it.
fn any_across(axis: DVec3, azimuth: f64) -> DVec3 {
    let first = axis.cross(DVec3::X).try_normalize().unwrap_or(DVec3::Y);
    let second = axis.cross(first);
    let (s, c) = sincos(azimuth);
    first * c + second * s
}

/// The down keeps the ratio of the guard hairs' root to their tip.
fn undercoat_colours(settings: &GrowSettings) -> [[f32; 3]; 2] {
    let luma = |c: [f32; 3]| 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    let tip = luma(settings.tip_colour);
    let ratio = if tip > 0.0 { (luma(settings.root_colour) / tip).min(1.0) } else { 1.0 };
    [settings.undercoat.colour.map(|c| c * ratio), settings.undercoat.colour]
}
