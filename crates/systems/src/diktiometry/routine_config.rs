use core::ops::Bound::{self, Excluded, Included};
use core::ops::RangeBounds;

use thiserror::Error;

/// Knowledge of a [`Surveyor`](super::Surveyor) about the corridors and its robot.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RoutineConfig {
    /// Width of a corridor from wall to wall, m, > 0.
    pub corridor_width: f64,
    /// Width of a doorway from jamb to jamb, m, > 0 and less than a corridor's; `None` where no
    /// narrow passage is a place.
    pub doorway_width: Option<f64>,
    /// Turn of the robot in one time step at full rate, rad, > 0.
    pub turn_per_step: f64,
    /// Distance that the robot covers in one time step at full speed, m, > 0.
    pub translate_per_step: f64,
    /// Largest error of odometry as a share of the distance, 0 … 0.5. Paper: "about 10% of
    /// distance travelled".
    pub odometry_share: f64,
    /// Largest error of the compass, rad, ≥ 0.
    pub compass_bound: f64,
}

/// Reason why no routine can be carried out with a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the routines' `{field}` is {value}; give {expected}")]
pub struct RoutineConfigError {
    /// Name of the field.
    pub field: &'static str,
    /// Value that was given.
    pub value: f64,
    /// Allowed values, in words.
    pub expected: &'static str,
}

impl RoutineConfig {
    /// Returns a configuration for corridors `corridor_width` m wide without doorways. In one time
    /// step the robot turns by at most `turn_per_step`, rad, and moves by at most
    /// `translate_per_step`, m. The error bounds are the paper's: odometry 10 %, compass 4°.
    #[must_use]
    pub fn new(corridor_width: f64, turn_per_step: f64, translate_per_step: f64) -> Self {
        Self {
            corridor_width,
            doorway_width: None,
            turn_per_step,
            translate_per_step,
            odometry_share: 0.1,
            compass_bound: 4_f64.to_radians(),
        }
    }

    /// Checks that every field is within its range.
    ///
    /// # Errors
    /// [`RoutineConfigError`] names the first that is not.
    pub fn check(&self) -> Result<(), RoutineConfigError> {
        let fields = [
            ("odometry_share", self.odometry_share, SHARE),
            ("compass_bound", self.compass_bound, ANGLE),
            ("corridor_width", self.corridor_width, POSITIVE),
            ("doorway_width", self.doorway_width.unwrap_or(1.0), POSITIVE),
            ("turn_per_step", self.turn_per_step, POSITIVE),
            ("translate_per_step", self.translate_per_step, POSITIVE),
        ];
        for (field, value, (range, expected)) in fields {
            if !range.contains(&value) {
                return Err(RoutineConfigError {
                    field,
                    value,
                    expected,
                });
            }
        }
        Ok(())
    }
}

/// Allowed values of a field, also in words.
type Allowed = ((Bound<f64>, Bound<f64>), &'static str);

const SHARE: Allowed = ((Included(0.0), Included(0.5)), "a share from 0 to 0.5");
const ANGLE: Allowed = (
    (Included(0.0), Excluded(f64::INFINITY)),
    "a number of radians, 0 or more",
);
const POSITIVE: Allowed = ((Excluded(0.0), Excluded(f64::INFINITY)), "a number above 0");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_out_of_its_range_is_named() {
        let mut sound = RoutineConfig::new(1.2, 1.0, 0.5);
        sound.doorway_width = Some(0.8);
        assert_eq!(sound.check(), Ok(()));
        let check = |change: fn(&mut RoutineConfig), expect: &str| {
            let mut config = sound;
            change(&mut config);
            assert_eq!(config.check().unwrap_err().field, expect);
        };
        check(|config| config.odometry_share = 0.6, "odometry_share");
        check(|config| config.compass_bound = f64::NAN, "compass_bound");
        check(|config| config.corridor_width = 0.0, "corridor_width");
        check(|config| config.doorway_width = Some(-1.0), "doorway_width");
        check(
            |config| config.turn_per_step = f64::INFINITY,
            "turn_per_step",
        );
        check(
            |config| config.translate_per_step = 0.0,
            "translate_per_step",
        );
    }
}
