//! What a hand does, as data.

use glam::DVec3;

use crate::FieldError;

/// Most places of a stroke, between those given too.
pub(super) const MOST_PLACES: usize = 4096;

/// What is in the hand. Angles are in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tool {
    /// Leans the fur further along a vector in model coordinates, by as many radians as it is long, as a drag over it does (L21).
    Comb {
        /// Which way and how far.
        toward: DVec3,
    },
    /// Leans the fur along the stroke, at an angle.
    Along {
        /// The angle from the normal.
        slant: f64,
    },
    /// Makes neighbours lie alike.
    Smooth,
    /// Lays the fur away from the stroke on both sides (L25).
    Part {
        /// The angle from the normal.
        slant: f64,
    },
    /// Lays the fur about the stroke's first place: away from it, turned by an angle, anticlockwise seen from outside (L25).
    Whorl {
        /// 0 away, π towards it, π/2 around it.
        turn: f64,
        /// The angle from the normal.
        slant: f64,
    },
    /// Stands the fur up.
    Lift,
    /// Lays the fur down to an angle, the way it leans already.
    Flatten {
        /// The angle from the normal.
        slant: f64,
    },
    /// Shortens the fur that is longer.
    Cut {
        /// To this part of its length, 0 to 1.
        to: f64,
    },
    /// Makes the fur longer and stands it up.
    Puff {
        /// By this part of its length, 0 or more.
        by: f64,
    },
}

/// One stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct BrushStroke {
    /// What is in the hand.
    pub tool: Tool,
    /// Where it goes, in model coordinates: each place is brought to the surface, from no further off than the radius. One place is a dab.
    pub path: Vec<DVec3>,
    /// How far along the surface it reaches to either side, in model diameters: above 0, up to 10. It fades out towards there.
    pub radius: f64,
    /// How strongly, 0 to 1: at 1 the fur under its middle does as it is told.
    pub strength: f64,
}

impl BrushStroke {
    pub(super) fn check(&self) -> Result<(), FieldError> {
        let wrong = |what: &'static str| Err(FieldError::Stroke { what });
        if self.path.is_empty() || !self.path.iter().all(|place| place.is_finite()) {
            return wrong("its path needs one finite place at least");
        }
        if !(self.radius > 0.0 && self.radius <= 10.0) {
            return wrong("its radius must be above 0 and at most 10 model diameters");
        }
        if !(0.0..=1.0).contains(&self.strength) {
            return wrong("its strength must be 0 to 1");
        }
        let fine = match self.tool {
            Tool::Comb { toward } => toward.is_finite(),
            Tool::Along { slant } | Tool::Part { slant } | Tool::Flatten { slant } => slant.is_finite(),
            Tool::Whorl { turn, slant } => turn.is_finite() && slant.is_finite(),
            Tool::Cut { to } => (0.0..=1.0).contains(&to),
            Tool::Puff { by } => (0.0..=100.0).contains(&by),
            Tool::Smooth | Tool::Lift => true,
        };
        if !fine {
            return wrong("its angles must be finite, what is cut to 0 to 1, what is puffed by 0 to 100");
        }
        if matches!(self.tool, Tool::Along { .. }) && self.path.len() < 2 {
            wrong("to comb along it, it needs two places at least")
        } else {
            Ok(())
        }
    }
}
