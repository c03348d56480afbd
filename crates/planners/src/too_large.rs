use tolman_maze::Grid;

/// The maze does not fit into the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the maze is {} × {} cells and the map holds {side} × {side} at most",
    grid.width(), grid.height()
)]
pub struct TooLarge {
    /// Size of the maze.
    pub grid: Grid,
    /// Maximum number of columns, and of rows, that the map holds.
    pub side: usize,
}

impl TooLarge {
    /// Checks that a maze of the size of `grid` has at most `side` columns and rows.
    ///
    /// # Errors
    /// [`TooLarge`] if the maze does not fit.
    pub const fn check(grid: Grid, side: usize) -> Result<(), Self> {
        if grid.width() as usize > side || grid.height() as usize > side {
            return Err(Self { grid, side });
        }
        Ok(())
    }
}
