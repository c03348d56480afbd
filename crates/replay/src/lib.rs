//! Replays: one HTML file that plays a run, for every system and every robot.
//!
//! A [`Replay`] is the player's input: a static [`Scenery`], and a [`RobotTrack`] with the poses of
//! each robot. Layers, which are specific to no system, hold the robot's knowledge over time. The
//! robot's own layers are the [`MapGrowth`] of the map it learned and its [`Belief`]. Others are
//! [`Field`]s over the floor, [`TimeSeries`] of numbers, [`Notes`] in words and [`Marks`] on the
//! time line. A new system hands these over and needs no line of JavaScript.
//!
//! Replays come from a [trace](Replay::of_traces) or from a run that was watched. [`page`] makes
//! the file, and with the feature `mcap` the function `mcap` one for Foxglove. A page that holds
//! many replays carries [`script`] and [`style`] once and calls `TolmanReplay.open(element, data)`
//! with what [`json`] wrote; `docs/replay.md` has the format.
//!
//! ```
//! use tolman_replay::{page, Replay, RobotTrack, Scenery};
//! use tolman_geom::{Heading, Point, Pose};
//! use tolman_robot::Body;
//!
//! let pose = |x| Pose::new(Point::new(x, 0.5), Heading::EAST);
//! let track = RobotTrack::new("robot", Body::Circle { radius: 0.1 }, vec![pose(0.2), pose(0.7)]);
//! let scenery = Scenery {
//!     walls: vec![[Point::new(0.0, 0.0), Point::new(1.0, 0.0)]],
//!     ..Scenery::default()
//! };
//! let replay = Replay::new("Two steps", 0.1, scenery, vec![track]);
//! assert!(page(&replay)?.starts_with("<!DOCTYPE html>"));
//! # Ok::<(), tolman_replay::EncodeError>(())
//! ```
//!
//! # A run that is played
//!
//! `cargo run --example there_and_back`:
#![doc = "```"]
#![doc = include_str!("../examples/there_and_back.rs")]
#![doc = "```"]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use tolman_draw as draw;
pub use tolman_geom as geom;
pub use tolman_maze as maze;
pub use tolman_robot as robot;
pub use tolman_sim as sim;

mod blob;
mod difference;
mod encode;
mod events;
mod floor;
mod knowledge;
#[cfg(feature = "mcap")]
mod mcap_file;
mod model;
mod moving_picture;
mod of_trace;
mod page;
mod rounding;
mod scenery;
mod thin;

pub use difference::{Difference, Differs};
pub use encode::{EncodeError, json};
pub use events::{EventContent, FloorDisc, FloorDrawing, ReplayEvent, Rgba, WORLD, events};
pub use floor::Floor;
pub use knowledge::{
    Belief, BeliefAt, EdgeKind, Exemplar, Field, FieldChange, MapEdge, MapGrowth, MapNode, Mark,
    Marks, NodeLabel, NodeMove, Note, Notes, Sample, Shape, TimeSeries,
};
#[cfg(feature = "mcap")]
pub use mcap_file::{McapExportError, mcap};
pub use model::{Chapter, Fact, Replay, RobotTrack, Scans};
pub use moving_picture::moving_picture;
pub use of_trace::{CompareError, Portrait, Trace, TraceComparison};
pub use page::{is_replay, page, script, style};
pub use scenery::{DoorChange, Scenery, SceneryDoor, SceneryZone, ZoneKind};
