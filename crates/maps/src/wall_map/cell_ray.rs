use tolman_maze::Direction;

/// Reading of a range sensor along one direction, in whole cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CellRay {
    /// Direction in which the sensor looks.
    pub direction: Direction,
    /// Number of consecutive absent walls, counted from the sensor's cell.
    pub open: u16,
    /// Reason why the ray ends after these cells.
    pub end: RayEnd,
}

/// Reason why a ray ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum RayEnd {
    /// A wall stopped the ray.
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
