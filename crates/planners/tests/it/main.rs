//! The planners seen from outside.
#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that cannot go on fails"
)]

#[cfg(feature = "alloc")]
extern crate alloc;

mod against_petgraph;
mod compression;
mod expected_costs;
#[cfg(feature = "serde")]
mod files;
#[cfg(feature = "alloc")]
mod moves;
mod pose_set;
mod speed_run;
mod too_large;
