use tolman_maze::{Cell, Direction, Knowledge, Walls};

use super::leap::beyond;
use super::{Leap, MoveMap};
use crate::Passages;

/// What there is to see: the best run that can be hoped for through every wall nobody has looked at.
pub(super) struct Hopes<'a, const N: usize, W> {
    pub(super) walls: &'a W,
    /// All that may be open.
    pub(super) hoped: &'a Passages<N>,
    /// Steps from the start, hoped for.
    pub(super) from_start: &'a MoveMap<N>,
    /// Steps to the goal, hoped for.
    pub(super) to_goal: &'a MoveMap<N>,
    pub(super) goals: &'a [Cell],
}

impl<const N: usize, W: Walls> Hopes<'_, N, W> {
    /// The sides of `cell` that nobody has looked at.
    pub(super) fn unknown_sides(&self, cell: Cell) -> impl Iterator<Item = Direction> {
        Direction::ALL
            .into_iter()
            .filter(move |side| self.is_unknown(cell, *side))
    }

    pub(super) fn is_unknown(&self, cell: Cell, side: Direction) -> bool {
        self.walls.knowledge(cell, side) == Knowledge::Unknown
    }

    /// The steps of the best run from the start to the goal that drives over the `side` of `cell`. At most
    /// six leaps do, each in both directions.
    pub(super) fn run_through(&self, cell: Cell, side: Direction) -> Option<u16> {
        let (mut from, back) = (cell, side.opposite());
        let mut best: Option<u16> = None;
        for before in 0..Leap::MOST_CELLS {
            for leap in Leap::along(self.hoped, from, side).skip(before.into()) {
                let run = [(from, leap.end), (leap.end, from)]
                    .into_iter()
                    .filter_map(|(tail, head)| self.run_by(tail, head));
                best = run.chain(best).min();
            }
            if !self.hoped.is_open(from, back) {
                break;
            }
            match beyond(from, back) {
                Some(cell) => from = cell,
                None => break,
            }
        }
        best
    }

    fn run_by(&self, tail: Cell, head: Cell) -> Option<u16> {
        Some(self.from_start.moves(tail)? + 1 + self.to_goal.moves(head)?)
    }
}
