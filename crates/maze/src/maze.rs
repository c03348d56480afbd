use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::RangeInclusive;

use crate::motion::Motion;
use crate::{Cell, CheckError, Direction, Grid, Wall, formats};

/// A maze in which every wall is known: the ground truth of a world.
///
/// Cells handed to its methods must lie on its grid; beyond the grid every wall stands.
///
/// ```
/// use tolman_maze::{Cell, Direction, Grid, Maze};
///
/// let mut maze = Maze::open(Grid::new(2, 1));
/// maze.set_wall(Cell::new(0, 0), Direction::East, true);
/// assert!(!maze.is_open(Cell::new(1, 0), Direction::West));
/// assert!(!maze.is_open(Cell::new(0, 0), Direction::North), "the border is closed");
/// ```
///
/// It displays as a drawing, north first, with `S` on the start, `G` on the goals, and landmarks by
/// their numbers:
///
/// ```
/// use tolman_maze::{Cell, Direction, Grid, Maze};
///
/// let mut maze = Maze::open(Grid::new(2, 2));
/// maze.set_wall(Cell::new(0, 0), Direction::East, true);
/// maze.set_start(Some((Cell::new(0, 0), Direction::North)));
/// maze.set_goals(vec![Cell::new(1, 0)]);
/// let drawing = "\
/// o---o---o
/// |       |
/// o   o   o
/// | S | G |
/// o---o---o
/// ";
/// assert_eq!(maze.to_string(), drawing);
/// assert_eq!(maze.check(), Ok(()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Maze {
    grid: Grid,
    /// One bit per [`Wall`], set where a wall stands.
    standing: Vec<u64>,
    start: Option<(Cell, Direction)>,
    goals: Vec<Cell>,
    /// Number of the landmark of each cell that has one.
    landmarks: BTreeMap<Cell, u32>,
}

impl Maze {
    /// Numbers of the landmarks that a drawing can mark.
    pub const LANDMARKS: RangeInclusive<u32> = 1..=8;

    /// Returns a maze without inner walls and with a closed border; no start, no goal.
    #[must_use]
    pub fn open(grid: Grid) -> Self {
        let mut maze = Self {
            grid,
            standing: vec![0; grid.wall_count().div_ceil(64)],
            start: None,
            goals: Vec::new(),
            landmarks: BTreeMap::new(),
        };
        for (cell, direction) in grid.border() {
            maze.set_wall(cell, direction, true);
        }
        maze
    }

    /// Returns a maze in which every wall stands, from which generators carve.
    #[must_use]
    pub fn solid(grid: Grid) -> Self {
        let mut maze = Self::open(grid);
        for cell in grid.cells() {
            for direction in [Direction::North, Direction::East] {
                maze.set_wall(cell, direction, true);
            }
        }
        maze
    }

    /// Returns size and wall numbering.
    #[must_use]
    pub const fn grid(&self) -> Grid {
        self.grid
    }

    /// Returns whether a wall stands on this edge.
    #[inline]
    #[must_use]
    pub fn stands(&self, wall: Wall) -> bool {
        let word = self.standing.get(wall.0 as usize / 64);
        word.is_none_or(|word| word >> (wall.0 % 64) & 1 == 1)
    }

    /// Returns whether one can go from `cell` to `direction`.
    #[inline]
    #[must_use]
    pub fn is_open(&self, cell: Cell, direction: Direction) -> bool {
        !self.stands(self.grid.wall(cell, direction))
    }

    /// Builds or removes the wall on the `direction` side of `cell`.
    pub fn set_wall(&mut self, cell: Cell, direction: Direction, stands: bool) {
        let wall = self.grid.wall(cell, direction).0;
        let bit = 1 << (wall % 64);
        if let Some(word) = self.standing.get_mut(wall as usize / 64) {
            if stands {
                *word |= bit;
            } else {
                *word &= !bit;
            }
        }
    }

    /// Returns the cell one step from `cell` to that side, or `None` if a wall stands there.
    #[inline]
    #[must_use]
    pub fn beside(&self, cell: Cell, direction: Direction) -> Option<Cell> {
        let next = self.grid.neighbour(cell, direction)?;
        self.is_open(cell, direction).then_some(next)
    }

    /// Returns the cells one step from `cell`, in the order of [`Direction::ALL`].
    pub fn neighbours(&self, cell: Cell) -> impl Iterator<Item = (Direction, Cell)> + '_ {
        let beside = move |direction| Some((direction, self.beside(cell, direction)?));
        Direction::ALL.into_iter().filter_map(beside)
    }

    /// Returns the number of open sides of `cell`: 0 enclosed, 1 a dead end, 2 a corridor or bend,
    /// 3 or 4 a junction.
    #[must_use]
    pub fn degree(&self, cell: Cell) -> usize {
        self.neighbours(cell).count()
    }

    /// Returns whether a cell, those to its north and east and the one between them are open to
    /// each other. Then no wall ends at the post in their middle.
    #[must_use]
    pub fn is_room(&self, cell: Cell) -> bool {
        let [north, east] =
            [Direction::North, Direction::East].map(|direction| self.beside(cell, direction));
        let (Some(north), Some(east)) = (north, east) else {
            return false;
        };
        self.is_open(north, Direction::East) && self.is_open(east, Direction::North)
    }

    /// Returns the cells open to one side only, also where no way leads to a goal, in the order of
    /// [`Grid::index`].
    pub fn dead_ends(&self) -> impl Iterator<Item = Cell> + '_ {
        self.grid.cells().filter(|cell| self.degree(*cell) == 1)
    }

    /// Returns the cells open to three or four sides, also where no way leads to a goal, in the
    /// order of [`Grid::index`].
    pub fn junctions(&self) -> impl Iterator<Item = Cell> + '_ {
        self.grid.cells().filter(|cell| self.degree(*cell) >= 3)
    }

    /// Returns the cells from which a way leads to a goal, including the goals, in the order of
    /// [`Grid::index`]. These are the cells a robot can be in. O(cells).
    ///
    /// ```
    /// let text = "\
    /// o---o---o---o
    /// |     G |   |
    /// o   o---o   o
    /// | S |       |
    /// o---o---o---o
    /// ";
    /// let maze = tolman_maze::read(text)?.maze;
    /// assert_eq!(maze.reachable().count(), 3);
    /// assert_eq!(maze.reachable().filter(|cell| maze.degree(*cell) == 1).count(), 2);
    /// assert_eq!(maze.sealed().count(), 3);
    /// # Ok::<(), tolman_maze::MazeError>(())
    /// ```
    pub fn reachable(&self) -> impl Iterator<Item = Cell> + '_ {
        let steps = self.steps_to_goal();
        self.grid
            .cells()
            .filter(move |cell| steps[self.grid.index(*cell)].is_some())
    }

    /// Returns the cells that are open to some side but have no way to a goal, in the order of
    /// [`Grid::index`]. O(cells).
    pub fn sealed(&self) -> impl Iterator<Item = Cell> + '_ {
        let steps = self.steps_to_goal();
        self.grid
            .cells()
            .filter(move |cell| steps[self.grid.index(*cell)].is_none() && self.degree(*cell) > 0)
    }

    /// Returns the number of inner edges without a wall. In a perfect maze, exactly one way joins
    /// every two cells. A maze is perfect if all its cells are connected and this is their number
    /// minus one.
    #[must_use]
    pub fn opening_count(&self) -> usize {
        self.grid
            .cells()
            .map(|cell| self.degree(cell))
            .sum::<usize>()
            / 2
    }

    /// Returns the maze turned by a quarter clockwise.
    #[must_use]
    pub fn rotated(&self) -> Self {
        self.moved(Motion::Quarter)
    }

    /// Returns the maze mirrored, west to east.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        self.moved(Motion::Mirror)
    }

    /// Returns the maze with every cell in its new place and every direction turned.
    pub(crate) fn moved(&self, motion: Motion) -> Self {
        let place = |cell| motion.cell(self.grid, cell);
        let mut moved = Self::open(motion.grid(self.grid));
        for cell in self.grid.cells() {
            for side in Direction::ALL {
                moved.set_wall(
                    place(cell),
                    motion.direction(side),
                    !self.is_open(cell, side),
                );
            }
        }
        moved.start = self
            .start
            .map(|(cell, heading)| (place(cell), motion.direction(heading)));
        moved.set_goals(self.goals.iter().copied().map(place).collect());
        let landmarks = self.landmarks.iter();
        moved.landmarks = landmarks.map(|(cell, n)| (place(*cell), *n)).collect();
        moved
    }

    /// Returns the start cell and the heading of the robot there, if the maze has a start.
    #[must_use]
    pub const fn start(&self) -> Option<(Cell, Direction)> {
        self.start
    }

    /// Sets the start cell and the robot's heading there; `None` removes the start.
    pub fn set_start(&mut self, start: Option<(Cell, Direction)>) {
        self.start = start;
    }

    /// Returns the destination cells, in ascending order of (x, y); may be empty.
    #[must_use]
    pub fn goals(&self) -> &[Cell] {
        &self.goals
    }

    /// Sets the destination cells.
    pub fn set_goals(&mut self, mut goals: Vec<Cell>) {
        goals.sort_unstable();
        goals.dedup();
        self.goals = goals;
    }

    /// Returns the cells of numbered landmarks, which errands name, with their numbers; may be
    /// empty. A landmark may have several cells.
    #[must_use]
    pub const fn landmarks(&self) -> &BTreeMap<Cell, u32> {
        &self.landmarks
    }

    /// Sets the cells of numbered landmarks.
    pub fn set_landmarks(&mut self, landmarks: BTreeMap<Cell, u32>) {
        self.landmarks = landmarks;
    }

    /// Returns, for every cell by [`Grid::index`], the number of steps to the nearest goal, or
    /// `None` if no way leads there. O(cells).
    #[must_use]
    pub fn steps_to_goal(&self) -> Vec<Option<u32>> {
        self.steps_to(&self.goals)
    }

    /// Returns, for every cell by [`Grid::index`], the number of steps to the nearest of `targets`,
    /// or `None` if no way leads there. O(cells).
    ///
    /// ```
    /// use tolman_maze::{Cell, Grid, Maze};
    ///
    /// let maze = Maze::open(Grid::new(3, 1));
    /// assert_eq!(maze.steps_to(&[Cell::new(2, 0)]), [Some(2), Some(1), Some(0)]);
    /// ```
    #[must_use]
    pub fn steps_to(&self, targets: &[Cell]) -> Vec<Option<u32>> {
        let mut steps = vec![None; self.grid.cell_count()];
        let on_grid = targets
            .iter()
            .copied()
            .filter(|cell| self.grid.contains(*cell));
        let mut frontier: Vec<Cell> = on_grid.collect();
        for target in &frontier {
            steps[self.grid.index(*target)] = Some(0);
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

    /// Checks that a robot can be put into this maze and sent to its destination. The border must
    /// be closed, and there must be a goal. Start and goals must lie on the grid. A way must lead
    /// from the start to at least one goal (without a start: from some other cell). Other cells may
    /// be enclosed. O(cells).
    ///
    /// # Errors
    /// The first of these that does not hold, with the cell it fails at.
    pub fn check(&self) -> Result<(), CheckError> {
        self.check_structure()?;
        let Some(goal) = self.goals.first().copied() else {
            return Err(CheckError::NoGoal);
        };
        match self.start {
            Some((start, _)) if self.steps_to_goal()[self.grid.index(start)].is_none() => {
                Err(CheckError::NoWay { start, goal })
            }
            None if self.goals.iter().all(|goal| self.degree(*goal) == 0) => {
                Err(CheckError::Enclosed { goal })
            }
            _ => Ok(()),
        }
    }

    /// Checks the part of [`Maze::check`] that every file must hold: cells, closed border, marks on
    /// the grid.
    pub(crate) fn check_structure(&self) -> Result<(), CheckError> {
        if self.grid.cell_count() == 0 {
            return Err(CheckError::NoCells);
        }
        if let Some((cell, direction)) = self
            .grid
            .border()
            .find(|(cell, direction)| self.is_open(*cell, *direction))
        {
            return Err(CheckError::OpenBorder { cell, direction });
        }
        if let Some((start, _)) = self.start
            && !self.grid.contains(start)
        {
            return Err(CheckError::StartOutside {
                start,
                grid: self.grid,
            });
        }
        let mut marked = self.goals.iter().chain(self.landmarks.keys());
        match marked.find(|goal| !self.grid.contains(**goal)) {
            Some(goal) => Err(CheckError::GoalOutside {
                goal: *goal,
                grid: self.grid,
            }),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Maze {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formats::draw(self, formatter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a 3 × 1 maze with the start in the west and the goal in the east.
    fn corridor() -> Maze {
        let mut maze = Maze::open(Grid::new(3, 1));
        maze.set_start(Some((Cell::new(0, 0), Direction::East)));
        maze.set_goals(vec![Cell::new(2, 0)]);
        maze
    }

    #[test]
    fn check_names_what_is_wrong() {
        let (west, middle, east) = (Cell::new(0, 0), Cell::new(1, 0), Cell::new(2, 0));
        let outside = Cell::new(3, 0);
        let grid = Grid::new(3, 1);
        let check = |change: fn(&mut Maze), expect: Result<(), CheckError>| {
            let mut maze = corridor();
            change(&mut maze);
            assert_eq!(maze.check(), expect, "\n{maze}");
        };
        check(|_| (), Ok(()));
        check(|maze| maze.set_goals(vec![]), Err(CheckError::NoGoal));
        check(
            |maze| maze.set_goals(vec![Cell::new(3, 0)]),
            Err(CheckError::GoalOutside {
                goal: outside,
                grid,
            }),
        );
        check(
            |maze| maze.set_start(Some((Cell::new(3, 0), Direction::North))),
            Err(CheckError::StartOutside {
                start: outside,
                grid,
            }),
        );
        check(
            |maze| maze.set_wall(Cell::new(1, 0), Direction::West, true),
            Err(CheckError::NoWay {
                start: west,
                goal: east,
            }),
        );
        check(
            |maze| maze.set_wall(Cell::new(1, 0), Direction::North, false),
            Err(CheckError::OpenBorder {
                cell: middle,
                direction: Direction::North,
            }),
        );
        check(
            |maze| {
                maze.set_start(None);
                maze.set_wall(Cell::new(2, 0), Direction::West, true);
            },
            Err(CheckError::Enclosed { goal: east }),
        );
        assert_eq!(
            Maze::open(Grid::new(0, 4)).check(),
            Err(CheckError::NoCells)
        );
    }

    #[test]
    fn one_reachable_goal_of_several_is_enough() {
        let mut maze = corridor();
        maze.set_goals(vec![Cell::new(1, 0), Cell::new(2, 0)]);
        maze.set_wall(Cell::new(2, 0), Direction::West, true);
        assert_eq!(maze.check(), Ok(()));
    }

    #[test]
    fn solid_and_open_differ_in_the_inner_walls_only() {
        let grid = Grid::new(5, 7);
        let (open, solid) = (Maze::open(grid), Maze::solid(grid));
        for cell in grid.cells() {
            for direction in Direction::ALL {
                let inner = grid.neighbour(cell, direction).is_some();
                assert_eq!(open.is_open(cell, direction), inner);
                assert!(!solid.is_open(cell, direction));
            }
        }
        let inner_walls = 4 * 7 + 5 * 6;
        assert_eq!(
            (open.opening_count(), solid.opening_count()),
            (inner_walls, 0)
        );

        let mut emptied = solid;
        for cell in grid.cells() {
            for direction in Direction::ALL {
                emptied.set_wall(cell, direction, grid.neighbour(cell, direction).is_none());
            }
        }
        assert_eq!(emptied, open, "equal walls make equal mazes");
    }

    #[test]
    fn degrees_tell_dead_ends_and_junctions_apart() {
        let mut maze = Maze::open(Grid::new(3, 2));
        maze.set_wall(Cell::new(0, 0), Direction::East, true);
        maze.set_wall(Cell::new(2, 0), Direction::North, true);
        let dead_ends = [Cell::new(0, 0), Cell::new(2, 0), Cell::new(2, 1)];
        assert_eq!(maze.dead_ends().collect::<Vec<_>>(), dead_ends);
        assert_eq!(maze.junctions().collect::<Vec<_>>(), [Cell::new(1, 1)]);
    }

    #[test]
    fn solid_cells_are_neither_reachable_nor_sealed() {
        // A cell walled in on four sides, two joined ones sealed off, and the goal.
        let mut maze = Maze::solid(Grid::new(4, 1));
        maze.set_wall(Cell::new(1, 0), Direction::East, false);
        maze.set_goals(vec![Cell::new(3, 0), Cell::new(9, 9)]);
        assert_eq!(maze.reachable().collect::<Vec<_>>(), [Cell::new(3, 0)]);
        let sealed = [Cell::new(1, 0), Cell::new(2, 0)];
        assert_eq!(maze.sealed().collect::<Vec<_>>(), sealed);
    }

    #[test]
    fn beyond_the_grid_every_wall_stands() {
        let maze = Maze::open(Grid::new(2, 2));
        assert!(maze.stands(Wall(u32::MAX)));
        assert_eq!(maze.steps_to(&[Cell::new(9, 9)]), [None; 4]);
    }
}
