//! Replays as `.rrd` files, which [Rerun](https://rerun.io) opens.
//!
//! [`rrd`] writes the [events](tolman_replay::events) of a replay. Coordinates are metres, x to the
//! right, y upwards and z out of the floor. The timelines are `step` and `time`.
//!
//! | entity | archetype | holds |
//! | --- | --- | --- |
//! | `/world/scene/…` | `LineStrips3D` | walls, zones and doors |
//! | `/world/robot NAME` | `Transform3D` | the pose, a row a step |
//! | `/world/robot NAME/body` | `LineStrips3D` | the outline, in the robot's frame |
//! | `/world/robot NAME/scan` | `Points3D` | what recorded beams met, in the robot's frame |
//! | `/world/NAME/map/MAP/node N` | `Points3D` | a node of a map while it lives, as it moves |
//! | `/world/NAME/map/MAP/edge N` | `LineStrips3D` | an edge while it lives |
//! | `/world/NAME/belief/BELIEF/belief` | `Points3D` | the believed positions |
//! | `/NAME/SERIES` | `Scalars` | a time series |
//! | `/log/…` | `TextLog` | notes and marks |
//! | `/facts` | `TextDocument` | the facts of the run |
//!
//! The package's command `tolman-rerun` is the command `tolman`, whose `--replay FILE.rrd` writes
//! such a file.

mod drawing;
mod entity;
mod recording;
#[cfg(test)]
mod tests;

pub use recording::{RrdExportError, rrd};
