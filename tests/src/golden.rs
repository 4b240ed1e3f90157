//! Pictures kept to compare with.

use std::path::PathBuf;

use image::{ImageBuffer, Rgb, RgbImage};
use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, FlipReport, Image, flip, heat_picture};
use pelage_nodes::Picture;

use crate::{Error, repository};

/// How far a picture may be from the one kept: FLIP over the furred area, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Of the mean.
    pub mean: f64,
    /// Of the 99th percentile.
    pub p99: f64,
}

impl Bounds {
    /// What every kept picture is held to, on any driver and processor: below the least of the seeded defects, which `seeded_defects.rs` holds it to.
    pub const KEPT: Self = Self { mean: 0.002, p99: 0.009 };
}

/// How far it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// FLIP's mean over the furred area.
    pub mean: f64,
    /// FLIP's 99th percentile there.
    pub p99: f64,
}

impl Comparison {
    fn of(report: &FlipReport) -> Self {
        Self { mean: report.mean, p99: report.p99 }
    }

    /// Whether it keeps both bounds.
    pub fn within(&self, bounds: Bounds) -> bool {
        self.mean <= bounds.mean && self.p99 <= bounds.p99
    }
}

/// The picture kept of a graph.
pub struct Golden {
    name: String,
    picture: RgbImage,
}

impl Golden {
    /// Where the picture of a graph is kept.
    pub fn path(name: &str) -> PathBuf {
        repository().join(format!("tests/goldens/{name}.png"))
    }

    /// Reads it.
    ///
    /// # Errors
    /// Where it is missing: that is a failure, never an occasion to write it.
    pub fn read(name: &str) -> Result<Self, Error> {
        let path = Self::path(name);
        let picture = image::open(&path).map_err(|error| {
            format!(
                "{}: {error}; draw it with `cargo run --release -p pelage-tests --example goldens -- {name}` and look at it",
                path.display()
            )
        })?;
        Ok(Self { name: name.into(), picture: picture.into_rgb8() })
    }

    /// Keeps a picture as a graph's golden.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn keep(name: &str, picture: &Picture) -> Result<PathBuf, Error> {
        let path = Self::path(name);
        std::fs::create_dir_all(repository().join("tests/goldens"))?;
        save(&path, picture, opaque(picture))?;
        Ok(path)
    }

    /// Compares over the pixels that either picture covers with skin or fur: the golden's are not kept, so those that differ from the
    /// test's background count by the test's coverage and the golden's difference alike.
    ///
    /// # Errors
    /// Where sizes differ.
    pub fn compare(&self, picture: &Picture) -> Result<Comparison, Error> {
        let rgb = opaque(picture);
        Ok(Comparison::of(&self.flip(picture, &rgb)?.0))
    }

    /// Compares; where a bound is passed, writes the picture and the difference beside the golden and says so.
    ///
    /// # Errors
    /// Where sizes differ, or a bound is passed.
    pub fn expect(&self, picture: &Picture, bounds: Bounds) -> Result<Comparison, Error> {
        let rgb = opaque(picture);
        let (report, mask) = self.flip(picture, &rgb)?;
        let comparison = Comparison::of(&report);
        if comparison.within(bounds) {
            return Ok(comparison);
        }
        let beside = |suffix: &str| Self::path(&format!("{}-{suffix}", self.name));
        save(&beside("actual"), picture, rgb)?;
        save(&beside("difference"), picture, heat_picture(&report.map, Some(&mask))?)?;
        Err(format!(
            "{}: FLIP mean {:.5}, 99th percentile {:.5}, past {bounds:?}; see {}",
            self.name,
            comparison.mean,
            comparison.p99,
            beside("difference").display()
        )
        .into())
    }

    /// FLIP over the furred area, and that area.
    fn flip(&self, picture: &Picture, rgb: &[u8]) -> Result<(FlipReport, Vec<u8>), Error> {
        let reference = Image::new(self.picture.width(), self.picture.height(), self.picture.as_raw())?;
        let steady = rounded(self.picture.as_raw(), rgb);
        let test = Image::new(picture.width, picture.height, &steady)?;
        let mask = furred(self.picture.as_raw(), rgb, &picture.coverage);
        Ok((flip(reference, test, Some(&mask), DEFAULT_PIXELS_PER_DEGREE)?, mask))
    }
}

/// The test's bytes, with the golden's where they are next to it: a software adapter compiles for the processor it finds, and one with other instructions rounds a tenth of all bytes
/// to the other side. FLIP sees that, past the bounds; a defect is more than one byte's step.
fn rounded(golden: &[u8], test: &[u8]) -> Vec<u8> {
    golden.iter().zip(test).map(|(&golden, &test)| if golden.abs_diff(test) <= 1 { golden } else { test }).collect()
}

/// The furred area of both pictures: what the test covers, and what differs outside it, since there the golden was covered.
fn furred(golden: &[u8], test: &[u8], coverage: &[u8]) -> Vec<u8> {
    let pixels = golden.chunks_exact(3).zip(test.chunks_exact(3)).zip(coverage);
    pixels
        .map(|((golden, test), &coverage)| if coverage > 0 || golden.iter().zip(test).any(|(a, b)| a.abs_diff(*b) > 2) { 255 } else { 0 })
        .collect()
}

/// A picture's pixels without alpha.
fn opaque(picture: &Picture) -> Vec<u8> {
    picture.rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}

fn save(path: &std::path::Path, picture: &Picture, rgb: Vec<u8>) -> Result<(), Error> {
    let image: ImageBuffer<Rgb<u8>, _> =
        ImageBuffer::from_raw(picture.width, picture.height, rgb).ok_or("the pixels do not fill the picture")?;
    Ok(image.save(path)?)
}
