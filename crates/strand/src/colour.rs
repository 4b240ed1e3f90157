//! What colour a hair is along its way, and how opaque (K9).

use crate::error::{StrandError, within};
use crate::tile::Strand;

/// Most stops of [`Bands`].
pub const MAX_STOPS: usize = 8;

/// A colour at a place along a hair.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stop {
    /// From 0 at the root to 1 at the tip.
    pub along: f32,
    /// Linear RGB, each 0 to 1.
    pub colour: [f32; 3],
}

/// Colours from root to tip that all hairs of a kind share, as an agouti's dark and light bands: straight between stops, even beyond the first and the last.
///
/// ```
/// use pelage_strand::{Bands, Stop};
///
/// let bands = Bands::new(&[Stop { along: 0.5, colour: [0.0; 3] }, Stop { along: 1.0, colour: [1.0; 3] }])?;
/// assert_eq!((bands.at(0.2), bands.at(0.75)), ([0.0; 3], [0.5; 3]));
/// assert_eq!(bands.mean(0.0, 1.0), [0.25; 3]);
/// # Ok::<(), pelage_strand::StrandError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bands {
    stops: [Stop; MAX_STOPS],
    count: usize,
}

impl Bands {
    /// Colours at up to [`MAX_STOPS`] places, from root to tip; none: two colours do.
    ///
    /// # Errors
    /// Too many stops, one that is nearer to the root than the one before, a place or a colour that is not within 0 to 1.
    pub fn new(stops: &[Stop]) -> Result<Self, StrandError> {
        if stops.len() > MAX_STOPS {
            return Err(StrandError::ListLength { name: "bands", length: stops.len(), least: 0, most: MAX_STOPS });
        }
        let mut low = 0.0;
        for stop in stops {
            within("bands.along", f64::from(stop.along), low, 1.0, "of the hair, and not before the stop before it")?;
            low = f64::from(stop.along);
            stop.colour.iter().try_for_each(|&c| within("bands.colour", f64::from(c), 0.0, 1.0, "(linear light)"))?;
        }
        Ok(Self { stops: std::array::from_fn(|index| stops.get(index).copied().unwrap_or_default()), count: stops.len() })
    }

    /// Whether there are no stops.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The stops, from root to tip.
    pub fn stops(&self) -> &[Stop] {
        &self.stops[..self.count]
    }

    /// The colour at a place along; black without stops.
    pub fn at(&self, along: f32) -> [f32; 3] {
        let stops = self.stops();
        let above = stops.partition_point(|stop| stop.along <= along);
        match (above.checked_sub(1).and_then(|below| stops.get(below)), stops.get(above)) {
            (Some(low), Some(high)) => mixed(low.colour, high.colour, (along - low.along) / (high.along - low.along)),
            (Some(stop), None) | (None, Some(stop)) => stop.colour,
            (None, None) => [0.0; 3],
        }
    }

    /// The mean colour from one place along to another; that at the place where they are one.
    pub fn mean(&self, from: f32, to: f32) -> [f32; 3] {
        if to - from < 1e-6 {
            return self.at(from);
        }
        // Straight between these, so the mean of each part is that of its ends.
        let inner = self.stops().iter().map(|stop| stop.along).filter(|&along| along > from && along < to);
        let mut sum = [0.0; 3];
        let (mut last, mut colour) = (from, self.at(from));
        for next in inner.chain([to]) {
            // Of two stops at one place the later has the way on.
            let before = self.before(next);
            let part = 0.5 * (next - last) / (to - from);
            sum = [0, 1, 2].map(|c| sum[c] + part * (colour[c] + before[c]));
            (last, colour) = (next, self.at(next));
        }
        sum
    }

    /// The colour just before a place.
    fn before(&self, along: f32) -> [f32; 3] {
        let stops = self.stops();
        let above = stops.partition_point(|stop| stop.along < along);
        match (above.checked_sub(1).and_then(|below| stops.get(below)), stops.get(above)) {
            (Some(low), Some(high)) => mixed(low.colour, high.colour, (along - low.along) / (high.along - low.along)),
            (Some(stop), None) | (None, Some(stop)) => stop.colour,
            (None, None) => [0.0; 3],
        }
    }
}

/// How opaque hair is, by hair and from root to tip (K9).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opacity {
    /// At the root: 0 to 1.
    pub root: f64,
    /// At the tip: 0 to 1.
    pub tip: f64,
    /// How much less opaque hairs may be, constant along each: 0 to 1.
    pub variation: f64,
}

impl Default for Opacity {
    fn default() -> Self {
        Self { root: 1.0, tip: 1.0, variation: 0.0 }
    }
}

impl Opacity {
    pub(crate) fn validate(&self) -> Result<(), StrandError> {
        within("opacity.root", self.root, 0.0, 1.0, "of 1")?;
        within("opacity.tip", self.tip, 0.0, 1.0, "of 1")?;
        within("opacity.variation", self.variation, 0.0, 1.0, "of 1")
    }
}

/// How one hair differs from root and tip colours alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tint {
    /// Which of the tile's bands it has; `u32::MAX` for none.
    pub(crate) bands: u32,
    /// What its bands are multiplied by.
    pub(crate) shade: f32,
    /// At the root and at the tip.
    pub(crate) opacity: [f32; 2],
}

impl Tint {
    /// Two colours, opaque.
    pub(crate) const PLAIN: Self = Self { bands: u32::MAX, shade: 1.0, opacity: [1.0; 2] };
}

impl Strand<'_> {
    /// Linear RGB a part of the way along the hair, 0 at the root, 1 at the tip.
    pub fn colour_at(&self, along: f32) -> [f32; 3] {
        match self.bands {
            Some(bands) => shaded(bands.at(along), self.shade),
            None => mixed(self.root_colour, self.tip_colour, along),
        }
    }

    /// The mean of [`Strand::colour_at`] from one place along to another, so that bands narrower than a layer are not missed.
    pub fn mean_colour(&self, from: f32, to: f32) -> [f32; 3] {
        match self.bands {
            Some(bands) => shaded(bands.mean(from, to), self.shade),
            None => self.colour_at(0.5 * (from + to)),
        }
    }

    /// What part of the light that meets the hair a part of the way along it does not get through: 0 to 1.
    pub fn opacity_at(&self, along: f32) -> f32 {
        let [root, tip] = self.opacity;
        root + (tip - root) * along
    }

    /// Whether nothing gets through.
    pub fn is_opaque(&self) -> bool {
        self.opacity == [1.0; 2]
    }
}

/// A part of the way from one colour to another.
fn mixed(from: [f32; 3], to: [f32; 3], part: f32) -> [f32; 3] {
    [0, 1, 2].map(|c| from[c] + (to[c] - from[c]) * part)
}

pub(crate) fn shaded(colour: [f32; 3], shade: f32) -> [f32; 3] {
    colour.map(|c| (c * shade).clamp(0.0, 1.0))
}
