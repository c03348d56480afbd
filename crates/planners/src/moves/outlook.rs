use tolman_maze::{Cell, Direction};

use super::cell_set::CellSet;
use super::chart::Chart;

/// Minimum number of unknown walls on the hoped-for way to the goal, from every cell.
pub(super) struct Outlook<const N: usize> {
    unknown: [[u8; N]; N],
}

impl<const N: usize> Outlook<N> {
    /// Returns the outlook on the ways of fewest steps with the fewest unknown walls. O(N²).
    pub(super) fn new(chart: &Chart<N>) -> Self {
        let mut outlook = Self {
            unknown: [[u8::MAX; N]; N],
        };
        for goal in chart.goals.iter() {
            outlook.lower(goal, 0);
        }
        // Step by step away from the goal: all cells one step nearer are done before a cell's turn
        // comes.
        let mut front = chart.goals;
        while !front.is_empty() {
            let mut next = CellSet::EMPTY;
            for cell in front.iter() {
                for direction in Direction::ALL {
                    outlook.look_back(chart, cell, direction, &mut next);
                }
            }
            front = next;
        }
        outlook
    }

    /// Adds the leaps that lead to `cell`, which is on the way, against `direction`.
    fn look_back(
        &mut self,
        chart: &Chart<N>,
        cell: Cell,
        direction: Direction,
        next: &mut CellSet<N>,
    ) {
        let (mut at, mut unknown) = (cell, self.unknown_walls(cell));
        for leap in chart.hoped.leaps_along(cell, direction) {
            unknown = unknown.saturating_add(chart.is_unknown(at, direction).into());
            at = leap.end;
            let farther = chart
                .to_goal
                .moves(cell)
                .and_then(|moves| moves.checked_add(1));
            if chart.to_goal.moves(at) == farther {
                self.lower(at, unknown.min(u8::MAX - 1));
                next.insert(at);
            }
        }
    }

    fn lower(&mut self, cell: Cell, unknown: u8) {
        let row = self.unknown.get_mut(usize::from(cell.y));
        if let Some(slot) = row.and_then(|row| row.get_mut(usize::from(cell.x))) {
            *slot = (*slot).min(unknown);
        }
    }

    /// Returns the number of unknown walls on the way from `cell`; the greatest number if there is
    /// no way.
    pub(super) fn unknown_walls(&self, cell: Cell) -> u8 {
        let row = self.unknown.get(usize::from(cell.y));
        let unknown = row.and_then(|row| row.get(usize::from(cell.x)));
        unknown.copied().unwrap_or(u8::MAX)
    }
}
