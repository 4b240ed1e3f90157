//! Image files.

use std::io::Cursor;
use std::path::Path;

use image::error::{ImageError, LimitErrorKind};
use image::{DynamicImage, ImageReader, Limits, RgbaImage};
use pelage_field::{FieldError, Image};

/// The most pixels along a side.
const MOST_PIXELS: u32 = 16_384;

/// The most bytes that decoding may take: those of the largest image with 16 bits a channel.
const MOST_BYTES: u64 = 8 * (MOST_PIXELS as u64) * (MOST_PIXELS as u64);

/// Why an image file cannot be used.
#[derive(Debug, thiserror::Error)]
pub(crate) enum PixelsError {
    /// It cannot be opened.
    #[error("{name}: the image cannot be read: {cause}")]
    Unreadable { name: String, cause: std::io::Error },
    /// It has too many pixels.
    #[error("{name}: the image is larger than {MOST_PIXELS} × {MOST_PIXELS} pixels; make it smaller")]
    TooLarge { name: String },
    /// It is no image, or broken.
    #[error("{name}: {cause}; give a PNG or JPEG file")]
    Broken { name: String, cause: ImageError },
}

/// A decoded image, with as many bits as its file has.
#[derive(Debug)]
pub(crate) struct Pixels(DynamicImage);

impl Pixels {
    /// Reads a PNG or JPEG file, whatever its name ends in.
    pub(crate) fn read(path: &Path) -> Result<Self, PixelsError> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|cause| PixelsError::Unreadable { name: name.clone(), cause })?;
        Self::decode(&bytes, &name)
    }

    /// Decodes the bytes of a file.
    pub(crate) fn decode(bytes: &[u8], name: &str) -> Result<Self, PixelsError> {
        let broken = |cause| match cause {
            ImageError::Limits(error) if !matches!(error.kind(), LimitErrorKind::Unsupported { .. }) => {
                PixelsError::TooLarge { name: name.to_owned() }
            }
            cause => PixelsError::Broken { name: name.to_owned(), cause },
        };
        let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| broken(error.into()))?;
        let mut limits = Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(MOST_PIXELS), Some(MOST_PIXELS));
        limits.max_alloc = Some(MOST_BYTES);
        reader.limits(limits);
        let image = reader.decode().map_err(broken)?;
        let deep = image.color().bits_per_pixel() / u16::from(image.color().channel_count()) > 8;
        Ok(Self(if deep { image.into_rgba16().into() } else { image.into_rgba8().into() }))
    }

    /// Eight bits a channel.
    pub(crate) fn into_rgba8(self) -> RgbaImage {
        self.0.into_rgba8()
    }

    /// To look colours up in.
    pub(crate) fn image(&self) -> Result<Image<'_>, FieldError> {
        match &self.0 {
            DynamicImage::ImageRgba16(pixels) => Image::rgba16(pixels.as_raw(), pixels.width(), pixels.height()),
            other => Image::rgba8(other.as_bytes(), other.width(), other.height()),
        }
    }
}
