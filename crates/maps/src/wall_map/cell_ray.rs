use tolman_maze::Direction;

/// What a range sensor tells of the walls along one direction, in whole cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CellRay {
    /// Where it looks.
    pub direction: Direction,
    /// How many walls in a row, from the cell it looks from, do not stand.
    pub open: u16,
    /// What comes after them.
    pub end: RayEnd,
}

/// What a ray ends at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum RayEnd {
    /// A wall stands.
    Wall,
    /// The sensor reaches no farther.
    OutOfRange,
}

impl CellRay {
    /// Returns a ray that meets a wall after `open` cells.
    #[must_use]
    pub const fn to_wall(direction: Direction, open: u16) -> Self {
        Self {
            direction,
            open,
            end: RayEnd::Wall,
        }
    }

    /// Returns a ray that has met no wall after `open` cells.
    #[must_use]
    pub const fn out_of_range(direction: Direction, open: u16) -> Self {
        Self {
            direction,
            open,
            end: RayEnd::OutOfRange,
        }
    }
}
