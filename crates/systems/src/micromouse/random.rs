use rand_chacha::ChaCha8Rng;
use tolman_maze::Walls;
use tolman_planners::moves::Leap;
use tolman_planners::{Passages, TooLarge, Unknown};

use super::SIDE;
use super::counter::pick;
use super::driver::{Next, Search, SearchView};

/// The paper's *random exploration* (section 3.2): take any way, "and choose to stop after we gain
/// about 70-80 percent knowledge out of the entire maze". Here that is 75 % of the inner walls. It
/// ignores dead ends and loops.
#[derive(Clone, Debug)]
pub struct RandomSearch {
    rng: ChaCha8Rng,
    arrived: bool,
}

/// The middle of "70-80 percent".
const KNOWN_PERCENT: u32 = 75;

impl RandomSearch {
    /// Returns a search without observations.
    #[must_use]
    pub const fn new(rng: ChaCha8Rng) -> Self {
        Self {
            rng,
            arrived: false,
        }
    }
}

impl Search for RandomSearch {
    fn next(&mut self, view: &SearchView<'_>) -> Result<Next, TooLarge> {
        self.arrived |= view.goals.contains(&view.at);
        let grid = view.map.grid();
        let inner = (grid.wall_count() - grid.border().count()) as u32;
        if self.arrived && 100 * (inner - view.map.unknown_count()) >= KNOWN_PERCENT * inner {
            return Ok(Next::Reset);
        }
        let known = Passages::<SIDE>::new(view.map, Unknown::Closed)?;
        let leaps: Vec<Leap> = Leap::all(&known, view.at).collect();
        Ok(pick(&leaps, &mut self.rng).map_or(Next::Turn, Next::Drive))
    }
}
