use tolman_planners::TooLarge;
use tolman_planners::moves::{
    MoveDecision, MoveExplorer, MoveExplorerConfig, RolloutConfig, Rollouts,
};

use super::driver::{Next, Search, SearchView};
use super::{MouseError, SIDE};
use tolman_maze::{Cell, Grid};

/// Explores until the best run is known for certain: see [`MoveExplorer`] and [`Rollouts`].
#[derive(Clone, Debug)]
pub struct Certify(Explorer);

/// Most mazes have 16 × 16 cells, and take half the room.
#[derive(Clone, Debug)]
enum Explorer {
    Plain(MoveExplorer<SIDE>),
    Small(Rollouts<16>),
    Large(Rollouts<SIDE>),
}

impl Certify {
    /// A search in a maze of the size of `grid`, for runs from `start`, by a mouse that has seen
    /// nothing; with rollouts or without.
    ///
    /// # Errors
    /// If a weight is out of its range.
    pub fn new(
        explorer: MoveExplorerConfig,
        rollouts: Option<RolloutConfig>,
        grid: Grid,
        start: Cell,
    ) -> Result<Self, MouseError> {
        let is_small = grid.width().max(grid.height()) <= 16;
        Ok(Self(match rollouts {
            None => Explorer::Plain(MoveExplorer::new(explorer, start)?),
            Some(rollouts) if is_small => Explorer::Small(Rollouts::new(
                MoveExplorer::new(explorer, start)?,
                rollouts,
            )?),
            Some(rollouts) => Explorer::Large(Rollouts::new(
                MoveExplorer::new(explorer, start)?,
                rollouts,
            )?),
        }))
    }
}

impl Search for Certify {
    fn next(&mut self, view: &SearchView<'_>) -> Result<Next, TooLarge> {
        let decision = match &mut self.0 {
            Explorer::Plain(explorer) => explorer.decide(view.map, view.goals, view.at),
            Explorer::Small(explorer) => explorer.decide(view.map, view.goals, view.at),
            Explorer::Large(explorer) => explorer.decide(view.map, view.goals, view.at),
        };
        Ok(match decision? {
            MoveDecision::Drive(leap) => Next::Drive(leap),
            MoveDecision::Turn => Next::Turn,
            MoveDecision::Finished { .. } => Next::Reset,
            MoveDecision::Stuck => Next::Stuck,
        })
    }
}
