//! How far one picture is from another, as numbers a test can bound and a person can read.
//!
//! The crate knows nothing of fur: pictures come in as plain sRGB bytes, numbers come out. The measures of pictures, each over the whole
//! picture or over a *mask* of the pixels that matter:
//!
//! - [`flip`]: the error a person would see when the two pictures alternate on a screen, 0 (none) to 1, per pixel, with mean,
//!   99th percentile and maximum. Standard library code (`nv-flip`), not ours.
//! - [`rmse_linear`]: root mean square error of linear light, for errors of energy that the eye forgives.
//! - [`light_ratio`]: how bright one picture is beside the other as a whole.
//! - [`silhouette`]: alpha across the reference's outline: whether the subject has grown, and whether its edge is softer.
//! - [`heat_picture`], [`difference_picture`]: where it is.
//! - [`field_error`], [`direction_error`]: of what comes before a picture, numbers and directions at places.
//! - [`Sweep`]: the settings of a program with what each costs and errs, as CSV, as JSON and (feature `plot`) as SVG; [`pareto_front`]: which of them are worth their cost.
//! - [`search`]: the cheapest setting within an error, or the one that errs least within a cost, by few evaluations.
//! - [`percentile`]: the nearest-rank percentile of any error values, so that other crates need not each invent one.
//!
//! # Convention
//!
//! A picture is row-major from the top left, three bytes a pixel, sRGB encoded ([`Image`]). A mask has one byte a pixel and counts
//! a pixel where the byte is above zero. The mask is used as it is given: [`union`] and [`dilate`] make the masks that [`flip`]
//! recommends, and nothing is widened behind the caller's back. A mask that counts no pixel is an error
//! ([`AccuracyError::EmptyMask`]), as a mean over nothing that read 0 would pass every bound.
//!
//! # Example
//!
//! ```
//! use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, Image, flip, rmse_linear};
//!
//! let grey = vec![128u8; 16 * 16 * 3];
//! let mut spotted = grey.clone();
//! spotted[3 * (8 * 16 + 8)] = 255; // one pixel redder
//!
//! let reference = Image::new(16, 16, &grey)?;
//! let test = Image::new(16, 16, &spotted)?;
//! let report = flip(reference, test, None, DEFAULT_PIXELS_PER_DEGREE)?;
//! assert!(report.mean > 0.0 && report.mean < report.max);
//! assert_eq!(flip(reference, reference, None, DEFAULT_PIXELS_PER_DEGREE)?.max, 0.0);
//! assert!(rmse_linear(reference, test, None)? > 0.0);
//! # Ok::<(), pelage_accuracy::AccuracyError>(())
//! ```
//!
//! # Features
//!
//! `plot`: the plot of a sweep.
//!
//! # Papers
//!
//! - P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild: *FLIP: A Difference Evaluator for
//!   Alternating Images*, High Performance Graphics 2020.
//! - P. F. Felzenszwalb, D. P. Huttenlocher: *Distance Transforms of Sampled Functions*, Theory of Computing 8, 2012.
//! - IEC 61966-2-1:1999, the sRGB transfer function.

mod distance;
mod error;
mod field;
mod flip;
mod image;
mod light;
mod mask;
mod pareto;
mod percentile;
mod picture;
#[cfg(feature = "plot")]
mod plot;
mod search;
mod silhouette;
mod sweep;

pub use error::AccuracyError;
pub use field::{FieldError, direction_error, field_error};
pub use flip::{DEFAULT_PIXELS_PER_DEGREE, ErrorMap, FlipReport, PIXELS_PER_DEGREE_RANGE, flip};
pub use image::{Image, MAX_PIXELS};
pub use light::{light_ratio, linear_light, rmse_linear};
pub use mask::{dilate, union, unlike_background};
pub use pareto::{pareto_front, unbeaten};
pub use percentile::percentile;
pub use picture::{difference_picture, heat_picture};
#[cfg(feature = "plot")]
pub use plot::Panel;
pub use search::{Found, Goal, MAX_SETTINGS, SearchError, Trial, search};
pub use silhouette::{ProfileBin, Silhouette, silhouette};
pub use sweep::{Column, Group, Row, Sweep};
