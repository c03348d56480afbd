use rand::Rng;

use super::super::{GenerateError, chance};
use super::pen::Pen;
use crate::{Cell, Direction, Maze};

/// Draws a spiral: one corridor that winds inwards from the south-west corner, to the right or to
/// the left. It ends at any of the last cells. The start is its outer end, the goal its inner one.
/// O(cells).
///
/// # Errors
/// [`GenerateError`] below 3 × 3 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let spiral = tolman_maze::drawings::spiral((6, 6), &mut rng)?;
/// assert_eq!((spiral.junctions().count(), spiral.dead_ends().count()), (0, 2));
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn spiral(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("spiral", size, (3, 3))?;
    let cells = pen.grid().cell_count() as u16;
    let left_out = chance::between(0, size.0.min(size.1), rng).min(cells - 4);
    let winds_right = chance::position(2, rng) == 0;
    let start = Cell::new(0, 0);
    let (mut at, mut ahead) = match winds_right {
        true => (start, Direction::North),
        false => (start, Direction::East),
    };
    for _ in 1..cells - left_out {
        let is_free = |pen: &Pen, way| {
            let next = pen.grid().neighbour(at, way);
            next.is_some_and(|next| next != start && pen.maze().degree(next) == 0)
        };
        if !is_free(&pen, ahead) {
            ahead = match winds_right {
                true => ahead.right(),
                false => ahead.left(),
            };
        }
        if !is_free(&pen, ahead) {
            break;
        }
        at = pen.line(at, ahead, 1);
    }
    Ok(pen.finish(start, rng))
}
