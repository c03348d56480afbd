use rand::{Rng, RngExt};
use tolman_control::Outcome;
use tolman_maze::Direction;

use super::{Brain, Perception};

/// MSLST's Wall-follow brain: "always sticks to the wall on its right".
///
/// Tries right first, then ahead, then left, then back, as seen from the direction it last travelled in;
/// whatever succeeds is the new direction. The first direction is drawn.
#[derive(Clone, Copy, Debug, Default)]
pub struct WallFollow {
    travelling: Option<Direction>,
    tried: usize,
}

impl Brain for WallFollow {
    fn choose(&mut self, perception: &Perception<'_>, rng: &mut dyn Rng) -> Direction {
        match perception.last {
            Some((action, Outcome::Completed)) => {
                self.travelling = Some(action);
                self.tried = 0;
            }
            Some(_) => self.tried = (self.tried + 1) % 4,
            None => {}
        }
        let travelling = *self
            .travelling
            .get_or_insert_with(|| Direction::ALL[rng.random_range(0..4_u32) as usize]);
        match self.tried {
            0 => travelling.right(),
            1 => travelling,
            2 => travelling.left(),
            _ => travelling.opposite(),
        }
    }
}
