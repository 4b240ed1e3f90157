//! What can be wrong with the pictures, masks and numbers given.

use thiserror::Error;

/// What was wrong with an input, and how to mend it.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum AccuracyError {
    /// A picture without a single pixel.
    #[error("a picture of {width}×{height} pixels has nothing to compare: give it at least one row and one column")]
    NoPixels {
        /// Width given, in pixels.
        width: u32,
        /// Height given, in pixels.
        height: u32,
    },
    /// A picture beyond [`MAX_PIXELS`](crate::MAX_PIXELS).
    #[error("a picture of {width}×{height} pixels is beyond the {limit} that can be compared at once: compare it in tiles")]
    TooManyPixels {
        /// Width given, in pixels.
        width: u32,
        /// Height given, in pixels.
        height: u32,
        /// The most pixels accepted.
        limit: u32,
    },
    /// The bytes of a picture do not match its size.
    #[error("a picture of {width}×{height} pixels needs {expected} bytes of RGB, {found} were given: is there an alpha channel to drop?")]
    WrongLength {
        /// Width given, in pixels.
        width: u32,
        /// Height given, in pixels.
        height: u32,
        /// Bytes that a picture of this size has.
        expected: usize,
        /// Bytes that were given.
        found: usize,
    },
    /// Two pictures of different sizes.
    #[error(
        "the reference is {}×{} pixels and the test {}×{}: render both at one size, a resampled picture measures the resampling",
        reference.0, reference.1, test.0, test.1
    )]
    SizeMismatch {
        /// Width and height of the reference.
        reference: (u32, u32),
        /// Width and height of the test picture.
        test: (u32, u32),
    },
    /// A mask, or a map, that does not have one value a pixel.
    #[error("{expected} pixels need a mask of as many bytes, {found} were given")]
    MaskLength {
        /// Pixels of the picture, or bytes of the other mask.
        expected: usize,
        /// Bytes of the mask.
        found: usize,
    },
    /// No pixel counts, so that no mean exists.
    #[error("the mask of {pixels} pixels counts none of them: is the subject in the picture?")]
    EmptyMask {
        /// Pixels of the mask.
        pixels: usize,
    },
    /// A viewing condition outside [`PIXELS_PER_DEGREE_RANGE`](crate::PIXELS_PER_DEGREE_RANGE).
    #[error("{found} pixels per degree is outside {low} to {high}, where FLIP's filters are well defined")]
    PixelsPerDegree {
        /// The value given.
        found: f32,
        /// Smallest value accepted.
        low: f32,
        /// Largest value accepted.
        high: f32,
    },
    /// A percentile of no values.
    #[error("a percentile needs at least one value")]
    NoValues,
    /// A percentile that is not a fraction.
    #[error("{found} is not a fraction from 0 to 1: the 99th percentile is 0.99")]
    NotAFraction {
        /// The value given.
        found: f64,
    },
    /// A picture that is opaque all over, or nowhere, has no outline.
    #[error("{opaque} of {pixels} pixels are opaque, so that there is no outline: is the subject whole in the picture?")]
    NoOutline {
        /// Pixels whose alpha is one half or more.
        opaque: usize,
        /// All pixels.
        pixels: usize,
    },
    /// Two fields of different sizes.
    #[error("the reference has values at {reference} places and the test at {test}: compare them on one mesh")]
    FieldLength {
        /// Values of the reference.
        reference: usize,
        /// Values of the test.
        test: usize,
    },
    /// A row of a sweep that does not fit its columns.
    #[error("row {row} of the sweep has {found} values for {expected} columns")]
    RowLength {
        /// Which row, from 0.
        row: usize,
        /// How many columns there are.
        expected: usize,
        /// How many values the row has.
        found: usize,
    },
    /// A column that a sweep does not have.
    #[error("the sweep has no column {name:?}; it has {known}")]
    NoSuchColumn {
        /// What was asked for.
        name: String,
        /// Those there are.
        known: String,
    },
    /// A plot that could not be drawn.
    #[error("the plot could not be drawn: {0}")]
    Plot(String),
}
