//! The mice of "Plot and Navigate a Virtual Maze" (Wang), and of the competitions.
//!
//! A [`Brief`] is all that a mouse is told of a maze; it learns the walls only by its sensors. In
//! the paper's rules a mouse, a [`Driver`], gets the readings of its three sensors and answers with
//! an [`Order`]. In its first run it explores. Once it has been at the goal it may ask to be put
//! back at the start for its second run.
//!
//! A [`Driver`] has a [`Search`] for its first run and a plan for its second, [`RunTwo`].
//! [`Certify`] stops when the best run is proven and hands out a [`Certificate`]; [`TargetSearch`],
//! [`CounterSearch`] and [`RandomSearch`] are the paper's; [`WholeMaze`] visits every cell. A
//! [`Searcher`] names one of them.
//!
//! [`system`] puts the searches behind the interface of all systems, to drive a robot with a laser
//! ring. [`noisy`] is the same mouse for wheels that slip and sensors that err, with a particle
//! filter. [`competition`] explores for the fastest run instead of the shortest. [`mms`] plays in
//! the simulator of that name, over its line protocol.
//!
//! ```
//! use tolman_maze::{Cell, Direction, Grid};
//! use tolman_systems::micromouse::{Brief, Order, Searcher, Sight};
//!
//! let brief = Brief {
//!     grid: Grid::new(1, 3),
//!     start: Cell::new(0, 0),
//!     heading: Direction::North,
//!     goals: vec![Cell::new(0, 2)],
//! };
//! let mut mouse = Searcher::Certify.mouse(&brief, 0)?;
//! let sight = |front| Sight { left: 0, front, right: 0 };
//! assert_eq!(mouse.next(sight(2))?, Order::new(0, 2), "ahead to the goal");
//! assert_eq!(mouse.next(sight(0))?, Order::RESET, "no run can be shorter");
//! assert_eq!(mouse.next(sight(2))?, Order::new(0, 2));
//! assert_eq!(mouse.certificate().map(|proof| proof.run.len()), Some(2));
//! # Ok::<(), tolman_systems::micromouse::MouseError>(())
//! ```

mod brief;
mod certificate;
mod certify;
pub mod competition;
mod counter;
mod driver;
mod grid_map;
pub mod mms;
mod mouse;
pub mod noisy;
mod order;
mod random;
mod run_two;
mod searcher;
pub mod system;
mod target;
mod until;
mod whole_maze;

pub use brief::Brief;
pub use certificate::Certificate;
pub use certify::Certify;
pub use counter::CounterSearch;
pub use driver::{Driver, Next, Search, SearchView};
pub use mouse::{MouseError, SIDE, Sight};
pub use order::{Movement, Order, OrderError, Rotation};
pub use random::RandomSearch;
pub use run_two::RunTwo;
pub use searcher::{Searcher, UnknownSearcher};
pub use target::TargetSearch;
pub use until::Until;
pub use whole_maze::WholeMaze;
