use tolman_geom::Point;

use crate::{Material, WallSegment};

/// Whether a door lets through.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DoorState {
    /// Bodies and sensors pass through the door.
    Open,
    /// The door is a wall like any other.
    Shut,
}

/// A wall that can be opened and shut.
///
/// A door does not shut while a body stands in it; it waits until the body is out of the way.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Door {
    /// Name; unique in a world.
    pub name: String,
    /// One end, m.
    pub start: Point,
    /// The other end, m.
    pub end: Point,
    /// Material of the door.
    #[serde(default)]
    pub material: Material,
    /// State when a run begins.
    pub state: DoorState,
    /// Changes that the door makes by itself, in order of time.
    #[serde(default)]
    pub schedule: Vec<DoorEvent>,
}

impl Door {
    /// Returns the wall of the shut door.
    pub(crate) fn wall(&self) -> WallSegment {
        WallSegment {
            start: self.start,
            end: self.end,
            material: self.material,
        }
    }
}

/// One change of a door on schedule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DoorEvent {
    /// Time since the run began, µs.
    pub time_us: u64,
    /// State of the door from then on.
    pub state: DoorState,
}
