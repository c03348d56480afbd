//! Plays the virtual maze of "Plot and Navigate a Virtual Maze" (Wang): the two runs of a mouse,
//! under a referee.
//!
//! A mouse, a [`Driver`](tolman_systems::micromouse::Driver), may give up to 1000 orders. In the
//! first run it explores; in the second it has to reach the goal. The [`Referee`] moves it and
//! keeps the score: a thirtieth of the steps of the first run, plus those of the second. A
//! [`MouseTrial`] is both runs of one mouse in one maze, and a [`Judgement`] its quality. [`check`]
//! verifies a mouse's proof that its second run is the best.
//!
//! ```
//! use tolman_arena::micromouse::{brief, check, MouseTrial};
//! use tolman_systems::micromouse::Searcher;
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
//! let mut mouse = Searcher::Certify.mouse(&brief(&maze)?, 0)?;
//! let trial = MouseTrial::play(&maze, &mut mouse, |_, _| {})?;
//! assert_eq!(trial.verdict.run_2, Some(4));
//! let certificate = mouse.certificate().ok_or("no proof")?;
//! check(certificate, &maze)?;
//! # Ok::<(), tolman_arena::BoxError>(())
//! ```

mod certificate;
mod judgement;
pub mod noisy;
mod q_learning;
mod referee;
mod trial;

pub use certificate::{CertificateError, check};
pub use judgement::{Judgement, floor, send, try_on};
pub use q_learning::CellTask;
pub use referee::{MAX_STEPS, Referee, RefereeError, Ruling, ScoreSheet, brief};
pub use trial::{MouseTrial, RefereedStep, SideSeen, sides_seen};
