use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};

use crate::TooLarge;

/// Everywhere a mouse can be that has lost its way in a maze it knows in part, of up to `N` × `N`
/// cells, `N` ≤ 32. A larger `N` does not compile:
///
/// ```compile_fail
/// # use tolman_maze::Grid;
/// # use tolman_planners::PoseSet;
/// PoseSet::<33>::anywhere(Grid::new(3, 1)).ok();
/// ```
///
/// Every cell and heading is possible at first. What the mouse sees and does then rules poses out:
/// those with a wall known where it sees none, or the other way round. Directions are the mouse's
/// own: north is straight ahead, east to the right.
///
/// ```
/// use tolman_maze::{Cell, Direction, Grid, Maze};
/// use tolman_planners::{PoseKnowledge, PoseSet};
///
/// // A corridor of three cells, with a branch at its western end.
/// let mut maze = Maze::open(Grid::new(3, 2));
/// maze.set_wall(Cell::new(1, 0), Direction::North, true);
/// maze.set_wall(Cell::new(2, 0), Direction::North, true);
/// maze.set_wall(Cell::new(0, 1), Direction::East, true);
/// let mut poses = PoseSet::<16>::anywhere(maze.grid())?;
///
/// // Walls on both sides, and open ahead:
/// let (ahead, right, left) = (Direction::North, Direction::East, Direction::West);
/// for (side, is_open) in [(left, false), (ahead, true), (right, false)] {
///     poses.see(&maze, side, is_open);
/// }
/// assert!(matches!(poses.location(), PoseKnowledge::Among { poses: 5.. }));
/// // It drives on and comes to a bend to the right.
/// poses.drive(&maze, ahead);
/// for (side, is_open) in [(left, false), (ahead, false), (right, true)] {
///     poses.see(&maze, side, is_open);
/// }
/// let found = PoseKnowledge::Found { cell: Cell::new(0, 0), heading: Direction::West };
/// assert_eq!(poses.location(), found);
/// # Ok::<(), tolman_planners::TooLarge>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PoseSet<const N: usize> {
    grid: Grid,
    /// Possible cells by heading, then y; bit x.
    cells: [[u32; N]; 4],
    /// Pose for which the next drive is planned, as long as it is in the set. Keeping it prevents
    /// the mouse from driving to and fro.
    guess: Option<(Cell, Direction)>,
}

/// Knowledge of a mouse's pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseKnowledge {
    /// The mouse is at one pose for certain.
    Found {
        /// Cell of the mouse.
        cell: Cell,
        /// Heading of the mouse.
        heading: Direction,
    },
    /// The mouse is at one of several poses.
    Among {
        /// Number of poses, at least 2.
        poses: u32,
    },
    /// No pose is possible: a wall of the map is wrong, or an observation was.
    Nowhere,
}

impl<const N: usize> PoseSet<N> {
    /// Returns the set of every pose in the maze.
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub fn anywhere(grid: Grid) -> Result<Self, TooLarge> {
        let headings = |cell| Direction::ALL.map(|heading| (cell, heading));
        Self::among(grid, grid.cells().flat_map(headings))
    }

    /// Returns the set of these poses, such as those in the cells the mouse has been in, or with
    /// the heading of its compass.
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub fn among(
        grid: Grid,
        poses: impl IntoIterator<Item = (Cell, Direction)>,
    ) -> Result<Self, TooLarge> {
        const { assert!(N <= 32, "a row of cells is a word of 32 bits") };
        TooLarge::check(grid, N)?;
        Ok(Self::of(grid, poses.into_iter(), None))
    }

    fn of(
        grid: Grid,
        poses: impl Iterator<Item = (Cell, Direction)>,
        guess: Option<(Cell, Direction)>,
    ) -> Self {
        let mut cells = [[0; N]; 4];
        for (cell, heading) in poses {
            let rows = cells.get_mut(heading.index());
            if let Some(row) = rows.and_then(|rows| rows.get_mut(usize::from(cell.y))) {
                *row |= 1 << (cell.x % 32);
            }
        }
        Self { grid, cells, guess }
    }

    /// Removes the poses that contradict an opening or a wall seen to `side` of the mouse. Unknown
    /// walls exclude nothing. O(N²).
    pub fn see(&mut self, walls: &impl Walls, side: Direction, is_open: bool) {
        let contrary = Knowledge::of_standing(is_open);
        let fits = |(cell, heading): &(Cell, Direction)| {
            walls.knowledge(*cell, heading.turned(side)) != contrary
        };
        *self = Self::of(self.grid, self.iter().filter(fits), self.guess);
    }

    /// Moves all poses as a mouse that has turned to `side` and driven one cell. O(N²).
    pub fn drive(&mut self, walls: &impl Walls, side: Direction) {
        let grid = self.grid;
        let driven = |(cell, heading): (Cell, Direction)| {
            let heading = heading.turned(side);
            let free = walls.knowledge(cell, heading) != Knowledge::Wall;
            let next = grid.neighbour(cell, heading).filter(|_| free)?;
            Some((next, heading))
        };
        let guess = self.guess.and_then(driven);
        *self = Self::of(grid, self.iter().filter_map(driven), guess);
    }

    /// Returns the knowledge of the mouse's pose.
    #[must_use]
    pub fn location(&self) -> PoseKnowledge {
        let mut poses = self.iter();
        match (poses.next(), poses.next()) {
            (None, _) => PoseKnowledge::Nowhere,
            (Some((cell, heading)), None) => PoseKnowledge::Found { cell, heading },
            _ => PoseKnowledge::Among {
                poses: self
                    .cells
                    .iter()
                    .flatten()
                    .map(|row| row.count_ones())
                    .sum(),
            },
        }
    }

    /// Returns the first direction of a drive that tells poses apart, or `None` if the known walls
    /// tell no pose from another. The drive leads, from one pose of the set and on known open ways,
    /// to the next place that looks different for another pose. O(N² + poses · cells on known open
    /// ways), and as much again for each pose on such ways that cannot be told from any other.
    #[must_use]
    pub fn next_drive(&mut self, walls: &impl Walls) -> Option<Direction> {
        let guess = self
            .guess
            .filter(|(cell, heading)| self.contains(*cell, *heading));
        let (guess, side) = guess.into_iter().chain(self.iter()).find_map(|guess| {
            let side = self.nearest_difference(walls, guess)?;
            Some((guess, side))
        })?;
        self.guess = Some(guess);
        Some(side)
    }

    /// Returns the side by which a mouse at this pose leaves for the nearest place with a wall that
    /// some other pose does not have, or the other way round.
    fn nearest_difference(&self, walls: &impl Walls, pose: (Cell, Direction)) -> Option<Direction> {
        let is_open = |side| walls.knowledge(pose.0, side) == Knowledge::Open;
        if !Direction::ALL.into_iter().any(is_open) {
            return None;
        }
        let reached = Reached::<N>::from(walls, pose);
        let mut nearest: Option<Way> = None;
        for other in self.iter().filter(|other| *other != pose) {
            let nearer = |way: &Way| nearest.is_none_or(|nearest| way.cells < nearest.cells);
            let mut ways = reached.ways().take_while(|(_, way)| nearer(way));
            let telling = ways.find(|(cell, _)| differ(walls, *cell, pose, other));
            nearest = telling.map(|(_, way)| way).or(nearest);
        }
        nearest.map(|way| way.side)
    }

    /// Returns the poses that are left: south-western cells first, and northern headings.
    pub fn iter(&self) -> impl Iterator<Item = (Cell, Direction)> {
        let grid = self.grid;
        grid.cells()
            .flat_map(|cell| Direction::ALL.map(|heading| (cell, heading)))
            .filter(|(cell, heading)| self.contains(*cell, *heading))
    }

    /// Returns whether the mouse can be in `cell` and look to `heading`.
    #[must_use]
    pub fn contains(&self, cell: Cell, heading: Direction) -> bool {
        let rows = self.cells.get(heading.index());
        let row = rows.and_then(|rows| rows.get(usize::from(cell.y)));
        self.grid.contains(cell) && row.is_some_and(|row| row >> (cell.x % 32) & 1 == 1)
    }
}

/// A way to some cell.
#[derive(Clone, Copy)]
struct Way {
    /// Length in cells.
    cells: u16,
    /// Direction of the way's first cell, in the mouse's frame.
    side: Direction,
}

/// Cells that a pose reaches by known open ways, nearest first.
struct Reached<const N: usize> {
    ways: [[Option<Way>; N]; N],
    cells: [[u16; N]; N],
    count: usize,
}

impl<const N: usize> Reached<N> {
    fn from(walls: &impl Walls, (start, heading): (Cell, Direction)) -> Self {
        let mut reached = Self {
            ways: [[None; N]; N],
            cells: [[0; N]; N],
            count: 0,
        };
        reached.push(start);
        let mut at = 0;
        while let Some(cell) = reached.cell(at) {
            let way = reached.way(cell);
            for side in Direction::ALL {
                let direction = heading.turned(side);
                let is_open = walls.knowledge(cell, direction) == Knowledge::Open;
                let next = walls.grid().neighbour(cell, direction);
                let Some(next) = next.filter(|next| is_open && *next != start) else {
                    continue;
                };
                let row = reached.ways.get_mut(usize::from(next.y));
                let slot = row.and_then(|row| row.get_mut(usize::from(next.x)));
                if let Some(slot @ None) = slot {
                    *slot = Some(Way {
                        cells: way.map_or(0, |way| way.cells) + 1,
                        side: way.map_or(side, |way| way.side),
                    });
                    reached.push(next);
                }
            }
            at += 1;
        }
        reached
    }

    fn push(&mut self, cell: Cell) {
        if let Some(slot) = self.cells.as_flattened_mut().get_mut(self.count) {
            *slot = cell.y << 8 | cell.x;
            self.count += 1;
        }
    }

    fn cell(&self, at: usize) -> Option<Cell> {
        let cells = self.cells.as_flattened().get(..self.count)?;
        cells.get(at).map(|cell| Cell::new(cell & 0xff, cell >> 8))
    }

    fn way(&self, cell: Cell) -> Option<Way> {
        let row = self.ways.get(usize::from(cell.y))?;
        *row.get(usize::from(cell.x))?
    }

    /// Returns all cells but the first one, with the ways there.
    fn ways(&self) -> impl Iterator<Item = (Cell, Way)> {
        (1..self.count).filter_map(|at| {
            let cell = self.cell(at)?;
            Some((cell, self.way(cell)?))
        })
    }
}

/// Returns whether a cell has a side that is known to be other than that of its twin, when a mouse
/// drives the same way from the pose `other` as from `first` to the cell.
fn differ(
    walls: &impl Walls,
    cell: Cell,
    first: (Cell, Direction),
    other: (Cell, Direction),
) -> bool {
    let Some(twin) = twin(cell, first, other) else {
        return false;
    };
    Direction::ALL.into_iter().any(|side| {
        let ours = walls.knowledge(cell, first.1.turned(side));
        let theirs = walls.knowledge(twin, other.1.turned(side));
        ours.is_known() && theirs.is_known() && ours != theirs
    })
}

/// Returns the cell of a mouse that began at `other`, when one that began at `first` and drove the
/// same way is in `cell`. `None` if it lies west or south of the grid.
fn twin(cell: Cell, first: (Cell, Direction), other: (Cell, Direction)) -> Option<Cell> {
    let east = i32::from(cell.x) - i32::from(first.0.x);
    let north = i32::from(cell.y) - i32::from(first.0.y);
    let (east, north) = match other.1.seen_from(first.1) {
        Direction::North => (east, north),
        Direction::East => (north, -east),
        Direction::South => (-east, -north),
        Direction::West => (-north, east),
    };
    let x = u16::try_from(i32::from(other.0.x) + east).ok()?;
    let y = u16::try_from(i32::from(other.0.y) + north).ok()?;
    Some(Cell::new(x, y))
}
