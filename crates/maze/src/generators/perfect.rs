use alloc::vec;
use alloc::vec::Vec;

use rand::Rng;

use super::{GenerateError, chance, grid, mark};
use crate::{Cell, Direction, Maze};

/// A perfect maze: exactly one way between any two cells, so no loops.
///
/// It has long winding corridors and few short dead ends. The recursive backtracker makes it: a
/// depth-first walk that carves into a random unvisited neighbour and turns back where there is
/// none. Start in the south-west, open to one side; goal in the middle, of at most 2 × 2 cells the
/// one farthest from the start. O(cells).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Perfect {
    /// Number of columns.
    pub width: u16,
    /// Number of rows.
    pub height: u16,
}

impl Perfect {
    /// Generates the maze that `rng` leads to.
    ///
    /// # Errors
    /// [`GenerateError::Size`].
    ///
    /// ```
    /// use rand::SeedableRng;
    /// use tolman_maze::Perfect;
    ///
    /// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    /// let maze = Perfect { width: 8, height: 5 }.generate(&mut rng).unwrap();
    /// assert_eq!(maze.opening_count(), 8 * 5 - 1);
    /// assert!(Perfect { width: 0, height: 5 }.generate(&mut rng).is_err());
    /// ```
    pub fn generate(&self, rng: &mut impl Rng) -> Result<Maze, GenerateError> {
        let grid = grid(self.width, self.height)?;
        let mut maze = Maze::solid(grid);
        let mut regions = vec![None; grid.cell_count()];
        carve(&mut maze, &mut regions, 0, Cell::new(0, 0), rng);
        mark(&mut maze);
        Ok(maze)
    }
}

/// Carves with the recursive backtracker from `start` through every cell that it can reach over
/// cells without a region. All of them then belong to `region`. `regions` is by
/// [`Grid::index`](crate::Grid::index).
///
/// In the south-west corner it leaves to the north, so that this cell keeps three walls, as the
/// competition rules want it.
pub(super) fn carve(
    maze: &mut Maze,
    regions: &mut [Option<u32>],
    region: u32,
    start: Cell,
    rng: &mut impl Rng,
) {
    let grid = maze.grid();
    regions[grid.index(start)] = Some(region);
    let mut trail = vec![start];
    while let Some(here) = trail.last().copied() {
        let free = |direction| {
            let next = grid.neighbour(here, direction)?;
            regions[grid.index(next)]
                .is_none()
                .then_some((direction, next))
        };
        let ways: Vec<(Direction, Cell)> = Direction::ALL.into_iter().filter_map(free).collect();
        if ways.is_empty() {
            trail.pop();
            continue;
        }
        // North comes first in the list.
        let corner = here == Cell::new(0, 0);
        let (direction, next) = ways[if corner {
            0
        } else {
            chance::position(ways.len(), rng)
        }];
        maze.set_wall(here, direction, false);
        regions[grid.index(next)] = Some(region);
        trail.push(next);
    }
}
