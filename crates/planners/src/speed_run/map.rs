use tolman_maze::{Cell, Direction};

use super::buckets::Buckets;
use super::moves::{for_each_turn, straights};
use super::state::{Facing, Node, STATES_PER_CELL};
use super::{RunState, SpeedRun, SpeedRunTimes};
use crate::Passages;

/// Duration that counts as never.
const NEVER: u16 = u16::MAX;

/// Duration of the best speed run from every state to the nearest goal, in a maze of up to `N` ×
/// `N` cells, `N` ≤ 32.
///
/// A run ends in the middle of a goal cell, coming along a straight. It is the best of all that
/// consist of straights, diagonals and [slalom turns](super::Slalom), in whole milliseconds. What
/// takes 65.535 s or more counts as out of reach. A larger `N` does not compile:
///
/// ```compile_fail
/// # use tolman_planners::speed_run::SpeedRunMap;
/// SpeedRunMap::<33>::new();
/// ```
///
/// The search is Dijkstra's, backwards from the goals. The model is the same in both directions, so
/// it drives the reversed runs from the goals to every state. Its queue has buckets no wider than
/// the shortest move lasts, so whatever is in the first bucket is final. Source: Denardo and Fox,
/// *Shortest-route methods: 1. Reaching, pruning, and buckets* (1979).
#[derive(Clone, Debug)]
pub struct SpeedRunMap<const N: usize> {
    /// Times to the reversed states, ms: the search drives backwards from the goals.
    times: [[[u16; STATES_PER_CELL]; N]; N],
    /// One bit for each state: whether its best run begins with a straight, which no other straight
    /// has to continue.
    by_straight: [[u16; N]; N],
    buckets: Buckets<N>,
}

/// Extent of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Searches every state.
    Everywhere,
    /// Searches until the duration from this state is certain. So are those of all states nearer to
    /// a goal; those farther away may be too long, or missing.
    Until(RunState),
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Arrival {
    Straight,
    Turn,
}

impl<const N: usize> Default for SpeedRunMap<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> SpeedRunMap<N> {
    /// Returns a map on which no goal is in reach from anywhere.
    #[must_use]
    pub const fn new() -> Self {
        const { assert!(N <= 32, "a row of cells is a word of 32 bits") };
        Self {
            times: [[[NEVER; STATES_PER_CELL]; N]; N],
            by_straight: [[0; N]; N],
            buckets: Buckets::EMPTY,
        }
    }

    /// Recomputes the times to `goals`. O(N² · N): every state looks along one straight at most.
    pub fn search(
        &mut self,
        passages: &Passages<N>,
        times: &SpeedRunTimes<N>,
        goals: &[Cell],
        extent: Extent,
    ) {
        self.times.as_flattened_mut().fill([NEVER; STATES_PER_CELL]);
        self.buckets.clear();
        let side = N as u16;
        for goal in goals.iter().filter(|goal| goal.x < side && goal.y < side) {
            for heading in Direction::ALL {
                let state = RunState::Straight {
                    cell: *goal,
                    heading,
                };
                self.arrive(Node::new::<N>(state), 0, Arrival::Turn, times);
            }
        }
        let last = match extent {
            Extent::Everywhere => None,
            Extent::Until(state) => Some(Node::new::<N>(state).reversed::<N>()),
        };
        let mut bucket = 0;
        while let Some(next) = self.buckets.next(bucket) {
            bucket = next;
            while let Some(cell) = self.buckets.pop(bucket) {
                self.settle(cell, bucket, passages.sides(), times);
            }
            if last.is_some_and(|last| times.bucket(self.time(last)) <= bucket) {
                break;
            }
        }
    }

    /// Returns the duration of the run from `state` to the nearest goal, ms, or `None` if no way
    /// leads there.
    #[must_use]
    pub fn time_ms(&self, state: RunState) -> Option<u16> {
        let time = self.time_from(Node::new::<N>(state));
        (time != NEVER).then_some(time)
    }

    /// Returns the best run from `start`, move by move, on the passages and times of the last
    /// search.
    ///
    /// If passages were closed since, the result is still a best run, provided that it
    /// [arrives](SpeedRun::has_arrived).
    #[must_use]
    pub fn run<'a>(
        &'a self,
        passages: &'a Passages<N>,
        times: &'a SpeedRunTimes<N>,
        start: RunState,
    ) -> SpeedRun<'a, N> {
        SpeedRun::new(self, passages, times, Node::new::<N>(start))
    }

    /// Returns the duration; [`NEVER`] if no way leads to a goal.
    pub(super) fn time_from(&self, node: Node) -> u16 {
        self.time(node.reversed::<N>())
    }

    #[inline(always)]
    fn time(&self, node: Node) -> u16 {
        let times = self.times.as_flattened().get(node.cell);
        let time = times.and_then(|times| times.get(node.state));
        time.copied().unwrap_or(NEVER)
    }

    #[inline(always)]
    fn arrive(&mut self, node: Node, time: u16, arrival: Arrival, times: &SpeedRunTimes<N>) {
        let states = self.times.as_flattened_mut().get_mut(node.cell);
        let Some(best) = states.and_then(|states| states.get_mut(node.state)) else {
            return;
        };
        if time >= *best {
            return;
        }
        *best = time;
        if let Some(flags) = self.by_straight.as_flattened_mut().get_mut(node.cell) {
            let bit = 1 << node.state;
            match arrival {
                Arrival::Straight => *flags |= bit,
                Arrival::Turn => *flags &= !bit,
            }
        }
        self.buckets.insert(times.bucket(time), node.cell);
    }

    /// Continues from every state of `cell` whose time lies in `bucket`, the first nonempty one.
    fn settle(&mut self, cell: usize, bucket: usize, sides: &[u8], times: &SpeedRunTimes<N>) {
        let (Some(states), Some(by_straight)) = (
            self.times.as_flattened().get(cell).copied(),
            self.by_straight.as_flattened().get(cell).copied(),
        ) else {
            return;
        };
        // No branch for each state, because nothing predicts which states they are.
        let mut due = (0..).zip(states).fold(0_u16, |due, (state, time)| {
            let is_due = times.bucket(time) == bucket && time != NEVER;
            due | u16::from(is_due) << state
        });
        while due != 0 {
            let state = due.trailing_zeros() as usize;
            due &= due - 1;
            let time = states.get(state).copied().unwrap_or(NEVER);
            let node = Node { cell, state };
            if by_straight >> state & 1 == 0 {
                let lengths = match node.facing() {
                    Facing::Straight(_) => times.straights(),
                    Facing::Diagonal(..) => times.diagonals(),
                };
                for (cells, to) in straights::<N>(sides, node) {
                    // A state that was reached no later stays ahead along the whole straight.
                    if self.time(to) <= time {
                        break;
                    }
                    let takes = lengths.get(cells).copied().unwrap_or(NEVER);
                    self.arrive(to, time.saturating_add(takes), Arrival::Straight, times);
                }
            }
            for_each_turn::<N>(sides, node, |slalom, _, to| {
                let takes = times.slalom().time_ms(slalom);
                self.arrive(to, time.saturating_add(takes), Arrival::Turn, times);
            });
        }
    }
}
