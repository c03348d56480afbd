//! The action model of "Plot and Navigate a Virtual Maze" (Wang), and how to explore in it with a
//! proof.
//!
//! In one step the mouse turns by a quarter or not at all. Then it drives up to three cells, ahead
//! or back ([`MouseStep`], section 1.1 of the paper). What counts is the number of steps, not of
//! cells. The paper plans in cells and converts the path afterwards, and says itself what that
//! costs: 23 steps where 22 would do (section 3.4). Here the search itself is in steps: a
//! [`MoveMap`] counts the fewest of them to some cells.
//!
//! That search needs no headings. Whatever its heading, one step takes the mouse to any of the four
//! sides: ahead or back without a turn, left or right with one. So a step is an [arc](Leap) from
//! cell to cell: up to three cells in a row without a wall between them.
//!
//! A [`MoveExplorer`] decides where to stop next, until the best possible run takes as many steps
//! as the best certain one.
//!
//! ```
//! use tolman_maze::{Cell, Direction, Grid, Maze};
//! use tolman_planners::moves::{MouseStep, MoveMap, QuarterTurn};
//! use tolman_planners::{Passages, Unknown};
//!
//! // Four cells to the north, then one to the west: three steps.
//! let maze = Maze::open(Grid::new(16, 16));
//! let passages = Passages::<16>::new(&maze, Unknown::Closed)?;
//! let map = MoveMap::new(&passages, [Cell::new(7, 8)]);
//! let start = Cell::new(8, 4);
//! assert_eq!(map.moves(start), Some(3));
//!
//! let leaps = map.way(&passages, start);
//! let mut heading = Direction::South;
//! let steps = leaps.map(|leap| MouseStep::of_leap(&mut heading, leap));
//! let expect = [
//!     MouseStep { turn: QuarterTurn::None, cells: -1 },
//!     MouseStep { turn: QuarterTurn::None, cells: -3 },
//!     MouseStep { turn: QuarterTurn::Right, cells: 1 },
//! ];
//! assert!(steps.eq(expect));
//! # Ok::<(), tolman_planners::TooLarge>(())
//! ```
//!
//! Nothing here allocates and nothing panics: sizes are const generics.

mod cell_set;
mod chart;
mod completion;
mod config;
mod explorer;
mod leap;
mod map;
mod outlook;
mod play;
mod rival;
mod rivals;
mod rollouts;
mod sides;
mod split_mix;
mod step;
mod stops;
mod wall_odds;
mod worth;

pub use config::{MoveExplorerConfig, MoveExplorerConfigError};
pub use explorer::{MoveDecision, MoveExplorer};
pub use leap::Leap;
pub use map::{MoveMap, Way};
pub use rollouts::{RolloutConfig, Rollouts};
pub use step::{MouseStep, QuarterTurn};
pub use worth::WorthConfig;
