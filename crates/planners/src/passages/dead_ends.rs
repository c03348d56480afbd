use tolman_maze::Cell;

use super::Passages;
use crate::speed_run::{beside, opposite};

/// Marks a cell as one to keep: with it, one open side is not the only bit.
const KEPT: u8 = 1 << 7;

impl<const N: usize> Passages<N> {
    /// Closes all dead ends: cells with one open side that are not in `kept`. O(N²).
    ///
    /// Who never turns round within a cell cannot leave a dead end again.
    pub(crate) fn without_dead_ends(&self, kept: impl IntoIterator<Item = Cell>) -> Self {
        let mut open = self.clone();
        for cell in kept {
            open.mark(cell, KEPT);
        }
        let sides = open.sides.as_flattened_mut();
        for first in (0..N * N).step_by(8) {
            let mut eight = [0; 8];
            for (to, from) in eight.iter_mut().zip(sides.iter().skip(first)) {
                *to = *from;
            }
            let mut ends = dead_ends(u64::from_le_bytes(eight));
            while ends != 0 {
                close_way::<N>(sides, first + ends.trailing_zeros() as usize / 8);
                ends &= ends - 1;
            }
        }
        sides.iter_mut().for_each(|sides| *sides &= !KEPT);
        open
    }
}

/// Closes the only way out of `cell`, then that out of the next one if it is the only one there,
/// and so on.
fn close_way<const N: usize>(sides: &mut [u8], mut cell: usize) {
    let is_dead_end = |sides: &&mut u8| matches!(**sides, 1 | 2 | 4 | 8);
    while let Some(only) = sides.get_mut(cell).filter(is_dead_end) {
        let direction = only.trailing_zeros() as usize;
        *only = 0;
        cell = beside::<N>(cell, direction);
        if let Some(sides) = sides.get_mut(cell) {
            *sides &= !(1 << opposite(direction));
        }
    }
}

/// Returns which of eight cells, a byte each, have one open side and are not kept, as the highest
/// bits of their bytes.
const fn dead_ends(sides: u64) -> u64 {
    /// 1 in each byte.
    const EACH: u64 = u64::MAX / 0xff;
    const fn not_zero(bytes: u64) -> u64 {
        (bytes + 0x7f * EACH) & (0x80 * EACH)
    }
    let open = sides & (0x0f * EACH);
    let but_the_first = open & ((open | (0x10 * EACH)) - EACH);
    not_zero(open) & !not_zero(but_the_first) & !sides
}

#[cfg(test)]
#[cfg(feature = "alloc")]
mod tests {
    use alloc::vec::Vec;

    use proptest::prelude::*;
    use tolman_maze::{Direction, Grid, Maze};

    use super::super::open_sides;
    use super::*;
    use crate::Unknown;

    /// Closes cells with one open side as long as there is one.
    fn closed_one_by_one(mut maze: Maze, kept: &[Cell]) -> Maze {
        let only_way = |maze: &Maze, cell| {
            let mut open = Direction::ALL
                .into_iter()
                .filter(|side| maze.is_open(cell, *side));
            let only = open.next().filter(|_| !kept.contains(&cell))?;
            open.next().is_none().then_some((cell, only))
        };
        while let Some((cell, side)) = maze.grid().cells().find_map(|cell| only_way(&maze, cell)) {
            maze.set_wall(cell, side, true);
        }
        maze
    }

    proptest! {
        #[test]
        fn dead_ends_are_closed_one_by_one(
            (width, height) in (1_u16..=7, 1_u16..=7),
            walls in prop::collection::vec(prop::bool::weighted(0.55), 98),
            kept in prop::collection::vec((0_u16..7, 0_u16..7), 0..4),
        ) {
            let mut maze = Maze::open(Grid::new(width, height));
            let sides: Vec<_> = open_sides::<7>(&maze, Unknown::Closed).into_iter().flatten().collect();
            for ((cell, side), stands) in sides.into_iter().zip(walls) {
                maze.set_wall(cell, side, stands);
            }
            let kept: Vec<Cell> = kept.into_iter().map(|(x, y)| Cell::new(x, y)).collect();
            let passages = |maze: &Maze| Passages::<7>::new(maze, Unknown::Closed);
            let closed = passages(&maze).map(|open| open.without_dead_ends(kept.iter().copied()));
            prop_assert_eq!(closed, passages(&closed_one_by_one(maze, &kept)));
        }
    }
}
