//! Systems, robots and families of worlds by name: the one list that the command, the papers'
//! tables, Python and the playground read.
//!
//! A [`SystemEntry`] says what a system is called, which robots can carry it, and how it is made
//! ready on one of them. A [`RobotEntry`] is a simulated robot with its noise. A [`Registry`] lists
//! both beside the [families](Family) of worlds. To add your own, [install](Registry::install) a
//! longer list before anything is looked up.

mod any_robot;
mod entry;
mod laser_entry;
mod learned_map;
mod list;
mod robots;
mod schooling;
mod setup;
mod start;
mod systems;
mod view_file;

pub use any_robot::{AnyRobot, ForRobot, RobotFailure};
pub use entry::{DemoWorld, DrivesBy, LogMapper, SystemEntry, SystemFacts};
pub use laser_entry::LaserEntry;
pub use learned_map::{LearnedMap, MapText};
pub use list::{Registry, slug};
pub use robots::{LaserLike, LaserModel, RobotEntry, RobotKind};
pub use schooling::Schooling;
pub use setup::{AllSettings, Settings, Setup, UnknownName};
pub use start::Start;
pub(crate) use view_file::view_file;

use crate::BoxError;
use crate::family::Family;

/// Returns an error that says what failed, `what`, with the error that was the reason.
pub(crate) fn because(what: impl Into<String>, source: impl Into<BoxError>) -> BoxError {
    Box::new(Because {
        what: what.into(),
        source: source.into(),
    })
}

#[derive(Debug, thiserror::Error)]
#[error("{what}")]
struct Because {
    what: String,
    source: BoxError,
}
