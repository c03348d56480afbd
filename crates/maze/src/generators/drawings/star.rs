use rand::Rng;

use super::super::{GenerateError, chance};
use super::pen::Pen;
use crate::{Cell, Direction, Maze};

/// Draws a star: four arms of any length from a hub, each with a bend to its right at the end, or
/// none. The start is the end of one arm, the goal the end that is farthest from it. O(cells).
///
/// # Errors
/// [`GenerateError`] below 3 × 3 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let star = tolman_maze::drawings::star((7, 7), &mut rng)?;
/// assert_eq!((star.junctions().count(), star.dead_ends().count()), (1, 4));
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn star(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("star", size, (3, 3))?;
    let hub = Cell::new(size.0 / 2, size.1 / 2);
    let reach = |way| match way {
        Direction::North => size.1 - 1 - hub.y,
        Direction::East => size.0 - 1 - hub.x,
        Direction::South => hub.y,
        Direction::West => hub.x,
    };
    let ends = Direction::ALL.map(|way| {
        let end = pen.line(hub, way, chance::between(1, reach(way), rng));
        // The quarter to the right of an arm is its own; the next arm bounds it.
        let room = reach(way.right()) - 1;
        pen.line(end, way.right(), chance::between(0, room, rng))
    });
    Ok(pen.finish(ends[chance::position(ends.len(), rng)], rng))
}
