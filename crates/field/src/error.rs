//! Why there is no such field.

/// Why a field cannot be made, and how to mend the input.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// The mesh has no faces.
    #[error("the mesh has no faces, so there is nothing to lay a field on")]
    NoSurface,
    /// The one direction is zero or not finite.
    #[error("the direction is {0}, which points nowhere; give a vector with a finite length other than 0")]
    NoDirection(glam::DVec3),
    /// There are no constraints.
    #[error("there are no constraints; give at least one place with a direction, or one that the fur lies about")]
    NoConstraints,
    /// A constraint's direction is zero or not finite.
    #[error("constraint {constraint} points along {along}, which is nowhere; give a vector with a finite length other than 0")]
    ConstraintDirection {
        /// The constraint, from 0.
        constraint: usize,
        /// Its direction.
        along: glam::DVec3,
    },
    /// A constraint's place is not finite.
    #[error("constraint {constraint} is at {at}, which is no place; mend its coordinates")]
    ConstraintPlace {
        /// The constraint, from 0.
        constraint: usize,
        /// Its place.
        at: glam::DVec3,
    },
    /// A point constraint's place is not finite.
    #[error("point {constraint} is at {at}, which is no place; mend its coordinates")]
    PointPlace {
        /// The point constraint, from 0.
        constraint: usize,
        /// Its place.
        at: glam::DVec3,
    },
    /// A point constraint's turn is not finite.
    #[error("point {constraint} is turned by {angle}, which is no angle; give a finite number of radians")]
    PointTurn {
        /// The point constraint, from 0.
        constraint: usize,
        /// Its angle.
        angle: f64,
    },
    /// The axis of a saddle is zero or not finite.
    #[error("point {constraint} is a saddle along {along}, which is nowhere; give a vector with a finite length other than 0")]
    PointDirection {
        /// The point constraint, from 0.
        constraint: usize,
        /// Its axis.
        along: glam::DVec3,
    },
    /// The radius of the Gaussians is out of range.
    #[error("the radius is {0}; give a fraction of the model's diameter from 0.001 to 100")]
    Radius(f64),
    /// A field has another number of values than the mesh has vertices, or than the field it is joined with.
    #[error("{values} values where {expected} are needed, one for each vertex; make both for the same mesh")]
    Length {
        /// Values there are.
        values: usize,
        /// Values needed.
        expected: usize,
    },
    /// A value is NaN or infinite.
    #[error("the value at vertex {vertex} is not finite; mend the number or formula that it comes from")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A stroke is out of range.
    #[error("the stroke cannot be made: {what}")]
    Stroke {
        /// What is wrong, and what is needed.
        what: &'static str,
    },
    /// A stroke leaves the surface.
    #[error(
        "on its way to place {place} the stroke is at {at}, {distance} from the surface, further than its radius of {radius}; move it to the surface, or widen it"
    )]
    StrokeOff {
        /// The place of its path that it goes to, from 0.
        place: usize,
        /// Where it is.
        at: glam::DVec3,
        /// How far from the surface, in model units.
        distance: f64,
        /// Its radius, in model units.
        radius: f64,
    },
    /// An image is sampled for a mesh that has no texture coordinates.
    #[error("the mesh has no texture coordinates to look an image up with; give each face corner a pair, or use a field without an image")]
    NoTextureCoordinates,
    /// An image's bytes do not fit its size.
    #[error("an image of {width} × {height} RGBA8 pixels needs {expected} bytes and at least one pixel, not {bytes} bytes")]
    ImageSize {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Bytes given.
        bytes: usize,
        /// Bytes needed.
        expected: u64,
    },
}
