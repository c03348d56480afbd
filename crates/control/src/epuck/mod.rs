//! An e-puck in corridors: the control level of CPM's robot.
//!
//! Kawewong, Honda, Tsuboyama, Hasegawa: "Reasoning on the Self-Organizing Incremental Associative
//! Memory for Online Robot Path Planning", sections 3.2 and 4.1, figure 2. In the order data flows:
//!
//! 1. [`RangeCurve`]: the raw values of the proximity sensors as ranges, and as [`Echoes`] round
//!    the robot.
//! 2. [`Forward`], layer 1: drive forward along the path. [`KeepOff`], layer 0, corrects it: keep
//!    off walls.
//! 3. [`Sweep`]: all eight sensors once round, 100 samples each, made one [`Profile`].
//! 4. [`Profile::segments`]: where the profile changes, and what lies between: [`Segments`] with
//!    their [`spaces`](Segments::spaces) and the [`feature`](Segments::feature).
//! 5. [`Profile::meet_point`]: the middle of a junction.
//! 6. [`Pilot`]: carries all this out on a [`Robot`](tolman_robot::Robot). The levels above (layer
//!    3, the mapper and planner) ask it for a sweep, half a second of path, or a turn.

mod echoes;
mod forward;
mod keep_off;
mod meet_point;
mod pilot;
mod profile;
mod range_curve;
mod segments;
mod sweep;

pub use echoes::Echoes;
pub use forward::{Forward, ForwardConfig};
pub use keep_off::KeepOff;
pub use meet_point::MeetPointConfig;
pub use pilot::{Pilot, PilotConfig, PilotError, TURN_STEP};
pub use profile::{Profile, ProfileError, SensorAlignment};
pub use range_curve::{RangeCurve, RangeCurveError};
pub use segments::{FEATURES, PlaceKind, Segment, SegmentConfig, SegmentError, Segments};
pub use sweep::Sweep;
