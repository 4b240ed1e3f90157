//! Which part of a creature is meant.

/// A part of a body that fur may be different on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// Chest, belly and rump.
    Trunk,
    /// The neck.
    Neck,
    /// The head without muzzle.
    Head,
    /// From the cheeks to the nose.
    Muzzle,
    /// The nose.
    Nose,
    /// Both eyes.
    Eyes,
    /// Both ears.
    Ears,
    /// Thighs and shanks.
    Legs,
    /// What the creature stands on.
    Paws,
    /// The tail without its tip.
    Tail,
    /// The last quarter of the tail.
    TailTip,
}
