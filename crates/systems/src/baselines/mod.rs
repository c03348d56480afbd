//! Brains without a map: the baselines of MSLST, and Q-learning.
//!
//! [`AvoidBrain`] and [`WallFollow`] are the paper's, [`Random`] is the floor. An
//! [`Actor`](crate::Actor) lets them drive; their map is empty.

mod avoid;
pub mod q_learning;
mod random;
mod wall_follow;

pub use avoid::AvoidBrain;
pub use random::Random;
pub use wall_follow::WallFollow;
