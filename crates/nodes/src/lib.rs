//! Every fur node: thin wrappers of the Pelage crates, and the only place where one crate's types become another's.
//!
//! [`registry`] lists the nodes; [`evaluator`] makes an engine that can draw. A program needs nothing else:
//!
//! ```
//! use pelage_graph::{Evaluator, Graph, Request};
//!
//! let graph = Graph::parse(r#"Graph(
//!     version: 1,
//!     nodes: {
//!         "ball":    Sphere(subdivisions: 8),
//!         "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.2),
//!     },
//! )"#)?;
//! let registry = pelage_nodes::registry();
//! let checked = graph.check(&registry)?;
//! let evaluation = Evaluator::new(64 << 20).run(&checked, &Request::output("patches.patches"))?;
//! let tiling = evaluation.get::<pelage_patch::PatchTiling>("patches.patches")?;
//! assert_eq!(tiling.patch_of_face().len(), 1280);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Convention
//! Lengths are fractions of the model's diameter (the diagonal of its bounding box) or of the hair tile's side, angles are degrees, and colours are sRGB as a person picks them;
//! here they become what the crates take.
//!
//! # Features
//! `gpu` (default): drawing. Without it every node but those that make pictures evaluates, and nothing of wgpu is built.

#[cfg(feature = "gpu")]
mod budget;
mod coat;
mod comb;
mod creature;
mod fields;
mod framing;
mod gltf_file;
mod hair;
mod images;
mod light;
mod mesh_edits;
mod models;
pub mod parts;
mod patches;
#[cfg(feature = "gpu")]
mod picture;
#[cfg(feature = "gpu")]
mod reads;
mod reference;
mod registry;
mod shading;
#[cfg(feature = "gpu")]
mod sheet;
mod stats;
#[cfg(feature = "gpu")]
mod turns;

#[cfg(feature = "gpu")]
pub use budget::{Budget, FrameCost, FrameLimit, OtherCoatError, Quality, TableError, TableRow};
pub use coat::{LayFur, LengthsAs, SlantAs};
pub use comb::{CombStroke, CombStrokes, CombTool, StrokePath};
pub use creature::{Animal, BodyPart, CreatureNode, PartFields, PartFur};
pub use fields::{
    BlurColours, BlurField, ColourAmount, ColourMeasure, ColourRamp, ConstantField, DirectionConstraint, DirectionFieldNode,
    DirectionPoint, FieldMath, ImageField, MaskField, MixColours, NoiseField, NoiseLook, Operation, PaintedStroke, PointFlow, RemapCourse,
    RemapField, ScalarRamp, StrokeField, VertexColours,
};
pub use framing::{CameraNode, Framing};
pub use gltf_file::GltfFile;
pub use hair::{
    BlockForm, CoatsInARow, CompressShells, CurlReport, FinDirection, FinImage, FinOfShells, GrowStrands, GuideHair, GuideStrands,
    HairBand, HairGather, HairNoise, HairOffset, HairOpacity, HairPattern, HairStyle, HairTaper, HairUndercoat, ImageShells,
    LevelsOfDetail, MixStrands, NotStraight, OneLayer, OneLayerReport, PatternLook, PatternShells, SampleFin, SampleShells, ShareImages,
    ShellSpacing, TileNoise, TilePattern, TintShells,
};
pub use light::{EnvironmentNode, LightNode};
pub use mesh_edits::{Join, Simplify, Subdivide, Transform};
pub use models::{ObjFile, Plane, RoundedDie, Sphere, Torus};
pub use patches::{GrowPatches, LapPatches};
pub use pelage_reference::Curves;
#[cfg(feature = "gpu")]
pub use pelage_render::{Fragments, FrameStats, Picture, RenderError};
#[cfg(feature = "gpu")]
pub use picture::{DepthMode, FinsOn, FrameReport, Gpu, LightingAt, RenderImage, ShellDetail, TableAxis};
pub use reference::{HairPlacement, StrandCurves};
#[cfg(feature = "gpu")]
pub use reference::{RayReport, ReferenceImage, ShadowsBy};
pub use registry::{evaluator, registry};
pub use shading::HairLightingNode;
#[cfg(feature = "gpu")]
pub use sheet::{Arranged, SideBySide};
pub use stats::{Stats, repair_counts, warnings};
#[cfg(feature = "gpu")]
pub use turns::{Contender, fur_of, time_in_turn};
