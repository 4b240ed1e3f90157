//! The geometric ground truth of a coat: the real strands laid on its surface, ray cast.
//!
//! Every approximation of fur, shells, fins, mips, levels of detail, is measured against the hair itself. Here the strands of the tile are laid on the surface
//! through the inverse of the patches' tile coordinates, as tapered segments in an `obvhs` hierarchy, and looked at with many rays a pixel; camera, lights and
//! the lighting formula are those of the renderer, in `f64`. It knows no texture of hair and shares no code with whoever makes them.
//!
//! # Convention
//! Coat coordinates ([`pelage_coat`]): a diameter of 1, right-handed, y up. Colours are linear light. A place of *shell space* is a face, barycentric coordinates
//! *β* and a height *h* from 0 at the skin to 1 at the tips; it is at
//!
//! ```text
//! S(β, h) = Σ β_i (p_i + c_i h + b_i (h² − h))
//! ```
//!
//! with the skin's places *p*, offsets *c* and bends *b* at the face's corners, which is where a renderer draws the shell of height *h*. *β* is the inverse of the
//! face's tile coordinates, linear in them; *h* is the height in the tile over that of its box.
//!
//! # Two truths
//! [`Placement::Shell`] is what infinitely many shells of infinite resolution would draw: all copies of the tile's hair, of each what is inside of the part of shell
//! space of the faces of a patch, and so cut at the patch's outline. [`Placement::Free`] lays each hair whole whose root is on a face: its way over the surface goes on as that face's linear map has
//! it, with the curve, colour and skin normal of its root. Their difference is what seams cost.
//!
//! # What a hair is
//! - **Round cones**: a segment is the hull of two spheres, so that joints have no gaps; met in `f64`, kept in `f32`.
//! - **Radius**: the strand's, in tile sides, times the side of a tile on the shell of that height: of the square with the same area, √(area of the shell's triangle /
//!   area of the tile's). A tile that is stretched one way keeps round hairs, of the mean width.
//! - **There by chance**: hair that lets light through is met with the probability of its opacity at that place along it (stochastic transparency: E. Enderton and others
//!   2010), and so is fur shorter than a thousandth of the diameter, which is there in part, as in the renderer. The chance is drawn anew for each ray from the eye, and once for
//!   all of a hair: a ray that meets it twice meets it once. Opaque hair draws nothing.
//! - **Of coats in a row** a hair is there where the surface's `mixes` say that it stands ([`StrandTile::row`](pelage_strand::StrandTile::row)): in shell space place by place, free hair by its root.
//! - **Cut** in shell space exactly: at outlines, where the coat's `ends` are, and at the outermost shell, and rays meet the cut. Free hair is cut at its axis, with a
//!   round end.
//! - **Straight** segments keep within [`Laying::tolerance`] radii of the true curve, in the tile and once more on the surface.
//! - **Lit** by its own tangent, the skin's normal and colour under its axis, its own colour, at the height of the place that is seen, which on top of a thick hair is
//!   higher than its axis; see [`Shadows`] for what shades it.
//!
//! # Cost
//! 80 bytes a segment and up to 68 for boxes. See the book's page for rays a second.
//!
//! # Example
//! One upright hair on a triangle, seen from the side:
//! ```
//! use std::sync::Arc;
//!
//! use glam::{DVec3, Vec2, Vec3};
//! use pelage_coat::{Camera, Coat, FinEdges, Frame, Lights, MipImage, PatchMesh, ShellTexture, Surface};
//! use pelage_reference::{Laying, Scene, Settings, View, quiet};
//! use pelage_strand::{StrandSource, StrandTile};
//!
//! let surface = Surface {
//!     positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
//!     normals: vec![Vec3::Z; 3],
//!     offsets: vec![0.5 * Vec3::Z; 3],
//!     bends: vec![Vec3::ZERO; 3],
//!     ends: vec![1.0; 3],
//!     mixes: vec![0.0; 3],
//!     directions: vec![Vec3::Z; 3],
//!     colours: vec![Vec3::ONE; 3],
//! };
//! let coordinates = vec![Vec2::ZERO, Vec2::X, Vec2::Y];
//! let patches = PatchMesh { vertices: vec![0, 1, 2], coordinates, faces: vec![[0, 1, 2]], patch_ends: vec![1], opacities: Vec::new() };
//! let skin = MipImage { width: 1, height: 1, texels: vec![180, 140, 120, 255] };
//! let coat = Coat {
//!     frame: Frame { centre: DVec3::ZERO, diameter: 1.0 },
//!     surface,
//!     patches,
//!     edges: FinEdges::default(),
//!     shells: Arc::new(ShellTexture::stack(1, vec![skin])),
//!     fin: None,
//! };
//! let hair = StrandSource { points: vec![[0.25, 0.25, 0.0], [0.25, 0.25, 1.0]], radii: vec![0.05; 2], root_colour: [1.0; 3], tip_colour: [1.0; 3] };
//! let tile = StrandTile::from_strands(1.0, &[hair])?;
//!
//! let scene = Scene::new(&coat, &tile, &Laying::default())?;
//! assert_eq!((scene.counts().segments, scene.counts().triangles), (1, 1));
//! let camera = Camera { eye: Vec3::new(0.25, -3.0, 0.25), target: Vec3::new(0.25, 0.25, 0.25), up: Vec3::Z, field_of_view: 0.2, near: 0.01 };
//! let view = View { camera, lights: Lights::default(), shading: Default::default() };
//! let image = scene.render(&view, &Settings { size: (33, 33), ..Settings::default() }, &quiet)?;
//! assert_eq!(image.pixels[33 * 16 + 16][3], 1.0, "the hair is in the middle");
//! assert_eq!(image.pixels[33 * 16 + 1][3], 0.0, "and not beside it");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Sources
//! Lengyel, Praun, Finkelstein and Hoppe 2001 (*Real-time fur over arbitrary surfaces*: the tile, the patches, the lighting); I. Quilez (*Intersectors*: the rounded
//! cone); B. Burley 2020 (*Practical hash-based Owen scrambling*: where rays go); P. Shirley and others on box-filtered distribution ray tracing, after Cook 1984.

mod clip;
mod cone;
mod curves;
mod error;
mod eye;
mod face;
#[cfg(test)]
mod fixture;
mod hair;
mod image;
mod lay;
mod ray;
mod render;
mod sampler;
mod scene;
mod segment;
mod settings;
mod shade;
mod tree;
mod triangle;

pub use curves::Curves;
pub use error::{FARTHEST, MOST_SEGMENTS, MOST_TILES, ReferenceError};
pub use image::Image;
pub use scene::{Counts, Scene};
pub use settings::{Laying, Placement, Progress, Settings, Shadows, SkinColours, View, quiet};
