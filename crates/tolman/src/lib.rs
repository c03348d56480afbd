//! Agents, the experiments that measure them, and what is shown of the results.
//!
//! In the order data flows: a [`course`] is a maze made ready for runs, the [`pioneer`] the robot that
//! runs in it, one of the [`agents`] its mind, a [`drive`] what carries out the actions, and an [`episode`] one run. An [`experiment`] plays
//! every run of its tables, [`stats`] weighs the runs against each other and against the paper,
//! [`draw`] makes pictures of them, [`replay`] plays them and [`report`] gathers everything on one page. [`data`] finds what
//! other people measured, [`files`] writes ours; [`shell`] spells commands. In the [`competition`] a micromouse
//! explores a maze for its speed run. [`q_learning`] is what papers set themselves against.

extern crate alloc;

pub mod agents;
pub mod competition;
pub mod course;
pub mod data;
pub mod draw;
pub mod drive;
pub mod episode;
pub mod experiment;
pub mod files;
pub mod micromouse;
pub mod mms;
pub mod pioneer;
pub mod q_learning;
pub mod replay;
pub mod report;
pub mod shell;
pub mod stats;
