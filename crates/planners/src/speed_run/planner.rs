use core::borrow::BorrowMut;
use core::marker::PhantomData;

use tolman_maze::Cell;

use super::{CellTimes, Extent, RunState, SpeedRun, SpeedRunMap, SpeedRunTimes};
use crate::Passages;

/// Keeps the best run from one start to the goals while the passages change.
///
/// Walls that turn up make no run faster. So as long as a best run found earlier can still be
/// driven, it is a best run still, and nothing has to be searched.
///
/// `M` is the map that it searches, its own or one that was lent to it.
#[derive(Clone, Debug)]
pub struct SpeedRunPlanner<'a, const N: usize, C: CellTimes = [u32; 16], M = SpeedRunMap<N, C>> {
    times: &'a SpeedRunTimes<N>,
    start: RunState,
    goals: &'a [Cell],
    map: M,
    held: PhantomData<C>,
    /// Passages of the last search.
    searched: Option<Passages<N>>,
}

/// Work of an update.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Replanning {
    /// The best run is as fast as before: there is still one among the best known.
    Kept,
    /// The map was searched again.
    Searched,
}

impl<'a, const N: usize, C: CellTimes> SpeedRunPlanner<'a, N, C> {
    /// Returns a planner that has seen no maze yet.
    #[must_use]
    pub const fn new(times: &'a SpeedRunTimes<N>, start: RunState, goals: &'a [Cell]) -> Self {
        Self::with_map(times, start, goals, SpeedRunMap::new())
    }
}

impl<'a, const N: usize, C: CellTimes, M: BorrowMut<SpeedRunMap<N, C>>>
    SpeedRunPlanner<'a, N, C, M>
{
    /// Returns a planner that has seen no maze yet, and searches this map. The map has to be
    /// [new](SpeedRunMap::new) or [cleared](SpeedRunMap::clear).
    #[must_use]
    pub const fn with_map(
        times: &'a SpeedRunTimes<N>,
        start: RunState,
        goals: &'a [Cell],
        map: M,
    ) -> Self {
        Self {
            times,
            start,
            goals,
            map,
            held: PhantomData,
            searched: None,
        }
    }

    /// Takes in the present openings. O(N²) if one of the known best runs is still open, else as
    /// [`SpeedRunMap::search`].
    #[inline(never)]
    pub fn update(&mut self, passages: &Passages<N>) -> Replanning {
        let only_closed = |before: &Passages<N>| passages.is_within(before);
        if self.searched.as_ref().is_some_and(only_closed) {
            let mut run = self.run(passages);
            run.by_ref().for_each(drop);
            if run.has_arrived() || self.time_ms().is_none() {
                return Replanning::Kept;
            }
        }
        let extent = Extent::Until(self.start);
        self.map
            .borrow_mut()
            .search(passages, self.times, self.goals, extent);
        self.searched = Some(passages.clone());
        Replanning::Searched
    }

    /// Returns the duration of the best run, ms, or `None` if no way leads to a goal, or before the
    /// first update.
    #[must_use]
    pub fn time_ms(&self) -> Option<u32> {
        self.map.borrow().time_ms(self.start)
    }

    /// Returns a best run on the passages of the last update.
    #[must_use]
    pub fn run<'b>(&'b self, passages: &'b Passages<N>) -> SpeedRun<'b, N, C> {
        self.map.borrow().run(passages, self.times, self.start)
    }

    /// Returns the state in which the runs begin.
    #[must_use]
    pub const fn start(&self) -> RunState {
        self.start
    }

    /// Returns the cells in which the runs end.
    #[must_use]
    pub const fn goals(&self) -> &'a [Cell] {
        self.goals
    }
}
