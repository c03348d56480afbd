use rand::Rng;

use super::super::{GenerateError, Perfect, chance};
use super::pen::Pen;
use crate::{Cell, Direction, Maze};

/// Draws wings: a spine from west to east, and on it two wings side by side, or four, two of them
/// mirrored to the south. All wings are the same perfect maze. The start is the west end of the
/// spine. O(cells).
///
/// # Errors
/// [`GenerateError`] below 5 × 5 cells or above 1024 a side.
///
/// ```
/// use rand::SeedableRng;
///
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
/// let wings = tolman_maze::drawings::wings((9, 7), &mut rng)?;
/// assert!(wings.junctions().count() >= 2);
/// # Ok::<(), tolman_maze::GenerateError>(())
/// ```
pub fn wings(size: (u16, u16), rng: &mut impl Rng) -> Result<Maze, GenerateError> {
    let mut pen = Pen::new("wings", size, (5, 5))?;
    let has_four = chance::position(2, rng) == 0;
    let (width, height) = ((size.0 - 1) / 2, (size.1 - 1) / 2);
    let wing = Perfect { width, height }.generate(rng)?;
    let door = chance::between(0, width - 1, rng);
    // The column west of the wings is the spine's alone.
    let start = Cell::new(0, height);
    let mut last = start;
    for west in [1, 1 + width] {
        copy(&mut pen, &wing, |cell| {
            Cell::new(west + cell.x, height + 1 + cell.y)
        });
        let at = Cell::new(west + door, height);
        pen.set(at, Direction::North, false);
        if has_four {
            copy(&mut pen, &wing, |cell| {
                Cell::new(west + cell.x, height - 1 - cell.y)
            });
            pen.set(at, Direction::South, false);
        }
        last = at;
    }
    pen.line(start, Direction::East, last.x - start.x);
    Ok(pen.finish(start, rng))
}

/// Opens in `pen` every wall that is open in `wing`, at the place that `lies` gives for each cell.
fn copy(pen: &mut Pen, wing: &Maze, lies: impl Fn(Cell) -> Cell) {
    for cell in wing.grid().cells() {
        for (_, next) in wing.neighbours(cell) {
            let (from, to) = (lies(cell), lies(next));
            let way = Direction::ALL.into_iter();
            let mut way = way.filter(|way| from.beyond(*way) == Some(to));
            if let Some(way) = way.next() {
                pen.set(from, way, false);
            }
        }
    }
}
