//! Strands sampled into shell layers and a fin texture.

mod blur;
mod composite;
mod error;
mod fin;
mod footprint;
mod gauss;
mod image;
mod mips;
mod plane;
mod shells;
mod slab;
mod srgb;

pub use error::VolumeError;
pub use fin::{FinAcross, FinSettings, sample_fin};
pub use image::{FinTexture, Image, ShellStack, Work};
pub use mips::MipRule;
pub use shells::{MAX_TEXELS, ShellSettings, sample_shells};
pub use srgb::{linear_to_srgb, srgb_to_linear};
