use tolman_maze::{Cell, Direction};

use crate::Passages;

/// Up to three cells in a row, driven in one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leap {
    /// Direction of the leap.
    pub direction: Direction,
    /// Number of cells, 1 to [`Leap::MOST_CELLS`].
    pub cells: u8,
    /// Cell at the leap's end.
    pub end: Cell,
}

impl Leap {
    /// Maximum number of cells of one step (the paper, section 1.1).
    pub const MOST_CELLS: u8 = 3;

    /// Returns all leaps from a cell: north, east, south, west; of each the short ones first.
    pub fn all<const N: usize>(passages: &Passages<N>, from: Cell) -> impl Iterator<Item = Self> {
        Direction::ALL
            .into_iter()
            .flat_map(move |direction| Self::along(passages, from, direction))
    }

    /// Returns the leaps from a cell in one direction, the short ones first.
    pub fn along<const N: usize>(
        passages: &Passages<N>,
        from: Cell,
        direction: Direction,
    ) -> impl Iterator<Item = Self> {
        Self::row(from, direction, move |cell| {
            passages.is_open(cell, direction)
        })
    }

    /// Returns the leaps from a cell in one direction, up to the first wall.
    pub(super) fn row(
        from: Cell,
        direction: Direction,
        is_open: impl Fn(Cell) -> bool,
    ) -> impl Iterator<Item = Self> {
        let mut end = from;
        (1..=Self::MOST_CELLS).map_while(move |cells| {
            end = end.beyond(direction).filter(|_| is_open(end))?;
            Some(Self {
                direction,
                cells,
                end,
            })
        })
    }
}
