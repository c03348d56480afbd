use tolman_maze::{Cell, Direction};

use crate::Passages;

/// How many cells away the nearest of some cells is, for every cell of a maze of up to `N` × `N`,
/// `N` ≤ 255. A larger `N` does not compile:
///
/// ```compile_fail
/// # use tolman_planners::{Passages, StepMap};
/// let _: fn(&Passages<300>) -> StepMap<300> = |passages| StepMap::new(passages, []);
/// ```
///
/// A mouse that drives from cell to cell follows it: always to a neighbour with a smaller number.
///
/// ```
/// use tolman_maze::{Cell, Grid, Maze};
/// use tolman_planners::{Passages, StepMap, Unknown};
///
/// let maze = Maze::open(Grid::new(3, 2));
/// let passages = Passages::<16>::new(&maze, Unknown::Closed)?;
/// let steps = StepMap::new(&passages, [Cell::new(2, 1)]);
/// assert_eq!(steps.steps(Cell::new(0, 0)), Some(3));
/// assert_eq!(steps.steps(Cell::new(3, 0)), None, "not in the maze");
/// # Ok::<(), tolman_planners::TooLarge>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepMap<const N: usize> {
    steps: [[u16; N]; N],
}

/// Distance of a cell to which no way leads.
const NEVER: u16 = u16::MAX;

impl<const N: usize> StepMap<N> {
    /// Returns the distances to `targets`, by breadth-first search; targets outside of `N` × `N`
    /// cells are left out. O(N²).
    #[must_use]
    pub fn new(passages: &Passages<N>, targets: impl IntoIterator<Item = Cell>) -> Self {
        const { assert!(N <= 255, "16 bits count the steps through all cells") };
        let mut map = Self::NOWHERE;
        map.flood(passages, targets);
        map
    }

    /// No way leads to a target.
    pub(crate) const NOWHERE: Self = Self {
        steps: [[NEVER; N]; N],
    };

    /// Counts the steps, in the caller's memory: in a small stack there is no room for two maps.
    #[inline(never)]
    pub(crate) fn flood(
        &mut self,
        passages: &Passages<N>,
        targets: impl IntoIterator<Item = Cell>,
    ) {
        let mut queue = [[0_u16; N]; N];
        let queue = queue.as_flattened_mut();
        let steps = self.steps.as_flattened_mut();
        let (mut first, mut last) = (0, 0);
        let mut reach = |steps: &mut [u16], queue: &mut [u16], cell: usize, step: u16| {
            if let (Some(slot @ &mut NEVER), Some(free)) =
                (steps.get_mut(cell), queue.get_mut(last))
            {
                *slot = step;
                *free = cell as u16;
                last += 1;
            }
            last
        };
        let mut end = 0;
        for target in targets {
            let (x, y) = (usize::from(target.x), usize::from(target.y));
            if x < N && y < N {
                end = reach(steps, queue, y * N + x, 0);
            }
        }
        while first < end {
            let cell = queue.get(first).copied().map_or(0, usize::from);
            first += 1;
            let (Some(sides), Some(step)) = (passages.sides().get(cell), steps.get(cell)) else {
                break;
            };
            let step = step + 1;
            for (bit, beside) in [
                (1, cell.wrapping_add(N)),
                (2, cell + 1),
                (4, cell.wrapping_sub(N)),
                (8, cell.wrapping_sub(1)),
            ] {
                if sides & bit != 0 {
                    end = reach(steps, queue, beside, step);
                }
            }
        }
    }

    /// Returns the number of steps from `cell` to the nearest target, or `None` if no way leads
    /// there.
    #[must_use]
    pub fn steps(&self, cell: Cell) -> Option<u16> {
        let row = self.steps.get(usize::from(cell.y))?;
        let steps = row.get(usize::from(cell.x)).copied()?;
        (steps != NEVER).then_some(steps)
    }

    /// Returns the direction that leads from `cell` nearest to a target: one of `directions` that
    /// is open, the first of equally good ones. `None` if no direction leads to a target.
    #[must_use]
    pub fn descend(
        &self,
        passages: &Passages<N>,
        cell: Cell,
        directions: impl IntoIterator<Item = Direction>,
    ) -> Option<Direction> {
        let open = directions
            .into_iter()
            .filter(|direction| passages.is_open(cell, *direction));
        let steps = |direction| Some((self.steps(cell.beyond(direction)?)?, direction));
        // Of equals, min_by_key takes the first.
        let nearest = open.filter_map(steps).min_by_key(|(steps, _)| *steps);
        nearest.map(|(_, direction)| direction)
    }
}
