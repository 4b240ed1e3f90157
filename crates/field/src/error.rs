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
    /// An image's pixels do not fit its size.
    #[error("an image of {width} × {height} pixels needs {expected} numbers, four for each, and at least one pixel, not {numbers} numbers")]
    ImageSize {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Numbers given.
        numbers: usize,
        /// Numbers needed.
        expected: u64,
    },
    /// Colours are wanted of a mesh that has none.
    #[error("the mesh has no colours of its own; read a model with a colour for each vertex, or use a field without them")]
    NoColours,
    /// A setting of a field by formula is out of its range.
    #[error("{parameter} is {value}; give a number from {least} to {most}")]
    Setting {
        /// The setting.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The least it may be.
        least: f64,
        /// The most it may be.
        most: f64,
    },
    /// A range that starts where it ends.
    #[error("the range to map from starts and ends at {0}; give it two different ends")]
    EmptyRange(f64),
    /// The points of a curve do not rise.
    #[error("point {point} of the curve is at {at}, which is not after the one before; give at least two points, from left to right")]
    CurvePoint {
        /// The point, from 0.
        point: usize,
        /// Where it is.
        at: f64,
    },
    /// A stroke without a point.
    #[error("stroke {stroke} has no point; give it one, or remove it")]
    EmptyStroke {
        /// The stroke, from 0.
        stroke: usize,
    },
    /// A number of a stroke is NaN, infinite or out of range.
    #[error("stroke {stroke}: {parameter} is {value}; give a number from {least} to {most}")]
    StrokeSetting {
        /// The stroke, from 0.
        stroke: usize,
        /// Which number.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The least it may be.
        least: f64,
        /// The most it may be.
        most: f64,
    },
    /// A stroke's point is no place.
    #[error("stroke {stroke}: point {point} is at {at}, which is no place; mend its coordinates")]
    StrokePlace {
        /// The stroke, from 0.
        stroke: usize,
        /// The point, from 0.
        point: usize,
        /// Where it is.
        at: glam::DVec3,
    },
    /// A stroke's point is not on the surface.
    #[error(
        "stroke {stroke}: point {point}, at {at}, is {distance} diameters off the surface, more than the stroke's radius of {radius};          move it onto the surface, or make the stroke wider"
    )]
    StrokeOffSurface {
        /// The stroke, from 0.
        stroke: usize,
        /// The point, from 0.
        point: usize,
        /// Where it is.
        at: glam::DVec3,
        /// How far off, in diameters.
        distance: f64,
        /// The stroke's radius, in diameters.
        radius: f64,
    },
    /// A stroke leaves the surface between two points.
    #[error(
        "stroke {stroke}: half-way between points {point} and {} it is {distance} diameters off the surface, more than its radius of {radius};          put points between them", point + 1
    )]
    StrokeLeavesSurface {
        /// The stroke, from 0.
        stroke: usize,
        /// The point before, from 0.
        point: usize,
        /// How far off at most, in diameters.
        distance: f64,
        /// The stroke's radius, in diameters.
        radius: f64,
    },
    /// A stroke is too long for its width.
    #[error("stroke {stroke} is {radii} radii long, more than {most}; cut it in pieces, or make it wider")]
    StrokeTooLong {
        /// The stroke, from 0.
        stroke: usize,
        /// Its length over its radius.
        radii: f64,
        /// The most that is painted.
        most: f64,
    },
    /// No vertex is within reach of a stroke.
    #[error(
        "stroke {stroke} passes between the vertices without reaching one: its radius is {radius} diameters and the faces there have sides of {side};          make it wider, or subdivide the mesh"
    )]
    StrokeBetweenVertices {
        /// The stroke, from 0.
        stroke: usize,
        /// Its radius, in diameters.
        radius: f64,
        /// The longest side of the face where it starts, in diameters.
        side: f64,
    },
    /// The system of equations could not be solved.
    #[error(
        "the field could not be blurred: the mesh's equations have no solution in the range of numbers; mend faces of extreme shape, or blur less"
    )]
    Unsolved,
}

/// Whether a setting is in its range.
pub(crate) fn check(parameter: &'static str, value: f64, (least, most): (f64, f64)) -> Result<(), FieldError> {
    if (least..=most).contains(&value) { Ok(()) } else { Err(FieldError::Setting { parameter, value, least, most }) }
}
