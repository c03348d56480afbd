use core::borrow::BorrowMut;

use tolman_maze::{Cell, Direction, Knowledge, Walls};

use super::{CellTimes, RunState, SpeedRunMap, SpeedRunPlanner, SpeedRunTimes};
use crate::{Passages, StepMap, TooLarge, Unknown};

/// Explores a maze cell by cell until the best speed run is known for certain, and comes back.
///
/// In every cell it takes the best run that can be hoped for, with all unknown walls open. If all
/// walls of that run are known, it is the best of all and the exploration is over. Otherwise the
/// mouse drives to the nearest cell beside one of the unknown walls. On the way out the goals count
/// as such cells too, so that it has been there in the end.
///
/// The explorer compares its stored passages with `walls` at each call. So walls may be forgotten
/// again at any time.
#[derive(Clone, Debug)]
pub struct SpeedRunExplorer<'a, const N: usize, C: CellTimes = [u32; 16], M = SpeedRunMap<N, C>> {
    planner: SpeedRunPlanner<'a, N, C, M>,
    home: Cell,
    stage: ExploreStage,
}

/// Stage of an exploration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExploreStage {
    /// The mouse has not been at a goal yet.
    Search,
    /// The mouse has been at a goal, and a run faster than the known ones may be possible.
    Proof,
    /// The mouse has been at a goal, and knows the fastest run.
    Home,
}

/// Decision of an explorer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decision {
    /// Drive one cell in this direction, and look at the walls there.
    Drive(Direction),
    /// The mouse is at the start and was at a goal. No run is faster than the known one, whatever
    /// the unknown walls are.
    Finished {
        /// Duration of the known run, ms.
        run_ms: u32,
    },
    /// No way leads to a goal, or the walls around the mouse are not known.
    Stuck,
}

impl<'a, const N: usize, C: CellTimes> SpeedRunExplorer<'a, N, C> {
    /// Returns an explorer without observations, for a mouse that starts in `home`, looking to
    /// `heading`.
    #[must_use]
    pub const fn new(
        times: &'a SpeedRunTimes<N>,
        home: Cell,
        heading: Direction,
        goals: &'a [Cell],
    ) -> Self {
        Self::with_map(times, home, heading, goals, SpeedRunMap::new())
    }
}

impl<'a, const N: usize, C: CellTimes, M: BorrowMut<SpeedRunMap<N, C>>>
    SpeedRunExplorer<'a, N, C, M>
{
    /// Returns the same as [`new`](SpeedRunExplorer::new), but for a map of its own or one that is
    /// lent, [new](SpeedRunMap::new) or [cleared](SpeedRunMap::clear).
    #[must_use]
    pub const fn with_map(
        times: &'a SpeedRunTimes<N>,
        home: Cell,
        heading: Direction,
        goals: &'a [Cell],
        map: M,
    ) -> Self {
        let start = RunState::Straight {
            cell: home,
            heading,
        };
        Self {
            planner: SpeedRunPlanner::with_map(times, start, goals, map),
            home,
            stage: ExploreStage::Search,
        }
    }

    /// Forgets that the mouse has been at a goal, because it was elsewhere.
    pub const fn restart(&mut self) {
        self.stage = ExploreStage::Search;
    }

    /// Returns the decision in the cell `at`, looking to `heading`, once its walls are in `walls`.
    /// O(N²), plus a search if no best run hoped for so far can be driven any more.
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    #[inline(never)]
    pub fn decide(
        &mut self,
        walls: &impl Walls,
        at: Cell,
        heading: Direction,
    ) -> Result<Decision, TooLarge> {
        if self.stage != ExploreStage::Search || self.planner.goals().contains(&at) {
            self.stage = ExploreStage::Proof;
        }
        let mut hoped = Passages::CLOSED;
        hoped.take(walls, Unknown::Open)?;
        self.planner.update(&hoped);
        let Some(run_ms) = self.planner.time_ms() else {
            return Ok(Decision::Stuck);
        };
        let unseen = self
            .planner
            .run(&hoped)
            .edges()
            .filter(|(cell, direction)| !walls.knowledge(*cell, *direction).is_known());
        let beside = unseen.flat_map(|(cell, direction)| {
            [Some(cell), walls.grid().neighbour(cell, direction)]
                .into_iter()
                .flatten()
        });
        let mut targets = beside.peekable();
        if self.stage == ExploreStage::Proof && targets.peek().is_none() {
            self.stage = ExploreStage::Home;
        }
        if self.stage == ExploreStage::Home && at == self.home {
            return Ok(Decision::Finished { run_ms });
        }
        let goals = match self.stage {
            ExploreStage::Search => self.planner.goals(),
            ExploreStage::Proof | ExploreStage::Home => &[],
        };
        // Home on known ways; nothing is left to look at then.
        let home = (self.stage == ExploreStage::Home).then_some(self.home);
        let mut known = Passages::CLOSED;
        if home.is_some() {
            known.take(walls, Unknown::Closed)?;
        }
        let passages = if home.is_some() { &known } else { &hoped };
        let mut steps = StepMap::NOWHERE;
        steps.flood(passages, targets.chain(goals.iter().copied()).chain(home));
        let order = [heading, heading.left(), heading.right(), heading.opposite()];
        let open = order
            .into_iter()
            .filter(|direction| walls.knowledge(at, *direction) == Knowledge::Open);
        let next = steps.descend(&hoped, at, open);
        Ok(next.map_or(Decision::Stuck, Decision::Drive))
    }

    /// Returns the stage of the last decision.
    #[must_use]
    pub const fn stage(&self) -> ExploreStage {
        self.stage
    }

    /// Returns the planner. Its run is the best possible one, and in the end the proven best.
    #[must_use]
    pub const fn planner(&self) -> &SpeedRunPlanner<'a, N, C, M> {
        &self.planner
    }
}
