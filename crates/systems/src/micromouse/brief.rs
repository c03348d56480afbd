use tolman_maze::{Cell, Direction, Grid};

/// What a mouse is told of a maze before it starts: all but its walls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Brief {
    /// The size of the maze.
    pub grid: Grid,
    /// The cell where runs begin.
    pub start: Cell,
    /// The side the mouse faces there.
    pub heading: Direction,
    /// The cells where runs end.
    pub goals: Vec<Cell>,
}
