use alloc::vec;
use alloc::vec::Vec;

use rand::Rng;

use super::{GenerateError, carved, chance, grid};
use crate::{Cell, Direction, Grid, Maze};

/// A small maze of corridors with one loop, one four-way crossing and several dead ends.
///
/// Junctions, bends and dead ends lie on lines of a lattice, two or three cells apart. A random
/// tree grows over it, one random corridor at a time, and one more corridor closes the loop. Trees
/// are drawn until one has the features asked for. The goal lies in the bottom right corner; no
/// start is marked, and cells between the corridors are closed. O(tries · cells).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OneLoop {
    /// Number of columns, at least 3.
    pub width: u16,
    /// Number of rows, at least 3.
    pub height: u16,
    /// Minimum number of dead ends.
    pub dead_ends: usize,
    /// Maximum length of a short corridor, cells from one bend, junction or dead end to the next.
    /// Three quarters of all corridors are short.
    pub short: u32,
}

/// Maximum number of trees that are tried.
const TRIES: u32 = 10_000;

impl OneLoop {
    /// Generates the maze that `rng` leads to.
    ///
    /// # Errors
    /// [`GenerateError::Size`]; [`GenerateError::Features`] when no tree has the dead ends, the
    /// crossing and the short corridors.
    ///
    /// ```
    /// use rand::SeedableRng;
    /// use tolman_maze::OneLoop;
    ///
    /// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    /// let drawing = OneLoop { width: 10, height: 6, dead_ends: 4, short: 4 };
    /// let maze = drawing.generate(&mut rng).unwrap();
    /// assert_eq!(maze.opening_count(), maze.reachable().count());
    /// ```
    pub fn generate(&self, rng: &mut impl Rng) -> Result<Maze, GenerateError> {
        let Self { width, height, .. } = *self;
        let grid = grid(width, height)?;
        if width < 3 || height < 3 {
            return Err(GenerateError::Size { width, height });
        }
        for _ in 0..TRIES {
            let (columns, rows) = (lines(width, rng), lines(height, rng));
            let lattice = tree_with_loop(&columns, &rows, rng);
            let maze = stretched(&lattice, &columns, &rows, grid);
            if self.has_features(&maze) {
                return Ok(maze);
            }
        }
        Err(GenerateError::Features { tries: TRIES })
    }

    fn has_features(&self, maze: &Maze) -> bool {
        let crossings = maze.grid().cells().filter(|cell| maze.degree(*cell) == 4);
        let lengths = corridors(maze);
        let short = lengths.iter().filter(|cells| **cells <= self.short).count();
        crossings.count() == 1
            && maze.dead_ends().count() >= self.dead_ends
            && 4 * short >= 3 * lengths.len()
    }
}

/// Returns lines from the first cell of a side to its last, two or three cells apart.
fn lines(side: u16, rng: &mut impl Rng) -> Vec<u16> {
    let (mut at, last) = (0, side - 1);
    let mut lines = vec![at];
    while at < last {
        at += match last - at {
            left @ (2 | 3) => left,
            4 => 2,
            _ => chance::between(2, 3, rng),
        };
        lines.push(at);
    }
    lines
}

/// Returns a random spanning tree over all crossings of the lines, with one more opening, which
/// closes a loop.
fn tree_with_loop(columns: &[u16], rows: &[u16], rng: &mut impl Rng) -> Maze {
    let grid = Grid::new(columns.len() as u16, rows.len() as u16);
    let mut maze = Maze::solid(grid);
    let mut known = vec![false; grid.cell_count()];
    known[0] = true;
    loop {
        let is_new = |(cell, _, next): &(Cell, Direction, Cell)| {
            known[grid.index(*cell)] != known[grid.index(*next)]
        };
        let ways: Vec<_> = grid.inner_edges().filter(is_new).collect();
        if ways.is_empty() {
            break;
        }
        let (cell, direction, next) = ways[chance::position(ways.len(), rng)];
        maze.set_wall(cell, direction, false);
        known[grid.index(cell)] = true;
        known[grid.index(next)] = true;
    }
    let mut closed: Vec<_> = grid.inner_edges().collect();
    closed.retain(|(cell, direction, _)| !maze.is_open(*cell, *direction));
    if !closed.is_empty() {
        let (cell, direction, _) = closed[chance::position(closed.len(), rng)];
        maze.set_wall(cell, direction, false);
    }
    maze
}

/// Returns the maze of cells whose corridors are those of the lattice.
fn stretched(lattice: &Maze, columns: &[u16], rows: &[u16], grid: Grid) -> Maze {
    let place = |cell: Cell| Cell::new(columns[usize::from(cell.x)], rows[usize::from(cell.y)]);
    let mut maze = Maze::solid(grid);
    for (cell, direction, next) in lattice.grid().inner_edges() {
        if lattice.is_open(cell, direction) {
            let (from, to) = (place(cell), place(next));
            let cells = (to.x - from.x) + (to.y - from.y);
            carved(&mut maze, from, direction, cells);
        }
    }
    maze.set_goals(vec![Cell::new(grid.width() - 1, 0)]);
    maze
}

/// Returns the lengths of all straight corridors, cells from a bend, junction or dead end to the
/// next.
fn corridors(maze: &Maze) -> Vec<u32> {
    let goes_on = |cell, direction: Direction| {
        maze.degree(cell) == 2
            && maze.is_open(cell, direction)
            && maze.is_open(cell, direction.opposite())
    };
    let mut lengths = Vec::new();
    for cell in maze.grid().cells() {
        for direction in [Direction::North, Direction::East] {
            if goes_on(cell, direction) || !maze.is_open(cell, direction) {
                continue;
            }
            let (mut here, mut cells) = (cell, 0);
            while let Some(next) = maze.beside(here, direction) {
                (here, cells) = (next, cells + 1);
                if !goes_on(here, direction) {
                    break;
                }
            }
            lengths.push(cells);
        }
    }
    lengths
}
