use tolman_maze::Cell;

use super::Leap;
use super::queue::Queue;
use crate::Passages;

/// The fewest steps from every cell of a maze of up to `N` × `N` to the nearest of some cells, and to come
/// from there: a leap can be driven back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MoveMap<const N: usize> {
    moves: [[u16; N]; N],
}

/// No way leads there.
const NEVER: u16 = u16::MAX;

impl<const N: usize> MoveMap<N> {
    /// Breadth-first search from `targets`, leap by leap; those outside of `N` × `N` cells are left out. O(N²).
    ///
    /// A target counts only where a leap ends, as the goal does in the paper's rules.
    #[must_use]
    pub fn new(passages: &Passages<N>, targets: impl IntoIterator<Item = Cell>) -> Self {
        let mut map = Self {
            moves: [[NEVER; N]; N],
        };
        let mut queue = Queue::new();
        for target in targets {
            map.reach(&mut queue, target, 0);
        }
        while let Some(cell) = queue.pop() {
            let moves = map.moves(cell).unwrap_or(0) + 1;
            for leap in Leap::all(passages, cell) {
                map.reach(&mut queue, leap.end, moves);
            }
        }
        map
    }

    fn reach(&mut self, queue: &mut Queue<N>, cell: Cell, moves: u16) {
        let row = self.moves.get_mut(usize::from(cell.y));
        if let Some(slot @ &mut NEVER) = row.and_then(|row| row.get_mut(usize::from(cell.x))) {
            *slot = moves;
            queue.push(cell);
        }
    }

    /// Steps from `cell` to the nearest target, none if no way leads there.
    #[must_use]
    pub fn moves(&self, cell: Cell) -> Option<u16> {
        let row = self.moves.get(usize::from(cell.y))?;
        let moves = row.get(usize::from(cell.x)).copied()?;
        (moves != NEVER).then_some(moves)
    }

    /// A way of fewest steps from `cell` to a target, on the passages the map was made for. Nothing, where no
    /// way leads to one or the cell is one. Of equally good leaps the first of [`Leap::all`] is taken.
    #[must_use]
    pub const fn way<'a>(&'a self, passages: &'a Passages<N>, cell: Cell) -> Way<'a, N> {
        Way {
            map: self,
            passages,
            at: cell,
        }
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
