//! The rows of Table 4.1.

use tolman_maps::place_map::{ColourSpace, FeatureChoice, ImageFeature};

/// The row of guesses.
pub(super) const RANDOM: &str = "random";

/// The paper's mean score of guesses.
pub(super) const RANDOM_SCORE: f64 = 0.175;

/// One set of features.
#[derive(Clone, Copy, Debug)]
pub(super) struct Set {
    /// The name of its row.
    pub(super) row: &'static str,
    image: ImageFeature,
    pub(super) with_sonar: bool,
    /// The paper's mean score.
    pub(super) score: f64,
    /// The paper's number of maps with a score.
    pub(super) samples: u32,
}

const SMALL_HSV: ImageFeature = ImageFeature::small(ColourSpace::Hsv);
const SMALL_RGB: ImageFeature = ImageFeature::small(ColourSpace::Rgb);
const LARGE_HSV: ImageFeature = ImageFeature::large(ColourSpace::Hsv);

/// The images of the sets, and so the tables of features: a set without sonar is one with a weight of 0.
pub(super) const IMAGES: [ImageFeature; 3] = [SMALL_HSV, SMALL_RGB, LARGE_HSV];

/// Sets 1 to 6.
pub(super) const SETS: [Set; 6] = [
    set("40x30 hsv+odometry", SMALL_HSV, false, 0.230, 7991),
    set("40x30 hsv+odometry+sonar", SMALL_HSV, true, 0.227, 7991),
    set("40x30 rgb+odometry", SMALL_RGB, false, 0.195, 7126),
    set("40x30 rgb+odometry+sonar", SMALL_RGB, true, 0.171, 7911),
    set("80x60 hsv+odometry", LARGE_HSV, false, 0.227, 7991),
    set("80x60 hsv+odometry+sonar", LARGE_HSV, true, 0.224, 7991),
];

const fn set(
    row: &'static str,
    image: ImageFeature,
    with_sonar: bool,
    score: f64,
    samples: u32,
) -> Set {
    Set {
        row,
        image,
        with_sonar,
        score,
        samples,
    }
}

impl Set {
    /// Returns the place of its image among [`IMAGES`].
    pub(super) fn image(&self) -> usize {
        let place = IMAGES.iter().position(|image| *image == self.image);
        place.unwrap_or(0)
    }
}

/// Returns the features of a table: the image, the odometry and the sonar.
pub(super) fn choice(image: ImageFeature) -> FeatureChoice {
    FeatureChoice::paper_with_sonar(image)
}
