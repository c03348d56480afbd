//! The speed run of a micromouse: the fastest way to the goal with straights, diagonals, slalom
//! turns and acceleration. Also the exploration that proves it to be the fastest.
//!
//! A [`SpeedRunConfig`] says how the mouse drives, [`SpeedRunTimes`] how long each move takes then.
//! On [`Passages`](crate::Passages) a [`SpeedRunMap`] finds how long the best run takes from
//! everywhere, and the run itself. A [`SpeedRunPlanner`] keeps the run up to date while walls are
//! found. A [`SpeedRunExplorer`] decides where to look for walls. A [`SpeedRunCertificate`]
//! convinces a checker that shares no code with them.
//!
//! ```
//! use tolman_maze::{Cell, Direction};
//! use tolman_planners::speed_run::{Extent, RunState, SpeedRunConfig, SpeedRunMap, SpeedRunTimes};
//! use tolman_planners::{Passages, Unknown};
//!
//! let text = "\
//! o---o---o---o---o
//! | S             |
//! o---o---o---o   o
//! |   |       |   |
//! o   o   o   o   o
//! |         G |   |
//! o   o   o---o   o
//! |   |           |
//! o---o---o---o---o
//! ";
//! # #[cfg(feature = "alloc")] {
//! let maze = tolman_maze::read(text)?.maze;
//! let times = SpeedRunTimes::<16>::new(&SpeedRunConfig::classic())?;
//! let passages = Passages::new(&maze, Unknown::Closed)?;
//! let mut map = SpeedRunMap::<16>::new();
//! map.search(&passages, &times, maze.goals(), Extent::Everywhere);
//!
//! let start = RunState::Straight { cell: Cell::new(0, 3), heading: Direction::East };
//! assert_eq!(map.time_ms(start), Some(2446));
//! for step in map.run(&passages, &times, start) {
//!     println!("{:?}", step.run_move);
//! }
//! # }
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! The model is that of kerikun11/micromouse-maze-library (`StepMapSlalom`), and so are the values
//! for half-size mazes. It deviates in two points. Times are whole milliseconds,
//! straights rounded up, where the library cuts them down to multiples of two. And the search is
//! exact: the library stops looking along a straight where another run is faster, although its own
//! could be faster farther on.
//!
//! Nothing here allocates, except for the checker, and nothing panics: sizes are const generics.

mod buckets;
mod cell_times;
#[cfg(feature = "alloc")]
mod certificate;
mod config;
mod estimate;
mod explorer;
mod map;
mod moves;
mod planner;
mod run;
mod state;
mod times;
mod turn;
mod ways;

pub use cell_times::CellTimes;
#[cfg(feature = "alloc")]
pub use certificate::{SpeedRunCertificate, SpeedRunCertificateError, best_possible_ms};
pub use config::{SearchPace, SpeedProfile, SpeedRunConfig, SpeedRunConfigError};
pub use explorer::{Decision, ExploreStage, SpeedRunExplorer};
pub use map::{Extent, SpeedRunMap};
pub use moves::{RunMove, RunStep, Side, Slalom};
pub use planner::{Replanning, SpeedRunPlanner};
pub use run::SpeedRun;
pub use state::RunState;
pub(crate) use state::{beside, opposite};
pub use times::SpeedRunTimes;
pub use turn::{DrivenTurn, SlalomTurn, SlalomTurns};
