use core::f64::consts::FRAC_PI_2;

use tolman_robot::Sounding;

/// Minimum distances of things: ahead, and beside.
///
/// A sensor that looks to the side may be nearer to a wall than one that looks ahead. The wall only
/// has to be beside the robot's lane. Its threshold is `side` divided by the sine of the angle
/// between the way ahead and the edge of its cone. It is at most `ahead`. Sensors that look back
/// have none.
///
/// ```
/// use tolman_control::wander::NearLimits;
/// use tolman_robot::{Soundings, pioneer_2dx};
///
/// let sensing = pioneer_2dx::Pioneer2dxSensing {
///     sonars: Some([1.0; 16]),
///     ..pioneer_2dx::Pioneer2dxSensing::SILENT
/// };
/// let limits = NearLimits::paper();
/// let thresholds: Vec<f64> = sensing.soundings().map(|sonar| limits.threshold(&sonar)).collect();
/// assert!((thresholds[3] - 1.1).abs() < 1e-12, "10° from ahead");
/// assert!((thresholds[0] - 0.15).abs() < 0.002, "to the left");
/// assert!(thresholds[11].abs() < 1e-12, "to the back");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct NearLimits {
    /// Threshold of a sensor that looks ahead, m. Paper: 1.1.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub ahead: f64,
    /// Threshold of a sensor that looks to the side, m. Paper: 0.15.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub side: f64,
}

impl NearLimits {
    /// Returns the paper's limits: 1.1 m at the front, 0.15 m at the sides (section 3.2). The paper
    /// gives none between them.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            ahead: 1.1,
            side: 0.15,
        }
    }

    /// Returns the range below which a sensor reports something as near, m.
    #[must_use]
    pub fn threshold(&self, sounding: &Sounding) -> f64 {
        /// Angle above which a sensor looks back, rad. One that looks straight to the side belongs
        /// to the sides, whatever the rounding.
        const ASIDE: f64 = FRAC_PI_2 + 1e-6;
        let bearing = sounding.mount.heading.radians().abs();
        if bearing > ASIDE {
            return 0.0;
        }
        let sine = libm::sin((bearing - sounding.half_width).clamp(0.0, FRAC_PI_2));
        if self.side < self.ahead * sine {
            self.side / sine
        } else {
            self.ahead
        }
    }
}
