use alloc::vec::Vec;

use thiserror::Error;

/// How far a surface is, by the raw value of a proximity sensor: straight lines between measured
/// points, nearest first.
///
/// ```
/// use tolman_control::epuck::RangeCurve;
///
/// let curve = RangeCurve::new(vec![(0.0, 3800.0), (0.05, 500.0), (0.25, 0.0)])?;
/// assert!((curve.range(250.0).unwrap() - 0.15).abs() < 1e-12);
/// assert_eq!(curve.range(0.0), None, "nothing is within reach");
/// # Ok::<(), tolman_control::epuck::RangeCurveError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<(f64, f64)>", into = "Vec<(f64, f64)>")
)]
pub struct RangeCurve {
    /// Range, m, and value there.
    points: Vec<(f64, f64)>,
}

/// Ranges, m, and values of CPM's simulated e-puck.
const CPM: [(f64, f64); 10] = [
    (0.0, 3800.0),
    (0.018, 1950.0),
    (0.036, 1320.0),
    (0.054, 504.0),
    (0.071, 299.0),
    (0.107, 158.0),
    (0.143, 86.0),
    (0.179, 50.0),
    (0.214, 35.0),
    (0.25, 0.0),
];

impl RangeCurve {
    /// Returns the curve of CPM's simulated e-puck, which sees 25 cm. The thresholds of its layers
    /// are meant for it.
    #[must_use]
    pub fn cpm() -> Self {
        Self {
            points: CPM.to_vec(),
        }
    }

    /// Returns a curve through points of a range, m, and the value read there.
    ///
    /// # Errors
    /// If there are fewer than two points, a number is not finite, ranges do not grow or values do
    /// not fall.
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, RangeCurveError> {
        if points.len() < 2 {
            return Err(RangeCurveError::TooFew {
                points: points.len(),
            });
        }
        for (index, (range, value)) in points.iter().enumerate() {
            if !(range.is_finite() && value.is_finite()) {
                return Err(RangeCurveError::NotFinite { index });
            }
        }
        for (index, pair) in points.windows(2).enumerate() {
            if pair[1].0 <= pair[0].0 || pair[1].1 >= pair[0].1 {
                return Err(RangeCurveError::Order { index: index + 1 });
            }
        }
        Ok(Self { points })
    }

    /// Returns the range at which a sensor reads `value`, m. `None` at or below the value of the
    /// farthest point, which is also read where nothing is near.
    #[must_use]
    pub fn range(&self, value: f64) -> Option<f64> {
        let far = self.points.partition_point(|(_, at)| *at > value);
        let (_, (range, at)) = (far, *self.points.get(far)?);
        let Some(nearer) = far.checked_sub(1).and_then(|near| self.points.get(near)) else {
            return Some(range);
        };
        if far + 1 == self.points.len() && value <= at {
            return None;
        }
        let share = (nearer.1 - value) / (nearer.1 - at);
        Some(nearer.0 + share * (range - nearer.0))
    }

    /// Returns the value read at a range, m: that of the nearest or farthest point beyond them.
    ///
    /// ```
    /// use tolman_control::epuck::RangeCurve;
    ///
    /// let curve = RangeCurve::new(vec![(0.0, 3800.0), (0.05, 500.0), (0.25, 0.0)])?;
    /// assert!((curve.value(0.15) - 250.0).abs() < 1e-9);
    /// assert!((curve.value(1.0)).abs() < 1e-9);
    /// # Ok::<(), tolman_control::epuck::RangeCurveError>(())
    /// ```
    #[must_use]
    pub fn value(&self, range: f64) -> f64 {
        let far = self.points.partition_point(|(at, _)| *at < range);
        let nearer = far.checked_sub(1).and_then(|near| self.points.get(near));
        match (nearer, self.points.get(far)) {
            (Some(near), Some(far)) => {
                let share = (range - near.0) / (far.0 - near.0);
                near.1 + share * (far.1 - near.1)
            }
            (Some(end), None) | (None, Some(end)) => end.1,
            (None, None) => 0.0,
        }
    }

    /// Returns the greatest range that can be measured, m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.0)
    }
}

impl TryFrom<Vec<(f64, f64)>> for RangeCurve {
    type Error = RangeCurveError;

    fn try_from(points: Vec<(f64, f64)>) -> Result<Self, RangeCurveError> {
        Self::new(points)
    }
}

impl From<RangeCurve> for Vec<(f64, f64)> {
    /// Returns the ranges, m, and the values there.
    fn from(curve: RangeCurve) -> Self {
        curve.points
    }
}

/// Reason why points do not make a [`RangeCurve`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RangeCurveError {
    /// A line needs two points.
    #[error("the curve has {points} points; give at least two")]
    TooFew {
        /// Number of points.
        points: usize,
    },
    /// A number is invalid.
    #[error("point {index} of the curve has a number that is not finite; give finite numbers")]
    NotFinite {
        /// Number of the point, from 0.
        index: usize,
    },
    /// Ranges must grow and values fall.
    #[error(
        "point {index} of the curve is not farther and darker than the one before; sort them by range"
    )]
    Order {
        /// Number of the point, from 0.
        index: usize,
    },
}
