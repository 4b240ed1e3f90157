//! Fields on the surface.

mod arithmetic;
mod blur;
mod colours;
mod constant;
mod directions;
mod image;
mod noise;
mod ramps;
mod remap;
mod strokes;

pub use arithmetic::{FieldMath, Operation};
pub use blur::{BlurColours, BlurField};
pub use colours::{ColourAmount, ColourMeasure, MixColours, VertexColours};
pub use constant::ConstantField;
pub use directions::{DirectionConstraint, DirectionFieldNode, DirectionPoint, PointFlow};
pub use image::ImageField;
pub use noise::{NoiseField, NoiseLook};
pub use ramps::{ColourRamp, ScalarRamp};
pub use remap::{MaskField, RemapCourse, RemapField};
pub use strokes::{PaintedStroke, StrokeField};
