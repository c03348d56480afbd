use alloc::vec;
use alloc::vec::Vec;

use crate::{Cell, Direction, Grid, Wall};

/// A maze whose every wall is known: the ground truth of a world.
///
/// ```
/// use tolman_maze::{Cell, Direction, Grid, Maze};
///
/// let mut maze = Maze::open(Grid::new(2, 1));
/// maze.set_wall(Cell::new(0, 0), Direction::East, true);
/// assert!(!maze.is_open(Cell::new(1, 0), Direction::West));
/// assert!(!maze.is_open(Cell::new(0, 0), Direction::North), "the border is closed");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Maze {
    grid: Grid,
    /// One bit per [`Wall`], set where a wall stands.
    standing: Vec<u64>,
    start: Option<(Cell, Direction)>,
    goals: Vec<Cell>,
}

impl Maze {
    /// A maze without inner walls and with a closed border; no start, no goal.
    #[must_use]
    pub fn open(grid: Grid) -> Self {
        let mut maze = Self {
            grid,
            standing: vec![0; grid.wall_count().div_ceil(64)],
            start: None,
            goals: Vec::new(),
        };
        for x in 0..grid.width() {
            maze.set_wall(Cell::new(x, 0), Direction::South, true);
            maze.set_wall(Cell::new(x, grid.height() - 1), Direction::North, true);
        }
        for y in 0..grid.height() {
            maze.set_wall(Cell::new(0, y), Direction::West, true);
            maze.set_wall(Cell::new(grid.width() - 1, y), Direction::East, true);
        }
        maze
    }

    /// A maze in which every wall stands: what generators carve from.
    #[must_use]
    pub fn solid(grid: Grid) -> Self {
        let mut maze = Self::open(grid);
        maze.standing.fill(u64::MAX);
        if let Some(last) = maze.standing.last_mut() {
            let used = grid.wall_count() % 64;
            if used != 0 {
                *last = (1 << used) - 1;
            }
        }
        maze
    }

    /// Size and wall numbering.
    #[must_use]
    pub const fn grid(&self) -> Grid {
        self.grid
    }

    /// Whether a wall stands on this edge.
    #[must_use]
    pub fn stands(&self, wall: Wall) -> bool {
        self.standing[wall.0 as usize / 64] >> (wall.0 % 64) & 1 == 1
    }

    /// Whether one can go from `cell` to `direction`.
    #[must_use]
    pub fn is_open(&self, cell: Cell, direction: Direction) -> bool {
        !self.stands(self.grid.wall(cell, direction))
    }

    /// Builds or removes the wall on the `direction` side of `cell`.
    pub fn set_wall(&mut self, cell: Cell, direction: Direction, stands: bool) {
        let wall = self.grid.wall(cell, direction).0;
        let bit = 1 << (wall % 64);
        if stands {
            self.standing[wall as usize / 64] |= bit;
        } else {
            self.standing[wall as usize / 64] &= !bit;
        }
    }

    /// The cells one step from `cell`, in the order of [`Direction::ALL`].
    pub fn neighbours(&self, cell: Cell) -> impl Iterator<Item = (Direction, Cell)> + '_ {
        Direction::ALL.into_iter().filter_map(move |direction| {
            let next = self.grid.neighbour(cell, direction)?;
            self.is_open(cell, direction).then_some((direction, next))
        })
    }

    /// Where runs begin and which way the robot looks, if the maze says so.
    #[must_use]
    pub const fn start(&self) -> Option<(Cell, Direction)> {
        self.start
    }

    /// Marks the start.
    pub fn set_start(&mut self, start: Option<(Cell, Direction)>) {
        self.start = start;
    }

    /// The destination cells, in ascending order of (x, y); may be empty.
    #[must_use]
    pub fn goals(&self) -> &[Cell] {
        &self.goals
    }

    /// Marks the destination.
    pub fn set_goals(&mut self, mut goals: Vec<Cell>) {
        goals.sort_unstable();
        goals.dedup();
        self.goals = goals;
    }

    /// For every cell, by [`Grid::index`], the number of steps to the nearest goal, or none where no
    /// way leads there. O(cells).
    #[must_use]
    pub fn steps_to_goal(&self) -> Vec<Option<u32>> {
        let mut steps = vec![None; self.grid.cell_count()];
        let mut frontier: Vec<Cell> = self.goals.clone();
        for goal in &frontier {
            steps[self.grid.index(*goal)] = Some(0);
        }
        let mut depth = 0;
        while !frontier.is_empty() {
            depth += 1;
            let mut next = Vec::new();
            for cell in frontier {
                for (_, beside) in self.neighbours(cell) {
                    let step = &mut steps[self.grid.index(beside)];
                    if step.is_none() {
                        *step = Some(depth);
                        next.push(beside);
                    }
                }
            }
            frontier = next;
        }
        steps
    }
}
