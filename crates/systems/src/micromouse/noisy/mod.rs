//! The paper's mouse with slipping wheels and noisy sensors, among walls that have a thickness (the
//! paper's section 6).
//!
//! Rules and search are those of the paper. But its motors are inexact, and it estimates its pose
//! only from its commands and its range sensors. It holds a
//! [`PoseFilter`](tolman_maps::wall_belief::PoseFilter) on a
//! [`WallBelief`](tolman_maps::wall_belief::WallBelief) that grows with its readings. It drives any
//! robot that turns and translates, and has range sensors and a bumper.

mod config;
mod mouse;
mod system;

pub use config::{MotionSource, NoisyMouseConfig, NoisyMouseError, PoseSource};
pub use mouse::{NoisyBody, NoisyMouse};
