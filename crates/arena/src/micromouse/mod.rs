//! The virtual maze of "Plot and Navigate a Virtual Maze" (Wang): a mouse, its two runs, and the referee.
//!
//! A [`Mouse`] is told what its three sensors see and answers with an [`Order`], up to 1000 times. In the first run it
//! explores; once it has been at the goal it may ask to be put back to the start, and has then to reach the goal in
//! the second run. The [`Referee`] moves it and keeps the score: a thirtieth of the steps of the first run, and those of
//! the second. A [`Trial`] is both runs of one mouse in one maze.
//!
//! The searches: [`Certify`] stops when the best run is proven, and hands out a [`Certificate`] that [`check`] verifies;
//! [`TargetSearch`], [`CounterSearch`] and [`RandomSearch`] are the paper's.
//!
//! [`noisy`] is the same mouse on the continuous simulator, among thick walls and with a particle filter.
//!
//! ```
//! use tolman_arena::micromouse::{Searcher, Trial, check};
//!
//! let text = "\
//! o---o---o---o---o
//! |               |
//! o   o---o---o   o
//! |   | G   G |   |
//! o   o   o   o   o
//! |   | G   G     |
//! o   o---o---o---o
//! | S             |
//! o---o---o---o---o
//! ";
//! let maze = tolman_maze::read(text)?.maze;
//! let mut mouse = Searcher::Certify.mouse(&maze, 0)?;
//! let trial = Trial::play(&maze, &mut *mouse)?;
//! assert_eq!(trial.verdict.run_2, Some(4));
//! let certificate = mouse.certificate().ok_or("no proof")?;
//! check(&certificate, &maze)?;
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod certificate;
mod certify;
mod counter;
mod driver;
mod judgement;
mod mouse;
pub mod noisy;
mod order;
mod q_learning;
mod random;
mod referee;
mod run_two;
mod searcher;
mod target;
mod trial;

pub use certificate::{Certificate, CertificateError, check};
pub use certify::Certify;
pub use counter::CounterSearch;
pub use driver::{Driver, Next, Search, View};
pub use judgement::{JudgeError, Judgement};
pub use mouse::{Mouse, MouseError, SIDE, Sight};
pub use order::{Movement, Order, OrderError, Rotation};
pub use q_learning::CellTask;
pub use random::RandomSearch;
pub use referee::{Event, MAX_STEPS, Referee, RefereeError, Verdict};
pub use run_two::RunTwo;
pub use searcher::{Searcher, UnknownSearcher};
pub use target::TargetSearch;
pub use trial::{Step, Trial, TrialError};
