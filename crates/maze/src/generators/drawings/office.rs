use alloc::vec;
use alloc::vec::Vec;

use rand::Rng;

use super::super::{GenerateError, chance};
use super::pen::Pen;
use crate::{Cell, Direction, Maze};

/// Number of rows of one corridor with the rooms on both its sides.
const DEPTH: u16 = 3;

/// Draws an office floor: corridors from west to east with rooms on both sides. Rooms are one or
/// two cells wide and have one doorway each. A corridor at both ends joins them all. The start is
/// the west end of the first corridor, the goal a room. O(cells).
///
/// # Errors
/// [`GenerateError`] below 4 × 3 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let office = tolman_maze::drawings::office((8, 6), &mut rng)?;
/// assert!(office.dead_ends().count() >= 8);
/// assert!(!office.grid().cells().any(|cell| office.is_room(cell)));
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn office(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("office", size, (4, DEPTH))?;
    let (width, corridors) = (size.0, size.1 / DEPTH);
    let start = Cell::new(0, 1);
    for corridor in 0..corridors {
        let y = DEPTH * corridor + 1;
        pen.line(Cell::new(0, y), Direction::East, width - 1);
        for side in [Direction::North, Direction::South] {
            rooms(&mut pen, y, side, rng);
        }
    }
    for x in [0, width - 1] {
        pen.line(Cell::new(x, 1), Direction::North, DEPTH * (corridors - 1));
    }
    let mut maze = pen.finish(start, rng);
    let ends: Vec<Cell> = maze.dead_ends().filter(|cell| *cell != start).collect();
    if let Some(goal) = ends.get(chance::position(ends.len().max(1), rng)) {
        maze.set_goals(vec![*goal]);
    }
    Ok(maze)
}

/// Draws the rooms on one side of the corridor in row `y`, between the corridors at both ends.
fn rooms(pen: &mut Pen, y: u16, side: Direction, rng: &mut impl Rng) {
    let last = pen.grid().width() - 2;
    let mut x = 1;
    while x <= last {
        let width = chance::between(1, 2, rng).min(last - x + 1);
        let doorway = Cell::new(x + chance::between(0, width - 1, rng), y);
        pen.set(doorway, side, false);
        if let Some(west) = Cell::new(x, y).beyond(side) {
            pen.line(west, Direction::East, width - 1);
        }
        x += width;
    }
}
