//! Worlds made ready for robots, and the loops that run systems in them.
//!
//! In the order data flows: a [`course`] is a maze made ready for runs, the [`pioneer`] the robot that
//! runs in it, one of the [`agents`] its mind, a [`drive`] what carries out the actions, and an [`episode`] one run.
//! [`micromouse`] is a paper's mouse and its referee; in the [`competition`] a micromouse
//! explores a maze for its speed run. [`mms`] is the protocol of the simulator of that name. [`q_learning`] is what papers set themselves against.

extern crate alloc;

pub mod agents;
pub mod competition;
pub mod course;
pub mod cpm;
pub mod diktiometry;
pub mod drive;
pub mod episode;
pub mod micromouse;
pub mod mms;
pub mod mslst;
pub mod pioneer;
pub mod q_learning;
pub mod run;

use tolman_systems::file_kind;
