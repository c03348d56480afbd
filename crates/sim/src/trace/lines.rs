//! The lines of a trace as they are written in the file.

use serde::{Deserialize, Serialize};
use tolman_geom::Pose;

use super::Recordable;
use crate::{DoorState, RobotId};

pub(super) const FORMAT: &str = "tolman-trace";
pub(super) const VERSION: u32 = 1;

/// The first line.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct Header<M: Recordable> {
    pub(super) format: String,
    pub(super) version: u32,
    /// The seed of all random numbers.
    pub(super) seed: u64,
    /// The length of a time step, µs.
    pub(super) step_us: u64,
    pub(super) robots: Vec<Start<M>>,
    /// A world file.
    pub(super) world: serde_json::Value,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct Start<M: Recordable> {
    pub(super) config: M::Config,
    pub(super) pose: Pose,
    /// Disturbances of the robot beyond its configuration.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) disturbances: Vec<String>,
}

/// Any line of a trace except the first.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", bound = "")]
pub enum TraceLine<M: Recordable> {
    /// A robot carried out a command.
    Step(StepRecord<M>),
    /// A robot was lifted and set down after the steps so far.
    Place {
        /// Id of the robot.
        robot: RobotId,
        /// New pose of the robot.
        pose: Pose,
    },
    /// A door was moved after the steps so far.
    Door {
        /// Name of the door.
        name: String,
        /// New state of the door.
        state: DoorState,
    },
}

/// One robot's step.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, bound = "")]
pub struct StepRecord<M: Recordable> {
    /// Number of steps since the run began, including this one.
    pub tick: u64,
    /// Microseconds since the run began.
    pub time_us: u64,
    /// Id of the robot.
    pub robot: RobotId,
    /// Command of the robot in this step.
    pub command: M::Command,
    /// Pose of the robot after the step.
    pub pose: Pose,
    /// Whether a contact cut the robot's motion.
    pub bump: bool,
    /// Readings of the robot after the step, if they were recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensing: Option<M::Sensing>,
}
