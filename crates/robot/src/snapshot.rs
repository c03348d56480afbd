use alloc::vec::Vec;

use crate::{LaserSensing, Picture, Sounding, Soundings};

/// Perception of a robot at its place, by any sensors.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snapshot {
    /// Readings of the robot's range sensors.
    pub soundings: Vec<Sounding>,
    /// Picture of the robot's camera; `None` for a robot without one.
    pub picture: Option<Picture>,
}

/// Can take a snapshot: senses ranges, a picture, or both.
pub trait TakesSnapshots: Soundings {
    /// Returns the snapshot of this time step; `None` while it would be incomplete, such as without
    /// a picture while the robot moves.
    fn snapshot(&self) -> Option<Snapshot>;
}

/// Snapshots of the laser's readings alone.
impl<S: AsRef<LaserSensing>> TakesSnapshots for S {
    fn snapshot(&self) -> Option<Snapshot> {
        let soundings: Vec<Sounding> = self.soundings().collect();
        (!soundings.is_empty()).then_some(Snapshot {
            soundings,
            picture: None,
        })
    }
}
