//! The rows of Table 4.1, and variants of its first row.

use tolman_maps::place_map::{ColourSpace, FeatureScaling, ImageFeature};

/// Name of the table.
pub(super) const TABLE: &str = "4.1";
pub(super) const VARIANTS: &str = "variants";

/// Name of the row of guesses.
pub(super) const RANDOM: &str = "random";

/// Mean score of guesses in the paper.
pub(super) const RANDOM_SCORE: f64 = 0.175;

/// A set of features.
#[derive(Clone, Copy, Debug)]
pub(super) struct Set {
    /// Name of the row of this set.
    pub(super) row: &'static str,
    image: ImageFeature,
    pub(super) with_sonar: bool,
    /// Mean score in the paper.
    pub(super) score: f64,
    /// Number of maps with a score in the paper.
    pub(super) samples: u32,
}

const SMALL_HSV: ImageFeature = ImageFeature::small(ColourSpace::Hsv);
const SMALL_RGB: ImageFeature = ImageFeature::small(ColourSpace::Rgb);
const LARGE_HSV: ImageFeature = ImageFeature::large(ColourSpace::Hsv);

/// The images of the sets, one for each table of features. A set without sonar has weight 0 for it.
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
    /// Returns the index of its image among [`IMAGES`].
    pub(super) fn image(&self) -> usize {
        let place = IMAGES.iter().position(|image| *image == self.image);
        place.unwrap_or(0)
    }
}

/// Source of the records, and their features.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    /// Maximum calibration error of each wheel, as a share.
    pub(super) calibration: f64,
    pub(super) scaling: FeatureScaling,
}

/// Records with wheels that slip by 2 % per step and have no calibration error. The paper says only
/// that its odometry "suffers from an accumulated noise".
const PAPER: Source = Source {
    calibration: 0.0,
    scaling: FeatureScaling::Group,
};

/// All sources of records.
pub(super) const SOURCES: [Source; 4] = [
    PAPER,
    Source {
        calibration: 0.003,
        ..PAPER
    },
    Source {
        calibration: 0.01,
        ..PAPER
    },
    Source {
        scaling: FeatureScaling::Raw,
        ..PAPER
    },
];

/// Rectangle over which a map is stretched before it is scored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stretch {
    /// The cells where records were taken.
    Visited,
    /// All cells of the field.
    Field,
}

/// A row with learned maps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting {
    pub(super) table: &'static str,
    pub(super) row: &'static str,
    pub(super) set: Set,
    /// Index among [`SOURCES`].
    pub(super) source: usize,
    pub(super) stretch: Stretch,
}

/// Returns all rows with learned maps, those of Table 4.1 first.
pub(super) fn settings() -> Vec<Setting> {
    let variants = [
        variant("wheels wrong by up to 0.3 %", 1, Stretch::Visited),
        variant("wheels wrong by up to 1 %", 2, Stretch::Visited),
        variant("raw values", 3, Stretch::Visited),
        variant("stretched over all cells", 0, Stretch::Field),
    ];
    SETS.into_iter().map(of_paper).chain(variants).collect()
}

const fn of_paper(set: Set) -> Setting {
    Setting {
        table: TABLE,
        row: set.row,
        set,
        source: 0,
        stretch: Stretch::Visited,
    }
}

const fn variant(row: &'static str, source: usize, stretch: Stretch) -> Setting {
    Setting {
        table: VARIANTS,
        row,
        set: SETS[0],
        source,
        stretch,
    }
}
