//! No two alike.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::error::check;
use crate::{CreatureError, Plan};

/// How far an angle may turn at a variation of 1, in degrees.
const WIDEST_TURN: f64 = 40.0;

impl Plan {
    /// An individual after this plan: every proportion is multiplied by exp(*v u*) with *u* uniform between −1 and 1 and *v* the variation, 0 to 0.5, and every
    /// angle turned by up to 40° *v*; none leaves its range. At 0 it is the plan itself. The same seed gives the same individual on every machine,
    /// and another resolution does not change it.
    ///
    /// # Errors
    /// Where the variation or a number of the plan is out of range.
    ///
    /// ```
    /// use pelage_creature::Species;
    /// let cat = Species::Cat.plan();
    /// assert_eq!(cat.individual(7, 0.0)?, cat);
    /// assert_ne!(cat.individual(7, 0.1)?, cat.individual(8, 0.1)?);
    /// # Ok::<(), pelage_creature::CreatureError>(())
    /// ```
    pub fn individual(&self, seed: u64, variation: f64) -> Result<Self, CreatureError> {
        check("variation", variation, 0.0..=0.5)?;
        self.check()?;
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut individual = *self;
        for proportion in individual.proportions() {
            let amount = variation * signed(&mut random);
            let is_angle = *proportion.range.end() >= 10.0;
            let varied = if is_angle { *proportion.value + amount * WIDEST_TURN } else { *proportion.value * libm::exp(amount) };
            *proportion.value = varied.clamp(*proportion.range.start(), *proportion.range.end());
        }
        Ok(individual)
    }
}

/// Uniform between −1 and 1.
fn signed(random: &mut Pcg64Mcg) -> f64 {
    2.0 * (random.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64) - 1.0
}
