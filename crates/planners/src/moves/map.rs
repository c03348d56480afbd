use core::cmp::Ordering;

use tolman_maze::{Cell, Direction};

use super::Leap;
use super::cell_set::CellSet;
use super::sides::Sides;
use crate::Passages;

/// The fewest steps from every cell to the nearest of some cells, in a maze of up to `N` × `N`, `N`
/// ≤ 32. A leap can be driven back, so it is also the way from there. A larger `N` does not
/// compile:
///
/// ```compile_fail
/// # use tolman_planners::Passages;
/// # use tolman_planners::moves::MoveMap;
/// let _: fn(&Passages<33>) -> MoveMap<33> = |passages| MoveMap::new(passages, []);
/// ```
#[derive(Clone, Debug)]
pub struct MoveMap<const N: usize> {
    moves: [[u16; N]; N],
    /// Number of cells at most n steps away, for each n below `levels`.
    within: [[u16; N]; N],
    levels: u16,
    /// First and last number of steps that sides closed since the last mending put in doubt.
    stale: Option<(u16, u16)>,
}

/// Distance of a cell to which no way leads.
const NEVER: u16 = u16::MAX;

impl<const N: usize> MoveMap<N> {
    const BLANK: Self = Self {
        moves: [[NEVER; N]; N],
        within: [[0; N]; N],
        levels: 0,
        stale: None,
    };

    /// Returns the map of the fewest steps to `targets`, by a breadth-first search over leaps.
    /// Targets outside of `N` × `N` cells are left out. O(N²).
    ///
    /// A target counts only where a leap ends, like the goal in the paper's rules.
    #[must_use]
    pub fn new(passages: &Passages<N>, targets: impl IntoIterator<Item = Cell>) -> Self {
        Self::over(&Sides::from(passages), &CellSet::of(targets))
    }

    /// Returns the map of the fewest steps to `targets`. It computes all cells at the same distance
    /// at once.
    pub(super) fn over(sides: &Sides<N>, targets: &CellSet<N>) -> Self {
        let mut map = Self::BLANK;
        map.spread(sides, Wave::new(*targets), |_| false);
        map
    }

    /// Returns a map of the fewest steps to `target`. The search may end as soon as it reaches
    /// `from`.
    pub(super) fn between(sides: &Sides<N>, target: Cell, from: Cell) -> Self {
        let mut map = Self::BLANK;
        let wave = Wave::new(CellSet::of([target]));
        map.spread(sides, wave, |wave| wave.front.contains(from));
        map
    }

    /// Assigns distances to cells, from the front of `wave` on, until no cell is in doubt any more.
    fn spread(
        &mut self,
        sides: &Sides<N>,
        mut wave: Wave<N>,
        is_enough: impl Fn(&Wave<N>) -> bool,
    ) {
        let last = self.stale.take().map_or(NEVER, |(_, last)| last);
        let mut within = match wave.moves.checked_sub(1) {
            Some(before) => self.within(before),
            None => 0,
        };
        while !wave.front.is_empty() {
            within += wave.front.fill(&mut self.moves, wave.moves);
            let as_before = wave.moves < self.levels && self.within(wave.moves) == within;
            if as_before && wave.moves >= last {
                // The number of cells that near is unchanged, so they are the same ones, and all
                // beyond is as before.
                return;
            }
            let slot = self.within.as_flattened_mut();
            if let Some(slot) = slot.get_mut(usize::from(wave.moves)) {
                *slot = within;
            }
            if is_enough(&wave) {
                break;
            }
            wave.advance(sides);
        }
        if self.levels > 0 {
            wave.reached.fill_others(&mut self.moves, NEVER);
        }
        self.levels = wave.moves;
    }

    fn within(&self, moves: u16) -> u16 {
        let slot = self.within.as_flattened().get(usize::from(moves));
        slot.copied().unwrap_or(0)
    }

    /// Records that one of the `sides` was closed. The map is out of date until it is
    /// [mended](Self::mend).
    pub(super) fn side_closed(&mut self, sides: &Sides<N>, cell: Cell, side: Direction) {
        sides.leaps_over(cell, side, |tail, head| {
            let (near, far) = match self.moves_or_never(tail).cmp(&self.moves_or_never(head)) {
                Ordering::Less => (tail, head),
                Ordering::Equal => return,
                Ordering::Greater => (head, tail),
            };
            // By this leap the farther cell was a step farther than the nearer one. Another leap
            // may give it the same distance.
            let before = self.moves_or_never(near);
            let mut leaps = sides.leaps(far);
            if leaps.any(|leap| self.moves_or_never(leap.end) == before) {
                return;
            }
            let doubtful = self.moves_or_never(far);
            if doubtful == NEVER {
                return;
            }
            let (first, last) = self.stale.unwrap_or((doubtful, doubtful));
            self.stale = Some((first.min(doubtful), last.max(doubtful)));
        });
    }

    /// Updates the map to `sides`, if fewer than `limit` steps anywhere are in doubt. Cells farther
    /// away may then count as out of reach. O(levels that change × N).
    pub(super) fn mend(&mut self, sides: &Sides<N>, limit: u16) {
        let Some((first, _)) = self.stale.filter(|(first, _)| *first < limit) else {
            return;
        };
        let before = first.saturating_sub(1);
        let mut wave = Wave {
            reached: CellSet::filter(&self.moves, |moves| moves < first),
            front: CellSet::filter(&self.moves, |moves| moves == before),
            moves: before,
        };
        wave.advance(sides);
        self.spread(sides, wave, |wave| wave.moves >= limit);
    }

    /// Returns the number of steps from `cell` to the nearest target, or `None` if no way leads
    /// there.
    #[must_use]
    pub fn moves(&self, cell: Cell) -> Option<u16> {
        let moves = self.moves_or_never(cell);
        (moves != NEVER).then_some(moves)
    }

    fn moves_or_never(&self, cell: Cell) -> u16 {
        let row = self.moves.get(usize::from(cell.y));
        let moves = row.and_then(|row| row.get(usize::from(cell.x)));
        moves.copied().unwrap_or(NEVER)
    }

    /// Returns a way of fewest steps from `cell` to a target, on the passages the map was made for.
    /// It is empty if no way leads to one or the cell is one. Of equal leaps the first of
    /// [`Leap::all`] is taken.
    #[must_use]
    pub const fn way<'a>(&'a self, passages: &'a Passages<N>, cell: Cell) -> Way<'a, N> {
        Way {
            map: self,
            passages,
            at: cell,
        }
    }
}

/// Breadth-first search: the cells at one number of steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave<const N: usize> {
    /// Cells that are at most the present number of steps away.
    reached: CellSet<N>,
    /// Cells that are exactly the present number of steps away.
    pub(super) front: CellSet<N>,
    pub(super) moves: u16,
}

impl<const N: usize> Wave<N> {
    pub(super) const fn new(targets: CellSet<N>) -> Self {
        Self {
            reached: targets,
            front: targets,
            moves: 0,
        }
    }

    /// Returns the number of steps until one of some cells is reached.
    pub(super) fn moves_to(mut self, targets: &CellSet<N>, sides: &Sides<N>) -> Option<u16> {
        while self.front.and(targets).is_empty() {
            if self.front.is_empty() {
                return None;
            }
            self.advance(sides);
        }
        Some(self.moves)
    }

    /// Advances by one step.
    pub(super) fn advance(&mut self, sides: &Sides<N>) {
        self.front = sides.leaps_from(&self.front).minus(&self.reached);
        self.reached = self.reached.or(&self.front);
        self.moves += 1;
    }
}

/// The leaps to the nearest target; see [`MoveMap::way`].
#[derive(Clone, Debug)]
pub struct Way<'a, const N: usize> {
    map: &'a MoveMap<N>,
    passages: &'a Passages<N>,
    at: Cell,
}

impl<const N: usize> Iterator for Way<'_, N> {
    type Item = Leap;

    fn next(&mut self) -> Option<Leap> {
        let left = self.map.moves(self.at)?.checked_sub(1)?;
        let leap = Leap::all(self.passages, self.at)
            .find(|leap| self.map.moves(leap.end) == Some(left))?;
        self.at = leap.end;
        Some(leap)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::moves::split_mix::SplitMix;

    const SIDE: u16 = 9;

    /// Returns random sides within a square, each open with the same probability.
    fn sides(rng: &mut SplitMix, open_in_ten: u32) -> Sides<12> {
        let mut sides = Sides::NONE;
        for y in 0..SIDE {
            for x in 0..SIDE {
                for (direction, last) in [(Direction::North, y), (Direction::East, x)] {
                    if last + 1 < SIDE && rng.below(10) < open_in_ten {
                        sides.insert(Cell::new(x, y), direction);
                    }
                }
            }
        }
        sides
    }

    #[test]
    fn a_map_follows_when_sides_are_closed() {
        let mut rng = SplitMix::new(1);
        for _ in 0..20 {
            let mut sides = sides(&mut rng, 9);
            let targets = CellSet::of([Cell::new(4, 4), Cell::new(5, 4)]);
            let mut map = MoveMap::over(&sides, &targets);
            for changes in 0..200 {
                let cell = Cell::new(rng.below(8) as u16, rng.below(8) as u16);
                let side = Direction::ALL[rng.below(2) as usize];
                if sides.contains(cell, side) {
                    sides.remove(cell, side);
                    map.side_closed(&sides, cell, side);
                }
                if changes % 3 == 0 {
                    map.mend(&sides, NEVER);
                    assert_eq!(map.moves, MoveMap::over(&sides, &targets).moves);
                }
            }
        }
    }

    #[test]
    fn a_map_is_mended_below_a_limit_only() {
        let mut sides = Sides::<12>::NONE;
        for y in 0..SIDE {
            sides.insert(Cell::new(0, y), Direction::North);
        }
        let mut map = MoveMap::over(&sides, &CellSet::of([Cell::new(0, 0)]));
        let far = Cell::new(0, 6);
        assert_eq!(map.moves(far), Some(2));
        sides.remove(far, Direction::South);
        map.side_closed(&sides, far, Direction::South);
        map.mend(&sides, 2);
        assert_eq!(map.moves(far), Some(2));
        map.mend(&sides, 3);
        assert_eq!(map.moves(far), None);
    }
}
