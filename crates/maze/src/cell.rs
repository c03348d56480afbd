use core::fmt;

use crate::Direction;

/// A cell of a maze: column `x` counted from the west, row `y` counted from the south, both from 0.
///
/// ```
/// use tolman_maze::{Cell, Direction};
///
/// let corner = Cell::new(0, 0);
/// assert_eq!(corner.beyond(Direction::North), Some(Cell::new(0, 1)));
/// assert_eq!(corner.beyond(Direction::West), None);
/// assert_eq!(corner.to_string(), "(0, 0)");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cell {
    /// Column from the west.
    pub x: u16,
    /// Row from the south.
    pub y: u16,
}

impl Cell {
    /// Returns the cell in column `x` and row `y`.
    #[must_use]
    pub const fn new(x: u16, y: u16) -> Self {
        Self { x, y }
    }

    /// Returns the cell one step in a direction, on a plane without an end in the north or east.
    #[inline]
    #[must_use]
    pub fn beyond(self, direction: Direction) -> Option<Self> {
        let (east, north) = direction.step();
        let x = self.x.checked_add_signed(east.into())?;
        let y = self.y.checked_add_signed(north.into())?;
        Some(Self { x, y })
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "({}, {})", self.x, self.y)
    }
}
