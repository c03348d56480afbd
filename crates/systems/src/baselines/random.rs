use core::convert::Infallible;

use rand::{Rng, RngExt};
use tolman_maze::Direction;
use tolman_robot::Mapper;

use crate::{Brain, TimeStep};

/// The lower bound: draws one of the four directions for each action. Not in the paper.
#[derive(Clone, Copy, Debug, Default)]
pub struct Random;

impl Mapper for Random {
    type Observation = TimeStep;
    type Error = Infallible;

    fn observe(&mut self, _seen: &TimeStep) -> Result<(), Infallible> {
        Ok(())
    }
}

impl Brain for Random {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        Direction::ALL[rng.random_range(0..4_u32) as usize]
    }
}
