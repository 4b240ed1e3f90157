//! What each hair is born with.

use glam::DVec3;
use libm::{cos, sin, sincos};
use std::f64::consts::TAU;

use crate::colour::{Tint, shaded};
use crate::noise::TileNoise;
use crate::seed::{Purpose, mix, signed, stream, unit};
use crate::settings::GrowSettings;
use crate::style::Style;
use crate::tile::Root;
use crate::vary::Places;

/// The numbers of one hair that stay the same while it grows.
#[derive(Clone, Copy)]
pub(crate) struct Traits {
    /// Length over that of the longest guard hair.
    pub(crate) length: f64,
    /// Of that, what its place in the tile and in its lock makes: what no fit to the height may take back.
    pub(crate) envelope: f64,
    /// Radius at the root, tile sides.
    pub(crate) radius: f64,
    /// Radius at the tip over that at the root.
    pub(crate) tip: f64,
    /// The way it wants to grow, unit.
    pub(crate) heading: DVec3,
    /// Sideways axis of its wave or helix at the root, unit, across the heading.
    pub(crate) side: DVec3,
    /// How far it bends, over how far hair does.
    pub(crate) bend: f64,
    /// Where in its wave it begins, radians.
    pub(crate) phase: f64,
    /// Where along it wool turns round.
    pub(crate) reversal: f64,
    /// Which way a helix turns, ±1.
    pub(crate) hand: f64,
    /// Where it reads the noise that is its own.
    pub(crate) own_noise: f64,
    /// How far it follows its lock, over how far any does.
    pub(crate) loyalty: f64,
    pub(crate) undercoat: bool,
    pub(crate) root_colour: [f32; 3],
    pub(crate) tip_colour: [f32; 3],
    pub(crate) tint: Tint,
}

/// Linear RGB of a white hair, before it is shaded.
const WHITE: [f32; 3] = [0.8, 0.79, 0.76];
/// No hair leans further, whatever bends it, in degrees.
const STEEPEST: f64 = 85.0;

/// Draws the traits of strand `index`, standing at `root`.
pub(crate) fn draw(settings: &GrowSettings, places: &Places, index: usize, root: Root) -> Traits {
    let undercoat = index >= settings.count as usize;
    // Guard hairs keep their traits when only the number of either population changes.
    let number = if undercoat { (1u64 << 32) | (index - settings.count as usize) as u64 } else { index as u64 };
    let [x, y] = root.fraction.map(f64::from);
    let here = places.at(x, y);
    let mut random = stream(settings.seed, Purpose::Traits, number);
    let u = unit(&mut random);
    // Squared, so that most hairs come near the longest.
    let mut length = (1.0 - settings.length_variation * u * u) * here.length;
    let mut radius = settings.thickness * (1.0 + settings.thickness_variation * signed(&mut random)) * here.thickness;
    let tilt = [unit(&mut random), unit(&mut random)];
    let azimuth = TAU * unit(&mut random);
    let hand = if unit(&mut random) < 0.5 { -1.0 } else { 1.0 };
    let phase = phase(settings, x, y, unit(&mut random));
    let own_noise = unit(&mut random) * 1024.0;
    let shade = (1.0 + settings.colour_variation * signed(&mut random)) * here.colour;
    // What came later is drawn last, so that hair without it has the bits that it had.
    let tip = (settings.tip_thickness * (1.0 + settings.tip_variation * signed(&mut random)) * here.tip).clamp(0.0, 1.0);
    let bend = (1.0 + settings.bend_variation * signed(&mut random)) * here.bend;
    let is_white = unit(&mut random) < settings.white;
    let opaque = 1.0 - settings.opacity.variation * unit(&mut random);
    let reversal = 0.3 + 0.4 * unit(&mut random);
    let loyalty = unit(&mut random);
    let heading = heading(settings, settings.lean * bend, tilt);
    let envelope = here.length;
    if undercoat {
        length *= settings.undercoat.length;
        radius *= settings.undercoat.thickness;
    }
    let bands = !undercoat && !is_white && !settings.bands.is_empty();
    let [root_colour, tip_colour] = colours(settings, undercoat, is_white).map(|colour| shaded(colour, shade as f32));
    Traits {
        length,
        envelope,
        radius,
        tip,
        heading,
        side: any_across(heading, azimuth),
        bend,
        phase,
        reversal,
        hand,
        own_noise,
        loyalty: 1.0 - loyalty * loyalty,
        undercoat,
        root_colour,
        tip_colour,
        tint: Tint {
            bands: if bands { 0 } else { u32::MAX },
            shade: shade as f32,
            opacity: [settings.opacity.root, settings.opacity.tip].map(|opacity| (opacity * opaque) as f32),
        },
    }
}

/// Where in its wave a hair begins.
fn phase(settings: &GrowSettings, x: f64, y: f64, own: f64) -> f64 {
    if matches!(settings.style, Style::Woolly { .. }) {
        return TAU * own;
    }
    // Neighbours wave nearly in step, as combed hair does.
    let together = TileNoise::new(mix(settings.seed ^ Purpose::LockNoise as u64), 3);
    TAU * (together.value(x, y, 0.5) + 0.4 * own)
}

/// At the root and at the tip.
fn colours(settings: &GrowSettings, undercoat: bool, is_white: bool) -> [[f32; 3]; 2] {
    match (is_white, undercoat, settings.bands.is_empty()) {
        (true, ..) => [WHITE; 2],
        (_, true, _) => undercoat_colours(settings),
        (_, _, true) => [settings.root_colour, settings.tip_colour],
        (_, _, false) => [settings.bands.at(0.0), settings.bands.at(1.0)],
    }
}

/// The common lean, tilted by a random angle up to `splay` (uniform over the cap's small disc).
fn heading(settings: &GrowSettings, lean: f64, [u, v]: [f64; 2]) -> DVec3 {
    let lean = lean.min(STEEPEST).to_radians();
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
