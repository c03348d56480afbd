use tolman_maze::{Cell, Direction};

use super::cell_set::CellSet;
use super::chart::Chart;

/// Minimum number of unknown walls on the hoped-for ways of fewest steps from one cell to the goal.
pub(super) struct Outlook<const N: usize> {
    unknown: [[u8; N]; N],
}

impl<const N: usize> Outlook<N> {
    /// Returns the number of unknown walls on the way from `cell`; the greatest number if there is
    /// no way. O(cells on ways of fewest steps).
    pub(super) fn unknown_walls(chart: &Chart<N>, cell: Cell) -> u8 {
        let Some(mut moves) = chart.to_goal.moves(cell) else {
            return u8::MAX;
        };
        let mut outlook = Self {
            unknown: [[u8::MAX; N]; N],
        };
        outlook.lower(cell, 0);
        // All cells at one distance from the goal are done before the cells one step nearer.
        let mut front = CellSet::of([cell]);
        while let Some(nearer) = moves.checked_sub(1) {
            let mut next = CellSet::EMPTY;
            for cell in front.iter() {
                for direction in Direction::ALL {
                    outlook.look_on(chart, (cell, nearer), direction, &mut next);
                }
            }
            (front, moves) = (next, nearer);
        }
        let ends = front.iter().map(|goal| outlook.at(goal));
        ends.min().unwrap_or(u8::MAX)
    }

    /// Adds the leaps from `cell` in `direction` that end `nearer` steps from the goal.
    fn look_on(
        &mut self,
        chart: &Chart<N>,
        (cell, nearer): (Cell, u16),
        direction: Direction,
        next: &mut CellSet<N>,
    ) {
        let (mut at, mut unknown) = (cell, self.at(cell));
        for leap in chart.hoped.leaps_along(cell, direction) {
            unknown = unknown.saturating_add(chart.is_unknown(at, direction).into());
            at = leap.end;
            if chart.to_goal.moves(at) == Some(nearer) {
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

    fn at(&self, cell: Cell) -> u8 {
        let row = self.unknown.get(usize::from(cell.y));
        let unknown = row.and_then(|row| row.get(usize::from(cell.x)));
        unknown.copied().unwrap_or(u8::MAX)
    }
}
