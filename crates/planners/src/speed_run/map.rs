use core::mem;

use tolman_maze::Cell;

use super::buckets::Buckets;
use super::estimate::Estimate;
use super::state::{Node, STATES_PER_CELL, index};
use super::ways::{line, turns};
use super::{CellTimes, RunState, SpeedRun, SpeedRunTimes};
use crate::Passages;

/// Duration that counts as never, ms. Two of them fit into a number.
pub(super) const NEVER: u32 = 1 << 30;

/// Duration of the best speed run from every state to the nearest goal, in a maze of up to `N` ×
/// `N` cells, `N` ≤ 32.
///
/// A run ends in the middle of a goal cell, coming along a straight. It is the best of all that
/// consist of straights, diagonals and [slalom turns](super::Slalom), in whole milliseconds. `C`
/// says how much memory its times take; a chip with little of it has [smaller ones](CellTimes). A
/// larger `N` does not compile:
///
/// ```compile_fail
/// # use tolman_planners::speed_run::SpeedRunMap;
/// SpeedRunMap::<33>::new();
/// ```
///
/// The search is Dijkstra's, backwards from the goals. The model is the same in both directions, so
/// it drives the reversed runs from the goals to every state. Its queue has buckets of time; once a
/// bucket is empty, all times within it are final. Only states behind a turn wait there: from all
/// along a straight the search turns at once. What is reached sooner later on is driven on from
/// again, which happens too seldom to be worth a finer order. Source: Denardo and Fox,
/// *Shortest-route methods: 1. Reaching, pruning, and buckets* (1979). A search until a start is
/// A*: its buckets are of the least time that a whole run can take, and it leaves out what cannot
/// be part of a run as fast as one that was found. Source: Hart, Nilsson and Raphael, *A formal
/// basis for the heuristic determination of minimum cost paths* (1968).
#[derive(Clone, Debug)]
pub struct SpeedRunMap<const N: usize, C: CellTimes = [u32; 16]> {
    /// Times to the reversed states, ms: the search drives backwards from the goals.
    times: [[C; N]; N],
    /// One bit for each state that a turn reaches and whose moves have not been looked at yet.
    waiting: [[u16; N]; N],
    buckets: Buckets<N>,
}

/// Extent of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Searches every state.
    Everywhere,
    /// Searches until the duration from this state is certain, and those of all states on a best
    /// run from it. Others may be too long, or missing.
    Until(RunState),
}

impl<const N: usize, C: CellTimes> Default for SpeedRunMap<N, C> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, C: CellTimes> SpeedRunMap<N, C> {
    /// Returns a map on which no goal is in reach from anywhere.
    #[must_use]
    pub const fn new() -> Self {
        const { assert!(N <= 32, "a row of cells is a word of 32 bits") };
        Self {
            times: [[C::NOWHERE; N]; N],
            waiting: [[0; N]; N],
            buckets: Buckets::EMPTY,
        }
    }

    /// Forgets all times, as if no goal were in reach from anywhere.
    pub fn clear(&mut self) {
        self.times.as_flattened_mut().fill(C::NOWHERE);
        self.waiting.as_flattened_mut().fill(0);
        self.buckets.clear();
    }

    /// Recomputes the times to `goals`. O(N² · N): each state looks along one straight.
    pub fn search(
        &mut self,
        passages: &Passages<N>,
        times: &SpeedRunTimes<N>,
        goals: &[Cell],
        extent: Extent,
    ) {
        match extent {
            Extent::Everywhere => self.search_to(passages, times, goals, None),
            Extent::Until(start) => {
                let start = Node::new::<N>(start);
                let ends = goals.iter().copied().chain([start.cell_of::<N>()]);
                let passages = passages.without_dead_ends(ends);
                self.search_to(&passages, times, goals, Some(start.reversed::<N>()));
            }
        }
    }

    /// Searches until the time to `last` is certain.
    fn search_to(
        &mut self,
        passages: &Passages<N>,
        times: &SpeedRunTimes<N>,
        goals: &[Cell],
        last: Option<Node>,
    ) {
        self.clear();
        let mut estimate = Estimate::to(last, times);
        let side = N as u16;
        for goal in goals.iter().filter(|goal| goal.x < side && goal.y < side) {
            for heading in 0..4 {
                let node = Node::straight(index::<N>(*goal), heading);
                self.reach(node, 0, &estimate, times);
            }
        }
        let mut bucket = 0;
        while let Some(next) = self.buckets.next(bucket) {
            bucket = next;
            estimate.at_most = last.map_or(NEVER, |last| self.time(last));
            while let Some(cell) = self.buckets.pop(bucket) {
                self.settle(cell, &estimate, passages, times);
            }
            if last.is_some_and(|last| times.bucket(self.time(last)) <= bucket) {
                break;
            }
        }
    }

    /// Returns the duration of the run from `state` to the nearest goal, ms, or `None` if no way
    /// leads there.
    #[must_use]
    pub fn time_ms(&self, state: RunState) -> Option<u32> {
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
    ) -> SpeedRun<'a, N, C> {
        SpeedRun::new(self, passages, times, Node::new::<N>(start))
    }

    /// Returns the duration; [`NEVER`] if no way leads to a goal.
    pub(super) fn time_from(&self, node: Node) -> u32 {
        self.time(node.reversed::<N>())
    }

    fn time(&self, node: Node) -> u32 {
        if node.state >= C::STATES {
            return NEVER;
        }
        C::of(self.times.as_flattened(), number::<N, C>(node))
    }

    /// Drives on from every waiting state of `cell`.
    #[inline(always)]
    fn settle(
        &mut self,
        cell: usize,
        estimate: &Estimate<N>,
        passages: &Passages<N>,
        times: &SpeedRunTimes<N>,
    ) {
        // Without times of states on edges, straights lead from cell to cell.
        let has_halves = C::STATES == STATES_PER_CELL && times.has_halves();
        let waiting = self.waiting.as_flattened_mut().get_mut(cell % (N * N));
        let mut waiting = waiting.map_or(0, mem::take);
        while waiting != 0 {
            let from = Node::numbered(cell, waiting.trailing_zeros() as usize);
            waiting &= waiting - 1;
            let time = C::limit(self.times.as_flattened(), number::<N, C>(from));
            self.turn(from, time, estimate, passages, times);
            let lengths = times.straights_of(from.facing(), has_halves);
            let lengths = lengths.get(1..).unwrap_or_default();
            let line = line::<N, C>(passages, from, has_halves);
            for (takes, (to, is_open)) in lengths.iter().zip(line) {
                let state = number::<N, C>(to);
                let limit = C::limit(self.times.as_flattened(), state);
                // A state that was reached no later stays ahead along the whole straight. One
                // branch for both, because nothing foresees where a straight ends.
                if !is_open | (limit <= time) {
                    break;
                }
                let arrives = time + u32::from(*takes);
                if arrives < limit.min(estimate.at_most) {
                    C::set(self.times.as_flattened_mut(), state, arrives);
                    if let Some(waiting) =
                        self.waiting.as_flattened_mut().get_mut(to.cell % (N * N))
                    {
                        *waiting &= !(1 << to.state);
                    }
                    self.turn(to, arrives, estimate, passages, times);
                }
            }
        }
    }

    /// Makes every turn from `from`, reached at `time`. What it reaches sooner than anything did
    /// before waits for its bucket.
    #[inline(always)]
    fn turn(
        &mut self,
        from: Node,
        time: u32,
        estimate: &Estimate<N>,
        passages: &Passages<N>,
        times: &SpeedRunTimes<N>,
    ) {
        let state = number::<N, C>(from);
        for turn in turns::<N, C>(passages, from) {
            let arrives = time + times.numbered_turn_ms(turn.backwards.into());
            let end = state.wrapping_add_signed(turn.states.into());
            // Three of four were reached sooner.
            if arrives < C::limit(self.times.as_flattened(), end) {
                self.reach(turn.end(from), arrives, estimate, times);
            }
        }
    }

    /// Lets a state that is reached sooner than before wait for its bucket, if it can be part of a
    /// best run.
    #[inline(always)]
    fn reach(&mut self, node: Node, time: u32, estimate: &Estimate<N>, times: &SpeedRunTimes<N>) {
        let whole = estimate.of_run(time, node.cell);
        if whole <= estimate.at_most {
            C::set(self.times.as_flattened_mut(), number::<N, C>(node), time);
            if let Some(waiting) = self.waiting.as_flattened_mut().get_mut(node.cell % (N * N)) {
                *waiting |= 1 << node.state;
            }
            self.buckets.insert(times.bucket(whole), node.cell);
        }
    }
}

/// Returns the number of a state in [`CellTimes`].
#[inline(always)]
const fn number<const N: usize, C: CellTimes>(node: Node) -> usize {
    node.cell % (N * N) * C::STATES + node.state
}
