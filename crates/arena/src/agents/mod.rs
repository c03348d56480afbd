//! The brains: one agent, one file, written to be read beside its paper.
//!
//! A [`Brain`] lives on what its robot perceives. A [`Yardstick`] is shown the truth instead; it is no
//! competitor but the measure of one: the best that the same body and the same layers allow.

mod avoid;
mod cast;
mod oracle;
mod random;
mod thought;
mod unlocalized;
mod wall_follow;

use core::fmt::Debug;

use rand::Rng;
use tolman_control::Outcome;
use tolman_geom::Heading;
use tolman_maze::Direction;
use tolman_robot::Scan;
use tolman_sim::Truth;

pub use avoid::Avoid;
pub use cast::{Agent, Cast};
pub use oracle::{Oracle, Policy};
pub use random::Random;
pub use thought::{Guess, Place, Thought};
pub use unlocalized::{Chart, UnlocalizedOracle};
pub use wall_follow::WallFollow;

/// What a brain is told when its next action is due.
#[derive(Clone, Copy, Debug)]
pub struct Perception<'a> {
    /// The action before this one and how it ended; none at the start.
    pub last: Option<(Direction, Outcome)>,
    /// The laser's ranges, in the robot's frame; none where the laser gave nothing.
    pub scan: Option<&'a Scan>,
    /// The compass heading; none where the compass gave nothing.
    pub heading: Option<Heading>,
}

/// Chooses high-level actions from what the robot perceives.
pub trait Brain: Debug {
    /// The next action.
    fn choose(&mut self, perception: &Perception<'_>, rng: &mut dyn Rng) -> Direction;

    /// What it made of its situation when it last chose; nothing, where a brain does not ask where it is.
    fn thought(&self) -> Thought {
        Thought::default()
    }
}

/// Chooses high-level actions from the truth.
pub trait Yardstick: Debug {
    /// The next action of a robot whose true state is `truth`.
    fn choose(
        &mut self,
        last: Option<(Direction, Outcome)>,
        truth: &Truth,
        rng: &mut dyn Rng,
    ) -> Direction;
}

/// Whoever chooses the actions.
#[derive(Debug)]
pub enum Mind {
    /// One that perceives.
    Brain(Box<dyn Brain>),
    /// One that is shown the truth.
    Yardstick(Box<dyn Yardstick>),
}
