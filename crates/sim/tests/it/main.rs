//! The simulator as its users see it.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot set itself up has failed"
)]

mod bodies;
mod camera;
#[cfg(feature = "parry2d")]
mod casters;
mod disturbances;
mod epuck;
mod leaks;
mod noise;
mod pioneer_2dx;
mod sensing;
mod traces;
mod two_crates;
mod worlds;
