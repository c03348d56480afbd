//! A maze as its robot moves in it: by numbers of cells.

use tolman_maze::{Direction, Maze};

/// What an episode looks up of its maze in each step.
#[derive(Clone, Debug)]
pub(super) struct Floor {
    pub(super) maze: Maze,
    /// For each cell and direction the next cell, if no wall stands between.
    next: Vec<[Option<u32>; 4]>,
    /// For each cell and direction the number of the wall there.
    walls: Vec<[u32; 4]>,
}

impl Floor {
    pub(super) fn new(maze: Maze) -> Self {
        let grid = maze.grid();
        let next = |cell| {
            Direction::ALL.map(|side| {
                let next = maze.beside(cell, side)?;
                Some(grid.index(next) as u32)
            })
        };
        Self {
            next: grid.cells().map(next).collect(),
            walls: grid
                .cells()
                .map(|cell| Direction::ALL.map(|side| grid.wall(cell, side).0))
                .collect(),
            maze,
        }
    }

    pub(super) fn cell_count(&self) -> usize {
        self.next.len()
    }

    pub(super) fn next(&self, cell: u32, direction: Direction) -> Option<u32> {
        self.next[cell as usize][direction.index()]
    }

    /// Returns the number of the wall or opening to that side of a cell.
    pub(super) fn wall(&self, cell: u32, direction: Direction) -> u32 {
        self.walls[cell as usize][direction.index()]
    }

    /// Returns the cells that can be reached from `cell`, itself among them, in order.
    pub(super) fn reachable(&self, cell: u32) -> Vec<u32> {
        let mut is_met = vec![false; self.cell_count()];
        let mut open = vec![cell];
        is_met[cell as usize] = true;
        while let Some(cell) = open.pop() {
            for next in self.next[cell as usize].into_iter().flatten() {
                if !is_met[next as usize] {
                    is_met[next as usize] = true;
                    open.push(next);
                }
            }
        }
        (0..self.cell_count() as u32)
            .filter(|cell| is_met[*cell as usize])
            .collect()
    }
}

/// Where a robot stands, and to where it looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stand {
    pub(super) cell: u32,
    pub(super) heading: Direction,
}

impl Stand {
    /// Returns a number of its own for each stand in a maze.
    pub(super) fn number(self) -> u32 {
        4 * self.cell + self.heading.index() as u32
    }

    pub(super) fn of_number(number: u32) -> Self {
        Self {
            cell: number / 4,
            heading: Direction::ALL[number as usize % 4],
        }
    }

    /// Returns the stands after the moves ahead, to the right and to the left. Ahead of a wall
    /// nothing changes.
    pub(super) fn moved(self, floor: &Floor) -> [Self; 3] {
        let turned = |heading| Self { heading, ..self };
        let cell = floor.next(self.cell, self.heading).unwrap_or(self.cell);
        [
            Self { cell, ..self },
            turned(self.heading.right()),
            turned(self.heading.left()),
        ]
    }
}
