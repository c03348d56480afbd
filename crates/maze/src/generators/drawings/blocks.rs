use alloc::vec::Vec;

use rand::Rng;

use super::super::{GenerateError, chance};
use super::pen::Pen;
use crate::{Cell, Direction, Maze};

/// Distance between neighbouring crossings, cells.
const STREET: u16 = 2;

/// Draws city blocks: streets along every other row and column. A quarter of the ways between two
/// crossings is walled up, as far as everything stays connected. Start and goal lie at crossings or
/// ends. O(ways · cells).
///
/// # Errors
/// [`GenerateError`] below 3 × 3 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let blocks = tolman_maze::drawings::blocks((7, 7), &mut rng)?;
/// assert!(blocks.grid().cells().all(|cell| cell.x % 2 == 0 || cell.y % 2 == 0 || blocks.degree(cell) == 0));
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn blocks(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("blocks", size, (3, 3))?;
    let last = |side: u16| (side - 1) / STREET * STREET;
    let (east, north) = (last(size.0), last(size.1));
    let mut ways: Vec<(Cell, Direction)> = Vec::new();
    for y in (0..=north).step_by(STREET.into()) {
        for x in (0..=east).step_by(STREET.into()) {
            let crossing = Cell::new(x, y);
            ways.extend((x < east).then_some((crossing, Direction::East)));
            ways.extend((y < north).then_some((crossing, Direction::North)));
        }
    }
    for (crossing, way) in &ways {
        pen.line(*crossing, *way, STREET);
    }
    chance::shuffle(&mut ways, rng);
    let mut left = ways.len() / 4;
    for (crossing, way) in ways {
        left -= usize::from(left > 0 && wall_up(&mut pen, crossing, way));
    }
    Ok(pen.finish(Cell::new(0, 0), rng))
}

/// Puts a wall across a way unless that cuts something off, and returns whether it did.
fn wall_up(pen: &mut Pen, crossing: Cell, way: Direction) -> bool {
    let Some(middle) = crossing.beyond(way) else {
        return false;
    };
    let sides = [way, way.opposite()];
    for side in sides {
        pen.set(middle, side, true);
    }
    let steps = pen.maze().steps_to(&[Cell::new(0, 0)]);
    let reached = pen.drawn();
    let mut reached = reached.iter().map(|cell| steps[pen.grid().index(*cell)]);
    let is_whole = reached.all(|steps| steps.is_some()) && pen.maze().degree(crossing) > 0;
    let beyond = middle
        .beyond(way)
        .is_some_and(|end| pen.maze().degree(end) > 0);
    if !(is_whole && beyond) {
        for side in sides {
            pen.set(middle, side, false);
        }
        return false;
    }
    true
}
