//! MSLST: maze solving by learning state topologies (Tingle, Ball, Augat).
//!
//! "The MSLST algorithm uses a three-stage process to solve a maze, first using GNG to abstract
//! perceptions of the maze into discrete states, then by mapping the topology of those states
//! within the maze into a graph, and finally using that graph to localize a robot within the maze
//! and find the most direct path to the destination."
//!
//! - [`ScanRecorder`] and [`States`] are Phase I: scans of a wandering robot become states.
//! - [`Topology`] is Phase II: the graph of the states, an action at a time. Both leave an
//!   [`MslstMap`].
//! - [`Navigator`] is Phase III: the brain that navigates by one.
//! - [`Mslst`] is all three, one by one.
//! - [`better`] explores and navigates in another way; [`BetterMslst`] is both, one by one.
//! - [`MapFile`] keeps a map.
//!
//! ```no_run
//! use tolman_control::Stack;
//! use tolman_robot::{
//!     Compass, Goal, Landmark, Ranges, Ring, Robot, SensesLandmarks, Standing, System, Task, TurnTranslate,
//! };
//! use tolman_systems::Actor;
//! use tolman_systems::mslst::{Mslst, MslstConfig, ROBOT_UNIT};
//!
//! /// Lets any robot of 72 beams learn its maze, and then find the goal.
//! fn learn_and_solve<R>(robot: &mut R) -> Result<(), Box<dyn std::error::Error>>
//! where
//!     R: Robot<Command = TurnTranslate> + SensesLandmarks,
//!     R::Sensing: Ranges + Compass,
//!     R::Error: std::error::Error + 'static,
//! {
//!     let layers = Stack::paper(Ring::full(72, 1.25), ROBOT_UNIT, 0.95)?;
//!     let mut mslst = Actor::seeded(Mslst::new(MslstConfig::j()), layers, 1);
//!     for task in [Task::Explore, Task::Reach(Goal::Landmark(Landmark::Goal))] {
//!         while mslst.act(robot, task)? == Standing::UnderWay {}
//!     }
//!     Ok(())
//! }
//! ```

pub mod better;
mod better_mslst;
mod brain;
mod config;
mod map;
mod map_file;
mod navigate;
mod north_scan;
mod scan_recorder;
mod states;
mod topology;

pub use better_mslst::BetterMslst;
pub use brain::Mslst;
pub use config::MslstConfig;
pub use map::{GrowthRecord, Learned, MslstMap};
pub use map_file::{MapFile, MapFileError};
pub use navigate::{NavigationState, Navigator};
pub use north_scan::{ROBOT_UNIT, heading_free};
pub use scan_recorder::ScanRecorder;
pub use states::{States, StatesError};
pub use topology::Topology;
