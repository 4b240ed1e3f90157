//! Hair grown by a particle simulation in a small box that repeats.
//!
//! One particle for each hair starts at its root; at each time step all particles move together under forces, and the trail that a particle
//! leaves is the strand (Lengyel, Praun, Finkelstein, Hoppe, "Real-time fur over arbitrary surfaces", I3D 2001, section 2.2).
//!
//! **Convention.** The tile is the unit square [0, 1)², toroidal in x and y. x runs along s, y along t (the way the fur lies), z up from the
//! skin; every length is in tile sides, but that styles and guides are in heights of the box. Colours are linear RGB. The simulation runs in `f64` with portable functions only, so a seed gives the
//! same bits on every machine; strands are stored in `f32`, each relative to its own tile.
//!
//! ```
//! use pelage_strand::{GrowSettings, Style, grow};
//!
//! let settings = GrowSettings { count: 200, style: Style::Curly { radius: 0.06, turns: 2.0 }, seed: 7, ..GrowSettings::default() };
//! let hair = grow(&settings)?;
//! assert_eq!(hair.strand_count() as u64, settings.strand_count());
//! let first = hair.strand(0).ok_or("no strand")?;
//! assert!(first.radii[0] > first.radii[first.radii.len() - 1]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod blend;
mod colour;
mod curls;
mod curve;
mod error;
mod forces;
mod gather;
mod grow;
mod guides;
mod light;
mod locks;
mod mix;
mod noise;
mod roots;
mod seed;
mod settings;
mod style;
mod tile;
mod torus;
mod traits;
mod vary;

pub use colour::{Bands, MAX_STOPS, Opacity, Stop};
pub use curls::Curls;
pub use curve::{Curve, MAX_CURVE, Taper};
pub use error::StrandError;
pub use gather::{Gather, Offset};
pub use grow::{grow, grow_at};
pub use guides::{Guide, MAX_GUIDE_POINTS, MAX_GUIDES, guided};
pub use mix::mix;
pub use noise::TileNoise;
pub use settings::{GrowSettings, MAX_POINTS, MAX_STRANDS, Undercoat};
pub use style::Style;
pub use tile::{MAX_TILES_AWAY, Root, Strand, StrandSource, StrandTile};
pub use vary::{Amounts, ByNoise, ByPattern, Pattern};
