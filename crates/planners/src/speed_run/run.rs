use tolman_maze::{Cell, Direction};

use super::map::NEVER;
use super::moves::{RunMove, RunStep};
use super::state::{Facing, Node};
use super::ways::{straights, turns};
use super::{CellTimes, RunState, SpeedRunMap, SpeedRunTimes};
use crate::Passages;

/// A speed run, as an iterator over its moves. See [`SpeedRunMap::run`].
#[derive(Clone, Debug)]
pub struct SpeedRun<'a, const N: usize, C: CellTimes = [u32; 16]> {
    map: &'a SpeedRunMap<N, C>,
    passages: &'a Passages<N>,
    times: &'a SpeedRunTimes<N>,
    at: Node,
}

impl<'a, const N: usize, C: CellTimes> SpeedRun<'a, N, C> {
    pub(super) const fn new(
        map: &'a SpeedRunMap<N, C>,
        passages: &'a Passages<N>,
        times: &'a SpeedRunTimes<N>,
        at: Node,
    ) -> Self {
        Self {
            map,
            passages,
            times,
            at,
        }
    }

    /// Returns the state of the mouse before its next move.
    #[must_use]
    pub fn state(&self) -> RunState {
        self.at.run_state::<N>()
    }

    /// Returns every edge that the run crosses from here on: the cell it leaves and the side it
    /// leaves it to.
    pub fn edges(self) -> impl Iterator<Item = (Cell, Direction)> {
        let mut cell = self.at.cell_of::<N>();
        self.flat_map(RunStep::directions).map(move |direction| {
            let edge = (cell, direction);
            let (east, north) = direction.step();
            // An edge that is open leads to a cell of the maze.
            cell.x = cell.x.wrapping_add_signed(east.into());
            cell.y = cell.y.wrapping_add_signed(north.into());
            edge
        })
    }

    /// Returns whether the run has reached a goal.
    #[must_use]
    pub fn has_arrived(&self) -> bool {
        self.map.time_from(self.at) == 0
    }
}

impl<const N: usize, C: CellTimes> Iterator for SpeedRun<'_, N, C> {
    type Item = RunStep;

    /// Returns a move after which exactly as much time is left as the map has: the longest
    /// straight, else the first turn. `None` at the goal, and if no move fits because passages were
    /// closed or no goal is in reach.
    fn next(&mut self) -> Option<RunStep> {
        let (map, times, passages, from) = (self.map, self.times, self.passages, self.at);
        let left = map.time_from(from);
        if left == 0 || left == NEVER {
            return None;
        }
        let has_halves = times.has_halves();
        let fits = |to: Node, takes: u32| map.time_from(to) + takes == left;
        let straight = straights::<N, C>(passages, from, has_halves).filter_map(|(length, to)| {
            let length = length as u16;
            let run_move = match from.facing() {
                Facing::Diagonal(..) => RunMove::Diagonal { cells: length },
                _ if has_halves => RunMove::Straight { half_cells: length },
                _ => RunMove::Straight {
                    half_cells: 2 * length,
                },
            };
            fits(to, times.of(run_move)?).then_some((run_move, to))
        });
        let turn = || {
            turns::<N, C>(passages, from).find_map(|turn| {
                let (slalom, side, to) = (turn.slalom, turn.side, turn.end(from));
                let run_move = RunMove::Turn { slalom, side };
                fits(to, times.of(run_move)?).then_some((run_move, to))
            })
        };
        let (run_move, to) = straight.last().or_else(turn)?;
        self.at = to;
        Some(RunStep {
            from: from.run_state::<N>(),
            run_move,
        })
    }
}
