//! The maps seen from outside.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that cannot set itself up has failed"
)]

extern crate alloc;

mod audit;
mod bump_map;
mod corridor_map;
mod cpm;
mod diktiometry;
#[cfg(feature = "serde")]
mod files;
mod memory;
mod moves;
mod mslst_graph;
mod pinned;
mod place_graph;
mod place_map;
mod scan_map;
mod scan_matching;
mod wall_belief;
mod wall_map;
