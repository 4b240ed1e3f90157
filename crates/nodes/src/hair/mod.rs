//! Hair: grown in its tile, and sampled into textures.

mod grow;
mod sample;

pub use grow::{GrowStrands, HairStyle, HairUndercoat};
pub use sample::{FinDirection, SampleFin, SampleShells};
