//! Agents, the experiments that measure them, and what is shown of the results.
//!
//! In the order data flows: an [`experiment`] plays every run of its tables, [`stats`] weighs the
//! runs against each other and against the paper, [`draw`] makes pictures of them and [`report`]
//! gathers everything on one page.

extern crate alloc;

pub mod draw;
pub mod experiment;
pub mod report;
pub mod stats;
