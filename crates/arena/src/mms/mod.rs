//! A headless host for mice that speak the protocol of the simulator
//! [mms](https://github.com/mackorone/mms), which most hobbyists use.
//!
//! A mouse is a program that writes commands to stdout, one per line, and reads replies from stdin.
//! The [`Simulator`] answers the commands as mms does, and the [`Score`] counts as mms does.
//! [`host()`] starts the program and connects the two, with a limit on time and on movements.
//! [`play`](tolman_systems::micromouse::mms::play) is a mouse of our own.
//!
//! ```
//! use tolman_arena::mms::Simulator;
//!
//! let maze = tolman_maze::read("+---+---+\n|     G |\n+   +   +\n| S |   |\n+---+---+\n")?.maze;
//! let mut simulator = Simulator::new(&maze);
//! assert_eq!(simulator.answer("wallRight").as_deref(), Some("true"));
//! assert_eq!(simulator.answer("moveForward").as_deref(), Some("ack"));
//! assert_eq!(simulator.answer("moveForward").as_deref(), Some("crash"));
//! // What only draws is not answered.
//! assert_eq!(simulator.answer("setWall 0 1 n"), None);
//! # Ok::<(), tolman_maze::MazeError>(())
//! ```

mod exchange;
mod host;
#[cfg(test)]
mod mouse_tests;
mod score;
mod simulator;

pub use exchange::Exchange;
pub use host::{Hosted, Limits, MouseExit, host};
pub use score::{Figures, Score, Unit};
pub use simulator::Simulator;
