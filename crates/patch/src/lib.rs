//! Lapped patches.
mod connectivity;
mod cover;
mod disc;
mod distortion;
mod frame;
mod growth;
mod quality;
mod settings;
mod shape;
mod solve;
mod splotch;
mod tiling;

pub use cover::grow;
pub use quality::Quality;
pub use settings::{
    DEFAULT_ALIGNMENT, DEFAULT_MAX_STRETCH, DEFAULT_MAX_TURNING, DEFAULT_PATCH_EXTENT, DEFAULT_TILE_FRACTION, PatchError, Settings,
};
pub use tiling::{Patch, PatchTiling};
