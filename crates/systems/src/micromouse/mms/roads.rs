//! Movements of a mouse of mms, with their costs in the score.

use tolman_maze::{Cell, Direction, Grid};
use tolman_planners::lattice::{Gate, LatticeHeading, LatticePoint, LatticePose};
use tolman_planners::{Graph, Passages};

/// All movements on some passages: turns in place by 45° and 90°, and straights, which may be
/// diagonal. Costs are those of the score, counted in halves of a half-step.
pub(super) struct Roads<'a, const N: usize> {
    grid: Grid,
    passages: &'a Passages<N>,
    at_start: TurnsAtStart,
}

/// Cost of turns at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TurnsAtStart {
    /// The movements cost the same everywhere.
    Count,
    /// The movements at the start cost nothing: a run begins with the first one that leaves the
    /// start.
    Free,
}

/// Cost of one turn, in halves.
const TURN: u32 = 2;

/// Returns the cost of a straight of `half_steps` half-steps: those after the second count half.
const fn straight(half_steps: u32) -> u32 {
    if half_steps > 2 {
        half_steps + 2
    } else {
        2 * half_steps
    }
}

impl<'a, const N: usize> Roads<'a, N> {
    pub(super) const fn new(grid: Grid, passages: &'a Passages<N>, at_start: TurnsAtStart) -> Self {
        Self {
            grid,
            passages,
            at_start,
        }
    }

    pub(super) const fn node(&self, stand: LatticePose) -> u32 {
        stand.index(self.grid)
    }

    pub(super) const fn stand(&self, node: u32) -> LatticePose {
        LatticePose::from_index(node, self.grid)
    }

    fn is_open(&self, place: LatticePoint, heading: LatticeHeading) -> bool {
        match place.gate(heading, self.grid) {
            Gate::None => true,
            Gate::Edge(cell, side) => self.passages.is_open(cell, side),
            Gate::Solid => false,
        }
    }
}

impl<const N: usize> Graph for Roads<'_, N> {
    fn node_count(&self) -> usize {
        LatticePose::count(self.grid) as usize
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        let LatticePose { place, heading } = self.stand(node);
        let mut ahead = place;
        for half_steps in 1.. {
            if !self.is_open(ahead, heading) {
                break;
            }
            ahead = ahead.ahead(heading);
            let place = ahead;
            visit(
                self.node(LatticePose { place, heading }),
                straight(half_steps),
            );
        }
        let free = self.at_start == TurnsAtStart::Free && place == LatticePoint::START;
        for eighths in [-2, -1, 1, 2] {
            let heading = heading.turned(eighths);
            let cost = if free { 0 } else { TURN };
            visit(self.node(LatticePose { place, heading }), cost);
        }
    }
}

/// Returns the sides of cells over which a straight leads from one place to another.
pub(super) fn edges(
    grid: Grid,
    from: LatticePose,
    to: LatticePose,
) -> impl Iterator<Item = (Cell, Direction)> {
    let mut place = from.place;
    core::iter::from_fn(move || {
        (place != to.place).then(|| {
            let gate = place.gate(from.heading, grid);
            place = place.ahead(from.heading);
            gate
        })
    })
    .filter_map(|gate| match gate {
        Gate::Edge(cell, side) => Some((cell, side)),
        Gate::None | Gate::Solid => None,
    })
}
