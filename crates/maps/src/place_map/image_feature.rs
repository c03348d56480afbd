use alloc::vec::Vec;

use tolman_robot::Picture;

use super::ColourSpace;

/// Conversion of a picture to features: it is made smaller by averaging boxes of pixels, then
/// converted (section 3.4, "Features").
///
/// The order is the paper's: "the camera images were reduced in size and converted to hsv". So
/// boxes are averaged in red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ImageFeature {
    /// Number of pixels across, at least 1.
    pub width: u32,
    /// Number of pixels down, at least 1.
    pub height: u32,
    /// Colour space of the pixels.
    pub colours: ColourSpace,
}

impl ImageFeature {
    /// Returns 40 × 30 pixels, the smaller of the paper's two sizes.
    #[must_use]
    pub const fn small(colours: ColourSpace) -> Self {
        Self {
            width: 40,
            height: 30,
            colours,
        }
    }

    /// Returns 80 × 60 pixels, the larger of the paper's two sizes.
    #[must_use]
    pub const fn large(colours: ColourSpace) -> Self {
        Self {
            width: 80,
            height: 60,
            colours,
        }
    }

    /// Returns the number of values of an image: three per pixel.
    #[must_use]
    pub const fn len(self) -> usize {
        3 * self.width as usize * self.height as usize
    }

    /// Returns whether an image has no pixels, and so no values.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// Returns the values of a picture, three per pixel, row by row from the top left: the left of
    /// the picture stays on the left. Boxes that end within a pixel count their share of it.
    /// O(pixels of the picture × boxes over each).
    pub(super) fn values(self, picture: &Picture) -> Vec<f32> {
        let columns = boxes(picture.width, self.width);
        let rows = boxes(picture.height, self.height);
        let mut values = Vec::with_capacity(self.len());
        for row in &rows {
            for column in &columns {
                values.extend(self.colours.values(mean_colour(picture, column, row)));
            }
        }
        values
    }

    /// Returns the red, green and blue of each pixel of values.
    pub(super) fn pixels(self, values: &[f32]) -> Vec<[u8; 3]> {
        let (pixels, _) = values.as_chunks::<3>();
        let pixels = pixels.iter().map(|pixel| self.colours.colour(*pixel));
        pixels.collect()
    }
}

/// A source pixel and its share of the box.
type Part = (u32, f32);

/// Cuts `source` pixels into `target` boxes of one size.
fn boxes(source: u32, target: u32) -> Vec<Vec<Part>> {
    let size = f64::from(source) / f64::from(target.max(1));
    let parts = |index: u32| {
        let (from, to) = (f64::from(index) * size, f64::from(index + 1) * size);
        let last = (libm::ceil(to) as u32).min(source);
        let part = move |pixel: u32| {
            let covered = to.min(f64::from(pixel) + 1.0) - from.max(f64::from(pixel));
            (pixel, (covered / size) as f32)
        };
        let parts = (libm::floor(from) as u32..last).map(part);
        parts.filter(|(_, share)| *share > 1e-6).collect()
    };
    (0..target).map(parts).collect()
}

/// Returns the mean red, green and blue of a box, 0 to 1.
fn mean_colour(picture: &Picture, columns: &[Part], rows: &[Part]) -> [f32; 3] {
    let mut mean = [0.0; 3];
    for (row, down) in rows {
        for (column, across) in columns {
            let colour = picture.pixel(*column, *row).unwrap_or_default();
            for (mean, value) in mean.iter_mut().zip(colour) {
                *mean += down * across * f32::from(value) / 255.0;
            }
        }
    }
    mean
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use tolman_robot::pioneer_2dx;

    use super::*;

    fn picture(width: u32, height: u32, colour: impl Fn(u32, u32) -> [u8; 3]) -> Picture {
        let mut picture = Picture::black(width, height, pioneer_2dx::CAMERA);
        let places = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        picture.pixels = places.map(|(column, row)| colour(column, row)).collect();
        picture
    }

    #[test]
    fn boxes_are_averaged() {
        let stripes = picture(80, 60, |column, _| [255 * (column % 2) as u8, 0, 51]);
        let values = ImageFeature::small(ColourSpace::Rgb).values(&stripes);
        assert_eq!(values.len(), 3600);
        for pixel in values.as_chunks::<3>().0 {
            for (value, expect) in pixel.iter().zip([0.5, 0.0, 0.2]) {
                assert!((value - expect).abs() < 1e-6, "{pixel:?}");
            }
        }
    }

    #[test]
    fn boxes_that_end_within_a_pixel_take_their_share() {
        assert_eq!(
            boxes(3, 2),
            [
                vec![(0, 2.0 / 3.0), (1, 1.0 / 3.0)],
                vec![(1, 1.0 / 3.0), (2, 2.0 / 3.0)]
            ]
        );
        for (source, target) in [(80, 40), (100, 30), (7, 5), (5, 7)] {
            for parts in boxes(source, target) {
                let sum: f32 = parts.iter().map(|(_, share)| share).sum();
                assert!((sum - 1.0).abs() < 1e-5, "{source} {target}");
            }
        }
    }

    #[test]
    fn the_left_stays_on_the_left() {
        let halves = picture(80, 60, |column, row| {
            let red = if column < 40 { 200 } else { 0 };
            let blue = if row < 30 { 100 } else { 0 };
            [red, 0, blue]
        });
        for feature in [
            ImageFeature::small(ColourSpace::Rgb),
            ImageFeature::small(ColourSpace::Hsv),
            ImageFeature::large(ColourSpace::Hsv),
        ] {
            let pixels = feature.pixels(&feature.values(&halves));
            assert_eq!(pixels[0], [200, 0, 100], "top left");
            assert_eq!(pixels[feature.width as usize - 1], [0, 0, 100], "top right");
            assert_eq!(pixels[pixels.len() - 1], [0, 0, 0], "bottom right");
        }
    }
}
