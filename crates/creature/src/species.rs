//! Plans of known animals.

use crate::{Ears, Head, Limbs, Neck, Plan, Stance, Tail, Trunk};

/// Animals that a plan is kept of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "an animal is its own explanation")]
pub enum Species {
    Cat,
    Dog,
    Fox,
    Bear,
    Mouse,
    Rabbit,
    Chimp,
    Spider,
}

impl Species {
    /// Every one of them.
    pub const ALL: [Self; 8] = [Self::Cat, Self::Dog, Self::Fox, Self::Bear, Self::Mouse, Self::Rabbit, Self::Chimp, Self::Spider];

    /// Its name in small letters.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cat => "cat",
            Self::Dog => "dog",
            Self::Fox => "fox",
            Self::Bear => "bear",
            Self::Mouse => "mouse",
            Self::Rabbit => "rabbit",
            Self::Chimp => "chimp",
            Self::Spider => "spider",
        }
    }

    /// The proportions of its kind.
    pub fn plan(self) -> Plan {
        match self {
            Self::Cat => cat(),
            Self::Dog => dog(),
            Self::Fox => fox(),
            Self::Bear => bear(),
            Self::Mouse => mouse(),
            Self::Rabbit => rabbit(),
            Self::Chimp => chimp(),
            Self::Spider => spider(),
        }
    }
}

fn cat() -> Plan {
    Plan {
        trunk: Trunk { chest: 0.235, belly: 0.215, rump: 0.225, width: 0.78, arch: 0.0 },
        neck: Neck { length: 0.13, thickness: 0.14, pitch: 48.0 },
        head: Head { radius: 0.225, muzzle: 0.16, muzzle_thickness: 0.42, pitch: 8.0, nose: 0.34, eyes: 0.17 },
        ears: Ears { length: 0.78, width: 0.42, tip: 0.25, spread: 34.0, lean: 0.0, droop: 0.0 },
        legs: Limbs { fore: 0.44, hind: 0.45, thigh: 0.115, ankle: 0.055, paw: 0.066, toes: 0.9, bend: 0.13, gap: 0.11, reach: 1.0 },
        leg_pairs: 2,
        stance: Stance::Upright,
        tail: Tail { length: 1.0, thickness: 0.055, bush: 1.0, tip: 0.75, pitch: 25.0, curl: 75.0, sway: 15.0 },
    }
}

fn dog() -> Plan {
    Plan {
        trunk: Trunk { chest: 0.29, belly: 0.225, rump: 0.235, width: 0.76, arch: 0.02 },
        neck: Neck { length: 0.2, thickness: 0.16, pitch: 50.0 },
        head: Head { radius: 0.21, muzzle: 0.95, muzzle_thickness: 0.46, pitch: 12.0, nose: 0.5, eyes: 0.15 },
        ears: Ears { length: 1.35, width: 0.42, tip: 0.85, spread: 62.0, lean: 8.0, droop: 155.0 },
        legs: Limbs { fore: 0.48, hind: 0.56, thigh: 0.125, ankle: 0.062, paw: 0.078, toes: 0.9, bend: 0.16, gap: 0.16, reach: 1.0 },
        leg_pairs: 2,
        stance: Stance::Upright,
        tail: Tail { length: 0.6, thickness: 0.062, bush: 1.0, tip: 0.45, pitch: 45.0, curl: 45.0, sway: 0.0 },
    }
}

fn fox() -> Plan {
    Plan {
        trunk: Trunk { chest: 0.21, belly: 0.18, rump: 0.19, width: 0.8, arch: 0.01 },
        neck: Neck { length: 0.16, thickness: 0.13, pitch: 40.0 },
        head: Head { radius: 0.19, muzzle: 0.98, muzzle_thickness: 0.27, pitch: 14.0, nose: 0.6, eyes: 0.14 },
        ears: Ears { length: 1.15, width: 0.47, tip: 0.25, spread: 30.0, lean: 4.0, droop: 0.0 },
        legs: Limbs { fore: 0.42, hind: 0.44, thigh: 0.095, ankle: 0.045, paw: 0.055, toes: 1.1, bend: 0.15, gap: 0.11, reach: 1.0 },
        leg_pairs: 2,
        stance: Stance::Upright,
        tail: Tail { length: 1.05, thickness: 0.06, bush: 2.1, tip: 0.3, pitch: -18.0, curl: 30.0, sway: 0.0 },
    }
}

fn bear() -> Plan {
    Plan {
        trunk: Trunk { chest: 0.36, belly: 0.37, rump: 0.37, width: 0.86, arch: 0.05 },
        neck: Neck { length: 0.2, thickness: 0.25, pitch: 14.0 },
        head: Head { radius: 0.235, muzzle: 0.55, muzzle_thickness: 0.46, pitch: 16.0, nose: 0.46, eyes: 0.2 },
        ears: Ears { length: 0.32, width: 0.31, tip: 1.0, spread: 44.0, lean: 5.0, droop: 0.0 },
        legs: Limbs { fore: 0.3, hind: 0.27, thigh: 0.17, ankle: 0.1, paw: 0.115, toes: 0.9, bend: 0.08, gap: 0.2, reach: 1.0 },
        leg_pairs: 2,
        stance: Stance::Upright,
        tail: Tail { length: 0.14, thickness: 0.07, bush: 0.9, tip: 0.8, pitch: -10.0, curl: 0.0, sway: 0.0 },
    }
}

fn mouse() -> Plan {
    Plan {
        trunk: Trunk { chest: 0.27, belly: 0.4, rump: 0.42, width: 0.92, arch: 0.02 },
        neck: Neck { length: 0.14, thickness: 0.22, pitch: 8.0 },
        head: Head { radius: 0.27, muzzle: 0.75, muzzle_thickness: 0.22, pitch: 14.0, nose: 0.7, eyes: 0.2 },
        ears: Ears { length: 0.7, width: 0.62, tip: 1.1, spread: 42.0, lean: 12.0, droop: 0.0 },
        legs: Limbs { fore: 0.13, hind: 0.1, thigh: 0.1, ankle: 0.045, paw: 0.05, toes: 1.8, bend: 0.12, gap: 0.26, reach: 1.0 },
        leg_pairs: 2,
        stance: Stance::Upright,
        tail: Tail { length: 1.5, thickness: 0.05, bush: 0.75, tip: 0.5, pitch: -25.0, curl: 70.0, sway: 50.0 },
    }
}

fn rabbit() -> Plan {
    Plan {
        trunk: Trunk { chest: 0.28, belly: 0.33, rump: 0.37, width: 0.84, arch: 0.06 },
        neck: Neck { length: 0.16, thickness: 0.18, pitch: 52.0 },
        head: Head { radius: 0.235, muzzle: 0.42, muzzle_thickness: 0.5, pitch: 16.0, nose: 0.26, eyes: 0.17 },
        ears: Ears { length: 2.3, width: 0.3, tip: 0.7, spread: 17.0, lean: 18.0, droop: 0.0 },
        legs: Limbs { fore: 0.24, hind: 0.15, thigh: 0.14, ankle: 0.07, paw: 0.075, toes: 1.8, bend: 0.16, gap: 0.16, reach: 1.0 },
        leg_pairs: 2,
        stance: Stance::Upright,
        tail: Tail { length: 0.14, thickness: 0.11, bush: 1.1, tip: 0.9, pitch: 25.0, curl: 0.0, sway: 0.0 },
    }
}

fn chimp() -> Plan {
    Plan {
        trunk: Trunk { chest: 0.33, belly: 0.27, rump: 0.25, width: 0.9, arch: 0.02 },
        neck: Neck { length: 0.19, thickness: 0.19, pitch: 32.0 },
        head: Head { radius: 0.25, muzzle: 0.34, muzzle_thickness: 0.6, pitch: 10.0, nose: 0.2, eyes: 0.11 },
        ears: Ears { length: 0.3, width: 0.34, tip: 1.0, spread: 84.0, lean: 0.0, droop: 0.0 },
        legs: Limbs { fore: 0.68, hind: 0.38, thigh: 0.12, ankle: 0.078, paw: 0.085, toes: 1.2, bend: 0.12, gap: 0.34, reach: 1.0 },
        leg_pairs: 2,
        stance: Stance::Upright,
        tail: Tail { length: 0.0, thickness: 0.05, bush: 1.0, tip: 0.5, pitch: 0.0, curl: 0.0, sway: 0.0 },
    }
}

fn spider() -> Plan {
    Plan {
        trunk: Trunk { chest: 0.28, belly: 0.12, rump: 0.46, width: 0.95, arch: -0.05 },
        neck: Neck { length: 0.06, thickness: 0.16, pitch: 5.0 },
        head: Head { radius: 0.2, muzzle: 0.2, muzzle_thickness: 0.4, pitch: 20.0, nose: 0.0, eyes: 0.3 },
        ears: Ears { length: 0.0, width: 0.2, tip: 0.5, spread: 40.0, lean: 0.0, droop: 0.0 },
        legs: Limbs { fore: 0.3, hind: 0.28, thigh: 0.085, ankle: 0.05, paw: 0.05, toes: 0.0, bend: 0.28, gap: 0.2, reach: 1.35 },
        leg_pairs: 4,
        stance: Stance::Sprawling,
        tail: Tail { length: 0.0, thickness: 0.05, bush: 1.0, tip: 0.5, pitch: 0.0, curl: 0.0, sway: 0.0 },
    }
}
