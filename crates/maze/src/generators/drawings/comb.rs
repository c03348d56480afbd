use rand::Rng;

use super::super::{GenerateError, chance};
use super::pen::Pen;
use crate::{Cell, Direction, Maze};

/// Draws a comb: a spine along the south, and in every other column a tooth of any length. The
/// start is the spine's west end, the goal the end that is farthest from it. O(cells).
///
/// # Errors
/// [`GenerateError`] below 3 × 2 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let comb = tolman_maze::drawings::comb((9, 5), &mut rng)?;
/// assert_eq!(comb.junctions().count(), 4 - 1);
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn comb(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("comb", size, (3, 2))?;
    let start = Cell::new(0, 0);
    // The last tooth stands at the spine's end.
    let spine = (size.0 - 1) / 2 * 2;
    pen.line(start, Direction::East, spine);
    for x in (2..=spine).step_by(2) {
        let length = chance::between(1, size.1 - 1, rng);
        pen.line(Cell::new(x, 0), Direction::North, length);
    }
    Ok(pen.finish(start, rng))
}
