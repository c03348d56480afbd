use tolman_geom::{OutOfRange, POSITIVE};

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
    /// [`OutOfRange`] names the first that is not.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let doorway_width = self.doorway_width.unwrap_or(1.0);
        OutOfRange::check("odometry_share", self.odometry_share, 0.0..=0.5)?;
        OutOfRange::check("compass_bound", self.compass_bound, 0.0..)?;
        OutOfRange::check("corridor_width", self.corridor_width, POSITIVE)?;
        OutOfRange::check("doorway_width", doorway_width, POSITIVE)?;
        OutOfRange::check("turn_per_step", self.turn_per_step, POSITIVE)?;
        OutOfRange::check("translate_per_step", self.translate_per_step, POSITIVE)
    }
}

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
