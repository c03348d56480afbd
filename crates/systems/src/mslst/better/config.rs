use serde::{Deserialize, Serialize};
use tolman_geom::OutOfRange;

use crate::mslst::ROBOT_UNIT;

/// Parameters of the better system.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct BetterConfig {
    /// Diameter of the robot, m.
    pub diameter: f64,
    /// Standard deviation of the odometry of a time step, as a share of its distance.
    pub odometry_sd: f64,
    /// Errors of the robot's motors.
    pub motors: Motors,
    /// Width of a corridor from wall to wall, m, for which the layers are made.
    pub corridor_width: f64,
    /// Length of an action, m.
    pub action_way: f64,
    /// Standard deviation of the distance of an action, as a share of that distance.
    pub action_sd: f64,
    /// Range below which the layers stop, m.
    pub buffer: f64,
    /// Part that is switched off, to measure its effect; `None` for the whole system.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub without: Option<BetterPart>,
}

/// A part of the better system that can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BetterPart {
    /// Corrects positions by the walls. Without it, positions come from odometry.
    Fit,
    /// Goes to the gaps of the map. Without it, wanders like Avoid until there are none.
    Exploration,
    /// Plans for motors with errors. Without it, plans for exact ones.
    Chances,
    /// Chooses the action that is best on average over the belief. Without it, chooses the best one
    /// at the likeliest standpoint.
    Average,
    /// Takes the absence of the goal's landmark as evidence.
    Absence,
    /// Shows the layers straightened scans.
    Straightening,
    /// Notices that the robot was lifted while it learned, and begins another map.
    Lifts,
}

impl BetterConfig {
    /// Returns the values for the paper's robot.
    #[must_use]
    pub const fn pioneer() -> Self {
        Self {
            diameter: ROBOT_UNIT,
            odometry_sd: 0.05,
            motors: Motors::PIONEER,
            corridor_width: 1.9 * ROBOT_UNIT,
            action_way: ROBOT_UNIT,
            action_sd: 0.2,
            buffer: 0.9 * ROBOT_UNIT,
            without: None,
        }
    }

    /// Refuses values that no robot has.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first of them.
    pub fn check(&self) -> Result<(), OutOfRange> {
        const SHARE: [f64; 2] = [0.0, 1.0];
        let Motors {
            turn_per_command,
            turn_sd,
            way_per_command,
            way_sd,
        } = self.motors;
        let fields = [
            ("diameter", self.diameter, [0.05, 5.0]),
            ("odometry_sd", self.odometry_sd, SHARE),
            ("motors.turn_per_command", turn_per_command, [0.01, 7.0]),
            ("motors.turn_sd", turn_sd, SHARE),
            ("motors.way_per_command", way_per_command, [0.01, 10.0]),
            ("motors.way_sd", way_sd, SHARE),
            ("corridor_width", self.corridor_width, [0.05, 20.0]),
            ("action_way", self.action_way, [0.01, 10.0]),
            ("action_sd", self.action_sd, SHARE),
            ("buffer", self.buffer, [0.0, 10.0]),
        ];
        for (field, value, [least, most]) in fields {
            OutOfRange::check(field, value, least..=most)?;
        }
        Ok(())
    }

    /// Returns whether `part` is in use.
    #[must_use]
    pub fn has(&self, part: BetterPart) -> bool {
        self.without != Some(part)
    }
}

/// Errors of motors, as a plan expects them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Motors {
    /// Turn in a time step per unit of the command, rad.
    pub turn_per_command: f64,
    /// Error of that turn, as a share (standard deviation).
    pub turn_sd: f64,
    /// Distance in a time step per unit of the command, m.
    pub way_per_command: f64,
    /// Error of that distance, as a share (standard deviation).
    pub way_sd: f64,
}

impl Motors {
    /// Returns the same motors without errors.
    pub(super) const fn exact(self) -> Self {
        Self {
            turn_sd: 0.0,
            way_sd: 0.0,
            ..self
        }
    }

    /// Errors of the motors of the paper's robot.
    pub const PIONEER: Self = Self {
        turn_per_command: 91.0 * core::f64::consts::PI / 180.0,
        turn_sd: 0.12,
        way_per_command: 2.0 * ROBOT_UNIT,
        way_sd: 0.25,
    };
}
