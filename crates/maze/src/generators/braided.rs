use alloc::vec::Vec;

use rand::Rng;

use super::{GenerateError, Perfect, chance};
use crate::{Cell, Direction, Maze};

/// A maze with loops: a [`Perfect`] one in which a share of the dead ends is opened.
///
/// A dead end is opened by removing one of its inner walls, at random, if possible one to another
/// dead end. The start keeps its three walls. With a share of 0 the maze stays perfect. With 1 the
/// only other dead ends are those that have only the border and the start beside them. O(cells).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braided {
    /// Number of columns.
    pub width: u16,
    /// Number of rows.
    pub height: u16,
    /// The share of dead ends to open, 0 … 1.
    pub share: f64,
}

impl Braided {
    /// Generates the maze that `rng` leads to.
    ///
    /// # Errors
    /// [`GenerateError::Size`], [`GenerateError::Share`].
    ///
    /// ```
    /// use rand::SeedableRng;
    /// use tolman_maze::Braided;
    ///
    /// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    /// let maze = Braided { width: 8, height: 8, share: 1.0 }.generate(&mut rng).unwrap();
    /// // Only the start is still one.
    /// assert_eq!(maze.dead_ends().count(), 1);
    /// ```
    pub fn generate(&self, rng: &mut impl Rng) -> Result<Maze, GenerateError> {
        self.generate_where(rng, |_, _| true)
    }

    /// Generates a maze of corridors alone: no four cells make an open square. A dead end that
    /// could be opened to such a square only stays. O(cells).
    ///
    /// # Errors
    /// As [`generate`](Self::generate).
    ///
    /// ```
    /// use rand::SeedableRng;
    /// use tolman_maze::Braided;
    ///
    /// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    /// let braided = Braided { width: 8, height: 8, share: 1.0 };
    /// let maze = braided.generate_corridors(&mut rng).unwrap();
    /// assert!(!maze.grid().cells().any(|cell| maze.is_room(cell)));
    /// ```
    pub fn generate_corridors(&self, rng: &mut impl Rng) -> Result<Maze, GenerateError> {
        self.generate_where(rng, |maze, (cell, direction)| {
            !opens_room(maze, cell, direction)
        })
    }

    /// Generates a maze in which only walls are removed that `may_open`.
    fn generate_where(
        &self,
        rng: &mut impl Rng,
        may_open: impl Fn(&Maze, (Cell, Direction)) -> bool,
    ) -> Result<Maze, GenerateError> {
        if !(0.0..=1.0).contains(&self.share) {
            return Err(GenerateError::Share { share: self.share });
        }
        let mut maze = Perfect {
            width: self.width,
            height: self.height,
        }
        .generate(rng)?;
        let start = maze.start().map(|(start, _)| start);
        let mut closed: Vec<Cell> = maze
            .dead_ends()
            .filter(|cell| Some(*cell) != start)
            .collect();
        // What was opened is counted by what remains, since one wall can open two. The cast rounds
        // down, so half more makes it the nearest whole number.
        let keep = ((1.0 - self.share) * closed.len() as f64 + 0.5) as usize;
        chance::shuffle(&mut closed, rng);
        let mut remaining = closed.len();
        for cell in closed {
            if remaining <= keep {
                break;
            }
            if maze.degree(cell) == 1 {
                remaining -= open(&mut maze, cell, start, &may_open, rng);
            }
        }
        Ok(maze)
    }
}

/// Opens the dead end `cell`, and returns the reduction of the number of dead ends.
fn open(
    maze: &mut Maze,
    cell: Cell,
    start: Option<Cell>,
    may_open: impl Fn(&Maze, (Cell, Direction)) -> bool,
    rng: &mut impl Rng,
) -> usize {
    let grid = maze.grid();
    let walled = |direction| {
        let beyond = grid.neighbour(cell, direction)?;
        let closed = !maze.is_open(cell, direction) && Some(beyond) != start;
        let closed = closed && may_open(maze, (cell, direction));
        closed.then(|| (direction, maze.degree(beyond) == 1))
    };
    let mut walls: Vec<(Direction, bool)> = Direction::ALL.into_iter().filter_map(walled).collect();
    if walls.iter().any(|(_, dead_end)| *dead_end) {
        walls.retain(|(_, dead_end)| *dead_end);
    }
    if walls.is_empty() {
        return 0;
    }
    let (direction, dead_end) = walls[chance::position(walls.len(), rng)];
    maze.set_wall(cell, direction, false);
    1 + usize::from(dead_end)
}

/// Returns whether an open square of four cells would come about without the wall on that side of
/// `cell`.
fn opens_room(maze: &Maze, cell: Cell, direction: Direction) -> bool {
    let mut opened = maze.clone();
    opened.set_wall(cell, direction, false);
    let around = |at: u16| at.saturating_sub(1)..=at;
    let mut corners = around(cell.x).flat_map(|x| around(cell.y).map(move |y| Cell::new(x, y)));
    corners.any(|corner| opened.is_room(corner))
}
