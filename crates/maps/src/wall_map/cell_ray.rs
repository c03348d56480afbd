use tolman_maze::Direction;

/// Reading of a range sensor along one direction, in whole cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CellRay {
    /// Direction in which it looks.
    pub direction: Direction,
    /// Number of absent walls in a row, counted from the cell it looks from.
    pub open: u16,
    /// End of the ray after these cells.
    pub end: RayEnd,
}

/// End of a ray.
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
