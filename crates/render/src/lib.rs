//! Shells, fins and skin drawn with wgpu: Lengyel, Praun, Finkelstein and Hoppe 2001, *Real-time fur over arbitrary surfaces*, on the
//! graphics processor.
//!
//! [`Renderer`] draws a [`pelage_coat::Coat`] into a render pass of yours: your device, your target, your depth buffer, your camera.
//! [`Offscreen`] and [`render_picture`] do it without a window, on an adapter that [`Headless`] finds, and give back pixels and figures.
//!
//! # Convention
//! Everything is in coat coordinates ([`pelage_coat`]); a model matrix goes through [`Viewpoint::placed`], with the lights carried over. Depth is reversed (1 near, 0 far) unless the [`Target`] says otherwise. Alpha is premultiplied, blending is linear: use a
//! target in an sRGB or a float format. Where light comes from and what fur makes of it is [`pelage_lighting::Shading`]; the shaders
//! compute the same formula in `f32`, which a test holds them to.
//!
//! # A frame
//! 1. [`Renderer::compute`] picks the edges that carry a fin and the faces of which a shell can be seen, and draws the shadow map where it
//!    is stale; nothing goes back to the processor.
//! 2. Surface, fins, shells, in this order (section 2.3): the skin writes depth; the fins near the silhouette test depth; the shells, innermost first, test
//!    and, as told, write it. Shell *k* of *N* stands at *c_v · k / (N − 1)* unless its [`pelage_coat::ShellLayer`] says otherwise; shell 0 is the skin.
//! 3. Between surface and shells [`Renderer::find_hidden`] may leave out faces that what has been drawn hides.
//!
//! One coat at many places is a [`Crowd`]: a draw for each run of one level of detail.
//!
//! # Limits
//! wgpu's defaults, no features; `TEXTURE_COMPRESSION_BC` for textures in blocks. What each option costs is in the README, measured.
//!
//! # Example
//! A picture of a bare triangle, without a window:
//! ```
//! use std::sync::Arc;
//!
//! use glam::{DVec3, Vec2, Vec3};
//! use pelage_coat::{Background, Camera, Coat, FinEdges, Frame, Irradiance, Light, Lights, MipImage, PatchMesh, ShellTexture, Surface};
//! use pelage_render::{Headless, View, render_picture};
//!
//! # fn main() -> Result<(), pelage_render::RenderError> {
//! let coat = Coat {
//!     frame: Frame { centre: DVec3::ZERO, diameter: 1.0 },
//!     surface: Surface {
//!         positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
//!         normals: vec![Vec3::Z; 3],
//!         offsets: vec![Vec3::ZERO; 3],
//!         bends: vec![Vec3::ZERO; 3],
//!         ends: vec![1.0; 3],
//!         mixes: vec![0.0; 3],
//!         directions: vec![Vec3::Z; 3],
//!         colours: vec![Vec3::ONE; 3],
//!     },
//!     patches: PatchMesh {
//!         vertices: vec![0, 1, 2],
//!         coordinates: vec![Vec2::ZERO, Vec2::X, Vec2::Y],
//!         faces: vec![[0, 1, 2]],
//!         patch_ends: vec![1],
//!         opacities: Vec::new(),
//!     },
//!     edges: FinEdges::default(),
//!     shells: Arc::new(ShellTexture::stack(1, vec![MipImage { width: 1, height: 1, texels: vec![180, 140, 120, 255] }])),
//!     fin: None,
//! };
//! let camera = Camera { eye: 3.0 * Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.8, near: 0.1 };
//! let lights = Lights {
//!     directional: vec![Light { direction: Vec3::Z, colour: Vec3::ONE }],
//!     ambient: Irradiance::hemisphere(Vec3::splat(0.3), Vec3::splat(0.1)),
//! };
//! let background = Background { top: Vec3::splat(0.2), bottom: Vec3::splat(0.1) };
//!
//! let headless = Headless::new()?;
//! let picture = render_picture(&headless, &coat, &View::new(camera, lights), (64, 48), 4, &background)?;
//! assert_eq!(picture.rgba.len(), 64 * 48 * 4);
//! assert!(picture.coverage.contains(&255) && picture.coverage.contains(&0));
//! # Ok(())
//! # }
//! ```

mod attachments;
mod background;
mod bindings;
mod buffers;
mod compute;
mod counts;
mod crowd;
mod error;
mod fins;
mod fragments;
mod frame;
mod frame_groups;
mod furred_faces;
mod gpu_coat;
mod headless;
mod limits;
mod offscreen;
mod pack;
mod picks;
mod picture;
mod pipelines;
mod prepared;
mod pyramid;
mod readback;
mod renderer;
mod resources;
mod schedule;
mod selection;
mod shader;
mod shadow;
mod shared;
mod target;
mod textures;
mod tile_frame;
mod timing;
mod uniforms;
mod view;

pub use crowd::Crowd;
pub use error::RenderError;
pub use fins::{FinEdge, fin_edges, fin_opacity};
pub use fragments::Fragments;
pub use gpu_coat::GpuCoat;
pub use headless::{AdapterSummary, Headless};
pub use offscreen::{Offscreen, TimedFrame, render_picture};
pub use picture::{FrameStats, Picture};
pub use prepared::PreparedView;
pub use renderer::Renderer;
pub use target::{DepthBuffer, Target};
pub use textures::GpuTextures;
pub use timing::{FrameTimes, PassTimes};
pub use view::{Detail, FinRule, LightingMode, March, Options, ShadowOptions, ShellDepth, ShellRange, View, Viewpoint};
