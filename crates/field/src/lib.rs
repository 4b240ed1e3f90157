//! Fields on a surface: one value for each vertex.

mod direction;

pub use direction::DirectionField;
