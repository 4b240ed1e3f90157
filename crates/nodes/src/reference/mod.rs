//! The geometric truth: the hair itself, ray cast or handed on as curves.

mod curves;
#[cfg(feature = "gpu")]
mod picture;

pub use curves::{HairPlacement, StrandCurves};
#[cfg(feature = "gpu")]
pub use picture::{RayReport, ReferenceImage, ShadowsBy};
