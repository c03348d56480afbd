use core::array;

use tolman_maze::{Cell, Direction, Walls};

use super::chart::Chart;
use super::outlook::Outlook;
use super::stops::Stops;
use super::{Leap, MoveExplorerConfig, MoveExplorerConfigError, MoveMap};
use crate::TooLarge;

/// Explores a maze until the best run is known for certain.
///
/// The paper's *open path* takes all unknown walls for open, its *closed path* for walls (section
/// 3.3.2). When both are equally long, no better run is possible. Here both are counted in steps of
/// the run that will be made, so that the proof holds for that run. The paper counts them in cells.
///
/// Which wall to look at next is our own:
///
/// - Walls matter that lie on a run better than the best known one. The mouse looks first at walls
///   that the very best runs depend on, because no proof can do without them. It looks at near
///   walls before far ones.
/// - While no way to the goal is known, it does so only at walls that are practically on its way.
///   Otherwise it makes for the goal by the way that takes fewest steps if all unknown walls are
///   open. Where it could stop and look on the way, unknown sides that it would see are worth a
///   detour.
/// - As soon as a way is known, the mouse drives to the goal, where it has to be once anyway. Only
///   then it looks at the rest.
///
/// It always ends. Each stop shows a wall that was not looked at yet, and on the way there that
/// stop only gets more attractive.
///
/// [`Rollouts`](super::Rollouts) choose better among the stops that it weighs for the proof, and
/// take longer.
///
/// The explorer remembers only whether it has been at the goal. It compares everything else with
/// `walls` at each call, so walls may be forgotten again at any time.
///
/// `N` is at most 32. A larger `N` does not compile:
///
/// ```compile_fail
/// # use tolman_maze::Cell;
/// # use tolman_planners::moves::{MoveExplorer, MoveExplorerConfig};
/// MoveExplorer::<33>::new(MoveExplorerConfig::tuned(), Cell::new(0, 0)).ok();
/// ```
#[derive(Clone, Debug)]
pub struct MoveExplorer<const N: usize> {
    config: MoveExplorerConfig,
    /// The powers of the first 16 distances, in steps: each distance to the exponent `nearness`.
    distances: [f32; 16],
    start: Cell,
    goal: Goal,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Goal {
    Ahead,
    Visited,
}

/// Decision of an explorer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MoveDecision {
    /// Drive there, and look around.
    Drive(Leap),
    /// Turn right in place, to see the side behind.
    Turn,
    /// The mouse was at a goal, and no run from the start takes fewer steps than the best known
    /// one, whatever the unknown walls are. Its length:
    Finished {
        /// Number of steps of the run.
        moves: u16,
    },
    /// The mouse was at a goal, and to look on is expected to cost more than it gains
    /// ([`WorthConfig`](super::WorthConfig)). The length of the best known run:
    Enough {
        /// Number of steps of the run.
        moves: u16,
    },
    /// No way leads to a goal.
    Stuck,
}

/// Task of an explorer.
pub(super) enum Task {
    /// The decision is made: nothing has to be weighed.
    Decided(MoveDecision),
    /// Drive to this cell.
    DriveTo(Cell),
    /// The mouse was at the goal and knows a run of this length: look for a better one.
    Prove {
        /// Number of steps of the known run.
        closed: u16,
    },
}

impl Task {
    /// Returns the mouse's next move in the cell `at`. `prove` chooses the stop where a run is to
    /// be proved.
    pub(super) fn decide<const N: usize>(
        self,
        chart: &Chart<N>,
        at: Cell,
        prove: impl FnOnce(u16) -> Option<Cell>,
    ) -> MoveDecision {
        let target = match self {
            Self::Decided(decision) => return decision,
            Self::DriveTo(target) => Some(target),
            Self::Prove { closed } => prove(closed),
        };
        let leap = target.and_then(|target| chart.leap_towards(target, at));
        leap.map_or(MoveDecision::Stuck, MoveDecision::Drive)
    }
}

impl<const N: usize> MoveExplorer<N> {
    /// Returns an explorer for a mouse without observations that makes its runs from `start`.
    ///
    /// # Errors
    /// If a weight is out of its range.
    pub fn new(config: MoveExplorerConfig, start: Cell) -> Result<Self, MoveExplorerConfigError> {
        const { assert!(N <= 32, "a row of cells is a word of 32 bits") };
        config.check()?;
        Ok(Self {
            config,
            distances: array::from_fn(|moves| libm::powf(moves as f32, config.nearness)),
            start,
            goal: Goal::Ahead,
        })
    }

    /// Returns the decision in the cell `at` on the way to one of `goals`, once the view from there
    /// is in `walls`. O(N²).
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub fn decide(
        &mut self,
        walls: &impl Walls,
        goals: &[Cell],
        at: Cell,
    ) -> Result<MoveDecision, TooLarge> {
        let chart = self.chart(walls, goals, at)?;
        let prove = |closed| self.proofs::<1>(&chart, at, closed).best();
        Ok(self.task(&chart, at).decide(&chart, at, prove))
    }

    /// Returns the chart of the known walls, as seen from the mouse's cell.
    pub(super) fn chart(
        &mut self,
        walls: &impl Walls,
        goals: &[Cell],
        at: Cell,
    ) -> Result<Chart<N>, TooLarge> {
        if goals.contains(&at) {
            self.goal = Goal::Visited;
        }
        Chart::new(walls, self.start, goals)
    }

    pub(super) fn task(&self, chart: &Chart<N>, at: Cell) -> Task {
        let Some(open) = chart.open() else {
            return Task::Decided(MoveDecision::Stuck);
        };
        if chart.unknown_sides(at).next().is_some() {
            // Only at the start has the mouse not seen what lies behind it. Later it has always
            // seen how far a row of cells goes on both sides before it drives along it.
            return Task::Decided(MoveDecision::Turn);
        }
        let target = match (chart.closed, self.goal) {
            (Some(moves), Goal::Visited) if moves == open => {
                return Task::Decided(MoveDecision::Finished { moves });
            }
            (Some(closed), Goal::Visited) => return Task::Prove { closed },
            // The mouse has to visit the goal at some time, and it is seldom nearer than now.
            (Some(_), Goal::Ahead) => nearest_goal(chart, at),
            (None, _) => {
                // Only the best runs are known to matter so far.
                let proofs = self.proofs::<1>(chart, at, open + 1);
                let early = proofs.best_above(self.config.early_proof);
                early.or_else(|| self.best_approach(chart, at))
            }
        };
        target.map_or(Task::Decided(MoveDecision::Stuck), Task::DriveTo)
    }

    /// Returns the best cell to look from while no way to the goal is known.
    fn best_approach(&self, chart: &Chart<N>, at: Cell) -> Option<Cell> {
        let config = &self.config;
        let unknown = chart.unknown().cells();
        let mut stops = Stops::<1>::new();
        for (moves, front) in chart.around(at) {
            for cell in front.and(&unknown).iter() {
                let Some(onward) = chart.to_goal.moves(cell) else {
                    continue;
                };
                let seen = chart.unknown_sides(cell).count() as f32;
                let score = |unknown: u8| {
                    let onward = f32::from(onward) + config.unknown_wall * f32::from(unknown);
                    config.sight * seen - config.known_step * f32::from(moves) - onward
                };
                // Unknown walls make no stop better, and counting them takes the most time.
                if score(0) < stops.lowest() {
                    continue;
                }
                let score = score(Outlook::unknown_walls(chart, cell));
                stops.offer(score, cell);
            }
        }
        stops.best()
    }

    /// Returns the best stops for the proof, the best first. Runs of `limit` steps and more do not
    /// matter.
    pub(super) fn proofs<const K: usize>(
        &self,
        chart: &Chart<N>,
        at: Cell,
        limit: u16,
    ) -> Stops<K> {
        let mut stops = Stops::new();
        let unknown = chart.unknown().cells();
        for (moves, front) in chart.around(at) {
            let distance = self.distance(moves);
            if stops.lowest() > self.most_told() / distance {
                break;
            }
            front.and(&unknown).iter().for_each(|cell| {
                let told = self.told(chart, cell, limit);
                if told > 0.0 {
                    stops.offer(told / distance, cell);
                }
            });
        }
        stops
    }

    /// Returns the weighted distance of a stop that is `moves` steps away.
    fn distance(&self, moves: u16) -> f32 {
        let near = self.distances.get(usize::from(moves)).copied();
        near.unwrap_or_else(|| libm::powf(f32::from(moves), self.config.nearness))
    }

    /// Returns whether a look around from `cell` can reveal anything about runs of less than
    /// `limit` steps.
    pub(super) fn tells(&self, chart: &Chart<N>, cell: Cell, limit: u16) -> bool {
        self.told(chart, cell, limit) > 0.0
    }

    /// Returns the gain of a look around from `cell`: how much it reveals about runs of less than
    /// `limit` steps.
    fn told(&self, chart: &Chart<N>, cell: Cell, limit: u16) -> f32 {
        let mut told = 0.0;
        // A leap over one of the sides begins or ends at the cell or drives over it. So a run with
        // it is at most one step shorter than a run that stops at the cell.
        let stopping = chart.from_start.moves(cell).zip(chart.to_goal.moves(cell));
        if stopping.is_none_or(|(before, after)| before + after > limit) {
            return told;
        }
        let open = chart.open().unwrap_or(0);
        for side in chart.unknown_sides(cell) {
            if let Some(run) = chart.run_through(cell, side)
                && run < limit
            {
                told += self.config.base + power(self.config.patience, run.saturating_sub(open));
            }
        }
        told
    }

    /// Returns the maximum gain of a stop. One of its four sides is known: the one by which the
    /// mouse arrives.
    fn most_told(&self) -> f32 {
        (Direction::ALL.len() - 1) as f32 * (self.config.base + 1.0)
    }
}

/// Returns the goal that takes fewest steps to drive to.
fn nearest_goal<const N: usize>(chart: &Chart<N>, at: Cell) -> Option<Cell> {
    let here = MoveMap::over(&chart.certain, &super::cell_set::CellSet::of([at]));
    let reached = chart
        .goals
        .iter()
        .filter(|goal| here.moves(*goal).is_some());
    reached.min_by_key(|goal| here.moves(*goal))
}

/// Returns `base` to the power `exponent`.
fn power(base: f32, exponent: u16) -> f32 {
    (0..exponent).fold(1.0, |power, _| power * base)
}

#[cfg(test)]
#[cfg(feature = "alloc")]
mod tests;
