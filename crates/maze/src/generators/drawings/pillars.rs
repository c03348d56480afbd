use rand::Rng;

use super::super::{GenerateError, chance};
use super::pen::Pen;
use crate::{Cell, Direction, Maze};

/// Draws an open room with pillars of one cell, one in each square of three by three that fits. A
/// pillar is never in the square's first row or column, so that a robot can go round it. Start in
/// the south-west. O(cells).
///
/// # Errors
/// [`GenerateError`] below 4 × 4 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let hall = tolman_maze::drawings::pillars((7, 7), &mut rng)?;
/// assert_eq!(hall.grid().cells().filter(|cell| hall.degree(*cell) == 0).count(), 4);
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn pillars(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("pillars", size, (4, 4))?;
    for cell in pen.grid().cells() {
        pen.set(cell, Direction::North, false);
        pen.set(cell, Direction::East, false);
    }
    for west in (0..size.0 - 3).step_by(3) {
        for south in (0..size.1 - 3).step_by(3) {
            let pillar = Cell::new(
                west + chance::between(1, 2, rng),
                south + chance::between(1, 2, rng),
            );
            for side in Direction::ALL {
                pen.set(pillar, side, true);
            }
        }
    }
    Ok(pen.finish(Cell::new(0, 0), rng))
}
