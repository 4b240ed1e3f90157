//! Meshes from meshes: finer, coarser, elsewhere, put together. What a mesh has at its vertices and corners goes with them.

mod join;
#[cfg(feature = "simplify")]
mod simplify;
mod subdivide;
mod transform;

pub use join::{JoinError, join};
#[cfg(feature = "simplify")]
pub use simplify::{Simplified, SimplifyError, SimplifySettings, simplify};
pub use subdivide::{MOST_SUBDIVIDED_FACES, SubdivideError, subdivide};
pub use transform::{Transform, TransformError, transform};
