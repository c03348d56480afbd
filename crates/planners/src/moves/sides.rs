use tolman_maze::{Cell, Direction, Grid, Walls};

use super::Leap;
use super::cell_set::CellSet;
use super::split_mix::SplitMix;
use crate::passages::open_sides;
use crate::{Passages, TooLarge, Unknown};

/// The set of all open sides of cells; a side is in it for both its cells. Like [`Passages`], but
/// for all cells at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sides<const N: usize> {
    /// Cells whose northern side is in the set.
    north: CellSet<N>,
    /// Cells whose eastern side is in the set.
    east: CellSet<N>,
}

impl<const N: usize> Sides<N> {
    pub(super) const NONE: Self = Self {
        north: CellSet::EMPTY,
        east: CellSet::EMPTY,
    };

    /// Returns the known open sides of a maze. O(N²).
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub(super) fn new(walls: &impl Walls, unknown: Unknown) -> Result<Self, TooLarge> {
        Ok(Self::of(open_sides::<N>(walls, unknown)?))
    }

    fn of(sides: impl Iterator<Item = (Cell, Direction)>) -> Self {
        let mut set = Self::NONE;
        for (cell, direction) in sides {
            set.insert(cell, direction);
        }
        set
    }

    /// Returns the cell that a side is north or east of, and the set that it is in.
    fn slot(&mut self, cell: Cell, direction: Direction) -> Option<(Cell, &mut CellSet<N>)> {
        let (cell, side) = northern_or_eastern(cell, direction)?;
        let is_north = side == Direction::North;
        let set = if is_north {
            &mut self.north
        } else {
            &mut self.east
        };
        Some((cell, set))
    }

    pub(super) fn insert(&mut self, cell: Cell, direction: Direction) {
        if let Some((cell, set)) = self.slot(cell, direction) {
            set.insert(cell);
        }
    }

    pub(super) fn remove(&mut self, cell: Cell, direction: Direction) {
        if let Some((cell, set)) = self.slot(cell, direction) {
            set.remove(cell);
        }
    }

    pub(super) fn contains(&self, cell: Cell, direction: Direction) -> bool {
        let beyond = || cell.beyond(direction);
        match direction {
            Direction::North => self.north.contains(cell),
            Direction::East => self.east.contains(cell),
            Direction::South => beyond().is_some_and(|cell| self.north.contains(cell)),
            Direction::West => beyond().is_some_and(|cell| self.east.contains(cell)),
        }
    }

    /// Returns a number that is nearly unique to the side, and the same from both its cells.
    pub(super) fn fingerprint(cell: Cell, direction: Direction) -> u64 {
        let number = northern_or_eastern(cell, direction).map_or(u64::MAX, |(cell, side)| {
            let is_north = u64::from(side == Direction::North);
            u64::from(cell.y) << 17 | u64::from(cell.x) << 1 | is_north
        });
        SplitMix::new(number).next()
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        Self {
            north: self.north.minus(&other.north),
            east: self.east.minus(&other.east),
        }
    }

    /// Returns the number of sides, each counted once.
    pub(super) fn len(&self) -> u32 {
        self.north.len() + self.east.len()
    }

    /// Returns the cells that have one of these sides.
    pub(super) fn cells(&self) -> CellSet<N> {
        let mut cells = self.north.or(&self.east);
        let rows = cells.rows.iter_mut().zip(&self.east.rows);
        let mut below = 0;
        for ((cells, east), north) in rows.zip(&self.north.rows) {
            *cells |= east << 1 | below;
            below = *north;
        }
        cells
    }

    /// Returns every side once: the northern ones, then the eastern ones.
    pub(super) fn iter(&self) -> impl Iterator<Item = (Cell, Direction)> + use<N> {
        let north = self.north.iter().map(|cell| (cell, Direction::North));
        north.chain(self.east.iter().map(|cell| (cell, Direction::East)))
    }

    /// Returns the cells that are one leap away from some of `cells`.
    pub(super) fn leaps_from(&self, cells: &CellSet<N>) -> CellSet<N> {
        let mut ends = CellSet::EMPTY;
        let rows = ends.rows.iter_mut().zip(&cells.rows);
        for ((ends, cells), open) in rows.zip(&self.east.rows) {
            let (mut east, mut west) = (*cells, *cells);
            for _ in 0..Leap::MOST_CELLS {
                east = (east & open) << 1;
                west = west >> 1 & open;
                *ends |= east | west;
            }
        }
        // Those that come from the row before, having driven over none, one or two cells.
        let mut coming = [0; Leap::MOST_CELLS as usize];
        let rows = ends.rows.iter_mut().zip(&cells.rows);
        for ((ends, cells), open) in rows.zip(&self.north.rows) {
            let [one, two, three] = coming;
            *ends |= one | two | three;
            coming = [cells & open, one & open, two & open];
        }
        let mut above = [0; Leap::MOST_CELLS as usize];
        let rows = ends.rows.iter_mut().zip(&cells.rows);
        for ((ends, cells), open) in rows.zip(&self.north.rows).rev() {
            let [one, two, three] = above.map(|cells| cells & open);
            *ends |= one | two | three;
            above = [*cells, one, two];
        }
        ends
    }

    /// Returns the leaps from a cell in one direction, the short ones first.
    pub(super) fn leaps_along(
        &self,
        from: Cell,
        direction: Direction,
    ) -> impl Iterator<Item = Leap> {
        Leap::row(from, direction, move |cell| self.contains(cell, direction))
    }

    /// Returns all leaps from a cell, in the order of [`Leap::all`].
    pub(super) fn leaps(&self, from: Cell) -> impl Iterator<Item = Leap> {
        Direction::ALL
            .into_iter()
            .flat_map(move |direction| self.leaps_along(from, direction))
    }

    /// Calls `visit` with begin and end of all leaps over the `side` of `cell`, whether it is in
    /// the set or not. They can be driven the other way as well.
    pub(super) fn leaps_over(
        &self,
        cell: Cell,
        side: Direction,
        mut visit: impl FnMut(Cell, Cell),
    ) {
        let Some(mut head) = cell.beyond(side) else {
            return;
        };
        let mut heads = [head; Leap::MOST_CELLS as usize];
        let mut count = 0;
        for slot in &mut heads {
            *slot = head;
            count += 1;
            match self.next(head, side) {
                Some(next) => head = next,
                None => break,
            }
        }
        let mut tail = cell;
        for most in (1..=heads.len()).rev() {
            for head in heads.iter().take(most.min(count)) {
                visit(tail, *head);
            }
            match self.next(tail, side.opposite()) {
                Some(next) => tail = next,
                None => break,
            }
        }
    }

    /// Returns the cell across an open side.
    fn next(&self, cell: Cell, side: Direction) -> Option<Cell> {
        cell.beyond(side).filter(|_| self.contains(cell, side))
    }
}

impl<const N: usize> From<&Passages<N>> for Sides<N> {
    fn from(passages: &Passages<N>) -> Self {
        let cells = Grid::new(N as u16, N as u16).cells();
        let sides = cells.flat_map(|cell| [(cell, Direction::North), (cell, Direction::East)]);
        Self::of(sides.filter(|(cell, direction)| passages.is_open(*cell, *direction)))
    }
}

/// Returns a side as the northern or eastern one of a cell, or `None` in the west or south of all
/// cells.
fn northern_or_eastern(cell: Cell, direction: Direction) -> Option<(Cell, Direction)> {
    match direction {
        Direction::North | Direction::East => Some((cell, direction)),
        Direction::South | Direction::West => Some((cell.beyond(direction)?, direction.opposite())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some_sides(rng: &mut SplitMix) -> Sides<16> {
        let mut sides = Sides::NONE;
        for _ in 0..300 {
            let cell = Cell::new(rng.below(15) as u16, rng.below(15) as u16);
            sides.insert(cell, Direction::ALL[rng.below(2) as usize]);
        }
        sides
    }

    #[test]
    fn the_leaps_of_all_cells_are_those_of_each() {
        let mut rng = SplitMix::new(1);
        for _ in 0..20 {
            let sides = some_sides(&mut rng);
            let mut from = CellSet::EMPTY;
            let mut expect = CellSet::EMPTY;
            for _ in 0..10 {
                let cell = Cell::new(rng.below(16) as u16, rng.below(16) as u16);
                from.insert(cell);
                sides.leaps(cell).for_each(|leap| expect.insert(leap.end));
            }
            assert_eq!(sides.leaps_from(&from), expect);
        }
    }

    #[test]
    fn the_leaps_over_a_side_are_those_that_it_makes_possible() {
        let mut rng = SplitMix::new(2);
        for _ in 0..20 {
            let mut sides = some_sides(&mut rng);
            let cell = Cell::new(rng.below(15) as u16, rng.below(15) as u16);
            for side in [Direction::North, Direction::East] {
                let count = |sides: &Sides<16>| {
                    let cells = sides.cells().iter();
                    cells.map(|cell| sides.leaps(cell).count()).sum::<usize>()
                };
                sides.remove(cell, side);
                let without = count(&sides);
                let mut over = 0;
                sides.leaps_over(cell, side, |_, _| over += 2);
                sides.insert(cell, side);
                assert_eq!(count(&sides), without + over);
            }
        }
    }
}
