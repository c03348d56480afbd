use tolman_maze::{Cell, Direction, Grid};
use tolman_robot::{Goal, Landmark, Standing};

/// Knowledge of a mouse about a maze before it starts: everything except its walls.
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

impl Brief {
    /// Returns the cells where a goal is reached. A place is a cell, by [`Grid::index`].
    ///
    /// # Errors
    /// The reason for which the mouse gives up, if the goal is not in this maze.
    pub(super) fn cells_of(&self, goal: Goal) -> Result<Vec<Cell>, Standing> {
        let cells = match goal {
            Goal::Landmark(Landmark::Start) => Some(vec![self.start]),
            Goal::Landmark(Landmark::Goal) => Some(self.goals.clone()),
            Goal::Landmark(Landmark::Numbered(_)) | Goal::Point(_) => None,
            Goal::Place(id) => self.grid.cells().nth(id as usize).map(|cell| vec![cell]),
        };
        let why = "the mouse knows the start, the goals, and cells of the maze";
        cells.ok_or_else(|| Standing::gave_up(why))
    }
}
