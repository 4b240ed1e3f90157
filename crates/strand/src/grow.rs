//! The particle simulation: hairs grow together, one particle each (L7).

use glam::DVec3;
use libm::cos;

use crate::colour::Opacity;
use crate::error::StrandError;
use crate::forces::{Forces, own_wander};
use crate::gather::{Gather, gather, shorten};
use crate::locks::nearest_locks;
use crate::roots::scatter;
use crate::seed::Purpose;
use crate::settings::GrowSettings;
use crate::style::Shape;
use crate::tile::{Root, StrandTile};
use crate::traits::{Traits, draw};
use crate::vary::Places;

/// Growths at most until the hair is as high as asked.
const FITS: u32 = 6;
/// How near to the asked height is near enough.
const FIT_TOLERANCE: f64 = 4e-3;
/// This part of the guard hairs stays below the asked height of itself; the rest is trimmed to it, so that the coat's outermost layer holds the tips of
/// many hairs and not of one.
const UNTRIMMED: f64 = 0.85;

/// Grows a tile of hair from blue-noise roots.
///
/// Zero strands are an empty tile of the asked height: bald skin, not an error.
///
/// # Errors
/// A setting outside its range, or more strands or points than a tile holds.
pub fn grow(settings: &GrowSettings) -> Result<StrandTile, StrandError> {
    settings.validate()?;
    let mut roots = scatter(settings.seed, Purpose::Roots, settings.count);
    roots.extend(scatter(settings.seed, Purpose::UndercoatRoots, settings.undercoat.count));
    Ok(Growth::new(settings, &roots).fitted())
}

/// Grows one hair from each given root; `count` and `undercoat.count` must add up to their number, guard hairs first.
///
/// # Errors
/// As [`grow`], and [`StrandError::OutOfRange`] where the numbers differ or a root's fraction is not in [0, 1).
pub fn grow_at(settings: &GrowSettings, roots: &[Root]) -> Result<StrandTile, StrandError> {
    settings.validate()?;
    let wanted = settings.strand_count() as f64;
    if roots.len() as u64 != settings.strand_count() {
        return Err(StrandError::OutOfRange { name: "roots", value: roots.len() as f64, low: wanted, high: wanted, unit: "roots" });
    }
    let outside = roots.iter().flat_map(|root| root.fraction).find(|c| !(0.0..1.0).contains(c));
    if let Some(value) = outside {
        return Err(StrandError::OutOfRange { name: "root fraction", value: f64::from(value), low: 0.0, high: 1.0, unit: "tile sides" });
    }
    Ok(Growth::new(settings, roots).fitted())
}

/// Where all particles are at one time; structure of arrays.
pub(crate) struct Particles {
    /// The way of growth that the wave or helix winds about, tile sides, unwrapped.
    pub(crate) guides: Vec<DVec3>,
    /// The hair itself.
    pub(crate) places: Vec<DVec3>,
    /// Unit vectors: which way each guide grows.
    pub(crate) headings: Vec<DVec3>,
    /// Unit vectors across the headings, carried along without twist.
    pub(crate) sides: Vec<DVec3>,
}

struct Growth<'a> {
    settings: &'a GrowSettings,
    roots: &'a [Root],
    traits: Vec<Traits>,
    own_wander: Vec<[f64; 2]>,
    /// For each strand the one in the middle of its lock; empty where nothing asks.
    locks: Vec<u32>,
    shape: Shape,
}

impl<'a> Growth<'a> {
    fn new(settings: &'a GrowSettings, roots: &'a [Root]) -> Self {
        let places = Places::new(settings.seed, settings.by_noise, settings.by_pattern);
        let mut traits: Vec<Traits> = roots.iter().enumerate().map(|(index, &root)| draw(settings, &places, index, root)).collect();
        let in_locks = settings.clump > 0.0 || settings.gather != Gather::Free;
        let locks = if in_locks { nearest_locks(settings.clump_size, roots) } else { Vec::new() };
        shorten(settings, roots, &locks, &mut traits);
        let own_wander = own_wander(settings, &traits);
        let shape = Shape::new(settings.style, settings.height, settings.seed);
        Self { settings, roots, traits, own_wander, locks, shape }
    }

    /// Forces bend hair down, so the lengths that reach the asked height are found by growing again.
    fn fitted(mut self) -> StrandTile {
        let height = self.settings.height;
        let mut length = height / cos(self.settings.lean.to_radians());
        let mut tile = self.run(length);
        for _ in 1..FITS {
            let tops = self.tops(&tile);
            let usual = height / self.usual_top(&tops).max(1e-12);
            let highest = tops.iter().fold(0.0, |a: f64, &b| a.max(b));
            if (usual - 1.0).abs() < FIT_TOLERANCE && (highest / height - 1.0).abs() < FIT_TOLERANCE {
                break;
            }
            length *= usual.clamp(0.25, 4.0);
            for (traits, top) in self.traits.iter_mut().zip(&tops) {
                traits.length *= (height / (top * usual).max(1e-12)).min(1.0);
            }
            tile = self.run(length);
        }
        tile
    }

    /// The height that [`UNTRIMMED`] of the guard hairs stay below (of all hairs where there are no guards).
    fn usual_top(&self, tops: &[f64]) -> f64 {
        let guards = if self.settings.count > 0 { self.settings.count as usize } else { tops.len() };
        let mut sorted: Vec<f64> = tops.iter().take(guards).copied().collect();
        sorted.sort_by(f64::total_cmp);
        let place = (sorted.len() as f64 * UNTRIMMED) as usize;
        let top = sorted.get(place.min(sorted.len().saturating_sub(1))).copied().unwrap_or(self.settings.height);
        // An undercoat alone is as short as it was asked to be.
        if self.settings.count > 0 { top } else { top / self.settings.undercoat.length }
    }

    /// One simulation from roots to tips; `length` is that of the longest hair's guide.
    fn run(&self, length: f64) -> StrandTile {
        let steps = self.settings.steps as usize;
        let count = self.roots.len();
        let mut particles = self.at_the_roots();
        let mut forces = Forces::new(self.settings, &self.traits, &self.own_wander, &self.locks, length);
        // Time after time, as the simulation goes; strand after strand is made of it below.
        let mut trail = Vec::with_capacity(count * (steps + 1));
        trail.extend_from_slice(&particles.places);
        for step in 0..steps {
            forces.turn(&mut particles, step);
            self.advance(&mut particles, length, step);
            trail.extend_from_slice(&particles.places);
        }
        gather(self.settings, self.roots, &self.locks, &self.traits, &mut trail);
        self.record(&trail)
    }

    fn at_the_roots(&self) -> Particles {
        let places: Vec<DVec3> = self.roots.iter().map(|r| DVec3::new(f64::from(r.fraction[0]), f64::from(r.fraction[1]), 0.0)).collect();
        Particles {
            guides: places.clone(),
            places,
            headings: self.traits.iter().map(|t| t.heading).collect(),
            sides: self.traits.iter().map(|t| t.side).collect(),
        }
    }

    /// Moves every particle one step along its heading and around its guide.
    fn advance(&self, particles: &mut Particles, length: f64, step: usize) {
        let steps = f64::from(self.settings.steps);
        let time = (step + 1) as f64 / steps;
        for (i, traits) in self.traits.iter().enumerate() {
            let heading = particles.headings[i];
            let guide = particles.guides[i] + heading * (length * traits.length / steps);
            let side = particles.sides[i];
            let side = (side - heading * side.dot(heading)).try_normalize().unwrap_or(side);
            let place = guide + self.shape.at(traits, heading, side, time);
            particles.sides[i] = side;
            particles.guides[i] = DVec3::new(guide.x, guide.y, guide.z.max(0.0));
            particles.places[i] = DVec3::new(place.x, place.y, place.z.max(0.0));
        }
    }

    /// Turns the trail, time by time, into strands.
    fn record(&self, trail: &[DVec3]) -> StrandTile {
        let count = self.roots.len();
        let steps = self.settings.steps as usize;
        let highest = trail.iter().fold(0.0f64, |top, p| top.max(p.z));
        let mut tile = StrandTile::empty(if count == 0 { self.settings.height } else { f64::from(highest as f32) });
        for (i, traits) in self.traits.iter().enumerate() {
            let points = (0..=steps).map(|step| trail[step * count + i].as_vec3().to_array());
            let taper = self.settings.taper;
            let radii = (0..=steps).map(|step| (traits.radius * taper.at(step as f64 / steps as f64, traits.tip)) as f32);
            tile.push(self.roots[i].cell, points, radii, traits.root_colour, traits.tip_colour);
        }
        tile.set_populations(&[self.settings.count, self.settings.undercoat.count]);
        if !self.settings.bands.is_empty() || self.settings.opacity != Opacity::default() {
            tile.tint(self.settings.bands, self.traits.iter().map(|traits| traits.tint).collect());
        }
        tile
    }

    /// The highest point of each strand, over what its place leaves of it.
    fn tops(&self, tile: &StrandTile) -> Vec<f64> {
        let top = |points: &[[f32; 3]]| points.iter().fold(0.0, |top: f64, p| top.max(f64::from(p[2])));
        tile.strands().zip(&self.traits).map(|(strand, traits)| top(strand.points) / traits.envelope).collect()
    }
}
