//! Proves that no second run takes fewer steps.

use tolman_maps::wall_map::WallMap;
use tolman_maze::{Cell, Grid, Knowledge, Wall, Walls};
use tolman_planners::moves::{Leap, MoveMap};
use tolman_planners::{Passages, TooLarge, Unknown};

use super::SIDE;

/// Proof for others that a run is the best possible, whatever the unknown walls are.
///
/// The run shows that it can be driven. A number for every cell, a lower bound of the steps to a
/// goal, shows that none is shorter. Goals have 0. No step over open or unknown walls leads to a
/// cell whose number is smaller by more than one. So from a cell with number *k* the goal is at
/// least *k* steps away. A checker only has to look at single steps; it needs no search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// The size of the maze.
    pub grid: Grid,
    /// Cell where the run begins.
    pub start: Cell,
    /// Cells where the run may end.
    pub goals: Vec<Cell>,
    /// All walls that were looked at, and whether they stand, by number.
    pub walls: Vec<(Wall, Knowledge)>,
    /// The cells the run stops on, from the start to a goal.
    pub run: Vec<Cell>,
    /// Number of steps of the best certain run: those of `run`.
    pub closed_cost: u32,
    /// Number of steps of the best run that can be hoped for.
    pub open_cost: u32,
    /// Lower bound of the steps to a goal from every cell, by [`Grid::index`].
    pub at_least: Vec<u32>,
}

impl Certificate {
    /// Returns the proof that `run` is the best, if it is one.
    ///
    /// # Errors
    /// If the maze has more than [`SIDE`] columns or rows.
    pub(super) fn of(
        map: &WallMap<SIDE>,
        start: Cell,
        goals: &[Cell],
        run: &[Leap],
    ) -> Result<Option<Self>, TooLarge> {
        let grid = map.grid();
        let hoped = Passages::<SIDE>::new(map, Unknown::Open)?;
        let to_goal = MoveMap::new(&hoped, goals.iter().copied());
        let Some(open_cost) = to_goal.moves(start).map(u32::from) else {
            return Ok(None);
        };
        let closed_cost = run.len() as u32;
        if open_cost < closed_cost {
            return Ok(None);
        }
        let walls = (0..grid.wall_count() as u32)
            .map(|id| (Wall(id), map.wall(Wall(id))))
            .filter(|(_, known)| known.is_known());
        // What is farther than the start, or leads nowhere, needs no larger number than the start
        // has.
        let at_least = grid
            .cells()
            .map(|cell| to_goal.moves(cell).map_or(open_cost, u32::from));
        Ok(Some(Self {
            grid,
            start,
            goals: goals.to_vec(),
            walls: walls.collect(),
            run: core::iter::once(start)
                .chain(run.iter().map(|leap| leap.end))
                .collect(),
            closed_cost,
            open_cost,
            at_least: at_least.map(|steps| steps.min(open_cost)).collect(),
        }))
    }
}
