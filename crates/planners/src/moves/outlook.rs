use tolman_maze::{Cell, Direction, Walls};

use super::hopes::Hopes;
use super::queue::Queue;
use super::{Leap, MoveMap};

/// How many walls nobody has looked at the hoped-for way to the goal drives over, at least, from every cell.
pub(super) struct Outlook<const N: usize> {
    unknown: [[u8; N]; N],
}

impl<const N: usize> Outlook<N> {
    /// Among the ways of fewest steps the one over fewest unknown walls. O(N²).
    pub(super) fn new<W: Walls>(hopes: &Hopes<'_, N, W>) -> Self {
        let mut outlook = Self {
            unknown: [[u8::MAX; N]; N],
        };
        // Breadth-first again: all cells one step nearer are done before a cell's turn comes.
        let mut queue = Queue::new();
        for goal in hopes.goals {
            outlook.lower(&mut queue, *goal, 0);
        }
        while let Some(cell) = queue.pop() {
            let so_far = outlook.unknown_walls(cell);
            for direction in Direction::ALL {
                let (mut at, mut unknown) = (cell, so_far);
                for leap in Leap::along(hopes.hoped, cell, direction) {
                    unknown = unknown.saturating_add(hopes.is_unknown(at, direction).into());
                    at = leap.end;
                    if is_next(hopes.to_goal, cell, at) {
                        outlook.lower(&mut queue, at, unknown.min(u8::MAX - 1));
                    }
                }
            }
        }
        outlook
    }

    fn lower(&mut self, queue: &mut Queue<N>, cell: Cell, unknown: u8) {
        let row = self.unknown.get_mut(usize::from(cell.y));
        if let Some(slot) = row.and_then(|row| row.get_mut(usize::from(cell.x))) {
            if *slot == u8::MAX {
                queue.push(cell);
            }
            *slot = (*slot).min(unknown);
        }
    }

    /// Unknown walls on the way from `cell`; the greatest number where there is no way.
    pub(super) fn unknown_walls(&self, cell: Cell) -> u8 {
        let row = self.unknown.get(usize::from(cell.y));
        let unknown = row.and_then(|row| row.get(usize::from(cell.x)));
        unknown.copied().unwrap_or(u8::MAX)
    }
}

/// Whether `far` is one step farther than `near`.
fn is_next<const N: usize>(map: &MoveMap<N>, near: Cell, far: Cell) -> bool {
    let next = map.moves(near).and_then(|moves| moves.checked_add(1));
    next.is_some() && map.moves(far) == next
}
