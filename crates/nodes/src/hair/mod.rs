//! Hair: grown in its tile, sampled into textures, and those made smaller.

mod convert;
mod economy;
mod grow;
mod picture;
mod row;
mod sample;

pub use economy::{BlockForm, CompressShells, LevelsOfDetail, NotStraight, OneLayer, OneLayerReport, ShareImages};
pub use grow::{GrowStrands, HairStyle, HairUndercoat};
pub use picture::FinImage;
pub use row::CoatsInARow;
pub use sample::{FinDirection, SampleFin, SampleShells, ShellSpacing};
