use alloc::vec;

use rand::Rng;

use super::{GenerateError, carved, chance, grid};
use crate::{Cell, Direction, Maze};

/// A letter J of corridors: a stem, a serif to its left, a hook that turns up again.
///
/// The goal lies in the bottom right corner, where the stem meets the hook. Serif and tail are
/// drawn: the serif from none to the hook's width, the tail from one cell up to one less than the
/// stem. No start is marked, and cells off the letter are closed. O(cells).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hook {
    /// Number of columns: the width of the hook, cells, at least 2.
    pub width: u16,
    /// Number of rows: the height of the stem, cells, at least 3.
    pub height: u16,
}

impl Hook {
    /// Generates the letter that `rng` leads to.
    ///
    /// # Errors
    /// [`GenerateError::Size`], also when it is too small for a letter.
    ///
    /// ```
    /// use rand::SeedableRng;
    /// use tolman_maze::{Cell, Hook};
    ///
    /// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    /// let maze = Hook { width: 6, height: 9 }.generate(&mut rng).unwrap();
    /// assert_eq!(maze.goals(), [Cell::new(5, 0)]);
    /// assert_eq!(maze.dead_ends().count(), 2);
    /// ```
    pub fn generate(&self, rng: &mut impl Rng) -> Result<Maze, GenerateError> {
        let Self { width, height } = *self;
        let grid = grid(width, height)?;
        if width < 2 || height < 3 {
            return Err(GenerateError::Size { width, height });
        }
        let serif = chance::between(0, width - 1, rng);
        let tail = chance::between(1, height - 2, rng);
        let mut maze = Maze::solid(grid);
        let mut pen = Cell::new(width - 1 - serif, height - 1);
        let strokes = [
            (Direction::East, serif),
            (Direction::South, height - 1),
            (Direction::West, width - 1),
            (Direction::North, tail),
        ];
        for (direction, cells) in strokes {
            pen = carved(&mut maze, pen, direction, cells);
        }
        maze.set_goals(vec![Cell::new(width - 1, 0)]);
        Ok(maze)
    }
}
