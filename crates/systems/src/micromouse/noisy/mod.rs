//! The paper's mouse on wheels that slip, with sensors that err, among walls that have a thickness
//! (its section 6).
//!
//! Rules and search are those of the paper; but a step is driven by motors that miss, and the mouse
//! knows where it is from its commands and its range sensors alone. It holds a
//! [`PoseFilter`](tolman_maps::wall_belief::PoseFilter) on a
//! [`WallBelief`](tolman_maps::wall_belief::WallBelief) that grows with what it sees. It drives any
//! robot that turns and translates, has range sensors and a bumper.

mod config;
mod mouse;
mod system;

pub use config::{MotionSource, NoisyMouseConfig, NoisyMouseError, PoseSource};
pub use mouse::{NoisyBody, NoisyMouse, NoisyNext};
