use tolman_maze::{Cell, Direction};

use crate::Passages;

/// Up to three cells in a row, driven in one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leap {
    /// Where it leads.
    pub direction: Direction,
    /// How many cells, 1 to [`Leap::MOST_CELLS`].
    pub cells: u8,
    /// Where it ends.
    pub end: Cell,
}

impl Leap {
    /// The most cells of one step (the paper, section 1.1).
    pub const MOST_CELLS: u8 = 3;

    /// All leaps from a cell: north, east, south, west; of each the short ones first.
    pub fn all<const N: usize>(passages: &Passages<N>, from: Cell) -> impl Iterator<Item = Self> {
        Direction::ALL
            .into_iter()
            .flat_map(move |direction| Self::along(passages, from, direction))
    }

    /// The leaps from a cell in one direction, the short ones first.
    pub fn along<const N: usize>(
        passages: &Passages<N>,
        from: Cell,
        direction: Direction,
    ) -> impl Iterator<Item = Self> {
        let mut at = from;
        (1..=Self::MOST_CELLS).map_while(move |cells| {
            if !passages.is_open(at, direction) {
                return None;
            }
            at = beyond(at, direction)?;
            Some(Self {
                direction,
                cells,
                end: at,
            })
        })
    }
}

/// The cell beside another one, on a plane without an end in the north or east.
pub(super) fn beyond(cell: Cell, direction: Direction) -> Option<Cell> {
    let (east, north) = direction.step();
    let x = cell.x.checked_add_signed(i16::from(east))?;
    let y = cell.y.checked_add_signed(i16::from(north))?;
    Some(Cell::new(x, y))
}
