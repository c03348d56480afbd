//! The lines of a trace as they stand in the file.

use serde::{Deserialize, Serialize};
use tolman_geom::Pose;

use super::Recordable;
use crate::DoorState;

pub(super) const FORMAT: &str = "tolman-trace";
pub(super) const VERSION: u32 = 1;

/// The first line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct Header<M: Recordable> {
    pub(super) format: String,
    pub(super) version: u32,
    /// The seed of all chance.
    pub(super) seed: u64,
    /// The length of a time step, µs.
    pub(super) step_us: u64,
    pub(super) robots: Vec<Start<M>>,
    /// A world file.
    pub(super) world: serde_json::Value,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct Start<M: Recordable> {
    pub(super) config: M::Config,
    pub(super) pose: Pose,
}

/// Any further line.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case", bound = "")]
pub(super) enum Line<M: Recordable> {
    /// A robot carried out a command.
    Step(Step<M>),
    /// A robot was lifted and set down.
    Place { robot: u32, pose: Pose },
    /// A door was moved.
    Door { name: String, state: DoorState },
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct Step<M: Recordable> {
    pub(super) tick: u64,
    pub(super) time_us: u64,
    pub(super) robot: u32,
    pub(super) command: M::Command,
    pub(super) pose: Pose,
    pub(super) bump: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) sensing: Option<M::Sensing>,
}
