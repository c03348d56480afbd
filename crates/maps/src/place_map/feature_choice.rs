use alloc::vec;
use alloc::vec::Vec;

use super::{ColourSpace, ImageFeature};

/// One group of the features of a place, from one kind of sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum FeatureGroup {
    /// The picture, made smaller.
    Image(ImageFeature),
    /// The range of each sounding, m.
    Sonar,
    /// Position of the robot by odometry, x and y, m. The heading is left out, as in the paper.
    Odometry,
}

/// Scaling of the values of a group before its weight is applied. A whole group has one factor, so
/// x and y keep their ratio, and so do pixels.
///
/// The paper does not mention any scaling: "the (unmodified) sensor values". Then the unit of a
/// sensor and the number of its values decide its influence, and no weight between 0 and 1 corrects
/// that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum FeatureScaling {
    /// All groups have the same mean squared distance: the variances of a group's values add up to
    /// one. So a group is one feature of equation 3.1, however many values it has: "in the case of
    /// a matrix … the distance calculation is a Euclidean distance". The weights of Table 3.1, 0.63
    /// for images and 0.33 for odometry, make sense only with this.
    #[default]
    Group,
    /// The values of a group have a mean variance of 1. A group's influence is then its number of
    /// values: 3600 for an image, 2 for the odometry.
    Value,
    /// Values as they are: metres, and colours of 0 … 1.
    Raw,
}

/// Features that describe a place.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct FeatureChoice {
    /// The groups, in the order of their values; none twice.
    pub groups: Vec<FeatureGroup>,
    /// Scaling of the groups.
    pub scaling: FeatureScaling,
}

impl FeatureChoice {
    /// Returns sets 1, 3 and 5 of Table 4.1: the image and the odometry.
    #[must_use]
    pub fn paper(image: ImageFeature) -> Self {
        Self {
            groups: vec![FeatureGroup::Image(image), FeatureGroup::Odometry],
            scaling: FeatureScaling::Group,
        }
    }

    /// Returns sets 2, 4 and 6 of Table 4.1: the image, the odometry and the sonar.
    #[must_use]
    pub fn paper_with_sonar(image: ImageFeature) -> Self {
        let mut choice = Self::paper(image);
        choice.groups.push(FeatureGroup::Sonar);
        choice
    }

    /// Sets the scaling of the groups.
    #[must_use]
    pub const fn scaled(mut self, scaling: FeatureScaling) -> Self {
        self.scaling = scaling;
        self
    }
}

impl Default for FeatureChoice {
    /// Returns set 1, the best of Table 4.1.
    fn default() -> Self {
        Self::paper(ImageFeature::small(ColourSpace::Hsv))
    }
}

/// Weight of each group: the w of equation 3.1. Weights of groups that are not chosen are ignored.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct FeatureWeights {
    /// Weight of the image, w_image; not negative.
    pub image: f64,
    /// Weight of the odometry, w_odo; not negative.
    pub odometry: f64,
    /// Weight of the sonar, w_sonar; not negative.
    pub sonar: f64,
}

impl FeatureWeights {
    /// Returns the middle of the optimal ranges of Table 3.1: image 0.63, odometry 0.3275, sonar
    /// 0.25.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            image: 0.63,
            odometry: 0.3275,
            sonar: 0.25,
        }
    }

    /// Returns the weight of a group.
    #[must_use]
    pub const fn of(&self, group: FeatureGroup) -> f64 {
        match group {
            FeatureGroup::Image(_) => self.image,
            FeatureGroup::Sonar => self.sonar,
            FeatureGroup::Odometry => self.odometry,
        }
    }
}

impl Default for FeatureWeights {
    fn default() -> Self {
        Self::paper()
    }
}
