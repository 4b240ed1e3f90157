//! Strands sampled into what a graphics card draws: shell layers and a fin.
//!
//! Each shell layer is an RGBA image of the hair in a slab of the tile, taken with a tall Gaussian filter that has a flat top; the fin is a slab of hair seen from its side
//! (Lengyel, Praun, Finkelstein, Hoppe, "Real-time fur over arbitrary surfaces", I3D 2001, section 2.2). Hair is integrated in closed form, never
//! point sampled, so that thin hair neither vanishes nor thickens with the resolution.
//!
//! **Convention.** A layer's row 0 is y = 0 of the tile, its column 0 is x = 0; layer 0 is the skin, the last the tips. A fin's row 0 is the tips. Texels are
//! RGBA8: red, green and blue premultiplied by alpha in linear light and then sRGB-encoded, alpha linear coverage. Strands are cut in `f64`, texels
//! evaluated and averaged in `f32`, and rounded to bytes once at the end of each level, so that each layer's mean coverage is kept.
//!
//! A [`ShellStack`] goes on from there: [`ShellStack::with_levels`] composites pairs of shells down to one (L16), [`OneLayerFit`] keeps one image of straight hair (L22),
//! [`ShellStack::shared`] shows the images by more or fewer shells (K5), [`ShellStack::compressed`] makes blocks (L22).
//!
//! Hair without strands: [`map_shells`] makes shells of a pattern (K2, Z1), [`shells_from_pixels`] and [`fin_from_pixels`] take what somebody drew, [`ShellStack::fin`] cuts a fin of shells, [`ShellStack::tinted`] dyes them by a
//! picture.
//!
//! ```
//! use pelage_strand::{GrowSettings, grow};
//! use pelage_volume::{FinSettings, ShellSettings, sample_fin, sample_shells};
//!
//! let hair = grow(&GrowSettings { count: 100, ..GrowSettings::default() })?;
//! let shells = sample_shells(&hair, &ShellSettings { layers: 8, resolution: 32, ..ShellSettings::default() })?;
//! assert_eq!((shells.resolution(), shells.mips.len()), (32, 6));
//! assert_eq!(shells.mips[0].texel(0, 3, 5).map(|texel| texel[3]), Some(255));
//! let fin = sample_fin(&hair, &FinSettings::default())?;
//! assert_eq!(fin.mips[0].texels.len(), 4 * 512 * 64);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod blur;
mod composite;
mod compress;
mod directions;
mod error;
mod extent;
mod fin;
mod footprint;
mod gauss;
mod heights;
mod image;
mod levels;
mod map;
mod mips;
mod picture;
mod pixels;
mod plane;
mod ramp_block;
mod share;
mod shell;
mod shells;
mod slab;
mod spacing;
mod srgb;
mod stack;
mod stack_fin;
mod taper;
mod tint;

pub use compress::{BlockImage, CompressedStack, CompressionError};
pub use error::VolumeError;
pub use fin::{FinAcross, FinSettings, sample_fin};
pub use heights::Spacing;
pub use image::{FinTexture, Image, ShellStack, Work};
pub use map::{FurMap, MapLook, map_shells};
pub use mips::MipRule;
pub use picture::{fin_from_pixels, shells_from_pixels};
pub use pixels::Pixels;
pub use shell::Shell;
pub use shells::{MAX_TEXELS, ShellSettings, sample_shells, sample_skin};
pub use spacing::layers_for;
pub use srgb::{linear_to_srgb, srgb_to_linear};
pub use stack::StackSettings;
pub use taper::OneLayerFit;
