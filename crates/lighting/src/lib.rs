//! How fur takes light: the hair lighting of Kajiya, Banks and Lengyel in `f64`, its table, self-shadow and facing, and light from all around.
//!
//! No mesh, no graphics adapter, no random number: numbers in, numbers out. `pelage-render` computes the same formula on the graphics
//! processor, and the ray-cast reference calls this crate, so that both agree on what light is.
//!
//! # Convention
//! All directions are unit vectors in one right-handed frame with y up; *L* points towards the light and *V* towards the eye.
//! Colours are linear light. Height runs from 0 at the skin to 1 at the tips, depth is 1 − height.
//!
//! # The whole formula
//! Written down once, in [`Shading::shade`]:
//!
//! ```text
//! colour of the light that leaves = albedo · ( Ka · irradiance(N) · sky(depth)
//!                                            + Σ (Kd (1 − u²)^(Pd/2) + Ks (1 − v²)^(Ps/2) · w(L, V)) · shadow(depth, N·L) · facing(N·L) · light )
//! u = T·L,  v = T·H
//! ```
//!
//! The sum is over the lights at infinity of an [`Illumination`]. The light from all around is an [`Irradiance`], a polynomial of the normal: a sky and a
//! ground, or all that an [`Environment`] shows, to order 2.
//!
//! # Example
//! ```
//! use glam::DVec3;
//! use pelage_lighting::{DirectionalLight, HairPoint, Illumination, Irradiance, Shading};
//!
//! let shading = Shading::default();
//! let sun = DirectionalLight { direction: DVec3::Y, colour: DVec3::ONE };
//! let light = Illumination { lights: vec![sun], ambient: Irradiance::hemisphere(DVec3::splat(0.3), DVec3::splat(0.1)) };
//! let tip = HairPoint { direction: DVec3::X, normal: DVec3::Y, height: 1.0 };
//! let root = HairPoint { height: 0.0, ..tip };
//! let seen_from = DVec3::new(0.0, 0.6, 0.8);
//! assert!(shading.shade(&light, seen_from, &tip).x > shading.shade(&light, seen_from, &root).x);
//! ```
//!
//! # Sources
//! Kajiya and Kay 1989 (*Rendering fur with three dimensional textures*); Banks 1994 (*Illumination in diverse codimensions*); Goldman
//! 1997 (*Fake fur rendering*); Lengyel 2000 (*Real-time fur*); Lengyel, Praun, Finkelstein and Hoppe 2001 (*Real-time fur over arbitrary
//! surfaces*, section 2.4); Ramamoorthi and Hanrahan 2001 (*An efficient representation for irradiance environment maps*).

mod environment;
mod facing;
mod hair;
mod irradiance;
mod shade;
mod shadow;
mod table;

pub use environment::{Environment, EnvironmentError};
pub use facing::Facing;
pub use hair::{HALF_VECTOR_FADE, HairLighting, HalfVector, half_vector};
pub use irradiance::Irradiance;
pub use shade::{DirectionalLight, HairPoint, Illumination, Shading};
pub use shadow::{DIFFUSIVITY, SelfShadow};
pub use table::{Axis, Deviation, FactorError, LightingTable, TableError, TableLayout};
