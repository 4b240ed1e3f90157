//! Hairs gathered into locks (K7, K8), after Silva, Bando, Chen and Nishita, "Curling and clumping fur represented by texture layers" (2010).

use glam::DVec3;
use libm::{cos, pow, sin};
use std::f64::consts::{PI, TAU};

use crate::curve::exponential;
use crate::error::{StrandError, within};
use crate::seed::{Purpose, stream, unit};
use crate::settings::GrowSettings;
use crate::tile::Root;
use crate::torus::shortest;
use crate::traits::Traits;

/// How much shorter the outermost hair of a spike is than its middle, at full strength.
const CONE: f64 = 0.45;
/// The down is too fine to gather as its guards do.
const DOWN: f64 = 0.4;

/// How hairs lie in locks, beside their style: any style may be clumpy or spiky.
///
/// It is a map of the grown hair and no force: how near tips come to each other is exactly as asked, and hair gathered does not push itself apart. Locks are
/// `clump_size` wide, as those of `clump` are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Gather {
    /// Not gathered.
    #[default]
    Free,
    /// Tufts: each hair goes its own part of the way to the middle of its lock, and each lock its own way aside.
    Clumpy {
        /// How far tips go to the middle at most, of the way there: 0 to 1. The mean hair goes two thirds of it.
        strength: f64,
        /// How far the lock's tip goes aside, in heights: 0 to 1.
        mess: f64,
        /// How both grow along the hair.
        offset: Offset,
    },
    /// Spikes: every tip goes the same part of the way to the middle of its lock, and hairs are the shorter the nearer to the rim, so that a lock is a cone.
    Spiky {
        /// How far tips go, of the way there: 0 to 1, where all of a lock meet.
        strength: f64,
        /// How it grows along the hair.
        offset: Offset,
    },
}

/// How an offset grows from 0 at the root to 1 at the tip (K8).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Offset {
    /// (1 − cos πx)/2: neither root nor tip is bent.
    Sine,
    /// (e^(rx) − 1)/(e^r − 1).
    Exponential {
        /// Above 0 hair bends at its tip, below 0 at its root, 0 is straight: −8 to 8.
        rate: f64,
    },
    /// x^p.
    Power {
        /// Above 1 hair bends at its tip, below 1 at its root: 0.1 to 10.
        exponent: f64,
    },
}

impl Offset {
    /// The part of the offset a part of the way along the hair.
    ///
    /// ```
    /// use pelage_strand::Offset;
    ///
    /// assert!((Offset::Sine.at(0.5) - 0.5).abs() < 1e-12);
    /// assert_eq!(Offset::Power { exponent: 2.0 }.at(0.5), 0.25);
    /// ```
    pub fn at(&self, along: f64) -> f64 {
        match *self {
            Self::Sine => 0.5 - 0.5 * cos(PI * along),
            Self::Exponential { rate } => exponential(along, -rate),
            Self::Power { exponent } => pow(along, exponent),
        }
    }

    fn validate(&self) -> Result<(), StrandError> {
        match *self {
            Self::Sine => Ok(()),
            Self::Exponential { rate } => within("gather.offset.rate", rate, -8.0, 8.0, "(rate)"),
            Self::Power { exponent } => within("gather.offset.exponent", exponent, 0.1, 10.0, "(exponent)"),
        }
    }
}

impl Gather {
    pub(crate) fn validate(&self) -> Result<(), StrandError> {
        match self {
            Self::Free => Ok(()),
            Self::Clumpy { strength, mess, offset } => {
                within("gather.strength", *strength, 0.0, 1.0, "of the way")?;
                within("gather.mess", *mess, 0.0, 1.0, "heights")?;
                offset.validate()
            }
            Self::Spiky { strength, offset } => {
                within("gather.strength", *strength, 0.0, 1.0, "of the way")?;
                offset.validate()
            }
        }
    }
}

/// Makes hairs the shorter the further they stand from the middle of their spike, whose own hair is as long as hair is there.
pub(crate) fn shorten(settings: &GrowSettings, roots: &[Root], locks: &[u32], traits: &mut [Traits]) {
    let Gather::Spiky { strength, .. } = settings.gather else { return };
    let away: Vec<f64> = locks.iter().enumerate().map(|(hair, &lock)| way(roots, hair, lock as usize).length()).collect();
    let mut widest = vec![0.0f64; roots.len()];
    for (&lock, &away) in locks.iter().zip(&away) {
        widest[lock as usize] = widest[lock as usize].max(away);
    }
    for (hair, (&lock, &away)) in locks.iter().zip(&away).enumerate() {
        let traits = &mut traits[hair];
        if lock as usize == hair {
            traits.length = if traits.undercoat { settings.undercoat.length } else { 1.0 } * traits.envelope;
            continue;
        }
        let part = away / widest[lock as usize].max(1e-12);
        let shorter = 1.0 - CONE * strength * part * part;
        traits.length *= shorter;
        traits.envelope *= shorter;
    }
}

/// Moves every point of a trail, time after time of all hairs, towards its lock's middle.
pub(crate) fn gather(settings: &GrowSettings, roots: &[Root], locks: &[u32], traits: &[Traits], trail: &mut [DVec3]) {
    let (strength, mess, offset, all_alike) = match settings.gather {
        Gather::Free => return,
        Gather::Clumpy { strength, mess, offset } => (strength, mess, offset, false),
        Gather::Spiky { strength, offset } => (strength, 0.0, offset, true),
    };
    let count = roots.len();
    let grown = trail.to_vec();
    let steps = settings.steps as usize;
    for (hair, &lock) in locks.iter().enumerate() {
        let lock = lock as usize;
        let own = &traits[hair];
        let part = strength * if all_alike { 1.0 } else { own.loyalty } * if own.undercoat { DOWN } else { 1.0 };
        // The image of the lock that stands next to the hair.
        let image = way(roots, hair, lock) - (grown[lock] - grown[hair]);
        let aside = aside(settings.seed, lock) * (mess * settings.height);
        // The middle goes on as its own hair does; at the same length grown, so that a short hair meets it low.
        let pace = own.length / traits[lock].length.max(1e-12);
        for step in 0..=steps {
            let along = step as f64 / steps as f64;
            let bent = offset.at(along);
            let place = grown[step * count + hair];
            let toward = middle(&grown, count, lock, steps, along * pace) + image - place;
            let moved = (DVec3::new(toward.x, toward.y, 0.0) * part + aside) * bent;
            trail[step * count + hair] = place + moved;
        }
    }
}

/// The shortest way over the skin from a hair's root to its lock's.
fn way(roots: &[Root], hair: usize, lock: usize) -> DVec3 {
    let [from, to] = [hair, lock].map(|index| roots[index].fraction.map(f64::from));
    DVec3::new(shortest(to[0] - from[0]), shortest(to[1] - from[1]), 0.0)
}

/// Where a lock's own hair is at a time; straight on after its tip.
fn middle(grown: &[DVec3], count: usize, lock: usize, steps: usize, time: f64) -> DVec3 {
    let place = time * steps as f64;
    let step = (place as usize).min(steps - 1);
    let [from, to] = [step, step + 1].map(|step| grown[step * count + lock]);
    from + (to - from) * (place - step as f64)
}

/// Which way a lock goes, level and of length 0 to 1.
fn aside(seed: u64, lock: usize) -> DVec3 {
    let mut random = stream(seed, Purpose::Locks, lock as u64);
    let (angle, reach) = (TAU * unit(&mut random), unit(&mut random).sqrt());
    DVec3::new(cos(angle), sin(angle), 0.0) * reach
}
