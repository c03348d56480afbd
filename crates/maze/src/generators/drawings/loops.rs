use rand::Rng;

use super::super::{GenerateError, chance};
use super::pen::Pen;
use crate::{Cell, Maze};

/// Maximum length of a corridor of a ladder, cells.
const LONGEST: u16 = 15;

/// Draws a ring: one loop of four equal sides, as large as fits. Start and goal lie opposite each
/// other, anywhere on it. O(cells).
///
/// # Errors
/// [`GenerateError`] below 3 × 3 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let ring = tolman_maze::drawings::ring((6, 5), &mut rng)?;
/// assert_eq!(ring.reachable().count(), 4 * 4);
/// assert!(ring.reachable().all(|cell| ring.degree(cell) == 2));
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn ring(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("ring", size, (3, 3))?;
    let side = size.0.min(size.1) - 1;
    pen.rectangle(Cell::new(0, 0), side, side);
    Ok(pen.finish_anywhere(rng))
}

/// Draws a ladder: two equal square loops side by side that share a rung. The corridors between
/// corners and forks have a random length of 1 to 15 cells, as far as it fits. Start and goal lie
/// anywhere, far from each other. O(cells).
///
/// # Errors
/// [`GenerateError`] below 5 × 3 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let ladder = tolman_maze::drawings::ladder((9, 5), &mut rng)?;
/// assert_eq!(ladder.junctions().count(), 2);
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn ladder(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let pen = Pen::new("ladder", size, (5, 3))?;
    let most = ((size.0 - 1) / 2).min(size.1 - 1) - 1;
    let corridor = chance::between(1, most.min(LONGEST), rng);
    Ok(rungs(pen, corridor, rng))
}

/// Draws a ladder whose corridors are `corridor` cells long. O(cells).
///
/// # Errors
/// [`GenerateError`] without a cell, or above 510.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let ladder = tolman_maze::drawings::ladder_of(3, &mut rng)?;
/// assert_eq!((ladder.grid().width(), ladder.grid().height()), (9, 5));
/// assert_eq!(ladder.reachable().count(), 6 + 7 * 3);
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn ladder_of(corridor: u16, rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let side = corridor.saturating_add(1);
    let size = (
        side.saturating_mul(2).saturating_add(1),
        side.saturating_add(1),
    );
    Ok(rungs(Pen::new("ladder", size, (5, 3))?, corridor, rng))
}

/// Draws both loops.
fn rungs(mut pen: Pen, corridor: u16, rng: &mut impl Rng) -> Maze {
    let side = corridor + 1;
    pen.rectangle(Cell::new(0, 0), side, side);
    pen.rectangle(Cell::new(side, 0), side, side);
    pen.finish_anywhere(rng)
}

/// Draws an eight: two loops of any sides that share one crossing. Start and goal lie anywhere, far
/// from each other. O(cells).
///
/// # Errors
/// [`GenerateError`] below 5 × 5 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let eight = tolman_maze::drawings::eight((6, 7), &mut rng)?;
/// let crossings: Vec<_> = eight.junctions().collect();
/// assert_eq!((crossings.len(), eight.degree(crossings[0])), (1, 4));
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn eight(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("eight", size, (5, 5))?;
    let crossing = Cell::new(
        chance::between(2, size.0 - 3, rng),
        chance::between(2, size.1 - 3, rng),
    );
    pen.rectangle(Cell::new(0, 0), crossing.x, crossing.y);
    pen.rectangle(crossing, size.0 - 1 - crossing.x, size.1 - 1 - crossing.y);
    Ok(pen.finish_anywhere(rng))
}
