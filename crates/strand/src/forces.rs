//! What turns the growing hairs: stiffness, gravity, wander, separation and clumping.

use glam::DVec3;
use rayon::prelude::*;

use crate::grow::Particles;
use crate::noise::TileNoise;
use crate::seed::{Purpose, mix};
use crate::settings::GrowSettings;
use crate::torus::{TorusGrid, shortest};
use crate::traits::Traits;

/// The smaller the number, the wider the shared wander: cells along a tile side.
const SHARED_FREQUENCY: u32 = 5;
/// Fewer particles than this are not worth another thread.
const PARTICLES_A_TASK: usize = 256;
/// How fast a heading steers to its lock, per length grown.
const LOCK_RATE: f64 = 12.0;

/// The forces of one simulation, with the grid through which particles feel each other.
pub(crate) struct Forces<'a> {
    settings: &'a GrowSettings,
    traits: &'a [Traits],
    length: f64,
    reach: f64,
    grid: TorusGrid,
    shared: TileNoise,
    own_wander: &'a [[f64; 2]],
    /// For each strand the guide particle of its lock.
    locks: &'a [u32],
    pushes: Vec<DVec3>,
}

impl<'a> Forces<'a> {
    pub(crate) fn new(settings: &'a GrowSettings, traits: &'a [Traits], own_wander: &'a [[f64; 2]], locks: &'a [u32], length: f64) -> Self {
        let count = traits.len();
        // Hairs feel each other up to the mean distance of neighbours.
        let reach = (1.0 / (count.max(1) as f64).sqrt()).min(0.5);
        Self {
            settings,
            traits,
            length,
            reach,
            grid: TorusGrid::new(reach, count),
            shared: TileNoise::new(wander_seed(settings), SHARED_FREQUENCY),
            own_wander,
            locks,
            pushes: vec![DVec3::ZERO; count],
        }
    }

    /// Turns all headings over one step; every particle sees the others where they were when the step began.
    pub(crate) fn turn(&mut self, particles: &mut Particles, step: usize) {
        let steps = f64::from(self.settings.steps);
        let time = step as f64 / steps;
        if self.settings.separation > 0.0 {
            self.grid.rebuild(particles.places.iter().map(|p| [p.x, p.y]));
        }
        // Each from what stood before the step, so that the bits do not depend on how many threads there are.
        let mut pushes = std::mem::take(&mut self.pushes);
        pushes.par_iter_mut().with_min_len(PARTICLES_A_TASK).enumerate().for_each(|(i, push)| {
            *push = DVec3::new(0.0, 0.0, -self.settings.gravity * self.traits[i].bend);
            *push += self.wander(i, particles.places[i], step);
            *push += self.separation(i, &particles.places);
            *push += self.clump(i, &particles.places, time);
        });
        self.pushes = pushes;
        let step_size = 1.0 / steps;
        let stiffness = self.settings.stiffness;
        for (i, push) in self.pushes.iter().enumerate() {
            let old = particles.headings[i];
            // Stiffness implicitly: bounded for any stiffness and step.
            let turned = (old + (self.traits[i].heading * stiffness + *push) * step_size) / (1.0 + stiffness * step_size);
            particles.headings[i] = keep_off_skin(turned, old, particles.places[i].z);
        }
    }

    /// Half shared by neighbours, half the hair's own.
    fn wander(&self, i: usize, place: DVec3, step: usize) -> DVec3 {
        let Some(&[ox, oy]) = self.own_wander.get(step * self.traits.len() + i) else { return DVec3::ZERO };
        let [sx, sy] = self.shared.sideways(place.x, place.y, place.z);
        DVec3::new(sx + ox, sy + oy, 0.0) * (2.0 * self.settings.wander)
    }

    /// Sideways away from every nearer hair, falling linearly to nothing at the mean distance.
    fn separation(&self, i: usize, places: &[DVec3]) -> DVec3 {
        if self.settings.separation == 0.0 {
            return DVec3::ZERO;
        }
        let from = places[i];
        let mut push = DVec3::ZERO;
        self.grid.around([from.x, from.y], |j| {
            let away = DVec3::new(shortest(from.x - places[j].x), shortest(from.y - places[j].y), from.z - places[j].z);
            let distance = away.length();
            if j != i && distance < self.reach && distance > 0.0 {
                push += DVec3::new(away.x, away.y, 0.0) * ((1.0 - distance / self.reach) / distance);
            }
        });
        push * self.settings.separation
    }

    /// Steers to where the lock's guide is now, more and more urgently, so that the tip arrives.
    fn clump(&self, i: usize, places: &[DVec3], time: f64) -> DVec3 {
        let Some(&lock) = self.locks.get(i).filter(|_| self.settings.clump > 0.0) else { return DVec3::ZERO };
        let to = places[lock as usize] - places[i];
        let sideways = DVec3::new(shortest(to.x), shortest(to.y), 0.0);
        let left = self.length * self.traits[i].length * (1.1 - time);
        // The down is too fine to gather as its guards do.
        let strength = if self.traits[i].undercoat { 0.4 } else { 1.0 } * self.settings.clump * LOCK_RATE;
        (sideways / left.max(1e-9)).clamp_length_max(2.0) * strength
    }
}

fn wander_seed(settings: &GrowSettings) -> u64 {
    mix(settings.seed ^ Purpose::Noise as u64)
}

/// The wander that is each hair's own, step after step: it does not depend on where the hair is, so one table does for all growths of a fit. Empty without
/// wander.
pub(crate) fn own_wander(settings: &GrowSettings, traits: &[Traits]) -> Vec<[f64; 2]> {
    if settings.wander == 0.0 {
        return Vec::new();
    }
    let own = TileNoise::new(mix(wander_seed(settings)), 1);
    let steps = settings.steps as usize;
    let mut values = vec![[0.0; 2]; steps * traits.len()];
    values.par_chunks_mut(traits.len().max(1)).enumerate().for_each(|(step, values)| {
        let time = step as f64 / steps as f64;
        for (value, traits) in values.iter_mut().zip(traits) {
            *value = own.sideways(0.37, 0.71, traits.own_noise + 3.0 * time);
        }
    });
    values
}

/// A unit heading that does not go through the skin.
fn keep_off_skin(turned: DVec3, old: DVec3, z: f64) -> DVec3 {
    let heading = turned.try_normalize().unwrap_or(old);
    if z <= 0.0 && heading.z < 0.05 { DVec3::new(heading.x, heading.y, 0.05).try_normalize().unwrap_or(DVec3::Z) } else { heading }
}
