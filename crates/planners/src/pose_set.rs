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
        let mut set = Self::among(grid, [])?;
        for rows in &mut set.cells {
            let rows = rows.iter_mut().take(grid.height().into());
            rows.for_each(|row| *row = low_bits(grid.width().into()));
        }
        Ok(set)
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
    #[inline(never)]
    pub fn see(&mut self, walls: &impl Walls, side: Direction, is_open: bool) {
        let contrary = Knowledge::of_standing(is_open);
        for (heading, rows) in Direction::ALL.into_iter().zip(&mut self.cells) {
            let direction = heading.turned(side);
            for (y, row) in rows.iter_mut().enumerate() {
                // A chip does this for thousands of poses, and iterators take twice as long.
                let mut left = *row;
                while left != 0 {
                    let x = left.trailing_zeros();
                    left &= left - 1;
                    if walls.knowledge(Cell::new(x as u16, y as u16), direction) == contrary {
                        *row &= !(1 << x);
                    }
                }
            }
        }
    }

    /// Moves all poses as a mouse that has turned to `side` and driven one cell. O(N²).
    #[inline(never)]
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
    /// to the next place that looks different for another pose. O(N² + N · cells on known open
    /// ways), and as much again for each pose on such ways that cannot be told from any other.
    #[must_use]
    #[inline(never)]
    pub fn next_drive(&mut self, walls: &impl Walls) -> Option<Direction> {
        let mut looks = Looks::UNKNOWN;
        looks.take(walls);
        let guess = self
            .guess
            .filter(|(cell, heading)| self.contains(*cell, *heading));
        let (guess, side) = guess.into_iter().chain(self.iter()).find_map(|guess| {
            let side = self.nearest_difference(&looks, guess)?;
            Some((guess, side))
        })?;
        self.guess = Some(guess);
        Some(side)
    }

    /// Returns the side by which a mouse at this pose leaves for the nearest place with a wall that
    /// some other pose does not have, or the other way round.
    fn nearest_difference(&self, looks: &Looks<N>, pose: (Cell, Direction)) -> Option<Direction> {
        let mut ways = Ways::NONE;
        ways.heading = pose.1;
        ways.is_new(pose.0);
        ways.extend(looks, (pose.0, None));
        let mut nearest: Option<((Cell, usize), Direction)> = None;
        let mut first = 0;
        while nearest.is_none() && first < ways.count {
            let end = ways.count;
            for number in first..end {
                let (cell, by) = ways.get(number)?;
                // Of equally near places the one that the first of the other poses differs in.
                if let Some(other) = self.first_unlike(looks, pose, cell)
                    && nearest.is_none_or(|(before, _)| order(other) < order(before))
                {
                    nearest = Some((other, by));
                }
                ways.extend(looks, (cell, Some(by)));
            }
            first = end;
        }
        nearest.map(|(_, by)| by)
    }

    /// Returns the first pose, and the number of its heading, from which the way that leads from
    /// `pose` to `cell` ends where a side is known to look otherwise.
    fn first_unlike(
        &self,
        looks: &Looks<N>,
        pose: (Cell, Direction),
        cell: Cell,
    ) -> Option<(Cell, usize)> {
        let mut first: Option<(Cell, usize)> = None;
        for (number, heading) in Direction::ALL.into_iter().enumerate() {
            let turned = heading.seen_from(pose.1);
            let (east, north) = offset(pose.0, cell, turned);
            let unlike = Direction::ALL.map(|side| match looks.of(cell, side) {
                Knowledge::Unknown => None,
                Knowledge::Open => looks.walls.get(side.turned(turned).index()),
                Knowledge::Wall => looks.open.get(side.turned(turned).index()),
            });
            // Beyond the north and the east there are walls; what lies in the south and the west is
            // not compared.
            let has_open = Direction::ALL
                .into_iter()
                .any(|side| looks.of(cell, side) == Knowledge::Open);
            let beyond = if has_open { u32::MAX } else { 0 };
            let width = i32::from(self.grid.width());
            let inside = low_bits(width - east.max(0));
            for (y, poses) in self.cells.get(number)?.iter().enumerate() {
                let twin = y as i32 + north;
                if *poses == 0 || twin < 0 {
                    continue;
                }
                let row = |plane: Option<&[u32; N]>| plane?.get(twin as usize).copied();
                let row = if twin < i32::from(self.grid.height()) {
                    unlike
                        .into_iter()
                        .filter_map(row)
                        .fold(0, |all, row| all | row)
                } else {
                    beyond & low_bits(width)
                };
                let row = if east < 0 {
                    row << east.unsigned_abs()
                } else {
                    row >> east | beyond & !inside
                };
                let differ = row & poses;
                if differ != 0 {
                    let other = (Cell::new(differ.trailing_zeros() as u16, y as u16), number);
                    if first.is_none_or(|before| order(other) < order(before)) {
                        first = Some(other);
                    }
                    break;
                }
            }
        }
        first
    }

    /// Returns the poses that are left: south-western cells first, and northern headings.
    pub fn iter(&self) -> impl Iterator<Item = (Cell, Direction)> {
        let [north, east, south, west] = &self.cells;
        let rows = north.iter().zip(east).zip(south).zip(west).enumerate();
        rows.flat_map(|(y, (((north, east), south), west))| {
            let headings = [*north, *east, *south, *west];
            let mut left = north | east | south | west;
            let cells = core::iter::from_fn(move || {
                let x = (left != 0).then_some(left.trailing_zeros())?;
                left &= left - 1;
                Some(x)
            });
            cells.flat_map(move |x| {
                let poses = headings.into_iter().zip(Direction::ALL);
                let here = poses.filter(move |(row, _)| row >> x & 1 == 1);
                here.map(move |(_, heading)| (Cell::new(x as u16, y as u16), heading))
            })
        })
    }

    /// Returns whether the mouse can be in `cell` and look to `heading`.
    #[must_use]
    pub fn contains(&self, cell: Cell, heading: Direction) -> bool {
        let rows = self.cells.get(heading.index());
        let row = rows.and_then(|rows| rows.get(usize::from(cell.y)));
        self.grid.contains(cell) && row.is_some_and(|row| row >> (cell.x % 32) & 1 == 1)
    }
}

/// What is known of the sides of all cells: by side and row; bit x.
struct Looks<const N: usize> {
    open: [[u32; N]; 4],
    walls: [[u32; N]; 4],
}

impl<const N: usize> Looks<N> {
    const UNKNOWN: Self = Self {
        open: [[0; N]; 4],
        walls: [[0; N]; 4],
    };

    fn take(&mut self, walls: &impl Walls) {
        for cell in walls.grid().cells() {
            for side in Direction::ALL {
                let plane = match walls.knowledge(cell, side) {
                    Knowledge::Unknown => continue,
                    Knowledge::Open => &mut self.open,
                    Knowledge::Wall => &mut self.walls,
                };
                let rows = plane.get_mut(side.index());
                if let Some(row) = rows.and_then(|rows| rows.get_mut(usize::from(cell.y))) {
                    *row |= 1 << (cell.x % 32);
                }
            }
        }
    }

    fn of(&self, cell: Cell, side: Direction) -> Knowledge {
        let is_in = |plane: &[[u32; N]; 4]| {
            let row = plane
                .get(side.index())
                .and_then(|rows| rows.get(usize::from(cell.y)));
            row.is_some_and(|row| row >> (cell.x % 32) & 1 == 1)
        };
        match (is_in(&self.open), is_in(&self.walls)) {
            (true, _) => Knowledge::Open,
            (_, true) => Knowledge::Wall,
            _ => Knowledge::Unknown,
        }
    }
}

/// Cells that a pose reaches by known open ways, nearest first, and the side of the pose by which
/// the way to each begins. The pose's own cell is left out.
struct Ways<const N: usize> {
    heading: Direction,
    /// Five bits each for x and y, and the side.
    cells: [[u16; N]; N],
    count: usize,
    /// By y; bit x.
    seen: [u32; N],
}

impl<const N: usize> Ways<N> {
    const NONE: Self = Self {
        heading: Direction::North,
        cells: [[0; N]; N],
        count: 0,
        seen: [0; N],
    };

    /// Returns whether a cell was not seen before, and remembers it.
    fn is_new(&mut self, cell: Cell) -> bool {
        let bit = 1 << (cell.x % 32);
        let row = self.seen.get_mut(usize::from(cell.y));
        row.is_some_and(|row| {
            let is_new = *row & bit == 0;
            *row |= bit;
            is_new
        })
    }

    /// Adds the cells beside `cell`, the way to which begins by this side.
    fn extend(&mut self, looks: &Looks<N>, (cell, by): (Cell, Option<Direction>)) {
        for side in Direction::ALL {
            let direction = self.heading.turned(side);
            if looks.of(cell, direction) == Knowledge::Open
                && let Some(next) = cell.beyond(direction)
                && self.is_new(next)
                && let Some(slot) = self.cells.as_flattened_mut().get_mut(self.count)
            {
                let by = by.unwrap_or(side).index() as u16;
                *slot = by << 10 | next.y << 5 | next.x;
                self.count += 1;
            }
        }
    }

    fn get(&self, number: usize) -> Option<(Cell, Direction)> {
        let way = self.cells.as_flattened().get(number)?;
        let by = Direction::ALL.get(usize::from(way >> 10))?;
        Some((Cell::new(way & 31, way >> 5 & 31), *by))
    }
}

/// Returns the order of poses: south-western cells first, and northern headings.
const fn order((cell, heading): (Cell, usize)) -> usize {
    ((cell.y as usize) << 5 | cell.x as usize) << 2 | heading
}

/// Returns a word with this many low bits.
const fn low_bits(count: i32) -> u32 {
    match count {
        ..=0 => 0,
        1..32 => u32::MAX >> (32 - count),
        _ => u32::MAX,
    }
}

/// Returns how far `to` lies east and north of `from`, in a frame that is turned.
fn offset(from: Cell, to: Cell, turned: Direction) -> (i32, i32) {
    let east = i32::from(to.x) - i32::from(from.x);
    let north = i32::from(to.y) - i32::from(from.y);
    match turned {
        Direction::North => (east, north),
        Direction::East => (north, -east),
        Direction::South => (-east, -north),
        Direction::West => (-north, east),
    }
}
