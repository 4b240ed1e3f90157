//! What a creature is made after: its proportions.

use std::ops::RangeInclusive;

use crate::CreatureError;
use crate::error::check;

/// One number of a plan.
#[derive(Debug, PartialEq)]
pub struct Proportion<'a> {
    /// `ears.length`
    pub name: &'static str,
    /// The number, to be read or changed.
    pub value: &'a mut f64,
    /// What it may be.
    pub range: RangeInclusive<f64>,
}

/// A struct of numbers, each with its range in the documentation, in the check and in the tests.
macro_rules! proportions {
    ($(#[$about:meta])* $name:ident in $group:literal { $($(#[$doc:meta])* $field:ident: $low:literal to $high:literal,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $($(#[$doc])* #[doc = concat!("\n\n", $low, " to ", $high, ".")] pub $field: f64,)*
        }

        impl $name {
            fn numbers(&mut self) -> Vec<Proportion<'_>> {
                vec![$(Proportion { name: concat!($group, ".", stringify!($field)), value: &mut self.$field, range: $low..=$high },)*]
            }
        }
    };
}

proportions! {
    /// Chest, belly and rump: three balls in a row, the outer ones a body length apart.
    Trunk in "trunk" {
        /// Radius of the chest, in body lengths, measured upright.
        chest: 0.08 to 0.6,
        /// Radius of the belly, in body lengths.
        belly: 0.06 to 0.6,
        /// Radius of the rump, in body lengths.
        rump: 0.08 to 0.6,
        /// Width over height.
        width: 0.5 to 1.0,
        /// How far the back's middle is raised, in body lengths; negative sags.
        arch: -0.1 to 0.25,
    }
}

proportions! {
    /// What carries the head.
    Neck in "neck" {
        /// From the chest's skin to the middle of the head, in body lengths.
        length: 0.0 to 0.9,
        /// Radius, in body lengths.
        thickness: 0.05 to 0.35,
        /// Degrees that it rises above the horizontal.
        pitch: -10.0 to 80.0,
    }
}

proportions! {
    /// A ball with a muzzle, a nose and eyes.
    Head in "head" {
        /// Radius, in body lengths.
        radius: 0.1 to 0.45,
        /// How far the muzzle stands out of the head, in radii of the head.
        muzzle: 0.0 to 1.8,
        /// Radius at the muzzle's end, in radii of the head.
        muzzle_thickness: 0.2 to 0.8,
        /// Degrees that the face looks down.
        pitch: -30.0 to 50.0,
        /// Radius of the nose, in radii of the muzzle's end; 0 leaves it out.
        nose: 0.0 to 0.8,
        /// Radius of the eyes, in radii of the head; 0 leaves them out.
        eyes: 0.0 to 0.4,
    }
}

proportions! {
    /// Two flat cones on the head.
    Ears in "ears" {
        /// From base to tip, in radii of the head; 0 leaves them out.
        length: 0.0 to 3.5,
        /// Radius at the base, in radii of the head.
        width: 0.15 to 0.7,
        /// Radius of the tip, in radii of the base: small is pointed, 1 is round.
        tip: 0.25 to 1.2,
        /// Degrees from the crown to the side at which they stand.
        spread: 10.0 to 90.0,
        /// Degrees that they lean back.
        lean: -20.0 to 70.0,
        /// Degrees from upright at which the outer half points; more than `spread` and it hangs.
        droop: 0.0 to 160.0,
    }
}

proportions! {
    /// Every leg: thigh, shank and paw.
    Limbs in "legs" {
        /// From the ground to the underside of the chest, in body lengths.
        fore: 0.08 to 1.0,
        /// From the ground to the underside of the rump, in body lengths.
        hind: 0.08 to 1.0,
        /// Radius where it leaves the trunk, in body lengths; hind legs of an upright stance have a quarter more.
        thigh: 0.03 to 0.2,
        /// Radius above the paw, in body lengths.
        ankle: 0.02 to 0.1,
        /// Radius of the paw, in body lengths.
        paw: 0.02 to 0.14,
        /// How far the paw reaches forward, in radii of it.
        toes: 0.0 to 2.5,
        /// How far knees stick out: forward and back in lengths between two pairs of legs, or in a sprawling stance up, in reaches.
        bend: 0.0 to 0.3,
        /// Between the left and the right foot, in body lengths.
        gap: 0.06 to 0.6,
        /// From the chest to the feet of a sprawling stance, in body lengths.
        reach: 0.7 to 2.5,
    }
}

proportions! {
    /// A curved row of cones.
    Tail in "tail" {
        /// In body lengths; under 0.02 there is none.
        length: 0.0 to 1.6,
        /// Radius at the base, in body lengths.
        thickness: 0.02 to 0.14,
        /// Radius at two thirds, in radii of the base.
        bush: 0.4 to 3.0,
        /// Radius of the tip, in radii at two thirds.
        tip: 0.2 to 1.0,
        /// Degrees that it rises where it begins; negative hangs.
        pitch: -60.0 to 80.0,
        /// Degrees that it turns up from base to tip; negative turns down.
        curl: -60.0 to 120.0,
        /// Degrees that it turns to the left from base to tip.
        sway: -90.0 to 90.0,
    }
}

/// Where the feet are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stance {
    /// Under the body, as a mammal's.
    #[default]
    Upright,
    /// In a fan around the chest, with knees above it, as a spider's.
    Sprawling,
}

/// The most pairs of legs.
pub const MOST_LEG_PAIRS: u32 = 6;

/// The proportions of a creature. A body length, from the middle of the chest to the middle of the rump, is 1; it looks along +z, y is up and the
/// feet stand at y = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each group says what it is")]
pub struct Plan {
    pub trunk: Trunk,
    pub neck: Neck,
    pub head: Head,
    pub ears: Ears,
    pub legs: Limbs,
    /// How many pairs of legs, up to [`MOST_LEG_PAIRS`]; without any the belly lies on the ground. Of an upright stance the last pair is made as
    /// hind legs, the others as fore legs.
    pub leg_pairs: u32,
    pub stance: Stance,
    pub tail: Tail,
}

impl Plan {
    /// Every number of the plan with its name and range, always in the same order.
    pub fn proportions(&mut self) -> Vec<Proportion<'_>> {
        let mut numbers = self.trunk.numbers();
        numbers.extend(self.neck.numbers());
        numbers.extend(self.head.numbers());
        numbers.extend(self.ears.numbers());
        numbers.extend(self.legs.numbers());
        numbers.extend(self.tail.numbers());
        numbers
    }

    /// Whether every number is in its range.
    ///
    /// # Errors
    /// Where one is not, with its name, its value and the range.
    pub fn check(&self) -> Result<(), CreatureError> {
        let mut copy = *self;
        copy.proportions().into_iter().try_for_each(|number| check(number.name, *number.value, number.range))?;
        check("leg_pairs", f64::from(self.leg_pairs), 0.0..=f64::from(MOST_LEG_PAIRS))
    }
}
