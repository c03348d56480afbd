//! A map of places and their positions, learned while the robot moves. The map corrects the robot's
//! pose.
//!
//! It follows the paper's list of future work (section 6). That list asks for displacement
//! "relative to the previous point", features in place of pixels, and a map that corrects the
//! odometry. In the order data flows:
//!
//! 1. An [`Outline`] holds the things round the robot in a snapshot. Points mark where things stand
//!    on the floor, with their colours. Arcs mark where sonars heard things.
//! 2. [`WheelError`] is the map's estimate of the wheels' errors, by which it predicts the robot's
//!    pose.
//! 3. The prediction is fitted to the map: the surfaces that all places have seen.
//! 4. A [`PlaceGraph`] keeps the places, each with its outline, in a
//!    [`PoseGraph`](crate::pose_graph::PoseGraph) whose closures are the places that a fit has
//!    recognized. While the robot's pose is unknown, the graph follows several hypotheses.

mod config;
mod fit;
mod foot_line;
mod graph;
mod hypotheses;
mod outline;
#[cfg(feature = "serde")]
mod saved;
mod surfaces;
mod wheels;

pub use config::PlaceGraphConfig;
pub use foot_line::foot_line;
pub use graph::{PlaceGraph, PlaceGraphError, SeenThere};
pub use outline::{Outline, OutlinePoint};
#[cfg(feature = "serde")]
pub use saved::{SavedPlaceGraph, SavedPlaceGraphError};
pub use wheels::WheelError;
