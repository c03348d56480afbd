use tolman_planners::TooLarge;
use tolman_planners::moves::{
    MoveDecision, MoveExplorer, MoveExplorerConfig, MoveExplorerConfigError, RolloutConfig,
    Rollouts, WorthConfig,
};

use super::SIDE;
use super::driver::{Next, Search, SearchView};
use tolman_maze::{Cell, Grid};

/// Explores until the best run is known for certain: see [`MoveExplorer`] and [`Rollouts`].
#[derive(Clone, Debug)]
pub struct Certify(Explorer);

/// Search with or without rollouts. Most mazes have 16 × 16 cells; for them `Small` takes half the
/// memory of `Large`.
#[derive(Clone, Debug)]
enum Explorer {
    Plain(MoveExplorer<SIDE>),
    Small(Rollouts<16>),
    Large(Rollouts<SIDE>),
}

impl Certify {
    /// Returns a search in a maze of the size of `grid`, for runs from `start`, by a mouse without
    /// observations. `rollouts` is `None` to search without rollouts. With a `worth`, a search with
    /// rollouts stops as soon as the rest of the proof is expected to cost more than it gains.
    ///
    /// # Errors
    /// If a weight is out of its range.
    pub fn new(
        explorer: MoveExplorerConfig,
        rollouts: Option<RolloutConfig>,
        worth: Option<WorthConfig>,
        grid: Grid,
        start: Cell,
    ) -> Result<Self, MoveExplorerConfigError> {
        let is_small = grid.width().max(grid.height()) <= 16;
        Ok(Self(match rollouts {
            None => Explorer::Plain(MoveExplorer::new(explorer, start)?),
            Some(rollouts) if is_small => {
                Explorer::Small(with_rollouts(explorer, rollouts, worth, start)?)
            }
            Some(rollouts) => Explorer::Large(with_rollouts(explorer, rollouts, worth, start)?),
        }))
    }

    /// Returns the tuned search with rollouts until the proof, in a maze of the size of `grid`, for
    /// runs from `start`.
    ///
    /// # Errors
    /// If a weight is out of its range.
    pub fn tuned(grid: Grid, start: Cell) -> Result<Self, MoveExplorerConfigError> {
        let (explorer, rollouts) = (MoveExplorerConfig::tuned(), RolloutConfig::tuned());
        Self::new(explorer, Some(rollouts), None, grid, start)
    }
}

fn with_rollouts<const N: usize>(
    explorer: MoveExplorerConfig,
    rollouts: RolloutConfig,
    worth: Option<WorthConfig>,
    start: Cell,
) -> Result<Rollouts<N>, MoveExplorerConfigError> {
    let rollouts = Rollouts::new(MoveExplorer::new(explorer, start)?, rollouts)?;
    match worth {
        Some(worth) => rollouts.until_worth(worth),
        None => Ok(rollouts),
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
            MoveDecision::Finished { .. } | MoveDecision::Enough { .. } => Next::Reset,
            MoveDecision::Stuck => Next::Stuck,
        })
    }
}
