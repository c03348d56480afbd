use core::fmt;

/// A compass direction of the grid, clockwise from north.
///
/// ```
/// use tolman_maze::Direction::{East, North, West};
///
/// assert_eq!(North.right(), East);
/// // What is to the left of a robot that looks east?
/// assert_eq!(East.turned(West), North);
/// assert_eq!(North.seen_from(East), West);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Direction {
    /// Towards growing y.
    North,
    /// Towards growing x.
    East,
    /// Towards falling y.
    South,
    /// Towards falling x.
    West,
}

impl Direction {
    /// All four, clockwise from north.
    pub const ALL: [Self; 4] = [Self::North, Self::East, Self::South, Self::West];

    /// Returns the direction's index: 0 for north, then clockwise to 3 for west.
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Returns a quarter turn clockwise.
    #[inline]
    #[must_use]
    pub const fn right(self) -> Self {
        Self::ALL[(self.index() + 1) % 4]
    }

    /// Returns a half turn.
    #[inline]
    #[must_use]
    pub const fn opposite(self) -> Self {
        Self::ALL[(self.index() + 2) % 4]
    }

    /// Returns a quarter turn counter-clockwise.
    #[inline]
    #[must_use]
    pub const fn left(self) -> Self {
        Self::ALL[(self.index() + 3) % 4]
    }

    /// Returns the direction that is at `side` of a viewer who looks this way; north is ahead.
    #[inline]
    #[must_use]
    pub const fn turned(self, side: Self) -> Self {
        Self::ALL[(self.index() + side.index()) % 4]
    }

    /// Returns the side at which a viewer who looks to `heading` has this direction: the inverse of
    /// [`turned`](Self::turned).
    #[inline]
    #[must_use]
    pub const fn seen_from(self, heading: Self) -> Self {
        Self::ALL[(self.index() + 4 - heading.index()) % 4]
    }

    /// Returns the unit step of this direction: (east, north).
    #[must_use]
    pub const fn step(self) -> (i8, i8) {
        match self {
            Self::North => (0, 1),
            Self::East => (1, 0),
            Self::South => (0, -1),
            Self::West => (-1, 0),
        }
    }
}

impl fmt::Display for Direction {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::North => "north",
            Self::East => "east",
            Self::South => "south",
            Self::West => "west",
        })
    }
}
