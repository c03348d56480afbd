use thiserror::Error;

use super::WallSegment;

/// Reason why a world cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum WorldError {
    /// The corridors have no width.
    #[error("the corridor width is {corridor_width} m; give a positive number of metres")]
    CorridorWidth {
        /// The offending width, m.
        corridor_width: f64,
    },
    /// The walls' thickness is negative.
    #[error("the wall thickness is {wall_thickness} m; give 0 or more metres")]
    WallThickness {
        /// The offending thickness, m.
        wall_thickness: f64,
    },
    /// Nothing stands.
    #[error("the world has no walls; give at least one")]
    NoWalls,
    /// A wall is invalid.
    #[error(
        "wall {index} from ({}, {}) to ({}, {}) m {what}; correct or remove it",
        wall.start.x, wall.start.y, wall.end.x, wall.end.y
    )]
    Wall {
        /// Number of the wall, from 0.
        index: usize,
        /// Wall that is invalid.
        wall: WallSegment,
        /// The fault, in words.
        what: &'static str,
    },
    /// A door is invalid.
    #[error("door `{name}` {what}; correct or remove it")]
    Door {
        /// Name of the door.
        name: String,
        /// The fault, in words.
        what: &'static str,
    },
    /// Two doors have one name.
    #[error("there are two doors named `{name}`; rename one")]
    DoorTwice {
        /// Name that was given.
        name: String,
    },
    /// A door's schedule goes back in time.
    #[error("the schedule of door `{name}` is not in order at {time_us} µs; sort it by time")]
    DoorSchedule {
        /// Name of the door.
        name: String,
        /// Time of the first event that is not later than the one before it, µs.
        time_us: u64,
    },
    /// A zone has an area without extent.
    #[error("area {index} of zone `{name}` has no extent; give it a positive size in metres")]
    Zone {
        /// Name of the zone.
        name: String,
        /// Index of the area, from 0.
        index: usize,
    },
    /// Two zones have one name.
    #[error("there are two zones named `{name}`; rename one or give one zone both areas")]
    ZoneTwice {
        /// Name that was given.
        name: String,
    },
    /// The size and the cells of an occupancy grid disagree.
    #[error(
        "the occupancy grid is {width} × {height} cells of {resolution} m with {bits} values; give a \
         positive size and resolution and one value per cell"
    )]
    Occupancy {
        /// Number of columns.
        width: usize,
        /// Number of rows.
        height: usize,
        /// Size of a cell, m.
        resolution: f64,
        /// Number of values that the grid holds.
        bits: usize,
    },
    /// No cell of an occupancy grid is free.
    #[error("every cell of the occupancy grid is occupied; leave at least one free")]
    NoFloor,
}
