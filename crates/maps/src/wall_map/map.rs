use tolman_maze::{Cell, Direction, Grid, Knowledge, Wall, Walls};
use tolman_planners::TooLarge;

use super::log::Log;
use super::{CellRay, RayEnd};

/// A mouse's knowledge of a maze of at most `N` × `N` cells, `N` ≤ 32, and of its visits. A larger
/// `N` does not compile:
///
/// ```compile_fail
/// # use tolman_maps::wall_map::{ClosedCells, WallMap};
/// # use tolman_maze::Grid;
/// WallMap::<33>::new(Grid::new(3, 1), ClosedCells::Possible).ok();
/// ```
///
/// The last `LOG` walls learned can be forgotten again. Cells outside the grid are walled in.
///
/// ```
/// use tolman_maps::wall_map::{CellRay, ClosedCells, WallMap};
/// use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};
///
/// let mut map: WallMap<16> = WallMap::new(Grid::new(16, 16), ClosedCells::Possible)?;
/// let start = Cell::new(0, 0);
/// let rays = [
///     CellRay::to_wall(Direction::West, 0),
///     CellRay::to_wall(Direction::North, 11),
///     CellRay::to_wall(Direction::East, 0),
/// ];
/// assert_eq!(map.observe(start, &rays)?, 13, "the wall in the west is the border, which was known");
/// assert_eq!(map.knowledge(Cell::new(0, 10), Direction::North), Knowledge::Open);
/// assert_eq!(map.knowledge(Cell::new(0, 11), Direction::North), Knowledge::Wall);
///
/// assert_eq!(map.uncertainty(Cell::new(0, 11)), 1);
/// assert!(map.is_dead_end(start));
/// assert_eq!(map.undo(1), 1);
/// assert_eq!(map.uncertainty(Cell::new(0, 11)), 3);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// Two maps are equal if they know the same, count the same visits and would forget the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "super::SavedWallMap", into = "super::SavedWallMap")
)]
pub struct WallMap<const N: usize, const LOG: usize = 64> {
    grid: Grid,
    closed_cells: ClosedCells,
    /// Walls between a cell and its eastern neighbour.
    east: Plane<N>,
    /// Walls between a cell and its northern neighbour.
    north: Plane<N>,
    log: Log<LOG>,
    /// Number of visits to each cell, by y, then x. A count stays at its maximum.
    visits: [[u8; N]; N],
}

/// State of the walls on one side of every cell: two bits each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Plane<const N: usize> {
    /// Known walls by y; bit x is set where the wall is known.
    known: [u32; N],
    /// Standing walls by y; bit x is set where the wall is known to stand.
    standing: [u32; N],
}

/// Whether the maze's rules allow cells with four walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum ClosedCells {
    /// A cell may have walls on all four sides: unseen walls stay unknown.
    Possible,
    /// No cell is walled in: where three walls are known to stand, the fourth does not.
    Impossible,
}

/// Reason why an observation is refused. The map is then unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ObserveError {
    /// The observer stands outside the maze.
    #[error(
        "nothing can be observed from {cell}; give a cell of the maze of {} × {} cells",
        grid.width(), grid.height()
    )]
    Outside {
        /// Cell beside the wall.
        cell: Cell,
        /// Size of the maze.
        grid: Grid,
    },
    /// The observation contradicts a known wall.
    #[error(
        "the {direction} side of {cell} is known to be {}: the mouse is elsewhere, or an observation was \
         wrong and has to be undone",
        if *known == Knowledge::Wall { "a wall" } else { "open" }
    )]
    Contradiction {
        /// Cell whose wall is contradicted.
        cell: Cell,
        /// Side of the cell on which the wall is.
        direction: Direction,
        /// Knowledge of the wall before the observation.
        known: Knowledge,
    },
}

impl<const N: usize> Plane<N> {
    const UNKNOWN: Self = Self {
        known: [0; N],
        standing: [0; N],
    };

    fn knowledge(&self, cell: Cell) -> Knowledge {
        let (x, y) = (u32::from(cell.x), usize::from(cell.y));
        let bit = |rows: &[u32; N]| rows.get(y).is_some_and(|row| row >> (x & 31) & 1 == 1);
        if bit(&self.known) {
            Knowledge::of_standing(bit(&self.standing))
        } else {
            Knowledge::Unknown
        }
    }

    fn set(&mut self, cell: Cell, knowledge: Knowledge) {
        let (bit, y) = (1 << (u32::from(cell.x) & 31), usize::from(cell.y));
        if let (Some(known), Some(standing)) = (self.known.get_mut(y), self.standing.get_mut(y)) {
            match knowledge {
                Knowledge::Unknown => *known &= !bit,
                Knowledge::Open | Knowledge::Wall => *known |= bit,
            }
            match knowledge {
                Knowledge::Unknown | Knowledge::Open => *standing &= !bit,
                Knowledge::Wall => *standing |= bit,
            }
        }
    }

    fn count(&self) -> u32 {
        self.known.iter().map(|row| row.count_ones()).sum()
    }
}

impl<const N: usize, const LOG: usize> WallMap<N, LOG> {
    /// Returns a map of an unseen maze: only the border is known.
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub const fn new(grid: Grid, closed_cells: ClosedCells) -> Result<Self, TooLarge> {
        const { assert!(N <= 32, "a row of a map is 32 bits wide") };
        if let Err(error) = TooLarge::check(grid, N) {
            return Err(error);
        }
        Ok(Self {
            grid,
            closed_cells,
            east: Plane::UNKNOWN,
            north: Plane::UNKNOWN,
            log: Log::new(),
            visits: [[0; N]; N],
        })
    }

    /// Returns the knowledge of a wall; beyond the grid every wall stands.
    #[must_use]
    pub fn wall(&self, wall: Wall) -> Knowledge {
        let side = self.grid.side(wall);
        side.map_or(Knowledge::Wall, |(cell, direction)| {
            self.knowledge(cell, direction)
        })
    }

    /// Records all rays seen from `cell` at one moment, each along its whole length. Returns the
    /// number of walls that became known. Of two rays in one direction the first counts. O(cells
    /// along the rays).
    ///
    /// # Errors
    /// If a ray contradicts what is known, or leaves the maze; then nothing is recorded.
    pub fn observe(&mut self, cell: Cell, rays: &[CellRay]) -> Result<u16, ObserveError> {
        let grid = self.grid;
        if !grid.contains(cell) {
            return Err(ObserveError::Outside { cell, grid });
        }
        for ray in rays {
            self.check(cell, *ray)?;
        }
        let mut learned = 0;
        for ray in rays {
            let mut at = cell;
            for _ in 0..ray.open {
                self.learn(at, ray.direction, Knowledge::Open, &mut learned);
                at = grid.neighbour(at, ray.direction).unwrap_or(at);
            }
            if ray.end == RayEnd::Wall {
                self.learn(at, ray.direction, Knowledge::Wall, &mut learned);
                self.infer(at, &mut learned);
                if let Some(beyond) = grid.neighbour(at, ray.direction) {
                    self.infer(beyond, &mut learned);
                }
            }
        }
        Ok(learned)
    }

    /// Forgets whether a wall stands on a side of a cell, because it is not as it was. Nothing is
    /// forgotten of the border of the maze.
    pub fn forget(&mut self, cell: Cell, direction: Direction) {
        self.set(cell, direction, Knowledge::Unknown);
    }

    /// Forgets the walls of the last `observations` that had anything new, inferences included.
    /// Returns the number of observations undone, which is smaller if the map no longer remembers
    /// them. Visits stay.
    pub fn undo(&mut self, observations: usize) -> usize {
        for undone in 0..observations {
            if !self.log.holds_last() {
                return undone;
            }
            while let Some((wall, first)) = self.log.pop() {
                if let Some((cell, direction)) = self.grid.side(wall) {
                    self.set(cell, direction, Knowledge::Unknown);
                }
                if first {
                    break;
                }
            }
        }
        observations
    }

    /// Counts a visit to a cell of the maze; visits to other cells do not count.
    pub fn visit(&mut self, cell: Cell) {
        if let Some(visits) = self.visits_mut(cell) {
            *visits = visits.saturating_add(1);
        }
    }

    /// Takes back a visit to a cell, because the mouse was elsewhere.
    pub fn unvisit(&mut self, cell: Cell) {
        if let Some(visits) = self.visits_mut(cell) {
            *visits = visits.saturating_sub(1);
        }
    }

    fn visits_mut(&mut self, cell: Cell) -> Option<&mut u8> {
        let rows = self.grid.contains(cell).then_some(&mut self.visits)?;
        let row = rows.get_mut(usize::from(cell.y))?;
        row.get_mut(usize::from(cell.x))
    }

    /// Returns the number of visits to a cell; 255 stands for all greater numbers.
    #[must_use]
    pub fn visits(&self, cell: Cell) -> u8 {
        let row = self.visits.get(usize::from(cell.y));
        let visits = row.and_then(|row| row.get(usize::from(cell.x)));
        visits.copied().unwrap_or(0)
    }

    /// Returns the memory for the largest maze of `N` × `N` cells, bytes, without the log of
    /// observations.
    #[must_use]
    pub const fn bytes(&self) -> usize {
        size_of::<Self>() - size_of::<Log<LOG>>()
    }

    /// Returns the number of visited cells.
    #[must_use]
    pub fn visited_count(&self) -> usize {
        self.visits
            .iter()
            .flatten()
            .filter(|visits| **visits > 0)
            .count()
    }

    /// Returns the number of unknown sides of a cell, 0 to 4.
    #[must_use]
    pub fn uncertainty(&self, cell: Cell) -> u8 {
        self.count(cell, Knowledge::Unknown)
    }

    /// Returns the number of unknown walls.
    #[must_use]
    pub fn unknown_count(&self) -> u32 {
        let (width, height) = (u32::from(self.grid.width()), u32::from(self.grid.height()));
        if width == 0 || height == 0 {
            return 0;
        }
        let inner = (width - 1) * height + width * (height - 1);
        inner - self.east.count() - self.north.count()
    }

    /// Returns whether three sides of a cell are known to be walls: the only way out is back.
    #[must_use]
    pub fn is_dead_end(&self, cell: Cell) -> bool {
        self.count(cell, Knowledge::Wall) >= 3
    }

    fn count(&self, cell: Cell, what: Knowledge) -> u8 {
        Direction::ALL
            .into_iter()
            .map(|direction| u8::from(self.knowledge(cell, direction) == what))
            .sum()
    }

    /// Checks that the ray contradicts no known wall.
    fn check(&self, cell: Cell, ray: CellRay) -> Result<(), ObserveError> {
        let direction = ray.direction;
        let refuse = |cell, known| {
            Err(ObserveError::Contradiction {
                cell,
                direction,
                known,
            })
        };
        let mut at = cell;
        for _ in 0..ray.open {
            match (
                self.knowledge(at, direction),
                self.grid.neighbour(at, direction),
            ) {
                (Knowledge::Wall, _) | (_, None) => return refuse(at, Knowledge::Wall),
                (_, Some(beyond)) => at = beyond,
            }
        }
        match (ray.end, self.knowledge(at, direction)) {
            (RayEnd::Wall, Knowledge::Open) => refuse(at, Knowledge::Open),
            _ => Ok(()),
        }
    }

    /// Records a wall that was unknown.
    fn learn(&mut self, cell: Cell, direction: Direction, what: Knowledge, learned: &mut u16) {
        if self.knowledge(cell, direction) == Knowledge::Unknown {
            self.set(cell, direction, what);
            self.log.push(self.grid.wall(cell, direction), *learned);
            *learned += 1;
        }
    }

    /// Infers from three known walls that the fourth is open, if the maze's rules allow it.
    fn infer(&mut self, cell: Cell, learned: &mut u16) {
        if self.closed_cells == ClosedCells::Impossible && self.is_dead_end(cell) {
            for direction in Direction::ALL {
                self.learn(cell, direction, Knowledge::Open, learned);
            }
        }
    }

    fn set(&mut self, cell: Cell, direction: Direction, knowledge: Knowledge) {
        match inner_wall(self.grid, cell, direction) {
            Some((cell, Direction::East)) => self.east.set(cell, knowledge),
            Some((cell, _)) => self.north.set(cell, knowledge),
            None => {}
        }
    }
}

#[cfg(feature = "serde")]
impl<const N: usize, const LOG: usize> WallMap<N, LOG> {
    pub(super) const fn closed_cells(&self) -> ClosedCells {
        self.closed_cells
    }

    /// Returns the walls that can be forgotten again, by observation.
    pub(super) fn remembered(&self) -> alloc::vec::Vec<alloc::vec::Vec<Wall>> {
        self.log.observations()
    }

    /// Restores an inner wall from its saved state.
    pub(super) fn restore_wall(&mut self, wall: Wall, knowledge: Knowledge) {
        if let Some((cell, direction)) = self.grid.side(wall) {
            self.set(cell, direction, knowledge);
        }
    }

    /// Adds the `place`-th wall of an observation to the end of the log.
    pub(super) fn restore_log(&mut self, wall: Wall, place: u16) {
        self.log.push(wall, place);
    }

    pub(super) fn restore_visits(&mut self, cell: Cell, count: u8) {
        let row = self.visits.get_mut(usize::from(cell.y));
        if let Some(visits) = row.and_then(|row| row.get_mut(usize::from(cell.x))) {
            *visits = count;
        }
    }
}

impl<const N: usize, const LOG: usize> Walls for WallMap<N, LOG> {
    fn grid(&self) -> Grid {
        self.grid
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        match inner_wall(self.grid, cell, direction) {
            Some((cell, Direction::East)) => self.east.knowledge(cell),
            Some((cell, _)) => self.north.knowledge(cell),
            None => Knowledge::Wall,
        }
    }
}

/// Returns the wall on a side of a cell as that in the east or north of a cell; `None` on the
/// border and beyond.
fn inner_wall(grid: Grid, cell: Cell, side: Direction) -> Option<(Cell, Direction)> {
    let beyond = grid.neighbour(cell, side).filter(|_| grid.contains(cell))?;
    Some(match side {
        Direction::North | Direction::East => (cell, side),
        Direction::South | Direction::West => (beyond, side.opposite()),
    })
}
