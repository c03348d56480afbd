use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Cell, Walls};
use tolman_planners::moves::Leap;
use tolman_planners::{Passages, TooLarge, Unknown};

use super::SIDE;
use super::driver::{Next, Search, SearchView};

/// The paper's *counter search* (section 3.3.2): to the least visited adjacent cell that is not a
/// dead end, until enough of the maze is visited. Section 3.4: "the search will continue even the
/// goal has already been visited until the threshold has been met".
///
/// The paper does not say how ties are broken, only that the method is stochastic. Here they are
/// broken at random. If all cells are dead ends, the least visited one is taken.
#[derive(Clone, Debug)]
pub struct CounterSearch {
    threshold_percent: u32,
    rng: ChaCha8Rng,
    arrived: bool,
}

impl CounterSearch {
    /// Returns a search that ends once `threshold_percent` of the cells and a goal were visited.
    #[must_use]
    pub const fn new(threshold_percent: u32, rng: ChaCha8Rng) -> Self {
        Self {
            threshold_percent,
            rng,
            arrived: false,
        }
    }
}

impl Search for CounterSearch {
    fn next(&mut self, view: &SearchView<'_>) -> Result<Next, TooLarge> {
        self.arrived |= view.goals.contains(&view.at);
        let cells = view.map.grid().cell_count();
        let visited = view.map.visited_count();
        if self.arrived && 100 * visited >= self.threshold_percent as usize * cells {
            return Ok(Next::Reset);
        }
        let known = Passages::<SIDE>::new(view.map, Unknown::Closed)?;
        let dead = |cell: Cell| view.map.is_dead_end(cell) && !view.goals.contains(&cell);
        let beside = || Leap::all(&known, view.at).filter(|leap| leap.cells == 1);
        let rank = |leap: &Leap| (dead(leap.end), view.map.visits(leap.end));
        let Some(least) = beside().map(|leap| rank(&leap)).min() else {
            return Ok(Next::Turn);
        };
        let ties: Vec<Leap> = beside().filter(|leap| rank(leap) == least).collect();
        Ok(pick(&ties, &mut self.rng).map_or(Next::Turn, Next::Drive))
    }
}

/// Returns a random leap.
pub(super) fn pick(leaps: &[Leap], rng: &mut impl Rng) -> Option<Leap> {
    let count = u32::try_from(leaps.len()).ok().filter(|count| *count > 0)?;
    leaps.get(rng.random_range(0..count) as usize).copied()
}
