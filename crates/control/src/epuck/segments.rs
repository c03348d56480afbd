use alloc::vec::Vec;

use thiserror::Error;

use super::Profile;

/// Elements of a [`feature`](Segments::feature): the means of up to ten segments, and the landmark
/// (section 4.1).
pub const FEATURES: usize = 11;

/// The parts of a [`Profile`] between the places where it changes (section 4.1).
///
/// The profile is cyclic. The first segment is the way by which the robot came: of those lower than
/// their neighbours, the one nearest to straight behind. The others follow counter-clockwise. So a
/// place in a bend has the same feature whichever way the robot looks. A bend to the left differs
/// from one to the right. Where there is no such segment, the first segment is the one behind.
///
/// ```
/// use tolman_control::epuck::{PlaceKind, Profile, SegmentConfig};
///
/// // Walls to the left and to the right, with sharp ends.
/// let wall = |index: usize| if (10..40).contains(&index) || (60..90).contains(&index) { 200.0 } else { 0.0 };
/// let profile = Profile::from_values((0..100).map(wall).collect())?;
/// let segments = profile.segments(&SegmentConfig::paper())?;
/// assert_eq!(segments.place(), PlaceKind::Path);
/// assert_eq!(segments.feature(0.0)?[..5], [0.0, 200.0, 0.0, 200.0, 0.0]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Segments {
    segments: Vec<Segment>,
    config: SegmentConfig,
}

/// A part of a profile that does not change much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Mean value of the segment.
    pub mean: f64,
    /// Bearing of the segment's middle, rad, counter-clockwise from ahead, from -π to π.
    pub bearing: f64,
    /// Number of samples.
    pub samples: u32,
}

/// Parameters by which a profile is segmented.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct SegmentConfig {
    /// δ: over how many samples a change is averaged, at least 1. The paper calls it the estimated
    /// error and gives no value.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_one")
    )]
    pub window: u32,
    /// Limit to which raw values are cut before steps between them are taken. So the sharp edge of
    /// a near wall does not hide all other boundaries. The paper cuts nothing, which is
    /// `f64::INFINITY`.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::positive_or_infinite")
    )]
    pub ceiling: f64,
    /// Raw value below which the mean of a segment makes it a space: a way on. The paper gives no
    /// value.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::finite"))]
    pub space_below: f64,
    /// Minimum number of samples of a space. Fewer are the foot of a wall's edge, or a gap between
    /// walls far away. The paper has no such rule, which is 1.
    pub narrowest_space: u32,
    /// Raw value for joining segments: neighbours whose means lie both below it, or both not,
    /// become one, so that ways and walls alternate. The paper joins none, which is 0.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::finite"))]
    pub way_below: f64,
}

impl SegmentConfig {
    /// Returns the paper's values, taken literally, with ours where it is silent: δ = 5. A space
    /// reads less than 12 on average, like all space with nothing within 23 cm.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            window: 5,
            ceiling: f64::INFINITY,
            space_below: 12.0,
            narrowest_space: 1,
            way_below: 0.0,
        }
    }

    /// Returns the paper's values with two changes. Raw values above 60, those of walls within 17
    /// cm, are cut. A space has at least four samples of 100; the robot does not fit through less
    /// at the end of its sensors' reach.
    #[must_use]
    pub const fn cut() -> Self {
        Self {
            ceiling: 60.0,
            narrowest_space: 4,
            ..Self::paper()
        }
    }

    /// Returns the values of [`cut`](Self::cut), with ways and walls joined. They serve features,
    /// which then say how much wall is on either side of a path, wherever the robot looks.
    #[must_use]
    pub const fn joined() -> Self {
        Self {
            way_below: 40.0,
            ..Self::cut()
        }
    }
}

/// Kind of a place by its spaces (section 4.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceKind {
    /// No space: the robot is enclosed.
    Closed,
    /// One space: a dead end.
    DeadEnd,
    /// Two spaces: the robot is on a path.
    Path,
    /// More than two spaces: a junction.
    Junction,
}

impl Profile {
    /// Divides the profile into segments. The profile changes at a value if the mean of the steps
    /// to the δ values after it exceeds (S_max + S_min)/2. That is the middle between the largest
    /// and the smallest step from one value to the next. Neighbouring such values are one boundary;
    /// what lies between two boundaries is a segment.
    ///
    /// # Errors
    /// If the window is empty or longer than the profile.
    ///
    /// # Complexity
    /// Values × δ.
    pub fn segments(&self, config: &SegmentConfig) -> Result<Segments, SegmentError> {
        let values = self.values();
        let (count, window) = (values.len(), config.window as usize);
        if window == 0 || window >= count {
            return Err(SegmentError::Window {
                window: config.window,
                values: count,
            });
        }
        let cut = |index: usize| values[index % count].min(config.ceiling);
        let step = |from: usize, by: usize| (cut(from) - cut(from + by)).abs();
        let steps = || (0..count).map(|index| step(index, 1));
        let largest = steps().fold(0.0, f64::max);
        let smallest = steps().fold(f64::INFINITY, f64::min);
        let threshold = (largest + smallest) / 2.0;
        let changes: Vec<bool> = (0..count)
            .map(|index| {
                let mean = (1..=window).map(|by| step(index, by)).sum::<f64>() / window as f64;
                mean > threshold
            })
            .collect();
        let mut parts: Vec<Part> = runs(&changes, count / 2)
            .map(|(start, length)| Part {
                start,
                length,
                sum: (0..length).map(|by| values[(start + by) % count]).sum(),
                values: length,
            })
            .collect();
        merge(&mut parts, count, config.way_below);
        let mut segments: Vec<Segment> = parts
            .into_iter()
            .map(|part| Segment {
                mean: part.mean(),
                bearing: self.bearing(part.start as f64 + (part.length - 1) as f64 / 2.0),
                samples: part.length as u32,
            })
            .collect();
        // A way on that is almost hidden behind a bend is not a space, but still lower than its
        // neighbours.
        let found = segments.len();
        let mean = |index: usize| segments[index % found].mean;
        let valleys = (0..found).filter(|index| {
            mean(*index) < mean(index + 1) && mean(*index) < mean(index + found - 1)
        });
        let behind = |index: &usize| segments[*index].bearing.abs();
        if let Some(entry) = valleys.max_by(|a, b| behind(a).total_cmp(&behind(b))) {
            segments.rotate_left(entry);
        }
        Ok(Segments {
            segments,
            config: *config,
        })
    }
}

/// Segment while it grows. The values of a segment may have boundaries between them, which count
/// for its extent alone.
#[derive(Clone, Copy, Debug)]
struct Part {
    start: usize,
    length: usize,
    sum: f64,
    values: usize,
}

impl Part {
    fn mean(&self) -> f64 {
        self.sum / self.values as f64
    }
}

/// Joins neighbours that are both ways or both walls, round the circle.
fn merge(parts: &mut Vec<Part>, count: usize, way_below: f64) {
    let alike =
        |a: &Part, b: &Part| (a.mean() < way_below) == (b.mean() < way_below) && way_below > 0.0;
    let mut at = 0;
    while parts.len() > 1 && at < parts.len() {
        let next = (at + 1) % parts.len();
        let (this, other) = (parts[at], parts[next]);
        if alike(&this, &other) {
            let end = other.start + other.length;
            let length = (end + 2 * count - this.start) % count;
            parts[at] = Part {
                start: this.start,
                length: if length == 0 { count } else { length },
                sum: this.sum + other.sum,
                values: this.values + other.values,
            };
            parts.remove(next);
            at = at.min(parts.len() - 1);
            if next == 0 {
                break;
            }
        } else {
            at += 1;
        }
    }
}

/// Returns start and length of the cyclic runs of values that do not change. The first is the one
/// that holds `origin`, or else the next.
fn runs(changes: &[bool], origin: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
    let count = changes.len();
    let quiet = move |index: usize| !changes[index % count];
    // Back to where the run begins, if it does.
    let back = (0..count).find(|back| !quiet(origin + count - back));
    let first = match back {
        None | Some(0) => origin,
        Some(back) => origin + count + 1 - back,
    };
    let mut at = 0;
    core::iter::from_fn(move || {
        while at < count && !quiet(first + at) {
            at += 1;
        }
        let start = at;
        while at < count && quiet(first + at) {
            at += 1;
        }
        (at > start).then_some(((first + start) % count, at - start))
    })
}

impl Segments {
    /// Returns the segments, counter-clockwise from the way by which the robot came.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Returns the bearings of the spaces, rad: the branches of a junction, counter-clockwise from
    /// the one by which the robot came, that nearest to behind.
    pub fn spaces(&self) -> impl Iterator<Item = f64> + '_ {
        let spaces = || {
            let below = self.segments.iter().filter(|segment| {
                segment.mean < self.config.space_below
                    && segment.samples >= self.config.narrowest_space
            });
            below.map(|segment| segment.bearing)
        };
        let entry = (0..)
            .zip(spaces())
            .max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()));
        let first = entry.map_or(0, |(index, _)| index);
        spaces().skip(first).chain(spaces().take(first))
    }

    /// Returns the number of ways that lead on where ways and walls alternate, half hidden ones
    /// included.
    #[must_use]
    pub fn ways(&self) -> usize {
        self.segments
            .iter()
            .filter(|segment| segment.mean < self.config.way_below)
            .count()
    }

    /// Returns the kind of the place, by its number of ways.
    #[must_use]
    pub fn place(&self) -> PlaceKind {
        match self.spaces().count() {
            0 => PlaceKind::Closed,
            1 => PlaceKind::DeadEnd,
            2 => PlaceKind::Path,
            _ => PlaceKind::Junction,
        }
    }

    /// Returns the input of SOINN: the means, filled up to ten with zeros, and the landmark element
    /// (0 for none).
    ///
    /// # Errors
    /// If there are more than ten segments: "the vector's size might be more than ten if the
    /// junction size is larger than five ways".
    pub fn feature(&self, landmark: f64) -> Result<[f64; FEATURES], SegmentError> {
        let most = FEATURES - 1;
        if self.segments.len() > most {
            return Err(SegmentError::TooMany {
                segments: self.segments.len(),
                most,
            });
        }
        let mut feature = [0.0; FEATURES];
        for (element, segment) in feature.iter_mut().zip(&self.segments) {
            *element = segment.mean;
        }
        feature[most] = landmark;
        Ok(feature)
    }
}

/// Reason why a profile cannot be segmented, or segments do not form a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SegmentError {
    /// The window cannot be averaged over.
    #[error("the window of {window} samples does not fit a profile of {values}; give 1 to {}", values.saturating_sub(1))]
    Window {
        /// Length of the window.
        window: u32,
        /// Number of values of the profile.
        values: usize,
    },
    /// There are more segments than a feature has elements for.
    #[error(
        "the profile has {segments} segments, but a feature holds only {most}; junctions may have at most five ways"
    )]
    TooMany {
        /// Number of segments.
        segments: usize,
        /// Maximum number of segments of a feature.
        most: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a profile with sharp walls of 200 at these indices, nothing between.
    fn profile(walls: &[(usize, usize)]) -> Profile {
        let mut values = alloc::vec![0.0; 100];
        for (start, end) in walls {
            for index in *start..*end {
                values[index % 100] = 200.0;
            }
        }
        Profile::from_values(values).unwrap()
    }

    fn check(walls: &[(usize, usize)], place: PlaceKind, spaces: &[f64]) {
        let segments = profile(walls).segments(&SegmentConfig::paper()).unwrap();
        assert_eq!(segments.place(), place, "{segments:?}");
        let found: Vec<f64> = segments.spaces().map(f64::to_degrees).collect();
        assert_eq!(found.len(), spaces.len());
        for (found, expected) in found.iter().zip(spaces) {
            // A boundary lies within δ samples before the step.
            let off = (found - expected + 540.0).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 2.5 * 3.6, "{found} {expected}");
        }
    }

    #[test]
    fn spaces_are_counted_and_numbered_counter_clockwise() {
        check(&[(0, 100)], PlaceKind::Closed, &[]);
        check(&[(10, 90)], PlaceKind::DeadEnd, &[0.0]);
        check(&[(10, 40), (60, 90)], PlaceKind::Path, &[180.0, 0.0]);
        let from_left = [(60, 90), (10, 20), (30, 40)];
        check(&from_left, PlaceKind::Junction, &[180.0, 0.0, 90.0]);
        let crossing = [(10, 15), (35, 40), (60, 65), (85, 90)];
        check(&crossing, PlaceKind::Junction, &[180.0, -90.0, 0.0, 90.0]);
        // A wall right behind, as in a bend.
        check(&[(90, 110), (30, 80)], PlaceKind::Path, &[72.0, -54.0]);
    }

    #[test]
    fn a_feature_begins_with_the_way_the_robot_came_by() {
        let feature = |walls: &[(usize, usize)]| {
            let segments = profile(walls).segments(&SegmentConfig::paper()).unwrap();
            segments.feature(0.0).unwrap()
        };
        // Looking along a corridor, or askew in it.
        assert_eq!(
            feature(&[(10, 40), (60, 90)]).map(f64::to_bits),
            feature(&[(20, 50), (70, 100)]).map(f64::to_bits)
        );
        // A bend to the left and one to the right: the long wall is on the other side.
        let bend = |wall: (usize, usize), post: (usize, usize)| {
            let mut values = profile(&[wall]).values().to_vec();
            values[post.0..post.1].fill(100.0);
            let profile = Profile::from_values(values).unwrap();
            let feature = profile
                .segments(&SegmentConfig::cut())
                .unwrap()
                .feature(0.0)
                .unwrap();
            [feature[1] > 150.0, feature[3] > 150.0]
        };
        assert_eq!(bend((60, 110), (35, 40)), [true, false]);
        assert_eq!(bend((90, 140), (60, 65)), [false, true]);
    }

    #[test]
    fn landmarks_are_the_last_element() {
        let segments = profile(&[(10, 90)])
            .segments(&SegmentConfig::paper())
            .unwrap();
        assert!((segments.feature(1.0).unwrap()[10] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_segmented_is_refused() {
        let config = |window| SegmentConfig {
            window,
            ..SegmentConfig::paper()
        };
        let all_round = profile(&[(0, 100)]);
        for window in [0, 100] {
            let error = all_round.segments(&config(window)).unwrap_err();
            assert!(matches!(error, SegmentError::Window { .. }));
        }
        let comb: Vec<(usize, usize)> = (0..6).map(|tooth| (tooth * 16, tooth * 16 + 8)).collect();
        let segments = profile(&comb).segments(&SegmentConfig::paper()).unwrap();
        assert!(matches!(
            segments.feature(0.0),
            Err(SegmentError::TooMany { segments: 12, .. })
        ));
    }
}
