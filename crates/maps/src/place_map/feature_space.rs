use alloc::vec::Vec;

use tolman_geom::Point;
use tolman_robot::{Picture, PinholeCamera};

use super::record_span::RecordSpan;
use super::{FeatureError, FeatureGroup, FeatureWeights, ImageFeature, PlaceRecord};

/// The space in which places are compared: the groups of features in a vector, and their scaling.
///
/// A [`FeatureTable`](super::FeatureTable) makes one of records.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureSpace {
    pub(super) parts: Vec<Part>,
    pub(super) camera: Option<PinholeCamera>,
    /// Basis for images that are stored as coordinates instead of pixels.
    pub(super) span: Option<RecordSpan>,
}

/// One group in a vector of features.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub(super) struct Part {
    pub(super) group: FeatureGroup,
    /// Number of the group's values in the vector.
    pub(super) len: usize,
    /// Factor by which the group's values are multiplied.
    pub(super) scale: f32,
}

impl FeatureGroup {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Image(_) => "image",
            Self::Sonar => "sonar",
            Self::Odometry => "odometry",
        }
    }

    /// Returns the values of a record, unscaled. `record` is its number, for errors.
    pub(super) fn values(self, of: &PlaceRecord, record: usize) -> Result<Vec<f32>, FeatureError> {
        let values: Vec<f32> = match self {
            Self::Image(feature) => feature.values(picture_of(of, record)?),
            Self::Sonar => {
                let soundings = of.snapshot.soundings.iter();
                soundings.map(|sounding| sounding.range as f32).collect()
            }
            Self::Odometry => {
                let Point { coords } = of.odometry.position;
                coords.iter().map(|value| *value as f32).collect()
            }
        };
        let group = self.name();
        let finite = values.iter().all(|value| value.is_finite());
        let refused = FeatureError::NotFinite { record, group };
        finite.then_some(values).ok_or(refused)
    }
}

fn picture_of(of: &PlaceRecord, record: usize) -> Result<&Picture, FeatureError> {
    let picture = of.snapshot.picture.as_ref();
    let picture = picture.ok_or(FeatureError::NoPicture { record })?;
    let Picture { width, height, .. } = *picture;
    let found = picture.pixels.len();
    if found == 0 || found != width as usize * height as usize {
        return Err(FeatureError::BadPicture {
            record,
            width,
            height,
            found,
        });
    }
    Ok(picture)
}

impl FeatureSpace {
    /// Returns the number of values in a vector of features.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.parts.iter().map(|part| part.len).sum()
    }

    /// Returns the features of a record outside the table.
    ///
    /// # Errors
    /// [`FeatureError`] if the record lacks a chosen feature; the error names it record 0.
    pub fn features(&self, of: &PlaceRecord) -> Result<Vec<f32>, FeatureError> {
        let mut features = Vec::with_capacity(self.dimension());
        for part in &self.parts {
            let mut values = part.group.values(of, 0)?;
            if let (FeatureGroup::Image(_), Some(span)) = (part.group, &self.span) {
                values = span.coordinates(&values);
            }
            if values.len() != part.len {
                return Err(FeatureError::OtherSoundings {
                    record: 0,
                    expected: part.len,
                    found: values.len(),
                });
            }
            features.extend(values.iter().map(|value| value * part.scale));
        }
        Ok(features)
    }

    /// Returns the weight of each value: that of its group.
    pub(super) fn weights(&self, weights: &FeatureWeights) -> Vec<f32> {
        let each = |part: &Part| core::iter::repeat_n(weights.of(part.group) as f32, part.len);
        self.parts.iter().flat_map(each).collect()
    }

    /// Returns the unscaled values, in a vector of features, of the first group for which `is` is
    /// true.
    fn part(&self, features: &[f32], is: impl Fn(FeatureGroup) -> bool) -> Option<Vec<f32>> {
        let mut start = 0;
        for part in &self.parts {
            if is(part.group) {
                let values = features.get(start..start + part.len)?;
                return Some(values.iter().map(|value| value / part.scale).collect());
            }
            start += part.len;
        }
        None
    }

    /// Returns the position in a vector of features, by odometry, m; `None` if odometry is not a
    /// chosen feature.
    #[must_use]
    pub fn position(&self, features: &[f32]) -> Option<Point> {
        let values = self.part(features, |group| group == FeatureGroup::Odometry)?;
        match values[..] {
            [x, y] => Some(Point::new(f64::from(x), f64::from(y))),
            _ => None,
        }
    }

    /// Returns the ranges in a vector of features, m; `None` if ranges are not a chosen feature.
    #[must_use]
    pub fn ranges(&self, features: &[f32]) -> Option<Vec<f64>> {
        let values = self.part(features, |group| group == FeatureGroup::Sonar)?;
        Some(values.into_iter().map(f64::from).collect())
    }

    /// Returns the image in a vector of features, in red, green and blue; `None` if images are not
    /// a chosen feature.
    #[must_use]
    pub fn picture(&self, features: &[f32]) -> Option<Picture> {
        let (feature, values) = self.image(features)?;
        Some(Picture {
            width: feature.width,
            height: feature.height,
            camera: self.camera?,
            pixels: feature.pixels(&values),
        })
    }

    /// Returns the values of the image's pixels in a vector of features, unscaled.
    fn image(&self, features: &[f32]) -> Option<(ImageFeature, Vec<f32>)> {
        let image = |group| match group {
            FeatureGroup::Image(feature) => Some(feature),
            FeatureGroup::Sonar | FeatureGroup::Odometry => None,
        };
        let feature = self.parts.iter().find_map(|part| image(part.group))?;
        let values = self.part(features, |group| image(group).is_some())?;
        let values = match &self.span {
            Some(span) => span.vector(&values),
            None => values,
        };
        Some((feature, values))
    }

    /// Returns the same space with images as pixels.
    #[cfg(feature = "serde")]
    pub(super) fn expanded(&self) -> Self {
        let part = |part: &Part| match part.group {
            FeatureGroup::Image(feature) => Part {
                len: feature.len(),
                ..*part
            },
            FeatureGroup::Sonar | FeatureGroup::Odometry => *part,
        };
        Self {
            parts: self.parts.iter().map(part).collect(),
            camera: self.camera,
            span: None,
        }
    }

    /// Returns the features in the space with images as pixels.
    #[cfg(feature = "serde")]
    pub(super) fn expand(&self, features: &[f32]) -> Vec<f32> {
        let mut start = 0;
        let mut expanded = Vec::new();
        for part in &self.parts {
            match (part.group, self.image(features)) {
                (FeatureGroup::Image(_), Some((_, values))) => {
                    expanded.extend(values.iter().map(|value| value * part.scale));
                }
                _ => expanded.extend_from_slice(&features[start..start + part.len]),
            }
            start += part.len;
        }
        expanded
    }
}
