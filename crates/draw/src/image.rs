//! Pictures made of pixels.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};
use thiserror::Error;

use super::Drawing;
use super::number::tenths;

/// A picture made of pixels, shown pixel by pixel and never blurred.
///
/// ```
/// use tolman_draw::{Figure, Image};
///
/// let red_and_blue = Image::rgb(2, 1, &[255, 0, 0, 0, 0, 255])?;
/// let figure = Figure::new("pixels", "Two pixels", red_and_blue.drawing("Red beside blue.", 80.0));
/// assert!(figure.standalone().contains("data:image/png;base64,"));
/// # Ok::<(), tolman_draw::ImageError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    png: Vec<u8>,
}

/// Reason why pixels do not form a picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImageError {
    /// The number of values does not fit the size.
    #[error("{found} values for {width} × {height} pixels of {channels}; give {expected}")]
    Size {
        /// Number of pixels in a row.
        width: u32,
        /// Number of rows.
        height: u32,
        /// Number of values per pixel: 1 or 3.
        channels: u32,
        /// Number of values expected.
        expected: u64,
        /// Number of values found.
        found: usize,
    },
    /// The PNG encoder refuses the picture.
    #[error("{width} × {height} pixels cannot be written as PNG; give fewer")]
    Png {
        /// Number of pixels in a row.
        width: u32,
        /// Number of rows.
        height: u32,
        /// Error of the PNG encoder.
        source: png::EncodingError,
    },
}

impl Image {
    /// Returns a picture with one value per pixel, 0 black and 255 white, row by row from the top
    /// left.
    ///
    /// # Errors
    /// If there are not `width` × `height` values, or zero.
    pub fn grey(width: u32, height: u32, pixels: &[u8]) -> Result<Self, ImageError> {
        Self::new(width, height, 1, png::ColorType::Grayscale, pixels)
    }

    /// Returns a picture with red, green and blue for each pixel, row by row from the top left.
    ///
    /// # Errors
    /// If there are not `width` × `height` × 3 values, or zero.
    pub fn rgb(width: u32, height: u32, pixels: &[u8]) -> Result<Self, ImageError> {
        Self::new(width, height, 3, png::ColorType::Rgb, pixels)
    }

    fn new(
        width: u32,
        height: u32,
        channels: u32,
        colour: png::ColorType,
        pixels: &[u8],
    ) -> Result<Self, ImageError> {
        let expected = u64::from(width) * u64::from(height) * u64::from(channels);
        if expected != pixels.len() as u64 || expected == 0 {
            return Err(ImageError::Size {
                width,
                height,
                channels,
                expected,
                found: pixels.len(),
            });
        }
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, width, height);
        encoder.set_color(colour);
        encoder.set_depth(png::BitDepth::Eight);
        let written = encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(pixels));
        written.map_err(|source| ImageError::Png {
            width,
            height,
            source,
        })?;
        Ok(Self { width, height, png })
    }

    /// Returns the picture, `width` user units wide. `description` describes it in words.
    pub fn drawing(&self, description: impl Into<String>, width: f64) -> Drawing {
        let height = width * f64::from(self.height) / f64::from(self.width);
        Drawing {
            width,
            height,
            description: description.into(),
            body: self.element(None, (width, height)),
        }
    }

    /// Returns the picture as an element, with its top left corner, if it is not the origin, and
    /// its size in user units.
    pub(super) fn element(
        &self,
        corner: Option<(f64, f64)>,
        (width, height): (f64, f64),
    ) -> Markup {
        let data = format!("data:image/png;base64,{}", STANDARD.encode(&self.png));
        let (x, y) = corner.map(|(x, y)| (tenths(x), tenths(y))).unzip();
        html! {
            image class="pixels" href=(data) x=[x] y=[y] width=(tenths(width)) height=(tenths(height))
                preserveAspectRatio="none" {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_survive() {
        let pixels: Vec<u8> = (0..=255).cycle().take(30 * 40 * 3).collect();
        let image = Image::rgb(30, 40, &pixels).unwrap();
        let decoder = png::Decoder::new(std::io::Cursor::new(&image.png));
        let mut reader = decoder.read_info().unwrap();
        let mut read = vec![0; pixels.len()];
        reader.next_frame(&mut read).unwrap();
        assert_eq!(read, pixels);
        let drawing = image.drawing("a test", 90.0);
        assert!((drawing.height - 120.0).abs() < 1e-9);
    }

    #[test]
    fn other_numbers_of_values_are_refused() {
        for (width, height, count) in [(2, 2, 3), (0, 4, 0), (u32::MAX, u32::MAX, 1)] {
            let refused = Image::grey(width, height, &vec![0; count]);
            assert!(matches!(refused, Err(ImageError::Size { .. })));
        }
    }
}
