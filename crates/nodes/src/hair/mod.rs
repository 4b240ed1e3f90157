//! Hair: grown in its tile, sampled into textures, and those made smaller.

mod convert;
mod economy;
mod grow;
mod guides;
mod kinds;
mod maps;
mod picture;
mod row;
mod sample;

pub use economy::{BlockForm, CompressShells, LevelsOfDetail, NotStraight, OneLayer, OneLayerReport, ShareImages};
pub use grow::{GrowStrands, HairUndercoat};
pub use guides::{GuideHair, GuideStrands, MixStrands};
pub use kinds::{HairBand, HairGather, HairNoise, HairOffset, HairOpacity, HairPattern, HairStyle, HairTaper, TilePattern};
pub use maps::{FinOfShells, ImageShells, PatternLook, PatternShells, TileNoise, TintShells};
pub use picture::FinImage;
pub use row::CoatsInARow;
pub use sample::{CurlReport, FinDirection, SampleFin, SampleShells, ShellSpacing};
