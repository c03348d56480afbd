use tolman_maze::{Cell, Direction};

use super::moves::{RunMove, RunStep};
use super::state::{Facing, Node};
use super::ways::{straights, turns};
use super::{RunState, SpeedRunMap, SpeedRunTimes};
use crate::Passages;

/// A speed run, as an iterator over its moves. See [`SpeedRunMap::run`].
#[derive(Clone, Debug)]
pub struct SpeedRun<'a, const N: usize> {
    map: &'a SpeedRunMap<N>,
    passages: &'a Passages<N>,
    times: &'a SpeedRunTimes<N>,
    at: Node,
}

impl<'a, const N: usize> SpeedRun<'a, N> {
    pub(super) const fn new(
        map: &'a SpeedRunMap<N>,
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

impl<const N: usize> Iterator for SpeedRun<'_, N> {
    type Item = RunStep;

    /// Returns the first move after which exactly as much time is left as the map has. Straights
    /// come first, from short to long, then turns. `None` at the goal, and if no move fits because
    /// passages were closed or no goal is in reach.
    fn next(&mut self) -> Option<RunStep> {
        let (map, times, passages, from) = (self.map, self.times, self.passages, self.at);
        let left = map.time_from(from);
        if left == 0 || left == u16::MAX {
            return None;
        }
        let fits = |to: Node, takes: u16| map.time_from(to).checked_add(takes) == Some(left);
        let straight = straights(passages, from).find_map(|(length, to)| {
            let cells = length as u16;
            let (takes, run_move) = match from.facing() {
                Facing::Straight(_) => (times.straight_ms(length), RunMove::Straight { cells }),
                Facing::Diagonal(..) => (times.diagonal_ms(length), RunMove::Diagonal { cells }),
            };
            fits(to, takes?).then_some((run_move, to))
        });
        let turn = || {
            turns(passages, from).find_map(|(slalom, side, to)| {
                fits(to, times.turn_ms(slalom)).then_some((RunMove::Turn { slalom, side }, to))
            })
        };
        let (run_move, to) = straight.or_else(turn)?;
        self.at = to;
        Some(RunStep {
            from: from.run_state::<N>(),
            run_move,
        })
    }
}
