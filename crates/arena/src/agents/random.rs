use rand::{Rng, RngExt};
use tolman_maze::Direction;

use super::{Brain, Perception};

/// The floor: any of the four directions, each time anew. Not in the paper.
#[derive(Clone, Copy, Debug, Default)]
pub struct Random;

impl Brain for Random {
    fn choose(&mut self, _perception: &Perception<'_>, rng: &mut dyn Rng) -> Direction {
        Direction::ALL[rng.random_range(0..4_u32) as usize]
    }
}
